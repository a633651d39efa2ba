//! Named settings that the tests share.

use crate::Distribution::{AshikhminShirley, Beckmann, Ggx, MultiGgx};
use crate::parameter as p;
use crate::{Closure, Distribution, Fuzz, Metal, SubsurfaceMethod, Surface, Switches};

/// A setting: places and their values.
pub(super) type Values<'a> = &'a [(usize, &'a [f32])];

/// A surface with defaults, the values written over them.
pub(super) fn surface(switches: Switches, values: Values) -> Surface {
    let mut constants = p::DEFAULTS;
    for (offset, value) in values {
        constants[*offset..offset + value.len()].copy_from_slice(value);
    }
    Surface::new(constants, &[false; p::COUNT], switches)
}

/// Principled with Blender's defaults under the values.
pub(super) fn principled(values: Values) -> Surface {
    let mut all: Vec<(usize, &[f32])> = vec![(p::ROUGHNESS, &[0.5]), (p::COAT_ROUGHNESS, &[0.03]), (p::COAT_IOR, &[1.5])];
    all.extend_from_slice(values);
    surface(Switches::principled(), &all)
}

/// A surface of one lobe.
pub(super) fn single(closure: Closure, values: Values) -> Surface {
    surface(Switches::single(closure), values)
}

/// A glossy lobe with Fresnel 1.
pub(super) fn glossy(colour: [f32; 3], roughness: f32, anisotropy: f32, distribution: Distribution) -> Surface {
    let switches = Switches { distribution, ..Switches::single(Closure::Glossy) };
    surface(switches, &[(p::BASE_COLOR, &colour), (p::ROUGHNESS, &[roughness]), (p::ANISOTROPY, &[anisotropy])])
}

/// Glass of index 1.5.
pub(super) fn glass(roughness: f32, distribution: Distribution) -> Surface {
    coloured_glass(Closure::Glass, 1.0, 1.5, roughness, distribution)
}

/// Glass or refraction alone.
pub(super) fn coloured_glass(closure: Closure, colour: f32, ior: f32, roughness: f32, distribution: Distribution) -> Surface {
    let switches = Switches { distribution, ..Switches::single(closure) };
    surface(switches, &[(p::BASE_COLOR, &[colour; 3]), (p::IOR, &[ior]), (p::ROUGHNESS, &[roughness])])
}

/// Transmission in Blender's terms: the tint of each interface is the root of the colour.
pub(super) fn transmission(colour: [f32; 3], weight: f32, roughness: f32) -> Surface {
    let root = colour.map(f32::sqrt);
    principled(&[
        (p::BASE_COLOR, &colour),
        (p::TRANSMISSION_COLOR, &root),
        (p::TRANSMISSION_WEIGHT, &[weight]),
        (p::ROUGHNESS, &[roughness]),
    ])
}

/// Metallic's default colours, as F82 or as a conductor.
pub(super) fn metallic(metal: Metal, distribution: Distribution) -> Surface {
    let switches = Switches { metal, distribution, ..Switches::single(Closure::Metallic) };
    let values: Values = &[(p::BASE_COLOR, &[0.617, 0.577, 0.540]), (p::METAL_EDGE_TINT, &[0.695, 0.726, 0.770]), (p::ROUGHNESS, &[0.5])];
    surface(switches, values)
}

/// Plain diffuse of colour 0.8.
pub(super) fn diffuse(sigma: f32) -> Surface {
    single(Closure::Diffuse, &[(p::DIFFUSE_ROUGHNESS, &[sigma])])
}

/// A film of 500 nm and index 1.33 on Principled of roughness 0.1.
pub(super) fn filmed(values: Values) -> Surface {
    let mut all: Vec<(usize, &[f32])> =
        vec![(p::ROUGHNESS, &[0.1]), (p::THIN_FILM_WEIGHT, &[1.0]), (p::THIN_FILM_THICKNESS, &[500.0]), (p::THIN_FILM_IOR, &[1.33])];
    all.extend_from_slice(values);
    principled(&all)
}

/// Those of [`all`] that hits do not draw a way inside for: of those, one way tells nothing of the mean.
pub(super) fn undrawn() -> impl Iterator<Item = (&'static str, Surface)> {
    all().into_iter().filter(|(_, surface)| !surface.lobes.drawn)
}

/// One setting of every kind, for the statistical tests.
pub(super) fn all() -> Vec<(&'static str, Surface)> {
    simple().into_iter().chain(fibres()).chain(layered()).collect()
}

/// One lobe each, but for hair.
fn simple() -> Vec<(&'static str, Surface)> {
    vec![
        ("lambert", diffuse(0.0)),
        ("rough diffuse", diffuse(1.0)),
        ("oren-nayar", surface(Switches::standard_surface(), &[(p::SPECULAR_SCALE, &[0.0]), (p::DIFFUSE_ROUGHNESS, &[0.7])])),
        ("glossy", glossy([1.0; 3], 0.5, 0.0, MultiGgx)),
        ("glossy anisotropic", glossy([0.9, 0.6, 0.3], 0.4, 0.8, MultiGgx)),
        ("metal turned", principled(&[(p::METALNESS, &[1.0]), (p::ANISOTROPY, &[0.9]), (p::ROTATION, &[0.1])])),
        ("beckmann", glossy([1.0; 3], 0.5, 0.0, Beckmann)),
        ("beckmann anisotropic", glossy([1.0; 3], 0.6, -0.6, Beckmann)),
        ("ashikhmin-shirley", glossy([1.0; 3], 0.5, 0.0, AshikhminShirley)),
        ("ashikhmin-shirley anisotropic", glossy([1.0; 3], 0.6, 0.7, AshikhminShirley)),
        ("beckmann glass", coloured_glass(Closure::Glass, 0.8, 1.5, 0.5, Beckmann)),
        ("refraction", coloured_glass(Closure::Refraction, 1.0, 1.45, 0.5, Ggx)),
        ("beckmann refraction", coloured_glass(Closure::Refraction, 1.0, 1.45, 0.5, Beckmann)),
        ("translucent", single(Closure::Translucent, &[])),
        ("velvet", surface(Switches { fuzz: Fuzz::Velvet, ..Switches::single(Closure::Sheen) }, &[])),
        // Edges at the borders of the bins that the statistical tests count in.
        ("toon", single(Closure::DiffuseToon, &[(p::TOON_SIZE, &[0.375]), (p::TOON_SMOOTH, &[0.25])])),
        ("toon, wide", single(Closure::DiffuseToon, &[(p::TOON_SIZE, &[0.8]), (p::TOON_SMOOTH, &[0.5])])),
        ("toon, sharp", single(Closure::GlossyToon, &[(p::TOON_SIZE, &[0.5])])),
        ("toon, glossy", single(Closure::GlossyToon, &[(p::TOON_SIZE, &[0.25]), (p::TOON_SMOOTH, &[0.375])])),
    ]
}

/// Hair.
fn fibres() -> Vec<(&'static str, Surface)> {
    vec![
        ("fibre", single(Closure::Hair, &[])),
        ("fibre, white", single(Closure::Hair, &[(p::HAIR_ABSORPTION, &[0.0; 3])])),
        ("fibre, rough", single(Closure::Hair, &[(p::HAIR_VARIANCE, &[4.0, 1.0, 16.0]), (p::HAIR_SCALE, &[1.3, 1.0, 2.0])])),
        (
            "fibre, tinted",
            single(Closure::Hair, &[(p::HAIR_TINT_R, &[0.5, 0.7, 0.9]), (p::HAIR_TINT_TT, &[0.2; 3]), (p::HAIR_TILT, &[0.2])]),
        ),
        ("elliptic fibre", single(Closure::HairElliptic, &[(p::ROUGHNESS, &[0.55])])),
        (
            "elliptic fibre, flat",
            single(
                Closure::HairElliptic,
                &[(p::ROUGHNESS, &[0.7]), (p::HAIR_ASPECT, &[0.6]), (p::HAIR_TURN, &[0.7]), (p::HAIR_TILT, &[0.1])],
            ),
        ),
        (
            "elliptic fibre, white",
            single(Closure::HairElliptic, &[(p::ROUGHNESS, &[0.8]), (p::HAIR_ABSORPTION, &[0.0; 3]), (p::HAIR_ASPECT, &[1.4])]),
        ),
        ("fibre reflects", single(Closure::HairReflection, &[(p::HAIR_WIDTHS, &[0.3, 0.8])])),
        ("fibre passes", single(Closure::HairTransmission, &[(p::HAIR_WIDTHS, &[0.15, 0.6]), (p::HAIR_TILT, &[0.25])])),
    ]
}

/// Films, walks, and layers of several lobes.
fn layered() -> Vec<(&'static str, Surface)> {
    let native = Switches::default();
    let thin = Switches { thin_walled: true, ..native };
    vec![
        ("transparent", single(Closure::Transparent, &[(p::BASE_COLOR, &[0.9, 0.5, 0.2])])),
        ("film on plastic", filmed(&[(p::ROUGHNESS, &[0.5])])),
        ("film on metal", filmed(&[(p::ROUGHNESS, &[0.5]), (p::METALNESS, &[1.0])])),
        ("film on glass", filmed(&[(p::ROUGHNESS, &[0.5]), (p::TRANSMISSION_WEIGHT, &[1.0])])),
        (
            "walk",
            surface(
                Switches { subsurface: SubsurfaceMethod::RandomWalk, ..Switches::principled() },
                &[(p::SUBSURFACE_WEIGHT, &[0.6]), (p::ROUGHNESS, &[0.5])],
            ),
        ),
        ("conductor", metallic(Metal::Conductor, MultiGgx)),
        ("plastic", principled(&[])),
        ("glass", glass(0.5, MultiGgx)),
        ("glass anisotropic", surface(native, &[(p::TRANSMISSION_WEIGHT, &[1.0]), (p::ROUGHNESS, &[0.6]), (p::ANISOTROPY, &[0.5])])),
        ("coated", principled(&[(p::COAT_WEIGHT, &[1.0]), (p::COAT_ROUGHNESS, &[0.2]), (p::COAT_COLOR, &[0.9, 0.5, 0.2])])),
        ("fuzzy", principled(&[(p::FUZZ_WEIGHT, &[1.0]), (p::FUZZ_COLOR, &[1.0, 0.2, 0.2])])),
        ("charlie", surface(Switches::gltf(), &[(p::FUZZ_WEIGHT, &[1.0]), (p::ROUGHNESS, &[0.5])])),
        (
            "everything",
            surface(
                native,
                &[
                    (p::METALNESS, &[0.3]),
                    (p::DIFFUSE_ROUGHNESS, &[0.5]),
                    (p::ROUGHNESS, &[0.4]),
                    (p::ANISOTROPY, &[0.6]),
                    (p::ROTATION, &[0.2]),
                    (p::TRANSMISSION_WEIGHT, &[0.4]),
                    (p::COAT_WEIGHT, &[0.5]),
                    (p::COAT_ROUGHNESS, &[0.3]),
                    (p::COAT_COLOR, &[0.9, 0.5, 0.2]),
                    (p::FUZZ_WEIGHT, &[0.4]),
                ],
            ),
        ),
        (
            "thin wall",
            surface(thin, &[(p::TRANSMISSION_WEIGHT, &[1.0]), (p::ROUGHNESS, &[0.6]), (p::TRANSMISSION_COLOR, &[0.9, 0.7, 0.5])]),
        ),
        ("thin leaf", surface(thin, &[(p::SUBSURFACE_WEIGHT, &[1.0]), (p::SUBSURFACE_ANISOTROPY, &[0.3]), (p::DIFFUSE_ROUGHNESS, &[0.6])])),
    ]
}
