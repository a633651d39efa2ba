//! Radiance's materials as gonio's: `docs/models.md` has the table.

use crate::vector::Vec3;
use gonio_scene::{Channel, Closure, Input, Material, MeasuredBsdf, Model, Operation, Origin, Scene};
use std::sync::Arc;

/// Index of glass where nothing is said, as Radiance has it.
pub(crate) const GLASS_INDEX: f64 = 1.52;
/// Luminance in cd/m² of a white radiance of 1 W/(sr m²), as Radiance has it.
const LUMENS_PER_WATT: f64 = 179.0;
/// Shares of Radiance's primaries in luminance.
const LUMINANCE: [f64; 3] = [0.265, 0.670, 0.065];
/// Those of linear Rec.709.
const REC709_LUMINANCE: [f64; 3] = [0.2126, 0.7152, 0.0722];

/// What Radiance calls a modifier: a material.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Modifier {
    /// Nothing is there.
    Void,
    Plastic {
        colour: Vec3,
        specularity: f64,
        roughness: f64,
    },
    Metal {
        colour: Vec3,
        specularity: f64,
        roughness: f64,
    },
    Trans {
        colour: Vec3,
        specularity: f64,
        roughness: f64,
        transmitted: f64,
        transmitted_specular: f64,
    },
    /// A pane of a transmissivity: what is left of light after one way through.
    Glass {
        transmissivity: Vec3,
        index: f64,
    },
    /// A solid of a transmissivity a unit of length, which is so many metres.
    Dielectric {
        transmissivity: Vec3,
        index: f64,
        metres: f64,
    },
    Mirror {
        colour: Vec3,
    },
    /// A lamp that shines from its front, W/(sr m²).
    Light {
        radiance: Vec3,
    },
    /// A measured BSDF, and what points up in its sample.
    Measured {
        bsdf: Arc<gonio_formats::bsdf::Measured>,
        up: Vec3,
    },
}

/// A material, and what points up in a measured one's sample.
pub(crate) struct Look {
    pub(crate) material: Material,
    pub(crate) up: Option<Vec3>,
}

impl Modifier {
    /// What is wrong with its numbers.
    pub(crate) fn problem(&self) -> Option<String> {
        let share = |name: &str, value: f64| {
            (!(0.0..=1.0).contains(&value)).then(|| format!("{name} {value} was found, expected a number from 0 to 1"))
        };
        let colour = |name: &str, colour: &Vec3| colour.iter().find_map(|&x| share(name, x));
        let index = |value: f64| (!(value > 1.0 && value < 100.0)).then(|| format!("index {value} was found, expected a number above 1"));
        match self {
            Self::Void | Self::Measured { .. } => None,
            Self::Plastic { colour: c, specularity, roughness } | Self::Metal { colour: c, specularity, roughness } => {
                colour("reflectance", c).or(share("specularity", *specularity)).or(share("roughness", *roughness))
            }
            Self::Trans { colour: c, specularity, roughness, transmitted, transmitted_specular } => colour("reflectance", c)
                .or(share("specularity", *specularity))
                .or(share("roughness", *roughness))
                .or(share("transmissivity", *transmitted))
                .or(share("transmitted specular", *transmitted_specular)),
            Self::Glass { transmissivity, index: n } => colour("transmissivity", transmissivity).or(index(*n)),
            Self::Dielectric { transmissivity, index: n, .. } => colour("transmissivity", transmissivity).or(index(*n)),
            Self::Mirror { colour: c } => colour("reflectance", c),
            Self::Light { radiance } => {
                let bad = radiance.iter().find(|x| !(**x >= 0.0 && x.is_finite()));
                bad.map(|x| format!("radiance {x} was found, expected a number of 0 or more"))
            }
        }
    }

    /// The material; `None` where nothing is there.
    pub(crate) fn look(&self, scene: &mut Scene, origin: &Origin) -> Option<Look> {
        let mut up_of = None;
        let mut material = Material { origin: origin.clone(), closures: Vec::new(), ..Material::default() };
        match self {
            Self::Void => return None,
            Self::Plastic { colour, specularity, roughness } => material.closures.push(plastic(*colour, *specularity, *roughness)),
            Self::Metal { colour, specularity, roughness } => material.closures.push(metal(*colour, *specularity, *roughness)),
            Self::Trans { colour, specularity, roughness, transmitted, transmitted_specular } => {
                material.closures = trans(*colour, *specularity, *roughness, [*transmitted, *transmitted_specular]);
            }
            Self::Glass { transmissivity, index } => material.closures.push(glass(*transmissivity, *index)),
            Self::Dielectric { transmissivity, index, metres } => {
                let mut solid = glass(*transmissivity, *index);
                solid.thin_walled = false;
                solid.set("transmission_depth", *metres as f32);
                material.closures.push(solid);
            }
            Self::Mirror { colour } => material.closures.push(mirror(*colour)),
            Self::Light { radiance } => shine(&mut material, *radiance),
            Self::Measured { bsdf, up } => {
                let measured = Some(scene.add_measured(MeasuredBsdf::new(origin.clone(), bsdf.clone())));
                up_of = Some(*up);
                material.closures.push(Closure { model: Model::Measured, measured, ..Closure::default() });
            }
        }
        Some(Look { material, up: up_of })
    }
}

/// A colour of Radiance's primaries in linear Rec.709 by its hue, with the luminance that it has in Radiance.
pub(crate) fn photometric(colour: Vec3) -> Vec3 {
    let of = |weights: Vec3| crate::vector::dot(colour, weights);
    let (meant, had) = (of(LUMINANCE), of(REC709_LUMINANCE));
    if had > 0.0 { colour.map(|x| x * meant / had) } else { colour }
}

/// A radiance in W/(sr m²) as one whose luminance is in cd/m².
pub(crate) fn luminous(radiance: Vec3) -> [f32; 3] {
    photometric(radiance).map(|x| (x * LUMENS_PER_WATT) as f32)
}

fn share(colour: Vec3) -> [f32; 3] {
    photometric(colour).map(|x| x.min(1.0) as f32)
}

/// Ward's roughness is the slope's, α, and ours its root.
fn ward(roughness: f64) -> f32 {
    roughness.max(0.0).sqrt() as f32
}

/// A diffuse base under a dielectric with the specularity as its normal reflectance.
fn plastic(colour: Vec3, specularity: f64, roughness: f64) -> Closure {
    let mut closure = Closure::default();
    closure.set_colour("base_color", share(colour));
    if specularity > 0.0 {
        let root = specularity.min(0.999).sqrt();
        closure.set("specular_ior", ((1.0 + root) / (1.0 - root)) as f32);
        closure.set("specular_roughness", ward(roughness));
    } else {
        closure.set("specular_weight", 0.0);
    }
    closure
}

/// The coloured specular share is metal, the rest diffuse.
fn metal(colour: Vec3, specularity: f64, roughness: f64) -> Closure {
    let mut closure = Closure::default();
    closure.set_colour("base_color", share(colour));
    closure.set("metalness", specularity as f32);
    closure.set("specular_weight", 0.0);
    closure.set("specular_roughness", ward(roughness));
    closure
}

fn mirror(colour: Vec3) -> Closure {
    let mut closure = Closure { model: Model::Glossy, ..Closure::default() };
    closure.set_colour("base_color", share(colour));
    closure.set("specular_roughness", 0.0);
    closure
}

/// What is reflected and passed, diffusely and otherwise, as four closures whose sum it is.
fn trans(colour: Vec3, specularity: f64, roughness: f64, [transmitted, specular]: [f64; 2]) -> Vec<Closure> {
    let rest = 1.0 - specularity;
    let parts = [
        (Model::Glossy, [1.0; 3], specularity),
        (Model::Diffuse, share(colour), rest * (1.0 - transmitted)),
        (Model::Translucent, share(colour), rest * transmitted * (1.0 - specular)),
        (Model::Transparent, share(colour), rest * transmitted * specular),
    ];
    let closure = |(model, colour, weight): (Model, [f32; 3], f64)| {
        let mut closure = Closure { model, weight: Input::Constant([weight as f32; 4]), ..Closure::default() };
        closure.set_colour("base_color", colour);
        if model == Model::Glossy {
            closure.set("specular_roughness", ward(roughness));
        }
        closure
    };
    parts.into_iter().filter(|part| part.2 > 0.0).map(closure).collect()
}

/// A smooth pane: Fresnel's reflections at both faces and all that go to and fro between them.
fn glass(transmissivity: Vec3, index: f64) -> Closure {
    let mut closure = Closure { thin_walled: true, ..Closure::default() };
    closure.set("transmission_weight", 1.0);
    closure.set("specular_roughness", 0.0);
    closure.set("specular_ior", index as f32);
    closure.set_colour("transmission_color", share(transmissivity));
    closure
}

/// Emission from the front; the back is black, as in Radiance.
fn shine(material: &mut Material, radiance: Vec3) {
    let [r, g, b] = luminous(radiance);
    let front = material.graph.add(Operation::FrontFacing, Vec::new());
    let inputs = vec![Input::Node(front, Channel::Rgb), Input::Constant([r, g, b, 1.0])];
    let light = material.graph.add(Operation::Multiply, inputs);
    let mut closure = Closure { model: Model::Emission, ..Closure::default() };
    closure.set_input("emission_color", Input::Node(light, Channel::Rgb));
    material.closures.push(closure);
}
