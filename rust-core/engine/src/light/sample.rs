//! Drawing a direction towards the lights, and weighing the directions that others drew.

use super::cylinder::Cylinder;
use super::disk::Disk;
use super::emitter::{Aim, Emitter};
use super::facing_disk::{self, FacingDisk};
use super::portal::Portals;
use super::projected_area::per_area;
use super::record::LightKind;
use super::rectangle::Rectangle;
use super::row::{Reader, field, flag};
use super::shaping::shaping;
use super::sphere::Sphere;
use super::table::{InfiniteLight, LightTable};
use super::tree::KnownLights;
use super::triangle::Triangle;
use super::{distant, dome};
use gonio_simd::{F, Lanes, M, Rgb, U, Vec3};

/// Light that may arrive at a point.
#[derive(Clone, Copy, Debug)]
pub struct LightSample<L: Lanes> {
    /// Unit direction to the light.
    pub wi: Vec3<L>,
    /// Way to the light's point in metres, `f32::MAX` for infinite lights.
    pub distance: F<L>,
    /// Radiance towards the point with shaping and texture, zero where `pdf` is; for delta lights the illuminance on a facing surface.
    pub radiance: Rgb<L>,
    /// Density per solid angle times the probability of the choice; for delta lights that probability alone. Zero where nothing arrives.
    pub pdf: F<L>,
    /// Lights that no ray from here can hit: the sample stands for all of their light.
    pub delta: M<L>,
    /// Index of the light.
    pub light: U<L>,
    /// Whether things block the light.
    pub casts_shadow: M<L>,
}

/// Share of the power heuristic for the first of two densities, safe for any magnitude.
#[inline(always)]
pub fn power_heuristic<L: Lanes>(own: F<L>, other: F<L>) -> F<L> {
    let ratio = other / own.max(f32::MIN_POSITIVE);
    (ratio * ratio + 1.0).recip()
}

impl LightTable {
    /// Draws a light, among those `known` to arrive there if that was learned, and a direction to it from point `p` with normal `n` (unit; zero where there is no surface, as in a volume), for `u_choice` and `u` in
    /// `[0, 1)`.
    #[inline(always)]
    pub fn sample<L: Lanes>(
        &self,
        l: L,
        known: Option<&KnownLights>,
        p: Vec3<L>,
        n: Vec3<L>,
        u_choice: F<L>,
        u: [F<L>; 2],
    ) -> LightSample<L> {
        if self.count == 0 {
            return LightSample::nothing(l);
        }
        let chosen = self.choose(l, known, p, n, u_choice);
        self.sample_chosen(l, chosen, p, n, u)
    }

    /// Draws a direction to a light that has been chosen with some probability.
    #[inline(always)]
    pub(crate) fn sample_chosen<L: Lanes>(&self, l: L, chosen: (U<L>, F<L>), p: Vec3<L>, n: Vec3<L>, u: [F<L>; 2]) -> LightSample<L> {
        let light = self.reader(l, chosen.0);
        // What all lanes share is known to be so all the way down: no gathers, no kind of light but one.
        match light.common() {
            Some(common) => self.sample_row(l, &common, chosen, p, n, u),
            None => self.sample_row(l, &light, chosen, p, n, u),
        }
    }

    #[inline(always)]
    fn sample_row<L: Lanes>(
        &self,
        l: L,
        light: &Reader<'_, L>,
        (index, probability): (U<L>, F<L>),
        p: Vec3<L>,
        n: Vec3<L>,
        u: [F<L>; 2],
    ) -> LightSample<L> {
        let infinite = light.flag(flag::INFINITE);
        let mut aim = Aim { wi: Vec3::splat(l, [0.0, 0.0, 1.0]), distance: l.f(f32::MAX), pdf: l.f(0.0), uv: [l.f(0.0); 2] };
        self.aim_near(l, light, p, u, &mut aim);
        self.aim_far(l, light, index, [p, n], u, infinite, &mut aim);
        let sent = self.emitted(l, light, aim.wi, aim.uv);
        let point = light.is_kind(LightKind::Point);
        let radiance = if point.any() {
            let squared = (aim.distance * aim.distance).max(f32::MIN_POSITIVE);
            point.select(sent * squared.recip(), sent)
        } else {
            sent
        };
        let pdf = aim.pdf * probability;
        let facing = light.is_kind(LightKind::FacingDisk);
        let enclosed = if facing.any() { facing & facing_disk::encloses(light, p) } else { facing };
        let valid = pdf.gt(0.0) & pdf.is_finite() & aim.distance.gt(0.0) & self.faces(light, p, aim.wi) & light.flag(flag::LIT);
        LightSample {
            wi: valid.select(aim.wi, Vec3::splat(l, [0.0, 0.0, 1.0])),
            distance: valid.select(aim.distance, l.f(f32::MAX)),
            radiance: radiance.keep_if(valid),
            pdf: pdf.keep_if(valid),
            delta: light.flag(flag::DELTA) | enclosed,
            light: index,
            casts_shadow: light.flag(flag::CASTS_SHADOW),
        }
    }

    /// Aims at lights that have a place.
    #[inline(always)]
    fn aim_near<L: Lanes>(&self, l: L, light: &Reader<'_, L>, p: Vec3<L>, u: [F<L>; 2], aim: &mut Aim<L>) {
        self.aim_kind(
            LightKind::Rectangle,
            light,
            aim,
            #[inline(always)]
            || Rectangle::sample(l, light, p, u),
        );
        self.aim_kind(
            LightKind::Disk,
            light,
            aim,
            #[inline(always)]
            || Disk::sample(l, light, p, u),
        );
        self.aim_kind(
            LightKind::Sphere,
            light,
            aim,
            #[inline(always)]
            || Sphere::sample(l, light, p, u),
        );
        self.aim_kind(
            LightKind::Cylinder,
            light,
            aim,
            #[inline(always)]
            || Cylinder::sample(l, light, p, u),
        );
        self.aim_kind(
            LightKind::Triangle,
            light,
            aim,
            #[inline(always)]
            || Triangle::sample(l, light, p, u),
        );
        self.aim_kind(
            LightKind::FacingDisk,
            light,
            aim,
            #[inline(always)]
            || FacingDisk::sample(l, light, p, u),
        );
        self.aim_kind(
            LightKind::Point,
            light,
            aim,
            #[inline(always)]
            || Aim { pdf: l.f(1.0), ..Aim::towards(light.vector(field::ORIGIN) - p) },
        );
    }

    /// Runs one kind's sampling where some lane has it.
    #[inline(always)]
    fn aim_kind<L: Lanes>(&self, kind: LightKind, light: &Reader<'_, L>, aim: &mut Aim<L>, sample: impl FnOnce() -> Aim<L>) {
        if !self.has(kind) {
            return;
        }
        if let Some(common) = light.common_kind() {
            if common == kind as u32 {
                *aim = sample();
            }
            return;
        }
        let of_kind = light.is_kind(kind);
        if of_kind.any() {
            let new = sample();
            aim.wi = of_kind.select(new.wi, aim.wi);
            aim.distance = of_kind.select(new.distance, aim.distance);
            aim.pdf = of_kind.select(new.pdf, aim.pdf);
            aim.uv = [of_kind.select(new.uv[0], aim.uv[0]), of_kind.select(new.uv[1], aim.uv[1])];
        }
    }

    /// Aims at infinite lights.
    #[inline(always)]
    #[expect(clippy::too_many_arguments, reason = "one stage of sampling, with its whole state")]
    fn aim_far<L: Lanes>(
        &self,
        l: L,
        light: &Reader<'_, L>,
        index: U<L>,
        [p, n]: [Vec3<L>; 2],
        u: [F<L>; 2],
        infinite: M<L>,
        aim: &mut Aim<L>,
    ) {
        if !infinite.any() {
            return;
        }
        if self.has(LightKind::Distant) {
            let of_kind = light.is_kind(LightKind::Distant);
            let (wi, pdf) = distant::sample(l, light, u);
            aim.wi = of_kind.select(wi, aim.wi);
            aim.pdf = of_kind.select(pdf, aim.pdf);
        }
        for infinite in self.infinite.iter().filter(|infinite| infinite.kind == LightKind::Dome) {
            let chosen = index.eq(infinite.light);
            if !chosen.any() {
                continue;
            }
            let (wi, pdf, place) = match self.portals_at(l, p) {
                Some(portals) => self.aim_at_dome_through(l, infinite, &portals, [p, n], u),
                None => self.aim_at_dome(l, infinite, n, u),
            };
            aim.wi = chosen.select(wi, aim.wi);
            aim.pdf = chosen.select(pdf, aim.pdf);
            aim.uv = [chosen.select(place[0], aim.uv[0]), chosen.select(place[1], aim.uv[1])];
        }
    }

    /// A direction to a dome by its own brightness, its density and its place in the image.
    #[inline(always)]
    fn aim_at_dome<L: Lanes>(&self, l: L, infinite: &InfiniteLight, n: Vec3<L>, u: [F<L>; 2]) -> (Vec3<L>, F<L>, [F<L>; 2]) {
        match &infinite.distribution {
            Some(distribution) => {
                let (local, pdf, place) = distribution.sample(l, u);
                (local.transform(self.reader(l, l.u(infinite.light)).frame()), pdf, place)
            }
            None => {
                let (wi, pdf) = dome::sample_constant(l, n, u);
                (wi, pdf, [l.f(0.0); 2])
            }
        }
    }

    /// The same where some directions go through portals.
    #[inline(always)]
    fn aim_at_dome_through<L: Lanes>(
        &self,
        l: L,
        infinite: &InfiniteLight,
        portals: &Portals<L>,
        [p, n]: [Vec3<L>; 2],
        u: [F<L>; 2],
    ) -> (Vec3<L>, F<L>, [F<L>; 2]) {
        let (through, of_portal, of_dome) = self.split_by_portal(portals, u[0]);
        let (wi, _, _) = self.aim_at_dome(l, infinite, n, [of_dome, u[1]]);
        let wi = through.select(self.aim_through_portal(l, portals, p, [of_portal, u[1]]), wi);
        let (pdf, place) = self.dome_density(l, infinite, n, wi);
        (wi, self.portal_density(l, portals, p, wi, pdf), place)
    }

    /// Density of a direction to a dome by its own brightness, and its place in the image.
    #[inline(always)]
    fn dome_density<L: Lanes>(&self, l: L, infinite: &InfiniteLight, n: Vec3<L>, wi: Vec3<L>) -> (F<L>, [F<L>; 2]) {
        match &infinite.distribution {
            Some(distribution) => {
                let local = self.reader(l, l.u(infinite.light)).in_frame(wi);
                let place = dome::place(local);
                (distribution.pdf(l, local, place), place)
            }
            None => (dome::pdf_constant(l, n, wi), [l.f(0.0); 2]),
        }
    }

    /// Whether a flat light's emitting side looks at the point that sees it along `wi`; other lights are kept by their densities.
    #[inline(always)]
    fn faces<L: Lanes>(&self, light: &Reader<'_, L>, from: Vec3<L>, wi: Vec3<L>) -> M<L> {
        let one_sided = light.flag(flag::FLAT).and_not(light.flag(flag::TWO_SIDED));
        if !one_sided.any() {
            return !one_sided;
        }
        let normal = light.vector(field::NORMAL);
        let in_front = normal.dot(from - light.vector(field::ORIGIN)).gt(0.0) & normal.dot(wi).lt(0.0);
        !one_sided | in_front
    }

    /// Radiance sent against `wi`, with shaping and texture.
    #[inline(always)]
    pub(super) fn emitted<L: Lanes>(&self, l: L, light: &Reader<'_, L>, wi: Vec3<L>, uv: [F<L>; 2]) -> Rgb<L> {
        let plain = light.colour(field::RADIANCE);
        let shaped = plain * (shaping(l, light, -wi, l.m(true)) * self.measured(l, light, -wi) * per_area(l, light, -wi));
        let width = light.integer(field::TEXTURE_WIDTH);
        let textured = width.ne(0);
        if !textured.any() {
            return shaped;
        }
        let (first, height) = (light.integer(field::TEXTURE), light.integer(field::TEXTURE_HEIGHT));
        let size = [width.max(1), height.max(1)];
        let dome = textured & light.is_kind(LightKind::Dome);
        let flat = textured.and_not(light.is_kind(LightKind::Dome));
        let mut image = Rgb::grey(l.f(1.0));
        if flat.any() {
            image = flat.select(self.textures.lookup(l, first, size, uv, false), image);
        }
        if dome.any() {
            image = dome.select(self.textures.lookup(l, first, size, uv, true), image);
        }
        shaped * image
    }

    /// Radiance towards `from` of the light's point `hit` that a ray along unit `wi` met, and the density with which [`Self::sample`] at `from` with
    /// normal `n` would have drawn it. Both zero outside `mask`, on sides that do not emit, and for lights that rays cannot hit.
    #[inline(always)]
    #[expect(clippy::too_many_arguments, reason = "a hit seen from a vertex")]
    pub fn eval_hit<L: Lanes>(
        &self,
        l: L,
        known: Option<&KnownLights>,
        light: U<L>,
        from: Vec3<L>,
        n: Vec3<L>,
        wi: Vec3<L>,
        hit: Vec3<L>,
        mask: M<L>,
    ) -> (Rgb<L>, F<L>) {
        if self.count == 0 || !mask.any() {
            return (Rgb::zero(l), l.f(0.0));
        }
        // Lanes left out follow the first one left in, so that they do not spoil a light common to all others.
        let index = mask.select(light, l.u(light.to_array()[mask.bits().trailing_zeros() as usize]));
        let light = self.reader(l, index);
        let mut density = (l.f(0.0), [l.f(0.0); 2]);
        self.density_kind(
            LightKind::Rectangle,
            &light,
            &mut density,
            #[inline(always)]
            || Rectangle::density(l, &light, from, wi, hit),
        );
        self.density_kind(
            LightKind::Disk,
            &light,
            &mut density,
            #[inline(always)]
            || Disk::density(l, &light, from, wi, hit),
        );
        self.density_kind(
            LightKind::Sphere,
            &light,
            &mut density,
            #[inline(always)]
            || Sphere::density(l, &light, from, wi, hit),
        );
        self.density_kind(
            LightKind::Cylinder,
            &light,
            &mut density,
            #[inline(always)]
            || Cylinder::density(l, &light, from, wi, hit),
        );
        self.density_kind(
            LightKind::Triangle,
            &light,
            &mut density,
            #[inline(always)]
            || Triangle::density(l, &light, from, wi, hit),
        );
        self.density_kind(
            LightKind::FacingDisk,
            &light,
            &mut density,
            #[inline(always)]
            || FacingDisk::density(l, &light, from, wi, hit),
        );
        let (pdf, uv) = density;
        let valid = mask & pdf.gt(0.0) & pdf.is_finite() & self.faces(&light, from, wi) & light.flag(flag::LIT);
        let probability = self.choice_probability(l, known, from, n, index);
        (self.emitted(l, &light, wi, uv).keep_if(valid), (pdf * probability).keep_if(valid))
    }

    /// Runs one kind's density where some lane has it.
    #[inline(always)]
    fn density_kind<L: Lanes>(
        &self,
        kind: LightKind,
        light: &Reader<'_, L>,
        density: &mut (F<L>, [F<L>; 2]),
        evaluate: impl FnOnce() -> (F<L>, [F<L>; 2]),
    ) {
        if !self.has(kind) {
            return;
        }
        let of_kind = light.is_kind(kind);
        if of_kind.any() {
            let (pdf, uv) = evaluate();
            density.0 = of_kind.select(pdf, density.0);
            density.1 = [of_kind.select(uv[0], density.1[0]), of_kind.select(uv[1], density.1[1])];
        }
    }

    /// Light that a ray from `from` (normal `n` there, zero where there is no surface) along unit `wi` meets on leaving the scene: the sum of the infinite
    /// lights' radiances, each times its power-heuristic weight against `bsdf_pdf`. The weight is 1 where the ray is a camera ray (`first`,
    /// which sees visible lights alone) or was sent by a delta lobe (`delta`). Of `only` one of them, where that is asked for.
    #[inline(always)]
    #[expect(clippy::too_many_arguments, reason = "a ray and how it came to be")]
    pub fn escaped<L: Lanes>(
        &self,
        l: L,
        known: Option<&KnownLights>,
        from: Vec3<L>,
        n: Vec3<L>,
        wi: Vec3<L>,
        bsdf_pdf: F<L>,
        first: M<L>,
        delta: M<L>,
        only: Option<u32>,
    ) -> Rgb<L> {
        let mut sum = Rgb::zero(l);
        for infinite in self.infinite.iter().filter(|infinite| only.is_none_or(|only| infinite.light == only)) {
            let (radiance, pdf) = self.infinite_radiance(l, infinite, [from, n], wi);
            let weighed = (!(first | delta)) & pdf.gt(0.0);
            let mut weight = l.f(1.0);
            if weighed.any() {
                let pdf = pdf * self.choice_probability(l, known, from, n, l.u(infinite.light));
                weight = weighed.select(power_heuristic(bsdf_pdf, pdf), weight);
            }
            let seen = (first & l.m(infinite.visible)) | l.m(infinite.scattered).and_not(first);
            sum += (radiance * weight).keep_if(seen);
        }
        sum
    }

    /// Radiance of one infinite light along `wi` and the density of its sampling.
    #[inline(always)]
    fn infinite_radiance<L: Lanes>(&self, l: L, infinite: &InfiniteLight, [from, n]: [Vec3<L>; 2], wi: Vec3<L>) -> (Rgb<L>, F<L>) {
        let light = self.reader(l, l.u(infinite.light));
        if infinite.kind == LightKind::Distant {
            let (inside, density) = distant::density(&light, wi);
            return (light.colour(field::RADIANCE).keep_if(inside), density.keep_if(inside));
        }
        let (mut pdf, place) = self.dome_density(l, infinite, n, wi);
        if let Some(portals) = self.portals_at(l, from) {
            pdf = self.portal_density(l, &portals, from, wi, pdf);
        }
        let textured = infinite.distribution.is_some();
        (if textured { self.emitted(l, &light, wi, place) } else { light.colour(field::RADIANCE) }, pdf)
    }
}

impl<L: Lanes> LightSample<L> {
    /// No light.
    #[inline(always)]
    fn nothing(l: L) -> Self {
        Self {
            wi: Vec3::splat(l, [0.0, 0.0, 1.0]),
            distance: l.f(f32::MAX),
            radiance: Rgb::zero(l),
            pdf: l.f(0.0),
            delta: l.m(false),
            light: l.u(0),
            casts_shadow: l.m(true),
        }
    }
}
