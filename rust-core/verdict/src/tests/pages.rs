//! The sheet for readers.

use super::{grid, meter, one, sheet};
use crate::{
    json, lines, page,
    words::{Words, text},
};
use gonio_page::{Language, differences};
use serde_json::json as value;

const KEYS: &str = "area = 'Desk'; quantity = 'mean'; at_least = 512; label = 'Em <b>\"x\"'";

#[test]
fn all_languages_have_the_words_of_english() {
    for (code, language) in Language::CODES {
        let read: Result<Words, _> = toml::from_str(text(language));
        assert!(read.is_ok(), "{code}: {read:?}");
        assert_eq!(differences(text(Language::English), text(language)), Vec::<String>::new(), "{code}");
    }
}

#[test]
fn the_page_holds_everything_itself() {
    let found = one(KEYS, &[grid()]).expect("a sheet");
    let html = page(&found, Language::English, "2026-03-01");
    for part in
        ["512\u{a0}lx", "510.0 ± 4.0\u{a0}lx", "within the error", "2026-03-01", "SHA-256", "no certificate", "out/0.json", "#within_error"]
    {
        assert!(html.contains(part), "{part}");
    }
    // A plan of six cells with their values.
    assert!(html.contains(">640</text>") && html.contains(">400</text>") && html.contains("1.50 × 0.80 m"));
    assert!(!html.contains("<b>\"x") && html.contains("Em &lt;b&gt;&quot;x&quot;"));
    for outside in ["http:", "https:", "src=", "@import", "url("] {
        assert!(!html.contains(outside), "{outside}");
    }
}

#[test]
fn numbers_have_the_languages_form() {
    let found = one(KEYS, &[grid()]).expect("a sheet");
    let html = page(&found, Language::German, "1.3.2026");
    assert!(html.contains("lang=\"de\"") && html.contains("510,0 ± 4,0\u{a0}lx") && html.contains("innerhalb des Fehlers"));
    assert!(html.contains("1,50 × 0,80 m"), "the plan's size");
}

#[test]
fn sums_are_those_of_sha256() {
    // FIPS 180-4's example: the bytes "abc".
    let source = crate::measured::Source::new(std::path::Path::new("abc"), b"abc");
    assert_eq!(source.sha256, "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
}

#[test]
fn the_table_tells_what_would_settle_a_line() {
    let found = one(KEYS, &[grid()]).expect("a sheet");
    let text = lines(&found).join("\n");
    // An error of 4 beside a gap of 2.
    assert!(text.contains("each way reach from 502.0 to 518.0 lx, and the limit lies within. About 16 times as many samples"), "{text}");
    assert!(text.contains("within the error  Desk  mean      ≥ 512 lx  510.0 ± 4.0 lx"), "{text}");
}

#[test]
fn figures_are_told_from_their_limits() {
    let files = [meter("a", "illuminance", "lx", value!(499.96))];
    let mut exact = files[0].clone();
    exact["meters"][0]["standard_error"] = value!(null);
    let text = lines(&one("area = 'a'; quantity = 'mean'; at_least = 500", &[exact]).expect("a sheet")).join("\n");
    assert!(text.contains("499.96") || text.contains("500.0"), "{text}");
    assert!(text.contains("not met") && !text.contains("  500 lx"), "{text}");
}

#[test]
fn json_has_the_documented_keys() {
    let text =
        "[[require]]\narea = 'Desk'\nquantity = 'mean'\nat_least = 512\n[[require]]\narea = 'Disk'\nquantity = 'mean'\nat_most = 1\n";
    let found = json(&sheet(text, &[grid()]).expect("a sheet"));
    assert_eq!(found["verdict"], "not_met");
    assert_eq!(found["counts"], value!({ "met": 0, "within_error": 1, "not_met": 0, "not_measured": 1 }));
    let first = &found["requirements"][0];
    assert_eq!([&first["verdict"], &first["bound"], &first["unit"]], ["within_error", "at_least", "lx"]);
    assert_eq!([&first["reached"]["value"], &first["reached"]["margin"]], [510.0, -2.0]);
    assert_eq!(first["reached"]["interval"], value!([502.0, 518.0]));
    assert_eq!(found["requirements"][1]["reached"], value!(null));
    assert_eq!(found["files"].as_array().map(Vec::len), Some(2));
}
