//! The diagrams hold the numbers they are for.

use crate::{steps, type_c};
use gonio_formats::photometry::{PolarUnit, cone_diagram, polar_diagram};

#[test]
fn the_cone_tells_illuminance_and_width() {
    let tent = type_c(&[0.0, 90.0], &[0.0], |_, gamma| 1000.0 - gamma * 100.0 / 9.0);
    let svg = cone_diagram(&tent);
    // Half at 45 degrees: as wide as twice the distance.
    for text in ["1 m, 1000 lx", "2 m, 250 lx", "5 m, 40 lx", "10 m, 10 m", "beam 90.0°"] {
        assert!(svg.contains(text), "{text} in {svg}");
    }
    roxmltree::Document::parse(&svg).unwrap();
}

#[test]
fn the_polar_diagram_has_round_rings() {
    let isotropic = type_c(&steps(0.0, 180.0, 18), &[0.0], |_, _| 470.0);
    let svg = polar_diagram(&isotropic, PolarUnit::Candela);
    for ring in [">100<", ">500<", "cd, 5906 lm"] {
        assert!(svg.contains(ring), "{ring} in {svg}");
    }
    roxmltree::Document::parse(&svg).unwrap();
    let per_kilolumen = polar_diagram(&isotropic, PolarUnit::CandelaPerKilolumen);
    assert!(per_kilolumen.contains("cd/klm") && per_kilolumen.contains(">80<"), "{per_kilolumen}");
    let dark = type_c(&[0.0, 90.0], &[0.0], |_, _| 0.0);
    roxmltree::Document::parse(&polar_diagram(&dark, PolarUnit::Candela)).unwrap();
    roxmltree::Document::parse(&cone_diagram(&dark)).unwrap();
}
