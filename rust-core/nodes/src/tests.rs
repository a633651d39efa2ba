//! Code and programs: folding, sharing, pruning, columns used again.

use crate::*;
use gonio_simd::{Execution, dispatch};

fn node(id: NodeId) -> Input {
    Input::Node(id, Channel::Rgb)
}

fn number(x: f32) -> Input {
    Input::Constant([x; 4])
}

/// Runs a graph whose leaves are positions: components 1, 2, 3 times the entry's number.
fn run(graph: &Graph, input: Input, execution: Execution) -> (Vec<[f32; 4]>, usize) {
    let code = Code::new(graph, |_, _| Hit::Step(()));
    let (program, sources) = Program::new(&code, &code.value(input));
    let mut registers = Registers::default();
    dispatch!(execution, l => program.run(l, CHUNK, &mut registers, |(), io| {
        for component in 0..3 {
            io.output(component).iter_mut().enumerate().for_each(|(i, x)| *x = (component + 1) as f32 * i as f32);
        }
    }));
    let entry = |i: usize| std::array::from_fn(|component| registers.entry(sources[component], i));
    ((0..CHUNK).map(entry).collect(), program.kernels().count())
}

#[test]
fn constants_are_folded_and_equal_steps_shared() {
    let mut graph = Graph::default();
    let position = graph.add(Operation::Position, vec![]);
    let two = graph.add(Operation::Add, vec![number(1.0), number(1.0)]);
    let first = graph.add(Operation::Multiply, vec![node(position), node(two)]);
    let again = graph.add(Operation::Multiply, vec![node(position), number(2.0)]);
    let sum = graph.add(Operation::Add, vec![node(first), node(again)]);
    for execution in Execution::all() {
        let (values, steps) = run(&graph, node(sum), execution);
        assert_eq!(values[7], [28.0, 56.0, 84.0, 0.0]);
        // The position, and a product and a sum of each of three components.
        assert_eq!(steps, 7);
        let (values, steps) = run(&graph, Input::Node(sum, Channel::G), execution);
        assert_eq!((values[7], steps), ([56.0; 4], 3));
    }
}

#[test]
fn columns_are_used_again_and_never_while_they_are_read() {
    let mut graph = Graph::default();
    let position = graph.add(Operation::Position, vec![]);
    let mut sum = position;
    for step in 0..200 {
        let operation = [Operation::Add, Operation::Subtract, Operation::Cross, Operation::Maximum][step % 4].clone();
        let turned = graph.add(operation, vec![node(sum), number(0.5)]);
        sum = graph.add(Operation::Mix, vec![node(turned), node(position), number(0.25)]);
    }
    let code = Code::new(&graph, |_, _| Hit::Step(()));
    let (program, _) = Program::new(&code, &code.value(node(sum)));
    assert_eq!(program.piece(), CHUNK, "a chain needs few columns");
    let all: Vec<_> = Execution::all().into_iter().map(|execution| run(&graph, node(sum), execution).0).collect();
    for (scalar, wide) in all[0].iter().zip(&all[all.len() - 1]) {
        (0..4).for_each(|k| assert!((scalar[k] - wide[k]).abs() <= 1e-4 * scalar[k].abs().max(1.0), "{scalar:?} {wide:?}"));
    }
}

#[test]
fn arrays_are_computed_by_the_kernels() {
    let a: Vec<[f32; 4]> = (0..1000).map(|i| [i as f32, 1.0, -1.0, 0.5]).collect();
    let b = vec![[0.5, 2.0, 3.0, 4.0]; 1000];
    let found = compute(Execution::detect(), &Operation::Multiply, &[&a, &b]).expect("arithmetic");
    assert_eq!(found[999], [499.5, 2.0, -3.0, 2.0]);
    let found = compute(Execution::detect(), &Operation::Combine, &[&a, &b]).expect("arithmetic");
    assert_eq!(found[3], [3.0, 0.5, 0.0, 0.0]);
    assert_eq!(compute(Execution::detect(), &Operation::Normal, &[]), None);
}

#[test]
fn remainders_have_the_sign_of_the_dividend() {
    for (a, b) in
        [(7.5, 2.0), (-7.5, 2.0), (1e3, 0.7), (1e6, 0.1), (3e7, 0.01), (-1e4, 0.3), (5.0, 5.0), (0.3, 0.1), (1.0, 0.0), (3.0, -2.0)]
    {
        let expected = if b == 0.0 { 0.0 } else { a % b };
        let found = compute(Execution::Scalar, &Operation::Modulo, &[&[[a; 4]], &[[b; 4]]]).expect("arithmetic");
        assert_eq!(found[0][0], expected, "{a} % {b}");
    }
}

#[test]
fn powers_of_negative_bases_want_whole_exponents() {
    for (a, b, expected) in [(-2.0, 3.0, -8.0), (-2.0, -2.0, 0.25), (-2.0, 0.5, 0.0), (0.0, 0.0, 1.0), (0.0, 2.0, 0.0), (-3.0, 0.0, 1.0)] {
        let found = compute(Execution::Scalar, &Operation::Power, &[&[[a; 4]], &[[b; 4]]]).expect("arithmetic");
        assert!((found[0][0] - expected as f32).abs() < 1e-5, "{a} ** {b}: {}", found[0][0]);
    }
}
