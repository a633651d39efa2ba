//! How much triangles glow whose emission a shading program knows: means over points of each, for light sampling.

use super::cancel::check;
use crate::{
    accel::Tlas,
    error::{Error, Result},
    geometry::GeometryTable,
    light::{LightTable, LightTexture},
    texture::TextureTable,
    transport::{Bodies, EmissionPoint, EmissionRoom, LightGroups, Links, MaterialTable, MatteNames, Tables, emitted},
};
use gonio_simd::Execution;
use rayon::prelude::*;
use std::sync::{Arc, atomic::AtomicBool};

/// Points a mesh is asked at, within [`POINTS`] a triangle.
const MESH_POINTS: usize = 8192;
const POINTS: std::ops::RangeInclusive<usize> = 4..=128;
/// Points that one task asks.
const TASK: usize = 4096;
/// A triangle counts at least this share of its mesh's mean, lest what lies between the points is found by chance alone.
const LEAST_SHARE: f32 = 0.02;

/// Geometry, materials and images before there are lights: enough to run shading programs.
pub(super) struct Probe<'a> {
    pub(super) tables: Tables,
    cancel: &'a AtomicBool,
}

/// What a triangle emits in the mean: luminance, of magnitudes where it takes light away, and whether both sides do.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Mean {
    pub(super) luminance: f32,
    pub(super) two_sided: bool,
}

impl<'a> Probe<'a> {
    pub(super) fn new(
        (geometry, materials, textures): (GeometryTable, MaterialTable, TextureTable),
        origin: [f64; 3],
        cancel: &'a AtomicBool,
    ) -> Result<Self> {
        let tables = Tables {
            bvh: Tlas::build(Vec::new(), &[], cancel).map_err(|_| Error::Cancelled)?,
            first_light_instance: 0,
            geometry,
            neighbours: None,
            materials,
            textures,
            lights: Arc::new(LightTable::build(&[], &[] as &[LightTexture], &[])),
            instance_light: Vec::new(),
            triangle_lights: Vec::new(),
            light_instances: (0, Vec::new()),
            object_lights: Vec::new(),
            groups: LightGroups::default(),
            links: Links::default(),
            matte_names: MatteNames::default(),
            any_transparent: false,
            any_absorbing: false,
            bodies: Bodies::default(),
            emission_in_media: Vec::new(),
            wavelengths: None,
            origin,
        };
        Ok(Self { tables, cancel })
    }

    /// What it was made of.
    pub(super) fn into_parts(self) -> (GeometryTable, MaterialTable, TextureTable) {
        (self.tables.geometry, self.tables.materials, self.tables.textures)
    }

    /// The means of an instance's triangles, whose normals are given (any length); `None` for those that emit evenly or not at all.
    pub(super) fn means(&self, instance: u32, normals: &[[f32; 3]]) -> Result<Vec<Option<Mean>>> {
        let Tables { geometry, materials, .. } = &self.tables;
        let asked = |triangle: &u32| materials.emits_by_program(geometry.material(instance, *triangle));
        let asked: Vec<u32> = (0..normals.len() as u32).filter(asked).collect();
        let points = (MESH_POINTS / asked.len().max(1)).clamp(*POINTS.start(), *POINTS.end());
        let sides = |room: &mut EmissionRoom, triangles: &[u32]| {
            check(self.cancel)?;
            Ok(self.sides(instance, triangles, normals, points, room))
        };
        let task = (TASK / (2 * points)).max(1);
        let found: Vec<Vec<[f32; 2]>> = asked.par_chunks(task).map_init(EmissionRoom::default, sides).collect::<Result<_>>()?;
        let least = LEAST_SHARE * found.iter().flatten().map(|[front, back]| front + back).sum::<f32>() / asked.len().max(1) as f32;
        let mut means = vec![None; normals.len()];
        for (triangle, [front, back]) in asked.into_iter().zip(found.into_iter().flatten()) {
            let luminance = if back > 0.0 { 0.5 * (front + back) } else { front };
            means[triangle as usize] = Some(Mean { luminance: luminance.max(least), two_sided: back > 0.0 || front <= 0.0 });
        }
        Ok(means)
    }

    /// Mean luminances of both sides of some triangles, first of those that the normals point away from.
    fn sides(&self, instance: u32, triangles: &[u32], normals: &[[f32; 3]], count: usize, room: &mut EmissionRoom) -> Vec<[f32; 2]> {
        let of_side = |triangle: u32, side: f32| {
            let normal = normals[triangle as usize].map(|x| x * side);
            (0..count).map(move |number| point(instance, triangle, normal, number))
        };
        let points: Vec<EmissionPoint> = triangles.iter().flat_map(|t| of_side(*t, 1.0).chain(of_side(*t, -1.0))).collect();
        let mut values = vec![[0.0; 3]; points.len()];
        emitted(&self.tables, Execution::detect(), &points, room, &mut values);
        let luminance = |value: &[f32; 3]| crate::colour::luminance(value.map(|x| f64::from(x).abs()));
        let mean = |values: &[[f32; 3]]| (values.iter().map(luminance).filter(|y| y.is_finite()).sum::<f64>() / count as f64) as f32;
        values.chunks(2 * count).map(|both| [mean(&both[..count]), mean(&both[count..])]).collect()
    }
}

/// Points spread evenly over a triangle (Martin Roberts' R sequence in four dimensions), seen from directions over the normal.
fn point(instance: u32, primitive: u32, normal: [f32; 3], number: usize) -> EmissionPoint {
    let [a, b, c, d] = [0.856_674_9, 0.733_891_86, 0.628_706_7, 0.538_597_3].map(|step: f32| (0.5 + step * number as f32).fract());
    let barycentric = if a + b > 1.0 { [1.0 - a, 1.0 - b] } else { [a, b] };
    // A point of the unit sphere around the normal's tip lies in a direction by the cosine's law.
    let length = normal.iter().map(|x| x * x).sum::<f32>().sqrt().max(f32::MIN_POSITIVE);
    let (z, (sine, cosine)) = (2.0 * c - 1.0, (std::f32::consts::TAU * d).sin_cos());
    let across = (1.0 - z * z).max(0.0).sqrt();
    let tip = [across * cosine, across * sine, z];
    let toward: [f32; 3] = std::array::from_fn(|k| normal[k] / length + 0.999 * tip[k]);
    let inverse = 1.0 / toward.iter().map(|x| x * x).sum::<f32>().sqrt();
    EmissionPoint { instance, primitive, barycentric, toward: toward.map(|x| x * inverse) }
}
