//! Inputs of nodes: constants in the renderer's colours and units, or what other nodes give.

use super::emit::{clamp, colour, component, constant_scalar, scalar};
use super::network::{Network, Shader};
use super::neutral::{Said, Source, Value};
use super::value::to_linear_rec709;
use gonio::scene::{Graph, Input};

impl Network<'_> {
    /// Where an input's value comes from; what cannot be read counts as nothing, with a warning.
    pub(in crate::material) fn source(&mut self, shader: &Shader, name: &str) -> Source {
        match self.document.node(shader.index).source(name) {
            Source::Unreadable(problem) => {
                self.warn(shader, format!("input '{name}' cannot be read ({problem}); its default is used"));
                Source::Nothing
            }
            source => source,
        }
    }

    /// An input as a constant or a node's output; `None` where nothing usable is said.
    pub(in crate::material) fn input(&mut self, shader: &Shader, name: &str) -> Option<Input> {
        let source = self.source(shader, name);
        self.value_of(shader, name, source)
    }

    /// What a source gives for an input of a node.
    pub(in crate::material) fn value_of(&mut self, shader: &Shader, name: &str, source: Source) -> Option<Input> {
        match source {
            Source::Nothing | Source::Unreadable(_) => None,
            Source::Value(Value::Numbers(values, count), said) => Some(self.constant(shader, name, values, count, &said)),
            Source::Value(..) => {
                self.warn(shader, format!("input '{name}' holds no number; its default is used"));
                None
            }
            Source::Geometric(property) => Some(self.geometric(&property)),
            Source::Output(node, output) => self.output(node, &output),
        }
    }

    /// Inputs of a node, or these defaults in all components.
    pub(in crate::material) fn inputs<const N: usize>(&mut self, shader: &Shader, names: [(&str, f32); N]) -> [Input; N] {
        names.map(|(name, default)| self.input(shader, name).unwrap_or(scalar(default)))
    }

    /// What is computed of the input `in`, which is opaque black where nothing is said.
    pub(in crate::material) fn with_opaque(&mut self, shader: &Shader, compute: fn(&mut Graph, &[Input]) -> Input) -> Option<Input> {
        let input = self.input(shader, "in").unwrap_or(Input::Constant([0.0, 0.0, 0.0, 1.0]));
        Some(compute(&mut self.graph, &[input]))
    }

    fn constant(&mut self, shader: &Shader, name: &str, values: [f32; 4], count: usize, said: &Said) -> Input {
        if values.iter().any(|x| !x.is_finite()) {
            self.warn(shader, format!("input '{name}' is not finite; 0 is used"));
            return Input::Constant(values.map(|x| if x.is_finite() { x } else { 0.0 }));
        }
        if count < 3 || !said.is_colour {
            let scale = self.unit(shader, name, &said.unit);
            return Input::Constant(if scale == 1.0 { values } else { values.map(|x| x * scale) });
        }
        match to_linear_rec709(values, &said.space) {
            Ok(values) => Input::Constant(values),
            Err(space) => {
                self.warn(shader, format!("input '{name}' has the unknown colour space '{space}'; taken as linear Rec.709"));
                Input::Constant(values)
            }
        }
    }

    /// A scalar input, or its default.
    pub(in crate::material) fn scalar(&mut self, shader: &Shader, name: &str, default: f32) -> Input {
        self.input(shader, name).map_or(scalar(default), |input| component(input, 0))
    }

    /// A scalar input that is a share of a whole, held within 0 to 1; says so where it is stated beyond.
    pub(in crate::material) fn share(&mut self, shader: &Shader, name: &str, default: f32) -> Input {
        let input = self.scalar(shader, name, default);
        if let Some(found) = constant_scalar(input).filter(|found| !(0.0..=1.0).contains(found)) {
            self.warn(shader, format!("input '{name}' is {found}, outside 0 to 1; {} is used", found.clamp(0.0, 1.0)));
        }
        clamp(&mut self.graph, input, scalar(0.0), scalar(1.0))
    }

    /// A colour or vector input, or its default.
    pub(in crate::material) fn colour(&mut self, shader: &Shader, name: &str, default: [f32; 3]) -> Input {
        self.input(shader, name).unwrap_or(colour(default))
    }

    /// An input that must not vary over the surface; what does is replaced by the default, with a warning.
    pub(in crate::material) fn uniform(&mut self, shader: &Shader, name: &str, default: [f32; 4]) -> [f32; 4] {
        match self.input(shader, name) {
            None => default,
            Some(Input::Constant(values)) => values,
            Some(Input::Node(..)) => {
                self.warn(shader, format!("input '{name}' varies over the surface, which is not supported for it; its default is used"));
                default
            }
        }
    }

    /// A number that must not vary over the surface.
    pub(in crate::material) fn number(&mut self, shader: &Shader, name: &str, default: f32) -> f32 {
        self.uniform(shader, name, [default; 4])[0]
    }

    /// A token or string.
    pub(in crate::material) fn text(&mut self, shader: &Shader, name: &str) -> Option<String> {
        match self.source(shader, name) {
            Source::Value(value, _) => value.text().map(str::to_owned),
            _ => None,
        }
    }

    /// What a number in a unit is multiplied with: lengths are in units of the stage, angles in degrees.
    fn unit(&mut self, shader: &Shader, name: &str, unit: &str) -> f32 {
        let metres = match unit {
            "" | "degree" => return 1.0,
            "radian" => return 180.0 / std::f32::consts::PI,
            "nanometer" => 1e-9,
            "micron" => 1e-6,
            "millimeter" => 1e-3,
            "centimeter" => 1e-2,
            "inch" => 0.0254,
            "foot" => 0.3048,
            "yard" => 0.9144,
            "meter" => 1.0,
            "kilometer" => 1e3,
            "mile" => 1609.344,
            other => {
                self.warn(shader, format!("input '{name}' has the unknown unit '{other}'; it is taken as it is"));
                return 1.0;
            }
        };
        (metres / self.host.metres_per_unit()) as f32
    }
}
