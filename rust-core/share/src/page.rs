//! The page's text.

use super::{
    codes::Steps,
    fit::{Fitted, fitted, reduced},
    pack::text,
    picture::{Picture, Problem},
    words::words,
};
use gonio_page::escaped;
use serde_json::{Value, json};
use std::collections::BTreeMap;

const TEMPLATE: &str = include_str!("../web/page.html");
const STYLE: &str = include_str!("../web/style.css");
/// In the order in which they need each other.
const SCRIPTS: [&str; 8] = [
    include_str!("../web/decode.js"),
    include_str!("../web/light.js"),
    include_str!("../web/gl.js"),
    include_str!("../web/plain.js"),
    include_str!("../web/show.js"),
    include_str!("../web/figures.js"),
    include_str!("../web/controls.js"),
    include_str!("../web/start.js"),
];

/// Columns that the picture for readers without scripts has at most.
const STILL_COLUMNS: usize = 1280;

/// A page, and what became of the picture in it.
#[derive(Clone, Debug)]
pub struct Page {
    /// The text of the file.
    pub html: String,
    /// Columns and rows that its light has.
    pub size: [usize; 2],
    /// The largest share by which a channel of a group's light differs from what it was.
    pub error: f64,
}

/// Bytes by which a group's numbers may be longer than foreseen.
const SLACK: usize = 64;

impl Page {
    /// The error where there is room enough.
    pub const FINE: f64 = 0.004;
}

/// Makes a page. `still` makes a JPEG of the picture's light, three values a pixel, with its columns and rows.
///
/// # Errors
/// As [`Problem`] lists them.
pub fn page(picture: &Picture, still: impl FnOnce(&[f32], [usize; 2]) -> Result<Vec<u8>, String>) -> Result<Page, Problem> {
    picture.check()?;
    let still = still_of(picture, still)?;
    let mut parts = parts(picture, &still);
    let groups: Vec<&[f32]> = picture.groups.iter().map(|group| group.light.as_slice()).collect();
    let bare = Fitted::bare(&groups, picture.size);
    parts.insert("data".into(), data(picture, &bare));
    parts.insert("lights".into(), lights(&bare));
    let fixed = expanded(TEMPLATE, &parts).len();
    // Base 64 takes four bytes for three; numbers of the groups may take some more.
    let room = picture.limit.saturating_sub(fixed + SLACK * picture.groups.len()) / 4 * 3;
    let fitted = fitted(&groups, picture.size, room)?;
    parts.insert("data".into(), data(picture, &fitted));
    parts.insert("lights".into(), lights(&fitted));
    let error = fitted.groups.first().map_or(0.0, |(steps, _)| steps.error());
    Ok(Page { html: expanded(TEMPLATE, &parts), size: fitted.size, error })
}

/// The sum of the groups as a JPEG in base 64.
fn still_of(picture: &Picture, still: impl FnOnce(&[f32], [usize; 2]) -> Result<Vec<u8>, String>) -> Result<String, Problem> {
    let mut sum = vec![0.0; 3 * picture.size[0] * picture.size[1]];
    for group in &picture.groups {
        sum.iter_mut().zip(&group.light).for_each(|(sum, light)| *sum += light);
    }
    let [width, height] = picture.size;
    let columns = width.min(STILL_COLUMNS);
    let size = [columns, (height * columns / width).max(1)];
    let bytes = still(&reduced(&sum, picture.size, size), size).map_err(Problem::Still)?;
    Ok(text(&bytes))
}

/// What fills the template, but for the light.
fn parts(picture: &Picture, still: &str) -> BTreeMap<String, String> {
    let words = words(picture.language);
    let rows = picture.groups.iter().map(|group| {
        let watts = group.watts.map_or_else(|| "–".to_owned(), |watts| format!("{watts} W"));
        format!("<tr><th scope=\"row\">{}</th><td>100 %</td><td>–</td><td>{watts}</td></tr>\n", escaped(&group.name))
    });
    let rows: String = rows.collect();
    let mut parts: BTreeMap<String, String> = words.iter().map(|(key, word)| (format!("word.{key}"), escaped(word))).collect();
    let mut put = |key: &str, text: String| drop(parts.insert(key.to_owned(), text));
    put("language", picture.language.code().to_owned());
    put("title", escaped(&picture.title));
    put("width", picture.size[0].to_string());
    put("height", picture.size[1].to_string());
    put("style", STYLE.to_owned());
    put("script", SCRIPTS.concat());
    put("still", format!("data:image/jpeg;base64,{still}"));
    put("rows", rows);
    parts
}

/// What the scripts know, as JSON in an element.
fn data(picture: &Picture, fitted: &Fitted) -> String {
    let group = |(group, (Steps { low, .. }, _)): (&super::Group, &(Steps, Vec<u8>))| json!({ "name": group.name, "low": low, "watts": group.watts });
    let setting = |setting: &super::Setting| json!({ "group": setting.group, "level": setting.level, "kelvin": setting.kelvin });
    let scene = |scene: &super::Scene| json!({ "name": scene.name, "settings": scene.settings.iter().map(setting).collect::<Vec<_>>() });
    let tints = &picture.tints;
    let data: Value = json!({
        "size": fitted.size,
        "original": picture.size,
        "perStop": fitted.groups.first().map_or(1, |(steps, _)| steps.per_stop),
        "groups": picture.groups.iter().zip(&fitted.groups).map(group).collect::<Vec<_>>(),
        "exposure": picture.exposure,
        "average": picture.average,
        "white": picture.white,
        "stops": picture.stops,
        "tints": { "first": tints.first, "step": tints.step, "colours": tints.colours },
        "scenes": picture.scenes.iter().map(scene).collect::<Vec<_>>(),
        "hours": picture.hours,
        "words": words(picture.language),
    });
    // No text within can end the element.
    data.to_string().replace('<', "\\u003c")
}

fn lights(fitted: &Fitted) -> String {
    let light = |(number, (_, bytes)): (usize, &(Steps, Vec<u8>))| {
        format!("<script type=\"application/octet-stream\" id=\"light-{number}\">{}</script>\n", text(bytes))
    };
    fitted.groups.iter().enumerate().map(light).collect()
}

/// The template with its holes, `{{name}}`, filled; what fills them is not looked at again.
fn expanded(template: &str, parts: &BTreeMap<String, String>) -> String {
    let mut out = String::new();
    let mut rest = template;
    while let Some((before, after)) = rest.split_once("{{") {
        let (name, after) = after.split_once("}}").unwrap_or((after, ""));
        out.push_str(before);
        out.push_str(parts.get(name).map_or("", String::as_str));
        rest = after;
    }
    out.push_str(rest);
    out
}
