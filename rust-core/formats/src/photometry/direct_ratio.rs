//! EULUMDAT's direct ratios: how much of the light that goes down reaches the working plane without a wall.

use super::Goniogram;

/// Room indices of the ratios.
const ROOM_INDICES: [f64; 10] = [0.6, 0.8, 1.0, 1.25, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0];

/// The widest steps of γ in degrees.
const STEP: f64 = 0.5;

/// Narrower steps of γ in degrees than that go with their neighbours, so that a file cannot ask for endless work.
const SLIVER: f64 = 0.02;

/// Steps of C about the circle.
const PLANES: u32 = 72;

impl Goniogram {
    /// The direct ratios for room indices 0.6, 0.8, 1, 1.25, 1.5, 2, 2.5, 3, 4 and 5, 0 to 1; zeros where no light goes down.
    ///
    /// The room is square, luminaires are spread evenly over its whole ceiling: light in one direction moves sideways by h tan γ on its way
    /// down by h, and what lands inside is the share of the ceiling that lies over the floor after that move. (The format's descriptions
    /// name the room indices alone; makers' figures agree with this within 0.02.)
    pub fn direct_ratios(&self) -> [f64; 10] {
        let own = self.to_type_c();
        let (mut reached, mut down) = ([0.0; 10], 0.0);
        for [gamma, width] in rows(&own.vertical) {
            let (sine, cosine) = gamma.to_radians().sin_cos();
            for column in 0..PLANES {
                let c = (f64::from(column) + 0.5) * 360.0 / f64::from(PLANES);
                let flux = own.intensity_at(c, gamma) * sine * width;
                let (across, along) = c.to_radians().sin_cos();
                let moved = [along, across].map(|part| part.abs() * sine / cosine);
                down += flux;
                for (sum, index) in reached.iter_mut().zip(ROOM_INDICES) {
                    // A square room of index k is 2 k h wide.
                    let inside = moved.map(|distance| (1.0 - distance / (2.0 * index)).max(0.0));
                    *sum += flux * inside[0] * inside[1];
                }
            }
        }
        reached.map(|sum| if down > 0.0 { sum / down } else { 0.0 })
    }
}

/// Middles and widths in degrees of rows of γ below the horizon, two or more for each tabulated step that is no sliver.
fn rows(vertical: &[f64]) -> Vec<[f64; 2]> {
    let mut ends: Vec<f64> = Vec::new();
    for angle in vertical.iter().map(|angle| angle.min(90.0)) {
        if ends.last().is_none_or(|last| angle - last >= SLIVER) {
            ends.push(angle);
        }
    }
    let cells = ends.windows(2).flat_map(|pair| {
        let count = ((pair[1] - pair[0]) / STEP).ceil().max(2.0);
        let (low, width) = (pair[0], (pair[1] - pair[0]) / count);
        (0..count as u32).map(move |row| [low + (f64::from(row) + 0.5) * width, width])
    });
    cells.collect()
}
