//! Pages of made-up pictures: what stands in them, and what cannot be made one of.

use gonio_page::Language;
use gonio_share::{Group, Page, Picture, Problem, Scene, Setting, Tints, page};

fn group(name: &str, light: Vec<f32>) -> Group {
    Group { name: name.into(), light, watts: Some(12.5) }
}

fn picture(groups: Vec<Group>) -> Picture {
    let settings = vec![Setting { group: 0, level: 0.25, kelvin: Some(2700.0) }];
    Picture {
        title: "</title><script>alert(1)</script>".into(),
        size: [4, 3],
        groups,
        exposure: 1.0,
        average: 0.18,
        white: 6.0,
        stops: 0.0,
        tints: Tints { first: 1000, step: 50, colours: vec![[1.0; 3]; 181] },
        scenes: vec![Scene { name: "Evening".into(), settings }],
        hours: 2000.0,
        language: Language::English,
        limit: 1_000_000,
    }
}

fn made(picture: &Picture) -> Result<Page, Problem> {
    page(picture, |light, size| {
        assert_eq!(light.len(), 3 * size[0] * size[1]);
        Ok(vec![0xff, 0xd8])
    })
}

#[test]
fn a_page_holds_everything_and_nothing_leaves_its_element() {
    let page = made(&picture(vec![group("<b>Key</b>", vec![1.0; 36]), group("other", vec![0.5; 36])])).expect("a page");
    assert_eq!((page.size, page.html.matches("alert(1)").count()), ([4, 3], 2));
    assert!(!page.html.contains("<script>alert") && !page.html.contains("<b>Key") && page.html.contains("&lt;b&gt;Key"));
    assert!(!page.html.contains("{{") && page.html.contains("id=\"light-1\"") && page.html.contains("data:image/jpeg;base64,/9g="));
    assert!(!page.html.contains("http:") && !page.html.contains("https:"));
    assert!((page.error - 0.0036).abs() < 1e-4);
}

#[test]
fn every_language_makes_a_page() {
    for (code, language) in Language::CODES {
        let page = made(&Picture { language, ..picture(vec![group("Key", vec![1.0; 36])]) }).expect("a page");
        assert!(page.html.contains(&format!("<html lang=\"{code}\"")) && !page.html.contains("{{"));
    }
}

#[test]
fn problems_say_what_is_wrong() {
    let fails = |picture: &Picture| made(picture).expect_err("a problem").to_string();
    let key = || group("Key", vec![1.0; 36]);
    let mut dark = vec![1.0; 36];
    (dark[17], dark[18]) = (f32::NAN, f32::INFINITY);
    assert_eq!(fails(&picture(vec![])), "there are no light groups");
    assert_eq!(fails(&picture(vec![key(), key()])), "two light groups are named 'Key'");
    assert_eq!(fails(&picture(vec![group("Key", vec![1.0; 35])])), "the light group 'Key' has 35 values, 36 were expected");
    let problem = fails(&picture(vec![key(), group("Sky", dark)]));
    assert_eq!(problem, "the light group 'Sky' has 2 values that are not finite, the first in column 1 and row 1");
    let many = (0..65).map(|number| group(&number.to_string(), vec![1.0; 36])).collect();
    assert_eq!(fails(&picture(many)), "there are 65 light groups, a page holds at most 64");
    let still = page(&picture(vec![key()]), |_, _| Err("no room".into())).expect_err("a problem");
    assert_eq!(still, Problem::Still("no room".into()));
}
