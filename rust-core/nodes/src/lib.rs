//! Shading nodes: one [table](Operation) of what they compute, [graphs](Graph) of them, and programs that run graphs on lanes.
//!
//! A graph becomes [`Code`]: steps on single components, constants folded and equal steps shared. A [`Program`] is the part of it that some
//! outputs need, with columns in the place of variables. Each step runs over a chunk of hits by a kernel of its own, which is compiled apart.
//! What hits, rays and images give is the host's affair: light transport, or [`compute`] with arrays.

mod arithmetic;
mod blackbody;
mod brick;
mod code;
mod columns;
mod compute;
mod curve;
mod finite;
mod fold;
mod fractal;
mod gabor;
mod graph;
mod hair;
pub mod hash;
mod magic;
mod mx_noise;
mod mx_worley;
mod noise;
mod periodic;
pub mod perlin;
mod program;
mod radial_tiling;
mod table;
#[cfg(test)]
mod tests;
mod vector;
pub mod voronoi;
mod wave;
mod wavelength;
mod white_noise;
mod words;

pub use blackbody::Blackbody;
pub use brick::BrickTexture;
pub use code::{Code, Hit, Kernel, Operand, Step, Value, constant};
pub use columns::Io;
pub use compute::compute;
pub use curve::Curve;
pub use fold::fold;
pub use fractal::NoiseKind;
pub use gabor::GaborTexture;
pub use graph::{Channel, Graph, Input, Node, NodeId};
pub use magic::MagicTexture;
pub use mx_noise::{MxFractal, MxNoise};
pub use mx_worley::{MxCellNoise, MxWorley, MxWorleyStyle};
pub use noise::NoiseTexture;
pub use program::{CHUNK, Program, Registers, Source};
pub use radial_tiling::{RadialTiling, TilingPart};
pub use table::{KernelKind, Operation, Rest, Signature};
pub use vector::normalize;
pub use wave::{WaveProfile, WaveShape, WaveTexture};
pub use wavelength::{RgbWhite, Wavelength};
pub use white_noise::WhiteNoise;
pub use words::{LightPathValue, Quantity, Space, TextureFilter, TextureId, WrapMode};
