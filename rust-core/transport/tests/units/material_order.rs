//! Hits in the order of their materials.

use gonio_accel::NONE;
use gonio_simd::{Execution, PADDING};
use gonio_transport::order_by_material;

#[test]
fn paths_of_one_material_stay_in_their_order_at_every_level() {
    let runs = (0..100u32).map(|i| if i < 40 { 2 } else { i.wrapping_mul(2_654_435_761) >> 29 });
    let material_of: Vec<u32> = runs.map(|material| if material > 4 { NONE } else { material }).chain([NONE; 12]).collect();
    let mut expected: Vec<u32> = (0..100).filter(|path| material_of[*path as usize] != NONE).collect();
    expected.sort_by_key(|path| material_of[*path as usize]);
    for execution in Execution::all() {
        let (mut order, mut starts, mut ends) = (Vec::new(), Vec::new(), Vec::new());
        order_by_material(execution, 5, &material_of, &mut order, &mut starts, &mut ends);
        let ranges = starts.iter().zip(&ends).map(|(start, end)| *start as usize..*end as usize);
        let sorted: Vec<u32> = ranges.flat_map(|range| order[range].to_vec()).collect();
        assert_eq!(sorted, expected, "{execution:?}");
        assert!(order.len() >= ends[4] as usize + PADDING);
    }
}
