//! Steps that ask the surface point, the ray or a table of the scene: images, primvars, normals, spaces.

use super::{
    SurfaceColumns,
    nearby::{Occlusion, occlusion, rounded_normal},
    nearby_rays::{Around, NearbyRays},
    normals::normal_map,
    shading::{Place, instance_transform, point_value},
};
use crate::geometry::GeometryTable;
use gonio_image::texture::{Filter, TextureTable, TileReader, Wrap};
use gonio_nodes::{Io, Operation, Quantity};
use gonio_simd::{F, Lanes, M, Vec2};

/// Such a step, with names resolved.
#[derive(Clone, Debug, PartialEq)]
pub enum HitStep {
    /// A texture lookup, texel · scale + bias.
    Image {
        /// Number in the texture table.
        texture: u32,
        /// What lies beyond the image.
        wrap: [Wrap; 2],
        /// How texels are filtered.
        filter: Filter,
        /// Multiplies the texel.
        scale: [f32; 4],
        /// Added afterwards.
        bias: [f32; 4],
        /// Where a set of tiles has none.
        fallback: [f32; 4],
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
    /// How much a primvar changes over the step to the next pixel.
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
    /// A world-space normal on the side of `wo` from a tangent-space one.
    NormalMap {
        /// Factor on x and y.
        scale: f32,
        /// Column of the texture coordinates it lies along, else those of the program.
        uv: Option<usize>,
    },
    /// From the hit instance's space to the world, or back.
    Transform {
        /// Whether the result is in world space.
        to_world: bool,
        /// What it stands for.
        quantity: Quantity,
    },
    /// The share of rays that meet nothing nearby.
    Occlusion(Occlusion),
    /// The mean normal nearby.
    RoundedNormal {
        /// Rays a hit.
        samples: u32,
    },
    /// What is known of the surface point and the ray, by its row of the table.
    Point(Operation),
}

impl HitStep {
    /// Whether it asks what is known of the ray.
    pub fn asks_for_ray(&self) -> bool {
        matches!(self, Self::Point(Operation::LightPath(_)) | Self::RoundedNormal { .. })
    }
}

/// The tables and the points that steps ask, from an entry of the chunk on.
#[derive(Clone, Copy, Debug)]
pub(super) struct Points<'a> {
    pub(super) geometry: &'a GeometryTable,
    pub(super) textures: &'a TextureTable,
    pub(super) columns: &'a SurfaceColumns,
    pub(super) first: usize,
}

impl<'a> Points<'a> {
    /// One register of hits.
    #[inline(always)]
    fn place<L: Lanes>(&self, l: L, at: usize) -> Place<'a, L> {
        let (columns, at) = (self.columns, self.first + at);
        Place { geometry: self.geometry, hit: columns.hit(l, self.geometry, at), points: columns, at }
    }
}

/// Runs a step for the entries of `io`; kinds of steps are compiled apart.
#[inline(always)]
pub(super) fn run_hit_step<L: Lanes>(
    l: L,
    step: &HitStep,
    points: &Points<'_>,
    (around, near, tiles): (&Around<'_>, &mut Option<Box<NearbyRays>>, &mut TileReader),
    io: &mut Io<'_>,
) {
    match step {
        HitStep::Image { texture, .. } if points.textures.is_paged(*texture) => image_in_tiles(l, step, points, tiles, io),
        HitStep::Image { .. } => image(l, step, points, io),
        HitStep::Primvar { column, fallback } => primvar(l, *column, fallback, points, io),
        HitStep::PrimvarStep { .. } | HitStep::UvTangent { .. } | HitStep::NormalMap { .. } | HitStep::Transform { .. } => {
            on_surface(l, step, points, io);
        }
        HitStep::Occlusion(step) => occlusion(l, step, points, around, near.get_or_insert_default(), io),
        HitStep::RoundedNormal { samples } => rounded_normal(l, *samples, points, around, near.get_or_insert_default(), io),
        HitStep::Point(operation) => point(l, operation, points, io),
    }
}

#[inline(never)]
fn image<L: Lanes>(l: L, step: &HitStep, points: &Points<'_>, io: &mut Io<'_>) {
    l.vectorize(
        #[inline(always)]
        || {
            let HitStep::Image { texture, wrap, filter, scale, bias, fallback, footprint } = step else { return };
            let has_gaps = points.textures.is_set(*texture);
            for at in (0..io.count).step_by(L::COUNT) {
                let [x, y] = io.load(l, at);
                let width = l.load(&points.columns.uv_width, points.first + at) * *footprint;
                let texel = points.textures.sample(l, *texture, Vec2 { x, y }, width, *wrap, *filter);
                let value = scaled(texel, scale, bias);
                let covered = if has_gaps { points.textures.covers(l, *texture, Vec2 { x, y }) } else { l.m(true) };
                io.store(at, where_covered(covered, value, fallback));
            }
        },
    );
}

/// A texel times a scale, plus a bias.
#[inline(always)]
fn scaled<L: Lanes>(texel: [F<L>; 4], scale: &[f32; 4], bias: &[f32; 4]) -> [F<L>; 4] {
    let mut value = texel;
    for (i, component) in value.iter_mut().enumerate() {
        *component = texel[i].mul_add(scale[i], bias[i]);
    }
    value
}

/// What was looked up, the value of missing images where a set has no tile.
#[inline(always)]
fn where_covered<L: Lanes>(covered: M<L>, mut value: [F<L>; 4], fallback: &[f32; 4]) -> [F<L>; 4] {
    if !covered.all() {
        for (component, missing) in value.iter_mut().zip(fallback) {
            *component = covered.select(*component, component.lanes().f(*missing));
        }
    }
    value
}

/// [`image`] for a texture of which not all is in memory.
#[inline(never)]
fn image_in_tiles<L: Lanes>(l: L, step: &HitStep, points: &Points<'_>, tiles: &mut TileReader, io: &mut Io<'_>) {
    l.vectorize(
        #[inline(always)]
        || {
            let HitStep::Image { texture, wrap, filter, scale, bias, fallback, footprint } = step else { return };
            let has_gaps = points.textures.is_set(*texture);
            for at in (0..io.count).step_by(L::COUNT) {
                let [x, y] = io.load(l, at);
                let width = l.load(&points.columns.uv_width, points.first + at) * *footprint;
                let reader = (&mut *tiles, io.count - at);
                let texel = points.textures.sample_tiles(l, reader, *texture, Vec2 { x, y }, width, (*wrap, *filter));
                let value = scaled(texel, scale, bias);
                let covered = if has_gaps { points.textures.covers(l, *texture, Vec2 { x, y }) } else { l.m(true) };
                io.store(at, where_covered(covered, value, fallback));
            }
        },
    );
}

#[inline(never)]
fn primvar<L: Lanes>(l: L, column: usize, fallback: &[f32; 4], points: &Points<'_>, io: &mut Io<'_>) {
    l.vectorize(
        #[inline(always)]
        || {
            for at in (0..io.count).step_by(L::COUNT) {
                let (value, present) = points.geometry.primvar(l, &points.place(l, at).hit, column);
                let mut chosen = value;
                for (i, component) in chosen.iter_mut().enumerate() {
                    *component = present.select(value[i], l.f(fallback[i]));
                }
                io.store(at, chosen);
            }
        },
    );
}

#[inline(never)]
fn on_surface<L: Lanes>(l: L, step: &HitStep, points: &Points<'_>, io: &mut Io<'_>) {
    l.vectorize(
        #[inline(always)]
        || {
            for at in (0..io.count).step_by(L::COUNT) {
                let place = points.place(l, at);
                let value: [F<L>; 4] = match step {
                    HitStep::PrimvarStep { column, axis } => place.primvar_step(l, *column, *axis),
                    HitStep::UvTangent { column } => place.uv_tangent(l, *column),
                    HitStep::NormalMap { scale, uv } => normal_map(l, &place, io.load(l, at), *scale, *uv),
                    HitStep::Transform { to_world, quantity } => instance_transform(l, &place, io.load(l, at), *to_world, *quantity),
                    _ => return,
                };
                io.store(at, value);
            }
        },
    );
}

#[inline(never)]
fn point<L: Lanes>(l: L, operation: &Operation, points: &Points<'_>, io: &mut Io<'_>) {
    l.vectorize(
        #[inline(always)]
        || {
            for at in (0..io.count).step_by(L::COUNT) {
                io.store(at, point_value(l, points.columns, points.first + at, operation));
            }
        },
    );
}
