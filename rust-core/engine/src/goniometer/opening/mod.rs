//! The luminous opening: where light leaves the luminaire, and the shape that stands for it in a file.
//!
//! Light is last turned within a luminaire, and leaves where its straight way passes what encloses those places: the mouth of an open reflector, the
//! surface of a cover. Several parts that shine apart have a hull each. What a direction sees of them is measured; the shape that a file can hold is the one
//! whose projected areas come nearest.

mod departure;
mod extent;
mod fit;
mod hull;
mod parts;
mod shadow;

#[cfg(test)]
mod tests;

pub(super) use departure::{Departure, Sample};
pub use extent::Extent;

use extent::{extent_of, joined, largest_of, middle, size_of};
use fit::Seen;
use gonio_formats::photometry::Opening as FileOpening;
use hull::Hull;
use shadow::Shadow;

/// Lengths in metres below which there is but a point.
const POINT: f64 = 1e-5;
/// Lengths below this share of the largest are none.
const FLAT: f64 = 4e-3;
/// The same of the height of what shows no sides: near its rim a mouth lets light through a little above it.
const RIM: f64 = 5e-2;
/// Share of the hull's mouth below which what shines has a hole.
const HOLE: f64 = 0.6;

/// The luminaire's opening, in its frame.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Opening {
    /// The box about all places where light leaves.
    pub bounds: Extent,
    /// The box about each part that shines apart from the others; one for most luminaires.
    pub parts: Vec<Extent>,
    /// Luminous square metres that are seen from below, or from above of what shines up alone.
    pub area: f64,
    /// What files say of it: about the origin, with the projected areas that were seen.
    pub shape: FileOpening,
}

impl Opening {
    /// Of a sample of the light that leaves.
    pub(super) fn of(sample: &[Departure]) -> Self {
        let Some(whole) = extent_of(&sample.iter().map(|departure| departure.place).collect::<Vec<_>>()) else { return Self::default() };
        let largest = largest_of(&whole);
        if largest < POINT {
            let middle = middle(&whole);
            return Self { bounds: [middle; 2], parts: vec![[middle; 2]], ..Self::default() };
        }
        let parts: Vec<Part> = parts::find(sample, &whole).iter().map(|members| Part::new(members)).collect();
        let boxes: Vec<Extent> = parts.iter().map(Part::bounds).collect();
        let bounds = boxes.iter().copied().reduce(joined).unwrap_or_default();
        let seen = Seen::sum(parts.iter().map(|part| part.seen));
        let elliptic = parts.len() == 1 && parts[0].elliptic;
        Self { bounds, parts: boxes, area: seen.floor(), shape: fit::file_opening(size_of(&bounds), elliptic, &seen) }
    }

    /// Length, width and height along x, y and z, metres.
    pub fn size(&self) -> [f64; 3] {
        size_of(&self.bounds)
    }

    /// The middle.
    pub fn centre(&self) -> [f64; 3] {
        middle(&self.bounds)
    }

    /// Whether it is round about z.
    pub fn is_round(&self) -> bool {
        self.shape.size[0] > 0.0 && self.shape.is_round()
    }
}

/// What shines in one piece.
struct Part {
    extent: Extent,
    /// Whether it is a disk or an ellipse seen from below, or from above of what shines up alone.
    elliptic: bool,
    seen: Seen,
}

impl Part {
    fn new(members: &[Departure]) -> Self {
        let hull = Hull::new(members);
        let exits: Vec<([f64; 3], [f64; 3])> = members.iter().filter_map(|departure| hull.exit(departure)).collect();
        let places: Vec<[f64; 3]> = exits.iter().map(|(place, _)| *place).collect();
        let origins: Vec<[f64; 3]> = members.iter().map(|departure| departure.place).collect();
        let through = fit::directions().map(|direction| {
            let turned = |normal: &[f64; 3]| (0..3).map(|k| normal[k] * direction[k]).sum::<f64>() > 1e-6;
            let passed: Vec<[f64; 3]> = exits.iter().filter(|(_, normal)| turned(normal)).map(|(place, _)| *place).collect();
            Shadow::new(&passed, direction)
        });
        let itself = fit::directions().map(|direction| Shadow::new(&origins, direction));
        // Both are no less than what is seen: through the hull, and of the places themselves. A hull fills rings and frames.
        let has_hole = itself[0].area < HOLE * through[0].area.max(through[1].area);
        let shadows = if has_hole { itself } else { through };
        let seen = Seen { areas: shadows.map(|shadow| shadow.area) };
        let elliptic = shadows[usize::from(seen.looks_up())].elliptic;
        Self { extent: extent_of(&places).unwrap_or_default(), elliptic, seen }
    }

    /// The box about it, without lengths that are none.
    fn bounds(&self) -> Extent {
        let (size, middle, largest) = (size_of(&self.extent), middle(&self.extent), largest_of(&self.extent));
        let mut bounds = [0, 1].map(|end| [0, 1, 2].map(|k| if size[k] <= FLAT * largest { middle[k] } else { self.extent[end][k] }));
        if size[2] <= RIM * largest && fit::file_opening(size, self.elliptic, &self.seen).heights == [0.0; 4] {
            let mouth = self.extent[usize::from(self.seen.looks_up())][2];
            bounds.iter_mut().for_each(|end| end[2] = mouth);
        }
        bounds
    }
}
