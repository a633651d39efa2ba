//! A graph's steps, each on single components: constants folded, equal steps shared (static single assignment).
//!
//! A value is four operands, each a constant or what a step gave. So taking a component, combining components and splatting a scalar cost
//! nothing, and components that nobody reads are never computed.

use crate::{
    Channel, Curve, Graph, Input, KernelKind, Operation, Rest, Signature,
    columns::{Io, MOST_INPUTS, MOST_OUTPUTS},
    table::run,
};
use gonio_simd::{Column, One, PADDING};
use std::{collections::HashMap, mem::Discriminant, sync::Arc};

/// One component of a value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Operand {
    /// A constant.
    Constant(f32),
    /// What a step gave, by number.
    Variable(u32),
}

impl Operand {
    fn key(self) -> u64 {
        match self {
            Self::Constant(value) => u64::from(value.to_bits()),
            Self::Variable(number) => 1 << 32 | u64::from(number),
        }
    }
    fn constant(self) -> Option<f32> {
        match self {
            Self::Constant(value) => Some(value),
            Self::Variable(_) => None,
        }
    }
}

/// A value of four components.
pub type Value = [Operand; 4];

/// A value that is the same everywhere.
pub fn constant(value: [f32; 4]) -> Value {
    value.map(Operand::Constant)
}

/// A value's components, if all are constants.
pub(crate) fn constants(value: Value) -> Option<[f32; 4]> {
    let [x, y, z, w] = value.map(Operand::constant);
    Some([x?, y?, z?, w?])
}

/// What computes a step; `X` is what the host of the graph knows: hits, images.
#[derive(Clone, Debug, PartialEq)]
pub enum Kernel<X> {
    /// An operation of the table.
    Operation(Operation),
    /// A curve's lookup.
    Curve(Arc<Curve>),
    /// The host's.
    Hit(X),
}

/// A step: a kernel, what it reads, and the numbers of what it gives, which follow each other.
#[derive(Clone, Debug, PartialEq)]
pub struct Step<X> {
    /// What computes it.
    pub kernel: Kernel<X>,
    /// What it reads.
    pub inputs: Vec<Operand>,
    /// The first variable that it gives.
    pub first: u32,
    /// How many it gives.
    pub outputs: usize,
}

/// What a host makes of an operation of the table's section `hit`.
#[derive(Clone, Debug)]
pub enum Hit<X> {
    /// A step of its own.
    Step(X),
    /// A value known beforehand.
    Constant([f32; 4]),
    /// The first input as it is.
    Same,
}

/// The steps of a graph and the values of its nodes.
#[derive(Clone, Debug)]
pub struct Code<X> {
    /// Steps in order.
    pub steps: Vec<Step<X>>,
    /// Variables in all.
    pub variables: u32,
    values: Vec<Value>,
}

impl<X> Code<X> {
    /// Lays out a graph; `hit` says what the operations of the section `hit` are, by the node's number. Nodes read earlier ones only.
    pub fn new(graph: &Graph, mut hit: impl FnMut(usize, &Operation) -> Hit<X>) -> Self {
        let mut code = Self { steps: Vec::new(), variables: 0, values: Vec::new() };
        let mut known = HashMap::new();
        for (number, node) in graph.nodes.iter().enumerate() {
            let inputs: Vec<Value> = node.inputs.iter().map(|input| code.value(*input)).collect();
            let value = code.lay_out(&node.operation, &inputs, &mut known, &mut |operation| hit(number, operation));
            code.values.push(value);
        }
        code
    }

    /// The value of a node or a constant.
    pub fn value(&self, input: Input) -> Value {
        match input {
            Input::Constant(value) => constant(value),
            Input::Node(node, channel) => {
                let value = self.values[usize::from(node.0)];
                match channel {
                    Channel::Rgb => value,
                    Channel::R => [value[0]; 4],
                    Channel::G => [value[1]; 4],
                    Channel::B => [value[2]; 4],
                    Channel::A => [value[3]; 4],
                }
            }
        }
    }

    fn lay_out(&mut self, operation: &Operation, inputs: &[Value], known: &mut Known, hit: &mut dyn FnMut(&Operation) -> Hit<X>) -> Value {
        let input = |number: usize| inputs.get(number).copied().unwrap_or(constant([0.0; 4]));
        match operation {
            Operation::Combine => return [0, 1, 2, 3].map(|number| input(number)[0]),
            Operation::Transform2d { scale, rotation_deg, translation } => {
                let rows = transform_rows(*scale, *rotation_deg, *translation);
                return self.lay_out(&Operation::Transform3d { rows }, inputs, known, hit);
            }
            Operation::Curve { table, range, linear, extrapolate } => {
                let argument = input(0);
                let curves = [0, 1, 2, 3].map(|column| {
                    let values = table.iter().map(|row| row[column]);
                    Arc::new(Curve::new(values, *range, *linear, *extrapolate))
                });
                return self.look_up(&curves, argument);
            }
            _ => {}
        }
        let signature = operation.signature();
        match signature.kind {
            KernelKind::Each => self.each(operation, signature, &input, known),
            KernelKind::Whole => self.whole(Kernel::Operation(operation.clone()), signature, &input),
            KernelKind::Hit => match hit(operation) {
                Hit::Step(step) => self.whole(Kernel::Hit(step), signature, &input),
                Hit::Constant(value) => constant(value),
                Hit::Same => input(0),
            },
        }
    }

    /// A step a component, those with equal inputs shared.
    fn each(&mut self, operation: &Operation, signature: Signature, input: &dyn Fn(usize) -> Value, known: &mut Known) -> Value {
        [0, 1, 2, 3].map(|component| {
            let operands: Vec<Operand> = (0..signature.inputs.len()).map(|number| input(number)[component]).collect();
            let key = (std::mem::discriminant(operation), [0, 1, 2].map(|i| operands.get(i).map_or(0, |operand| operand.key())));
            if let Some(found) = known.get(&key) {
                return *found;
            }
            let [found] = self.step(Kernel::Operation(operation.clone()), operands);
            known.insert(key, found);
            found
        })
    }

    /// One step on the components of all inputs.
    fn whole(&mut self, kernel: Kernel<X>, signature: Signature, input: &dyn Fn(usize) -> Value) -> Value {
        let parts = signature.inputs.iter().enumerate();
        let operands = parts.flat_map(|(number, (_, width))| input(number).into_iter().take(*width)).collect();
        let given: [Operand; 4] = self.step_of(kernel, operands, signature.outputs);
        [0, 1, 2, 3].map(|component| match signature.rest {
            _ if component < signature.outputs => given[component],
            Rest::Splat => given[0],
            Rest::Zero => Operand::Constant(0.0),
            Rest::Keep => input(0)[component],
        })
    }

    fn look_up(&mut self, curves: &[Arc<Curve>; 4], argument: Value) -> Value {
        let mut out = argument;
        for component in 0..4 {
            let same = (0..component).find(|other| argument[*other] == argument[component] && curves[*other] == curves[component]);
            out[component] = match same {
                Some(other) => out[other],
                None => self.step::<1>(Kernel::Curve(curves[component].clone()), vec![argument[component]])[0],
            };
        }
        out
    }

    fn step<const N: usize>(&mut self, kernel: Kernel<X>, inputs: Vec<Operand>) -> [Operand; N] {
        let given = self.step_of(kernel, inputs, N);
        std::array::from_fn(|component| given[component])
    }

    /// Appends a step, or computes it at once where nothing varies.
    fn step_of(&mut self, kernel: Kernel<X>, inputs: Vec<Operand>, outputs: usize) -> Value {
        if let Some(constants) = inputs.iter().map(|operand| operand.constant()).collect::<Option<Vec<f32>>>()
            && let Some(value) = fold(&kernel, &constants)
        {
            return constant(value);
        }
        let first = self.variables;
        self.variables += outputs as u32;
        self.steps.push(Step { kernel, inputs, first, outputs });
        [0, 1, 2, 3].map(|component| if component < outputs { Operand::Variable(first + component as u32) } else { Operand::Constant(0.0) })
    }
}

/// Steps on single components by operation and operands.
type Known = HashMap<(Discriminant<Operation>, [u64; 3]), Operand>;

/// What a kernel gives for constants, by its scalar level; none for those of the host. What is not finite counts as zero.
fn fold<X>(kernel: &Kernel<X>, inputs: &[f32]) -> Option<[f32; 4]> {
    let constants: Vec<[f32; PADDING]> = inputs.iter().map(|value| [*value; PADDING]).collect();
    let mut outputs: [Column; MOST_OUTPUTS] = std::array::from_fn(|_| Column::new(1));
    let mut io = Io::new(1, &mut outputs);
    assert!(inputs.len() <= MOST_INPUTS, "kernels have at most {MOST_INPUTS} inputs");
    constants.iter().for_each(|values| io.push_constant(values));
    match kernel {
        Kernel::Operation(operation) => run(One, operation, &mut io),
        Kernel::Curve(curve) => curve.run(One, &mut io),
        Kernel::Hit(_) => return None,
    }
    Some(std::array::from_fn(|component| if outputs[component][0].is_finite() { outputs[component][0] } else { 0.0 }))
}

/// The rows that scale, then turn counter-clockwise, then move two coordinates.
fn transform_rows(scale: [f32; 2], rotation_deg: f32, translation: [f32; 2]) -> [[f32; 4]; 3] {
    let (sin, cos) = rotation_deg.to_radians().sin_cos();
    [[cos * scale[0], -sin * scale[1], 0.0, translation[0]], [sin * scale[0], cos * scale[1], 0.0, translation[1]], [0.0, 0.0, 1.0, 0.0]]
}
