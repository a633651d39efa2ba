//! Good files to start from.

use gonio_volume::{Grid, Packing, Tile, Transform, Values, to_bytes};

/// Grids of all kinds that can be written, packed and not.
pub(crate) fn seeds() -> Vec<Vec<u8>> {
    let shape = [9, 7, 10];
    let values: Vec<f32> = (0..shape.iter().product::<usize>()).map(|n| (n % 11) as f32 / 8.0).collect();
    let Ok(mut float) = Grid::from_dense("density", &values, shape, Transform::uniform(0.1, [1.0, 2.0, 3.0])) else {
        return Vec::new();
    };
    float.tiles = vec![
        Tile { origin: [64, 0, 8], log2_edge: 3, active: true, value: [1.0; 3] },
        Tile { origin: [-128, 0, 0], log2_edge: 7, active: true, value: [0.5; 3] },
        Tile { origin: [4096, -4096, 0], log2_edge: 12, active: false, value: [-1.0; 3] },
    ];
    let numbers: Vec<f32> = (0..float.values.len()).map(|n| float.values.get(n)[0]).collect();
    let half = Grid { values: Values::Half(numbers.iter().map(|x| half::f16::from_f32(*x)).collect()), ..float.clone() };
    let vector = Grid { name: "v".into(), values: Values::Vector(numbers.iter().map(|x| [*x, -x, 2.0 * x]).collect()), ..float.clone() };
    let sets: [&[&Grid]; 4] = [&[&float], &[&half], &[&vector, &float], &[&float, &float, &half]];
    sets.into_iter().flat_map(|set| [Packing::None, Packing::Zip].map(|packing| to_bytes(set, packing))).filter_map(Result::ok).collect()
}
