//! A closure's parameters: numbers held within their ranges, and what is asked of the graph.

use super::program::CompiledGraph;
use crate::{
    bsdf::{
        Switches,
        parameter::{self, Parameter},
    },
    error::Diagnostic,
    graph::WantedOutput,
    scene::{Closure, Material},
};
use gonio_nodes::{Operand, Value};

/// Of the weights of closures.
pub(super) const WEIGHT: [f32; 2] = [0.0, 1.0];

/// The parameters of a closure.
pub(in super::super) struct Parameters {
    /// Numbers of the places that do not vary.
    pub(super) constants: [f32; parameter::COUNT],
    /// The places that do.
    pub(super) varying: [bool; parameter::COUNT],
    /// What the graph computes.
    pub(super) outputs: Vec<WantedOutput>,
    /// The same as light sampling has it.
    pub(super) sampled: Vec<WantedOutput>,
}

impl Parameters {
    /// Lays out a closure's parameters; says once by name what was out of range, or is not known.
    pub(super) fn new(
        material: &Material,
        closure: &Closure,
        (switches, measured): (&Switches, bool),
        graph: &CompiledGraph,
        diagnostics: &mut Vec<Diagnostic>,
    ) -> Self {
        let mut constants = parameter::DEFAULTS;
        if measured {
            constants[parameter::BASE_COLOR..parameter::BASE_COLOR + 3].fill(1.0);
        }
        let mut made = Self { constants, varying: [false; parameter::COUNT], outputs: Vec::new(), sampled: Vec::new() };
        let mut tell = |message: String| tell_once(material, message, diagnostics);
        for (name, input) in &closure.parameters {
            let Some(parameter) = parameter::find(name) else {
                tell(format!("surface parameter '{name}' is not known; it is ignored"));
                continue;
            };
            let range = parameter.range_of(switches, measured);
            let value = graph.code.value(*input);
            if let Some(problem) = made.set_constants(parameter, &value, range) {
                tell(problem);
            }
            if value[..parameter.width()].iter().any(|operand| matches!(operand, Operand::Variable(_))) {
                made.varying[parameter.offset..parameter.offset + parameter.width()].fill(true);
                let wanted = |value: Value| WantedOutput { offset: parameter.offset, width: parameter.width(), value, range: Some(range) };
                made.outputs.push(wanted(value));
                made.sampled.push(wanted(graph.sampled.value(*input)));
            }
        }
        made
    }

    /// Gives the places from `offset` on these numbers, whatever the closure says.
    pub(in super::super) fn fix(&mut self, offset: usize, values: &[f32]) {
        self.constants[offset..offset + values.len()].copy_from_slice(values);
        self.varying[offset..offset + values.len()].fill(false);
        self.outputs.retain(|output| output.offset != offset);
        self.sampled.retain(|output| output.offset != offset);
    }

    /// Takes the numbers among a parameter's components, for a graph may give constants, too; says what was out of range.
    fn set_constants(&mut self, parameter: &Parameter, value: &Value, range: [f32; 2]) -> Option<String> {
        let mut problem = None;
        for (place, operand) in value.iter().take(parameter.width()).enumerate() {
            let Operand::Constant(found) = *operand else { continue };
            let held = parameter.held(place, found, range);
            self.constants[parameter.offset + place] = held;
            if held != found {
                problem = Some(out_of_range(parameter.name, found, range, held));
            }
        }
        problem
    }
}

/// Says once what weights of closures were out of range.
pub(super) fn tell_weights(material: &Material, graph: &CompiledGraph, diagnostics: &mut Vec<Diagnostic>) {
    let [low, high] = WEIGHT;
    for value in material.closures.iter().map(|closure| graph.code.value(closure.weight)) {
        for operand in &value[..3] {
            let Operand::Constant(found) = *operand else { continue };
            let held = if found.is_nan() { low } else { found.clamp(low, high) };
            if held != found {
                tell_once(material, out_of_range("weight", found, WEIGHT, held), diagnostics);
            }
        }
    }
}

fn tell_once(material: &Material, message: String, diagnostics: &mut Vec<Diagnostic>) {
    let diagnostic = Diagnostic::warning(&material.origin, message);
    if !diagnostics.contains(&diagnostic) {
        diagnostics.push(diagnostic);
    }
}

/// Says that a number was out of range.
fn out_of_range(name: &str, found: f32, [low, high]: [f32; 2], held: f32) -> String {
    let [found, low, high, held] = [found, low, high, held].map(in_short);
    format!("surface parameter '{name}' is {found}, outside {low} to {high}; {held} is used")
}

fn in_short(value: f32) -> String {
    if value != 0.0 && !(1e-4..1e6).contains(&value.abs()) { format!("{value:e}") } else { value.to_string() }
}
