//! Volumes: what a material's output of that name says fills the closed meshes that have it. MaterialX 1.39, "Volume Shader Nodes" and its distributions.

use super::from_usd;
use super::network::{Network, Shader};
use super::neutral::NodeIndex;
use super::outputs::{VOLUME, source};
use super::surface::{behind, emission, node_name};
use crate::context::Context;
use crate::prim::Prim;
use gonio::scene::{Input, Medium, Origin};

/// What fills the meshes of a material; `None` where it has no such output, or what is there is told to be left out.
pub(super) fn read<'py>(context: &mut Context<'_, 'py>, material: &Prim<'py>) -> Option<Medium> {
    let origin = Origin::new(material.path());
    let prim = context.attempt(&origin, "the material's volume cannot be found", source(material, VOLUME))??;
    let document = from_usd::read(prim, &context.time);
    let mut network = Network::new(context, document);
    let shader = network.shader(NodeIndex(0));
    let found = convert(&mut network, &shader)?;
    // Coefficients are one over the stage's units.
    let metres = network.host.metres_per_unit() as f32;
    Some(scaled(found, metres.recip()))
}

/// So much of a medium.
fn scaled(medium: Medium, by: f32) -> Medium {
    let times = |part: [f32; 3]| part.map(|x| x * by);
    let Medium { absorption, scattering, emission, .. } = medium;
    Medium { absorption: times(absorption), scattering: times(scattering), emission: times(emission), ..medium }
}

/// Both together, scattering by the mean of their angles.
fn sum(a: Medium, b: Medium) -> Medium {
    let plus = |a: [f32; 3], b: [f32; 3]| [0, 1, 2].map(|part| a[part] + b[part]);
    let [own, other] = [a, b].map(|medium| medium.scattering.iter().sum::<f32>());
    Medium {
        absorption: plus(a.absorption, b.absorption),
        scattering: plus(a.scattering, b.scattering),
        emission: plus(a.emission, b.emission),
        anisotropy: (own * a.anisotropy + other * b.anisotropy) / (own + other).max(f32::MIN_POSITIVE),
        field: a.field.or(b.field),
    }
}

/// A volume shader or a distribution; `None` for one that is not known or varies, which is told.
fn convert(network: &mut Network<'_>, shader: &Shader) -> Option<Medium> {
    let part = |network: &mut Network<'_>, input: &str| -> Option<Medium> {
        match behind(network, shader, input) {
            Some(part) => network.within(&part, |network| convert(network, &part))?,
            None => Some(Medium::default()),
        }
    };
    match node_name(&shader.id) {
        "volume" => {
            let medium = part(network, "vdf")?;
            let shining = match behind(network, shader, "edf") {
                Some(edf) => {
                    let radiance = emission(network, &edf);
                    constant(network, shader, radiance)?
                }
                None => [0.0; 3],
            };
            Some(sum(medium, Medium { emission: shining, ..Medium::default() }))
        }
        "absorption_vdf" => Some(Medium { absorption: colour(network, shader, "absorption")?, ..Medium::default() }),
        "anisotropic_vdf" => Some(Medium {
            absorption: colour(network, shader, "absorption")?,
            scattering: colour(network, shader, "scattering")?,
            anisotropy: network.number(shader, "anisotropy", 0.0),
            field: None,
            ..Medium::default()
        }),
        "add" => Some(sum(part(network, "in1")?, part(network, "in2")?)),
        "mix" => {
            let share = network.number(shader, "mix", 0.0).clamp(0.0, 1.0);
            Some(sum(scaled(part(network, "bg")?, 1.0 - share), scaled(part(network, "fg")?, share)))
        }
        "multiply" => {
            let factor = network.number(shader, "in2", 1.0);
            Some(scaled(part(network, "in1")?, factor))
        }
        _ => match network.inside(shader) {
            Some(inside) => network.within(&inside, |network| convert(network, &inside))?,
            None => {
                network.unsupported(&format!("the volume shader '{}'", shader.id), shader);
                None
            }
        },
    }
}

fn colour(network: &mut Network<'_>, shader: &Shader, name: &str) -> Option<[f32; 3]> {
    let input = network.colour(shader, name, [0.0; 3]);
    constant(network, shader, input)
}

/// An even coefficient; `None` where it varies, which is told.
fn constant(network: &mut Network<'_>, shader: &Shader, input: Input) -> Option<[f32; 3]> {
    match input {
        Input::Constant([r, g, b, _]) => Some([r, g, b]),
        Input::Node(..) => {
            network.unsupported("a volume that varies from place to place", shader);
            None
        }
    }
}
