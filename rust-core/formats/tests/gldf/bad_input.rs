//! Broken archives and products: one clear message each.

use crate::zip::{Packed, archive, packed};
use crate::{GENERAL, VARIANTS, downlight, gldf, product};
use gonio_formats::gldf::Gldf;
use gonio_formats::photometry::read;

fn problem(bytes: &[u8], variant: &str) -> String {
    read(bytes, &format!("lamp.gldf#{variant}")).unwrap_err().to_string()
}

/// The product with its one photometry, changed in one place.
fn changed(from: &str, to: &str) -> Vec<u8> {
    let text = product(GENERAL, VARIANTS);
    assert!(text.contains(from), "{from}");
    archive(&[("product.xml", text.replacen(from, to, 1).as_bytes()), ("ldc/down.ies", &downlight(1000.0))])
}

#[test]
fn what_is_no_product_is_refused() {
    let xml = |text: &str| archive(&[("product.xml", text.as_bytes())]);
    let entities = "<!DOCTYPE a [<!ENTITY a \"aaaa\"><!ENTITY b \"&a;&a;&a;&a;\">]>\n<Root><Header>&b;</Header></Root>";
    for (bytes, expected) in [
        (b"PK\x03\x04".to_vec(), "no ZIP archive that can be read"),
        (archive(&[]), "no product.xml is in the archive, expected one in a GLDF file; it holds nothing"),
        (archive(&[("structure.xml", b"")]), "no product.xml is in the archive, expected one in a GLDF file; it holds 'structure.xml'"),
        (xml("<Rot/>"), "product.xml: line 1: <Rot> was found, expected GLDF's <Root>"),
        (xml("<Root>\n</Rot>"), "product.xml: line 2: not XML"),
        (xml("<Root/>"), "product.xml: line 1: no <Header> was found"),
        (xml(""), "product.xml: line 1: not XML"),
        (xml(entities), "product.xml: line 1: not XML"),
        (xml("<Root><Header/></Root>"), "the product has no variant"),
    ] {
        let found = problem(&bytes, "");
        assert!(found.starts_with(expected), "{found}");
    }
}

#[test]
fn sizes_that_lie_are_refused() {
    let zeros = vec![0; 1 << 20];
    let photometry = |bytes: &[u8], size: u32| {
        let text = product(GENERAL, VARIANTS);
        packed(&[Packed("product.xml", text.as_bytes(), text.len() as u32), Packed("ldc/down.ies", bytes, size)])
    };
    for (bytes, expected) in [
        (photometry(&zeros, 1000), "ldc/down.ies: cannot be unpacked to the 1000 bytes that are stated"),
        (photometry(&zeros, 2 << 20), "ldc/down.ies: "),
        (photometry(b"a", 60 << 20), "ldc/down.ies: 3 bytes cannot unpack to 62914560"),
        (photometry(b"a", 1 << 30), "ldc/down.ies: 1073741824 bytes are stated, at most 67108864 are read"),
    ] {
        let found = problem(&bytes, "plain");
        assert!(found.starts_with(expected), "{found}");
    }
    // A byte that changed on the way.
    let mut broken = gldf();
    let at = broken.windows(12).position(|name| name == b"ldc/down.ies").unwrap();
    broken[at + 60] ^= 0x10;
    assert!(problem(&broken, "plain").starts_with("ldc/down.ies: "));
}

#[test]
fn wrong_references_are_told_where_they_stand() {
    for (from, to, expected) in [
        ("emitterId=\"ed\"", "emitterId=\"no\"", "product.xml: line 54: no emitter 'no' is defined"),
        (
            "PhotometryReference photometryId=\"pd\"",
            "PhotometryReference photometryId=\"no\"",
            "product.xml: line 30: no photometry 'no' is defined",
        ),
        (
            "PhotometryFileReference fileId=\"down\"",
            "PhotometryFileReference fileId=\"no\"",
            "product.xml: line 14: no file 'no' is defined",
        ),
        ("<PhotometryReference photometryId=\"pd\"/>", "", "product.xml: line 30: <FixedLightEmitter> names no photometry"),
        (">down.ies<", ">gone.ies<", "ldc/gone.ies: is not in the archive"),
        (
            "type=\"localFileName\">down.ies",
            "type=\"url\">https://example.org/down.ies",
            "https://example.org/down.ies: is not in the archive but at that address, which is not fetched",
        ),
    ] {
        let found = problem(&changed(from, to), "plain");
        assert!(found.contains(expected), "{found}");
    }
    assert!(problem(&gldf(), "dark").contains("the variant 'dark' names no emitter with a light"));
    assert!(problem(&gldf(), "wrong").contains("no emitter 'nothing' is defined"));
    let bytes = changed(">down.ies<", ">gone.ies<");
    let told = Gldf::read(&bytes).unwrap().warnings;
    assert!(told.iter().any(|warning| warning.to_string().starts_with("product.xml: line 7: 'ldc/gone.ies' is not in")), "{told:?}");
}

#[test]
fn broken_photometry_is_told_with_its_name() {
    let text = product(GENERAL, VARIANTS);
    let with = |photometry: &[u8]| archive(&[("product.xml", text.as_bytes()), ("ldc/down.ies", photometry)]);
    assert!(problem(&with(b"TILT=NONE\nnothing"), "plain").starts_with("ldc/down.ies: line 2: "));
    // An archive within an archive is no photometry.
    assert!(problem(&with(&gldf()), "plain").starts_with("ldc/down.ies: "));
}

#[test]
fn cut_archives_never_panic() {
    let bytes = gldf();
    for end in (0..bytes.len()).step_by(7) {
        drop(read(&bytes[..end], "lamp.gldf"));
    }
}
