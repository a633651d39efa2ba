//! A year of daylight on a scene's grids: traced coefficients as `gonio_annual` takes them.
//!
//! [`AnnualGrid::all`] lays grids out, [`trace`] gives each a group of windows, and `gonio_annual::evaluate` makes a year of it.

use crate::{
    error::{Diagnostic, Error, Result},
    measure::{DaylightCoefficients, GridPoints, MOST_POINTS, ROUNDS, SkyTask, Watch, daylight_coefficients},
    scene::{Measurand, Meter, Origin, Scene},
    sky::Frame,
};
use gonio_annual::{AnnualError, Blinds, Coefficients, Division, Group, SUN_ANGLE_DEG, Year};
use gonio_simd::Execution;
use std::ops::Range;

/// Bytes that coefficients may take before they are refused.
const MOST_BYTES: f64 = 16e9;

/// A grid whose year is calculated.
#[derive(Clone, Debug)]
pub struct AnnualGrid {
    /// Where it came from.
    pub origin: Origin,
    /// A name of its own: the last part of its origin's.
    pub name: String,
    /// Points in a row, and rows.
    pub size: [usize; 2],
    /// By place in the rows, whether there is a point.
    pub is_there: Vec<bool>,
    /// The points, metres.
    pub positions: Vec<[f64; 3]>,
    /// Their unit normals.
    pub normals: Vec<[f64; 3]>,
}

impl AnnualGrid {
    /// The grids of a scene that measure illuminance, and its meters, a row for those below the same prim or of the same sensor grid; others are told.
    ///
    /// # Errors
    /// Neither grid nor meter, one that cannot be laid out, more than [`MOST_POINTS`] points.
    pub fn all(scene: &Scene) -> Result<(Vec<Self>, Vec<Diagnostic>)> {
        let (mut grids, mut diagnostics): (Vec<Self>, Vec<Diagnostic>) = Default::default();
        let left_out = |origin: &Origin, of: Measurand| {
            Diagnostic::warning(origin, format!("a year is calculated of illuminances; what measures {} is left out", of.name()))
        };
        for grid in &scene.grids {
            if grid.measurand != Measurand::Illuminance {
                diagnostics.push(left_out(&grid.origin, grid.measurand));
                continue;
            }
            let points = GridPoints::new(scene, grid)?;
            let positions: Vec<_> = points.known().collect();
            let mut found = Self::named(&grid.origin, &grid.origin.name, &grids);
            found.size = points.size;
            found.is_there = points.positions.iter().map(Option::is_some).collect();
            found.normals = vec![points.normal; positions.len()];
            found.positions = positions;
            grids.push(found);
        }
        let of_grids = grids.len();
        let mut parents: Vec<&str> = Vec::new();
        for meter in &scene.meters {
            if meter.measurand != Measurand::Illuminance {
                diagnostics.push(left_out(&meter.origin, meter.measurand));
                continue;
            }
            let parent = meter.origin.name.rsplit_once('/').map_or("", |(parent, _)| parent);
            let known = parents.iter().position(|other| *other == parent).unwrap_or_else(|| {
                parents.push(parent);
                grids.push(Self::named(&meter.origin, if parent.is_empty() { "meters" } else { parent }, &grids));
                parents.len() - 1
            });
            grids[of_grids + known].add(meter);
        }
        match grids.iter().map(|grid| grid.positions.len()).sum() {
            0 => Err(Error::setting("grid", "there is no grid and no meter that measures illuminance; name a surface with --grid /Prim")),
            count if count > MOST_POINTS => {
                Err(Error::setting("grids", format!("{count} points in all, expected at most {MOST_POINTS}; take a wider spacing")))
            }
            _ => Ok((grids, diagnostics)),
        }
    }

    /// One without points, with a name of its own.
    fn named(origin: &Origin, path: &str, others: &[Self]) -> Self {
        let stem = path.rsplit('/').next().unwrap_or_default();
        let is_double = others.iter().any(|other| other.name == stem);
        Self {
            origin: Origin { name: path.into(), file: origin.file.clone() },
            name: if is_double { format!("{stem}_{}", others.len() + 1) } else { stem.to_owned() },
            size: [0, 1],
            is_there: Vec::new(),
            positions: Vec::new(),
            normals: Vec::new(),
        }
    }

    fn add(&mut self, meter: &Meter) {
        self.size[0] += 1;
        self.is_there.push(true);
        self.positions.push(meter.position);
        self.normals.push(meter.normal);
    }

    fn meters(&self) -> impl Iterator<Item = Meter> {
        let meter = |(position, normal): (&[f64; 3], &[f64; 3])| Meter {
            origin: self.origin.clone(),
            position: *position,
            normal: *normal,
            ..Meter::default()
        };
        self.positions.iter().zip(&self.normals).map(meter)
    }
}

/// What is traced.
#[derive(Clone, Debug)]
pub struct AnnualTask<'a> {
    /// The year, whose suns are traced at their places.
    pub year: &'a Year,
    /// Where up and north are in the scene.
    pub frame: Frame,
    /// Reinhart's division of the sky, 1 to 6.
    pub factor: u32,
    /// Share of light through closed blinds, where there are some.
    pub blinds: Option<f32>,
    /// The scene with closed blinds, in place of a share.
    pub closed: Option<&'a Scene>,
}

/// A group of windows for each grid, and what differs from what was asked for: `scene.settings.samples` paths a point.
///
/// # Errors
/// What compiling finds, coefficients that would take too much memory, cancellation.
pub fn trace(
    scene: &Scene,
    grids: &[AnnualGrid],
    task: &AnnualTask<'_>,
    execution: Execution,
    watch: &mut Watch<'_>,
) -> Result<(Vec<Group>, Vec<Diagnostic>)> {
    let points: Vec<Meter> = grids.iter().flat_map(AnnualGrid::meters).collect();
    let open = coefficients(scene, &points, task, execution, watch)?;
    let closed = task.closed.map(|scene| coefficients(scene, &points, task, execution, watch)).transpose()?;
    let mut first = 0;
    let group = |grid: &AnnualGrid| {
        let rows = first..first + grid.positions.len();
        first = rows.end;
        let blinds = match &closed {
            Some(closed) => Some(Blinds::Coefficients(matrix(&closed.all, points.len(), rows.clone())?)),
            None => task.blinds.map(Blinds::Share),
        };
        Ok(Group {
            open: matrix(&open.all, points.len(), rows.clone())?,
            scattered: Some(matrix(&open.scattered, points.len(), rows.clone())?),
            direct: Some(matrix(std::slice::from_ref(&open.suns), points.len(), rows)?),
            sun: None,
            blinds,
        })
    };
    let groups = grids.iter().map(group).collect::<Result<Vec<_>>>()?;
    Ok((groups, open.diagnostics.into_iter().chain(closed.into_iter().flat_map(|closed| closed.diagnostics)).collect()))
}

/// The coefficients of all points in a scene.
pub(crate) fn coefficients(
    scene: &Scene,
    points: &[Meter],
    task: &AnnualTask<'_>,
    execution: Execution,
    watch: &mut Watch<'_>,
) -> Result<DaylightCoefficients> {
    let AnnualTask { year, frame, factor, .. } = task;
    let division = Division::new(*factor).ok_or_else(|| Error::setting("factor", format!("{factor} was found, expected 1 to 6")))?;
    let patches = division.patches().len();
    let bytes = 8.0 * ROUNDS as f64 * points.len() as f64 * patches as f64;
    if bytes > MOST_BYTES {
        let (wanted, most) = (bytes * 1e-9, MOST_BYTES * 1e-9);
        let problem = format!(
            "{} points with {patches} patches want {wanted:.0} GB, expected at most {most:.0}; take a wider spacing or a smaller factor",
            points.len()
        );
        return Err(Error::setting("grids", problem));
    }
    let axes = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(|axis| frame.to_scene(axis));
    let along = |axis: [f64; 3], direction: [f32; 3]| axis.iter().zip(direction).map(|(a, b)| a * f64::from(b)).sum::<f64>();
    let patch_of = |direction: [f32; 3]| division.patch_of(axes.map(|axis| along(axis, direction)));
    let suns: Vec<[f64; 3]> = year.sunny_steps().iter().map(|step| frame.to_scene(year.steps[*step].sun.direction())).collect();
    let place = |patch: usize, within: [f64; 2]| division.place(patch, within).map(|place| frame.to_scene(place).map(|x| x as f32));
    let solid_angle = |patch: usize| division.patches()[patch].solid_angle;
    let task = SkyTask {
        patches,
        patch_of: &patch_of,
        place: &place,
        solid_angle: &solid_angle,
        suns: &suns,
        sun_angle: SUN_ANGLE_DEG.to_radians(),
        up: axes[2],
    };
    daylight_coefficients(scene, points, &task, execution, watch)
}

/// Rows of some of all points, in all rounds.
pub(crate) fn matrix(rounds: &[Vec<f32>], all: usize, rows: Range<usize>) -> Result<Coefficients> {
    let columns = rounds.first().map_or(0, Vec::len) / all.max(1);
    let blocks = rounds.iter().map(|round| round[rows.start * columns..rows.end * columns].to_vec()).collect();
    Coefficients::new(rows.len(), columns, blocks).map_err(|error| Error::setting("grids", error.to_string()))
}

/// A year's error as one of the scene's.
pub fn told(error: AnnualError) -> Error {
    match error {
        AnnualError::Content { path, error } => Error::in_file(path, &error),
        AnnualError::Setting { name, problem } => Error::setting(name, problem),
    }
}
