//! The closures of a chunk of hits of one material, one after the other.

use crate::graph::{CHUNK, Program};
use crate::kernels;
use crate::stage::find::surface::{ChunkRays, ChunkSource};
use crate::state::chunk::ChunkColumns;
use crate::state::mix_weights::{ClosureWeights, MixWeights};
use crate::state::rays::Rays;
use crate::state::wavelengths::SlotWavelengths;
use crate::tables::Tables;
use crate::tables::material::{Mix, Shading};
use gonio_accel::TransparentHit;
use gonio_simd::Lanes;

/// Hits of one material, at most a chunk, and the rays that met them.
#[derive(Clone, Copy, Debug)]
pub(crate) struct MaterialHits<'a> {
    pub(crate) material: u32,
    pub(crate) hits: &'a [TransparentHit],
    pub(crate) rays: &'a Rays,
    /// Wavelengths of slots, where light has any, and the rays' slots.
    pub(crate) wavelengths: Option<(&'a SlotWavelengths, &'a [u32])>,
}

/// One closure of them.
#[derive(Debug)]
pub(crate) struct ClosureHits<'a> {
    /// Its number among the surfaces.
    pub(crate) surface: usize,
    /// Its weights, where the material is a mix.
    pub(crate) weights: Option<ClosureWeights<'a>>,
    pub(crate) hits: &'a [TransparentHit],
    source: &'a ChunkSource<'a>,
    pub(crate) columns: &'a mut ChunkColumns,
}

impl ClosureHits<'_> {
    /// Fills the columns: surface points, and what a program computes there.
    #[inline(always)]
    pub(crate) fn run<L: Lanes>(&mut self, l: L, tables: &Tables, program: &Program) {
        kernels::run_program(l, tables, program, self.hits, self.source, self.columns);
    }
}

/// Looks at each closure of a chunk of hits; `program` names what computes the weights of a mix.
#[inline(always)]
pub(crate) fn each_closure<L: Lanes>(
    l: L,
    tables: &Tables,
    chunk: MaterialHits<'_>,
    program: impl Fn(&Mix) -> &Program,
    (weights, columns): (&mut MixWeights, &mut ChunkColumns),
    mut each: impl FnMut(ClosureHits<'_>),
) {
    let MaterialHits { material, hits, rays, wavelengths } = chunk;
    let (wavelengths, slots) = wavelengths.unzip();
    columns.wavelengths.fill(wavelengths, hits.iter().map(|hit| slots.map_or(0, |slots| slots[hit.ray as usize])));
    let mut order = [0; CHUNK];
    order.iter_mut().zip(0..hits.len() as u32).for_each(|(place, number)| *place = number);
    let source = &ChunkSource { order: &order, count: hits.len(), rays: ChunkRays::Rays(rays) };
    match tables.materials.shading(material) {
        Shading::Surface(surface) => each(ClosureHits { surface: surface as usize, weights: None, hits, source, columns }),
        Shading::Mix(mix) => {
            let mix = &tables.materials.mixes[mix as usize];
            kernels::run_program(l, tables, program(mix), hits, source, columns);
            weights.keep(mix, columns);
            for closure in 0..mix.count {
                let surface = mix.first as usize + closure;
                each(ClosureHits { surface, weights: Some(weights.of(closure)), hits, source, columns });
            }
        }
    }
}
