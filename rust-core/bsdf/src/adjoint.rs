//! The adjoint BSDF: what a surface makes of a path that comes from a light, which carries flux where a camera's path carries importance.
//!
//! Layers take from each other by the *view's* angle, rough lobes give back what facets lose by it, and measured tables need not be reciprocal. So a
//! light path's scattering is evaluated the way a camera path would see it: with the direction towards the camera as the view, on whichever side
//! of the surface that is. Camera paths keep radiance behind an interface without the squared index (`glass.rs`), which flux has. Toon lobes
//! are evaluated the way that the path runs, for no light has them: what the camera sees of them is not where light from the other end would be sent.
//! So is what interfaces let pass where no picture is made, for nothing must get lost of the flux.
//! Shading normals bring the factor of Veach (Robust Monte Carlo Methods, 1997, section 5.3).

use super::lobes::{Asked, evaluate};
use super::normals::Normals;
use super::resolve::Hits;
use super::{BsdfSample, Closure, Lobes, Surface};
use gonio_simd::{F, Lanes, M, Select, Spectrum, Vec3};

/// Cosines below this are those of directions in the plane, of which nothing can be said.
const GRAZING: f32 = 1e-6;

/// A register of hits of light paths: the hits as resolved for the direction towards the light, and the triangle's normal.
#[derive(Clone, Copy, Debug)]
pub struct LightHits<'a, L: Lanes> {
    /// Parameters and, as the view, the direction towards the light.
    pub hits: Hits<'a, 'a, L>,
    /// Unit normal of the triangle in the shading frame, on the light's side.
    pub geometric: Vec3<L>,
    /// Whether interfaces let all flux pass that does not reflect. Else they let pass what camera paths would find, direction by direction, which need
    /// not be the same where they are rough or coated.
    pub whole: bool,
}

impl Surface {
    /// Flux that leaves into unit direction `to`, per solid angle and unit of flux that arrives, without delta lobes. `lobes` are resolved for the
    /// direction towards the light; `room` is written over.
    #[inline(always)]
    pub fn flux<'s, L: Lanes>(
        &'s self,
        l: L,
        light: &LightHits<'s, L>,
        lobes: &Lobes<'s, L>,
        to: Vec3<L>,
        room: &mut Lobes<'s, L>,
    ) -> Spectrum<L> {
        self.resolve_seen(l, light, to, room);
        let mut sum = seen(l, light, to, room, if light.whole { Asked::Swapped } else { Asked::Seen }).0;
        let is_toon = matches!(self.switches.closure, Closure::DiffuseToon | Closure::GlossyToon);
        if is_toon || (light.whole && self.lobes.transmission && to.z.lt(0.0).any()) {
            let along = evaluate(l, lobes, light.hits.wo, to, Asked::Along).0;
            sum += along * bend(light, to);
        }
        sum
    }

    /// The part of [`Self::flux`] that is not of facets and interfaces, and the probability that a camera path which goes the other way has drawn its
    /// direction from such a lobe; `room` is as `flux` left it for the same direction.
    #[inline(always)]
    pub fn flux_diffuse<L: Lanes>(l: L, light: &LightHits<'_, L>, room: &Lobes<'_, L>, to: Vec3<L>) -> (Spectrum<L>, F<L>) {
        let (value, diffuse) = seen(l, light, to, room, Asked::Diffuse);
        let (_, all) = seen(l, light, to, room, Asked::Seen);
        (value, diffuse / all.max(1e-20))
    }

    /// Makes `room` the lobes that a camera path sees which comes from `to`.
    #[inline(always)]
    fn resolve_seen<'s, L: Lanes>(&'s self, l: L, light: &LightHits<'s, L>, to: Vec3<L>, room: &mut Lobes<'s, L>) {
        let behind = to.z.lt(0.0);
        #[allow(clippy::manual_map, reason = "a closure may stay a call outside the level's instructions")]
        let normals = match light.hits.normals {
            Some(normals) => Some(on_side(behind, normals)),
            None => None,
        };
        let entering = light.hits.entering.and_not(behind) | behind.and_not(light.hits.entering);
        self.resolve(l, &Hits { wo: turned(behind, to), entering, normals: normals.as_ref(), ..light.hits }, room);
    }

    /// The throughput factor of a sampled direction for a path from a light.
    #[inline(always)]
    pub fn flux_factor<'s, L: Lanes>(
        &'s self,
        l: L,
        light: &LightHits<'s, L>,
        lobes: &Lobes<'s, L>,
        sample: &BsdfSample<L>,
        room: &mut Lobes<'s, L>,
    ) -> Spectrum<L> {
        let plain = sample.value * sample.pdf.recip();
        let alone = sample.delta | sample.entered;
        let straight = sample.straight | sample.entered;
        let mut delta = plain * straight.select(l.f(1.0), bend(light, sample.wi));
        if !light.whole && self.lobes.transmission && (self.lobes.coat || self.lobes.fuzz) {
            let passed = sample.delta & sample.transmitted.and_not(straight);
            if passed.any() {
                self.resolve_seen(l, light, sample.wi, room);
                let behind = sample.wi.z.lt(0.0);
                let value = room.passed_sharply(l, turned(behind, sample.wi), turned(behind, light.hits.wo));
                delta = passed.select(value * sample.pdf.recip() * bend(light, sample.wi), delta);
            }
        }
        if (alone | sample.pdf.le(0.0)).all() {
            return delta;
        }
        let scattered = self.flux(l, light, lobes, sample.wi, room) * sample.pdf.recip();
        alone.select(delta, scattered)
    }
}

/// Flux per solid angle by what a camera path sees which comes from `to`, and the density with which that path finds the light.
#[inline(always)]
fn seen<L: Lanes>(l: L, light: &LightHits<'_, L>, to: Vec3<L>, room: &Lobes<'_, L>, asked: Asked) -> (Spectrum<L>, F<L>) {
    let (from, behind) = (light.hits.wo, to.z.lt(0.0));
    let (value, density) = evaluate(l, room, turned(behind, to), turned(behind, from), asked);
    (value * ratio(light.geometric.dot(to).abs(), light.geometric.dot(from).abs()), density)
}

/// What bent normals do to flux that leaves `from` for `to`: the cosines about the shading normal in place of those about the triangle's.
#[inline(always)]
fn bend<L: Lanes>(light: &LightHits<'_, L>, to: Vec3<L>) -> F<L> {
    let from = light.hits.wo;
    let shaded = ratio(from.z.abs(), light.geometric.dot(from).abs());
    shaded * ratio(light.geometric.dot(to).abs(), to.z.abs())
}

#[inline(always)]
fn ratio<L: Lanes>(a: F<L>, b: F<L>) -> F<L> {
    (a / b.max(GRAZING)).keep_if(b.gt(GRAZING))
}

/// A vector as the side has it that is looked at.
#[inline(always)]
fn turned<L: Lanes>(behind: M<L>, v: Vec3<L>) -> Vec3<L> {
    behind.select(about_x(v), v)
}

/// The normals beside the shading normal, on the side that is looked at.
#[inline(always)]
fn on_side<L: Lanes>(behind: M<L>, normals: &Normals<L>) -> Normals<L> {
    #[allow(clippy::manual_map, reason = "a closure may stay a call outside the level's instructions")]
    let coat = match normals.coat {
        Some(coat) => Some(other_side(behind, coat)),
        None => None,
    };
    Normals { geometric: other_side(behind, normals.geometric), smooth: other_side(behind, normals.smooth), coat }
}

/// A vector in the shading frame as the surface's other side has it: turned about the tangent.
#[inline(always)]
fn about_x<L: Lanes>(v: Vec3<L>) -> Vec3<L> {
    Vec3::new(v.x, -v.y, -v.z)
}

/// A normal on the side that is looked at: turned round, and seen in the frame of that side.
#[inline(always)]
fn other_side<L: Lanes>(behind: M<L>, normal: Vec3<L>) -> Vec3<L> {
    Vec3::select(behind, about_x(-normal), normal)
}
