//! Volumes: what a material's output of that name says fills the closed meshes and the volume prims that have it. MaterialX 1.39, "Volume Shader
//! Nodes" and its distributions, and Arnold's standard_volume.

mod arnold;

use super::emit::{add, is_constant, multiply, rest, scalar};
use super::from_usd;
use super::network::{Network, Shader};
use super::neutral::NodeIndex;
use super::outputs::{VOLUME, source};
use super::surface::{behind, emission, node_name};
use crate::context::Context;
use crate::prim::Prim;
use gonio::scene::{Channel, Graph, Input, Medium, Operation, Origin};
use gonio_nodes::{Code, Hit, Operand};
use std::collections::BTreeSet;

/// What a material says of the inside of what has it. Coefficients are one over the stage's unit, constants or outputs of the graph, which reads
/// fields as primvars.
#[derive(Debug)]
pub(crate) struct VolumeShading {
    /// Path of the material; that of the prim where it has none.
    pub(crate) path: String,
    graph: Graph,
    pub(crate) absorption: Input,
    pub(crate) scattering: Input,
    pub(crate) emission: Input,
    pub(crate) anisotropy: f32,
}

impl VolumeShading {
    /// What scatters white light evenly, as much of it a unit of length as the field of a name says.
    pub(crate) fn usual(path: String, field: &str) -> Self {
        let mut graph = Graph::default();
        let density = graph.add(Operation::Primvar { name: field.to_owned(), fallback: [0.0; 4] }, vec![]);
        let scattering = Input::Node(density, Channel::R);
        Self { path, graph, absorption: scalar(0.0), scattering, emission: scalar(0.0), anisotropy: 0.0 }
    }

    /// Names of the fields and primvars that an input follows.
    pub(crate) fn names(&self, input: Input) -> BTreeSet<&str> {
        let (mut names, mut waiting, mut seen) = (BTreeSet::new(), vec![input], BTreeSet::new());
        while let Some(input) = waiting.pop() {
            let Input::Node(node, _) = input else { continue };
            if seen.insert(node.0) {
                let node = &self.graph.nodes[usize::from(node.0)];
                waiting.extend(&node.inputs);
                if let Operation::Primvar { name, .. } = &node.operation {
                    names.insert(name.as_str());
                }
            }
        }
        names
    }

    /// An input where fields have these values, `None` for one that is not there; nothing where the input asks for more than fields.
    pub(crate) fn value(&self, input: Input, given: &dyn Fn(&str) -> Option<[f32; 4]>) -> Option<[f32; 3]> {
        let code = Code::new(&self.graph, |_, operation| match operation {
            Operation::Primvar { name, fallback } => Hit::Constant(given(name).unwrap_or(*fallback)),
            _ => Hit::Step(()),
        });
        let [r, g, b, _] = code.value(input).map(|part| if let Operand::Constant(x) = part { Some(x) } else { None });
        Some([r?, g?, b?])
    }
}

/// What fills the meshes of a material; `None` where it has no such output, or what is there is told to be left out.
pub(super) fn read<'py>(context: &mut Context<'_, 'py>, material: &Prim<'py>) -> Option<Medium> {
    let VolumeShading { path, absorption, scattering, emission, anisotropy, .. } = shading(context, material)?;
    let even = |input: Input| if let Input::Constant([r, g, b, _]) = input { Some([r, g, b]) } else { None };
    // Coefficients are one over the stage's units.
    let metres = context.metres_per_unit as f32;
    let coefficient = |input: Input| Some(even(input)?.map(|x| x / metres));
    let medium = || {
        let [absorption, scattering, emission] = [coefficient(absorption)?, coefficient(scattering)?, coefficient(emission)?];
        Some(Medium { absorption, scattering, emission, anisotropy, ..Medium::default() })
    };
    let found = medium();
    if found.is_none() {
        context.unsupported("a volume that varies from place to place", &Origin::new(path));
    }
    found
}

/// What a material's volume is; `None` where it has none, or it is told to be left out.
pub(crate) fn shading<'py>(context: &mut Context<'_, 'py>, material: &Prim<'py>) -> Option<VolumeShading> {
    let path = material.path();
    let prim = context.connected(material, "volume", source(material, VOLUME))?;
    let document = from_usd::read(prim, &context.time);
    let mut network = Network::new(context, document);
    let shader = network.shader(NodeIndex(0));
    let Parts { absorption, scattering, emission, anisotropy } = convert(&mut network, &shader)?;
    Some(VolumeShading { path, graph: network.graph, absorption, scattering, emission, anisotropy })
}

/// A medium under way.
struct Parts {
    absorption: Input,
    scattering: Input,
    emission: Input,
    anisotropy: f32,
}

impl Default for Parts {
    fn default() -> Self {
        Self { absorption: scalar(0.0), scattering: scalar(0.0), emission: scalar(0.0), anisotropy: 0.0 }
    }
}

impl Parts {
    /// So much of it.
    fn scaled(self, graph: &mut Graph, by: Input) -> Self {
        let [absorption, scattering, emission] = [self.absorption, self.scattering, self.emission].map(|part| multiply(graph, part, by));
        Self { absorption, scattering, emission, ..self }
    }
}

/// Both together, scattering by the mean of their angles.
fn sum(network: &mut Network<'_>, shader: &Shader, a: Parts, b: Parts) -> Parts {
    let anisotropy = mean_anisotropy(network, shader, [&a, &b]);
    let graph = &mut network.graph;
    Parts {
        absorption: add(graph, a.absorption, b.absorption),
        scattering: add(graph, a.scattering, b.scattering),
        emission: add(graph, a.emission, b.emission),
        anisotropy,
    }
}

/// The mean of two anisotropies by what is scattered; of the two alike where that is known only from place to place, which is told.
fn mean_anisotropy(network: &mut Network<'_>, shader: &Shader, [a, b]: [&Parts; 2]) -> f32 {
    let weight = |part: &Parts| match part.scattering {
        Input::Constant([x, y, z, _]) => Some(x + y + z),
        Input::Node(..) => None,
    };
    let is_clear = |part: &Parts| is_constant(part.scattering, 0.0);
    match [weight(a), weight(b)] {
        _ if is_clear(a) => b.anisotropy,
        _ if is_clear(b) || a.anisotropy == b.anisotropy => a.anisotropy,
        [Some(own), Some(other)] => (own * a.anisotropy + other * b.anisotropy) / (own + other).max(f32::MIN_POSITIVE),
        _ => {
            let message = "volumes that vary and scatter by different anisotropies are mixed; their mean is used".to_owned();
            network.host.once("anisotropy", &shader.path, &shader.path, message);
            0.5 * (a.anisotropy + b.anisotropy)
        }
    }
}

/// A volume shader or a distribution; `None` for one that is not known, which is told.
fn convert(network: &mut Network<'_>, shader: &Shader) -> Option<Parts> {
    let part = |network: &mut Network<'_>, input: &str| -> Option<Parts> {
        match behind(network, shader, input) {
            Some(part) => network.within(&part, |network| convert(network, &part))?,
            None => Some(Parts::default()),
        }
    };
    match node_name(&shader.id) {
        arnold::ID => Some(arnold::convert(network, shader)),
        "volume" => {
            let medium = part(network, "vdf")?;
            let shining = behind(network, shader, "edf").map_or(scalar(0.0), |edf| emission(network, &edf));
            let emission = add(&mut network.graph, medium.emission, shining);
            Some(Parts { emission, ..medium })
        }
        "absorption_vdf" => Some(Parts { absorption: network.colour(shader, "absorption", [0.0; 3]), ..Parts::default() }),
        "anisotropic_vdf" => Some(Parts {
            absorption: network.colour(shader, "absorption", [0.0; 3]),
            scattering: network.colour(shader, "scattering", [0.0; 3]),
            anisotropy: network.number(shader, "anisotropy", 0.0),
            ..Parts::default()
        }),
        "add" => {
            let (a, b) = (part(network, "in1")?, part(network, "in2")?);
            Some(sum(network, shader, a, b))
        }
        "mix" => {
            let share = network.share(shader, "mix", 0.0);
            let (bg, fg) = (part(network, "bg")?, part(network, "fg")?);
            let left = rest(&mut network.graph, share);
            let (bg, fg) = (bg.scaled(&mut network.graph, left), fg.scaled(&mut network.graph, share));
            Some(sum(network, shader, bg, fg))
        }
        "multiply" => {
            let factor = network.input(shader, "in2").unwrap_or(scalar(1.0));
            Some(part(network, "in1")?.scaled(&mut network.graph, factor))
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
