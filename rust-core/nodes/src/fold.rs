//! Single operations on constants.

use crate::{Channel, Code, Graph, Hit, Input, Operation, code::constants};

/// What an operation gives for constants, by its scalar kernel; none for those that ask for more than their inputs. What is not finite counts
/// as zero.
pub fn fold(operation: &Operation, inputs: &[[f32; 4]]) -> Option<[f32; 4]> {
    let mut graph = Graph::default();
    let node = graph.add(operation.clone(), inputs.iter().map(|value| Input::Constant(*value)).collect());
    let code = Code::new(&graph, |_, _| Hit::Step(()));
    constants(code.value(Input::Node(node, Channel::Rgb)))
}
