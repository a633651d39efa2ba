//! Parameters at the ends of their ranges: no model makes light of them, or something that is no number.

use super::harness::{View, spread};
use super::rows::surface;
use crate::parameter::{self as p, NAMES, Parameter};
use crate::{Closure, Distribution, Fuzz, Metal, SubsurfaceMethod, Switches};

/// All models, with the layers that a surface can have.
fn models() -> Vec<(String, Switches)> {
    let layered = [
        ("openpbr", Switches::default()),
        ("openpbr walk", Switches { subsurface: SubsurfaceMethod::RandomWalk, ..Switches::default() }),
        ("openpbr thin", Switches { thin_walled: true, ..Switches::default() }),
        ("principled", Switches::principled()),
        ("preview surface", Switches::preview_surface()),
        ("standard surface", Switches::standard_surface()),
        ("gltf", Switches::gltf()),
    ];
    use Closure as C;
    let single = [
        C::Diffuse,
        C::Glossy,
        C::Glass,
        C::Refraction,
        C::Metallic,
        C::Sheen,
        C::DiffuseToon,
        C::GlossyToon,
        C::Translucent,
        C::Subsurface,
        C::Transparent,
        C::Hair,
        C::HairReflection,
        C::HairTransmission,
    ];
    let mut all: Vec<(String, Switches)> = layered.map(|(name, switches)| (name.to_owned(), switches)).into();
    all.extend(single.map(|closure| (format!("{closure:?}"), Switches::single(closure))));
    all.push(("conductor".into(), Switches { metal: Metal::Conductor, ..Switches::single(C::Metallic) }));
    all.push(("velvet".into(), Switches { fuzz: Fuzz::Velvet, ..Switches::single(C::Sheen) }));
    all.push(("beckmann".into(), Switches { distribution: Distribution::Beckmann, ..Switches::single(C::Glossy) }));
    all
}

#[test]
fn no_parameter_makes_light_or_is_no_number() {
    let numbers = spread(1 << 9);
    // Everything there at once, so that each parameter has something to act on.
    let layers: [(usize, &[f32]); 7] = [
        (p::METALNESS, &[0.3]),
        (p::TRANSMISSION_WEIGHT, &[0.3]),
        (p::SUBSURFACE_WEIGHT, &[0.3]),
        (p::COAT_WEIGHT, &[0.5]),
        (p::FUZZ_WEIGHT, &[0.3]),
        (p::THIN_FILM_WEIGHT, &[0.5]),
        (p::ANISOTROPY, &[0.3]),
    ];
    let mut failures = Vec::new();
    for (name, switches) in models() {
        // What passes straight is coloured at will.
        let at_will = |parameter: &Parameter| switches.closure == Closure::Transparent && parameter.offset == p::BASE_COLOR;
        for parameter in NAMES.iter().filter(|parameter| parameter.offset != p::EMISSION_COLOR && !at_will(parameter)) {
            for wanted in [f32::NEG_INFINITY, f32::INFINITY, 255.0, 1e-40] {
                let range = parameter.range_of(&switches, false);
                let value: Vec<f32> = (0..parameter.width()).map(|place| parameter.held(place, wanted, range)).collect();
                let mut values: Vec<(usize, &[f32])> = layers.into();
                values.push((parameter.offset, &value));
                let surface = surface(switches, &values);
                for (angle, entering) in [(10.0, true), (75.0, false)] {
                    let view = View::new(&surface, angle, entering);
                    let mut sum = [0.0f64; 3];
                    for sample in view.sample(&numbers).iter().filter(|sample| sample.pdf.is_nan() || sample.pdf > 0.0) {
                        (0..3).for_each(|c| sum[c] += f64::from(sample.value[c] / sample.pdf) / numbers.len() as f64);
                    }
                    let most = sum.iter().copied().fold(0.0, |most: f64, x| if x.is_nan() { f64::NAN } else { most.max(x) });
                    if !(most < 1.05 && sum.iter().all(|x| *x >= 0.0)) {
                        failures.push(format!("{name}, {} {wanted} ({value:?}) at {angle}: {sum:.4?}", parameter.name));
                    }
                }
            }
        }
    }
    assert!(failures.is_empty(), "{} failures\n{}", failures.len(), failures.join("\n"));
}

#[test]
fn values_are_held_and_defaults_lie_within() {
    for parameter in NAMES {
        for (place, default) in parameter.default.iter().enumerate() {
            assert_eq!(parameter.held(place, *default, parameter.range), *default, "{}", parameter.name);
            assert_eq!(parameter.held(place, f32::NAN, parameter.range), *default);
        }
        let [low, high] = parameter.range;
        assert!(low < high && low.is_finite() && high.is_finite());
        assert_eq!([f32::NEG_INFINITY, f32::INFINITY].map(|value| parameter.held(0, value, parameter.range)), [low, high]);
    }
    let tint = p::find("specular_color").expect("a parameter");
    // A tint of the normal reflectance may be above 1: UsdPreviewSurface's specular colour over that of its index.
    assert_eq!(tint.held(0, 12.5, tint.range_of(&Switches::preview_surface(), false)), 12.5);
    assert_eq!(tint.held(0, 12.5, tint.range_of(&Switches::default(), false)), 1.0);
}
