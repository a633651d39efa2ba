//! Analytic shapes in unit object space, intersected in f64: there are few, and their hits place light samples.

use super::prepared::Padded;
use crate::tree::node::Bounds;

/// A shape in its own space. Flat ones are hit from both sides, closed ones from outside alone, where lights shine.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shape {
    /// The square [-0.5, 0.5]^2 in the plane z = 0; u = x + 0.5, v = y + 0.5.
    Rectangle,
    /// The disk of radius 1 in the plane z = 0; u = x, v = y.
    Disk,
    /// The sphere of radius 1 about the origin; u = v = 0, the point follows from t.
    Sphere,
    /// The tube of radius 1 about the x axis, x in [-0.5, 0.5], without caps; u = v = 0, the point follows from t.
    Cylinder,
}

/// One crossing of a ray and a shape.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ShapeHit {
    pub(crate) t: f32,
    pub(crate) u: f32,
    pub(crate) v: f32,
}

impl Shape {
    /// A box around the shape.
    pub(crate) fn bounds(self) -> Bounds {
        let half = match self {
            Shape::Rectangle => [0.5, 0.5, 0.0],
            Shape::Disk => [1.0, 1.0, 0.0],
            Shape::Sphere => [1.0, 1.0, 1.0],
            Shape::Cylinder => [0.5, 1.0, 1.0],
        };
        Bounds { min: half.map(|x: f32| -x), max: half }.padded()
    }

    /// The crossings with `t_min < t <= t_max`, nearest first.
    pub(crate) fn crossings(self, origin: Padded, direction: Padded, t_min: f32, t_max: f32) -> [Option<ShapeHit>; 2] {
        let [o, d] = [origin, direction].map(|[x, y, z, _]| [x, y, z].map(f64::from));
        let point = |t: f64| [0, 1, 2].map(|axis| o[axis] + t * d[axis]);
        let inside = |t: f64| ((t as f32) > t_min && (t as f32) <= t_max).then_some(t as f32);
        match self {
            Shape::Rectangle | Shape::Disk => {
                let t = -o[2] / d[2];
                let [x, y, _] = point(t);
                let hit = match self {
                    Shape::Rectangle => (x.abs() <= 0.5 && y.abs() <= 0.5).then_some((x + 0.5, y + 0.5)),
                    _ => (x * x + y * y <= 1.0).then_some((x, y)),
                };
                [hit.and_then(|(u, v)| Some(ShapeHit { t: inside(t)?, u: u as f32, v: v as f32 })), None]
            }
            Shape::Sphere | Shape::Cylinder => {
                let first = if self == Shape::Sphere { 0 } else { 1 };
                let keep = |t: f64| (self == Shape::Sphere || point(t)[0].abs() <= 0.5).then_some(t);
                let roots = unit_roots(&o[first..], &d[first..]);
                let hit = |t: f64| Some(ShapeHit { t: inside(keep(t)?)?, u: 0.0, v: 0.0 });
                [roots.and_then(|[near, _]| hit(near)), None]
            }
        }
    }
}

/// Where `|o + t d| = 1`, nearest first, without cancellation (half the middle coefficient, and the discriminant from the foot point).
fn unit_roots(o: &[f64], d: &[f64]) -> Option<[f64; 2]> {
    let dot = |a: &[f64], b: &[f64]| -> f64 { a.iter().zip(b).map(|(x, y)| x * y).sum() };
    let dd = dot(d, d);
    if dd == 0.0 {
        return None;
    }
    let middle = -dot(o, d) / dd;
    let foot2: f64 = o.iter().zip(d).map(|(x, y)| (x + middle * y) * (x + middle * y)).sum();
    let half2 = (1.0 - foot2) / dd;
    (half2 >= 0.0).then(|| [middle - half2.sqrt(), middle + half2.sqrt()])
}
