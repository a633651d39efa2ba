//! A page of raw floats, for work on pages without an engine: `cargo run --example page -- picture.json page.html`.
//!
//! The JSON has `title`, `size`, `exposure`, `average`, `still` (a JPEG file), `tints` (colours from 1000 K in steps of 50 K), `groups` with `name`,
//! `watts` and `light` (a file of 32-bit floats, three a pixel), `scenes` with `name` and `settings` (`group`, `level`, `kelvin`), `language`, `limit`.

use gonio_page::Language;
use gonio_share::{Group, Picture, Scene, Setting, Tints, page};
use serde_json::Value;
use std::{error::Error, fs};

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or(0.0)
}

fn name(value: &Value) -> String {
    value["name"].as_str().unwrap_or_default().to_owned()
}

fn items(value: &Value) -> &[Value] {
    value.as_array().map_or(&[], Vec::as_slice)
}

fn main() -> Result<(), Box<dyn Error>> {
    let [from, to] =
        <[String; 2]>::try_from(std::env::args().skip(1).collect::<Vec<_>>()).map_err(|_| "expected picture.json page.html")?;
    let given: Value = serde_json::from_slice(&fs::read(from)?)?;
    let group = |group: &Value| -> Result<Group, std::io::Error> {
        let bytes = fs::read(group["light"].as_str().unwrap_or_default())?;
        let light = bytes.as_chunks::<4>().0.iter().map(|bytes| f32::from_le_bytes(*bytes)).collect();
        Ok(Group { name: name(group), light, watts: group["watts"].as_f64() })
    };
    let setting = |of: &Value| Setting { group: number(&of["group"]) as usize, level: number(&of["level"]), kelvin: of["kelvin"].as_f64() };
    let scene = |scene: &Value| Scene { name: name(scene), settings: items(&scene["settings"]).iter().map(setting).collect() };
    let colour = |colour: &Value| [0, 1, 2].map(|k| number(&colour[k]) as f32);
    let code = given["language"].as_str().unwrap_or("en");
    let picture = Picture {
        title: given["title"].as_str().unwrap_or_default().to_owned(),
        size: [0, 1].map(|axis| number(&given["size"][axis]) as usize),
        groups: items(&given["groups"]).iter().map(group).collect::<Result<_, _>>()?,
        exposure: number(&given["exposure"]) as f32,
        average: number(&given["average"]) as f32,
        white: 6.0,
        stops: 0.0,
        tints: Tints { first: 1000, step: 50, colours: items(&given["tints"]).iter().map(colour).collect() },
        scenes: items(&given["scenes"]).iter().map(scene).collect(),
        hours: 2500.0,
        language: Language::of_code(code),
        limit: given["limit"].as_u64().unwrap_or(15_000_000) as usize,
    };
    let still = fs::read(given["still"].as_str().unwrap_or_default())?;
    let page = page(&picture, |_, _| Ok(still))?;
    eprintln!("{} bytes, {:?} pixels, {:.2} %", page.html.len(), page.size, 100.0 * page.error);
    fs::write(to, page.html)?;
    Ok(())
}
