//! A light as it looks from far away: its intensity by direction, and what that sums up to.

use super::beam::SMALLEST_SPREAD;
use super::build::Geometry;
use super::goniogram::{AngularType, Goniogram};
use super::light_kind::LightKind;
use super::projected_area::ProjectedArea;
use super::record::{LightRecord, LightTexture};
use super::row::field;
use super::table::LightTable;
use super::vector::{dot, widen};
use gonio_simd::{Lanes, One, Vec3};
use std::f64::consts::{FRAC_PI_2, PI, TAU};
use std::sync::Arc;

/// Greatest steps in radians along the two angles where the intensity is the goniogram's alone, which is linear in both between its lines.
const PLAIN: [f64; 2] = [0.09, 0.09];
/// The same where an emitter's own shape or a beam's edge comes in.
const SHAPED: [f64; 2] = [0.09, 0.009];

/// What a light with a place, made of one record or of several, sends in all.
#[derive(Debug)]
pub struct FarField {
    table: LightTable,
    /// What each emitter shows of itself; none of points.
    areas: Vec<Option<ProjectedArea>>,
    /// Columns of the frame that the beam refers to.
    frame: [[f64; 3]; 3],
    breaks: [Vec<f64>; 2],
    angular_type: AngularType,
    most: [f64; 2],
}

impl FarField {
    /// Of the records that make one light; images over it are left out.
    pub fn new(records: &[LightRecord], goniograms: &[Arc<Goniogram>]) -> Self {
        let plain: Vec<LightRecord> = records.iter().map(|record| LightRecord { texture: None, ..*record }).collect();
        let table = LightTable::build(&plain, &[] as &[LightTexture], goniograms);
        let areas = plain.iter().map(|record| Geometry::new(record).projected_area(record.kind)).collect();
        let vector = |at: usize| std::array::from_fn(|k| table.rows.get(at + k).copied().map_or(0.0, f64::from));
        let axis: [f64; 3] = vector(field::AXIS);
        let frame = [vector(field::LEVEL_X), vector(field::LEVEL_Y), axis.map(|x| -x)];
        let goniogram = records.first().and_then(|record| record.goniogram).and_then(|number| goniograms.get(number as usize));
        let is_plain = records.iter().all(is_measured_alone);
        let breaks = match goniogram {
            Some(goniogram) => goniogram.angles().map(|angles| angles.iter().copied().map(f64::from).collect()),
            None => [vec![0.0, TAU], beam_edges(records.first())],
        };
        let angular_type = goniogram.map_or(AngularType::C, |goniogram| goniogram.angular_type());
        let [across, down] = if is_plain { PLAIN } else { SHAPED };
        // What looks the same all around is looked at from one side.
        let across = if goniogram.is_none() && records.iter().all(is_round) { TAU } else { across };
        Self { table, areas, frame, breaks, angular_type, most: [across, down] }
    }

    /// Luminous intensity in cd, and the greatest luminance of an emitter in cd/m² (0 for points), towards a direction in the luminaire's frame.
    pub fn towards(&self, direction: [f64; 3]) -> [f64; 2] {
        self.in_direction(std::array::from_fn(|k| (0..3).map(|axis| self.frame[axis][k] * direction[axis]).sum()))
    }

    /// The same towards a direction of length 1 in world space.
    pub fn in_direction(&self, world: [f64; 3]) -> [f64; 2] {
        let mut total = [0.0; 2];
        for (part, area) in self.areas.iter().enumerate() {
            let shown = area.map_or(1.0, |area| area.towards(world));
            if shown > 0.0 {
                let l = One;
                let light = self.table.reader(l, l.u(part as u32));
                let sent = self.table.le(l, &light, Vec3::splat(l, world.map(|x| -x as f32)), [l.f(0.0); 2]);
                let luminance = f64::from(sent.luminance().to_array()[0]);
                total[0] += luminance * shown;
                total[1] = f64::max(total[1], if area.is_some() { luminance } else { 0.0 });
            }
        }
        total
    }

    /// Luminous flux in lm: two-point Gauss quadrature between the tabulated angles.
    pub fn flux(&self) -> f64 {
        let [across, down] = [0, 1].map(|k| gauss(&self.breaks[k], self.most[k]));
        let mut sum = 0.0;
        for (horizontal, width) in &across {
            for (vertical, height) in &down {
                let solid_angle = self.angular_type.solid_angle(*horizontal, *vertical) * width * height;
                sum += self.towards(self.angular_type.direction(*horizontal, *vertical))[0] * solid_angle;
            }
        }
        sum
    }

    /// The greatest intensity in cd and the greatest luminance in cd/m² over the tabulated angles and points between.
    pub fn peaks(&self) -> [f64; 2] {
        let mut peaks = [0.0; 2];
        let [across, down] = [0, 1].map(|k| between(&self.breaks[k], 4.0 * self.most[k]));
        for horizontal in &across {
            for vertical in &down {
                let found = self.towards(self.angular_type.direction(*horizontal, *vertical));
                peaks = [0, 1].map(|k| f64::max(peaks[k], found[k]));
            }
        }
        peaks
    }
}

/// Whether nothing but a goniogram shapes the intensity.
fn is_measured_alone(record: &LightRecord) -> bool {
    let spreads_intensity = record.opening.is_some() || record.kind == LightKind::Point;
    spreads_intensity && record.goniogram.is_some() && record.spot.is_none() && record.shaping == super::Shaping::default()
}

/// Whether a light sends the same all around its beam's axis.
fn is_round(record: &LightRecord) -> bool {
    let is_shape = match record.kind {
        LightKind::Point | LightKind::FacingDisk => true,
        LightKind::Sphere => {
            let [x, y, z, _] = record.to_world.map(widen);
            let [xx, yy, zz] = [dot(x, x), dot(y, y), dot(z, z)];
            let skew = dot(x, y).abs() + dot(y, z).abs() + dot(z, x).abs();
            (xx - yy).abs() + (xx - zz).abs() + skew < 1e-5 * xx
        }
        _ => false,
    };
    is_shape && record.opening.is_none() && record.spot.is_none_or(|spot| spot.stretch[0] == spot.stretch[1])
}

/// Parts of a focus' beam that are summed apart: the cosine's power falls by √½ over each, to a 4096th in all.
const FOCUS_STEPS: u32 = 24;

/// Polar angles where a beam begins or ends, or where a focus takes a step.
fn beam_edges(record: Option<&LightRecord>) -> Vec<f64> {
    let mut edges = vec![0.0, FRAC_PI_2, PI];
    if let Some(record) = record {
        let shaping = &record.shaping;
        edges.extend([shaping.cone_angle, shaping.cone_angle * (1.0 - shaping.softness)].map(f64::from));
        edges.extend(record.spot.iter().map(|spot| f64::from(spot.angle) / 2.0));
        edges.extend((record.kind.is_flat() && record.spread < PI as f32).then(|| f64::from(record.spread.max(SMALLEST_SPREAD)) / 2.0));
        let focus = f64::from(shaping.focus);
        let steps = (1..=FOCUS_STEPS).filter(|_| focus > 0.0).map(|k| 0.5_f64.powf(0.5 * f64::from(k) / focus).acos());
        // The power is that of the cosine's size: behind as before.
        edges.extend(steps.flat_map(|angle| [angle, PI - angle]));
    }
    edges.retain(|edge| (0.0..=PI).contains(edge));
    edges.sort_by(f64::total_cmp);
    edges.dedup_by(|a, b| (*a - *b).abs() < 1e-6);
    edges
}

/// Equal steps between the breaks, none wider than `most`: their starts and widths.
fn steps(breaks: &[f64], most: f64) -> impl Iterator<Item = [f64; 2]> + '_ {
    breaks.windows(2).flat_map(move |pair| {
        let count = ((pair[1] - pair[0]) / most).ceil().clamp(1.0, 4096.0);
        let width = (pair[1] - pair[0]) / count;
        (0..count as usize).map(move |k| [pair[0] + width * k as f64, width])
    })
}

/// The breaks and points between them.
fn between(breaks: &[f64], most: f64) -> Vec<f64> {
    steps(breaks, most).map(|[start, _]| start).chain(breaks.last().copied()).collect()
}

/// Points and weights.
fn gauss(breaks: &[f64], most: f64) -> Vec<(f64, f64)> {
    let off = 0.5 / 3.0_f64.sqrt();
    steps(breaks, most).flat_map(|[start, width]| [0.5 - off, 0.5 + off].map(|t| (start + t * width, 0.5 * width))).collect()
}
