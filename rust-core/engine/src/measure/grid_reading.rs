//! What grids show.

use super::{
    eyes::EyeReadings,
    glare::Coverage,
    points::GridPoints,
    reaching::Reaching,
    reading::{Found, Reading, SmallSources, Summary},
    spectral::ColourReading,
    vector::Vector,
};
use crate::scene::{Grid, Measurand, Origin};
use std::sync::Arc;

/// What a grid shows.
#[derive(Clone, Debug, PartialEq)]
pub struct GridReading {
    /// Where the grid came from.
    pub origin: Origin,
    /// What was measured.
    pub measurand: Measurand,
    /// Points in a row, and rows.
    pub size: [usize; 2],
    /// Metres from point to point, along a row and from row to row.
    pub spacing: [f64; 2],
    /// Unit normal of the area.
    pub normal: Vector,
    /// Square metres of the whole surface, margins included, seen along the normal.
    pub area: f64,
    /// Position (world space, metres) and reading of each point, row by row; none where the area does not reach.
    pub points: Vec<Option<(Vector, Reading)>>,
    /// What eyes at the points get, whose mean over the directions is then each point's reading; none of grids without eyes.
    pub eyes: Option<EyeReadings>,
    /// The figures.
    pub summary: Summary,
    /// What the glare ratings leave out, by point in the order of those that were measured; empty of other quantities.
    pub coverage: Vec<Coverage>,
    /// Sources that the glare ratings take as small, and what tables would say, in the same order.
    pub small: Vec<SmallSources>,
    /// The spectra that figures of colour are of, in the same order, of eyes direction by direction; empty of other quantities.
    pub colours: Vec<Arc<ColourReading>>,
}

impl GridReading {
    pub(super) fn new(grid: &Grid, points: GridPoints, found: &[Found]) -> Self {
        let own = || found.iter().map(|found| found.reading);
        let eyes = (!points.facings.is_empty()).then(|| EyeReadings::new(points.facings, own()));
        let readings: Vec<Reading> = eyes.as_ref().map_or_else(|| own().collect(), EyeReadings::means);
        let mut next = readings.iter().copied();
        let placed = points.positions.iter().map(|position| position.and_then(|position| Some((position, next.next()?)))).collect();
        Self {
            origin: grid.origin.clone(),
            measurand: grid.measurand,
            size: points.size,
            spacing: points.spacing,
            normal: points.normal,
            area: points.area,
            points: placed,
            eyes,
            summary: Summary::new(readings.iter().copied()),
            coverage: found.iter().filter_map(|found| found.rated.map(|(coverage, _)| coverage)).collect(),
            small: found.iter().filter_map(|found| found.rated.map(|(_, small)| small)).collect(),
            colours: found.iter().filter_map(|found| found.colour.clone()).collect(),
        }
    }

    /// A grid that shows other values than what it measures, one for each point that there is.
    pub fn of_values(grid: &Grid, points: GridPoints, values: &[f64]) -> Self {
        let found: Vec<Found> = values.iter().map(|value| Found::from(Reading { value: *value, standard_error: 0.0 })).collect();
        Self::new(grid, GridPoints { facings: Vec::new(), ..points }, &found)
    }

    /// The figures by CIE 117 alone, as UGR tables have them; none where no source counts as small, or one is a point.
    pub fn tabular_summary(&self) -> Option<Summary> {
        let readings: Vec<Reading> = self.small.iter().map(|small| small.tabular).collect::<Option<_>>()?;
        self.small.iter().any(|small| small.count > 0).then(|| Summary::new(readings.into_iter()))
    }

    /// In words what the ratings are made of: small sources, and what is left out; none where there is nothing to be said.
    pub fn rating_note(&self) -> Option<String> {
        let notes: Vec<String> = [self.small_note(), self.coverage_note()].into_iter().flatten().collect();
        (!notes.is_empty()).then(|| notes.join("; "))
    }

    fn small_note(&self) -> Option<String> {
        let points = self.small.iter().filter(|small| small.count > 0).count();
        let tabular = match self.tabular_summary() {
            Some(Summary { average, min, max, .. }) => {
                let [average, min, max] = [average, min, max].map(|reading| reading.value);
                format!("average {average:.1}, least {min:.1}, greatest {max:.1}")
            }
            None => "none, since a point has no luminance".to_owned(),
        };
        let all = self.small.len();
        let note = || {
            format!(
                "sources below 0.005 m² rated as small by CIE 147 at {points} of {all} points; by CIE 117 alone, as in UGR tables: {tabular}"
            )
        };
        (points > 0).then(note)
    }

    /// In words what the ratings leave out; none where all is rated.
    pub fn coverage_note(&self) -> Option<String> {
        let notes: Vec<String> = [self.left_out_note(), self.covered_note()].into_iter().flatten().collect();
        (!notes.is_empty()).then(|| notes.join("; "))
    }

    fn covered_note(&self) -> Option<String> {
        let count = self.coverage.iter().filter(|coverage| coverage.covered > 0).count();
        let points = self.coverage.len();
        (count > 0)
            .then(|| format!("{count} of {points} points see luminaires behind glass or covers of the scene alone, which are not rated"))
    }

    fn left_out_note(&self) -> Option<String> {
        let out: Vec<&Coverage> = self.coverage.iter().filter(|coverage| coverage.left_out() > 0).collect();
        let share = out.iter().map(|coverage| coverage.share_left_out()).fold(0.0, f64::max);
        let most = out.iter().map(|coverage| coverage.left_out()).max()?;
        let points = format!("{} of {} points", out.len(), self.coverage.len());
        Some(format!(
            "sources left out (CIE 117) at {points}: {most} at most, up to {:.0} % of the sources' light at the eye",
            100.0 * share
        ))
    }

    /// The values row by row; not a number where the area does not reach.
    pub fn values(&self) -> Vec<f32> {
        self.points.iter().map(|point| point.map_or(f32::NAN, |(_, reading)| reading.value as f32)).collect()
    }

    /// The readings of all that was measured, point by point, of eyes direction by direction.
    pub fn readings(&self) -> Vec<Reading> {
        let of_points = || self.points.iter().flatten().map(|(_, reading)| *reading).collect();
        self.eyes.as_ref().map_or_else(of_points, |eyes| eyes.views.concat())
    }

    /// The melanopic light of figures of colour, as a grid of that shows it; none of other quantities.
    pub fn melanopic(&self) -> Option<Self> {
        let all = || self.colours.iter().map(|colour| colour.melanopic_edi().unwrap_or(Reading::UNKNOWN));
        let eyes = self.eyes.as_ref().map(|eyes| EyeReadings::new(eyes.facings.clone(), all()));
        let readings: Vec<Reading> = eyes.as_ref().map_or_else(|| all().collect(), EyeReadings::means);
        let mut next = readings.iter().copied();
        let points = self.points.iter().map(|point| point.and_then(|(position, _)| Some((position, next.next()?)))).collect();
        let summary = Summary::new(readings.iter().copied());
        let shown = Self { measurand: Measurand::MelanopicEdi, points, eyes, summary, colours: Vec::new(), ..self.clone() };
        (!self.colours.is_empty()).then_some(shown)
    }

    /// How many points reach a value, those with eyes by their mean over the directions.
    pub fn reaching(&self, target: f64) -> Reaching {
        Reaching::new(self.points.iter().flatten().map(|(_, reading)| *reading), target)
    }
}
