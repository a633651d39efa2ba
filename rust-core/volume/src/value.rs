//! Types of voxels: as files hold them, and as grids do.

use half::f16;

/// A number as files hold it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Number {
    Bool,
    /// Voxels that are on or off and have no value beside.
    Mask,
    Int8,
    Uint8,
    Int16,
    Uint16,
    Int32,
    Uint32,
    Int64,
    Half,
    Float,
    Double,
}

impl Number {
    pub(crate) fn size(self) -> usize {
        match self {
            Self::Bool | Self::Mask | Self::Int8 | Self::Uint8 => 1,
            Self::Int16 | Self::Uint16 | Self::Half => 2,
            Self::Int32 | Self::Uint32 | Self::Float => 4,
            Self::Int64 | Self::Double => 8,
        }
    }

    fn is_real(self) -> bool {
        matches!(self, Self::Float | Self::Double)
    }

    /// Numbers of the file, as single-precision ones at the end of `to`.
    pub(crate) fn decode(self, bytes: &[u8], to: &mut Vec<f32>) {
        fn each<const N: usize>(bytes: &[u8], to: &mut Vec<f32>, convert: impl Fn([u8; N]) -> f32) {
            to.extend(bytes.as_chunks::<N>().0.iter().map(|chunk| convert(*chunk)));
        }
        match self {
            Self::Bool | Self::Mask => each(bytes, to, |[byte]| f32::from(u8::from(byte != 0))),
            Self::Int8 => each(bytes, to, |b| i8::from_le_bytes(b).into()),
            Self::Uint8 => each(bytes, to, |b| u8::from_le_bytes(b).into()),
            Self::Int16 => each(bytes, to, |b| i16::from_le_bytes(b).into()),
            Self::Uint16 => each(bytes, to, |b| u16::from_le_bytes(b).into()),
            Self::Int32 => each(bytes, to, |b| i32::from_le_bytes(b) as f32),
            Self::Uint32 => each(bytes, to, |b| u32::from_le_bytes(b) as f32),
            Self::Int64 => each(bytes, to, |b| i64::from_le_bytes(b) as f32),
            Self::Half => each(bytes, to, |b| f16::from_le_bytes(b).into()),
            Self::Float => each(bytes, to, f32::from_le_bytes),
            Self::Double => each(bytes, to, |b| f64::from_le_bytes(b) as f32),
        }
    }
}

/// The type of a file's voxels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct ValueType {
    pub(crate) number: Number,
    /// 1 to 4.
    pub(crate) components: usize,
    /// Real numbers of voxels are stored as halves; those of tiles of the root and the background are not.
    pub(crate) halved: bool,
}

/// The most components of a value.
pub(crate) const COMPONENTS: usize = 4;

impl ValueType {
    /// By OpenVDB's name of the type, such as `float` or `vec3s`.
    pub(crate) fn named(name: &str, halved: bool) -> Option<Self> {
        let (number, components) = match name {
            "bool" => (Number::Bool, 1),
            "mask" => (Number::Mask, 1),
            "int8" => (Number::Int8, 1),
            "uint8" => (Number::Uint8, 1),
            "int16" => (Number::Int16, 1),
            "uint16" => (Number::Uint16, 1),
            "int32" => (Number::Int32, 1),
            "uint32" => (Number::Uint32, 1),
            "int64" => (Number::Int64, 1),
            "half" => (Number::Half, 1),
            "float" => (Number::Float, 1),
            "double" => (Number::Double, 1),
            "vec2i" => (Number::Int32, 2),
            "vec2s" => (Number::Float, 2),
            "vec2d" => (Number::Double, 2),
            "vec3u8" => (Number::Uint8, 3),
            "vec3u16" => (Number::Uint16, 3),
            "vec3i" => (Number::Int32, 3),
            "vec3h" => (Number::Half, 3),
            "vec3s" => (Number::Float, 3),
            "vec3d" => (Number::Double, 3),
            "vec4i" => (Number::Int32, 4),
            "vec4s" => (Number::Float, 4),
            "vec4d" => (Number::Double, 4),
            _ => return None,
        };
        Some(Self { number, components, halved: halved && number.is_real() })
    }

    /// Bytes of one value in full.
    pub(crate) fn size(self) -> usize {
        self.number.size() * self.components
    }

    /// The number that arrays of voxels are made of.
    pub(crate) fn stored(self) -> Number {
        if self.halved { Number::Half } else { self.number }
    }

    /// How a grid holds it; nothing for two and four components.
    pub(crate) fn storage(self) -> Option<Storage> {
        match (self.components, self.stored()) {
            (1, Number::Half) => Some(Storage::Half),
            (1, _) => Some(Storage::Float),
            (3, _) => Some(Storage::Vector),
            _ => None,
        }
    }
}

/// How a grid holds its voxels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Storage {
    /// Single precision; double precision, whole numbers and yes or no are rounded to it.
    Float,
    /// Half precision, as the file has it.
    Half,
    /// Three numbers of single precision.
    Vector,
}

impl Storage {
    /// Bytes of one voxel.
    pub fn bytes(self) -> u64 {
        match self {
            Self::Float => 4,
            Self::Half => 2,
            Self::Vector => 12,
        }
    }
}

/// The voxels of all bricks: 512 a brick, x slowest and z fastest, as OpenVDB's leaves have them.
#[derive(Clone, Debug, PartialEq)]
pub enum Values {
    /// Of single precision.
    Float(Vec<f32>),
    /// Of half precision.
    Half(Vec<f16>),
    /// Of three numbers.
    Vector(Vec<[f32; 3]>),
}

impl Values {
    pub(crate) fn with_capacity(storage: Storage, voxels: usize) -> Self {
        match storage {
            Storage::Float => Self::Float(Vec::with_capacity(voxels)),
            Storage::Half => Self::Half(Vec::with_capacity(voxels)),
            Storage::Vector => Self::Vector(Vec::with_capacity(voxels)),
        }
    }

    /// How the voxels are held.
    pub fn storage(&self) -> Storage {
        match self {
            Self::Float(_) => Storage::Float,
            Self::Half(_) => Storage::Half,
            Self::Vector(_) => Storage::Vector,
        }
    }

    /// The number of voxels.
    pub fn len(&self) -> usize {
        match self {
            Self::Float(values) => values.len(),
            Self::Half(values) => values.len(),
            Self::Vector(values) => values.len(),
        }
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// One voxel; a scalar stands in all three places.
    ///
    /// # Panics
    ///
    /// If there is no such voxel.
    pub fn get(&self, index: usize) -> [f32; 3] {
        match self {
            Self::Float(values) => [values[index]; 3],
            Self::Half(values) => [values[index].to_f32(); 3],
            Self::Vector(values) => values[index],
        }
    }

    /// Appends voxels, told as numbers one after another.
    pub(crate) fn push(&mut self, numbers: &[f32]) {
        match self {
            Self::Float(values) => values.extend_from_slice(numbers),
            Self::Half(values) => values.extend(numbers.iter().map(|x| f16::from_f32(*x))),
            Self::Vector(values) => values.extend_from_slice(numbers.as_chunks::<3>().0),
        }
    }
}
