//! What shading programs compute at places within meshes: densities and heats of media.

use crate::graph::CHUNK;
use crate::kernels;
use crate::state::chunk::ChunkColumns;
use crate::tables::Tables;
use crate::tables::material::parameter_values;
use gonio_bsdf::parameter::EMISSION_COLOR;
use gonio_simd::{Execution, Lanes, dispatch};

/// The emission that the program of a surface gives at places in rebased world space, R, G, B, as if they lay on an instance's first triangle and faced
/// up. `values` has a place for each.
pub fn emission_at(tables: &Tables, execution: Execution, surface: usize, instance: u32, places: &[[f32; 3]], values: &mut [[f32; 3]]) {
    let mut columns = ChunkColumns::default();
    for (places, values) in places.chunks(CHUNK).zip(values.chunks_mut(CHUNK)) {
        set_places(tables, instance, places, &mut columns);
        dispatch!(execution, l => compute(l, tables, surface, &mut columns, values));
    }
}

fn set_places(tables: &Tables, instance: u32, places: &[[f32; 3]], columns: &mut ChunkColumns) {
    let surface = &mut columns.surface;
    surface.origin = tables.origin.map(|x| x as f32);
    surface.instance.fill(instance);
    surface.side.fill(1.0);
    for up in
        [&mut surface.geometric_normal, &mut surface.shading_normal, &mut surface.smooth_normal, &mut surface.coat_normal, &mut surface.wo]
    {
        up[2].fill(1.0);
    }
    for axis in 0..3 {
        surface.position[axis].iter_mut().zip(places).for_each(|(column, place)| *column = place[axis]);
    }
}

#[inline(always)]
fn compute<L: Lanes>(l: L, tables: &Tables, number: usize, columns: &mut ChunkColumns, values: &mut [[f32; 3]]) {
    let material = &tables.materials.surfaces[number];
    let ChunkColumns { surface, scratch, outputs, .. } = columns;
    if !material.program.is_empty() {
        kernels::evaluate(l, tables, &material.program, surface, values.len(), scratch, outputs);
    }
    let found = parameter_values(material, outputs);
    for (first, values) in (0..values.len()).step_by(L::COUNT).zip(values.chunks_mut(L::COUNT)) {
        let [r, g, b] = [0, 1, 2].map(
            #[inline(always)]
            |part| found.get(l, EMISSION_COLOR + part, first).to_array(),
        );
        values.iter_mut().enumerate().for_each(|(lane, value)| *value = [r[lane], g[lane], b[lane]]);
    }
}
