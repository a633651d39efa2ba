//! What an observer's eye sees of luminaires.

use super::{
    glare::{Coverage, is_below, weight},
    vector::{Vector, cross, dot, subtract, unit},
};
use crate::{
    accel::{Hits, NONE, RayBatch},
    compile::{CompiledScene, Luminaire},
    error::{Error, Result},
    light::{LightSample, LightSampleContext, LightTable},
    scene::Meter,
    transport::ray_mask,
};
use gonio_formats::photometry::NoIndex;
use gonio_simd::{Execution, Lanes, One, Vec3};

/// The position index at the end of CIE 117's table.
const LAST_INDEX: f64 = 16.0;
/// Square metres of luminous area below which a source counts as small (CIE 147).
const SMALL: f64 = 0.005;
/// Share of the way to a luminous part that must be free: the luminaire's own housing may begin there.
const FREE: f32 = 1.0 - 1e-4;
/// Panes before a luminaire that are looked through.
const MOST_PANES: usize = 16;
/// Parts along a side of an emitter of 1 sr, and the fewest and most along one of any solid angle.
const FINENESS: f64 = 60.0;
const PARTS: [f64; 2] = [3.0, 16.0];

/// An observer's eye.
#[derive(Clone, Copy, Debug)]
pub(super) struct Eye {
    position: Vector,
    /// Right, up and ahead; unit.
    axes: [Vector; 3],
}

/// What a luminaire adds to a rating.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Share {
    /// Σ L² ω / p², by CIE 147 where it is small.
    pub(super) sum: f64,
    /// The same by CIE 117's formula alone; none of a point, whose luminance is infinite.
    pub(super) tabular: Option<f64>,
    /// Whether it is rated as a small source.
    pub(super) is_small: bool,
}

/// A part of a luminaire as an eye sees it.
struct Part {
    /// Unit, from the eye, and the way in metres.
    direction: [f32; 3],
    distance: f32,
    /// L² ω; 0 of what is dark.
    strength: f64,
    /// At the eye across the part's way, lx.
    light: f64,
    /// Of the way to the line of sight; 0 of what is not ahead.
    cosine: f64,
    /// In sr; 0 of points.
    solid_angle: f64,
    /// 1 / p², or why the part has no position index.
    weight: Result<f64, NoIndex>,
}

impl Eye {
    /// A meter's `facing` is the line of sight, its `normal` tells where up is.
    pub(super) fn new(meter: &Meter) -> Result<Self> {
        let found = || {
            let ahead = unit(meter.facing)?;
            let right = unit(cross(ahead, unit(meter.normal)?))?;
            Some([right, cross(right, ahead), ahead])
        };
        let problem = "an observer wants a line of sight (facing) and a way up (normal) that is not along it";
        Ok(Self { position: meter.position, axes: found().ok_or_else(|| Error::scene(&meter.origin, problem))? })
    }

    /// Σ L² ω / p² over the parts of a luminaire that nothing opaque hides: L is the luminance towards the eye, p the position index. A luminaire of a
    /// maker's file counts or not by its centre (CIE 117); other lights, of any size, part by part. What has no index is left out, and
    /// counted. What shows less than 0.005 m² in all counts as having that area (CIE 147), so that points have a rating too; UGR tables know no such rule.
    pub(super) fn glare(&self, luminaire: &Luminaire, scene: &CompiledScene, coverage: &mut Coverage) -> Share {
        let place = subtract(self.position, scene.tables.origin).map(|x| x as f32);
        let mut parts: Vec<Part> = luminaire.emitters.iter().flat_map(|emitter| self.parts(emitter, place)).collect();
        let way = subtract(luminaire.centre, self.position);
        let solid_angle = |parts: &[Part]| parts.iter().map(|part| part.solid_angle).sum::<f64>();
        let middle = self.in_view(way);
        if is_below(middle, solid_angle(&parts)) {
            parts.iter_mut().filter(|part| part.weight != Err(NoIndex::Behind)).for_each(|part| part.weight = Err(NoIndex::Below));
        } else if luminaire.is_one {
            // Near a long one each part has an index of its own; beyond the table's end the last, and below the line of sight the centre's.
            let of_centre = weight(middle);
            let of_part = |found| match found {
                Err(NoIndex::High | NoIndex::Aside) => Ok(LAST_INDEX.powi(-2)),
                found => found.or(of_centre),
            };
            parts.iter_mut().for_each(|part| part.weight = of_centre.and(of_part(part.weight)));
        }
        let area = solid_angle(&parts) * dot(way, way);
        parts.retain(|part| part.strength > 0.0 && part.weight != Err(NoIndex::Behind));
        coverage.covered += usize::from(luminaire.casts_shadow && retain_seen(&mut parts, place, scene));
        let Some(brightest) = parts.iter().max_by(|a, b| a.light_left_out().total_cmp(&b.light_left_out())) else {
            return Share { tabular: Some(0.0), ..Share::default() };
        };
        coverage.count(brightest.weight.err(), solid_angle(&parts));
        parts.iter().for_each(|part| coverage.add_light(part.weight.err(), part.illuminance()));
        let seen: f64 = parts.iter().map(|part| part.strength * part.weight.unwrap_or(0.0)).sum();
        let small = if area > 0.0 { (area / SMALL).min(1.0) } else { 1.0 };
        Share { sum: seen * small, tabular: (area > 0.0 || seen == 0.0).then_some(seen), is_small: seen > 0.0 && area < SMALL }
    }

    /// What comes straight to it from a luminaire's parts that nothing opaque hides, whichever way it looks: unit directions, and lx across them. And
    /// whether it is seen through glass or a cover alone.
    pub(super) fn straight(&self, luminaire: &Luminaire, scene: &CompiledScene) -> (Vec<([f64; 3], f64)>, bool) {
        let place = subtract(self.position, scene.tables.origin).map(|x| x as f32);
        let mut parts: Vec<Part> = luminaire.emitters.iter().flat_map(|emitter| self.parts(emitter, place)).collect();
        parts.retain(|part| part.light > 0.0);
        let is_covered = luminaire.casts_shadow && retain_seen(&mut parts, place, scene);
        (parts.iter().map(|part| (part.direction.map(f64::from), part.light)).collect(), is_covered)
    }

    /// A direction to the right, up and ahead.
    fn in_view(&self, direction: Vector) -> Vector {
        self.axes.map(|axis| dot(axis, direction))
    }

    /// An emitter in parts of like solid angles.
    fn parts(&self, emitter: &LightTable, place: [f32; 3]) -> Vec<Part> {
        let middle = drawn(emitter, place, [0.5; 2]);
        if middle.delta.0 {
            return vec![self.part(&middle, 1.0)];
        }
        let density = f64::from(middle.pdf.0);
        let along = if density > 0.0 { (FINENESS / density.sqrt()).ceil().clamp(PARTS[0], PARTS[1]) } else { PARTS[0] };
        let at = |k: usize| ((k as f64 + 0.5) / along) as f32;
        let count = along as usize;
        (0..count * count).map(|k| self.part(&drawn(emitter, place, [at(k % count), at(k / count)]), along * along)).collect()
    }

    /// One of so many parts of an emitter.
    fn part(&self, sample: &LightSample<One>, count: f64) -> Part {
        let direction = [sample.wi.x.0, sample.wi.y.0, sample.wi.z.0];
        let [luminance, pdf, distance] = [sample.radiance.luminance().0, sample.pdf.0, sample.distance.0].map(f64::from);
        let in_view = self.in_view(direction.map(f64::from));
        let cosine = in_view[2].max(0.0);
        let dark =
            Part { direction, distance: sample.distance.0, strength: 0.0, light: 0.0, cosine, solid_angle: 0.0, weight: weight(in_view) };
        if pdf <= 0.0 {
            return dark;
        }
        if sample.delta.0 {
            // Its illuminance is I / r².
            return Part { strength: (luminance * distance).powi(2) / SMALL, light: luminance, ..dark };
        }
        let solid_angle = 1.0 / (pdf * count);
        let light = luminance * solid_angle;
        Part { strength: luminance * light, light, solid_angle, ..dark }
    }
}

impl Part {
    /// On the plane of the eye, lx.
    fn illuminance(&self) -> f64 {
        self.light * self.cosine
    }

    /// Its illuminance if it is left out.
    fn light_left_out(&self) -> f64 {
        if self.weight.is_err() { self.illuminance() } else { 0.0 }
    }
}

/// A direction from a place to a light that is alone in its table, for `u` in `[0, 1)`.
fn drawn(emitter: &LightTable, place: [f32; 3], u: [f32; 2]) -> LightSample<One> {
    // No side of the eye is dark.
    let eye = LightSampleContext { position: Vec3::splat(One, place), normal: Vec3::splat(One, [0.0; 3]), receiver: One.u(0) };
    emitter.sample_li(One, None, &eye, One.f(0.5), &u.map(|x| One.f(x)))
}

/// Drops the parts that something opaque hides; whether that is all of them, and what hides any first lets light through in its own way, as glass and
/// opal covers do.
fn retain_seen(parts: &mut Vec<Part>, place: [f32; 3], scene: &CompiledScene) -> bool {
    let ways: Vec<Way> = parts.iter().map(|part| Way { direction: part.direction, from: 0.0, to: part.distance * FREE }).collect();
    let mut blocked = vec![0; ways.len()];
    let mut passed = Vec::new();
    asked(&ways, place, |rays| scene.tables.bvh.any_hit_transparent(Execution::Scalar, rays, &mut blocked, &mut passed));
    let (materials, geometry) = (&scene.tables.materials, &scene.tables.geometry);
    // Of a mesh with a window in it the wall hides what is behind.
    for hit in passed.iter().filter(|hit| !materials.lets_light_pass(geometry.material(hit.instance, hit.primitive))) {
        blocked[hit.ray as usize] = 1;
    }
    let mut blocked = blocked.into_iter();
    parts.retain(|_| blocked.next() == Some(0));
    parts.is_empty() && is_covered(ways, place, scene)
}

/// Whether the first thing on any of the ways that shadow rays do not pass lets light through.
fn is_covered(mut ways: Vec<Way>, place: [f32; 3], scene: &CompiledScene) -> bool {
    let (materials, geometry) = (&scene.tables.materials, &scene.tables.geometry);
    for _ in 0..MOST_PANES {
        if ways.is_empty() {
            return false;
        }
        let mut hits = Hits::default();
        asked(&ways, place, |rays| scene.tables.bvh.first_hit_in_tree(Execution::Scalar, rays, false, &mut hits));
        let mut behind = Vec::new();
        for (ray, way) in ways.iter().enumerate().filter(|(ray, _)| hits.instance[*ray] != NONE) {
            let material = geometry.material(hits.instance[ray], hits.primitive[ray]);
            if !materials.lets_light_pass(material) {
                if materials.lets_light_through(material) {
                    return true;
                }
                continue;
            }
            behind.push(Way { from: (hits.t[ray] * (1.0 + 1e-6)).next_up(), ..*way });
        }
        ways = behind;
    }
    false
}

/// From the eye, between two distances.
#[derive(Clone, Copy)]
struct Way {
    direction: [f32; 3],
    from: f32,
    to: f32,
}

/// Asks the tree about ways that shadow rays take.
fn asked(ways: &[Way], place: [f32; 3], ask: impl FnOnce(&RayBatch<'_>)) {
    let count = ways.len();
    let origin = place.map(|x| vec![x; count]);
    let direction = [0, 1, 2].map(|k| ways.iter().map(|way| way.direction[k]).collect::<Vec<f32>>());
    let [t_min, t_max] = [|way: &Way| way.from, |way: &Way| way.to].map(|of| ways.iter().map(of).collect::<Vec<f32>>());
    ask(&RayBatch {
        origin: origin.each_ref().map(|x| &x[..]),
        direction: direction.each_ref().map(|x| &x[..]),
        t_min: &t_min,
        t_max: &t_max,
        mask: &vec![ray_mask::SHADOW; count],
        time: &[],
        passed: &[],
    });
}
