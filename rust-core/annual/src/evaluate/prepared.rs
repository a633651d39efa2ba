//! What light groups of windows let in, and when their blinds are closed.

use super::{
    blinds::{ClosedLight, GroupLight, operated},
    columns::Columns,
};
use crate::{
    Coefficients, Schedule,
    group::{Blinds, Group},
    product::Panels,
};

/// A group's matrices as products take them.
pub(super) struct Prepared {
    open: Panels,
    direct: Option<Direct>,
    sun: Option<Direct>,
    scattered: Option<Panels>,
    blinds: Option<Closed>,
    closed: Option<Schedule>,
}

enum Direct {
    Patches(Panels),
    /// `[point][sun]`.
    Suns(Vec<f32>, usize),
}

enum Closed {
    Share(f32),
    Panels(Panels),
    Traced { all: Panels, scattered: Panels, suns: Direct },
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
            scattered: group.scattered.as_ref().map(panels),
            blinds: group.blinds.as_ref().map(|blinds| match blinds {
                Blinds::Share(share) => Closed::Share(*share),
                Blinds::Coefficients(closed) => Closed::Panels(panels(closed)),
                Blinds::Traced { all, scattered, suns } => {
                    Closed::Traced { all: panels(all), scattered: panels(scattered), suns: Direct::Suns(mean(suns, without), suns.columns) }
                }
            }),
            closed: group.closed.clone(),
        };
        groups.iter().map(prepare).collect()
    }
}

/// Matrices of a single block stay whole.
fn mean(of: &Coefficients, without: Option<usize>) -> Vec<f32> {
    of.mean(without.filter(|_| of.blocks.len() > 1))
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

/// Light of all groups at `[point][step]` in lx.
pub(super) struct Light {
    /// Of sky and sun with blinds as they are operated.
    pub(super) total: Vec<f32>,
    /// Of the sun alone through open ones.
    pub(super) direct: Option<Vec<f32>>,
    /// Of the sun alone with blinds as they are operated.
    pub(super) sun: Option<Vec<f32>>,
    /// By group, in which steps its blinds are closed; empty where they never are.
    pub(super) closed: Vec<Vec<bool>>,
}

/// The light of all groups.
pub(super) fn light(groups: &[Prepared], columns: &Columns, threads: usize) -> Light {
    let steps = columns.suns.len();
    let open: Vec<GroupLight> = groups.iter().map(|group| group.open_light(columns, threads)).collect();
    let operated = operated(&open, steps, |group| groups[group].closed_light(&open[group], columns, threads));
    let knows_sun = open.iter().all(|group| group.direct.is_some());
    let [mut totals, mut directs, mut suns]: [Vec<Vec<f32>>; 3] = Default::default();
    let mut closed = Vec::with_capacity(groups.len());
    for (GroupLight { open: mut light, direct, .. }, operated) in open.into_iter().zip(operated) {
        let mut sun = direct.clone();
        closed.push(operated.map_or_else(Vec::new, |operated| {
            close(&mut light, &operated.light.all, &operated.steps);
            sun = sun.take().zip(operated.light.sun).map(|(mut sun, closed)| {
                close(&mut sun, &closed, &operated.steps);
                sun
            });
            operated.steps
        }));
        totals.push(light);
        directs.extend(direct);
        suns.extend(sun);
    }
    let knows_seen_sun = suns.len() == groups.len();
    let all = |parts: Vec<Vec<f32>>| parts.into_iter().reduce(|to, other| sum(to, &other));
    Light {
        total: all(totals).unwrap_or_default(),
        direct: all(directs).filter(|_| knows_sun),
        sun: all(suns).filter(|_| knows_seen_sun),
        closed,
    }
}

impl Prepared {
    /// Its light with blinds open.
    fn open_light(&self, columns: &Columns, threads: usize) -> GroupLight {
        let of_sun = self.direct.as_ref().map(|direct| direct.light(columns, threads));
        let open = match (&self.sun, &self.scattered, &of_sun) {
            (Some(sun), ..) => sum(self.open.times(&columns.sky, threads), &sun.light(columns, threads)),
            (None, Some(scattered), Some(of_sun)) => with_sun_at_its_place([&self.open, scattered], of_sun, columns, threads),
            _ => self.open.times(&columns.all, threads),
        };
        let closed = self.closed.as_ref().map(|closed| columns.steps.iter().map(|step| closed.is_used(*step)).collect());
        GroupLight { open, direct: of_sun, has_blinds: self.blinds.is_some(), closed }
    }

    /// Its light with blinds closed, of which `open` is that with open ones.
    fn closed_light(&self, open: &GroupLight, columns: &Columns, threads: usize) -> ClosedLight {
        let dimmed = |light: &[f32], share: f32| light.iter().map(|value| value * share).collect::<Vec<_>>();
        match &self.blinds {
            Some(Closed::Share(share)) => {
                ClosedLight { all: dimmed(&open.open, *share), sun: open.direct.as_deref().map(|direct| dimmed(direct, *share)) }
            }
            Some(Closed::Panels(panels)) => ClosedLight { all: panels.times(&columns.all, threads), sun: None },
            Some(Closed::Traced { all, scattered, suns }) => {
                let sun = suns.light(columns, threads);
                ClosedLight { all: with_sun_at_its_place([all, scattered], &sun, columns, threads), sun: Some(sun) }
            }
            None => ClosedLight { all: open.open.clone(), sun: open.direct.clone() },
        }
    }
}

/// Light of the sky, of the sun by what it lights, and of the sun itself.
fn with_sun_at_its_place([all, scattered]: [&Panels; 2], of_sun: &[f32], columns: &Columns, threads: usize) -> Vec<f32> {
    sum(sum(all.times(&columns.sky, threads), &scattered.times(&columns.alone, threads)), of_sun)
}

fn sum(mut to: Vec<f32>, other: &[f32]) -> Vec<f32> {
    to.iter_mut().zip(other).for_each(|(value, other)| *value += other);
    to
}

/// Takes what closed blinds leave in the steps in which they are closed.
fn close(light: &mut [f32], closed: &[f32], steps: &[bool]) {
    let steps = steps.iter().cycle();
    light.iter_mut().zip(closed).zip(steps).filter(|(_, closed)| **closed).for_each(|((value, dimmed), _)| *value = *dimmed);
}
