//! Groups of windows: their coefficients, their blinds, and what light they let in.

use super::wrong;
use crate::{
    Coefficients,
    division::Division,
    error::{AnnualError, Result},
    product::Panels,
    sky::SkyMatrix,
    sun::SUN_ANGLE_DEG,
    year::Year,
};
use std::f64::consts::PI;

/// Direct sun that has blinds closed, lx (LM-83-12).
const TOO_BRIGHT: f32 = 1000.0;
/// Blinds close when more than this share of the points has it.
const TOO_MANY: f64 = 0.02;

/// What blinds leave of a group's light when they are closed.
#[derive(Clone, Debug)]
pub enum Blinds {
    /// This share of the light through open ones; 0.02 is usual.
    Share(f32),
    /// Coefficients of their own.
    Coefficients(Coefficients),
}

/// Windows whose blinds are operated together.
#[derive(Clone, Debug)]
pub struct Group {
    /// Of all light, blinds open: points × patches.
    pub open: Coefficients,
    /// Of direct light alone: points × patches, or points × suns, a column for each step with the sun above the horizon.
    pub direct: Option<Coefficients>,
    /// Of the sun's light with all its bounces: points × suns. Where it is given, the sun leaves the patches.
    pub sun: Option<Coefficients>,
    /// The blinds, which direct sun closes; `None` where there are none.
    pub blinds: Option<Blinds>,
}

/// What all groups of a grid have in common.
pub(super) struct Shape {
    pub(super) points: usize,
    pub(super) factor: u32,
    pub(super) blocks: usize,
    pub(super) has_direct: bool,
    /// For each step the column of its sun.
    pub(super) suns: Vec<Option<usize>>,
}

/// Checks coefficients against each other and the year.
pub(super) fn shape(groups: &[Group], year: &Year) -> Result<Shape> {
    let first = groups.first().ok_or_else(|| AnnualError::setting("coefficients", "there are none"))?;
    let (points, patches) = (first.open.points, first.open.columns);
    let division = Division::of_count(patches).ok_or_else(|| {
        let counts = [1, 2, 3, 4, 5, 6].map(|factor| Division::count(factor).to_string()).join(", ");
        wrong(&first.open, format!("{patches} columns, expected those of a sky with its ground: {counts}"))
    })?;
    let sunny = year.sunny_steps();
    let mut blocks = 1;
    for group in groups {
        let closed = if let Some(Blinds::Coefficients(closed)) = &group.blinds { Some(closed) } else { None };
        for (of, is_patches, is_suns) in [
            (Some(&group.open), true, false),
            (closed, true, false),
            (group.direct.as_ref(), true, true),
            (group.sun.as_ref(), false, true),
        ] {
            let Some(of) = of else { continue };
            if of.points != points {
                return Err(wrong(of, format!("{} rows, expected {points}, the points of the other matrices", of.points)));
            }
            if !(is_patches && of.columns == patches || is_suns && of.columns == sunny.len()) {
                let names =
                    [(is_patches, patches, "patches"), (is_suns, sunny.len(), "suns, one for each step of the weather with the sun up")];
                let expected: Vec<String> =
                    names.iter().filter(|name| name.0).map(|(_, count, name)| format!("{count} ({name})")).collect();
                return Err(wrong(of, format!("{} columns, expected {}", of.columns, expected.join(" or "))));
            }
            if blocks > 1 && of.blocks.len() > 1 && of.blocks.len() != blocks {
                return Err(wrong(of, format!("{} blocks, expected {blocks} as in the other matrices", of.blocks.len())));
            }
            blocks = blocks.max(of.blocks.len());
        }
        if group.blinds.is_some() && group.direct.is_none() {
            return Err(AnnualError::setting("blinds", "direct coefficients are missing: direct sun is what closes blinds"));
        }
    }
    let mut suns = vec![None; year.steps.len()];
    sunny.iter().enumerate().for_each(|(column, step)| suns[*step] = Some(column));
    let has_direct = groups.iter().all(|group| group.direct.is_some());
    Ok(Shape { points, factor: division.factor(), blocks, has_direct, suns })
}

/// A group's matrices as products take them.
pub(super) struct Prepared {
    open: Panels,
    direct: Option<Direct>,
    sun: Option<Direct>,
    blinds: Option<Closed>,
}

enum Direct {
    Patches(Panels),
    /// `[point][sun]`.
    Suns(Vec<f32>, usize),
}

enum Closed {
    Share(f32),
    Panels(Panels),
}

impl Prepared {
    /// All groups, without one of the blocks if that is asked for.
    pub(super) fn all(groups: &[Group], without: Option<usize>) -> Vec<Self> {
        let panels = |of: &Coefficients| Panels::new(of.points, of.columns, &mean(of, without));
        let prepare = |group: &Group| Self {
            open: panels(&group.open),
            direct: group.direct.as_ref().map(|direct| {
                if direct.columns == group.open.columns {
                    Direct::Patches(panels(direct))
                } else {
                    Direct::Suns(mean(direct, without), direct.columns)
                }
            }),
            sun: group.sun.as_ref().map(|sun| Direct::Suns(mean(sun, without), sun.columns)),
            blinds: group.blinds.as_ref().map(|blinds| match blinds {
                Blinds::Share(share) => Closed::Share(*share),
                Blinds::Coefficients(closed) => Closed::Panels(panels(closed)),
            }),
        };
        groups.iter().map(prepare).collect()
    }
}

/// Matrices of a single block stay whole.
fn mean(of: &Coefficients, without: Option<usize>) -> Vec<f32> {
    of.mean(without.filter(|_| of.blocks.len() > 1))
}

/// The skies that columns are taken from.
pub(super) struct Skies<'a> {
    pub(super) all: &'a SkyMatrix<'a>,
    pub(super) alone: &'a SkyMatrix<'a>,
    pub(super) suns: &'a [Option<usize>],
}

/// A chunk's columns of the sky.
pub(super) struct Columns {
    /// Sky and sun.
    all: Vec<f32>,
    /// The sun in the patches.
    alone: Vec<f32>,
    /// The sky without the sun.
    sky: Vec<f32>,
    /// Column and luminance in cd/m² of each step's sun.
    suns: Vec<Option<(usize, f32)>>,
}

impl Columns {
    pub(super) fn new(skies: &Skies<'_>, groups: &[Group], shape: &Shape, steps: &[usize], threads: usize) -> Self {
        let patches = Division::count(shape.factor);
        let needs_alone =
            groups.iter().any(|group| group.sun.is_some() || group.direct.as_ref().is_some_and(|direct| direct.columns == patches));
        let all = skies.all.columns(steps, threads);
        let alone = if needs_alone { skies.alone.columns(steps, threads) } else { Vec::new() };
        let sky = if groups.iter().any(|group| group.sun.is_some()) {
            all.iter().zip(&alone).map(|(all, sun)| (all - sun).max(0.0)).collect()
        } else {
            Vec::new()
        };
        let disc = PI * (0.5 * SUN_ANGLE_DEG).to_radians().powi(2);
        let sun = |step: &usize| Some((skies.suns[*step]?, (skies.all.conditions(*step)?.direct_normal / disc) as f32));
        Self { all, alone, sky, suns: steps.iter().map(sun).collect() }
    }
}

impl Direct {
    fn light(&self, columns: &Columns, threads: usize) -> Vec<f32> {
        match self {
            Self::Patches(panels) => panels.times(&columns.alone, threads),
            Self::Suns(rows, count) => {
                let at = |row: &[f32], sun: &Option<(usize, f32)>| sun.map_or(0.0, |(column, luminance)| row[column] * luminance);
                rows.chunks_exact(*count).flat_map(|row| columns.suns.iter().map(move |sun| at(row, sun))).collect()
            }
        }
    }
}

/// Light of all groups at `[point][step]` in lx: of sky and sun with blinds as they are operated, and of the sun alone through open ones.
pub(super) fn light(groups: &[Prepared], columns: &Columns, threads: usize) -> (Vec<f32>, Option<Vec<f32>>) {
    let steps = columns.suns.len();
    let (mut total, mut direct): (Vec<f32>, Option<Vec<f32>>) = (Vec::new(), None);
    for group in groups {
        let mut light = match &group.sun {
            Some(sun) => sum(group.open.times(&columns.sky, threads), &sun.light(columns, threads)),
            None => group.open.times(&columns.all, threads),
        };
        let of_sun = group.direct.as_ref().map(|direct| direct.light(columns, threads));
        if let (Some(blinds), Some(of_sun)) = (&group.blinds, &of_sun) {
            close(&mut light, blinds, &closed(of_sun, steps), columns, threads);
        }
        total = if total.is_empty() { light } else { sum(total, &light) };
        direct = match (direct, of_sun) {
            (Some(others), Some(of_sun)) => Some(sum(others, &of_sun)),
            (others, of_sun) => others.or(of_sun),
        };
    }
    (total, direct.filter(|_| groups.iter().all(|group| group.direct.is_some())))
}

fn sum(mut to: Vec<f32>, other: &[f32]) -> Vec<f32> {
    to.iter_mut().zip(other).for_each(|(value, other)| *value += other);
    to
}

/// In which steps a group's blinds are closed.
fn closed(direct: &[f32], steps: usize) -> Vec<bool> {
    let mut bright = vec![0_usize; steps];
    for row in direct.chunks_exact(steps) {
        bright.iter_mut().zip(row).for_each(|(count, value)| *count += usize::from(*value >= TOO_BRIGHT));
    }
    let points = direct.len() / steps;
    bright.into_iter().map(|count| count as f64 > TOO_MANY * points as f64).collect()
}

/// Takes what closed blinds leave in the steps in which they are closed.
fn close(light: &mut [f32], blinds: &Closed, closed: &[bool], columns: &Columns, threads: usize) {
    if !closed.contains(&true) {
        return;
    }
    let dimmed = match blinds {
        Closed::Share(share) => light.iter().map(|value| value * share).collect(),
        Closed::Panels(panels) => panels.times(&columns.all, threads),
    };
    let steps = closed.iter().cycle();
    light.iter_mut().zip(dimmed).zip(steps).filter(|(_, closed)| **closed).for_each(|((value, dimmed), _)| *value = dimmed);
}
