//! The luminance of the road as an observer sees it, in cd/m².

use crate::{line::Line, road::Reach, standard::Standard, surface::Surface};

/// Distance of an observer from the field, and height of the eye, in metres.
pub(crate) const AWAY: f64 = 60.0;
pub(crate) const EYE: f64 = 1.5;

/// Rounding of a distance that is exactly the reach.
const SLACK: f64 = 1e-9;

/// What luminance is calculated with.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Seen<'a> {
    pub(crate) lines: &'a [Line<'a>],
    pub(crate) reach: &'a Reach,
    pub(crate) surface: &'a Surface,
    pub(crate) standard: Standard,
    /// Where the observer stands.
    pub(crate) observer: [f64; 2],
}

impl Seen<'_> {
    /// Maintained and initial luminance at a place of the road.
    pub(crate) fn luminance(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let way = [x - self.observer[0], y - self.observer[1]];
        let mut sums = [0.0; 2];
        for line in self.lines {
            let height = line.row.height;
            let [back, ahead, aside] = self.reach.luminance.map(|reach| reach * height);
            if (line.y - y).abs() > aside * (1.0 + SLACK) {
                continue;
            }
            let of_line: f64 = line
                .between(x - back, x + ahead)
                .map(|at| {
                    let ray = line.ray(at, [x, y, 0.0]);
                    let beta = angle(way, [ray.to[0], ray.to[1]]);
                    let tangent = ray.to[0].hypot(ray.to[1]) / height;
                    ray.intensity * self.surface.reduced(beta, tangent, self.standard) / (height * height)
                })
                .sum();
            sums[0] += of_line * line.row.maintenance_factor;
            sums[1] += of_line;
        }
        sums
    }
}

/// The angle between two directions in plan, in degrees.
fn angle(a: [f64; 2], b: [f64; 2]) -> f64 {
    let (along, across) = (a[0] * b[0] + a[1] * b[1], a[0] * b[1] - a[1] * b[0]);
    across.abs().atan2(along).to_degrees()
}
