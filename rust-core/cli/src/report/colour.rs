//! Colour of the light at grids and meters: figures, spectra beside TM-30's colour vector graphics, melanopic light on plans.

use super::{
    grids::{figure, plan},
    html::Page,
};
use crate::{
    arguments::ReportOptions,
    measure::evaluated,
    progress::Reporter,
    words::{ColourWords, Words},
};
use gonio::{
    Error, Result,
    compile::CompiledScene,
    measure::{ColourReading, GridPoints, GridReading, Measurements, Reading},
    scene::{Grid, Light, Material, Measurand, Meter, Scene},
};
use gonio_page::fill;
use gonio_spectrum::Figures;
use std::sync::{Arc, atomic::AtomicBool};

/// A place whose light has a colour.
struct Place {
    /// The meter, or the grid whose middle it is.
    of: String,
    is_middle: bool,
    /// Metres.
    at: [f64; 3],
    colour: Arc<ColourReading>,
}

/// What the page tells of colour.
#[derive(Default)]
pub(super) struct Colours {
    places: Vec<Place>,
    /// Melanopic light of grids that measure a figure of colour.
    plans: Vec<GridReading>,
    /// Why there is no more.
    missing: Option<String>,
}

impl Colours {
    /// What meters and grids of colour show; and where lamps have spectra, the light at meters of illuminance and at the middles of such grids.
    pub(super) fn new(
        (scene, found): (&Scene, &Measurements),
        previous: Option<&CompiledScene>,
        reporter: Reporter,
        interrupted: &'static AtomicBool,
    ) -> Result<Self> {
        let mut colours = Self::default();
        let meters = found.meters.iter().filter_map(|meter| Some((&meter.meter, meter.colour.clone()?)));
        colours.places.extend(meters.map(|(meter, colour)| Place {
            of: meter.origin.to_string(),
            is_middle: false,
            at: meter.position,
            colour,
        }));
        for grid in found.grids.iter().filter(|grid| !grid.colours.is_empty()) {
            colours.places.extend(middle_of(grid));
            colours.plans.extend(grid.melanopic());
        }
        let (others, are_middles): (Vec<Meter>, Vec<bool>) =
            if has_spectra(scene) { others(scene)? } else { Vec::new() }.into_iter().unzip();
        if others.is_empty() {
            return Ok(colours);
        }
        let beside = Scene { meters: others, grids: Vec::new(), ..scene.clone() };
        match evaluated(&beside, previous, reporter, interrupted) {
            Err(Error::Cancelled) => return Err(Error::Cancelled),
            Err(error) => colours.missing = Some(error.to_string()),
            Ok(found) => colours.places.extend(found.meters.iter().zip(are_middles).filter_map(|(meter, is_middle)| {
                let (of, at) = (meter.meter.origin.to_string(), meter.meter.position);
                Some(Place { of, is_middle, at, colour: meter.colour.clone()? })
            })),
        }
        Ok(colours)
    }

    /// The section, where there is anything to be told.
    pub(super) fn write(&self, options: &ReportOptions, words: &Words, page: &mut Page) -> Result<()> {
        if self.places.is_empty() && self.missing.is_none() {
            return Ok(());
        }
        let say = &words.colour;
        page.section(&say.title);
        if let Some(missing) = &self.missing {
            page.note(&fill(&say.missing, &[("problem", missing)]));
        }
        if self.places.is_empty() {
            return Ok(());
        }
        page.table(&say.columns, &self.places.iter().map(|place| place.row(words)).collect::<Vec<_>>(), &[]);
        page.note(&say.note);
        for place in &self.places {
            let name = place.name(say);
            if let Some(drawing) = place.colour.drawing(&name) {
                page.wide_drawing(&drawing, &fill(&say.drawing, &[("place", &name)]));
            }
        }
        self.plans.iter().try_for_each(|grid| plan(options, grid, (words, &mut *page)))
    }
}

impl Place {
    fn name(&self, say: &ColourWords) -> String {
        if self.is_middle { fill(&say.middle, &[("grid", &self.of)]) } else { self.of.clone() }
    }

    fn row(&self, words: &Words) -> Vec<String> {
        // Where a cell is narrow the error stands below its value.
        let whole = |text: String| text.replace("± ", "±\u{a0}");
        let shown = |found: Option<Reading>| found.map_or("–".to_owned(), |reading| whole(figure(&reading, "", words)));
        let of = |measurand: Measurand| shown(self.colour.of(measurand));
        let index = |of: fn(&Figures) -> Option<f64>| shown(self.colour.figure(of));
        let [x, y, z] = self.at.map(|number| words.numbers.fixed(number, 2));
        vec![
            fill(&words.colour.at, &[("place", &self.name(&words.colour)), ("x", &x), ("y", &y), ("z", &z)]),
            of(Measurand::Cct),
            self.colour.of(Measurand::Duv).map_or("–".to_owned(), |reading| whole(words.numbers.form(&duv(reading)))),
            of(Measurand::Ra),
            index(|figures| figures.white.as_ref()?.special_index(9)),
            of(Measurand::Rf),
            of(Measurand::Rg),
            index(Figures::melanopic_der),
            shown(self.colour.melanopic_edi()),
        ]
    }
}

/// Duv as it is written: with its sign and four places, or as many as its error has.
fn duv(Reading { value, standard_error }: Reading) -> String {
    if standard_error < 0.00005 { format!("{value:+.4}") } else { format!("{value:+.4} ± {standard_error:.4}") }
}

/// The point of a grid that is nearest to the middle of all of them, of eyes in the first direction.
fn middle_of(grid: &GridReading) -> Option<Place> {
    let positions: Vec<[f64; 3]> = grid.points.iter().flatten().map(|(position, _)| *position).collect();
    let number = middle(&positions)?;
    let eyes = grid.eyes.as_ref().map_or(1, |eyes| eyes.facings.len());
    let colour = grid.colours.get(number * eyes)?.clone();
    Some(Place { of: grid.origin.to_string(), is_middle: true, at: positions[number], colour })
}

/// The number of the place that is nearest to the mean of all.
fn middle(positions: &[[f64; 3]]) -> Option<usize> {
    let mean = [0, 1, 2].map(|axis| positions.iter().map(|position| position[axis]).sum::<f64>() / positions.len() as f64);
    let away = |position: &[f64; 3]| position.iter().zip(mean).map(|(a, b)| (a - b).powi(2)).sum::<f64>();
    (0..positions.len()).min_by(|a, b| away(&positions[*a]).total_cmp(&away(&positions[*b])))
}

/// Whether any of its lamps and surfaces that shine has a spectrum.
fn has_spectra(scene: &Scene) -> bool {
    let of_light = |light: &Light| light.lamp_spectrum().is_some();
    let of_surface = |material: &Material| material.spectrum.is_some() && material.shines();
    scene.lights.iter().any(of_light) || scene.materials.iter().any(of_surface)
}

/// Meters of colour where illuminance is measured: at meters, and at the middles of grids, which these are.
fn others(scene: &Scene) -> Result<Vec<(Meter, bool)>> {
    let is_lit = |measurand: Measurand| measurand == Measurand::Illuminance;
    let meters = scene.meters.iter().filter(|meter| is_lit(meter.measurand));
    let mut found: Vec<(Meter, bool)> = meters.map(|meter| (Meter { measurand: Measurand::Ra, ..meter.clone() }, false)).collect();
    for grid in scene.grids.iter().filter(|grid| is_lit(grid.measurand)) {
        found.extend(middle_meter(grid, &GridPoints::new(scene, grid)?).map(|meter| (meter, true)));
    }
    Ok(found)
}

fn middle_meter(grid: &Grid, points: &GridPoints) -> Option<Meter> {
    let positions: Vec<[f64; 3]> = points.known().collect();
    let meter = points.meters(grid).nth(middle(&positions)? * points.facings.len().max(1))?;
    Some(Meter { origin: grid.origin.clone(), measurand: Measurand::Ra, ..meter })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_middle_is_nearest_to_the_mean() {
        assert_eq!(middle(&[[0.0; 3], [1.0, 0.0, 0.0], [2.0, 0.0, 0.0]]), Some(1));
        assert_eq!(middle(&[]), None);
        assert_eq!(duv(Reading { value: 0.001_23, standard_error: 0.0 }), "+0.0012");
        assert_eq!(duv(Reading { value: -0.01, standard_error: 0.000_21 }), "-0.0100 ± 0.0002");
    }
}
