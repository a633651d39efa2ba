//! Spheres and ellipsoids, sampled by the cone of directions that meets them, in the frame where they are unit spheres.

use super::emitter::{Aim, Emitter};
use super::row::{Reader, field};
use gonio_simd::{F, Frame, Lanes, Vec3};

/// Spheres and ellipsoids.
pub(crate) struct Sphere;

/// Density per solid angle of the frame, and 1 − cos of the cone's half angle, for a point at squared distance `squared` from the unit sphere's
/// centre; infinite density inside, from where nothing is seen.
#[inline(always)]
fn cone<L: Lanes>(squared: F<L>) -> (F<L>, F<L>) {
    let l = squared.lanes();
    let outside = squared.gt(1.0);
    let sine_squared = outside.select(squared, l.f(1.0)).recip();
    let one_minus_cosine = sine_squared / ((1.0 - sine_squared).safe_sqrt() + 1.0);
    let density = (one_minus_cosine * std::f32::consts::TAU).recip();
    (outside.select(density, l.f(f32::INFINITY)), one_minus_cosine)
}

impl Emitter for Sphere {
    #[inline(always)]
    fn sample<L: Lanes>(_: L, light: &Reader<'_, L>, p: Vec3<L>, u: [F<L>; 2]) -> Aim<L> {
        let centre = light.in_frame(light.vector(field::ORIGIN) - p);
        let squared = centre.length_squared();
        let (density, one_minus_cosine) = cone(squared);
        let inverse = squared.inverse_root();
        let distance = squared * inverse;
        // 1 − cos itself is drawn, which keeps its digits where the cone is thin.
        let fall = one_minus_cosine * u[0];
        let sine_squared = fall * (2.0 - fall);
        let sine = sine_squared.safe_sqrt();
        let cosine = 1.0 - fall;
        let (sine_turn, cosine_turn) = u[1].sin_cos_turns();
        let frame = Frame::from_normal(centre * inverse);
        let direction = frame.to_world(Vec3::new(sine * cosine_turn, sine * sine_turn, cosine));
        let along = distance * cosine - (1.0 - squared * sine_squared).safe_sqrt();
        let aim = Aim::towards((direction * along).transform(light.frame()));
        Aim { pdf: density * light.solid_angle_ratio(aim.wi), ..aim }
    }
    #[inline(always)]
    fn density<L: Lanes>(l: L, light: &Reader<'_, L>, from: Vec3<L>, wi: Vec3<L>, _: Vec3<L>) -> (F<L>, [F<L>; 2]) {
        let centre = light.in_frame(light.vector(field::ORIGIN) - from);
        let (density, _) = cone(centre.length_squared());
        (density * light.solid_angle_ratio(wi), [l.f(0.0); 2])
    }
}
