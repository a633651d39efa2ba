//! Grids whose year is calculated.

use crate::{
    error::{Diagnostic, Error, Result},
    measure::{GridPoints, MOST_POINTS},
    scene::{Measurand, Meter, Origin, Scene},
};

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
            if grid.eyes.is_some() {
                let message = "a year is calculated of planes; the eyes of this grid are left out (gonio annual-glare rates eyes)";
                diagnostics.push(Diagnostic::warning(&grid.origin, message));
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

    pub(super) fn meters(&self) -> impl Iterator<Item = Meter> {
        let meter = |(position, normal): (&[f64; 3], &[f64; 3])| Meter {
            origin: self.origin.clone(),
            position: *position,
            normal: *normal,
            ..Meter::default()
        };
        self.positions.iter().zip(&self.normals).map(meter)
    }
}
