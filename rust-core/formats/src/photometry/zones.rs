//! Flux by zones: CIE flux codes, and the luminaire classification system with its BUG rating.

use super::{Goniogram, Symmetry};

/// Greatest γ in degrees of the cones of π/2, π, 3π/2 and 2π sr (CIE 52).
const CONES: [f64; 4] = [41.409_622_109_270_86, 60.0, 75.522_487_814_070_1, 90.0];

/// Ends of the zones in degrees from nadir: low, mid, high, very high, and both of uplight.
const ENDS: [f64; 7] = [0.0, 30.0, 60.0, 80.0, 90.0, 100.0, 180.0];

/// Greatest lumens of the ratings 0 to 4 in each zone (IES TM-15-11, addendum A).
const LOW: [f64; 5] = [110.0, 500.0, 1000.0, 2500.0, 5000.0];
const MID: [f64; 5] = [220.0, 1000.0, 2500.0, 5000.0, 8500.0];
const UPLIGHT: [f64; 5] = [0.0, 10.0, 50.0, 500.0, 1000.0];
const VERY_HIGH: [f64; 5] = [10.0, 100.0, 225.0, 500.0, 750.0];
const FORWARD_HIGH: [f64; 5] = [660.0, 1800.0, 5000.0, 7500.0, 12_000.0];
/// Lumens that are none: intensities' last digits.
const NOTHING: f64 = 0.05;

/// Lumens of the ten zones of IES TM-15-11.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Zones {
    /// To the front: low (0° to 30° from nadir), mid (to 60°), high (to 80°), very high (to 90°).
    pub forward: [f64; 4],
    /// The same to the back.
    pub back: [f64; 4],
    /// Up, all around: low (90° to 100°) and high (to 180°).
    pub up: [f64; 2],
}

/// Backlight, uplight and glare, 0 to 5 each.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Bug {
    /// Backlight.
    pub backlight: u8,
    /// Uplight.
    pub uplight: u8,
    /// Glare.
    pub glare: u8,
}

impl std::fmt::Display for Bug {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "B{} U{} G{}", self.backlight, self.uplight, self.glare)
    }
}

impl Goniogram {
    /// CIE flux codes N1 to N5 (CIE 52), as shares: of the flux down within cones of π/2, π and 3π/2 sr, of the whole that goes down, and the light output
    /// ratio, which is 1 where the file states none. None without light; N1 to N3 are 0 where none goes down.
    pub fn flux_codes(&self) -> Option<[f64; 5]> {
        let whole = self.flux();
        let cones = CONES.map(|end| self.to_type_c().flux_between([0.0, end]));
        let down = cones[3];
        let of_down = |flux: f64| if down > 0.0 { flux / down } else { 0.0 };
        let [first, second, third, _] = cones.map(of_down);
        let ratio = self.lamps().and_then(|lamps| lamps.flux).map_or(1.0, |lamps| whole / lamps);
        (whole > 0.0).then(|| [first, second, third, down / whole, ratio])
    }

    /// The C plane in degrees that faces the street: C90 in EULUMDAT, whose C0–C180 runs along it, and C0 in LM-63.
    pub fn street_side(&self) -> f64 {
        // EULUMDAT alone states direct ratios.
        if self.stated.direct_ratios.is_some() { 90.0 } else { 0.0 }
    }

    /// Whether it sends the same to all four sides, as types V and V square do, within 1 % of the peak.
    pub fn is_square(&self) -> bool {
        let limit = 0.01 * self.peak();
        let own = self.to_type_c();
        let planes = own.expanded().horizontal;
        let same =
            |c: &f64| own.vertical.iter().all(|gamma| (own.intensity_at(*c, *gamma) - own.intensity_at(c + 90.0, *gamma)).abs() <= limit);
        planes.iter().all(same)
    }

    /// Lumens by zones; the front is the half about the plane C(`front`), such as [`Goniogram::street_side`].
    pub fn zones(&self, front: f64) -> Zones {
        let turned = self.to_type_c().rotated(-front).symmetrised(Symmetry::None);
        let within = |sides: &[[f64; 2]], zone: usize| turned.flux_of_sides(sides, [ENDS[zone], ENDS[zone + 1]]);
        let (ahead, behind) = ([[0.0, 90.0], [270.0, 360.0]], [[90.0, 270.0]]);
        Zones {
            forward: [0, 1, 2, 3].map(|zone| within(&ahead, zone)),
            back: [0, 1, 2, 3].map(|zone| within(&behind, zone)),
            up: [4, 5].map(|zone| within(&[[0.0, 360.0]], zone)),
        }
    }
}

impl Zones {
    /// The rating; `all_round` where the luminaire is of type V, the same to all four sides, whose back may have the high zone of the front.
    pub fn rating(&self, all_round: bool) -> Bug {
        let rating = |limits: [f64; 5], lumens: f64| limits.iter().filter(|limit| lumens > **limit + NOTHING).count() as u8;
        let worst = |ratings: &[u8]| ratings.iter().copied().max().unwrap_or(0);
        let [low, mid, high, very_high] = self.back;
        let behind = if all_round { FORWARD_HIGH } else { LOW };
        Bug {
            backlight: worst(&[rating(LOW, low), rating(MID, mid), rating(LOW, high)]),
            uplight: worst(&self.up.map(|lumens| rating(UPLIGHT, lumens))),
            glare: worst(&[
                rating(VERY_HIGH, self.forward[3]),
                rating(VERY_HIGH, very_high),
                rating(FORWARD_HIGH, self.forward[2]),
                rating(behind, high),
            ]),
        }
    }
}
