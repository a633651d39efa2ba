//! Determinants and inverses of matrices that vary over the surface, by minors of two rows (Laplace's expansion).

use super::super::emit::{add, combine, component, divide, multiply, subtract};
use gonio::scene::{Graph, Input};

/// Rows of a matrix, filled up with those of the unit matrix.
pub(super) type Rows = [Input; 4];

/// Pairs of columns.
const PAIRS: [[usize; 2]; 6] = [[0, 1], [0, 2], [0, 3], [1, 2], [1, 3], [2, 3]];
/// The other two columns of each, and whether the expansion subtracts their product.
const REST: [(usize, bool); 6] = [(5, false), (4, true), (3, false), (2, false), (1, true), (0, false)];

/// Determinants of all pairs of columns of two rows.
fn minors(graph: &mut Graph, upper: Input, lower: Input) -> [Input; 6] {
    PAIRS.map(|[a, b]| {
        let products = [(a, b), (b, a)].map(|(a, b)| multiply(graph, component(upper, a), component(lower, b)));
        subtract(graph, products[0], products[1])
    })
}

pub(super) fn determinant(graph: &mut Graph, rows: &Rows) -> Input {
    let (upper, lower) = (minors(graph, rows[0], rows[1]), minors(graph, rows[2], rows[3]));
    let mut sum = None;
    for (pair, (other, is_minus)) in REST.into_iter().enumerate() {
        let product = multiply(graph, upper[pair], lower[other]);
        sum = Some(match sum {
            None => product,
            Some(sum) if is_minus => subtract(graph, sum, product),
            Some(sum) => add(graph, sum, product),
        });
    }
    sum.unwrap_or(Input::Constant([0.0; 4]))
}

/// The inverse; zeros where there is none.
pub(super) fn inverse(graph: &mut Graph, rows: &Rows) -> Rows {
    let (upper, lower) = (minors(graph, rows[0], rows[1]), minors(graph, rows[2], rows[3]));
    let determinant = determinant(graph, rows);
    // A column of the inverse leaves out one row: what is left are another of its half and the minors of the other half.
    let columns = [(1, lower, false), (0, lower, true), (3, upper, false), (2, upper, true)];
    [0, 1, 2, 3].map(|left_out| {
        let parts = columns.map(|(row, minors, is_minus)| {
            let value = cofactor(graph, rows[row], &minors, left_out, is_minus != (left_out % 2 == 1));
            divide(graph, value, determinant)
        });
        combine(graph, &parts)
    })
}

/// The determinant of a row over two rows whose minors are known, without a column; negated if so asked.
fn cofactor(graph: &mut Graph, row: Input, minors: &[Input; 6], left_out: usize, is_minus: bool) -> Input {
    let kept: Vec<usize> = (0..4).filter(|column| *column != left_out).collect();
    let minor = |a: usize, b: usize| minors[PAIRS.iter().position(|pair| *pair == [a, b]).unwrap_or(0)];
    let products =
        [(0, [1, 2]), (1, [0, 2]), (2, [0, 1])].map(|(at, [a, b])| multiply(graph, component(row, kept[at]), minor(kept[a], kept[b])));
    let outer = add(graph, products[0], products[2]);
    if is_minus { subtract(graph, products[1], outer) } else { subtract(graph, outer, products[1]) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn inverses_undo() {
        let mut graph = Graph::default();
        let numbers = [[2.0, -1.0, 0.5, 0.25], [0.0, 3.0, 1.0, -2.0], [1.0, 0.5, -1.5, 4.0], [0.75, 2.0, 1.0, 1.0]];
        let inverse = inverse(&mut graph, &numbers.map(Input::Constant));
        for (row, numbers) in numbers.iter().enumerate() {
            for column in 0..4 {
                let product: f32 = inverse.iter().zip(numbers).map(|(other, x)| constant(*other)[column] * x).sum();
                assert!((product - f32::from(u8::from(row == column))).abs() < 1e-5, "{row} {column}: {product}");
            }
        }
        // Expanded by hand.
        let diagonal = [[2.0, 0.0, 0.0, 0.0], [7.0, 3.0, 0.0, 0.0], [1.0, 5.0, -1.0, 0.0], [9.0, 2.0, 1.0, 4.0]];
        assert_eq!(constant(determinant(&mut graph, &diagonal.map(Input::Constant)))[0], -24.0);
    }

    fn constant(input: Input) -> [f32; 4] {
        match input {
            Input::Constant(values) => values,
            Input::Node(..) => panic!("constants fold"),
        }
    }
}
