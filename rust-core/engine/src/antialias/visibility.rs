//! The visibility map: which triangles the camera sees at several times the picture's resolution, and where those of one pixel part.
//!
//! Where a pinhole looks at triangles at rest it is rasterised, as in the paper (`raster.rs`). All else is asked by rays: pixels that may show a
//! light's shape, curves, points or what moves, tiles of very many triangles, and other lenses. There a pixel's rays are a packet of the traversal,
//! which meet nearly the same nodes.

use super::{
    raster::{Front, Grid, draw},
    seams::parts,
    triangles::Triangles,
    view::TileView,
};
use crate::{
    accel::NONE,
    camera::sampler::{BATCH, TILE},
    geometry::GeometryTable,
    transport::{Start, Tables, Tracer, Workspace},
};
use gonio_simd::{Lanes, dispatch};

/// Cosine between normals from which on surfaces count as one.
pub(super) const LEAST_COSINE: f32 = 0.9;
/// Share of the distance by which surfaces of different objects may lie before or behind one another, and those of one out of the other's plane.
pub(super) const MOST_DEPTH: f32 = 0.05;

/// For fewer pixels of a tile rays are faster than drawing it.
const FEWEST_PIXELS: usize = 128;

/// What the rays of some pixels have met.
#[derive(Debug, Default)]
pub(super) struct VisibilityMap {
    places: [Vec<f32>; 2],
    slots: Vec<u32>,
    met: Met,
    grid: Grid,
    triangles: Triangles,
    front: Front,
    /// Whether each pixel of the tile is asked by rays, row after row.
    by_rays: Vec<bool>,
}

/// The tile that is mapped: its first pixel and its size, and rays along a pixel's side.
#[derive(Clone, Copy, Debug)]
pub(super) struct Mapped {
    pub(super) min: [u32; 2],
    pub(super) size: [usize; 2],
    pub(super) side: u32,
}

/// Hits by slot, and the surfaces at those of pixels that show several triangles.
#[derive(Debug, Default)]
struct Met {
    instance: Vec<u32>,
    primitive: Vec<u32>,
    t: Vec<f32>,
    barycentric: [Vec<f32>; 2],
    /// Slots whose surfaces are looked at, pixel after pixel.
    chosen: Vec<u32>,
    normal: [Vec<f32>; 3],
    position: [Vec<f32>; 3],
}

impl VisibilityMap {
    /// Maps some pixels of a tile, and tells `seam` those that show surfaces which part.
    pub(super) fn look(
        &mut self,
        tracer: &Tracer<'_>,
        tile: Mapped,
        pixels: &[[usize; 2]],
        ws: &mut Workspace,
        mut seam: impl FnMut([usize; 2]),
    ) {
        if pixels.is_empty() {
            return;
        }
        let mut asked = Vec::new();
        let view = if pixels.len() < FEWEST_PIXELS { None } else { self.rasterise(tracer, tile) };
        match &view {
            Some(view) => dispatch!(tracer.transport.execution, l => self.tell_seams(l, view, pixels, &mut seam, &mut asked)),
            None => asked.extend_from_slice(pixels),
        }
        let rays = (tile.side * tile.side) as usize;
        for pixels in asked.chunks(BATCH / rays) {
            self.place(tile.min, pixels, tile.side);
            tracer.first_hits_at([&self.places[0], &self.places[1]], &self.slots, ws);
            self.met.take(pixels.len() * rays, ws);
            self.part(tracer, pixels, rays, &mut seam);
        }
    }

    /// Draws the tile's triangles, and marks the pixels that rays are to be asked about; `None` if they are for all.
    fn rasterise(&mut self, tracer: &Tracer<'_>, tile: Mapped) -> Option<TileView> {
        let Start::Camera(camera, _) = tracer.start else { return None };
        let view = TileView::new(camera, tile.min, tile.size)?;
        let Self { grid, triangles, front, by_rays, .. } = self;
        by_rays.clear();
        by_rays.resize(TILE * TILE, false);
        let few = triangles.list(&view, tracer.tables, |[[left, right], [top, bottom]]| {
            (top..=bottom).for_each(|y| by_rays[y * TILE + left..=y * TILE + right].fill(true));
        });
        if !few {
            return None;
        }
        grid.prepare(tile.side);
        front.clear(grid.count(), view.clipping[1]);
        dispatch!(tracer.transport.execution, l => draw(l, &view, grid, triangles, front));
        Some(view)
    }

    /// Tells the pixels of the rasterised map whose surfaces part, and lists those that rays are to be asked about.
    #[inline(always)]
    fn tell_seams<L: Lanes>(
        &self,
        l: L,
        view: &TileView,
        pixels: &[[usize; 2]],
        seam: &mut impl FnMut([usize; 2]),
        asked: &mut Vec<[usize; 2]>,
    ) {
        for pixel in pixels {
            if self.by_rays[pixel[1] * TILE + pixel[0]] {
                asked.push(*pixel);
            } else if parts(l, view, &self.grid, &self.triangles, &self.front, *pixel) {
                seam(*pixel);
            }
        }
    }

    /// Lists the rays of some pixels.
    fn place(&mut self, min: [u32; 2], pixels: &[[usize; 2]], side: u32) {
        self.places.iter_mut().for_each(Vec::clear);
        let step = |i: u32| (i as f32 + 0.5) / side as f32;
        for pixel in pixels {
            for (y, x) in (0..side).flat_map(|y| (0..side).map(move |x| (y, x))) {
                self.places[0].push((min[0] + pixel[0] as u32) as f32 + step(x));
                self.places[1].push((min[1] + pixel[1] as u32) as f32 + step(y));
            }
        }
        self.slots.clear();
        self.slots.extend(0..self.places[0].len() as u32);
    }

    /// Tells the pixels whose surfaces part.
    fn part(&mut self, tracer: &Tracer<'_>, pixels: &[[usize; 2]], rays: usize, seam: &mut impl FnMut([usize; 2])) {
        let met = &mut self.met;
        let first_light = tracer.tables.first_light_instance;
        met.chosen.clear();
        let mut waiting = Vec::new();
        for (number, pixel) in pixels.iter().enumerate() {
            let slots = number * rays..(number + 1) * rays;
            if !met.several(slots.clone()) {
                continue;
            }
            if met.instance[slots.clone()].iter().any(|instance| *instance >= first_light) {
                // Something against nothing, or against a light.
                seam(*pixel);
            } else {
                met.chosen.extend(slots.map(|slot| slot as u32));
                waiting.push(*pixel);
            }
        }
        met.look_up(tracer);
        let parting = waiting.into_iter().enumerate().filter(|(number, _)| met.parts(number * rays..(number + 1) * rays));
        parting.for_each(|(_, pixel)| seam(pixel));
    }
}

impl Met {
    /// Takes the hits of the workspace's rays.
    fn take(&mut self, rays: usize, ws: &Workspace) {
        let (slots, hits) = ws.hits_by_slot();
        [&mut self.instance, &mut self.primitive].into_iter().for_each(|column| {
            column.clear();
            column.resize(rays, NONE);
        });
        [&mut self.t].into_iter().chain(&mut self.barycentric).for_each(|column| column.resize(rays, 0.0));
        for (ray, slot) in slots.map(|slot| slot as usize).enumerate() {
            (self.instance[slot], self.primitive[slot], self.t[slot]) = (hits.instance[ray], hits.primitive[ray], hits.t[ray]);
            (self.barycentric[0][slot], self.barycentric[1][slot]) = (hits.u[ray], hits.v[ray]);
        }
    }

    /// Whether some slots show more than one triangle.
    fn several(&self, mut slots: std::ops::Range<usize>) -> bool {
        let first = slots.start;
        slots.any(|slot| self.instance[slot] != self.instance[first] || self.primitive[slot] != self.primitive[first])
    }

    /// Finds normals and positions of the chosen hits.
    fn look_up(&mut self, tracer: &Tracer<'_>) {
        let room = gonio_simd::padded(self.chosen.len());
        self.chosen.resize(room, 0);
        self.normal.iter_mut().chain(&mut self.position).for_each(|column| column.resize(room, 0.0));
        dispatch!(tracer.transport.execution, l => surfaces(l, tracer.tables, self));
    }

    /// Whether the chosen hits of one pixel lie on surfaces that part: each is held against the first and against the one before.
    fn parts(&self, chosen: std::ops::Range<usize>) -> bool {
        let first = chosen.start;
        (first + 1..chosen.end).any(|place| self.part_from(first, place) || self.part_from(place - 1, place))
    }

    fn part_from(&self, one: usize, other: usize) -> bool {
        let [a, b] = [one, other].map(|place| self.chosen[place] as usize);
        if self.instance[a] == self.instance[b] && self.primitive[a] == self.primitive[b] {
            return false;
        }
        let dot = |v: [f32; 3], w: [f32; 3]| v[0] * w[0] + v[1] * w[1] + v[2] * w[2];
        let at = |columns: &[Vec<f32>; 3], place: usize| [columns[0][place], columns[1][place], columns[2][place]];
        let (normal, position) = (at(&self.normal, one), at(&self.position, one));
        if dot(normal, at(&self.normal, other)) < LEAST_COSINE {
            return true;
        }
        let least = self.t[a].min(self.t[b]) * MOST_DEPTH;
        if self.instance[a] != self.instance[b] {
            return (self.t[a] - self.t[b]).abs() > least;
        }
        let to = at(&self.position, other);
        dot(normal, [to[0] - position[0], to[1] - position[1], to[2] - position[2]]).abs() > least
    }
}

/// Normals and positions of the chosen hits, all of which are on meshes.
#[inline(always)]
fn surfaces<L: Lanes>(l: L, tables: &Tables, met: &mut Met) {
    let geometry: &GeometryTable = &tables.geometry;
    for at in (0..met.chosen.len()).step_by(L::COUNT) {
        let slot = l.load_integers(&met.chosen, at);
        let (instance, primitive) = (l.gather_integers(&met.instance, slot), l.gather_integers(&met.primitive, slot));
        let [u, v] = [0, 1].map(|i| l.gather(&met.barycentric[i], slot));
        let point = geometry.surface_point(l, &geometry.hit_lanes(l, instance, primitive, u, v));
        let [x, y, z] = &mut met.normal;
        point.geometric_normal.store([x, y, z], at);
        let [x, y, z] = &mut met.position;
        point.position.store([x, y, z], at);
    }
}
