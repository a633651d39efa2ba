//! The luminaire schedule: a scene's lights by type, with flux and power.

use super::html::Page;
use crate::{
    light_words::describe,
    photometry::{self, ugr},
    words::Words,
};
use gonio::{compile::luminous_fluxes, scene::Light};
use gonio_formats::photometry::{CATALOGUE_SPACING, Goniogram, PolarUnit, polar_diagram};
use gonio_page::fill;
use gonio_usd::{Loaded, LuminaireFile};

/// Lights that differ in nothing but their place.
#[derive(Debug)]
struct Kind {
    /// What tells it from others.
    key: String,
    name: String,
    maker: String,
    file: String,
    count: usize,
    /// Of one, lm, dimming included; none where it is not known.
    flux: Option<f64>,
    /// Of one, W by its file, at full power.
    watts: Option<f64>,
    dimming: f32,
}

/// A scene's lights.
#[derive(Debug)]
pub(super) struct Schedule<'a> {
    /// Those with a place.
    kinds: Vec<Kind>,
    /// Where each of them is, in metres, and its power in W where its file states it.
    places: Vec<([f64; 3], Option<f64>)>,
    /// Sun, sky and other light from infinity, in words.
    far: Vec<String>,
    /// Materials that shine by themselves.
    shining: usize,
    files: Vec<&'a LuminaireFile>,
}

impl<'a> Schedule<'a> {
    pub(super) fn new(loaded: &'a Loaded, words: &Words) -> Self {
        let scene = &loaded.scene;
        let mut kinds: Vec<Kind> = Vec::new();
        let mut places = Vec::new();
        let mut far = Vec::new();
        for (light, flux) in scene.lights.iter().zip(luminous_fluxes(scene)).filter(|(light, _)| !light.portal) {
            if light.shape.is_at_infinity() {
                far.push(format!("{}: {}", light.origin.name, describe(light, words)));
                continue;
            }
            let file = loaded.luminaires.iter().find(|file| file.is_of(light));
            places.push((light.transform.point([0.0; 3]), file.and_then(watts)));
            let what = describe(light, words);
            let key = format!("{:?} {what} {} {flux:.2?}", file.map(|file| &file.path), light.share());
            match kinds.iter_mut().find(|kind| kind.key == key) {
                Some(known) => known.count += 1,
                None => kinds.push(kind(key, what, light, file, flux)),
            }
        }
        let is_lit = |file: &&LuminaireFile| scene.lights.iter().any(|light| file.is_of(light));
        let files = loaded.luminaires.iter().filter(is_lit).collect();
        Self { kinds, places, far, shining: scene.materials.iter().filter(|material| material.shines()).count(), files }
    }

    /// Power in W of the lights at certain places whose files state it, how many these are, and how many have none stated.
    pub(super) fn installed_power(&self, counts: impl Fn([f64; 3]) -> bool) -> (f64, usize, usize) {
        let inside: Vec<Option<f64>> = self.places.iter().filter(|(place, _)| counts(*place)).map(|(_, watts)| *watts).collect();
        let known = inside.iter().flatten().count();
        (inside.iter().flatten().sum(), known, inside.len() - known)
    }

    /// The table with its totals, and what does not stand in it.
    pub(super) fn write(&self, words: &Words, page: &mut Page) {
        let say = &words.luminaires;
        page.section(&say.title);
        if self.kinds.is_empty() {
            page.paragraph(&say.none);
        } else {
            let rows: Vec<Vec<String>> = self.kinds.iter().map(|kind| kind.row(words)).collect();
            page.table(&say.columns, &rows, &self.totals(words));
            page.note(&say.note);
        }
        if !self.far.is_empty() {
            page.part(&say.afar);
            page.list(&self.far);
        }
        if self.shining > 0 {
            page.note(&fill(&say.shining, &[("count", &self.shining.to_string())]));
        }
    }

    fn totals(&self, words: &Words) -> Vec<String> {
        let sum = |of: fn(&Kind) -> Option<f64>| {
            let (known, unknown): (Vec<&Kind>, Vec<&Kind>) = self.kinds.iter().partition(|kind| of(kind).is_some());
            let sum: f64 = known.iter().filter_map(|kind| Some(of(kind)? * kind.count as f64)).sum();
            let unknown: usize = unknown.iter().map(|kind| kind.count).sum();
            let value = words.numbers.short(sum);
            match (known.is_empty(), unknown) {
                (true, _) => "–".to_owned(),
                (_, 0) => value,
                (_, unknown) => fill(&words.luminaires.unknown, &[("value", &value), ("count", &unknown.to_string())]),
            }
        };
        let blank = String::new;
        let count = self.kinds.iter().map(|kind| kind.count).sum::<usize>().to_string();
        let (flux, watts) = (sum(|kind| kind.flux), sum(|kind| kind.watts));
        vec![words.luminaires.in_all.clone(), blank(), blank(), count, blank(), blank(), blank(), blank(), flux, watts]
    }

    /// Each file with its polar diagram and what it says.
    pub(super) fn write_files(&self, words: &Words, page: &mut Page) {
        if self.files.is_empty() {
            return;
        }
        page.section(&words.file.title);
        let mut shown: Vec<&str> = Vec::new();
        for file in &self.files {
            // One file may be read for several purposes.
            if !shown.contains(&file.path.as_str()) {
                shown.push(&file.path);
                page.part(&file.path);
                page.drawing(&polar_diagram(&file.photometry, PolarUnit::CandelaPerKilolumen), &file.path);
                page.list(&photometry::as_text(&file.photometry, &file.photometry.figures(), None, words));
                write_ugr_table(&file.photometry, words, page);
            }
        }
    }
}

/// The UGR table of a file's luminaire, or why there is none.
fn write_ugr_table(goniogram: &Goniogram, words: &Words, page: &mut Page) {
    match goniogram.ugr_table(CATALOGUE_SPACING) {
        Ok(table) => {
            let rows: Vec<Vec<String>> =
                ugr::rows(&table).iter().map(|row| row.iter().map(|cell| words.numbers.form(cell)).collect()).collect();
            page.table(&ugr::names(&words.ugr), &rows, &[]);
            page.note(&fill(&words.ugr.note, &[("caption", &ugr::caption(&table, words))]));
        }
        Err(error) => page.note(&error.problem),
    }
}

/// Power in W that a file states.
fn watts(file: &LuminaireFile) -> Option<f64> {
    file.photometry.figures().watts
}

fn kind(key: String, what: String, light: &Light, file: Option<&LuminaireFile>, flux: Option<f64>) -> Kind {
    let text = |keyword: &str| file.and_then(|file| file.photometry.text(keyword)).map(str::to_owned);
    Kind {
        key,
        name: text("LUMINAIRE").or_else(|| text("LUMCAT")).unwrap_or(what),
        maker: text("MANUFAC").unwrap_or_else(|| "–".into()),
        file: file.map_or("–".into(), |file| file.path.clone()),
        count: 1,
        flux,
        watts: file.and_then(watts),
        dimming: light.share(),
    }
}

impl Kind {
    fn row(&self, words: &Words) -> Vec<String> {
        let shown = |value: Option<f64>| value.map_or("–".to_owned(), |value| words.numbers.short(value));
        let of_all = |value: Option<f64>| shown(value.map(|value| value * self.count as f64));
        // The lamp's own efficacy: what a dimmer leaves of its power no file tells.
        let full = self.flux.filter(|_| self.dimming > 0.0).map(|flux| flux / f64::from(self.dimming));
        let efficacy = full.zip(self.watts).map(|(flux, watts)| flux / watts);
        vec![
            self.name.clone(),
            self.file.clone(),
            self.maker.clone(),
            self.count.to_string(),
            shown(self.flux),
            shown(self.watts),
            shown(efficacy),
            format!("{:.0} %", 100.0 * self.dimming),
            of_all(self.flux),
            of_all(self.watts),
        ]
    }
}
