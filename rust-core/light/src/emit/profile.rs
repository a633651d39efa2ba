//! What lights send by direction, in cells about their poles: the tables that rays are drawn from, and the powers.

use super::beams::{Beams, Placed};
use super::body::Body;
use super::row::Model;
use crate::goniogram::{AngularType, Goniogram};
use crate::light_kind::LightKind;
use crate::row::{field, flag};
use std::collections::BTreeMap;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// No band is wider, in radians.
const WIDEST: f64 = 0.05;
/// Bands between two edges of a beam, at least.
const FEWEST: f64 = 6.0;
/// With more edges than this, as measured beams have them, one band is enough.
const MANY_EDGES: usize = 24;
/// Columns around the pole of what is not the same all around.
const COLUMNS: usize = 64;
/// So many looks are tabulated finely; of more, as the triangles of a mesh with a beam may have, each by fewer columns and one point a cell.
const MOST_FINE: usize = 64;
const COARSE_COLUMNS: usize = 8;
/// Parts of a focus' beam that are cut apart: the cosine's power falls by √½ over each.
const FOCUS_STEPS: u32 = 24;

/// How lights of one look send.
#[derive(Clone, Copy, Debug)]
pub(super) struct Profile {
    pub(super) model: Model,
    pub(super) placed: Placed,
    /// Integral over the sphere of what is sent, by component, per radiance and unit.
    pub(super) integral: [f64; 3],
}

/// Profiles found so far.
#[derive(Default)]
pub(super) struct Profiles {
    known: BTreeMap<Vec<u32>, Profile>,
    pub(super) beams: Beams,
}

impl Profiles {
    pub(super) fn of(&mut self, body: &Body<'_>, goniogram: Option<&Goniogram>) -> Profile {
        if let Some(plain) = plain(body) {
            return plain;
        }
        let key = body.key();
        if let Some(known) = self.known.get(&key) {
            return *known;
        }
        let heights = heights(body, goniogram);
        let fine = self.known.len() < MOST_FINE;
        let columns = match (body.is_round(), fine) {
            (true, _) => 1,
            (false, true) => COLUMNS,
            (false, false) => COARSE_COLUMNS,
        };
        let (cells, integral) = cells(body, &heights, columns, fine);
        let placed = if integral.iter().any(|x| *x > 0.0) { self.beams.insert(&heights, &cells) } else { Placed::default() };
        let found = Profile { model: Model::Table, placed, integral };
        self.known.insert(key, found);
        found
    }
}

/// What needs no table.
fn plain(body: &Body<'_>) -> Option<Profile> {
    if body.has_beam() {
        return None;
    }
    let (model, whole) = match body.kind {
        LightKind::Rectangle | LightKind::Disk | LightKind::Triangle if body.is(flag::TWO_SIDED) => (Model::BothSides, TAU),
        LightKind::Rectangle | LightKind::Disk | LightKind::Triangle => (Model::Cosine, PI),
        LightKind::Sphere if body.is_ball() => (Model::Even, 4.0 * PI * body.shown([0.0, 0.0, 1.0]) / body.unit()),
        LightKind::FacingDisk | LightKind::Point => (Model::Even, 4.0 * PI),
        _ => return None,
    };
    Some(Profile { model, placed: Placed::default(), integral: [whole; 3] })
}

/// Angles to the pole where a beam begins, ends or bends.
fn edges(body: &Body<'_>, goniogram: Option<&Goniogram>) -> Vec<f64> {
    let value = |at: usize| f64::from(body.row[at]);
    let mut edges = vec![0.0, FRAC_PI_2, PI];
    edges.extend([field::CUTOFF, field::SMOOTH_START].map(value));
    if body.is(flag::SPOT) {
        let cosine = value(field::SPOT_COSINE);
        let inner = (cosine + 1.0 / value(field::SPOT_STEEPNESS)).min(1.0);
        edges.extend([cosine.acos(), inner.acos()]);
        let stretches = [field::SPOT_X, field::SPOT_Y].map(|at| 1.0 / (0..3).map(|k| value(at + k).powi(2)).sum::<f64>().sqrt());
        edges.extend(stretches.into_iter().filter(|_| cosine > 0.0).map(|stretch| (cosine.acos().tan() * stretch).atan()));
    }
    edges.extend(Some(value(field::SPREAD_TANGENT).atan()).filter(|_| body.is(flag::SPREAD)));
    let focus = value(field::FOCUS);
    let steps = (1..=FOCUS_STEPS).filter(|_| focus > 0.0).map(|k| 0.5_f64.powf(0.5 * f64::from(k) / focus).acos());
    // The power is that of the cosine's size: behind as before.
    edges.extend(steps.flat_map(|angle| [angle, PI - angle]));
    if let Some(goniogram) = goniogram {
        let [horizontal, vertical] = goniogram.angles();
        edges.extend(vertical.iter().map(|angle| f64::from(angle.abs())));
        let polar = goniogram.angular_type() == AngularType::C;
        edges.extend(horizontal.iter().filter(|_| !polar).map(|angle| f64::from(angle.abs())));
    }
    edges.retain(|edge| (0.0..=PI).contains(edge));
    edges.sort_by(f64::total_cmp);
    edges.dedup_by(|a, b| (*a - *b).abs() < 1e-5);
    edges
}

/// Ends of the bands, as squared sines of half the angle to the pole.
fn heights(body: &Body<'_>, goniogram: Option<&Goniogram>) -> Vec<f64> {
    let edges = edges(body, goniogram);
    let fewest = if edges.len() < MANY_EDGES { FEWEST } else { 1.0 };
    let mut heights = Vec::new();
    for pair in edges.windows(2) {
        let count = ((pair[1] - pair[0]) / WIDEST).ceil().max(fewest);
        heights.extend((0..count as usize).map(|k| (0.5 * (pair[0] + (pair[1] - pair[0]) * k as f64 / count)).sin().powi(2)));
    }
    heights.push(1.0);
    // Bands that single precision cannot tell apart are one.
    heights.dedup_by(|a, b| *a as f32 <= *b as f32);
    if let Some(last) = heights.last_mut() {
        *last = 1.0;
    }
    heights
}

/// The unit direction about the pole at a height and a turn.
fn direction(t: f64, turn: f64) -> [f64; 3] {
    let sine = 2.0 * (t * (1.0 - t)).max(0.0).sqrt();
    let (sine_turn, cosine_turn) = (TAU * turn).sin_cos();
    [sine * cosine_turn, sine * sine_turn, 1.0 - 2.0 * t]
}

/// Mean luminance sent from each cell, and the integral by component: two-point Gauss quadrature both ways where it is to be fine.
fn cells(body: &Body<'_>, heights: &[f64], columns: usize, fine: bool) -> (Vec<f64>, [f64; 3]) {
    let off = 0.5 / 3.0_f64.sqrt();
    let (one, two) = ([0.5], [0.5 - off, 0.5 + off]);
    let points: &[f64] = if fine { &two } else { &one };
    let around: &[f64] = if columns == 1 { &one } else { points };
    let (mut cells, mut integral) = (Vec::new(), [0.0; 3]);
    for pair in heights.windows(2) {
        let height = pair[1] - pair[0];
        for column in 0..columns {
            let mut mean = [0.0; 3];
            for up in points {
                for across in around {
                    let local = direction(pair[0] + height * up, (column as f64 + across) / columns as f64);
                    let sent = body.sent(body.world(local));
                    (0..3).for_each(|k| mean[k] += sent[k] / (points.len() * around.len()) as f64);
                }
            }
            (0..3).for_each(|k| integral[k] += mean[k] * 4.0 * PI * height / columns as f64);
            cells.push(gonio_image::colour::luminance(mean.map(f64::abs)));
        }
    }
    (cells, integral)
}
