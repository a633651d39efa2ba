use super::*;
use gonio_simd::{Execution, Lanes, dispatch};

fn assert_near(found: &Matrix3, expected: &Matrix3, tolerance: f64) {
    for (a, b) in found.iter().flatten().zip(expected.iter().flatten()) {
        assert!((a - b).abs() < tolerance, "{found:?} is not {expected:?}");
    }
}

#[test]
fn matrices_are_the_published_ones() {
    // As in the ACES configurations of OpenColorIO (Bradford adaptation), five digits.
    let ap1 = [[1.70505, -0.62179, -0.08326], [-0.13026, 1.14080, -0.01055], [-0.02400, -0.12897, 1.15297]];
    assert_near(&Gamut::Ap1.to_rec709().unwrap(), &ap1, 1e-5);
    let ap0 = [[2.52169, -1.13413, -0.38756], [-0.27648, 1.37272, -0.09624], [-0.01538, -0.15298, 1.16835]];
    assert_near(&Gamut::Ap0.to_rec709().unwrap(), &ap0, 1e-5);
    // ITU-R BT.2087, annex 2.
    let rec2020 = [[1.6605, -0.5876, -0.0728], [-0.1246, 1.1329, -0.0083], [-0.0182, -0.1006, 1.1187]];
    assert_near(&Gamut::Rec2020.to_rec709().unwrap(), &rec2020, 6e-5);
    // CSS Color 4.
    let p3 = [[1.22494, -0.22494, 0.0], [-0.04206, 1.04206, 0.0], [-0.01964, -0.07864, 1.09827]];
    assert_near(&Gamut::DisplayP3.to_rec709().unwrap(), &p3, 1e-4);
    // IEC 61966-2-1, rounded to four digits there.
    let rec709 = [[0.4124, 0.3576, 0.1805], [0.2126, 0.7152, 0.0722], [0.0193, 0.1192, 0.9505]];
    assert_near(&Gamut::Rec709.primaries().to_xyz().unwrap(), &rec709, 1e-4);
}

#[test]
fn white_stays_white() {
    for gamut in [Gamut::Rec2020, Gamut::DisplayP3, Gamut::AdobeRgb, Gamut::Ap1, Gamut::Ap0, Gamut::XyzE] {
        for value in apply(&gamut.to_rec709().unwrap(), [1.0; 3]) {
            assert!((value - 1.0).abs() < 1e-12, "{gamut:?}: {value}");
        }
    }
    assert!(Gamut::Rec709.to_rec709().is_none());
}

#[test]
fn degenerate_primaries_give_nothing() {
    let line = Primaries { red: [0.1, 0.1], green: [0.2, 0.2], blue: [0.3, 0.3], white: [0.3, 0.3] };
    assert!(line.to_rec709().is_none());
    let nan = Primaries { red: [f64::NAN, 0.1], ..Gamut::Rec709.primaries() };
    assert!(nan.to_rec709().is_none());
    let no_white = Primaries { white: [0.3, 0.0], ..Gamut::Rec709.primaries() };
    assert!(no_white.to_rec709().is_none());
}

const TRANSFERS: [Transfer; 6] =
    [Transfer::Linear, Transfer::Srgb, Transfer::Gamma18, Transfer::Gamma22, Transfer::Gamma24, Transfer::AdobeRgb];

#[test]
fn all_codes_return() {
    for transfer in TRANSFERS {
        for code in 0..=255_u8 {
            let stored = f64::from(code) / 255.0;
            assert!((transfer.encode(transfer.decode(stored)) - stored).abs() < 1e-7, "{transfer:?} {code}");
            let through_f32 = transfer.encode(f64::from(transfer.table()[usize::from(code)])) * 255.0;
            assert_eq!(through_f32.round() as u8, code, "{transfer:?}");
            assert_eq!(transfer.decode(-stored), -transfer.decode(stored));
        }
    }
    assert!((Transfer::Srgb.decode(0.5) - 0.214_041_140_482).abs() < 1e-11);
}

#[test]
fn lanes_agree_with_the_exact_srgb() {
    #[inline(always)]
    fn both<L: Lanes>(l: L, x: f32) -> [f32; 2] {
        [srgb_to_linear(l.f(x)).to_array()[0], linear_to_srgb(l.f(x)).to_array()[0]]
    }
    for execution in Execution::all() {
        for step in -200..=1200 {
            let x = step as f32 / 1000.0;
            let [decoded, encoded] = dispatch!(execution, l => both(l, x));
            for (found, exact) in [(decoded, Transfer::Srgb.decode(f64::from(x))), (encoded, Transfer::Srgb.encode(f64::from(x)))] {
                assert!(
                    (f64::from(found) - exact).abs() <= 2e-6 * exact.abs().max(1e-3),
                    "{}: {x} gives {found}, not {exact}",
                    execution.name()
                );
            }
        }
    }
}

#[test]
fn names_are_known() {
    let known = [
        ("auto", ColourSpace::Auto),
        ("", ColourSpace::Auto),
        ("raw", ColourSpace::Raw),
        ("Non-Color", ColourSpace::Raw),
        ("sRGB", ColourSpace::SRGB_TEXTURE),
        ("srgb_texture", ColourSpace::SRGB_TEXTURE),
        ("sRGB - Texture", ColourSpace::SRGB_TEXTURE),
        ("sRGB Encoded Rec.709 (sRGB)", ColourSpace::SRGB_TEXTURE),
        ("lin_rec709", ColourSpace::LINEAR_REC709),
        ("lin_srgb", ColourSpace::LINEAR_REC709),
        ("Linear Rec.709 (sRGB)", ColourSpace::LINEAR_REC709),
        ("Utility - Linear - sRGB", ColourSpace::LINEAR_REC709),
        ("acescg", ColourSpace::ACES_CG),
        ("ACEScg", ColourSpace::ACES_CG),
        ("ACES - ACEScg", ColourSpace::ACES_CG),
        ("lin_ap1", ColourSpace::ACES_CG),
        ("lin_ap1_scene", ColourSpace::ACES_CG),
        ("ACES2065-1", ColourSpace::ACES_2065),
        ("lin_displayp3", ColourSpace::LINEAR_P3),
        ("srgb_displayp3", ColourSpace::DISPLAY_P3),
        ("Linear DCI-P3 D65", ColourSpace::LINEAR_P3),
        ("lin_rec2020_scene", ColourSpace::LINEAR_REC2020),
        ("g22_rec709", ColourSpace::G22),
    ];
    for (name, space) in known {
        assert_eq!(name.parse(), Ok(space), "{name}");
    }
    let error = ColourSpace::parse("Filmic Log").unwrap_err();
    assert!(error.to_string().contains("'Filmic Log'"), "{error}");
}
