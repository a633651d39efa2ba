//! A material's graph laid out for running: steps in order, each with a four-component register.

use super::{Curve, LightPathValue};
use gonio_image::texture::{Filter, Wrap};
use std::sync::Arc;

/// Where a step reads: a constant, or the register of an earlier step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Source {
    /// Four components.
    Constant([f32; 4]),
    /// All components of a register.
    Register(u16),
    /// One component of a register in all four places.
    Component(u16, u8),
}

impl Source {
    /// The register it reads.
    fn register(self) -> Option<u16> {
        match self {
            Self::Constant(_) => None,
            Self::Register(number) | Self::Component(number, _) => Some(number),
        }
    }
    /// Follows registers to their new places.
    fn renumber(&mut self, place: &[u16]) {
        match self {
            Self::Constant(_) => {}
            Self::Register(number) | Self::Component(number, _) => *number = place[usize::from(*number)],
        }
    }
}

/// Arithmetic on each of four components alike.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Arithmetic {
    /// a + b.
    Add,
    /// a − b.
    Subtract,
    /// a · b.
    Multiply,
    /// a / b, zero where b is zero.
    Divide,
    /// a at c = 0, b at c = 1.
    Mix,
    /// a to the power b, zero for negative a; zero to the power zero is one, to any other zero.
    Power,
    /// b − a.
    Invert,
    /// a held between b and c.
    Clamp,
    /// The lesser of a and b.
    Minimum,
    /// The greater of a and b.
    Maximum,
    /// The magnitude of a.
    Absolute,
    /// −1, 0 or 1.
    Sign,
    /// The largest integer not above a.
    Floor,
    /// The square root of a, zero below zero.
    SquareRoot,
    /// e to the power a, which is held to 88.
    Exponential,
    /// The natural logarithm of a, zero for a ≤ 0.
    Logarithm,
    /// The sine of a, radians.
    Sine,
    /// The cosine of a, radians.
    Cosine,
    /// The angle whose sine is a, held to [−1, 1].
    ArcSine,
    /// The angle whose cosine is a, held to [−1, 1].
    ArcCosine,
    /// The angle of the point (b, a).
    ArcTangent2,
    /// 1 where a < b, else 0.
    Less,
    /// Reflectance of a smooth dielectric at the cosine |a|; b is the far side's index over the near side's.
    Fresnel,
}

/// Operations that mix components.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum VectorOperation {
    /// The luminance of a in all components.
    Luminance,
    /// The inner product of the first three components in all.
    Dot,
    /// The cross product.
    Cross,
    /// The unit vector; zero stays zero.
    Normalize,
    /// Hue in turns, saturation and value of a colour; the fourth component stays.
    RgbToHsv,
    /// Its inverse.
    HsvToRgb,
}

/// What is known of a hit; normals are unit and on the side of `wo`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum HitValue {
    /// World position, metres, not rebased.
    Position,
    /// The shading normal before the program bends it.
    Normal,
    /// The triangle's normal.
    GeometricNormal,
    /// The unit direction to where the ray came from.
    Incoming,
    /// 1 on the front side, 0 on the back.
    FrontFacing,
    /// What is known of the ray, in all components.
    LightPath(LightPathValue),
}

/// What a vector stands for when spaces change.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quantity {
    /// A point.
    Point,
    /// A difference of points.
    Vector,
    /// A normal, made unit.
    Normal,
}

/// A step of a program.
#[derive(Clone, Debug, PartialEq)]
pub enum Step {
    /// A texture lookup, texel · scale + bias.
    Image {
        /// Number in the texture table.
        texture: u32,
        /// Texture coordinates.
        uv: Source,
        /// What lies beyond the image.
        wrap: [Wrap; 2],
        /// How texels are filtered.
        filter: Filter,
        /// Multiplies the texel.
        scale: [f32; 4],
        /// Added afterwards.
        bias: [f32; 4],
        /// Size of a unit of the coordinates, as transforms before this step scaled them.
        footprint: f32,
    },
    /// A primvar column of the geometry.
    Primvar {
        /// Column number.
        column: usize,
        /// Taken where the mesh has none.
        fallback: [f32; 4],
    },
    /// A 2×2 matrix by rows, and an offset.
    Transform2d {
        /// What is transformed.
        input: Source,
        /// Rows.
        matrix: [[f32; 2]; 2],
        /// Offset.
        offset: [f32; 2],
    },
    /// A 3×4 matrix by rows applied to a point; the fourth component stays.
    Transform3d {
        /// What is transformed.
        input: Source,
        /// Rows.
        rows: [[f32; 4]; 3],
    },
    /// From the hit instance's space to the world, or back.
    Transform {
        /// What is transformed.
        input: Source,
        /// Whether the result is in world space.
        to_world: bool,
        /// What it stands for.
        quantity: Quantity,
    },
    /// A world-space normal on the side of `wo` from a tangent-space one.
    NormalMap {
        /// The tangent-space normal in [−1, 1].
        input: Source,
        /// Factor on x and y.
        scale: f32,
        /// Column of the texture coordinates it lies along, else those of the program.
        uv: Option<usize>,
    },
    /// What is known of the hit.
    Hit(HitValue),
    /// The world vector to the next pixel along one of two directions in the surface.
    PositionStep {
        /// Which of the two.
        axis: u8,
    },
    /// How much a primvar changes over that step.
    PrimvarStep {
        /// Column number.
        column: usize,
        /// Which of the two directions.
        axis: u8,
    },
    /// The unit tangent along the first of a primvar's coordinates, world space; zero where there is none.
    UvTangent {
        /// Column number.
        column: usize,
    },
    /// Each component looked up in a curve.
    Curve {
        /// The argument.
        input: Source,
        /// The curve; programs of one material share it.
        curve: Arc<Curve>,
    },
    /// An operation that mixes components.
    Vector(VectorOperation, [Source; 2]),
    /// Arithmetic on each component.
    Arithmetic {
        /// What is computed.
        operation: Arithmetic,
        /// Its inputs.
        inputs: [Source; 3],
        /// Whether all four components of every input are the same: one serves for all.
        even: bool,
    },
    /// The first components of four sources.
    Combine([Source; 4]),
}

impl Step {
    /// What it reads.
    fn inputs(&mut self) -> Vec<&mut Source> {
        match self {
            Self::Image { uv: input, .. }
            | Self::Transform2d { input, .. }
            | Self::Transform3d { input, .. }
            | Self::Transform { input, .. }
            | Self::NormalMap { input, .. }
            | Self::Curve { input, .. } => vec![input],
            Self::Vector(_, inputs) => inputs.iter_mut().collect(),
            Self::Arithmetic { inputs, .. } => inputs.iter_mut().collect(),
            Self::Combine(inputs) => inputs.iter_mut().collect(),
            Self::Primvar { .. } | Self::Hit(_) | Self::PositionStep { .. } | Self::PrimvarStep { .. } | Self::UvTangent { .. } => {
                Vec::new()
            }
        }
    }
}

/// A parameter that the graph computes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Output {
    /// First place in the parameter block.
    pub offset: usize,
    /// Places: 1 or 3.
    pub width: usize,
    /// Its value.
    pub source: Source,
}

/// A material's graph.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Program {
    /// Steps in order.
    pub steps: Vec<Step>,
    /// Parameters computed.
    pub outputs: Vec<Output>,
    /// Step that gives the shading normal.
    pub normal: Option<u16>,
    /// Whether that normal is taken as it is; else it is turned so that mirror directions leave the surface.
    pub free_normal: bool,
    /// Step that gives the coat's normal.
    pub coat_normal: Option<u16>,
    /// Step that gives the direction of anisotropy.
    pub tangent: Option<u16>,
    /// Primvar column that tangents and footprints follow.
    pub uv: Option<usize>,
    /// Whether surface points keep the ray, for this program or for one that runs on the same points.
    pub light_path: bool,
}

impl Program {
    /// Whether there is nothing to run.
    pub fn is_empty(&self) -> bool {
        self.outputs.is_empty() && self.normal.is_none() && self.coat_normal.is_none() && self.tangent.is_none()
    }
    /// Whether any step asks for the ray.
    pub fn asks_for_ray(&self) -> bool {
        self.steps.iter().any(|step| matches!(step, Step::Hit(HitValue::LightPath(_))))
    }
    /// Leaves out the steps that nothing reads: closures of a material share its graph, and each wants a part of it.
    pub fn pruned(mut self) -> Self {
        let mut read = vec![false; self.steps.len()];
        for source in self.outputs.iter().map(|output| output.source) {
            source.register().into_iter().for_each(|number| read[usize::from(number)] = true);
        }
        for number in self.directions().into_iter().flatten() {
            read[usize::from(*number)] = true;
        }
        for (number, step) in self.steps.iter_mut().enumerate().rev() {
            if !read[number] {
                continue;
            }
            step.inputs().iter().filter_map(|input| input.register()).for_each(|input| read[usize::from(input)] = true);
        }
        let mut place = vec![0; read.len()];
        let mut kept = 0;
        for (place, read) in place.iter_mut().zip(&read) {
            *place = kept;
            kept += u16::from(*read);
        }
        let mut read = read.iter();
        self.steps.retain(|_| read.next() == Some(&true));
        self.steps.iter_mut().flat_map(Step::inputs).for_each(|input| input.renumber(&place));
        self.outputs.iter_mut().for_each(|output| output.source.renumber(&place));
        self.directions().into_iter().flatten().for_each(|number| *number = place[usize::from(*number)]);
        self.light_path = self.asks_for_ray();
        self
    }
    /// The steps that give directions.
    fn directions(&mut self) -> [Option<&mut u16>; 3] {
        [self.normal.as_mut(), self.coat_normal.as_mut(), self.tangent.as_mut()]
    }
}
