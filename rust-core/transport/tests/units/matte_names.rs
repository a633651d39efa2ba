//! Names of placements in cryptomattes.

use gonio_transport::geometry::InstanceRow;
use gonio_transport::{MatteNames, NameRun};

#[test]
fn placements_of_a_set_have_names_of_their_own() {
    let run = |first, object| NameRun { first, object, asset: object + 1 };
    let names = MatteNames::new([vec![run(0, 10)], vec![run(0, 20), run(3, 30)], Vec::new()].into_iter());
    let of = |set, number| names.of(&InstanceRow { set, number, ..InstanceRow::default() });
    assert_eq!([of(0, 0), of(0, 7), of(1, 0), of(1, 2), of(1, 3), of(1, 9)], [[10, 11], [10, 11], [20, 21], [20, 21], [30, 31], [30, 31]]);
    assert_eq!(of(2, 0), [0; 2]);
}
