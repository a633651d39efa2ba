//! Files that are wrong: one message with its line, and no panic whatever the bytes.

use crate::{Road, Table};
use std::{fs, path::PathBuf};

const ROAD: &str = r#"[road]
carriageway_width = 7
lanes = 2
surface = "lambert"
reflectance = 0.2

[[row]]
luminaire = "lamp.ies"
spacing = 30
height = 8
side = "right"

[[footpath]]
side = "left"
width = 2
required = { e_av = 5 }

[required]
l_av = 0.5

[[period]]
hours = 4000

[[class]]
name = "A"
ul = 0.6

[optimise]
spacing = [20, 40]
"#;
const LAMP: &str = "IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 2 1 1 2 0 0 0\n1 1 10\n0 90\n0\n100 100\n";

/// A folder with the luminaire, and the path of a road in it.
fn folder(name: &str) -> PathBuf {
    let folder = std::env::temp_dir().join(format!("gonio-road-{name}-{}", std::process::id()));
    fs::create_dir_all(&folder).expect("a folder");
    fs::write(folder.join("lamp.ies"), LAMP).expect("a luminaire");
    folder.join("road.toml")
}

#[test]
fn messages_tell_the_line() {
    let path = folder("lines");
    for (from, to, expected) in [
        ("width = 2", "width = -2", "road.toml:15: [[footpath]] 1: width is -2, expected a number above 0"),
        ("l_av = 0.5", "lav = 0.5", "road.toml:19: [required]: the key 'lav' is not known; did you mean 'l_av'?"),
        ("e_av = 5", "l_av = 5", "road.toml:16: [[footpath]] 1: required: the key 'l_av' is not known"),
        ("hours = 4000", "hours = 9000", "road.toml:22: [[period]] 1: hours is 9000"),
        ("[20, 40]", "[40, 20]", "road.toml:29: [optimise]: spacing goes from 40 to 20"),
        ("[20, 40]", "[20]", "road.toml:29: [optimise]: spacing is not a list of 2 numbers"),
        ("ul = 0.6", "", "road.toml:25: [[class]] 1: name is 'A', which requires nothing"),
        ("name = \"A\"", "", "road.toml:24: [[class]] 1: name is missing"),
        ("ul = 0.6", "ull = 0.6", "road.toml:26: [[class]] 1: the key 'ull' is not known; did you mean 'ul'?"),
        ("[[row]]", "[row]", "road.toml:7: the road's file: row is not a list of tables, expected [[row]]"),
        ("side = \"right\"", "", "[[row]] 1: side is missing, expected one of left, right, opposite, staggered"),
        ("\"lamp.ies\"", "\".\"", "[[row]] 1: luminaire names"),
        ("[road]", "[raod]", "road.toml:1: the road's file: the key 'raod' is not known; did you mean 'road'?"),
    ] {
        fs::write(&path, ROAD.replace(from, to)).expect("a file");
        let told = Road::read(&path).expect_err("it is wrong").to_string();
        assert!(told.contains(expected) && !told.contains('\n'), "{told}");
    }
    let aimless = ROAD.replace("l_av = 0.5", "").replace("required = { e_av = 5 }", "");
    fs::write(&path, aimless).expect("a file");
    let told = Road::read(&path).expect_err("it is wrong").to_string();
    assert!(told.contains("road.toml:28: the road's file: optimise has nothing to meet"), "{told}");
    fs::write(&path, ROAD).expect("a file");
    Road::read(&path).expect("a road");
    fs::remove_dir_all(path.parent().expect("a folder")).expect("to be removed");
}

#[test]
fn bytes_that_are_lost_or_changed_break_nothing() {
    let path = folder("bytes");
    for index in 0..ROAD.len() {
        let mut bytes = ROAD.as_bytes().to_vec();
        let lost = bytes.remove(index);
        fs::write(&path, &bytes).expect("a file");
        let _ = Road::read(&path);
        for other in *b"\0-\xff" {
            bytes.insert(index, other);
            fs::write(&path, &bytes).expect("a file");
            let _ = Road::read(&path);
            bytes.remove(index);
        }
        bytes.insert(index, lost);
    }
    fs::remove_dir_all(path.parent().expect("a folder")).expect("to be removed");
}

#[test]
fn tables_that_are_none_are_told() {
    for (text, expected) in [
        ("", "no numbers"),
        ("0 90 180\n", "expected 2 to 1000"),
        ("t 0 90 180\n0 1 2 3\n", "1 lines of tan γ"),
        ("t 10 90 180\n0 1 2 3\n1 1 2 3\n", "line 1: the first β is not 0"),
        ("t 0 90 90 180\n0 1 2 3 4\n1 1 2 3 4\n", "line 1: β 90 does not follow 90"),
        ("t 0 90 180\n1 1 2 3\n2 1 2 3\n", "the first tan γ is not 0"),
        ("t 0 90 180\n0 1 2 1e99\n1 1 2 3\n", "line 2: '1e99' was found"),
        ("t 0 90 180\n0 1 2\n1 1 2 3\n", "line 2: 3 numbers, expected 4"),
    ] {
        let told = Table::read(text.as_bytes()).expect_err("it is wrong").to_string();
        assert!(told.contains(expected), "{told}");
    }
    assert!(Table::read(b"\xff\xfe").is_err());
}
