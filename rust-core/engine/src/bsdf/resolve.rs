//! From parameters to lobes: layers from the outside in, each taking its albedo at the view from those under it.

use super::diffuse::DiffuseLobe;
use super::energy;
use super::fresnel::{self, Curve};
use super::fuzz::FuzzLobe;
use super::glass::{GlassLobe, Interface};
use super::lobes::{CoatTint, Lobes, Shape, Slot, turned};
use super::microfacet::Widths;
use super::parameter as p;
use super::reflect::ReflectLobe;
use super::surface::{ParameterValues, Surface};
use super::switches::{Anisotropy, Attenuation, CoatPath, EmissionOrder, Fresnel, Fuzz, FuzzAttenuation, FuzzOrder, Metal, Tint};
use gonio_simd::{F, Lanes, M, Rgb, Vec3};

/// The layers' state on the way in.
struct Layers<'a, 'b, L: Lanes> {
    l: L,
    surface: &'a Surface,
    values: &'a ParameterValues<'a>,
    at: usize,
    wo: Vec3<L>,
    /// Cosine of the view, kept off the tables' edge.
    mu: F<L>,
    entering: M<L>,
    /// What the layers above leave.
    weight: Rgb<L>,
    /// Whether a coloured coat stands above.
    coated: bool,
    lobes: &'b mut Lobes<L>,
}

/// The dielectric base at a hit.
struct Base<L: Lanes> {
    /// Roughness r under the coat.
    roughness: F<L>,
    widths: Widths<L>,
    turn: Option<[F<L>; 2]>,
    /// Index that bends transmitted light.
    bending: F<L>,
    /// Reflection from above.
    curve: Curve<L>,
    /// Index that shapes it.
    eta: F<L>,
    /// Its ends.
    ends: [Rgb<L>; 2],
}

impl Surface {
    /// The lobes of the hits from `at` on, seen from `wo` in the shading frame on the viewer's side; `entering` tells the geometric front.
    #[inline(always)]
    pub fn resolve<L: Lanes>(&self, l: L, values: &ParameterValues, at: usize, wo: Vec3<L>, entering: M<L>) -> Lobes<L> {
        let mut lobes = Lobes::empty(l);
        Layers {
            l,
            surface: self,
            values,
            at,
            wo,
            mu: wo.z.clamp(1e-4, 1.0),
            entering,
            weight: Rgb::grey(l.f(1.0)),
            coated: false,
            lobes: &mut lobes,
        }
        .run();
        lobes
    }

    /// What passes straight through towards a light: what opacity leaves open, and smooth thin walls.
    #[inline(always)]
    pub fn transmittance<L: Lanes>(&self, l: L, values: &ParameterValues, at: usize, wo: Vec3<L>, entering: M<L>) -> Rgb<L> {
        if !(self.switches.thin_walled && self.lobes.transmission) {
            let open = if self.lobes.cut_out { 1.0 - values.get(l, p::OPACITY, at).saturate() } else { l.f(0.0) };
            return Rgb::grey(open);
        }
        self.resolve(l, values, at, wo, entering).transmittance(l, wo)
    }
}

impl<L: Lanes> Layers<'_, '_, L> {
    #[inline(always)]
    fn get(&self, offset: usize) -> F<L> {
        self.values.get(self.l, offset, self.at)
    }
    #[inline(always)]
    fn rgb(&self, offset: usize) -> Rgb<L> {
        self.values.rgb(self.l, offset, self.at)
    }
    #[inline(always)]
    fn white(&self) -> Rgb<L> {
        Rgb::grey(self.l.f(1.0))
    }

    #[inline(always)]
    fn run(&mut self) {
        let (set, switches) = (self.surface.lobes, self.surface.switches);
        if set.cut_out {
            self.lobes.opacity = self.get(p::OPACITY).saturate();
        }
        if set.emission && switches.emission_order == EmissionOrder::Top {
            self.lobes.emission = self.rgb(p::EMISSION_COLOR);
        }
        if set.fuzz && switches.fuzz_order == FuzzOrder::Top {
            self.fuzz();
        }
        if set.coat {
            self.coat();
        }
        if set.fuzz && switches.fuzz_order == FuzzOrder::UnderCoat {
            self.fuzz();
        }
        if set.emission && switches.emission_order == EmissionOrder::UnderCoat {
            let tint = match &self.lobes.coat {
                Some(coat) => coat.along(coat.view),
                None => self.white(),
            };
            self.lobes.emission = self.rgb(p::EMISSION_COLOR) * self.weight * tint;
        }
        if set.metal {
            self.metal();
        }
        if set.transmission || set.specular {
            let base = self.base();
            if set.transmission {
                if switches.thin_walled { self.thin_wall(&base) } else { self.glass(&base) }
            }
            if set.specular {
                self.specular(&base);
            }
        }
        if set.diffuse {
            if set.fuzz && switches.fuzz_order == FuzzOrder::UnderSpecular {
                self.fuzz();
            }
            self.diffuse();
        }
    }

    #[inline(always)]
    fn push(&mut self, shape: Shape<L>, weight: Rgb<L>, albedo: Rgb<L>, turn: Option<[F<L>; 2]>, mirrored: bool) {
        let slot = Slot { shape, weight, share: self.l.f(0.0), turn, mirrored, coated: self.coated };
        self.lobes.push(slot, albedo);
    }

    /// Takes a layer's albedo (its share of what reaches it) from what lies under it.
    #[inline(always)]
    fn attenuate(&mut self, albedo: Rgb<L>) {
        let left = match self.surface.switches.attenuation {
            Attenuation::PerChannel => (self.white() - albedo).saturate(),
            Attenuation::LargestChannel => Rgb::grey((1.0 - albedo.max_component()).saturate()),
        };
        self.weight = self.weight * left;
    }

    #[inline(always)]
    fn fuzz(&mut self) {
        let switches = self.surface.switches;
        let roughness = self.get(p::FUZZ_ROUGHNESS).saturate();
        let (lobe, albedo) = match switches.fuzz {
            Fuzz::Zeltner => FuzzLobe::zeltner(self.wo, roughness),
            Fuzz::Charlie => FuzzLobe::charlie(self.wo, roughness),
        };
        let presence = self.get(p::FUZZ_WEIGHT);
        let colour = self.rgb(p::FUZZ_COLOR) * presence;
        self.push(Shape::Fuzz(lobe), self.weight * colour, self.weight * colour * albedo, None, false);
        self.attenuate(match switches.fuzz_attenuation {
            FuzzAttenuation::Grey => Rgb::grey(presence * albedo),
            FuzzAttenuation::Coloured => colour * albedo,
        });
    }

    #[inline(always)]
    fn coat(&mut self) {
        let (l, switches) = (self.l, self.surface.switches);
        let presence = self.get(p::COAT_WEIGHT);
        let roughness = self.get(p::COAT_ROUGHNESS).saturate();
        let ior = self.get(if switches.coat_has_base_ior { p::IOR } else { p::COAT_IOR }).max(1.0);
        let curve = self.dielectric_curve(ior, Rgb::grey(fresnel::normal_reflectance(ior)), self.white());
        let factor = energy::compensation(energy::reflect(l, roughness, self.mu), curve.mean(l));
        let albedo = self.albedo(&curve, factor, roughness) * presence;
        let lobe = ReflectLobe::new(self.wo, Widths::isotropic(roughness * roughness), curve);
        self.push(Shape::Reflect(lobe), self.weight * factor * presence, self.weight * albedo, None, false);
        if switches.coat_darkens {
            self.weight = self.weight * self.darkening(presence, ior, &curve);
        }
        if self.surface.lobes.coat_tint {
            self.coat_tint(presence, ior);
        }
        self.attenuate(albedo);
    }

    #[inline(always)]
    fn coat_tint(&mut self, presence: F<L>, ior: F<L>) {
        let colour = self.rgb(p::COAT_COLOR).max(1e-6);
        let view = (1.0 - (1.0 - self.mu * self.mu) / (ior * ior)).max(1e-4).sqrt().recip();
        let tint = CoatTint { log: Rgb::new(colour.r.ln(), colour.g.ln(), colour.b.ln()), weight: presence, ior, view };
        match self.surface.switches.coat_path {
            CoatPath::Both => {
                self.lobes.coat = Some(tint);
                self.coated = true;
            }
            CoatPath::View => self.weight = self.weight * tint.along(view),
            CoatPath::Flat => self.weight = self.weight * self.white().lerp(colour, presence),
        }
    }

    /// Loss to repeated reflection between base and coat (OpenPBR 1.1, coat darkening).
    #[inline(always)]
    fn darkening(&self, presence: F<L>, ior: F<L>, coat: &Curve<L>) -> Rgb<L> {
        let base = self.rgb(p::BASE_COLOR).saturate();
        let metalness = self.get(p::METALNESS).saturate();
        let passed = self.get(p::TRANSMISSION_WEIGHT).saturate();
        let body = base.lerp(self.rgb(p::SUBSURFACE_COLOR).saturate(), self.get(p::SUBSURFACE_WEIGHT).saturate()) * (1.0 - passed);
        let below = body.lerp(base * self.get(p::METAL_WEIGHT).saturate(), metalness);
        let roughness = self.get(p::ROUGHNESS).saturate();
        let f0 = fresnel::normal_reflectance(self.get(p::IOR)) * self.get(p::SPECULAR_WEIGHT);
        let rough_share = self.l.f(1.0).lerp(roughness, f0.saturate()).lerp(roughness, metalness);
        let diffuse = 1.0 - (1.0 - coat.mean(self.l).r) / (ior * ior);
        let inside = coat.reflectance(self.mu).r.lerp(diffuse, rough_share);
        let kept = Rgb::grey(1.0 - inside) / (self.white() - below * inside);
        self.white().lerp(kept, presence * self.get(p::COAT_DARKENING))
    }

    /// A dielectric's reflection between two colours.
    #[inline(always)]
    fn dielectric_curve(&self, eta: F<L>, f0: Rgb<L>, f90: Rgb<L>) -> Curve<L> {
        match self.surface.switches.fresnel {
            Fresnel::Exact => Curve::Dielectric { eta, f0, f90 },
            Fresnel::Schlick => Curve::Schlick { f0, f90 },
        }
    }

    /// Albedo of a compensated lobe.
    #[inline(always)]
    fn albedo(&self, curve: &Curve<L>, factor: Rgb<L>, roughness: F<L>) -> Rgb<L> {
        let white = energy::reflect(self.l, roughness, self.mu)[0];
        energy::tinted(self.l, curve, roughness, self.mu) * factor * white
    }

    /// Factor for scattering between facets of a reflection, and the lobe's albedo with it.
    #[inline(always)]
    fn glossy(&self, curve: &Curve<L>, roughness: F<L>) -> [Rgb<L>; 2] {
        let tinted = energy::tinted(self.l, curve, roughness, self.mu);
        if !self.surface.switches.multiscatter {
            return [self.white(), tinted];
        }
        let table = energy::reflect(self.l, roughness, self.mu);
        let factor = energy::compensation(table, curve.mean(self.l));
        [factor, tinted * factor * table[0]]
    }

    /// Roughness of the base under the coat.
    #[inline(always)]
    fn base_roughness(&self) -> F<L> {
        let mut roughness = self.get(p::ROUGHNESS).saturate();
        if self.surface.lobes.coat {
            let (presence, coat) = (self.get(p::COAT_WEIGHT), self.get(p::COAT_ROUGHNESS).saturate());
            if self.surface.switches.coat_roughens {
                let widened = (roughness.squared().squared() + coat.squared().squared() * 2.0).min(1.0).sqrt().sqrt();
                roughness = roughness.lerp(widened, presence);
            }
            let affected = self.get(p::COAT_AFFECT_ROUGHNESS) * presence * coat;
            roughness = roughness.lerp(1.0, affected);
        }
        roughness
    }

    /// Widths and turn of metal and specular lobes.
    #[inline(always)]
    fn widths(&self, roughness: F<L>) -> (Widths<L>, Option<[F<L>; 2]>) {
        let alpha = roughness * roughness;
        if !self.surface.lobes.anisotropic {
            return (Widths::isotropic(alpha), None);
        }
        let k = self.get(p::ANISOTROPY);
        let widths = match self.surface.switches.anisotropy {
            Anisotropy::OpenPbr => {
                let q = (1.0 - k).max(1e-3);
                let x = alpha * (2.0 / (q * q + 1.0)).sqrt();
                Widths { x, y: x * q }
            }
            Anisotropy::Principled => Widths::with_aspect(alpha, (1.0 - k.saturate() * 0.9).sqrt()),
            Anisotropy::StandardSurface => Widths::with_aspect(alpha, (1.0 - k.min(0.98)).sqrt()),
            Anisotropy::Gltf => Widths { x: alpha.lerp(1.0, k * k), y: alpha },
            Anisotropy::Glossy => {
                let q = 1.0 - k.abs().min(0.99);
                let (narrow, wide) = (alpha * q, (alpha / q).min(1.0));
                let along = k.ge(0.0);
                Widths { x: along.select(narrow, wide), y: along.select(wide, narrow) }
            }
        };
        if !self.surface.lobes.turned {
            return (widths, None);
        }
        let (sin, cos) = self.get(p::ROTATION).sin_cos_turns();
        (widths, Some([cos, sin]))
    }

    #[inline(always)]
    fn metal(&mut self) {
        let metalness = self.get(p::METALNESS).saturate();
        let (base, edge) = (self.rgb(p::BASE_COLOR).saturate(), self.rgb(p::METAL_EDGE_TINT).saturate());
        let curve = match self.surface.switches.metal {
            Metal::F82 => Curve::f82(base, edge),
            Metal::Conductor => Curve::Conductor { n: self.rgb(p::METAL_N), k: self.rgb(p::METAL_K) },
            Metal::Gulbrandsen => Curve::gulbrandsen(base, edge),
            Metal::Schlick => Curve::Schlick { f0: base, f90: edge },
        };
        let (widths, turn) = self.widths(self.base_roughness());
        let [factor, albedo] = self.glossy(&curve, widths.roughness());
        let weight = self.weight * metalness * self.get(p::METAL_WEIGHT);
        let lobe = ReflectLobe::new(turned(self.wo, turn), widths, curve);
        self.push(Shape::Reflect(lobe), weight * factor, weight * albedo, turn, false);
        self.weight = self.weight * (1.0 - metalness);
    }

    /// The dielectric base: its indices, its reflection and its widths.
    #[inline(always)]
    fn base(&self) -> Base<L> {
        let switches = self.surface.switches;
        let mut ior = self.get(p::IOR).max(1e-5);
        if self.surface.lobes.coat && switches.coat_lowers_ior {
            let relative = ior / self.get(p::COAT_IOR).max(1.0);
            ior = ior.lerp(relative.max(relative.recip()), self.get(p::COAT_WEIGHT));
        }
        let level = self.get(p::SPECULAR_WEIGHT).max(0.0);
        let normal = fresnel::normal_reflectance(ior) * level;
        let root = normal.clamp(0.0, 0.99).sqrt();
        let shaped = (1.0 + root) / (1.0 - root);
        let moved = ior.lt(1.0).select(shaped.recip(), shaped);
        let eta = level.eq(1.0).select(ior, moved);
        let (tint, scale) = (self.rgb(p::SPECULAR_COLOR), self.get(p::SPECULAR_SCALE));
        let ends = match switches.tint {
            Tint::Normal => [(tint * normal).saturate() * scale, Rgb::grey(scale)],
            Tint::WholeLobe => [tint * (normal.min(1.0) * scale), tint * scale],
        };
        let roughness = self.base_roughness();
        let (widths, turn) = self.widths(roughness);
        let curve = match switches.fresnel {
            Fresnel::Exact => Curve::Dielectric { eta, f0: ends[0], f90: ends[1] },
            Fresnel::Schlick => Curve::Schlick { f0: ends[0], f90: ends[1] },
        };
        let bending = if switches.weight_bends { eta } else { ior };
        Base { roughness, widths, turn, bending, curve, eta, ends }
    }

    #[inline(always)]
    fn specular(&mut self, base: &Base<L>) {
        let [factor, albedo] = self.glossy(&base.curve, base.widths.roughness());
        // Equal indices show no interface at all, whatever the tint says of grazing angles.
        let present = (base.eta - 1.0).abs().gt(1e-6);
        let (factor, albedo) = (factor.keep_if(present), albedo.keep_if(present));
        let lobe = ReflectLobe::new(turned(self.wo, base.turn), base.widths, base.curve);
        self.push(Shape::Reflect(lobe), self.weight * factor, self.weight * albedo, base.turn, false);
        self.attenuate(albedo);
    }

    /// Widths of the transmission.
    #[inline(always)]
    fn transmission_widths(&self, base: &Base<L>) -> (Widths<L>, Option<[F<L>; 2]>) {
        let roughness = (base.roughness + self.get(p::TRANSMISSION_EXTRA_ROUGHNESS)).saturate();
        if self.surface.switches.transmission_isotropic { (Widths::isotropic(roughness * roughness), None) } else { self.widths(roughness) }
    }

    #[inline(always)]
    fn glass(&mut self, base: &Base<L>) {
        let l = self.l;
        let presence = self.get(p::TRANSMISSION_WEIGHT).saturate();
        let normal = fresnel::normal_reflectance(base.bending);
        let (tint, scale) = (self.rgb(p::SPECULAR_COLOR), self.get(p::SPECULAR_SCALE));
        let depth = self.get(p::TRANSMISSION_DEPTH).gt(0.0);
        let passed = depth.select(self.white(), self.rgb(p::TRANSMISSION_COLOR).max(0.0));
        // From inside, the tint of a whole lobe stays off: it colours what comes from above.
        let interface = match self.surface.switches.tint {
            Tint::Normal => {
                let f0 = (tint * normal).saturate();
                Interface { eta: base.bending, f0: f0 * scale, f90: Rgb::grey(scale), kept: f0, passed, schlick: false }
            }
            Tint::WholeLobe => {
                let above = self.entering.select(tint, self.white()) * scale;
                Interface { eta: base.bending, f0: above * normal, f90: above, kept: Rgb::grey(normal), passed, schlick: false }
            }
        };
        let eta = self.entering.select(interface.eta, interface.eta.recip());
        let interface = Interface { eta, schlick: self.surface.switches.fresnel == Fresnel::Schlick, ..interface };
        let (widths, turn) = self.transmission_widths(base);
        let mut factor = self.white();
        if self.surface.switches.multiscatter {
            factor = energy::compensation(energy::glass(l, widths.roughness(), self.mu, eta), passed.saturate());
        }
        let weight = self.weight * presence;
        let [reflected, refracted] = interface.split(self.mu);
        let lobe = GlassLobe::new(turned(self.wo, turn), widths, interface);
        self.push(Shape::Glass(lobe), weight * factor, weight * (reflected + refracted), turn, false);
        self.weight = self.weight * (1.0 - presence);
    }

    /// A sheet of dielectric: what its two interfaces reflect and pass in all, at the view's angle (OpenPBR 1.1, thin-walled case).
    #[inline(always)]
    fn thin_wall(&mut self, base: &Base<L>) {
        let presence = self.get(p::TRANSMISSION_WEIGHT).saturate();
        let eta = base.bending.max(1.0);
        let first = base.ends[0].lerp(base.ends[1], fresnel::dielectric_share(self.mu, eta)).saturate();
        let cos = (1.0 - (1.0 - self.mu * self.mu) / (eta * eta)).max(1e-4).sqrt();
        let colour = self.rgb(p::TRANSMISSION_COLOR).saturate().max(1e-6);
        let path = cos.recip();
        let through = Rgb::new(colour.r.pow(path), colour.g.pow(path), colour.b.pow(path));
        let entered = self.white() - first;
        let inner = first * through;
        let passed = through * entered * entered / (self.white() - inner * inner).max(1e-6);
        let reflected = first + passed * inner;
        let weight = self.weight * presence;
        let (widths, turn) = self.transmission_widths(base);
        let spread = (((eta - 1.0) * (eta - 0.5).squared() * 3.4) / (eta * eta * eta)).safe_sqrt();
        let widened = Widths { x: (widths.x * spread).min(1.0), y: (widths.y * spread).min(1.0) };
        for (widths, colour, mirrored) in [(widths, reflected, false), (widened, passed, true)] {
            let [factor, _] = self.glossy(&Curve::One, widths.roughness());
            let lobe = ReflectLobe::new(turned(self.wo, turn), widths, Curve::One);
            self.push(Shape::Reflect(lobe), weight * colour * factor, weight * colour, turn, mirrored);
        }
        self.weight = self.weight * (1.0 - presence);
    }

    #[inline(always)]
    fn diffuse(&mut self) {
        let (set, switches) = (self.surface.lobes, self.surface.switches);
        let mut base = self.deepened(self.rgb(p::BASE_COLOR).max(0.0));
        let mut passed = None;
        if set.subsurface {
            let presence = self.get(p::SUBSURFACE_WEIGHT).saturate();
            let mut inner = self.deepened(self.rgb(p::SUBSURFACE_COLOR).max(0.0));
            if switches.thin_walled {
                let forward = (self.get(p::SUBSURFACE_ANISOTROPY) + 1.0) * 0.5;
                passed = Some(inner * (presence * forward));
                inner = inner * (1.0 - forward);
            }
            base = base.lerp(inner, presence);
        }
        self.diffuse_lobe(base, false);
        if let Some(colour) = passed {
            self.diffuse_lobe(colour, true);
        }
    }

    #[inline(always)]
    fn diffuse_lobe(&mut self, colour: Rgb<L>, mirrored: bool) {
        let lobe = if self.surface.lobes.rough_diffuse {
            DiffuseLobe::rough(self.wo, colour, self.get(p::DIFFUSE_ROUGHNESS).saturate(), self.surface.switches.diffuse)
        } else {
            DiffuseLobe::lambert(colour)
        };
        self.push(Shape::Diffuse(lobe), self.weight, self.weight * colour, None, mirrored);
    }

    /// A colour raised to the power that the coat asks for.
    #[inline(always)]
    fn deepened(&self, colour: Rgb<L>) -> Rgb<L> {
        if !self.surface.lobes.coat {
            return colour;
        }
        let power = self.get(p::COAT_AFFECT_COLOR).mul_add(self.get(p::COAT_WEIGHT), 1.0);
        let deepened = Rgb::new(colour.r.pow(power), colour.g.pow(power), colour.b.pow(power));
        power.eq(1.0).select(colour, deepened)
    }
}
