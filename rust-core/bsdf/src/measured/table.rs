//! Tables over angles: what the reference [`gonio_formats::bsdf::Table`] gives, on lanes.

use super::angles::{azimuth, elevation, sine, unturned};
use core::f32::consts::FRAC_PI_2;
use gonio_formats::bsdf::{Axis as Knots, Coordinates, Mode, Table};
use gonio_simd::{F, Lanes, Rgb, Vec3};
use gonio_table::{Axis, Colours};

/// A table of BSDF values in linear Rec.709, 1/sr, without the cosine.
#[derive(Clone, Debug)]
pub(super) struct BsdfTable {
    coordinates: Coordinates,
    bilateral: bool,
    reciprocal: bool,
    cells: Cells,
}

#[derive(Clone, Debug)]
enum Cells {
    /// Isotropic and half/difference coordinates.
    Three(Box<Colours<3>>),
    /// Anisotropic and specular ones.
    Four(Box<Colours<4>>),
}

impl BsdfTable {
    /// The table with its channels as colours. `None` where its angles are too near each other for single precision, or it has 2³¹ values.
    pub(super) fn new(table: &Table) -> Option<Self> {
        let layout = table.layout();
        let weights: Vec<[f32; 3]> = layout.channels.rgb_weights().iter().map(|w| w.map(|x| x as f32)).collect();
        let colour = |cell: usize| {
            let values = &table.values()[cell * weights.len()..][..weights.len()];
            let sum = |c: usize| values.iter().zip(&weights).map(|(value, weight)| value * weight[c]).sum();
            (!values[0].is_nan()).then(|| [sum(0), sum(1), sum(2)])
        };
        let mut axes = Vec::with_capacity(layout.axes.len());
        for (number, knots) in layout.axes.iter().enumerate() {
            axes.push(axis(knots, is_azimuth(layout.coordinates, number))?);
        }
        let cells = if axes.len() == 3 {
            Cells::Three(Box::new(Colours::new(axes.try_into().ok()?, colour)?))
        } else {
            Cells::Four(Box::new(Colours::new(axes.try_into().ok()?, colour)?))
        };
        Some(Self { coordinates: layout.coordinates, bilateral: layout.bilateral, reciprocal: layout.reciprocal, cells })
    }

    /// The BSDF of two directions at the front.
    #[inline(always)]
    pub(super) fn value<L: Lanes>(&self, l: L, wi: Vec3<L>, wo: Vec3<L>) -> Rgb<L> {
        let (value, known) = self.look_up(l, wi, wo);
        if !self.reciprocal || !self.has_gaps() || known.gt(0.0).all() {
            return value;
        }
        // What was not measured one way may have been the other way.
        known.gt(0.0).select(value, self.look_up(l, wo, wi).0)
    }

    fn has_gaps(&self) -> bool {
        match &self.cells {
            Cells::Three(cells) => cells.has_gaps(),
            Cells::Four(cells) => cells.has_gaps(),
        }
    }

    #[inline(always)]
    fn look_up<L: Lanes>(&self, l: L, wi: Vec3<L>, wo: Vec3<L>) -> (Rgb<L>, F<L>) {
        match (&self.cells, self.coordinates) {
            (Cells::Three(cells), Coordinates::HalfDifference) => {
                let [theta_h, theta_d, phi_d] = half_difference(l, wi, wo);
                cells.value(l, [theta_h, theta_d, self.folded(phi_d)])
            }
            (Cells::Three(cells), _) => {
                let between = wi.x.mul_add(wo.y, -(wi.y * wo.x)).atan2(wi.x.mul_add(wo.x, wi.y * wo.y));
                cells.value(l, [elevation(wi), elevation(wo), self.folded(between)])
            }
            (Cells::Four(cells), Coordinates::Specular) => {
                let [about, radial] = about_specular(wi, wo);
                cells.value(l, [wi.y.atan2(wi.x) + FRAC_PI_2, elevation(wi), self.folded(about), radial])
            }
            (Cells::Four(cells), _) => {
                let mut y = [wi.y, wo.y];
                if self.bilateral {
                    let mirror = wi.y.lt(0.0);
                    y = [mirror.select(-wi.y, wi.y), mirror.select(-wo.y, wo.y)];
                }
                cells.value(l, [elevation(wi), y[0].atan2(wi.x), elevation(wo), y[1].atan2(wo.x)])
            }
        }
    }

    /// Of a material with a plane of symmetry only half of the angles is asked for.
    #[inline(always)]
    fn folded<L: Lanes>(&self, angle: F<L>) -> F<L> {
        if self.bilateral { angle.abs() } else { angle }
    }
}

/// Which axes are angles about something.
fn is_azimuth(coordinates: Coordinates, axis: usize) -> bool {
    match coordinates {
        Coordinates::Isotropic | Coordinates::HalfDifference => axis == 2,
        Coordinates::Anisotropic => axis == 1 || axis == 3,
        Coordinates::Specular => axis == 0 || axis == 2,
    }
}

fn axis(knots: &Knots, is_azimuth: bool) -> Option<Axis> {
    let narrow: Vec<f32> = knots.knots().iter().map(|knot| *knot as f32).collect();
    let axis = match knots.mode() {
        Mode::Periodic { period } => return Axis::periodic(narrow, period as f32),
        Mode::Linear => Axis::new(narrow)?,
        Mode::Nearest => Axis::new(narrow)?.nearest(),
    };
    Some(if is_azimuth { axis.turning() } else { axis })
}

/// θh, θd, φd of half vector and difference vector (Rusinkiewicz 1998).
#[inline(always)]
fn half_difference<L: Lanes>(l: L, wi: Vec3<L>, wo: Vec3<L>) -> [F<L>; 3] {
    let half = (wi + wo).normalize_or(Vec3::splat(l, [0.0, 0.0, 1.0]));
    let level = unturned(wi, azimuth(half));
    let x = half.z.mul_add(level.x, -(sine(half) * level.z));
    let y = level.y;
    [elevation(half), x.mul_add(x, y * y).sqrt().atan2(half.dot(wi)), y.atan2(x)]
}

/// Azimuth and radial angle of `wo` about the specular direction of `wi`; azimuth 0 points to the normal.
#[inline(always)]
fn about_specular<L: Lanes>(wi: Vec3<L>, wo: Vec3<L>) -> [F<L>; 2] {
    let specular = Vec3::new(-wi.x, -wi.y, wi.z);
    let [cos, sin] = azimuth(wi);
    let toward = Vec3::new(wi.z * cos, wi.z * sin, sine(wi));
    let (x, y) = (toward.dot(wo), specular.cross(toward).dot(wo));
    [y.atan2(x), x.mul_add(x, y * y).sqrt().atan2(specular.dot(wo))]
}
