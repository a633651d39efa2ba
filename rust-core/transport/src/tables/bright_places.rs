//! Bright places: cells of a grid on whose surfaces light paths arrive more densely than the pixels of the picture lie (a candle under its flame, a
//! caustic).
//!
//! What a surface scatters on to others is found from both of its ends: camera paths that were scattered look for the place, or light paths go on
//! from it to what the camera sees. A density p of light paths on the place and a density q of pixels on what is seen, each a share of all paths
//! a square metre, leave noise as p to q. So light paths carry the light on by a share that both sides look up in the place's cell.

use gonio_simd::{F, Lanes, M, PADDING, U, Vec3};
use std::{
    collections::HashMap,
    hash::{BuildHasherDefault, Hasher},
};

/// Where light paths arrived, cell by cell.
#[derive(Clone, Debug)]
pub struct ArrivalCells {
    /// Cells a metre.
    scale: f32,
    /// By the hash of the cell: the sums of flux and of its square.
    cells: HashMap<u32, [f64; 2], BuildHasherDefault<AsItIs>>,
}

/// The share of the light from each bright cell that light paths carry on.
#[derive(Clone, Debug, Default)]
pub struct BrightPlaces {
    scale: f32,
    /// Hashes of cells, in buckets by their last bits; no cell has 0.
    keys: Vec<u32>,
    shares: Vec<f32>,
}

/// Hashes of cells are hashes already.
#[derive(Clone, Copy, Debug, Default)]
struct AsItIs(u64);

/// Cells along the radius of the scene.
const CELLS: f64 = 128.0;
/// Cells that fit into a bucket. With a single one up to a tenth of the cells found no room, and camera paths met these as fireflies.
const BUCKET: usize = 2;
/// Smaller shares are none, and larger ones all.
const SHARES: [f64; 2] = [0.1, 0.95];
/// Where cells begin, in cells: surfaces at round coordinates are not to lie on borders.
const OFFSET: [f32; 3] = [0.381_966, 0.236_068, 0.145_898];
/// Factors of the coordinates, and of their mix.
const FACTORS: [u32; 3] = [0x9e37_79b1, 0x85eb_ca77, 0xc2b2_ae3d];
const MIX: u32 = 0x2c1b_3c6d;

impl Hasher for AsItIs {
    fn finish(&self) -> u64 {
        self.0
    }
    fn write(&mut self, bytes: &[u8]) {
        bytes.iter().for_each(|byte| self.0 = self.0 << 8 | u64::from(*byte));
    }
    fn write_u32(&mut self, hash: u32) {
        // Tables look at the first bits as well.
        self.0 = u64::from(hash) << 32 | u64::from(hash);
    }
}

impl ArrivalCells {
    /// None yet, in a scene of some radius, metres.
    pub fn new(radius: f64) -> Self {
        Self { scale: (CELLS / radius.max(f64::MIN_POSITIVE)) as f32, cells: HashMap::default() }
    }

    /// Adds flux (mean of R, G, B) that arrived at a place, rebased world space.
    pub fn add(&mut self, position: [f32; 3], flux: f64) {
        let cell = [0, 1, 2].map(|axis| (position[axis] * self.scale + OFFSET[axis]).floor() as i32);
        let [sum, squares] = self.cells.entry(hash(cell)).or_default();
        (*sum, *squares) = (*sum + flux, *squares + flux * flux);
    }

    /// The bright places among them; `share` is the part of a path in all that were traced, `seen` the area that pixels spread over, as many as light
    /// paths of a sample, m².
    pub fn bright_places(&self, share: f64, seen: f64) -> BrightPlaces {
        let of_path = f64::from(self.scale).powi(2) * share * seen;
        let carried = |[sum, squares]: &[f64; 2]| {
            // As many paths as would be that noisy if each brought as much.
            let ratio = (sum * sum / squares.max(f64::MIN_POSITIVE) * of_path).powi(2);
            let share = if ratio.is_finite() { ratio / (ratio + 1.0) } else { 1.0 };
            if share < SHARES[1] { share } else { 1.0 }
        };
        let shares = self.cells.iter().map(|(key, sums)| (*key, carried(sums)));
        let chosen: Vec<(u32, f32)> = shares.filter(|(_, share)| *share >= SHARES[0]).map(|(key, share)| (key, share as f32)).collect();
        if chosen.is_empty() {
            return BrightPlaces::default();
        }
        let buckets = (4 * chosen.len()).next_power_of_two().max(PADDING);
        let mut places = BrightPlaces { scale: self.scale, keys: vec![0; BUCKET * buckets], shares: vec![0.0; BUCKET * buckets] };
        for mut cell in chosen {
            let first = BUCKET * (cell.0 as usize & (buckets - 1));
            // Of more cells than fit the brighter stay, whatever the order.
            for slot in first..first + BUCKET {
                let held = (places.keys[slot], places.shares[slot]);
                if (cell.1, cell.0) > (held.1, held.0) {
                    (places.keys[slot], places.shares[slot]) = cell;
                    cell = held;
                }
            }
        }
        places
    }
}

impl BrightPlaces {
    /// Whether there is none.
    #[inline(always)]
    pub fn is_empty(&self) -> bool {
        self.keys.is_empty()
    }

    /// Share of the light at chosen points that light paths carry on from there.
    #[inline(always)]
    pub fn carried_on<L: Lanes>(&self, position: Vec3<L>, chosen: M<L>) -> F<L> {
        let l = position.x.lanes();
        let x = (position.x * self.scale + OFFSET[0]).floor().to_i32();
        let y = (position.y * self.scale + OFFSET[1]).floor().to_i32();
        let z = (position.z * self.scale + OFFSET[2]).floor().to_i32();
        let key = mixed((x * FACTORS[0]) ^ (y * FACTORS[1]) ^ (z * FACTORS[2]));
        let first = ((key & ((self.keys.len() / BUCKET) as u32 - 1)) * BUCKET as u32).keep_if(chosen);
        let mut share = l.f(0.0);
        for slot in 0..BUCKET as u32 {
            let known = chosen & l.gather_integers(&self.keys, first + slot).eq(key);
            share += l.gather(&self.shares, first + slot).keep_if(known);
        }
        share
    }
}

#[inline(always)]
fn mixed<L: Lanes>(h: U<L>) -> U<L> {
    let h = (h ^ (h >> 15)) * MIX;
    (h ^ (h >> 13)).max(1)
}

/// The same of one cell.
fn hash(cell: [i32; 3]) -> u32 {
    let [x, y, z] = [0, 1, 2].map(|axis| (cell[axis] as u32).wrapping_mul(FACTORS[axis]));
    let h = x ^ y ^ z;
    let h = (h ^ (h >> 15)).wrapping_mul(MIX);
    (h ^ (h >> 13)).max(1)
}
