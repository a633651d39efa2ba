//! What a measured material amounts to: albedo by angle, reciprocity, energy, and what is wrong with it.

use super::axis::degrees;
use super::coordinates::Coordinates;
use super::direction::{Direction, spherical, through};
use super::hemispheres::Hemispheres;
use super::measured::Measured;
use super::patches::Band;
use super::quadrature::STRATA;
use super::report::{Albedo, Reciprocity};
use super::table::{Layout, Table};

/// Polar angles of light that albedo is told for, degrees.
const THETA_DEG: [f64; 7] = [0.0, 15.0, 30.0, 45.0, 60.0, 75.0, 85.0];

/// Azimuths of light that an anisotropic material's albedo is told for, degrees.
const PHI_DEG: [f64; 2] = [0.0, 90.0];

/// A coarser quadrature for spectra of many bands: lobes down to about a degree.
const COARSE_STRATA: usize = 64;

/// With more channels than that the quadrature is the coarse one.
const MOST_FINE_CHANNELS: usize = 8;

/// More than arrives may leave by that share before it counts as a problem: noise of a measurement and of its interpolation.
const ENERGY_TOLERANCE: f64 = 0.005;

/// Reciprocity that differs by more than that on average is a problem.
const RECIPROCITY_TOLERANCE: f64 = 0.05;

/// Angles of light or view that end before that many degrees are told.
const LEAST_LAST_DEG: f64 = 80.0;

/// A share of light: its luminance, and it in linear Rec.709.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Share {
    /// As luminance.
    pub luminance: f64,
    /// In linear Rec.709.
    pub rgb: [f64; 3],
}

/// What becomes of light from one direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FromDirection {
    /// Whether it comes from the front.
    pub from_front: bool,
    /// Its angle from the normal of that side, degrees.
    pub theta_deg: f64,
    /// Its azimuth, degrees.
    pub phi_deg: f64,
    /// What goes back to its side.
    pub reflected: Share,
    /// What passes through.
    pub transmitted: Share,
}

/// Figures of a measured material.
#[derive(Clone, Debug, PartialEq)]
pub struct Figures {
    /// Albedo by angle, those sides alone that scatter anything.
    pub albedo: Vec<FromDirection>,
    /// How reciprocal it is; none where nothing scatters both ways.
    pub reciprocity: Option<Reciprocity>,
    /// What is wrong or missing, one sentence each.
    pub problems: Vec<String>,
}

impl Measured {
    /// Albedo by angle, reciprocity, energy and problems. It takes some hundred thousand evaluations.
    pub fn figures(&self) -> Figures {
        let albedo = self.albedo_by_angle();
        let reciprocity = self.reciprocity();
        let mut problems = energy_problems(&albedo);
        problems.extend(reciprocity.filter(|found| found.mean_difference > RECIPROCITY_TOLERANCE).map(|found| {
            format!("not reciprocal: with light and view exchanged values differ by {:.1} % on average", 100.0 * found.mean_difference)
        }));
        match self {
            Self::Tables(tables) => tables.iter().for_each(|table| problems.extend(table_problems(table))),
            Self::Rgl(rgl) => {
                let last = rgl.theta_knots().last().copied().unwrap_or(0.0);
                problems.extend(coverage("reflection-front", "theta_o", f64::from(last)));
            }
            Self::Patches(_) | Self::Tree(_) => problems.extend(self.unseen()),
        }
        Figures { albedo, reciprocity, problems }
    }

    /// Where the file has what the eye does not see alone, one sentence for each such pair of sides: nothing scatters there.
    pub fn unseen(&self) -> Vec<String> {
        let found: Vec<(Hemispheres, Band)> = match self {
            Self::Patches(patches) => patches.matrices().iter().map(|matrix| (matrix.hemispheres, matrix.band)).collect(),
            Self::Tree(tree) => tree.components().iter().map(|component| (component.hemispheres, component.band)).collect(),
            Self::Tables(_) | Self::Rgl(_) => Vec::new(),
        };
        let told = |pair: &Hemispheres| {
            let bands: Vec<String> = found.iter().filter(|(of, _)| of == pair).map(|(_, band)| format!("{band:?}")).collect();
            let missing = !bands.is_empty() && !self.has(*pair);
            missing.then(|| format!("{}: there is {} alone and nothing visible; nothing scatters there", pair.name(), bands.join(", ")))
        };
        Hemispheres::ALL.iter().filter_map(told).collect()
    }

    /// Albedo of light from both sides at fixed angles.
    fn albedo_by_angle(&self) -> Vec<FromDirection> {
        let azimuths = if self.is_isotropic() { &PHI_DEG[..1] } else { &PHI_DEG[..] };
        let mut rows = Vec::new();
        for from_front in [true, false] {
            if !Hemispheres::ALL.into_iter().any(|pair| pair.is_from_front() == from_front && self.has(pair)) {
                continue;
            }
            for (&theta_deg, &phi_deg) in THETA_DEG.iter().flat_map(|theta| azimuths.iter().map(move |phi| (theta, phi))) {
                let up = spherical(theta_deg.to_radians(), phi_deg.to_radians());
                let [reflected, transmitted] = self.shares(if from_front { up } else { through(up) });
                rows.push(FromDirection { from_front, theta_deg, phi_deg, reflected, transmitted });
            }
        }
        rows
    }

    /// What is reflected and transmitted of light from `wi`.
    fn shares(&self, wi: Direction) -> [Share; 2] {
        let strata = if self.channels().count() > MOST_FINE_CHANNELS { COARSE_STRATA } else { STRATA };
        let Albedo { reflected, transmitted } = self.albedo_by(wi, strata);
        let (luminance, rgb) = (self.channels().luminance_weights(), self.channels().rgb_weights());
        [reflected, transmitted].map(|values| Share {
            luminance: values.iter().zip(&luminance).map(|(v, w)| v * w).sum(),
            rgb: [0, 1, 2].map(|c| values.iter().zip(&rgb).map(|(v, w)| v * w[c]).sum()),
        })
    }
}

/// Where more light leaves than arrives, the worst direction of each side; or that none leaves at all.
fn energy_problems(albedo: &[FromDirection]) -> Vec<String> {
    let total = |row: &FromDirection| row.reflected.luminance + row.transmitted.luminance;
    if albedo.iter().all(|row| total(row) <= 0.0) {
        return vec!["nothing scatters".into()];
    }
    let worst = |from_front: bool| {
        let side = albedo.iter().filter(|row| row.from_front == from_front);
        let row = side.max_by(|a, b| total(a).total_cmp(&total(b)))?;
        (total(row) > 1.0 + ENERGY_TOLERANCE).then(|| {
            let side = if from_front { "front" } else { "back" };
            format!("more light leaves than arrives: {:.3} of what comes from the {side} at {}°", total(row), row.theta_deg)
        })
    };
    [true, false].into_iter().filter_map(worst).collect()
}

/// Cells without a value, and angles that were not measured.
fn table_problems(table: &Table) -> Vec<String> {
    let layout = table.layout();
    let side = layout.hemispheres.name();
    let mut problems = Vec::new();
    let cells = table.values().len() / layout.channels.count();
    let expected = below_horizon(layout);
    let invalid = table.invalid_cells().saturating_sub(expected);
    if invalid > 0 {
        let share = 100.0 * invalid as f64 / cells as f64;
        problems.push(format!("{side}: {invalid} of {cells} cells above the surface ({share:.1} %) have no value"));
    }
    let names = layout.coordinates.axis_names();
    for (name, axis) in names.iter().zip(&layout.axes).filter(|(name, _)| ["theta_i", "theta_o"].contains(name)) {
        problems.extend(coverage(side, name, axis.knots().last().copied().unwrap_or(0.0)));
    }
    problems
}

/// Cells with a direction below the surface, which coordinates about a half vector or a specular direction have.
fn below_horizon(layout: &Layout) -> usize {
    if matches!(layout.coordinates, Coordinates::Isotropic | Coordinates::Anisotropic) {
        return 0;
    }
    let count: usize = layout.axes.iter().map(|axis| axis.knots().len()).product();
    let is_below = |cell: &usize| {
        let (wi, wo) = layout.directions(*cell);
        wi[2] < 0.0 || wo[2] < 0.0
    };
    (0..count).filter(is_below).count()
}

/// What holds beyond the last polar angle, if that is not near the horizon.
fn coverage(side: &str, axis: &str, last: f64) -> Option<String> {
    let last = degrees(last);
    (last < LEAST_LAST_DEG).then(|| format!("{side}: {axis} ends at {last:.1}°; what was measured there holds up to 90°"))
}
