//! The unified glare rating of a luminaire in standard rooms: its UGR table (CIE 117, CIE 190).

mod area;
mod position;
mod room;

pub use position::{NoIndex, position_index};
pub use room::{REFLECTANCES, ROOMS};

use super::{Goniogram, PhotometricType, Symmetry};
use crate::error::{FormatError, Result};
use std::f64::consts::PI;

/// The spacing to height ratio of catalogues.
pub const CATALOGUE_SPACING: f64 = 0.25;
/// The ratios that a table can be asked for: nearer ones are thousands of luminaires, farther ones leave rooms without a second.
pub const SPACINGS: [f64; 2] = [0.1, 2.0];
/// Widest cell of the reference plane over which illuminances are summed, in heights.
const CELL: f64 = 0.0625;

/// A luminaire's UGR in 19 rooms with 5 sets of reflectances, seen across C0–C180 and along it.
#[derive(Clone, Debug, PartialEq)]
pub struct UgrTable {
    /// Distance of the luminaires over their height above the eye.
    pub spacing: f64,
    /// By room as in [`ROOMS`]; five values by reflectances as in [`REFLECTANCES`] crosswise (along C0–C180, across the lamps), then five endwise. None
    /// where nothing glares.
    pub values: [[Option<f64>; 10]; 19],
}

impl UgrTable {
    /// One line a room, ten values each, with one digit as catalogues have them; empty where nothing glares.
    pub fn csv(&self) -> String {
        let cell = |value: &Option<f64>| value.map_or(String::new(), |value| format!("{value:.1}"));
        let line = |values: &[Option<f64>; 10]| values.iter().map(cell).collect::<Vec<_>>().join(",");
        self.values.iter().map(|values| line(values) + "\n").collect()
    }
}

impl Goniogram {
    /// The UGR table with luminaires `spacing` times their height above the eye apart. The eye is at the middle of a wall and looks straight at the other;
    /// luminaires fill the room evenly, half a spacing from its walls. What has no position index is left out. The light that first reaches walls and
    /// reference plane is that of this layout, and is reflected by walls, plane and ceiling as CIE 190 has it.
    ///
    /// # Errors
    /// Spacings beyond [`SPACINGS`], and luminaires without a luminous opening or without light.
    pub fn ugr_table(&self, spacing: f64) -> Result<UgrTable> {
        let problem = |problem: String| Err(FormatError::whole(problem));
        let [least, most] = SPACINGS;
        if !(least..=most).contains(&spacing) {
            return problem(format!("the spacing to height ratio is {spacing}, expected {least} to {most}"));
        }
        if self.opening.projected_area([0.0, 0.6, -0.8]) <= 0.0 && self.opening.projected_area([0.6, 0.0, -0.8]) <= 0.0 {
            return problem("the file states no luminous opening, of which a luminance could be had: there is no UGR table".to_owned());
        }
        if self.flux() <= 0.0 {
            return problem("the luminaire sends no light: there is no UGR table".to_owned());
        }
        let mean = self.symmetrised(Symmetry::Rotational);
        let mut values = [[None; 10]; 19];
        for (row, room) in values.iter_mut().zip(ROOMS) {
            let layout = Layout::new(room, spacing);
            let arriving = mean.arriving(&layout);
            let background = REFLECTANCES.map(|reflectances| layout.background(arriving, reflectances));
            for (direction, turn) in [0.0, 90.0].into_iter().enumerate() {
                let sum = self.glare(&layout, turn);
                for (k, background) in background.iter().enumerate() {
                    row[5 * direction + k] = (sum > 0.0 && *background > 0.0).then(|| 8.0 * (0.25 / background * sum).log10());
                }
            }
        }
        Ok(UgrTable { spacing, values })
    }

    /// Σ L² ω / p² of the luminaires, seen from the plane C(`turn`); heights are 1 m, since background and sum fall alike with height.
    fn glare(&self, layout: &Layout, turn: f64) -> f64 {
        let luminaire = |[aside, ahead]: [f64; 2]| {
            let Ok(index) = position_index([aside, 1.0, ahead]) else { return 0.0 };
            let square = aside * aside + ahead * ahead + 1.0;
            let c = turn + aside.atan2(ahead).to_degrees();
            let towards = PhotometricType::C.direction(c, aside.hypot(ahead).atan().to_degrees());
            let (intensity, area) = (self.intensity(towards), self.opening.projected_area(towards));
            // (I / A)² A / r².
            if area > 0.0 { intensity * intensity / (area * square * index * index) } else { 0.0 }
        };
        layout.places().map(luminaire).sum()
    }

    /// Flux in lm that each luminaire sends straight to ceiling, walls and reference plane, for a rotational goniogram.
    fn arriving(&self, layout: &Layout) -> [f64; 3] {
        let (down, on_plane) = (self.flux_below(), layout.on_plane(self));
        [self.flux() - down, (down - on_plane).max(0.0), on_plane]
    }
}

/// Luminaires that fill a room evenly; lengths in their heights above the eye.
struct Layout {
    room: [f64; 2],
    /// Luminaires across and along the line of sight.
    count: [usize; 2],
}

impl Layout {
    fn new(room: [f64; 2], spacing: f64) -> Self {
        Self { room, count: room.map(|side| ((side / spacing).round() as usize).max(1)) }
    }

    fn number(&self) -> f64 {
        (self.count[0] * self.count[1]) as f64
    }

    /// Luminance in cd/m² of what the eye has around the luminaires, by the light that arrives at ceiling, walls and plane: the walls' mean illuminance by
    /// reflection over π.
    fn background(&self, arriving: [f64; 3], reflectances: [f64; 3]) -> f64 {
        let factors = room::transfer(self.room, reflectances);
        let reflected: f64 = arriving.iter().zip(factors).map(|(flux, factor)| flux * factor).sum();
        self.number() * reflected / (2.0 * (self.room[0] + self.room[1])) / PI
    }

    /// Each luminaire's place to the side and ahead of the eye.
    fn places(&self) -> impl Iterator<Item = [f64; 2]> {
        let [across, along] = self.count;
        let step = [self.room[0] / across as f64, self.room[1] / along as f64];
        (0..across * along).map(move |k| {
            let [i, j] = [k % across, k / across].map(|number| number as f64 + 0.5);
            [i * step[0] - 0.5 * across as f64 * step[0], j * step[1]]
        })
    }

    /// Mean flux in lm that a luminaire sends straight to the reference plane, with a height of 1 m.
    fn on_plane(&self, luminaire: &Goniogram) -> f64 {
        let [across, along] = [0, 1].map(|axis| distances(self.room[axis], self.count[axis]));
        let cell = across.step * along.step;
        let mut sum = 0.0;
        for (x, pairs) in across.pairs() {
            for (y, others) in along.pairs() {
                let square = x * x + y * y + 1.0;
                let illuminance = luminaire.intensity_at(0.0, x.hypot(y).atan().to_degrees()) / (square * square.sqrt());
                sum += pairs * others * illuminance * cell;
            }
        }
        sum / self.number()
    }
}

/// How often each distance along one side occurs between a luminaire and a cell of the plane.
struct Distances {
    step: f64,
    /// Of the k-th distance, from the middle of the first.
    often: Vec<f64>,
    /// Cells from one luminaire to the next.
    between: usize,
}

/// Between `count` luminaires and the cells under them along a side.
fn distances(side: f64, count: usize) -> Distances {
    let between = ((side / count as f64 / CELL).ceil() as usize).max(1);
    let cells = count * between;
    let mut often = vec![0.0; 2 * cells];
    for luminaire in 0..count {
        for cell in 0..cells {
            often[cell + cells - luminaire * between] += 1.0;
        }
    }
    Distances { step: side / cells as f64, often, between }
}

impl Distances {
    /// Distances with how often each occurs.
    fn pairs(&self) -> impl Iterator<Item = (f64, f64)> {
        // A luminaire stands over the middle of its cells.
        let first = (self.often.len() / 2) as f64 + 0.5 * self.between as f64 - 0.5;
        self.often.iter().enumerate().filter(|(_, often)| **often > 0.0).map(move |(k, often)| ((k as f64 - first) * self.step, *often))
    }
}
