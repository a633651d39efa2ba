//! What is wrong with a fixture's file.

use crate::zip::{Packed, archive, packed as packed_files};
use crate::{DESCRIPTION, fixture, packed};
use gonio_formats::gdtf::Gdtf;
use gonio_formats::photometry::read;
use std::fmt::Write;

fn problem(bytes: &[u8]) -> String {
    Gdtf::read(bytes).unwrap_err().to_string()
}

fn warnings(description: &str) -> String {
    Gdtf::read(&packed(description)).unwrap().warnings.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n")
}

#[test]
fn what_is_no_fixture_is_refused() {
    assert!(problem(b"GDTF").starts_with("no ZIP archive that can be read"));
    assert!(
        problem(&archive(&[("a.txt", b"x")]))
            .contains("no description.xml is in the archive, expected one in a GDTF file; it holds 'a.txt'")
    );
    assert!(problem(&packed("<GDTF>")).starts_with("description.xml: line 1: not XML"));
    assert!(problem(&packed("<Root/>")).contains("line 1: <Root> was found, expected <GDTF>"));
    assert!(problem(&packed("<GDTF/>")).contains("no <FixtureType> was found"));
    assert!(problem(&packed("<!DOCTYPE a [<!ENTITY b \"cc\">]>\n<GDTF>&b;</GDTF>")).contains("line 1: not XML"));
    // By its ending, where nothing else tells.
    assert!(read(&archive(&[("a.txt", b"x")]), "a.gdtf").unwrap_err().to_string().contains("description.xml"));
    assert!(read(&archive(&[("a.txt", b"x")]), "a.gldf").unwrap_err().to_string().contains("product.xml"));
}

#[test]
fn sizes_that_lie_are_refused() {
    let found = problem(&packed_files(&[Packed("description.xml", DESCRIPTION.as_bytes(), u32::MAX)]));
    assert!(found.contains("description.xml: 4294967295 bytes are stated"), "{found}");
    let found = problem(&packed_files(&[Packed("description.xml", DESCRIPTION.as_bytes(), 40)]));
    assert!(found.contains("cannot be unpacked to the 40 bytes"), "{found}");
}

#[test]
fn modes_without_light_say_so() {
    let fixture = fixture();
    let found = fixture.goniogram(&fixture.modes[3]).unwrap_err().problem;
    assert_eq!(found, "the mode 'Dark' has no beam");
    let text = DESCRIPTION.replace("12000", "0");
    assert!(read(&packed(&text), "a.gdtf").unwrap_err().problem.contains("has no beam that has a flux"));
}

#[test]
fn wrong_values_are_told_with_their_line() {
    let cases = [
        (
            DESCRIPTION.replace("\"12000\"", "\"-5\""),
            "description.xml: line 13: LuminousFlux is '-5', expected a number that is not negative: 10000 is taken",
        ),
        (DESCRIPTION.replace("BeamAngle=\"20\"", "BeamAngle=\"0\""), "line 13: BeamAngle is 0°: 0.1° is taken"),
        (DESCRIPTION.replace("\"Fresnel\"", "\"Laser\""), "line 13: the beam type 'Laser' is unknown: Wash is taken"),
        (DESCRIPTION.replace("EmitterSpectrum=\"White\"", "EmitterSpectrum=\"Red\""), "line 13: no emitter 'Red' is defined"),
        (DESCRIPTION.replace("Name=\"one\" Geometry=\"Base\"", "Name=\"one\" Geometry=\"Bass\""), "line 16: no geometry 'Bass' is defined"),
        (DESCRIPTION.replace("Name=\"Standard\" Geometry=\"Base\"", "Name=\"Standard\""), "line 22: no geometry '' is defined"),
        (DESCRIPTION.replace("{0,0,1,-0.225}", "{0,0,1}"), "line 12: Position is"),
        (DESCRIPTION.replace("WaveLength=\"780\" ", ""), "line 7: a point of the emitter 'White' has no WaveLength and Energy"),
    ];
    for (text, expected) in cases {
        let found = warnings(&text);
        assert!(found.contains(expected), "{found}: {expected}");
        assert_eq!(found.lines().count(), 1, "{found}");
    }
}

#[test]
fn circles_and_trees_of_references_end() {
    let fixture = |geometries: &str| {
        format!(
            "<GDTF><FixtureType><Geometries>{geometries}</Geometries><DMXModes><DMXMode Name=\"m\" Geometry=\"g0\"/></DMXModes></FixtureType></GDTF>"
        )
    };
    let circle = fixture("<Geometry Name=\"g0\"><GeometryReference Geometry=\"g0\"/></Geometry>");
    assert!(problem(&packed(&circle)).contains("more than 64 geometries hang on one another"));
    // Each of twenty stands for two of the next: a million beams.
    let mut tree = String::new();
    for level in 0..20 {
        let next = format!("<GeometryReference Geometry=\"g{}\"/>", level + 1);
        write!(tree, "<Geometry Name=\"g{level}\">{next}{next}</Geometry>").unwrap();
    }
    tree += "<Beam Name=\"g20\"/>";
    let found = problem(&packed(&fixture(&tree)));
    assert!(found.contains("a mode has more than 4096 beams") || found.contains("more than 65536 geometries are placed"), "{found}");
}

#[test]
fn cut_archives_never_panic() {
    let bytes = packed(DESCRIPTION);
    for end in 0..bytes.len() {
        let _ = Gdtf::read(&bytes[..end]);
    }
}
