//! A chunk of hits of one material: its columns, and what all its registers share.

use crate::graph::{CHUNK, GraphScratch, OutputColumns, Program, SurfaceColumns};
use crate::state::paths::Paths;
use crate::state::sample::SampleContext;
use crate::state::wavelengths::ChunkWavelengths;
use crate::tables::Tables;
use crate::tables::material::ChunkOutputs;
use crate::tables::transport::Transport;
use gonio_accel::Hits;
use gonio_simd::{Lanes, M, U};

/// Surface points of a chunk, and what programs compute there.
#[derive(Debug, Default)]
pub(crate) struct ChunkColumns {
    pub(crate) surface: SurfaceColumns,
    pub(crate) scratch: GraphScratch,
    /// What the material's program computed.
    pub(crate) outputs: OutputColumns,
    /// What the program of shader passes computed.
    pub(crate) shader_outputs: OutputColumns,
    /// Wavelengths of the hits' paths.
    pub(crate) wavelengths: ChunkWavelengths,
}

impl ChunkColumns {
    /// What its parameters are read from.
    pub(crate) fn outputs(&self) -> ChunkOutputs<'_> {
        (&self.outputs, self.wavelengths.column())
    }
}

/// What shading reads of a chunk: the scene, the settings, the sample, the hits and the paths that made them.
#[derive(Clone, Debug)]
pub(crate) struct ChunkContext<'a, L> {
    pub(crate) l: L,
    pub(crate) tables: &'a Tables,
    pub(crate) transport: &'a Transport,
    pub(crate) sample: &'a SampleContext<'a>,
    /// What computed the chunk's shader passes, where any are wanted.
    pub(crate) shader: Option<&'a Program>,
    /// Hits of the chunk.
    pub(crate) count: usize,
    /// By hit, the number of its path; padded to whole registers.
    pub(crate) order: &'a [u32],
    pub(crate) paths: &'a Paths,
    /// By path.
    pub(crate) hits: &'a Hits,
    /// By hit of the chunk.
    pub(crate) columns: &'a ChunkColumns,
    /// What a way straight through these surfaces counts: nothing where they only bound what fills their mesh.
    pub(crate) straight: u32,
}

impl<L: Lanes> ChunkContext<'_, L> {
    /// Whether paths may go straight through one more of these surfaces.
    #[inline(always)]
    pub(crate) fn allows_straight(&self, counts: U<L>) -> M<L> {
        if self.straight == 0 { self.l.m(true) } else { self.transport.limits.allow_straight(counts) }
    }
}

const _: () = assert!(CHUNK.is_multiple_of(gonio_simd::PADDING));
