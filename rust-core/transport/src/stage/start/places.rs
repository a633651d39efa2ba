//! Ray generation without a camera: pixels that lie on surfaces, as textures do that light is baked into.
//!
//! A pixel says where on a triangle it is, so nothing needs to be traced to find it: what its path "meets" first is written down as a hit.

use crate::geometry::{NONE, SurfacePoint};
use crate::stage::find::covered::{BEFORE, BEHIND, covered_lanes};
use crate::stage::start::generate::TileArea;
use crate::state::nearest::NearestHits;
use crate::state::passed::PassedLanes;
use crate::state::path_core::PathCore;
use crate::state::paths::{PathLanes, Paths};
use crate::state::queue::measure_points::{MeasureLanes, MeasurePoints};
use crate::state::rays::RayLanes;
use crate::tables::Tables;
use crate::words::{flag, ray_mask};
use gonio_accel::Hits;
use gonio_camera::sampler::{CAPACITY, Runs, Sampler, dimension, morton_even};
use gonio_simd::{Column, F, Lanes, M, U, Vec3, padded};

/// Metres from which a path sees its surface.
const DISTANCE: f32 = 1.0;
/// The least cosine at which the camera sees a place: what faces away is seen as from its rim.
const LEAST_COSINE: f32 = 0.02;

/// Where a pixel lies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Place {
    /// Number of the compiled instance.
    pub instance: u32,
    /// Number of the triangle in its mesh.
    pub triangle: u32,
    /// Barycentric coordinates of corners 1 and 2 in the middle of the pixel.
    pub at: [f32; 2],
    /// How they change from pixel to pixel along a row, and along a column.
    pub steps: [[f32; 2]; 2],
}

/// From where places are seen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Viewpoint {
    /// From right above, along the shading normal.
    Above,
    /// From a point, rebased world space.
    Point([f32; 3]),
    /// From far off, in the direction of a unit vector.
    Direction([f32; 3]),
}

/// A picture of places, row by row from the top.
#[derive(Debug)]
pub struct PlaceTable {
    size: [u32; 2],
    instance: Column<u32>,
    triangle: Column<u32>,
    at: [Column; 2],
    along: [Column; 2],
    down: [Column; 2],
    viewpoint: Viewpoint,
    /// Whether light that leaves is looked at, and whether light that arrives is measured.
    looks: bool,
    measures: bool,
}

impl PlaceTable {
    /// `size` is width and height, of which `places` has a place each, or none. It is seen from a viewpoint (`looks`), or lit as meters are
    /// (`measures`), or both.
    pub fn new(size: [u32; 2], places: &[Option<Place>], viewpoint: Viewpoint, [looks, measures]: [bool; 2]) -> Self {
        let room = padded(places.len()) + gonio_simd::PADDING;
        let (mut instance, mut triangle) = (Column::new(room), Column::new(room));
        let (mut at, mut along, mut down) = (two(room), two(room), two(room));
        instance.fill(NONE);
        for (number, place) in places.iter().enumerate() {
            let Some(place) = place else { continue };
            (instance[number], triangle[number]) = (place.instance, place.triangle);
            for (columns, values) in [(&mut at, place.at), (&mut along, place.steps[0]), (&mut down, place.steps[1])] {
                columns.iter_mut().zip(values).for_each(|(column, value)| column[number] = value);
            }
        }
        Self { size, instance, triangle, at, along, down, viewpoint, looks, measures }
    }

    /// Whether light that leaves the places is looked at.
    pub fn looks(&self) -> bool {
        self.looks
    }
}

fn two(room: usize) -> [Column; 2] {
    [Column::new(room), Column::new(room)]
}

/// A register of places.
struct PlaceLanes<L: Lanes> {
    instance: U<L>,
    triangle: U<L>,
    uv: [F<L>; 2],
    /// Barycentric steps along a row and down a column.
    steps: [[F<L>; 2]; 2],
    slot: U<L>,
    inside: M<L>,
}

/// What starts at places.
pub(crate) struct Started<'a> {
    pub(crate) paths: &'a mut Paths,
    pub(crate) hits: &'a mut Hits,
    pub(crate) points: &'a mut MeasurePoints,
    /// 1 for places that another surface lies on.
    pub(crate) covered: &'a [u8],
}

/// The random numbers of a batch, and its pixels.
#[derive(Clone, Copy)]
pub(crate) struct PlaceBatch<'a> {
    pub(crate) sampler: &'a Sampler,
    pub(crate) area: TileArea,
    pub(crate) runs: &'a Runs,
}

/// Short rays through every place of a tile that a batch holds, from before it to behind it, and what they start from as hits; gives their number.
#[inline(always)]
pub(crate) fn look_at_places<L: Lanes>(
    l: L,
    tables: &Tables,
    table: &PlaceTable,
    batch: PlaceBatch<'_>,
    nearest: &mut NearestHits,
) -> usize {
    let NearestHits { hits, behind_rays, .. } = nearest;
    hits.resize(padded(CAPACITY) + gonio_simd::PADDING);
    behind_rays.mask.fill(ray_mask::SHADOW);
    let mut count = 0;
    for register in batch.runs.registers(L::COUNT) {
        let Some(PlaceLanes { instance, triangle, uv: [u, v], inside, .. }) = place_lanes(l, table, batch, register) else { continue };
        let point = tables.geometry.surface_point(l, &tables.geometry.hit_lanes(l, instance, triangle, u, v));
        let origin = point.geometric_normal.mul_add(point.error * BEFORE, point.position);
        let (t_min, t_max) = (l.f(0.0), point.error * (BEFORE + BEHIND));
        behind_rays.append(&RayLanes { origin, direction: -point.geometric_normal, t_min, t_max }, inside, count);
        instance.append(inside, &mut hits.instance, count);
        triangle.append(inside, &mut hits.primitive, count);
        count += inside.count();
    }
    count
}

/// Starts a path towards every place of a tile that a batch holds, with its hit, and queues the points that are measured there.
#[inline(always)]
pub(crate) fn start_places<L: Lanes>(l: L, tables: &Tables, table: &PlaceTable, batch: PlaceBatch<'_>, started: &mut Started<'_>) {
    (started.paths.count, started.points.count) = (0, 0);
    started.hits.resize(padded(CAPACITY) + gonio_simd::PADDING);
    let mut count = 0;
    for register in batch.runs.registers(L::COUNT) {
        let Some(place) = place_lanes(l, table, batch, register) else { continue };
        append(l, tables, table, &place, covered_lanes(l, started.covered, count, place.inside), started);
        count += place.inside.count();
    }
    let count = started.paths.count;
    started.hits.resize(count);
    started.paths.set_masks();
}

/// Random places in the pixels of a register, kept on their triangles, if it has any.
#[inline(always)]
fn place_lanes<L: Lanes>(l: L, table: &PlaceTable, batch: PlaceBatch<'_>, [slot, first_pixel, sample]: [u32; 3]) -> Option<PlaceLanes<L>> {
    let PlaceBatch { sampler, area, .. } = batch;
    let (slot, pixel) = (l.iota() + slot, l.iota() + first_pixel);
    let (x, y) = (morton_even(pixel) + area.min[0], morton_even(pixel >> 1) + area.min[1]);
    let inside = x.lt(area.max[0]) & y.lt(area.max[1]);
    if !inside.any() {
        return None;
    }
    let number = (y * table.size[0] + x).keep_if(inside);
    let instance = l.gather_integers(&table.instance, number);
    let inside = inside.and_not(instance.eq(NONE));
    if !inside.any() {
        return None;
    }
    let [x, y] = sampler.pair(l, sampler.index(pixel, l.u(sample)), dimension::PIXEL);
    let [at, along, down] = [pair(l, &table.at, number), pair(l, &table.along, number), pair(l, &table.down, number)];
    let (x, y) = (x - 0.5, y - 0.5);
    let u = x.mul_add(along[0], y.mul_add(down[0], at[0])).max(0.0).min(1.0);
    let v = x.mul_add(along[1], y.mul_add(down[1], at[1])).max(0.0).min(l.f(1.0) - u);
    let (instance, triangle) = (instance.keep_if(inside), l.gather_integers(&table.triangle, number));
    Some(PlaceLanes { instance, triangle, uv: [u, v], steps: [along, down], slot, inside })
}

#[inline(always)]
fn pair<L: Lanes>(l: L, columns: &[Column; 2], number: U<L>) -> [F<L>; 2] {
    [l.gather(&columns[0], number), l.gather(&columns[1], number)]
}

/// Writes paths and hits, and measured points where nothing lies on them.
#[inline(always)]
fn append<L: Lanes>(l: L, tables: &Tables, table: &PlaceTable, place: &PlaceLanes<L>, covered: M<L>, started: &mut Started<'_>) {
    let PlaceLanes { instance, triangle, uv: [u, v], slot, inside, .. } = *place;
    let hit = tables.geometry.hit_lanes(l, instance, triangle, u, v);
    let point = tables.geometry.surface_point(l, &hit);
    // What textures lie in is not known.
    let flags = covered.select(l.u(flag::COVERED), l.u(0)) | (flag::CAMERA | flag::DELTA);
    let core = PathCore { width: width(place, &point), ..PathCore::of_world(l, tables, slot, flags) };
    if table.measures {
        let measured = MeasureLanes {
            position: point.position,
            error: point.error,
            geometric_normal: point.geometric_normal,
            shading_normal: point.shading_normal,
            receiver: tables.links.receiver(l, instance),
            core,
        };
        started.points.append(&measured, inside.and_not(covered));
    }
    if !table.looks {
        return;
    }
    let above = towards_eye(l, table.viewpoint, &point);
    let origin = above.mul_add(l.f(DISTANCE), point.position);
    let ray = RayLanes { origin, direction: -above, t_min: l.f(0.0), t_max: l.f(f32::MAX) };
    let count = started.paths.count;
    instance.append(inside, &mut started.hits.instance, count);
    triangle.append(inside, &mut started.hits.primitive, count);
    u.append(inside, &mut started.hits.u, count);
    v.append(inside, &mut started.hits.v, count);
    l.f(DISTANCE).append(inside, &mut started.hits.t, count);
    // Only the places count: the way to them from above is passed already, so that no haze dims them.
    let passed = PassedLanes { t: l.f(DISTANCE), instance: l.u(NONE), primitive: l.u(NONE), barycentric: [l.f(0.0); 2] };
    let passed = core.media.is_filled().any().then_some(passed);
    started.paths.append(&PathLanes::start(ray, core).having_passed(passed), inside);
}

/// Unit vectors from places to where they are seen from.
#[inline(always)]
fn towards_eye<L: Lanes>(l: L, viewpoint: Viewpoint, point: &SurfacePoint<L>) -> Vec3<L> {
    let normal = point.shading_normal;
    let towards = match viewpoint {
        Viewpoint::Above => return normal,
        Viewpoint::Point(eye) => (Vec3::splat(l, eye) - point.position).normalize_or(normal),
        Viewpoint::Direction(direction) => Vec3::splat(l, direction),
    };
    turned(turned(towards, normal), point.geometric_normal)
}

/// A direction turned towards a normal until it is seen from there.
#[inline(always)]
fn turned<L: Lanes>(towards: Vec3<L>, normal: Vec3<L>) -> Vec3<L> {
    let lacking = (towards.x.lanes().f(LEAST_COSINE) - towards.dot(normal)).max(0.0);
    normal.mul_add(lacking, towards).normalize_or(normal)
}

/// Metres of a pixel's side on the surface: the root of its area.
#[inline(always)]
fn width<L: Lanes>(place: &PlaceLanes<L>, point: &SurfacePoint<L>) -> F<L> {
    let [along, down] = place.steps;
    let share = (along[0] * down[1] - along[1] * down[0]).abs();
    (share * point.double_area).sqrt()
}
