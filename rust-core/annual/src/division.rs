//! The sky in patches: Tregenza's 145 (Solar Energy 1987) and Reinhart's finer ones, in the order of Radiance's `gendaymtx` and `reinhartb.cal`.
//!
//! Directions are unit vectors (east, north, up). Patch 0 is the ground; then rows from the horizon up, each from north clockwise; the zenith last.

use std::f64::consts::{FRAC_PI_2, TAU};

/// Tregenza's patches by row, from the horizon up, without the zenith.
const ROWS: [usize; 7] = [30, 30, 24, 24, 18, 12, 6];
/// The finest division: 5185 patches and the ground.
pub const FINEST: u32 = 6;

/// One patch of the sky, or the ground.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Patch {
    /// Radians above the horizon, of the centre.
    pub altitude: f64,
    /// Radians from north, clockwise seen from above, of the centre.
    pub azimuth: f64,
    /// Steradians.
    pub solid_angle: f64,
}

impl Patch {
    /// Unit vector towards the centre: east, north, up.
    pub fn direction(&self) -> [f64; 3] {
        direction(self.altitude, self.azimuth)
    }
}

/// Unit vector of angles in radians: east, north, up.
pub(crate) fn direction(altitude: f64, azimuth: f64) -> [f64; 3] {
    let ((up, flat), (east, north)) = (altitude.sin_cos(), azimuth.sin_cos());
    [flat * east, flat * north, up]
}

/// Cosine of the angle between two unit vectors.
pub(crate) fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// A division of sky and ground.
#[derive(Clone, Debug, PartialEq)]
pub struct Division {
    factor: u32,
    patches: Vec<Patch>,
}

impl Division {
    /// Reinhart's MF:`factor`; 1 is Tregenza's division. `None` unless it is 1 to [`FINEST`].
    pub fn new(factor: u32) -> Option<Self> {
        if !(1..=FINEST).contains(&factor) {
            return None;
        }
        let many = factor as usize;
        let height = FRAC_PI_2 / ((ROWS.len() * many) as f64 + 0.5);
        let mut patches = vec![Patch { altitude: -FRAC_PI_2, azimuth: 0.0, solid_angle: TAU }];
        for row in 0..ROWS.len() * many {
            let (count, low) = (ROWS[row / many] * many, row as f64 * height);
            let solid_angle = TAU * ((low + height).sin() - low.sin()) / count as f64;
            let azimuths = (0..count).map(|index| TAU * index as f64 / count as f64);
            patches.extend(azimuths.map(|azimuth| Patch { altitude: low + 0.5 * height, azimuth, solid_angle }));
        }
        patches.push(Patch { altitude: FRAC_PI_2, azimuth: 0.0, solid_angle: TAU * (1.0 - (0.5 * height).cos()) });
        Some(Self { factor, patches })
    }

    /// The division of that many patches, ground included: 146, 578, 1298, 2306, 3602 or 5186.
    pub fn of_count(count: usize) -> Option<Self> {
        (1..=FINEST).find(|factor| Self::count(*factor) == count).and_then(Self::new)
    }

    /// Patches of a factor, ground included.
    pub fn count(factor: u32) -> usize {
        144 * (factor * factor) as usize + 2
    }

    /// Reinhart's factor.
    pub fn factor(&self) -> u32 {
        self.factor
    }

    /// The patches, ground first.
    pub fn patches(&self) -> &[Patch] {
        &self.patches
    }

    /// A place in a patch of the sky for two numbers from 0 to 1, even by solid angle: east, north, up. The ground has none.
    pub fn place(&self, patch: usize, [u, v]: [f64; 2]) -> Option<[f64; 3]> {
        let many = self.factor as usize;
        let height = FRAC_PI_2 / ((ROWS.len() * many) as f64 + 0.5);
        let found = self.patches.get(patch).filter(|_| patch > 0)?;
        if patch + 1 == self.patches.len() {
            let up = 1.0 - u * (1.0 - (0.5 * height).cos());
            return Some(direction(up.asin(), TAU * v));
        }
        let [low, high] = [-0.5, 0.5].map(|side| (found.altitude + side * height).sin());
        let width = found.solid_angle / (high - low);
        Some(direction((low + u * (high - low)).asin(), found.azimuth + (v - 0.5) * width))
    }

    /// The patch of the sky that holds a direction; the ground's for one below the horizon.
    pub fn patch_of(&self, towards: [f64; 3]) -> usize {
        let [east, north, up] = towards;
        let many = self.factor as usize;
        if up <= 0.0 {
            return 0;
        }
        let height = FRAC_PI_2 / ((ROWS.len() * many) as f64 + 0.5);
        let row = (up.atan2(east.hypot(north)) / height) as usize;
        if row >= ROWS.len() * many {
            return self.patches.len() - 1;
        }
        let before: usize = (0..row).map(|row| ROWS[row / many] * many).sum();
        let count = ROWS[row / many] * many;
        let turn = east.atan2(north).rem_euclid(TAU) / TAU * count as f64;
        1 + before + (turn + 0.5) as usize % count
    }
}
