//! The photon map: where light paths left flux on surfaces that are not specular, on a hash grid, to be merged with camera paths.

use crate::tables::bright_places::BrightPlaces;
use gonio_simd::{Lanes, PADDING, Rgb, U, Vec3, padded};

/// Flux that arrived at a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Photon {
    /// Where, rebased world space.
    pub position: [f32; 3],
    /// Unit direction that it came in.
    pub direction: [f32; 3],
    /// Unit normal of the triangle.
    pub normal: [f32; 3],
    /// Metres to the triangle's nearest edge.
    pub inside: f32,
    /// Flux, R, G, B.
    pub flux: [f32; 3],
    /// Light that it left.
    pub light: u32,
}

/// The photons of a block of samples.
#[derive(Clone, Debug, Default)]
pub struct Photons {
    /// For what is seen directly or in mirrors and through glass: its blur shows.
    pub fine: PhotonMap,
    /// For light that goes on from there to other surfaces: fewer photons, of a radius that always finds some.
    pub coarse: PhotonMap,
    /// Where light paths carry on what falls straight from lights, and what mirrors and smooth glass sent there.
    pub bright: Bright,
}

/// Bright places by how light came there.
#[derive(Clone, Debug, Default)]
pub struct Bright {
    /// Straight from lights.
    pub direct: BrightPlaces,
    /// By mirrors and smooth glass.
    pub caustic: BrightPlaces,
}

/// Photons by cells of a grid whose width is twice the radius: what lies about a point is in eight cells.
#[derive(Clone, Debug, Default)]
pub struct PhotonMap {
    radius: f32,
    /// First photon of each bucket, and the number of all.
    starts: Vec<u32>,
    position: [Vec<f32>; 3],
    /// Items of directions and the bits of lights.
    direction: Vec<f32>,
    /// Items of fluxes, the fourth word unused.
    flux: Vec<f32>,
}

/// A register of photons.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PhotonLanes<L: Lanes> {
    /// Unit direction towards where the light came from.
    pub(crate) wi: Vec3<L>,
    pub(crate) light: U<L>,
    pub(crate) flux: Rgb<L>,
}

/// Part of the radius that photons may lie off the plane.
pub const OFF_PLANE: f32 = 0.1;
/// Cells that the scene's radius is cut into to see how much of its surfaces photons lie on.
const CELLS: f64 = 64.0;
/// Most photons of a coarse map.
const MOST_COARSE: usize = 1 << 16;
/// Photons that a place of mean irradiance finds in it.
const FOUND_COARSE: f64 = 16.0;

impl Photons {
    /// Sorts photons into cells. `radius` is that of the fine map, `shrinks` the part of the coarse map's that later blocks keep; `share` is the part of
    /// a path in all that were traced, `area` about that of the scene's surfaces. `covered` tells of photons which parts of their discs of a radius lie
    /// on surfaces: what they bring is spread over these.
    pub fn new(
        photons: &[Photon],
        bright: Bright,
        [radius, shrinks, share, area]: [f64; 4],
        mut covered: impl FnMut(&[Photon], f32) -> Vec<f32>,
    ) -> Self {
        let step = photons.len().div_ceil(MOST_COARSE).max(1);
        let some: Vec<Photon> = photons.iter().step_by(step).copied().collect();
        let wide = (FOUND_COARSE * lit_area(&some, area) / (std::f64::consts::PI * some.len().max(1) as f64)).sqrt() * shrinks;
        let mut map = |photons: &[Photon], radius: f32, share: f64| PhotonMap::new(photons, &covered(photons, radius), radius, share);
        let fine = map(photons, radius as f32, share);
        Self { fine, coarse: map(&some, wide.max(radius) as f32, share * step as f64), bright }
    }
}

/// About the area that photons lie on: that of the cells of a grid which hold any.
fn lit_area(photons: &[Photon], area: f64) -> f64 {
    let width = (area / (4.0 * std::f64::consts::PI)).sqrt() / CELLS;
    let cell = |photon: &Photon| photon.position.map(|x| (f64::from(x) / width).floor() as i32);
    let mut cells: Vec<[i32; 3]> = photons.iter().map(cell).collect();
    cells.sort_unstable();
    cells.dedup();
    cells.len() as f64 * width * width
}

impl PhotonMap {
    /// Sorts photons into cells; `share` is the part of a path in all that were traced, `covered` that of each one's disc which lies on surfaces.
    fn new(photons: &[Photon], covered: &[f32], radius: f32, share: f64) -> Self {
        if photons.is_empty() || radius <= 0.0 {
            return Self::default();
        }
        let buckets = photons.len().next_power_of_two().max(16);
        let map = Self { radius, starts: vec![0; buckets + 1], ..Self::default() };
        let bucket_of = |photon: &Photon| map.bucket(photon.position.map(|x| map.cell(x)));
        let mut starts = map.starts.clone();
        photons.iter().for_each(|photon| starts[bucket_of(photon) + 1] += 1);
        (0..buckets).for_each(|bucket| starts[bucket + 1] += starts[bucket]);
        let mut order = vec![0_u32; photons.len()];
        let mut next = starts.clone();
        for (number, photon) in photons.iter().enumerate() {
            let place = &mut next[bucket_of(photon)];
            order[*place as usize] = number as u32;
            *place += 1;
        }
        let room = padded(photons.len()) + PADDING;
        let mut position = [0, 1, 2].map(|_| vec![f32::INFINITY; room]);
        let (mut direction, mut flux) = (vec![0.0; 4 * room], vec![0.0; 4 * room]);
        for (place, number) in order.iter().enumerate() {
            let photon = &photons[*number as usize];
            position.iter_mut().zip(photon.position).for_each(|(column, x)| column[place] = x);
            direction[4 * place..4 * place + 3].copy_from_slice(&photon.direction);
            direction[4 * place + 3] = f32::from_bits(photon.light);
            let spread = share / f64::from(covered[*number as usize]);
            let shared = photon.flux.map(|x| (f64::from(x) * spread) as f32);
            flux[4 * place..4 * place + 3].copy_from_slice(&shared);
        }
        Self { starts, position, direction, flux, ..map }
    }

    /// Whether nothing arrived.
    pub(crate) fn is_empty(&self) -> bool {
        self.radius <= 0.0
    }

    /// Radius within which photons are merged, metres.
    pub(crate) fn radius(&self) -> f32 {
        self.radius
    }

    fn cell(&self, x: f32) -> i64 {
        (x / (2.0 * self.radius)).floor() as i64
    }

    fn bucket(&self, cell: [i64; 3]) -> usize {
        let [x, y, z] = cell.map(|c| c as u64);
        let mixed = x.wrapping_mul(0x9e37_79b9_7f4a_7c15) ^ y.wrapping_mul(0xc2b2_ae3d_27d4_eb4f) ^ z.wrapping_mul(0x1656_67b1_9e37_79f9);
        ((mixed ^ (mixed >> 29)).wrapping_mul(0xbf58_476d_1ce4_e5b9) >> 32) as usize & (self.starts.len() - 2)
    }

    /// Lists the photons within the radius of a point, near the plane through it: those of other surfaces do not count.
    #[inline(always)]
    pub(crate) fn about<L: Lanes>(&self, l: L, point: [f32; 3], normal: [f32; 3], found: &mut Vec<u32>) {
        found.clear();
        if self.is_empty() || !point.iter().all(|x| x.is_finite()) {
            return;
        }
        let low = point.map(|x| self.cell(x - self.radius));
        let mut buckets = [usize::MAX; 8];
        for (corner, bucket) in buckets.iter_mut().enumerate() {
            *bucket = self.bucket(std::array::from_fn(|axis| low[axis] + (corner as i64 >> axis & 1)));
        }
        // Cells may share a bucket.
        buckets.sort_unstable();
        let plane = [Vec3::splat(l, point), Vec3::splat(l, normal)];
        for (place, bucket) in buckets.iter().enumerate() {
            if place == 0 || buckets[place - 1] != *bucket {
                self.in_bucket(l, plane, *bucket, found);
            }
        }
    }

    #[inline(always)]
    fn in_bucket<L: Lanes>(&self, l: L, [p, normal]: [Vec3<L>; 2], bucket: usize, found: &mut Vec<u32>) {
        let [first, end] = [self.starts[bucket] as usize, self.starts[bucket + 1] as usize];
        let [x, y, z] = &self.position;
        for at in (first..end).step_by(L::COUNT) {
            let way = Vec3::new(l.load(x, at), l.load(y, at), l.load(z, at)) - p;
            let flat = normal.dot(way).abs().lt(self.radius * OFF_PLANE);
            let near = way.length_squared().lt(self.radius * self.radius) & flat & l.first(end - at);
            if near.any() {
                let count = found.len();
                found.resize(count + PADDING, 0);
                (l.iota() + at as u32).append(near, found, count);
                found.truncate(count + near.count());
            }
        }
    }

    #[inline(always)]
    pub(crate) fn photons<L: Lanes>(&self, l: L, number: U<L>) -> PhotonLanes<L> {
        let [x, y, z, light] = l.gather_quads(&self.direction, number << 2);
        let [r, g, b, _] = l.gather_quads(&self.flux, number << 2);
        PhotonLanes { wi: -Vec3::new(x, y, z), light: light.to_bits(), flux: Rgb::new(r, g, b) }
    }
}
