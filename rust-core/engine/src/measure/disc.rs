//! Discs about meters: light that mirrors and clear glass send on is counted where it crosses one, for no path from the meter itself would find it.
//!
//! The disc of a plane lies in it. That of a cylinder, which light meets from all around, faces each ray.

use super::vector::{Vector, add, cross, dot, length, scaled, subtract};
use crate::{
    accel::{Hits, RayBatch},
    compile::CompiledScene,
    transport::{Segment, Sensor, ray_mask},
};
use gonio_simd::Execution;
use std::f64::consts::{PI, TAU};

/// Of the way to what mirrors or refracts, how much a disc's radius may be: light that falls off with the square of the way is within (1/20)² of its mean.
const SHARE: f64 = 1.0 / 20.0;
/// Of the radius about something that mirrors or refracts, how near a meter within counts as.
const WITHIN: f64 = 0.25;
/// Of the way to the nearest surface, how far a disc reaches.
const FREE: f64 = 0.98;
/// Rays that look for surfaces, over a plane and all around.
const ROUND: usize = 64;
const AROUND: usize = 256;
/// Errors of the position that a disc is off the surface it lies on, where rays look for others, and the least number that its radius has.
const OFF: f64 = 16.0;
const LEAST: f64 = 4.0;
/// Radians from one of the directions all around to the next, which spreads them evenly.
const GOLDEN: f64 = 2.399_963_229_728_653;

/// A disc in rebased world space.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Disc {
    pub(super) position: Vector,
    normal: Vector,
    /// Towards which a cylinder's normal turns.
    side: Vector,
    turn: f64,
    /// How far the true surface may lie off.
    error: f64,
    /// Metres; 0 where there is no room for a disc.
    pub(super) radius: f64,
}

impl Disc {
    /// The largest that is fit for a sensor: within `reach` metres, near enough to show how light changes from place to place, and clear of all surfaces
    /// but the one it lies on.
    pub(super) fn of(sensor: &Sensor, reach: f64, scene: &CompiledScene) -> Self {
        let wide = |v: [f32; 3]| v.map(f64::from);
        let (position, error) = (wide(sensor.position), f64::from(sensor.error));
        let disc =
            Self { position, normal: wide(sensor.normal), side: wide(sensor.side), turn: f64::from(sensor.turn), error, radius: 0.0 };
        let way = |(centre, radius): &([f32; 3], f32)| {
            let radius = f64::from(*radius);
            (length(subtract(wide(*centre), position)) - radius).max(WITHIN * radius)
        };
        let most = SHARE * scene.casters.targets.iter().map(way).fold(f64::INFINITY, f64::min);
        // What polished floors and walls send on comes from all over the scene, which may be far off.
        let (middle, all) = scene.bounds.sphere(scene.tables.origin);
        let outside = length(subtract(wide(middle), position)) - all;
        let most = most.min(SHARE * all.max(outside)).min(reach);
        let radius = most.min(FREE * disc.free(scene, most));
        Self { radius: if radius > LEAST * error { radius } else { 0.0 }, ..disc }
    }

    /// Metres to the nearest surface, of those up to `most`.
    fn free(&self, scene: &CompiledScene, most: f64) -> f64 {
        let across = cross(self.normal, self.side);
        let directions: Vec<Vector> = if self.turn > 0.0 {
            let height = |number: usize| 1.0 - (2.0 * number as f64 + 1.0) / AROUND as f64;
            let at = |number: usize| {
                let (sin, cos) = (number as f64 * GOLDEN).sin_cos();
                let away = (1.0 - height(number) * height(number)).sqrt();
                add(scaled(self.normal, height(number)), add(scaled(self.side, away * cos), scaled(across, away * sin)))
            };
            (0..AROUND).map(at).collect()
        } else {
            let at = |number: usize| {
                let (sin, cos) = (number as f64 * TAU / ROUND as f64).sin_cos();
                add(scaled(self.side, cos), scaled(across, sin))
            };
            (0..ROUND).map(at).collect()
        };
        let from = if self.turn > 0.0 { self.position } else { add(self.position, scaled(self.normal, OFF * self.error)) };
        nearest(scene, from, &directions, most)
    }

    /// Where a segment crosses the disc, in metres from its origin, and how much of its flux counts: the illuminance is that over the disc's area.
    pub(super) fn crossed(&self, segment: &Segment) -> Option<(f64, f64)> {
        let [origin, direction] = [segment.origin, segment.direction].map(|v| v.map(f64::from));
        let to = subtract(self.position, origin);
        let cosine = -dot(self.normal, direction);
        let (at, slack, weight) = if self.turn > 0.0 {
            (dot(to, direction), 0.0, self.turned(cosine, -dot(self.side, direction)))
        } else if cosine > 0.0 {
            (-dot(to, self.normal) / cosine, OFF * self.error / cosine, 1.0)
        } else {
            return None;
        };
        let off = subtract(scaled(direction, at), to);
        let within = dot(off, off) < self.radius * self.radius;
        let between = at > f64::from(segment.from) - slack && at < f64::from(segment.to) + slack;
        (within && between && weight > 0.0).then_some((at, weight))
    }

    /// Mean of the cosine, where it is positive, over the normals of a cylinder or of half of one, of light from a direction that has these components
    /// along the normal in the middle and along the side.
    fn turned(&self, along: f64, aside: f64) -> f64 {
        let across = along.hypot(aside);
        if self.turn > 0.75 * PI { across / PI } else { (across + along) / PI }
    }

    /// A plane's, anywhere.
    #[cfg(test)]
    pub(super) fn for_test(position: Vector, radius: f64) -> Self {
        Self { position, normal: [0.0, 0.0, 1.0], side: [1.0, 0.0, 0.0], radius, ..Self::default() }
    }

    /// Square metres.
    pub(super) fn area(&self) -> f64 {
        PI * self.radius * self.radius
    }
}

/// Metres to the nearest surface in some directions, of those up to `most`.
fn nearest(scene: &CompiledScene, from: Vector, directions: &[Vector], most: f64) -> f64 {
    let count = directions.len();
    let origin = from.map(|x| vec![x as f32; count]);
    let columns = [0, 1, 2].map(|axis| directions.iter().map(|direction| direction[axis] as f32).collect::<Vec<f32>>());
    let rays = RayBatch {
        origin: origin.each_ref().map(|x| &x[..]),
        direction: columns.each_ref().map(|x| &x[..]),
        t_min: &vec![0.0; count],
        t_max: &vec![(most / FREE) as f32; count],
        mask: &vec![ray_mask::SHADOW; count],
        time: &[],
        passed: &[],
    };
    let mut hits = Hits::default();
    scene.tables.bvh.first_hit(Execution::Scalar, &rays, false, &mut hits);
    // Lights block nothing.
    let met = hits.t.iter().zip(&hits.instance).filter(|(_, instance)| **instance < scene.tables.first_light_instance);
    met.map(|(t, _)| f64::from(*t)).fold(most / FREE, f64::min)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn disc(turn: f64) -> Disc {
        Disc { normal: [0.0, 0.0, 1.0], side: [1.0, 0.0, 0.0], turn, radius: 0.5, ..Disc::default() }
    }

    fn segment(origin: [f32; 3], direction: [f32; 3]) -> Segment {
        Segment { origin, direction, from: 0.0, to: 10.0 }
    }

    #[test]
    fn planes_are_crossed_from_their_front() {
        let disc = disc(0.0);
        assert_eq!(disc.crossed(&segment([0.4, 0.0, 2.0], [0.0, 0.0, -1.0])), Some((2.0, 1.0)));
        assert_eq!(disc.crossed(&segment([0.6, 0.0, 2.0], [0.0, 0.0, -1.0])), None);
        assert_eq!(disc.crossed(&segment([0.4, 0.0, -2.0], [0.0, 0.0, 1.0])), None);
        assert_eq!(disc.crossed(&Segment { to: 1.9, ..segment([0.4, 0.0, 2.0], [0.0, 0.0, -1.0]) }), None);
    }

    #[test]
    fn cylinders_weigh_light_as_the_mean_of_their_normals_does() {
        for turn in [PI, 0.5 * PI] {
            for (along, aside) in [(0.6, 0.3), (-0.5, 0.7), (0.0, -0.9), (-1.0, 0.0)] {
                let steps = 100_000;
                let cosine = |step: usize| {
                    let angle = turn * ((2.0 * step as f64 + 1.0) / steps as f64 - 1.0);
                    (along * angle.cos() + aside * angle.sin()).max(0.0)
                };
                let mean = (0..steps).map(cosine).sum::<f64>() / steps as f64;
                assert!((disc(turn).turned(along, aside) - mean).abs() < 1e-6, "{turn} {along} {aside}");
            }
        }
    }
}
