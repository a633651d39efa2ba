//! The course of the three wavelengths.

use super::Triples;
use crate::{
    integral::{Integral, VISIBLE},
    white::{colour, solved},
};

/// Where the short wavelength ends and the middle one begins, and where that ends and the long one begins, nm. They are nearly complementary:
/// white is made of these two, and the third, at an end of the visible, begins and ends with a share below 2 %. A search found speeds above zero on
/// one side of the line of complementary pairs, cells of even width near it; colour noise of lamps hardly depends on the pair.
const STARTS: [f64; 2] = [478.06, 576.56];

/// The most of Newton's steps; six are taken at most.
const STEPS: usize = 30;

/// The edges of the cells, as [`super::Triples::edges`].
///
/// Integrated over u, the condition on the speeds says that the light which the three have passed is u times white. So each triple of edges is
/// the solution of three equations, found by Newton's method from the triple before.
pub(super) fn edges() -> Vec<[f64; 3]> {
    let [first, last] = VISIBLE;
    let [a, b] = STARTS;
    let light = Integral::new(&[], colour);
    let passed = |triple: [f64; 3]| {
        let [long, middle, short] = triple.map(|nm| light.to(nm));
        std::array::from_fn::<f64, 3, _>(|k| long[k] + middle[k] + short[k])
    };
    let mut triple = [b, a, first];
    let start = passed(triple);
    let mut edges = vec![triple];
    for cell in 1..Triples::COUNT {
        let white = cell as f64 / Triples::COUNT as f64;
        for _ in 0..STEPS {
            let now = passed(triple);
            let step = solved(triple.map(colour), std::array::from_fn(|k| start[k] + white - now[k]));
            triple = std::array::from_fn(|k| (triple[k] + step[k]).clamp(first, last));
            if step.iter().all(|step| step.abs() < 1e-9) {
                break;
            }
        }
        edges.push(triple);
    }
    edges.push([last, b, a]);
    edges
}
