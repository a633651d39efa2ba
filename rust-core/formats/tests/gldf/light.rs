//! Variants and their light, by closed forms: Lambertian luminaires of known flux.

use crate::zip::archive;
use crate::{GENERAL, VARIANTS, close, downlight, gldf, product};
use gonio_formats::gldf::{Emergency, FilePlace, Gldf, RatedFlux, split_variant};
use gonio_formats::photometry::{Goniogram, ies, ldt, read, read_variant};

fn light(name: &str) -> Goniogram {
    read(&gldf(), &format!("lamp.gldf#{name}")).unwrap()
}

fn warnings(found: &Goniogram) -> Vec<String> {
    found.warnings.iter().map(ToString::to_string).collect()
}

#[test]
fn a_product_says_who_made_what() {
    let bytes = gldf();
    let product = Gldf::read(&bytes).unwrap();
    assert_eq!((product.manufacturer.as_str(), product.id.as_str(), product.version.as_str()), ("ACME", "id-1", "1.0-rc.3"));
    assert_eq!((product.name.shown(), product.number.shown()), ("Lamp", "P-1"));
    assert_eq!(product.variants.len(), 6);
    assert_eq!(product.warnings, []);
    let plain = &product.variants[0];
    assert_eq!(plain.mountings, ["ceiling, pendant 0.5 m", "ceiling, surface mounted", "wall at 1.8 m, surface mounted"]);
    assert_eq!(product.variants[1].simple.unwrap().body, [1.2, 0.3, 0.08]);
    let light = &product.emitters[0].lights[0];
    assert_eq!((light.rated, light.watts), (Some(RatedFlux::Luminaire(1000.0)), Some(10.0)));
    assert_eq!((light.temperature, light.rendering, light.spectrum), (Some(3000.0), Some(90.0), Some(0)));
    assert_eq!((light.emergency, light.emergency_factor), (Emergency::Combined, Some(0.1)));
    let values: Vec<(f64, f64)> = product.spectra[1].values.iter().map(|point| (point.nm, point.power)).collect();
    assert_eq!(values, [(450.0, 0.5), (650.0, 1.0)]);
    assert_eq!(product.files[3].place, FilePlace::Address("https://example.org/lamp.png".into()));
    assert_eq!(product.files[4].size, Some(126));
}

#[test]
fn a_variant_is_its_photometry_under_the_product_s_names() {
    let plain = light("plain");
    close(plain.flux(), 1000.0, 1e-12);
    // The photometry itself has them by the trapezia of a cosine in steps of one degree.
    close(plain.peak(), 1000.0 / std::f64::consts::PI, 1e-4);
    let lamps = plain.lamps().unwrap();
    assert_eq!((lamps.watts, lamps.colour.as_str(), lamps.colour_rendering.as_str()), (10.0, "3000 K", "90"));
    assert_eq!(["MANUFAC", "LUMINAIRE", "LUMCAT"].map(|word| plain.text(word).unwrap()), ["ACME", "Lamp, plain", "N-1"]);
    assert_eq!(warnings(&plain), [""; 0]);
    for again in [ies::read(&ies::write(&plain)).unwrap(), ldt::read(&ldt::write(&plain)).unwrap()] {
        close(again.flux(), 1000.0, 1e-6);
    }
}

#[test]
fn a_variant_has_the_spectrum_that_all_its_lights_have() {
    let plain = light("plain").spectrum.unwrap();
    assert_eq!((plain.name.as_str(), plain.wavelengths_nm.len(), plain.power[11]), ("s1", 21, 1.0));
    assert_eq!(light("both").spectrum, Some(plain));
    assert_eq!(light("tubes").spectrum, None);
    let changed = |from: &str, to: &str| {
        let text = product(GENERAL, VARIANTS);
        assert!(text.contains(from), "{from}");
        let bytes = archive(&[("product.xml", text.replacen(from, to, 1).as_bytes()), ("ldc/down.ies", &downlight(1000.0))]);
        let found = read(&bytes, "lamp.gldf#plain").unwrap();
        (found.spectrum.is_some(), warnings(&found).join("; "))
    };
    let inside = |points: &str| changed("<SpectrumFileReference fileId=\"power\"/>", points);
    let row = |nm: u32, power: f64| format!("<Intensity wavelength=\"{nm}\">{power}</Intensity>\n");
    let listed: String = (0..41).map(|k| row(380 + 10 * k, 1.0)).collect();
    assert_eq!(inside(&listed), (true, String::new()));
    for (points, told) in [
        (listed.replace("\"500\"", "\"480\""), "its spectrum is left out: product.xml: line 29: 480 nm after 490 nm"),
        (listed.replace("\"500\">1<", "\"500\">-1<"), "its spectrum is left out: product.xml: line 29: power -1 at 500 nm"),
        (
            (0..9).map(|k| row(380 + 50 * k, 1.0)).collect(),
            "its spectrum is left out: product.xml: line 18: nothing between 380 and 430 nm",
        ),
    ] {
        let (has, found) = inside(&points);
        assert!(!has && found.starts_with(told), "{found}");
    }
    let (has, found) = changed("spectrumId=\"s1\"", "spectrumId=\"s2\"");
    assert!(!has && found.contains("product.xml: line 18: 2 points of wavelength and power"), "{found}");
    // Without the file in the archive.
    assert!(changed("<Name>", "<Name>").1.contains("spectrum/power.txt"));
}

#[test]
fn the_rated_flux_counts_and_is_told_where_it_differs() {
    let strong = light("strong");
    close(strong.flux(), 1500.0, 1e-12);
    let told = warnings(&strong);
    assert_eq!(told.len(), 1, "{told:?}");
    assert!(told[0].starts_with("ldc/down.ies: the light's flux is 1000.0 lm here, the product rates it 1500 lm"), "{told:?}");
}

#[test]
fn lamps_leave_absolute_photometry_alone() {
    let tubes = light("tubes");
    close(tubes.flux(), 1000.0, 1e-3);
    assert_eq!(tubes.lamps().unwrap().watts, 31.0);
    assert!(warnings(&tubes)[0].contains("is absolute: its 999.9"), "{:?}", warnings(&tubes));
}

#[test]
fn emitters_add_up() {
    // Twice 1000 lm down, once 600 lm up.
    let both = light("both");
    close(both.flux(), 2600.0, 1e-6);
    close(both.intensity([0.0, 0.0, -1.0]), light("plain").peak() * 2.0, 1e-9);
    close(both.intensity([0.0, 0.0, 1.0]) / both.intensity([0.0, 0.0, -1.0]), 0.3, 1e-6);
    close(both.figures().downward_fraction, 2000.0 / 2600.0, 1e-5);
    assert_eq!(both.lamps().unwrap().watts, 30.0);
    let told = warnings(&both).join("\n");
    assert!(told.contains("the sum of 2 photometries"), "{told}");
    assert!(told.contains("no light emitting object 'absent'"), "{told}");
    assert!(told.contains("the model turns light emitting object 'leo-1': its nadir points along (0, -1, 0)"), "{told}");
    assert!(!told.contains("'leo-0'"), "{told}");
}

#[test]
fn products_may_be_written_in_utf_16() {
    let text = crate::product(crate::GENERAL, crate::VARIANTS);
    let words: Vec<u16> = std::iter::once(0xfeff).chain(text.encode_utf16()).collect();
    let little: Vec<u8> = words.iter().flat_map(|word| word.to_le_bytes()).collect();
    let big: Vec<u8> = words.iter().flat_map(|word| word.to_be_bytes()).collect();
    for product in [&little, &big] {
        let bytes = crate::zip::archive(&[("product.xml", product), ("ldc/down.ies", &crate::downlight(1000.0))]);
        close(read(&bytes, "lamp.gldf#plain").unwrap().flux(), 1000.0, 1e-12);
    }
    let half = crate::zip::archive(&[("product.xml", &little[..little.len() - 1])]);
    assert!(read(&half, "lamp.gldf").unwrap_err().to_string().starts_with("product.xml: line 1: text of UTF-16"));
}

#[test]
fn emergencies_have_their_own_flux() {
    let bytes = gldf();
    let product = Gldf::read(&bytes).unwrap();
    let flux = |index: usize| product.emergency_flux(&product.variants[index]).unwrap();
    assert_eq!(flux(0), Some(100.0));
    assert_eq!(flux(1), Some(50.0));
    assert_eq!(flux(2), Some(200.0));
    assert_eq!(flux(3), None);
}

#[test]
fn variants_are_chosen_by_many_names() {
    let bytes = gldf();
    let product = Gldf::read(&bytes).unwrap();
    for name in ["plain", "PLAIN", "schlicht", "N-1", "12345678", "v1", "1"] {
        assert_eq!(product.variant(Some(name)), Ok(0), "{name}");
    }
    assert_eq!(product.variant(None), Ok(0));
    assert_eq!(product.variant(Some("3")), Ok(2));
    let problem = product.variant(Some("7")).unwrap_err().to_string();
    assert!(problem.contains("no variant '7' was found among 6: 'plain', 'strong'"), "{problem}");
    let first = read(&bytes, "lamp.gldf").unwrap();
    assert_eq!(warnings(&first), ["the first of 6 variants is taken, 'plain'"]);
}

#[test]
fn a_name_may_have_its_variant_behind_it() {
    assert_eq!(split_variant("a/lamp.gldf#wide#1"), ("a/lamp.gldf", Some("wide#1")));
    assert_eq!(split_variant("a/LAMP.GLDF#"), ("a/LAMP.GLDF", None));
    assert_eq!(split_variant("a/lamp#1.ies"), ("a/lamp#1.ies", None));
    let problem = read_variant(&crate::downlight(1.0), "a.ies", Some("wide"), &mut |_| Err(String::new())).unwrap_err();
    assert!(problem.problem.contains("no GLDF or GDTF archive"), "{problem}");
}
