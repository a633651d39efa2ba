//! How large a luminaire can be: openings in the wrong unit, and those that are longer than the body they are in.

use super::Opening;
use super::text::number;

/// Metres of the longest luminaire that a file describes as one.
pub(super) const LONGEST: f64 = 20.0;

/// By that much an opening may be larger than the body before it is cut: makers round them apart.
const TOLERANCE: f64 = 1.1;

/// Metres in a millimetre.
const MILLIMETRE: f64 = 1e-3;

/// Lengths in metres that a file's numbers are as millimetres; those below 1 count as metres among them. `None` if even they are too long.
pub(super) fn from_millimetres(numbers: [f64; 3]) -> Option<[f64; 3]> {
    let metres = numbers.map(|x| if x.abs() < 1.0 { x } else { x * MILLIMETRE });
    metres.iter().all(|x| x.abs() <= LONGEST).then_some(metres)
}

/// An opening within a body of length, width and height in metres, and what was cut; without a body that says how large it is, a point where it is
/// too long for a luminaire.
pub(super) fn within_body(opening: Opening, body: [f64; 3]) -> (Opening, Option<String>) {
    let [_, _, height] = opening.size;
    let Some(floor) = floor_of(body) else {
        let largest = opening.size.into_iter().fold(0.0, f64::max);
        let problem = || format!("the luminous area is {} m long, and no body tells its size: a point is taken", number(largest));
        return if largest > LONGEST { (Opening::default(), Some(problem())) } else { (opening, None) };
    };
    // Some files count length and width the other way round in one of the two places.
    let (along, across) = if opening.size[1] >= opening.size[0] { (1, 0) } else { (0, 1) };
    let mut limits = [f64::INFINITY; 3];
    (limits[along], limits[across]) = (floor[0], floor[1]);
    limits[2] = if body[2] > 0.0 && body[2] <= LONGEST { body[2] } else { LONGEST };
    let mut cut = opening;
    for (extent, limit) in cut.size.iter_mut().zip(limits) {
        *extent = if *extent > limit * TOLERANCE { limit } else { *extent };
    }
    if height > cut.size[2] {
        cut.heights = cut.heights.map(|side| side.min(cut.size[2]));
    }
    let metres = |size: [f64; 3]| size.map(number).join(" × ");
    let problem =
        || format!("the luminous area of {} m is larger than the luminaire: {} m is taken", metres(opening.size), metres(cut.size));
    (cut, (cut != opening).then(problem))
}

/// The greater and the lesser horizontal extent of a body; a width of 0 means round. `None` where the file says nothing, or nothing sensible.
fn floor_of([length, width, _]: [f64; 3]) -> Option<[f64; 2]> {
    let width = if width == 0.0 { length } else { width };
    (length > 0.0 && length.max(width) <= LONGEST).then_some([length.max(width), length.min(width)])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::photometry::OpeningShape;

    #[test]
    fn millimetres_beside_metres() {
        assert_eq!(from_millimetres([600.0, -600.0, 80.0]), Some([0.6, -0.6, 0.08]));
        assert_eq!(from_millimetres([0.0, 1200.0, -0.05]), Some([0.0, 1.2, -0.05]));
        assert_eq!(from_millimetres([63_800_000.0, 38.0, 0.0]), None);
    }

    #[test]
    fn openings_end_where_the_body_does() {
        let opening = |size| Opening::new(OpeningShape::Box, size);
        let body = [0.7, 0.043, 0.052];
        let (cut, problem) = within_body(opening([0.038, 63_800.0, 0.01]), body);
        assert_eq!(cut.size, [0.038, 0.7, 0.01]);
        assert!(problem.unwrap_or_default().contains("0.038 × 63800 × 0.01 m"));
        // Within a body, by rounding, and with length and width exchanged there is nothing to be said.
        for size in [[0.038, 0.638, 0.01], [0.04, 0.71, 0.05], [0.638, 0.038, 0.01]] {
            assert_eq!(within_body(opening(size), body), (opening(size), None));
        }
        let (cut, _) = within_body(opening([0.04, 0.6, 0.5]), body);
        assert_eq!((cut.size[2], cut.heights), (0.052, [0.052; 4]));
        let round = Opening::new(OpeningShape::Disk, [3.0, 3.0, 0.0]);
        assert_eq!(within_body(round, [0.3, 0.0, 0.1]).0.size, [0.3, 0.3, 0.0]);
    }

    #[test]
    fn without_a_body_only_what_no_luminaire_is_counts() {
        let long = Opening::new(OpeningShape::Rectangle, [0.1, 15.0, 0.0]);
        for body in [[0.0; 3], [70_000.0, 0.1, 0.1]] {
            assert_eq!(within_body(long, body), (long, None));
            let (point, problem) = within_body(Opening { size: [0.1, 150.0, 0.0], ..long }, body);
            assert_eq!(point, Opening::default());
            assert!(problem.is_some());
        }
    }
}
