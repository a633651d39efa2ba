//! The container of RGL's measurements: named arrays of numbers behind a list of fields (EPFL, "tensor_file" version 1.0).

use half::f16;

use super::bytes::{Cursor, doubles, floats};
use crate::error::{FormatError, Result};

/// How such a file begins.
pub(crate) const MAGIC: &[u8; 12] = b"tensor_file\0";

/// Fields whose names or shapes are longer than this are no tensor file of ours.
const MOST_DIMENSIONS: usize = 16;

/// An array of a tensor file.
#[derive(Clone, Debug)]
pub(crate) struct Field<'a> {
    name: &'a str,
    /// The array's lengths; one may be zero.
    pub(crate) shape: Vec<usize>,
    kind: u8,
    offset: u64,
    bytes: &'a [u8],
}

/// The fields of a tensor file, all inside its bytes.
#[derive(Clone, Debug)]
pub(crate) struct TensorFile<'a> {
    fields: Vec<Field<'a>>,
}

impl<'a> TensorFile<'a> {
    /// Reads the list of fields; the arrays stay where they are.
    pub(crate) fn read(bytes: &'a [u8]) -> Result<Self> {
        let mut cursor = Cursor::new(bytes);
        if cursor.take(12, "the magic")? != MAGIC {
            return Err(FormatError::byte(0, "not a tensor file: it does not begin with \"tensor_file\""));
        }
        let version = (cursor.u8("the version")?, cursor.u8("the version")?);
        if version.0 != 1 {
            return Err(FormatError::byte(12, format!("tensor file version {}.{}, expected 1.0", version.0, version.1)));
        }
        let count = cursor.u32("the number of fields")?;
        let mut fields = Vec::new();
        for _ in 0..count {
            fields.push(Field::read(&mut cursor, bytes)?);
        }
        Ok(Self { fields })
    }

    /// The field of that name, if there is one.
    pub(crate) fn find(&self, name: &str) -> Option<&Field<'a>> {
        self.fields.iter().find(|field| field.name == name)
    }

    /// The field of that name.
    pub(crate) fn field(&self, name: &str) -> Result<&Field<'a>> {
        self.find(name).ok_or_else(|| {
            let found: Vec<&str> = self.fields.iter().map(|field| field.name).take(20).collect();
            FormatError::whole(format!("no field \"{name}\"; found {}", found.join(", ")))
        })
    }
}

impl<'a> Field<'a> {
    fn read(cursor: &mut Cursor<'a>, bytes: &'a [u8]) -> Result<Self> {
        let at = cursor.at();
        let length = cursor.u16("a field's name")?;
        let name = core::str::from_utf8(cursor.take(length.into(), "a field's name")?)
            .map_err(|_| FormatError::byte(at + 2, "a field's name is not UTF-8"))?;
        let dimensions = usize::from(cursor.u16("a field's number of dimensions")?);
        if dimensions > MOST_DIMENSIONS {
            return Err(FormatError::byte(cursor.at() - 2, format!("{dimensions} dimensions, expected up to {MOST_DIMENSIONS}")));
        }
        let kind = cursor.u8("a field's type")?;
        let size = match kind {
            1 | 2 => 1,
            3 | 4 | 9 => 2,
            5 | 6 | 10 => 4,
            7 | 8 | 11 => 8,
            _ => return Err(FormatError::byte(cursor.at() - 1, format!("type {kind} of field \"{name}\", expected 1 to 11"))),
        };
        let offset = cursor.u64("a field's offset")?;
        let shape_at = cursor.at();
        let shape = (0..dimensions).map(|_| cursor.u64("a field's shape")).collect::<Result<Vec<u64>>>()?;
        let length = shape.iter().try_fold(size, |product: u64, &n| product.checked_mul(n));
        let data = length
            .and_then(|length| Some(usize::try_from(offset).ok()?..usize::try_from(offset.checked_add(length)?).ok()?))
            .and_then(|range| bytes.get(range));
        let Some(data) = data else {
            let problem =
                format!("field \"{name}\" of shape {shape:?} at byte {offset} does not fit into the file's {} bytes", bytes.len());
            return Err(FormatError::byte(shape_at, problem));
        };
        Ok(Self { name, shape: shape.iter().map(|&n| n as usize).collect(), kind, offset, bytes: data })
    }

    /// The numbers, whatever their type.
    pub(crate) fn numbers(&self) -> Vec<f64> {
        let b = self.bytes;
        let pairs = |f: fn([u8; 2]) -> f64| b.chunks_exact(2).map(|b| f([b[0], b[1]])).collect();
        let quads = |f: fn([u8; 4]) -> f64| b.chunks_exact(4).map(|b| f([b[0], b[1], b[2], b[3]])).collect();
        let eights = |f: fn(u64) -> f64| doubles(b).map(|x| f(x.to_bits())).collect();
        match self.kind {
            1 => b.iter().map(|&x| f64::from(x)).collect(),
            2 => b.iter().map(|&x| f64::from(x as i8)).collect(),
            3 => pairs(|b| f64::from(u16::from_le_bytes(b))),
            4 => pairs(|b| f64::from(i16::from_le_bytes(b))),
            9 => pairs(|b| f16::from_le_bytes(b).to_f64()),
            5 => quads(|b| f64::from(u32::from_le_bytes(b))),
            6 => quads(|b| f64::from(i32::from_le_bytes(b))),
            10 => quads(|b| f64::from(f32::from_le_bytes(b))),
            7 => eights(|x| x as f64),
            8 => eights(|x| x as i64 as f64),
            _ => eights(f64::from_bits),
        }
    }

    /// The bytes, of a text.
    pub(crate) fn bytes(&self) -> &'a [u8] {
        self.bytes
    }

    /// The numbers, all of them finite, as f32.
    pub(crate) fn finite_floats(&self) -> Result<Vec<f32>> {
        // The common case copies once.
        let floats: Vec<f32> =
            if self.kind == 10 { floats(self.bytes).collect() } else { self.numbers().iter().map(|&x| x as f32).collect() };
        match floats.iter().position(|x| !x.is_finite()) {
            Some(at) => {
                let size = (self.bytes.len() / floats.len()) as u64;
                Err(FormatError::byte(self.offset + at as u64 * size, format!("{} in field \"{}\"", floats[at], self.name)))
            }
            None => Ok(floats),
        }
    }

    /// Fails unless the shape is `expected`; `None` is any length from `least` on.
    pub(crate) fn expect_shape(&self, expected: &[Option<usize>], least: usize) -> Result<()> {
        let fits = |(&n, want): (&usize, &Option<usize>)| want.map_or(n >= least, |want| n == want);
        if self.shape.len() == expected.len() && self.shape.iter().zip(expected).all(fits) {
            return Ok(());
        }
        let name = |want: &Option<usize>| want.map_or(format!("{least} or more"), |n| n.to_string());
        let want: Vec<String> = expected.iter().map(name).collect();
        Err(FormatError::byte(self.offset, format!("field \"{}\" of shape {:?}, expected [{}]", self.name, self.shape, want.join(", "))))
    }
}

/// An array to write.
pub(crate) struct Output<'a> {
    pub(crate) name: &'a str,
    pub(crate) shape: Vec<usize>,
    pub(crate) data: Data<'a>,
}

/// Its numbers.
pub(crate) enum Data<'a> {
    Bytes(&'a [u8]),
    Floats(&'a [f32]),
}

/// A tensor file of these arrays.
pub(crate) fn write(outputs: &[Output<'_>]) -> Vec<u8> {
    let header: usize = 18 + outputs.iter().map(|o| 2 + o.name.len() + 2 + 1 + 8 + 8 * o.shape.len()).sum::<usize>();
    let mut file = MAGIC.to_vec();
    file.extend([1, 0]);
    file.extend((outputs.len() as u32).to_le_bytes());
    let mut offset = header.next_multiple_of(8);
    for output in outputs {
        let (kind, length) = match output.data {
            Data::Bytes(bytes) => (1, bytes.len()),
            Data::Floats(floats) => (10, 4 * floats.len()),
        };
        file.extend((output.name.len() as u16).to_le_bytes());
        file.extend(output.name.as_bytes());
        file.extend((output.shape.len() as u16).to_le_bytes());
        file.push(kind);
        file.extend((offset as u64).to_le_bytes());
        output.shape.iter().for_each(|&n| file.extend((n as u64).to_le_bytes()));
        offset = (offset + length).next_multiple_of(8);
    }
    for output in outputs {
        file.resize(file.len().next_multiple_of(8), 0);
        match output.data {
            Data::Bytes(bytes) => file.extend(bytes),
            Data::Floats(floats) => floats.iter().for_each(|x| file.extend(x.to_le_bytes())),
        }
    }
    file
}
