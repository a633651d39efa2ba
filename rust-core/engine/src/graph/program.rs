//! A material's graph laid out for running: steps in order, each with a four-component register.

use crate::texture::{Filter, Wrap};

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

/// Arithmetic on four components at once.
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
    /// a to the power b, zero for negative a.
    Power,
    /// b − a.
    Invert,
    /// a held between b and c.
    Clamp,
    /// The luminance of a.
    Luminance,
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
    /// A world-space normal from a tangent-space one.
    NormalMap {
        /// The tangent-space normal in [−1, 1].
        input: Source,
        /// Factor on x and y.
        scale: f32,
    },
    /// Arithmetic.
    Arithmetic(Arithmetic, [Source; 3]),
    /// The first components of four sources.
    Combine([Source; 4]),
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
}

impl Program {
    /// Whether there is nothing to run.
    pub fn is_empty(&self) -> bool {
        self.outputs.is_empty() && self.normal.is_none() && self.coat_normal.is_none() && self.tangent.is_none()
    }
}
