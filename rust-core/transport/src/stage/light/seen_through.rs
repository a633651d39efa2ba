//! What surfaces let pass straight on at given points: how much is seen through panes, cut-outs and veils.

use crate::graph::CHUNK;
use crate::stage::find::closures::{MaterialHits, each_closure};
use crate::stage::find::sort::for_materials;
use crate::stage::light::shadow::add_transmittance;
use crate::stage::light::textured_emission::EmissionPoint;
use crate::state::chunk::ChunkColumns;
use crate::state::mix_weights::MixWeights;
use crate::state::rays::Rays;
use crate::tables::Tables;
use gonio_accel::TransparentHit;
use gonio_simd::{Execution, One, SpectrumColumns, dispatch};

/// Scratch of [`seen_through`].
#[derive(Debug)]
pub struct SeenThroughRoom {
    rays: Rays,
    weights: MixWeights,
    passed: SpectrumColumns,
    columns: ChunkColumns,
}

impl Default for SeenThroughRoom {
    fn default() -> Self {
        Self {
            rays: Rays::new(CHUNK, 0),
            weights: MixWeights::default(),
            passed: SpectrumColumns::new(CHUNK),
            columns: ChunkColumns::default(),
        }
    }
}

/// The share of light that points of meshes let pass straight on towards who sees them, the mean of red, green and blue; a share for each point.
pub fn seen_through(tables: &Tables, execution: Execution, points: &[EmissionPoint], room: &mut SeenThroughRoom) -> Vec<f32> {
    let SeenThroughRoom { rays, weights, passed, columns } = room;
    let mut shares = vec![0.0; points.len()];
    for (points, shares) in points.chunks(CHUNK).zip(shares.chunks_mut(CHUNK)) {
        let mut hits = Vec::with_capacity(points.len());
        for (number, point) in points.iter().enumerate() {
            (0..3).for_each(|axis| rays.direction[axis][number] = -point.toward[axis]);
            let EmissionPoint { instance, primitive, barycentric: [u, v], .. } = *point;
            hits.push(TransparentHit { ray: number as u32, instance, primitive, u, v, t: 1.0 });
        }
        for_materials(tables, &mut hits, |material, chunk| {
            passed.clear();
            let of_one = MaterialHits { material, hits: chunk, rays, wavelengths: None };
            dispatch!(execution, l => each_closure(
                l,
                tables,
                of_one,
                |mix| &mix.program,
                (weights, columns),
                #[inline(always)]
                |closure| add_transmittance(l, tables, closure, passed),
            ));
            for (i, hit) in chunk.iter().enumerate() {
                let rgb: [f32; 3] = passed.load(One, i).to_rgb().into();
                shares[hit.ray as usize] = rgb.iter().sum::<f32>() / 3.0;
            }
        });
    }
    shares
}
