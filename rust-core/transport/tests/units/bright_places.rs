//! Where light paths go on.

use gonio_simd::{Execution, Lanes, Vec3, dispatch};
use gonio_transport::ArrivalCells;

#[test]
fn both_sides_know_the_same_share() {
    let mut cells = ArrivalCells::new(20.0);
    for number in 0..4000 {
        let x = (number % 63) as f32 * 0.05 - 1.5;
        cells.add([x, 0.0, (number / 63) as f32 * 0.05 - 1.5], 1.0);
    }
    let spot = [0.3, 0.2, -0.7];
    (0..4000).for_each(|_| cells.add(spot, 1.0));
    // 0.005 paths of 8000 a square metre elsewhere, half of them on 0.024 m² in the spot, and pixels spread over a square metre.
    let places = cells.bright_places(1.0 / 8000.0, 1.0);
    dispatch!(Execution::best(), l => {
        let at = |p: [f32; 3]| places.carried_on(Vec3::splat(l, p), l.m(true)).to_array()[0];
        assert!(at(spot) == 1.0 && at([0.301, 0.2001, -0.701]) == 1.0);
        assert_eq!((at([0.5, 0.0, 0.5]), at([9.0, 1.0, 3.0])), (0.0, 0.0));
        assert_eq!(places.carried_on(Vec3::splat(l, spot), l.m(false)).to_array()[0], 0.0);
    });
    assert!(ArrivalCells::new(1.0).bright_places(1.0, 1.0).is_empty());
}

#[test]
fn one_path_among_faint_ones_makes_no_place_bright() {
    let mut cells = ArrivalCells::new(20.0);
    (0..1000).for_each(|_| cells.add([0.0; 3], 1e-6));
    cells.add([0.0; 3], 1.0);
    assert!(cells.bright_places(1e-3, 1.0).is_empty());
    (0..100).for_each(|_| cells.add([0.0; 3], 1.0));
    assert!(!cells.bright_places(1e-3, 1.0).is_empty());
}
