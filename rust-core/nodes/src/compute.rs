//! Single operations on arrays.

use crate::{CHUNK, Channel, Code, Graph, Hit, Input, Operation, Program, Registers, Source};
use gonio_simd::{Execution, Lanes, dispatch};

/// What an operation gives for inputs that are arrays of one length; none for those that ask for more than their inputs (surface points, rays,
/// images).
pub fn compute(execution: Execution, operation: &Operation, inputs: &[&[[f32; 4]]]) -> Option<Vec<[f32; 4]>> {
    let mut graph = Graph::default();
    let leaf = || Operation::Primvar { name: String::new(), fallback: [0.0; 4] };
    let leaves: Vec<Input> = inputs.iter().map(|_| Input::Node(graph.add(leaf(), Vec::new()), Channel::Rgb)).collect();
    let node = graph.add(operation.clone(), leaves);
    let mut asks_for_more = false;
    let code = Code::new(&graph, |number, _| {
        asks_for_more |= number == inputs.len();
        Hit::Step(number)
    });
    if asks_for_more {
        return None;
    }
    let (program, sources) = Program::new(&code, &code.value(Input::Node(node, Channel::Rgb)));
    let mut out = vec![[0.0; 4]; inputs.first().map_or(1, |input| input.len())];
    let mut registers = Registers::default();
    for (number, chunk) in out.chunks_mut(CHUNK).enumerate() {
        dispatch!(execution, l => chunk_of(l, &program, &sources, inputs, number * CHUNK, &mut registers, chunk));
    }
    Some(out)
}

/// Runs a program for the entries from `first` on.
#[inline(always)]
fn chunk_of<L: Lanes>(
    l: L,
    program: &Program<usize>,
    sources: &[Source],
    inputs: &[&[[f32; 4]]],
    first: usize,
    registers: &mut Registers,
    out: &mut [[f32; 4]],
) {
    program.run(l, out.len(), registers, |number, io| {
        for component in 0..4 {
            let column = io.output(component);
            for (place, value) in column.iter_mut().zip(&inputs[*number][first..first + out.len()]) {
                *place = value[component];
            }
        }
    });
    for (component, source) in sources.iter().enumerate() {
        for (entry, value) in out.iter_mut().enumerate() {
            value[component] = registers.entry(*source, entry);
        }
    }
}
