//! What is no goniogram: one clear line with the line's number.

use crate::ldt::Text;
use gonio_formats::photometry::{ies, ldt, read};

const GOOD: &str = "IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 3 2 1 2 0 0 0\n1 1 20\n0 45 90\n0 90\n10 9 8\n7 6 5\n";

fn problem(from: &str, to: &str) -> String {
    let text = GOOD.replacen(from, to, 1);
    assert_ne!(text, GOOD);
    ies::read(text.as_bytes()).unwrap_err().to_string()
}

#[test]
fn ies_errors_name_the_line() {
    assert!(ies::read(GOOD.as_bytes()).is_ok());
    for (from, to, expected) in [
        ("7 6 5", "7 6", "line 8: the file ends, expected a candela value"),
        ("7 6 5", "7 6 nan", "line 8: 'nan' was found, expected a candela value"),
        ("7 6 5", "7 6 -5", "line 8: a negative intensity, -5, was found, expected 0 or more"),
        ("7 6 5", "7 6 1e999", "line 8: '1e999' was found, expected a candela value"),
        ("0 45 90", "0 95 90", "line 5: vertical angle 90 follows 95, expected increasing angles"),
        ("0 45 90", "0 45 45", "line 5: vertical angle 45 comes again with other intensities"),
        ("0 45 90", "0 45 190", "line 5: vertical angle 190 was found, expected 0 to 180 degrees"),
        ("\n0 90\n", "\n0 70\n", "line 6: horizontal angles run from 0 to 70, expected 0 alone, 0 to 90, 0 to 180, 90 to 270 or 0 to 360"),
        ("3 2 1 2", "3 2 4 2", "line 3: the photometric type is 4, expected 1 (C), 2 (B) or 3 (A)"),
        ("3 2 1 2", "3 2 1 5", "line 3: the units type is 5, expected 1 (feet) or 2 (metres)"),
        ("3 2 1 2", "0 2 1 2", "line 3: the number of vertical angles is 0, expected a whole number from 1"),
        ("3 2 1 2", "2.5 2 1 2", "line 3: the number of vertical angles is 2.5, expected a whole number from 1"),
        ("TILT=NONE", "TILT NONE", "line 8: the file ends, expected a line that starts with TILT="),
    ] {
        assert_eq!(problem(from, to), expected);
    }
    assert!(problem("3 2 1 2", "10000000000 2 1 2").starts_with("line 3: the number of vertical angles is 10000000000, expected"));
    assert!(problem("3 2 1 2", "12 12 1 2").starts_with("line 4: 12 vertical and 12 horizontal angles, but the rest"));
}

#[test]
fn eulumdat_errors_name_the_line() {
    let stored: Vec<f64> = (0..12).map(|index| f64::from(index) * 30.0).collect();
    let good = Text::default().write(&stored, |_, _| 79.577);
    let problem = |line: usize, to: &str| {
        let mut lines: Vec<&str> = good.lines().collect();
        lines[line - 1] = to;
        ldt::read(lines.join("\n").as_bytes()).unwrap_err().to_string()
    };
    assert_eq!(problem(2, "x"), "line 2: 'x' was found, expected the type indicator");
    assert_eq!(problem(3, "7"), "line 3: the symmetry indicator is 7, expected a whole number from 0 to 4");
    assert!(problem(4, "10000000000").starts_with("line 4: the number of C planes is 10000000000, expected a whole number from 1 to"));
    assert!(problem(6, "1").starts_with("line 6: the number of angles in a plane is 1"));
    assert!(problem(26, "99999").starts_with("line 26: the number of lamp sets is 99999"));
    assert_eq!(problem(60, "inf"), "line 60: 'inf' was found, expected γ angle 6 of 13");
    assert_eq!(problem(70, "1.234,5"), "line 70: '1.234,5' was found, expected an intensity");
    assert_eq!(problem(70, "-80"), "line 70: a negative intensity, -80, was found, expected 0 or more");
    let cut: String = good.lines().take(80).collect::<Vec<_>>().join("\n");
    assert!(ldt::read(cut.as_bytes()).unwrap_err().to_string().contains("but the rest of the file has room for"));
    let cut: String = good.lines().take(20).collect::<Vec<_>>().join("\n");
    assert_eq!(ldt::read(cut.as_bytes()).unwrap_err().to_string(), "line 20: the file ends, expected the luminous area's height at C270");
}

#[test]
fn other_things_are_no_goniograms() {
    for bytes in
        [&b""[..], b"\0\0\0\0", b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR", b"\xff\xfeT\0I\0L\0T\0=\0", &[0xd7; 4000], b"TILT=", b"TILT=INCLUDE"]
    {
        for name in ["a.ies", "a.ldt", "a", ""] {
            let message = read(bytes, name).unwrap_err().to_string();
            assert!(!message.contains('\n') && message.len() < 200, "{message}");
        }
    }
}
