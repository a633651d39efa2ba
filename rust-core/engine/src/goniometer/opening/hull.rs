//! What encloses places from outside: a polytope of fixed directions (k-DOP, Klosowski et al. 1998), and where rays pass it.

use super::{
    departure::Departure,
    extent::{extent_of, largest_of},
};

/// Greatest whole coordinate of the polytope's normals: 98 directions.
const REACH: i32 = 2;
/// Share of its size by which a place may lie beyond the polytope: what is farther away belongs to no part.
const BEYOND: f64 = 0.05;

/// A convex polytope about places.
#[derive(Clone, Debug)]
pub(super) struct Hull {
    /// Unit normals, and how far the faces are from the origin.
    faces: Vec<([f64; 3], f64)>,
    size: f64,
}

impl Hull {
    /// About departures' places, but for the outermost along the axes.
    pub(super) fn new(members: &[Departure]) -> Self {
        let places: Vec<[f64; 3]> = members.iter().map(|departure| departure.place).collect();
        let Some(extent) = extent_of(&places) else { return Self { faces: Vec::new(), size: 0.0 } };
        let inside = |place: &&[f64; 3]| (0..3).all(|k| (extent[0][k]..=extent[1][k]).contains(&place[k]));
        let inner: Vec<[f64; 3]> = places.iter().filter(inside).copied().collect();
        let farthest = |normal: [f64; 3]| inner.iter().map(|place| dot(normal, *place)).fold(f64::NEG_INFINITY, f64::max);
        Self { faces: normals().map(|normal| (normal, farthest(normal))).collect(), size: largest_of(&extent) }
    }

    /// Whether a point is inside.
    pub(super) fn holds(&self, point: [f64; 3]) -> bool {
        self.faces.iter().all(|(normal, distance)| dot(*normal, point) <= *distance)
    }

    /// Where a ray from inside passes the hull, and the normal of the face there; none of what starts far outside.
    pub(super) fn exit(&self, departure: &Departure) -> Option<([f64; 3], [f64; 3])> {
        let Departure { place, direction } = *departure;
        let (mut way, mut through) = (f64::INFINITY, [0.0; 3]);
        for (normal, distance) in &self.faces {
            let (left, speed) = (distance - dot(*normal, place), dot(*normal, direction));
            if left < -BEYOND * self.size {
                return None;
            }
            // A face that is grazed at no distance is not passed.
            if speed > 1e-9 && left.max(0.0) / speed < way {
                (way, through) = (left.max(0.0) / speed, *normal);
            }
        }
        way.is_finite().then(|| ([0, 1, 2].map(|k| place[k] + way * direction[k]), through))
    }
}

/// Directions of whole coordinates, each once, the axes first.
fn normals() -> impl Iterator<Item = [f64; 3]> {
    let range = -REACH..=REACH;
    let all = range.clone().flat_map(move |x| {
        let range = range.clone();
        range.clone().flat_map(move |y| range.clone().map(move |z| [x, y, z]))
    });
    let mut wanted: Vec<[i32; 3]> = all.filter(|v| divisor(*v) == 1).collect();
    wanted.sort_by_key(|v| v.iter().map(|x| x * x).sum::<i32>());
    wanted.into_iter().map(|v| {
        let v = v.map(f64::from);
        v.map(|x| x / dot(v, v).sqrt())
    })
}

/// The greatest common divisor; 0 of no direction.
fn divisor(v: [i32; 3]) -> i32 {
    v.iter().fold(0, |mut a, b| {
        let mut b = b.abs();
        while b != 0 {
            (a, b) = (b, a % b);
        }
        a
    })
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}
