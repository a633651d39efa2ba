//! Matrices: they never reach the graph as such, only as the rows that vectors are multiplied with.

use super::super::emit::{add, combine, component, mix, multiply, scalar, subtract};
use super::super::network::{Network, Shader};
use super::super::neutral::{Source, Value};
use super::super::value::UNIT_MATRIX;
use super::{
    math::{condition, dot},
    split,
    varying_matrices::{self as varying, Rows},
};
use gonio::scene::{Graph, Input};

/// The rows of the matrix in an input, the unit matrix where nothing is said; `None` where it comes from a node that gives none.
pub(super) fn rows(network: &mut Network<'_>, shader: &Shader, name: &str) -> Option<Rows> {
    match network.source(shader, name) {
        Source::Value(Value::Matrix(rows, _), _) => Some(rows.map(Input::Constant)),
        Source::Output(node, _) => {
            let node = network.shader(node);
            network.within(&node, |network| of_node(network, &node)).flatten()
        }
        _ => Some(UNIT_MATRIX.map(Input::Constant)),
    }
}

fn of_node(network: &mut Network<'_>, node: &Shader) -> Option<Rows> {
    if let Some(rows) = defined(network, node) {
        return Some(rows);
    }
    match split(&node.id).0 {
        "constant" => rows(network, node, "value"),
        "dot" => rows(network, node, "in"),
        "creatematrix" => {
            let is_small = node.id.contains("vector3_matrix44");
            let mut result = UNIT_MATRIX.map(Input::Constant);
            for (index, name) in ["in1", "in2", "in3", "in4"].into_iter().enumerate() {
                let Some(row) = network.input(node, name) else { continue };
                // Rows of three are filled up with those of the unit matrix.
                let last = if index == 3 { 1.0 } else { 0.0 };
                let parts = [component(row, 0), component(row, 1), component(row, 2), scalar(last)];
                result[index] = if is_small { combine(&mut network.graph, &parts) } else { row };
            }
            Some(result)
        }
        "transpose" => rows(network, node, "in").map(|rows| transposed(&mut network.graph, &rows)),
        "invertmatrix" => rows(network, node, "in").and_then(|rows| inverse(&mut network.graph, &rows)),
        "add" | "subtract" => {
            let a = rows(network, node, "in1")?;
            let is_same = node.id.ends_with("FA");
            let b = if is_same { [network.scalar(node, "in2", 0.0); 4] } else { rows(network, node, "in2")? };
            let graph = &mut network.graph;
            let is_sum = split(&node.id).0 == "add";
            Some([0, 1, 2, 3].map(|row| if is_sum { add(graph, a[row], b[row]) } else { subtract(graph, a[row], b[row]) }))
        }
        "ifgreater" | "ifgreatereq" | "ifequal" => {
            let condition = component(condition(network, node)?, 0);
            let (a, b) = (rows(network, node, "in1")?, rows(network, node, "in2")?);
            Some([0, 1, 2, 3].map(|row| mix(&mut network.graph, b[row], a[row], condition)))
        }
        "multiply" => {
            let (a, b) = (rows(network, node, "in1")?, rows(network, node, "in2")?);
            Some(a.map(|row| times(&mut network.graph, row, &b, 4)))
        }
        "divide" => {
            let (a, b) = (rows(network, node, "in1")?, rows(network, node, "in2")?);
            let b = inverse(&mut network.graph, &b)?;
            Some(a.map(|row| times(&mut network.graph, row, &b, 4)))
        }
        _ => None,
    }
}

/// The matrix that a graph gives in the place of a node that it defines.
fn defined(network: &mut Network<'_>, node: &Shader) -> Option<Rows> {
    let is_computed = super::row(&node.id).is_some();
    let outputs = if is_computed { None } else { network.expanded(node) }?;
    match &outputs.first()?.1 {
        Source::Value(Value::Matrix(rows, _), _) => Some(rows.map(Input::Constant)),
        Source::Output(inner, _) => {
            let inner = network.shader(*inner);
            network.within(&inner, |network| of_node(network, &inner)).flatten()
        }
        _ => None,
    }
}

fn transposed(graph: &mut Graph, rows: &Rows) -> Rows {
    let mut result = *rows;
    for (index, row) in result.iter_mut().enumerate() {
        let parts = rows.map(|row| component(row, index));
        *row = combine(graph, &parts);
    }
    result
}

/// A row vector times a matrix.
fn times(graph: &mut Graph, vector: Input, rows: &Rows, width: usize) -> Input {
    let mut sum = scalar(0.0);
    for (index, row) in rows.iter().enumerate().take(width) {
        let part = multiply(graph, component(vector, index), *row);
        sum = add(graph, sum, part);
    }
    sum
}

/// The numbers of a matrix that does not vary.
fn constant(rows: &Rows) -> Option<[[f64; 4]; 4]> {
    let mut numbers = [[0.0; 4]; 4];
    for (numbers, row) in numbers.iter_mut().zip(rows) {
        let Input::Constant(row) = row else { return None };
        *numbers = row.map(f64::from);
    }
    Some(numbers)
}

/// By elimination in double precision, where it does not vary; `None` for matrices that have no inverse.
fn inverse(graph: &mut Graph, rows: &Rows) -> Option<Rows> {
    let Some(mut left) = constant(rows) else { return Some(varying::inverse(graph, rows)) };
    let mut right = UNIT_MATRIX.map(|row| row.map(f64::from));
    for column in 0..4 {
        let pivot = (column..4).max_by(|a, b| left[*a][column].abs().total_cmp(&left[*b][column].abs()))?;
        left.swap(column, pivot);
        right.swap(column, pivot);
        let scale = left[column][column];
        if scale == 0.0 {
            return None;
        }
        left[column] = left[column].map(|x| x / scale);
        right[column] = right[column].map(|x| x / scale);
        for row in (0..4).filter(|row| *row != column) {
            let factor = left[row][column];
            for i in 0..4 {
                left[row][i] -= factor * left[column][i];
                right[row][i] -= factor * right[column][i];
            }
        }
    }
    Some(right.map(|row| Input::Constant(row.map(|x| x as f32))))
}

/// A vector as a row times a matrix; what is shorter than the matrix ends in 1.
pub(super) fn transform(network: &mut Network<'_>, shader: &Shader, kind: &str) -> Option<Input> {
    let [input] = network.inputs(shader, [("in", 0.0)]);
    let rows = rows(network, shader, "mat")?;
    let graph = &mut network.graph;
    let width = match kind {
        "vector2M3" => 2,
        "vector4" => 4,
        _ => 3,
    };
    let product = times(graph, input, &rows, width);
    Some(if matches!(kind, "vector2M3" | "vector3M4") { add(graph, product, rows[width]) } else { product })
}

pub(super) fn determinant(network: &mut Network<'_>, shader: &Shader, kind: &str) -> Option<Input> {
    let rows = rows(network, shader, "in")?;
    if kind == "matrix44" {
        return Some(constant_determinant(&rows).map_or_else(|| varying::determinant(&mut network.graph, &rows), scalar));
    }
    let graph = &mut network.graph;
    let cross = super::math::cross(graph, &[rows[1], rows[2]]);
    Some(dot(graph, rows[0], cross, 3))
}

/// Expanded along the first row; `None` for matrices that vary.
fn constant_determinant(rows: &Rows) -> Option<f32> {
    let m = constant(rows)?;
    let minor = |skip: usize| {
        let c: Vec<usize> = (0..4).filter(|column| *column != skip).collect();
        m[1][c[0]] * (m[2][c[1]] * m[3][c[2]] - m[2][c[2]] * m[3][c[1]]) - m[1][c[1]] * (m[2][c[0]] * m[3][c[2]] - m[2][c[2]] * m[3][c[0]])
            + m[1][c[2]] * (m[2][c[0]] * m[3][c[1]] - m[2][c[1]] * m[3][c[0]])
    };
    let sign = |column: usize| if column.is_multiple_of(2) { 1.0 } else { -1.0 };
    Some((0..4).map(|column| sign(column) * m[0][column] * minor(column)).sum::<f64>() as f32)
}
