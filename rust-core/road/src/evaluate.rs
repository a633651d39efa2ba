//! From a road to its results.

use crate::{
    areas::{Lit, ratio},
    energy::energy,
    field::{across, field, middles},
    glare::{increment, veiling},
    illuminance::Measurand,
    line::Line,
    luminance::{AWAY, EYE, Seen},
    required::{Wanted, classes, verdicts},
    results::{Field, Observed, Results},
    road::Road,
    surface::Surface,
};

impl Road {
    /// Calculates everything.
    pub fn evaluate(&self) -> Results {
        let lines = Line::all(self);
        let field = field(self, &lines);
        let lit = Lit { road: self, lines: &lines, field: &field };
        let observers: Vec<Observed> = (1..=self.lanes).map(|lane| self.observed(&lines, &field, lane)).collect();
        let edges = lit.edges();
        let illuminances = lit.illuminances([0.0, self.carriageway_width]);
        let footpaths: Vec<_> = self.footpaths.iter().map(|path| lit.footpath(path)).collect();
        let illuminance_y = across([0.0, self.carriageway_width]);
        let mut results = Results {
            standard: self.standard.name(),
            l_av: observers.iter().map(|seen| seen.l_av).fold(f64::INFINITY, f64::min),
            uo: lowest(observers.iter().map(|seen| seen.uo)),
            ul: lowest(observers.iter().map(|seen| seen.ul)),
            uo_wet: lowest(observers.iter().map(|seen| seen.uo_wet)),
            ti: lowest(observers.iter().map(|seen| seen.ti.map(|ti| -ti))).map(|ti| -ti),
            eir: lowest(edges.iter().map(|edge| edge.ratio)),
            energy: energy(self, &lines, &field, &illuminances, &footpaths),
            illuminances,
            observers,
            edges,
            footpaths,
            surface: self.surface.figures.clone(),
            wet_surface: self.wet.as_ref().map(|wet| wet.figures.clone()),
            field,
            x: field.xs(),
            luminance_y: middles([0.0, self.carriageway_width], field.across),
            illuminance: lit.values(&illuminance_y, Measurand::Horizontal),
            illuminance_y,
            required: Vec::new(),
            met: None,
            class: None,
            classes: Vec::new(),
            notes: Vec::new(),
        };
        results.required = verdicts(&self.required, &|key| results.wanted(key));
        results.classes = classes(&self.classes, &|key| results.wanted(key));
        results.class = results.classes.iter().find(|class| class.met).map(|class| class.name.clone());
        let mut asked = results.required.iter().chain(results.footpaths.iter().flat_map(|path| &path.required)).peekable();
        results.met = asked.peek().is_some().then(|| asked.all(|verdict| verdict.met));
        results.notes = self.notes(&results);
        results
    }

    /// What the observer in a lane sees.
    fn observed(&self, lines: &[Line<'_>], field: &Field, lane: u32) -> Observed {
        let y = (f64::from(lane) - 0.5) * self.lane_width();
        let grid = |surface| self.grid(lines, field, surface, y);
        let (values, [average, initial]) = grid(&self.surface);
        let least = |values: &[Vec<f64>]| values.iter().flatten().copied().fold(f64::INFINITY, f64::min);
        let middle = values.get(3 * lane as usize - 2).map_or(&[][..], Vec::as_slice);
        let ends = middle.iter().fold([f64::INFINITY, 0.0], |[low, high], value| [value.min(low), value.max(high)]);
        let uo_wet = self.wet.as_ref().and_then(|wet| {
            let (values, [average, _]) = grid(wet);
            ratio(least(&values), average)
        });
        let [veiling, veiling_x] = veiling(lines, field, y, self.observer_age);
        Observed {
            lane,
            position: [field.start - AWAY, y, EYE],
            l_av: average,
            l_av_initial: initial,
            uo: ratio(least(&values), average),
            ul: ratio(ends[0], ends[1]),
            uo_wet,
            ti: increment(veiling, initial),
            veiling,
            veiling_x,
            luminance: values,
        }
    }

    /// Maintained luminances by y and x, and the averages of maintained and initial luminance.
    fn grid(&self, lines: &[Line<'_>], field: &Field, surface: &Surface, y: f64) -> (Vec<Vec<f64>>, [f64; 2]) {
        let seen = self.seen(lines, surface, [field.start - AWAY, y]);
        let (xs, ys) = (field.xs(), middles([0.0, self.carriageway_width], field.across));
        let mut sums = [0.0; 2];
        let mut row = |y: f64| {
            let of_point = |x: &f64| {
                let [maintained, initial] = seen.luminance([*x, y]);
                sums = [sums[0] + maintained, sums[1] + initial];
                maintained
            };
            xs.iter().map(of_point).collect::<Vec<f64>>()
        };
        let values: Vec<Vec<f64>> = ys.into_iter().map(&mut row).collect();
        let count = (field.along * field.across) as f64;
        (values, sums.map(|sum| sum / count))
    }

    /// What luminance is calculated with, for an observer at a place.
    pub(crate) fn seen<'a>(&'a self, lines: &'a [Line<'a>], surface: &'a Surface, observer: [f64; 2]) -> Seen<'a> {
        Seen { lines, reach: &self.reach, surface, standard: self.standard, observer }
    }

    fn notes(&self, results: &Results) -> Vec<String> {
        let mut notes = Vec::new();
        let spacings = self.rows.iter().map(|row| row.spacing);
        if spacings.clone().fold(f64::INFINITY, f64::min) < spacings.fold(0.0, f64::max) {
            notes.push("rows have different spacings: the field is that of the widest, and other fields of this road differ".into());
        }
        if results.observers.iter().any(|seen| seen.ti.is_none()) {
            notes.push("no threshold increment: its formula holds above 0.05 cd/m² of initial average luminance".into());
        }
        for surface in [Some(&self.surface), self.wet.as_ref()].into_iter().flatten() {
            if surface.farthest() < self.reach.luminance[1] {
                let (name, end, reach) = (&surface.name, surface.farthest(), self.reach.luminance[1]);
                notes.push(format!(
                    "{name}: the table ends at tan γ {end}; luminaires beyond it, up to {reach} heights ahead, count for nothing"
                ));
            }
        }
        for row in &self.rows {
            let warned = row.goniogram.warnings.iter().map(|warning| format!("{}: {warning}", row.luminaire));
            notes.extend(warned.filter(|warning| !notes.contains(warning)).collect::<Vec<_>>());
            let measured = row.goniogram.stated.measurement_tilt;
            if measured != 0.0 {
                notes
                    .push(format!("{}: measured at a tilt of {measured}°, from which the tilt of {}° is counted", row.luminaire, row.tilt));
            }
        }
        notes
    }
}

/// The lowest of values that are all there.
fn lowest(values: impl Iterator<Item = Option<f64>>) -> Option<f64> {
    values.collect::<Option<Vec<f64>>>()?.into_iter().min_by(f64::total_cmp)
}
