//! Settings of a view that stages read: bounce limits, clamps, wanted passes, seed. Nothing changes them during a render.

use super::shutter::Shutter;
use crate::tables::expressions::PathExpressions;
use crate::tables::guiding::GuidingField;
use crate::tables::light_groups::GroupPasses;
use crate::tables::motion_vectors::MotionCameras;
use crate::tables::openings::Openings;
use crate::tables::photons::Photons;
use crate::tables::shader_passes::ShaderPasses;
use crate::words::{counts, event, flag};
use gonio_light::{FixedLightSample, LightCache};
use gonio_simd::{Execution, F, Lanes, M, Spectrum, U, Vec3};
use std::sync::Arc;

/// Settings of a view that stages read, as pbrt's integrators hold them.
#[derive(Clone, Debug)]
pub struct Transport {
    /// How kernels run.
    pub execution: Execution,
    /// How far paths go, and how much a contribution may bring.
    pub limits: Limits,
    /// Whether the camera sees infinite lights.
    pub shows_environment: bool,
    /// Whether they cover the background.
    pub environment_covers: bool,
    /// Which passes (AOVs) are wanted.
    pub passes: Passes,
    /// The camera's position and viewing direction, rebased world space.
    pub eye: [f32; 3],
    /// The camera's viewing direction, see `eye`.
    pub forward: [f32; 3],
    /// Squared index of what the camera stands in, by which what it sees is brighter than what paths carry.
    pub squared_index: f32,
    /// Seed of the random numbers.
    pub seed: u32,
    /// Samples a pixel in the whole render.
    pub samples: u32,
    /// The learned light cache, if there is one: which lights arrive where.
    pub light_cache: Option<Arc<LightCache>>,
    /// The guiding field, if following it pays: where indirect light comes from.
    pub guiding: Option<Arc<GuidingField>>,
    /// Which light counts, by the path that found it.
    pub path_filter: PathFilter,
    /// How light is gathered.
    pub estimator: Estimator,
    /// By light, 1 where light paths bring its caustics; `None` where camera paths look for all of them.
    pub light_paths: Option<Arc<[u32]>>,
    /// The shutter, where anything moves while it is open; else all is seen at the middle of the time.
    pub shutter: Option<Arc<Shutter>>,
    /// Photons that camera paths take up behind mirrors and smooth glass.
    pub photons: Option<Arc<Photons>>,
    /// How the light of light paths comes to where paths start.
    pub first_light: FirstLight,
}

/// How the light of light paths comes to where other paths start; elsewhere these take up photons.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum FirstLight {
    /// As splats: the camera sees the surface directly.
    #[default]
    Splats,
    /// As photons: the surface is baked.
    Photons,
    /// Not at all: what crosses a disc about a meter is added up apart. What a luminance meter sees takes up photons.
    Discs,
}

/// Least share of a pixel's width that images are looked up over: less is sharper by little and reads many more tiles.
const LEAST_LOOKUP: f32 = 0.25;

impl Transport {
    /// The share of a pixel's width that each sample looks images up over, as many samples see it (pbrt-v4 does likewise): all of it would blur twice.
    pub(crate) fn lookup_width(&self) -> f32 {
        #[allow(clippy::cast_precision_loss, reason = "a root of a count")]
        let samples = self.samples.max(1) as f32;
        samples.sqrt().recip().max(LEAST_LOOKUP)
    }

    /// Where light that a camera path found is left by light paths: mirrors or smooth glass sent it on last, and light paths
    /// bring what they do to the surface before; or they bring all that comes straight to it. Each path of light so belongs to one technique.
    #[inline(always)]
    pub(crate) fn is_left_to_light_paths<L: Lanes>(&self, flags: U<L>, light: U<L>, found: M<L>) -> M<L> {
        let l = flags.lanes();
        let Some(left) = &self.light_paths else { return l.m(false) };
        let theirs = found & (is_caustic(flags) | (flags & flag::DIRECT_LEFT).ne(0));
        if theirs.any() { theirs & l.gather_integers(left, light.keep_if(theirs)).ne(0) } else { theirs }
    }
}

/// Whether mirrors or smooth glass stand between a path's end and the last surface to which light paths bring light.
#[inline(always)]
fn is_caustic<L: Lanes>(flags: U<L>) -> M<L> {
    (flags & (flag::LEFT_TO_LIGHT_PATHS | flag::DELTA)).eq(flag::LEFT_TO_LIGHT_PATHS | flag::DELTA) & !(flags >> flag::BOUNCE_SHIFT).lt(2)
}

/// How light is gathered.
#[derive(Clone, Debug)]
pub enum Estimator {
    /// Along paths: a light and a direction at random at each vertex.
    Paths,
    /// Along paths that end at the first surface which is neither mirror nor smooth glass: what light paths cannot bring, as the rest is theirs.
    Seen,
    /// By trees of rays (Whitted): these light samples at every point, and all specular ways. The specular trees that guide denoisers have no
    /// samples, as they end where lights would be sampled.
    Trees(Arc<[FixedLightSample]>),
}

/// How far paths go, and how much a contribution may bring.
#[derive(Clone, Copy, Debug)]
pub struct Limits {
    /// Most bounces: scatterings after the first surface.
    pub max_bounces: u32,
    /// The same by kind: diffuse, glossy, transmitted, straight through; at most 255.
    pub kind_bounces: [u32; 4],
    /// The same in media.
    pub volume_bounces: u32,
    /// Limits of direct and indirect contributions, as means of their channels; 0 is off.
    pub clamps: [f32; 2],
    /// Whether paths that were scattered diffusely last meet reflection off facets, and refraction (Cycles' switches of caustics).
    pub caustics: [bool; 2],
    /// Up to this roughness refraction shows what is behind the scene as the camera itself does, where that is transparent; none where negative.
    pub clear_roughness: f32,
}

impl Limits {
    /// A contribution within the user's limits against fireflies (Cycles' clamping). Light that surfaces scatter once at most on its way from
    /// the lamp to the camera is direct; `scattered` counts.
    #[inline(always)]
    pub(crate) fn clamped<L: Lanes>(&self, value: Spectrum<L>, scattered: U<L>) -> Spectrum<L> {
        if !self.clamps_any() {
            return value;
        }
        let (mean, limit) = (value.abs().mean(), self.ceiling(scattered));
        value * mean.gt(limit).select(limit / mean, mean.lanes().f(1.0))
    }
    /// Whether there is such a limit.
    pub(crate) fn clamps_any(&self) -> bool {
        self.clamps.iter().any(|clamp| *clamp > 0.0)
    }
    /// The most that a contribution may come to in the mean of its channels.
    #[inline(always)]
    pub(crate) fn ceiling<L: Lanes>(&self, scattered: U<L>) -> F<L> {
        let l = scattered.lanes();
        let [direct, indirect] = self.clamps.map(|clamp| if clamp > 0.0 { clamp } else { f32::MAX });
        scattered.lt(2).select(l.f(direct), l.f(indirect))
    }

    /// Whether the bounces of each kind are within their limits.
    #[inline(always)]
    pub(crate) fn allow<L: Lanes>(&self, counts: U<L>, bounces: U<L>) -> M<L> {
        let within = |kind: u32| counts::of(counts, kind).lt(self.kind_bounces[kind as usize] + 1);
        let on_surfaces = within(event::DIFFUSE) & within(event::GLOSSY) & within(event::TRANSMISSION);
        let most = self.volume_bounces;
        if most < 255 { on_surfaces & counts::in_media(counts, bounces).lt(most + 1) } else { on_surfaces }
    }

    /// Whether the number of surfaces that light goes straight through is limited.
    pub(crate) fn counts_straight(&self) -> bool {
        self.kind_bounces[3] < 255
    }

    /// How many surfaces light may still go straight through, after so many.
    pub(crate) fn straight_left(&self, gone: u32) -> u32 {
        self.kind_bounces[3].saturating_sub(gone)
    }

    /// Whether a path may go straight through one more surface.
    #[inline(always)]
    pub(crate) fn allow_straight<L: Lanes>(&self, counts: U<L>) -> M<L> {
        counts::straight(counts).lt(self.kind_bounces[3])
    }
}

/// Which light counts, by the path that found it. A path is specular while it has met nothing but mirrors and smooth glass.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum PathFilter {
    /// All of it.
    #[default]
    All,
    /// Light on specular paths; paths end at other surfaces.
    SpecularOnly,
    /// Light on all other paths.
    ExceptSpecular,
}

/// Which passes (AOVs) are wanted, beyond those that are always summed.
#[derive(Clone, Debug, Default)]
pub struct Passes {
    /// Depth, normal, position and albedo.
    pub surface: bool,
    /// Texture coordinates.
    pub uv: bool,
    /// The camera at the frames that motion vectors go between.
    pub motion: Option<Arc<MotionCameras>>,
    /// Start, depth and falloff of the mist.
    pub mist: Option<Mist>,
    /// Albedo and normal for denoisers.
    pub guides: bool,
    /// With the guides, the light on specular paths: that of trees of rays has no noise, that of samples has.
    pub specular: bool,
    /// Illuminance.
    pub illuminance: bool,
    /// Numbers and pass indices of instances and materials.
    pub numbers: bool,
    /// Rays by pixel.
    pub effort: bool,
    /// Names of instances and materials, for cryptomattes.
    pub mattes: bool,
    /// How far first surfaces are, for deep pictures.
    pub deep: Option<Distance>,
    /// What materials compute for passes of their own.
    pub shader: ShaderPasses,
    /// Light path expressions that are followed along paths.
    pub expressions: Option<Arc<PathExpressions>>,
    /// Openings that are followed along paths; never together with expressions.
    pub openings: Option<Arc<Openings>>,
    /// Which groups of lights are summed apart.
    pub groups: GroupPasses,
}

impl Transport {
    /// Metres of places from the camera, as deep pictures have them.
    #[inline(always)]
    pub(crate) fn deep_depth<L: Lanes>(&self, distance: Distance, place: Vec3<L>) -> F<L> {
        let l = place.x.lanes();
        let from_eye = place - Vec3::splat(l, self.eye);
        match distance {
            Distance::AlongAxis => from_eye.dot(Vec3::splat(l, self.forward)),
            Distance::FromEye => from_eye.length(),
        }
    }
}

/// What depths of deep pictures are, metres.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Distance {
    /// Along the camera's axis.
    AlongAxis,
    /// From the eye, where pictures look all around.
    FromEye,
}

/// The mist pass: metres at which it starts, metres until it is full, exponent.
#[derive(Clone, Copy, Debug, Default)]
pub struct Mist {
    /// Metres from the camera at which it starts.
    pub start: f32,
    /// Metres from there until it is full.
    pub depth: f32,
    /// Exponent of the share of the way.
    pub falloff: f32,
}
