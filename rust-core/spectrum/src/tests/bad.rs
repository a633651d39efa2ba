use crate::{Spectrum, figures, named, read, spectrum_drawing};

/// What is wrong with a file.
#[track_caller]
fn problem(bytes: &[u8]) -> String {
    read(bytes, "lamp").expect_err("a problem").to_string()
}

/// 380 to 780 nm in steps of 5 nm from line 1 on, with a line in another's place.
fn with(line: usize, other: &str) -> Vec<u8> {
    (1..=81).map(|k| if k == line { format!("{other}\n") } else { format!("{},1.5\n", 375 + 5 * k) }).collect::<String>().into_bytes()
}

#[test]
fn bad_files_have_one_message_with_the_line() {
    for (bytes, message) in [
        (with(7, "410,nan"), "line 7: power NaN at 410 nm, expected a number"),
        (with(7, "410,inf"), "line 7: power inf at 410 nm, expected a number"),
        (with(7, "nan,1"), "line 7: wavelength NaN, expected a positive number of nm"),
        (with(7, "-410,1"), "line 7: wavelength -410, expected a positive number of nm"),
        (with(7, "410,-1"), "line 7: power -1 at 410 nm, expected none below zero"),
        (with(7, "405,1"), "line 7: 405 nm stands twice, expected increasing wavelengths"),
        (with(7, "400,1"), "line 7: 400 nm after 405 nm, expected increasing wavelengths"),
        (with(7, "410,much"), "line 7: 'much' is no number, expected the power beside the wavelength"),
        (with(1, "380,"), "line 1: '380,' is no number, expected the power beside the wavelength"),
        (with(7, "sodium"), "line 7: 'sodium' amid the numbers, expected wavelength in nm and power"),
        (with(7, "410,0,1,5"), "line 7: '410,0,1,5': commas may stand between numbers or within them"),
        (b"380,1\n500,1\n".to_vec(), "line 1: 2 points of wavelength and power, a spectrum has at least 5"),
        (b"".to_vec(), "no line of wavelength in nm and power"),
        (b"lamp\n".to_vec(), "no line of wavelength in nm and power"),
        (b"\x89PNG\r\n\x1a\n\0\0\0".to_vec(), "byte"),
        (b"<html></html>".to_vec(), "line 1: <'html'> was found, expected a root whose name begins with IESTM27"),
        (b"<IESTM2714></IESTM2714>".to_vec(), "line 1: no SpectralDistribution"),
        (b"<IESTM2714><a>".to_vec(), "line 1: not XML"),
    ] {
        let found = problem(&bytes);
        assert!(found.starts_with(message), "{found}, expected {message}");
    }
}

#[test]
fn units_gaps_and_darkness_are_told() {
    let micrometres: String = (0..=80).map(|k| format!("{} 1\n", 0.38 + 0.005 * f64::from(k))).collect();
    assert!(problem(micrometres.as_bytes()).contains("look like micrometres"));
    let angstrom: String = (0..=80).map(|k| format!("{} 1\n", 3800 + 50 * k)).collect();
    assert!(problem(angstrom.as_bytes()).contains("look like ångström"));
    let gap: String = (0..=80).filter(|k| !(20..24).contains(k)).map(|k| format!("{} 1\n", 380 + 5 * k)).collect();
    assert_eq!(problem(gap.as_bytes()), "line 21: nothing between 475 and 500 nm, expected steps of at most 20 nm");
    let infrared: String = (0..=80).map(|k| format!("{} 1\n", 900 + 5 * k)).collect();
    assert_eq!(problem(infrared.as_bytes()), "no visible light from 900 to 1300 nm");
    let dark: String = (0..=80).map(|k| format!("{} 0\n", 380 + 5 * k)).collect();
    assert_eq!(problem(dark.as_bytes()), "no power above zero");
    assert!(Spectrum::new("", &[1.0], &[]).expect_err("two lengths").to_string().contains("1 wavelengths and 0 powers"));
}

#[test]
fn bombs_are_refused() {
    let bomb = "<!DOCTYPE a [<!ENTITY b \"bbbbbbbb\"><!ENTITY c \"&b;&b;&b;&b;&b;&b;&b;&b;\">]>\n<IESTM2714>&c;</IESTM2714>";
    assert!(problem(bomb.as_bytes()).contains("not XML"), "{}", problem(bomb.as_bytes()));
    let deep = format!("<IESTM2714>{}", "<a>".repeat(1 << 16));
    assert!(problem(deep.as_bytes()).contains("not XML"));
    let huge = vec![b' '; (64 << 20) + 1];
    assert!(problem(&huge).contains("more than 67108864 bytes"));
}

#[test]
fn extreme_powers_have_figures() {
    let lamp = named("LED-B3").expect("a name").expect("a spectrum");
    let expected = figures(&lamp);
    for scale in [1e-300, 1e300] {
        let power: Vec<f64> = lamp.power.iter().map(|power| power * scale).collect();
        let found = figures(&Spectrum::new("CIE LED-B3", &lamp.wavelengths_nm, &power).expect("a spectrum"));
        assert!((found.xy[0] - expected.xy[0]).abs() < 1e-9, "{scale}");
    }
}

/// Mutated files give a spectrum whose figures are finite, or one message; nothing panics.
#[test]
fn mutated_files_do_no_harm() {
    let text = String::from_utf8(with(0, "")).expect("text");
    let data: String = (0..=80).map(|k| format!("<SpectralData wavelength=\"{}\">1.5</SpectralData>", 380 + 5 * k)).collect();
    let spdx =
        format!("<IESTM2714><SpectralDistribution><SpectralQuantity>flux</SpectralQuantity>{data}</SpectralDistribution></IESTM2714>");
    let mut state = 0x9e37_79b9_7f4a_7c15_u64;
    let mut draw = |below: usize| {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state % below as u64) as usize
    };
    let pieces: [&[u8]; 14] = [
        b"nan",
        b"-",
        b"1e999",
        b"1e-320",
        b",",
        b";",
        b"\t",
        b"\n",
        b"\0",
        b"<",
        b"\xff\xfe",
        b"9",
        b".",
        b"<!DOCTYPE a [<!ENTITY b \"c\">]>",
    ];
    for round in 0..1500 {
        let mut bytes = if round % 2 == 0 { text.clone() } else { spdx.clone() }.into_bytes();
        for _ in 0..=draw(4) {
            if bytes.is_empty() {
                break;
            }
            let at = draw(bytes.len());
            match draw(4) {
                0 => bytes[at] = draw(256) as u8,
                1 => drop(bytes.splice(at..at, pieces[draw(pieces.len())].iter().copied())),
                2 => drop(bytes.drain(at..(at + 1 + draw(40)).min(bytes.len()))),
                _ => bytes.truncate(at.max(1)),
            }
        }
        if let Ok(lamp) = read(&bytes, "lamp") {
            let found = figures(&lamp);
            let receptors = found.alpha_opic.expect("receptors").map(|opsin| opsin.der);
            assert!(found.xy.iter().chain(&receptors).chain([&found.ler]).all(|figure| figure.is_finite()), "{found:?}");
            assert!(!spectrum_drawing(&lamp, &found).contains("NaN"));
        }
    }
}
