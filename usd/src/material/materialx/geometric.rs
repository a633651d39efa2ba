//! What nodes know of the place on the surface, and of the frame.

use super::super::emit::{multiply, scalar};
use super::super::network::{Network, Shader};
use super::super::varying::primvar;
use gonio::scene::{Input, Operation, Quantity, Space};

/// What lies in front of the coordinates' names.
const FIRST_COORDINATES: &str = "st";

impl Network<'_> {
    /// A geometric property by the name that inputs' defaults have: `UV0`, `Pobject`, `Nworld`.
    pub(in crate::material) fn geometric(&mut self, name: &str) -> Input {
        match name {
            "UV0" => self.texture_coordinates(0),
            "Pobject" => self.position(Space::Object),
            "Pworld" => self.position(Space::World),
            "Nobject" => self.surface_normal(Space::Object),
            "Tobject" => self.surface_tangent(Space::Object),
            "Tworld" => self.surface_tangent(Space::World),
            "Bobject" => self.surface_bitangent(Space::Object),
            "Bworld" => self.surface_bitangent(Space::World),
            "Vworld" | "Iworld" => self.view_direction(Space::World),
            _ => self.surface_normal(Space::World),
        }
    }

    /// An input, or a geometric property where nothing is said.
    pub(in crate::material) fn geometric_input(&mut self, shader: &Shader, input: &str, property: &str) -> Input {
        match self.input(shader, input) {
            Some(input) => input,
            None => self.geometric(property),
        }
    }

    /// The position in the mesh's own space or in the stage's, in units of the stage.
    fn position(&mut self, space: Space) -> Input {
        let mut metres = self.node(Operation::Position, vec![]);
        if let Some(axis) = self.step() {
            let step = self.node(Operation::PositionStep { axis }, vec![]);
            metres = self.node(Operation::Add, vec![metres, step]);
        }
        match space {
            Space::Object => self.carried(metres, Space::World, Space::Object, Quantity::Point),
            Space::World => {
                let units = (1.0 / self.host.metres_per_unit()) as f32;
                multiply(&mut self.graph, metres, scalar(units))
            }
        }
    }

    fn surface_normal(&mut self, space: Space) -> Input {
        let normal = self.node(Operation::Normal, vec![]);
        self.carried(normal, Space::World, space, Quantity::Normal)
    }

    fn surface_tangent(&mut self, space: Space) -> Input {
        let tangent = self.node(Operation::UvTangent { uv: FIRST_COORDINATES.to_owned() }, vec![]);
        self.direction(tangent, space)
    }

    fn surface_bitangent(&mut self, space: Space) -> Input {
        let (normal, tangent) = (self.surface_normal(Space::World), self.surface_tangent(Space::World));
        let bitangent = self.node(Operation::Cross, vec![normal, tangent]);
        self.direction(bitangent, space)
    }

    /// From the eye to the surface.
    fn view_direction(&mut self, space: Space) -> Input {
        let incoming = self.node(Operation::Incoming, vec![]);
        let outgoing = multiply(&mut self.graph, incoming, scalar(-1.0));
        self.direction(outgoing, space)
    }

    /// A unit vector of the world as one of a space.
    fn direction(&mut self, vector: Input, space: Space) -> Input {
        match space {
            Space::World => vector,
            Space::Object => {
                let carried = self.carried(vector, Space::World, Space::Object, Quantity::Vector);
                self.node(Operation::Normalize, vec![carried])
            }
        }
    }

    /// A value carried from one space to another; world space in metres.
    pub(in crate::material) fn carried(&mut self, value: Input, from: Space, to: Space, quantity: Quantity) -> Input {
        if from == to { value } else { self.node(Operation::Transform { from, to, quantity }, vec![value]) }
    }

    /// A primvar's value at the place, or at the one beside it for which the nodes are built.
    pub(in crate::material) fn primvar(&mut self, name: String, fallback: [f32; 4]) -> Input {
        let here = self.node(Operation::Primvar { name: name.clone(), fallback }, vec![]);
        match self.step() {
            Some(axis) => {
                let step = self.node(Operation::PrimvarStep { name, axis }, vec![]);
                self.node(Operation::Add, vec![here, step])
            }
            None => here,
        }
    }

    /// The space that a node's input names; `otherwise` where it names none.
    pub(in crate::material) fn space(&mut self, shader: &Shader, input: &str, otherwise: Space) -> Space {
        match self.text(shader, input).as_deref() {
            Some("world") => Space::World,
            Some("object" | "model") => Space::Object,
            _ => otherwise,
        }
    }
}

pub(super) fn position(network: &mut Network<'_>, shader: &Shader, _: &str) -> Option<Input> {
    let space = network.space(shader, "space", Space::Object);
    Some(network.position(space))
}

pub(super) fn normal(network: &mut Network<'_>, shader: &Shader, _: &str) -> Option<Input> {
    let space = network.space(shader, "space", Space::Object);
    Some(network.surface_normal(space))
}

pub(super) fn tangent(network: &mut Network<'_>, shader: &Shader, _: &str) -> Option<Input> {
    let space = network.space(shader, "space", Space::Object);
    Some(network.surface_tangent(space))
}

pub(super) fn bitangent(network: &mut Network<'_>, shader: &Shader, _: &str) -> Option<Input> {
    let space = network.space(shader, "space", Space::Object);
    Some(network.surface_bitangent(space))
}

pub(super) fn view_direction(network: &mut Network<'_>, shader: &Shader, _: &str) -> Option<Input> {
    let space = network.space(shader, "space", Space::World);
    Some(network.view_direction(space))
}

pub(super) fn coordinates(network: &mut Network<'_>, shader: &Shader, _: &str) -> Option<Input> {
    let index = network.number(shader, "index", 0.0);
    Some(network.texture_coordinates(index.clamp(0.0, 64.0) as u32))
}

/// The colours of the mesh: `displayColor`, and `displayColor1`, … of further sets.
pub(super) fn colours(network: &mut Network<'_>, shader: &Shader, _: &str) -> Option<Input> {
    let index = network.number(shader, "index", 0.0).clamp(0.0, 64.0) as u32;
    let name = if index == 0 { "displayColor".to_owned() } else { format!("displayColor{index}") };
    Some(network.primvar(name, [0.0, 0.0, 0.0, 1.0]))
}

/// A primvar; the library's own names stand for what they mean.
pub(super) fn property(network: &mut Network<'_>, shader: &Shader, kind: &str) -> Option<Input> {
    let [fallback] = network.inputs(shader, [("default", 0.0)]);
    let name = network.text(shader, "geomprop").filter(|name| !name.is_empty() && !kind.starts_with("string"))?;
    match name.as_str() {
        "UV0" | "Pobject" | "Pworld" | "Nobject" | "Nworld" | "Tobject" | "Tworld" | "Bobject" | "Bworld" => Some(network.geometric(&name)),
        _ => Some(primvar(&mut network.graph, name, fallback)),
    }
}

pub(super) fn frame(network: &mut Network<'_>, _: &Shader, _: &str) -> Option<Input> {
    Some(scalar(network.host.frame()[0] as f32))
}

/// Seconds, by the rate that the node says or the stage's.
pub(super) fn time(network: &mut Network<'_>, shader: &Shader, _: &str) -> Option<Input> {
    let [frame, rate] = network.host.frame();
    let rate = network.number(shader, "fps", rate as f32);
    Some(scalar(if rate > 0.0 { frame as f32 / rate } else { 0.0 }))
}

/// A point, a vector or a normal from one space to another; spaces that are not named are the same.
pub(super) fn transform(network: &mut Network<'_>, shader: &Shader, _: &str) -> Option<Input> {
    let quantity = match super::split(&shader.id).0 {
        "transformpoint" => Quantity::Point,
        "transformnormal" => Quantity::Normal,
        _ => Quantity::Vector,
    };
    let default = if quantity == Quantity::Normal { [0.0, 0.0, 1.0, 1.0] } else { [0.0; 4] };
    let input = network.input(shader, "in").unwrap_or(Input::Constant(default));
    let from = network.space(shader, "fromspace", Space::World);
    let to = network.space(shader, "tospace", from);
    // World space is in metres, meshes' own spaces in what their points are in.
    let metres = network.host.metres_per_unit() as f32;
    let scaled = |network: &mut Network<'_>, value: Input, factor: f32| match quantity {
        Quantity::Normal => value,
        Quantity::Point | Quantity::Vector => multiply(&mut network.graph, value, scalar(factor)),
    };
    let input = if (from, to) == (Space::World, Space::Object) { scaled(network, input, metres) } else { input };
    let carried = network.carried(input, from, to, quantity);
    Some(if (from, to) == (Space::Object, Space::World) { scaled(network, carried, metres.recip()) } else { carried })
}
