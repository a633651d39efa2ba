use crate::cct_of_colour;
use crate::{Figures, OPSINS, Spectrum, figures, named};

fn of(name: &str) -> Figures {
    figures(&named(name).expect("a name").expect("a spectrum"))
}

#[track_caller]
fn near(what: &str, found: f64, expected: f64, tolerance: f64) {
    assert!((found - expected).abs() <= tolerance, "{what}: {found}, expected {expected} ± {tolerance}");
}

/// By colour-science 0.4.7 (x, y, CCT, Duv, Ra, Rf, Rg) and luxpy 1.12.5 (melanopic DER) of the same tables.
const ILLUMINANTS: [(&str, [f64; 8]); 11] = [
    ("A", [0.44756, 0.40743, 2855.7, 0.0000, 100.0, 100.0, 100.0, 0.4958]),
    ("D65", [0.31273, 0.32902, 6502.0, 0.0032, 100.0, 100.0, 100.0, 1.0]),
    ("FL11", [0.38052, 0.37712, 4000.7, 0.00015, 82.86, 80.04, 101.06, 0.5636]),
    ("FL2", [0.37208, 0.37528, 4225.0, 0.0019, 64.23, 70.12, 86.42, f64::NAN]),
    ("FL4", [0.44018, 0.40329, 2939.5, -0.0007, 51.48, 56.70, 83.49, f64::NAN]),
    ("LED-B1", [0.45592, 0.40790, 2734.7, -0.0007, 81.79, 84.08, 96.15, 0.4067]),
    ("LED-B3", [0.37566, 0.37245, 4102.5, -0.0006, 84.84, 85.32, 97.86, 0.6326]),
    ("LED-B5", [0.31190, 0.32385, 6590.7, 0.0010, 80.28, 79.47, 94.15, 0.8552]),
    ("LED-RGB1", [0.45576, 0.42110, 2839.5, 0.0043, 57.39, 71.00, 107.01, 0.5777]),
    ("HP1", [0.53278, 0.41517, 1962.0, 0.0008, 8.50, 34.19, 53.97, f64::NAN]),
    ("E", [0.33331, 0.33329, 5455.5, -0.0044, 95.29, 94.71, 103.66, 0.9058]),
];

#[test]
fn eleven_illuminants_have_their_figures() {
    for (name, [x, y, cct, duv, ra, rf, rg, der]) in ILLUMINANTS {
        let found = of(name);
        let white = found.white.as_ref().expect("a white light");
        let tm30 = white.rendition.as_ref().expect("TM-30");
        near(&format!("{name} x"), found.xy[0], x, 3e-4);
        near(&format!("{name} y"), found.xy[1], y, 3e-4);
        near(&format!("{name} CCT"), white.cct, cct, 2e-3 * cct);
        near(&format!("{name} Duv"), white.duv, duv, 2e-4);
        near(&format!("{name} Ra"), white.rendering.as_ref().expect("indices").ra, ra, 0.5);
        near(&format!("{name} Rf"), tm30.rf, rf, 0.2);
        near(&format!("{name} Rg"), tm30.rg, rg, 0.2);
        if der.is_finite() {
            near(&format!("{name} DER"), found.melanopic_der().expect("a ratio"), der, 2e-3);
        }
    }
}

/// FL2's indices by colour-science 0.4.7: R1 to R15 by its CIE 2024, Rcs,h, Rhs,h and Rf,h by its TM-30-18.
#[test]
fn hues_have_their_shifts() {
    let r = [56.05, 76.72, 90.32, 57.09, 59.03, 67.25, 74.15, 33.25, -83.59, 45.42, 46.03, 53.72, 60.35, 94.06, 46.88];
    let chroma = [-24.93, -17.66, -8.89, 5.41, 11.1, 4.45, -7.73, -14.64, -17.24, -15.43, -3.64, 5.05, 11.0, 6.68, -6.45, -16.37];
    let hue = [-0.022, 0.14, 0.244, 0.196, 0.091, -0.067, -0.122, -0.085, 0.006, 0.166, 0.19, 0.114, -0.081, -0.147, -0.263, -0.17];
    let fidelity = [60.2, 61.28, 52.54, 68.33, 79.55, 87.53, 76.77, 72.73, 76.16, 62.29, 69.61, 76.54, 81.34, 71.37, 63.59, 65.26];
    let white = of("FL2").white.expect("a white light");
    white.rendering.as_ref().expect("indices").r.iter().zip(r).for_each(|(found, expected)| near("R", *found, expected, 0.5));
    let tm30 = white.rendition.expect("TM-30");
    [78.89, 58.98, 66.87, 65.67, 35.78].iter().zip(&tm30.samples).for_each(|(expected, found)| near("CES", *found, *expected, 0.05));
    for (k, bin) in tm30.bins.iter().enumerate() {
        near("Rcs", bin.chroma_shift, chroma[k], 0.05);
        near("Rhs", bin.hue_shift, hue[k], 1e-3);
        near("Rf", bin.fidelity, fidelity[k], 0.05);
    }
}

/// CIE 015:2018, tables 10 to 12: chromaticities to four digits.
#[test]
fn lamps_have_the_chromaticities_of_the_cie() {
    for (name, x, y) in
        [("FL2", 0.3721, 0.3751), ("FL7", 0.3129, 0.3292), ("FL11", 0.3805, 0.3769), ("HP1", 0.5330, 0.4150), ("LED-B1", 0.4560, 0.4078)]
    {
        let [found_x, found_y] = of(name).xy;
        near(&format!("{name} x"), found_x, x, 6e-5);
        near(&format!("{name} y"), found_y, y, 6e-5);
    }
}

/// A blackbody is its own nearest, at no distance; so is daylight its own reference.
#[test]
fn blackbodies_and_daylight_are_their_own_references() {
    for kelvin in [1000.0, 2700.0, 4999.0, 25_000.0] {
        let found = of(&format!("{kelvin}K"));
        let white = found.white.expect("a white light");
        near("CCT", white.cct, kelvin, 1e-4 * kelvin);
        near("Duv", white.duv, 0.0, 1e-6);
        if (2000.0..4000.0).contains(&kelvin) {
            near("Ra", white.rendering.as_ref().expect("indices").ra, 100.0, 1e-3);
            near("Rf", white.rendition.expect("TM-30").rf, 100.0, 1e-3);
        }
    }
    let day = of("D5600K").white.expect("a white light");
    near("daylight's CCT", day.cct, 5600.0, 5.0);
    near("daylight's Ra", day.rendering.as_ref().expect("indices").ra, 100.0, 0.05);
}

/// CIE S 026:2018, table A.2: mW/lm of D65.
#[test]
fn daylight_gives_receptors_their_share() {
    for (found, (expected, (name, _))) in
        of("D65").alpha_opic.expect("receptors").iter().zip([0.8173, 1.4558, 1.6289, 1.4497, 1.3262].iter().zip(OPSINS))
    {
        near(name, found.elr_mw_per_lm, *expected, 1e-4);
        near(name, found.der, 1.0, 1e-6);
    }
}

/// CIE standard illuminant D65's table (ISO/CIE 11664-2) over its value at 560 nm, to its six digits.
#[test]
fn daylight_is_that_of_the_table() {
    let day = named("D65").expect("a name").expect("a spectrum");
    let power = |nm: f64| day.power[(nm - 360.0) as usize];
    for (nm, expected) in [(380.0, 49.9755), (450.0, 117.008), (600.0, 90.0062), (780.0, 63.3828)] {
        near(&format!("{nm} nm"), 100.0 * power(nm) / power(560.0), expected, 1e-3);
    }
}

/// A line at 555 nm has 683 lm/W, and no figures of white light.
#[test]
fn coloured_light_has_no_figures_of_white_light() {
    let wavelengths: Vec<f64> = (0..=8000).map(|k| 380.0 + 0.05 * f64::from(k)).collect();
    let line = |at: f64| -> Vec<f64> { wavelengths.iter().map(|nm| (-((nm - at) / 0.3).powi(2)).exp()).collect() };
    let green = figures(&Spectrum::new("laser", &wavelengths, &line(555.0)).expect("a spectrum"));
    near("LER", green.ler, 683.0, 0.1);
    assert_eq!(green.white, None);
    assert!(green.notes.iter().any(|note| note.contains("no CCT, Ra, Rf and Rg")), "{:?}", green.notes);
    let blue = figures(&Spectrum::new("blue", &wavelengths, &line(460.0)).expect("a spectrum"));
    assert_eq!(blue.white, None);
}

#[test]
fn rendering_outside_its_range_is_told() {
    let even = of("E");
    assert!(even.notes.iter().any(|note| note.contains("outside of CIE 13.3's range")), "{:?}", even.notes);
    assert_eq!(of("FL11").notes, Vec::<String>::new());
}

/// The same lamp at 5 nm, at a tenth of a nanometre and at uneven steps, linear between points, in another unit.
#[test]
fn figures_are_those_of_the_light_not_of_its_points() {
    let lamp = named("LED-B3").expect("a name").expect("a spectrum");
    let at = |nm: f64| {
        let k = (((nm - 380.0) / 5.0) as usize).min(lamp.power.len() - 2);
        let t = (nm - lamp.wavelengths_nm[k]) / 5.0;
        1e-7 * (lamp.power[k] + t * (lamp.power[k + 1] - lamp.power[k]))
    };
    let fine: Vec<f64> = (0..=4000).map(|k| 380.0 + 0.1 * f64::from(k)).collect();
    let uneven: Vec<f64> = (0..=400).map(f64::from).filter(|k| k % 5.0 == 0.0 || k % 7.0 == 0.0).map(|k| 380.0 + k).collect();
    let expected = figures(&lamp);
    for wavelengths in [fine, uneven] {
        let power: Vec<f64> = wavelengths.iter().map(|nm| at(*nm)).collect();
        let found = figures(&Spectrum::new("", &wavelengths, &power).expect("a spectrum"));
        let [found_white, white] = [&found, &expected].map(|figures| figures.white.clone().expect("a white light"));
        near("CCT", found_white.cct, white.cct, 4.0);
        near("Ra", found_white.rendering.as_ref().expect("indices").ra, white.rendering.as_ref().expect("indices").ra, 0.1);
        near("Rf", found_white.rendition.expect("TM-30").rf, white.rendition.expect("TM-30").rf, 0.15);
        near("DER", found.melanopic_der().expect("a ratio"), expected.melanopic_der().expect("a ratio"), 2e-3);
        near("LER", found.ler, expected.ler, 0.5);
    }
}

#[test]
fn names_are_written_in_many_ways() {
    for (name, title) in [
        ("cie led_rgb1", "CIE LED-RGB1"),
        ("FL3.15", "CIE FL3.15"),
        ("fl 2", "CIE FL2"),
        ("d50", "CIE D50"),
        ("2700 k", "blackbody of 2700 K"),
        ("D5700", "daylight of 5700 K"),
        ("e", "CIE E"),
    ] {
        assert_eq!(named(name).expect(name).expect(name).name, title);
    }
    for name in ["", "F", "FL13", "led.csv", "D", "DK", "K", "65K.txt", "1e3K", "D65.csv", "-2700K"] {
        assert_eq!(named(name), None, "{name}");
    }
    for (name, problem) in
        [("D30", "daylight of 3002 K, expected 4000 to 25000 K"), ("100K", "a blackbody of 100 K"), ("D999999", "daylight of")]
    {
        let error = named(name).expect(name).expect_err(name).to_string();
        assert!(error.contains(problem), "{error}");
    }
}

#[test]
fn drawings_are_documents() {
    for name in ["FL11", "A", "HP1", "2000K"] {
        let mut lamp = named(name).expect("a name").expect("a spectrum");
        lamp.name = "<lamp> & more".to_owned();
        let svg = crate::spectrum_drawing(&lamp, &figures(&lamp));
        let document = roxmltree::Document::parse(&svg).expect("a document");
        assert!(!svg.contains("NaN"), "{name}");
        assert!(document.descendants().any(|node| node.text() == Some("<lamp> & more")), "{name}");
    }
}

/// Pictures have CCT and Duv by a parabola, which is as good as the search; what is not white has none.
#[test]
fn colours_of_pictures_have_a_temperature() {
    for name in ["A", "D65", "FL11", "LED-B1", "LED-B5", "3000K", "9000K"] {
        let lamp = crate::named(name).expect("a name").expect("a spectrum");
        let xyz = crate::source::sums(&lamp.nodes(), crate::observer::cie_1931);
        let colour = crate::white::turned(&crate::white::XYZ_TO_REC709, xyz);
        let (kelvin, duv) = cct_of_colour(colour).expect("white");
        let white = crate::figures(&lamp).white.expect("white");
        assert!((kelvin / white.cct - 1.0).abs() < 5e-4 && (duv - white.duv).abs() < 2e-5, "{name}: {kelvin} K, {duv}");
    }
    assert!([[0.0, 1.0, 0.0], [1.0, 0.0, 0.0], [0.0; 3], [-1.0, 2.0, 1.0]].into_iter().all(|colour| cct_of_colour(colour).is_none()));
}

#[test]
fn many_spectra_have_the_figures_of_each() {
    for name in ["LED-B3", "FL11", "A", "D65", "LED-RGB1"] {
        let lamp = named(name).expect("a name").expect("a spectrum");
        for step in [5.0, 10.0] {
            let nm: Vec<f64> = (0..(400.0 / step) as usize).map(|band| 380.0 + step * (band as f64 + 0.5)).collect();
            let power: Vec<f64> = nm.iter().map(|nm| lamp.at(*nm)).collect();
            let many = crate::RenderingOfMany::new(&nm);
            let one = figures(&Spectrum::new(name, &nm, &power).expect("a spectrum")).white.expect("a white light");
            near(name, many.ra(&power).expect("Ra"), one.rendering.as_ref().expect("indices").ra, 0.02);
            let tm30 = one.rendition.expect("TM-30");
            let [rf, rg] = many.rf_rg(&power).expect("Rf and Rg");
            near(name, rf, tm30.rf, 0.02);
            near(name, rg, tm30.rg, 0.02);
        }
    }
    let many = crate::RenderingOfMany::new(&[500.0, 510.0, 520.0, 530.0, 540.0]);
    assert!(many.ra(&[0.0; 5]).is_none() && many.rf_rg(&[1.0; 5]).is_none());
}

/// x and y by observer, with colour-science 0.4.7's tables of them.
const OBSERVED: [(&str, [[f64; 2]; 4]); 4] = [
    ("A", [[0.44757, 0.40744], [0.45117, 0.40594], [0.45276, 0.4088], [0.45293, 0.4052]]),
    ("D65", [[0.31273, 0.32902], [0.31382, 0.331], [0.31345, 0.3308], [0.31379, 0.33127]]),
    ("FL11", [[0.38054, 0.37692], [0.38544, 0.37109], [0.38404, 0.37694], [0.38611, 0.36879]]),
    ("LED-B3", [[0.37561, 0.37229], [0.38085, 0.36852], [0.38067, 0.37591], [0.38086, 0.3666]]),
];

#[test]
fn observers_have_their_chromaticities() {
    use crate::CieObserver;
    for (name, expected) in OBSERVED {
        let lamp = named(name).expect("a name").expect("a spectrum");
        for (observer, expected) in CieObserver::ALL.into_iter().zip(expected) {
            let found = observer.chromaticity(&lamp);
            (0..2).for_each(|k| near(&format!("{name} {observer:?}"), found[k], expected[k], 2e-4));
        }
    }
    assert_eq!(CieObserver::by_name("CIE-2015"), Some(CieObserver::Cie2015));
    let white = crate::rec709_of_white([1.0; 3]);
    white.iter().for_each(|part| near("white", *part, 1.0, 1e-12));
}
