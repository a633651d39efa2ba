//! Building the light table: from light records to rows.

use super::beam::{fill_shaping, fill_spot, fill_spread};
use super::light_kind::LightKind;
use super::projected_area::{Outline, ProjectedArea};
use super::record::LightRecord;
use super::row::{ROW, field, flag};
use super::vector::{Vector, add, cross, determinant, dot, inverse_rows, length, narrow, scale, unit_or, widen};
use std::f64::consts::TAU;

/// Half angles below this cannot be told from a point in single precision directions.
const SMALLEST_HALF_ANGLE: f64 = 2e-5;

/// The shape's geometry in double precision.
pub(super) struct Geometry {
    axes: [Vector; 3],
    /// Axes that the beam refers to.
    aim: [Vector; 3],
    origin: Vector,
    /// Columns of the sampling frame, when it has an inverse.
    frame: [Vector; 3],
    inverse: Option<[Vector; 3]>,
    half: [f64; 2],
    normal: Vector,
    area: f64,
    centre: Vector,
    radius: f64,
}

/// The side that a flat light emits to: the plane's normal nearer to −z.
fn flat_normal(axes: [Vector; 3]) -> Vector {
    let n = unit_or(cross(axes[0], axes[1]), [0.0; 3]);
    if dot(n, axes[2]) > 0.0 || axes[2] == [0.0; 3] { scale(n, -1.0) } else { n }
}

/// The frame in which the emitter takes its simplest form, and what [`field::HALF`] keeps.
fn sampling_frame(kind: LightKind, axes: [Vector; 3], normal: Vector) -> ([Vector; 3], [f64; 2]) {
    let [x, y, z] = axes;
    match kind {
        LightKind::Rectangle => {
            let half = [length(x), length(y)];
            ([unit_or(x, [0.0; 3]), unit_or(y, [0.0; 3]), normal], half)
        }
        LightKind::Disk => ([x, y, scale(normal, length(cross(x, y)).sqrt())], [0.0; 2]),
        LightKind::Sphere => (axes, [0.0; 2]),
        LightKind::Cylinder => (axes, [length(x), 0.0]),
        LightKind::Triangle => ([x, y, normal], [0.0; 2]),
        LightKind::Distant | LightKind::Dome | LightKind::Point | LightKind::FacingDisk => {
            // Directions alone: orthonormal, and a mirrored light stays mirrored.
            let up = unit_or(y, [0.0, 1.0, 0.0]);
            let front = unit_or(add(z, scale(up, -dot(z, up))), [0.0, 0.0, 1.0]);
            let side = unit_or(cross(up, front), [1.0, 0.0, 0.0]);
            (
                [if dot(side, x) < 0.0 { scale(side, -1.0) } else { side }, up, front],
                if kind == LightKind::FacingDisk { [length(x), 1.0 / (TAU * dot(x, x))] } else { [0.0; 2] },
            )
        }
    }
}

/// A sphere that holds the shape.
fn bound(kind: LightKind, axes: [Vector; 3], origin: Vector) -> (Vector, f64) {
    let [x, y, z] = axes;
    let square = |v: Vector| dot(v, v);
    match kind {
        LightKind::Rectangle => (origin, length(add(x, y)).max(length(add(x, scale(y, -1.0))))),
        LightKind::Disk => (origin, (square(x) + square(y)).sqrt().min(length(x) + length(y))),
        LightKind::Sphere => {
            let largest = square(x).max(square(y)).max(square(z));
            let skew = dot(x, y).abs() + dot(y, z).abs() + dot(z, x).abs();
            // Gershgorin's bound of the largest eigenvalue of the axes' Gram matrix.
            (origin, (largest + skew).sqrt())
        }
        LightKind::Cylinder => (origin, length(x) + (square(y) + square(z)).sqrt()),
        LightKind::Triangle => {
            let centre = add(origin, scale(add(x, y), 1.0 / 3.0));
            let reach = [[0.0; 3], x, y].map(|corner| length(add(add(origin, corner), scale(centre, -1.0))));
            (centre, reach.into_iter().fold(0.0, f64::max))
        }
        LightKind::FacingDisk => (origin, length(x)),
        LightKind::Distant | LightKind::Dome | LightKind::Point => (origin, 0.0),
    }
}

/// Emitting area in the units of the axes, squared.
fn area(kind: LightKind, axes: [Vector; 3]) -> f64 {
    match kind {
        LightKind::Distant | LightKind::Dome | LightKind::Point => 0.0,
        _ => super::size::size_factor(kind, axes, 0.0),
    }
}

impl Geometry {
    pub(super) fn new(record: &LightRecord) -> Self {
        let kind = record.kind;
        let columns = record.to_world.map(widen);
        let (axes, origin) = ([columns[0], columns[1], columns[2]], columns[3]);
        let normal = if kind == LightKind::Triangle { unit_or(cross(axes[0], axes[1]), [0.0; 3]) } else { flat_normal(axes) };
        let (frame, half) = sampling_frame(kind, axes, normal);
        let (centre, radius) = bound(kind, axes, origin);
        let inverse = inverse_rows(frame).filter(|_| columns.iter().flatten().all(|x| x.is_finite()));
        let aim = record.opening.map_or(axes, |opening| opening.axes.map(widen));
        Self { axes, aim, origin, frame, inverse, half, normal, area: area(kind, axes), centre, radius }
    }
    /// What the emitter shows of itself by direction; none where it has no area.
    pub(super) fn projected_area(&self, kind: LightKind) -> Option<ProjectedArea> {
        ProjectedArea::of_emitter(kind, self.axes, self.normal, self.area)
    }
    fn fill(&self, row: &mut [f32]) {
        let mut put = |at: usize, v: Vector| row[at..at + 3].copy_from_slice(&narrow(v));
        put(field::ORIGIN, self.origin);
        put(field::BOUND_CENTRE, self.centre);
        put(field::NORMAL, self.normal);
        let axis = unit_or(scale(self.aim[2], -1.0), unit_or(self.normal, [0.0, 0.0, -1.0]));
        put(field::AXIS, axis);
        let level = |v: Vector| add(v, scale(axis, -dot(v, axis)));
        let x = unit_or(level(self.aim[0]), unit_or(level([1.0, 0.0, 0.0]), [0.0, 1.0, 0.0]));
        // A mirrored luminaire stays mirrored.
        let y = cross(x, axis);
        let side = if dot(y, self.aim[1]) < 0.0 { -1.0 } else { 1.0 };
        put(field::LEVEL_X, x);
        put(field::LEVEL_Y, scale(y, side));
        for k in 0..3 {
            put(field::FRAME + 3 * k, self.frame[k]);
            put(field::INVERSE + 3 * k, self.inverse.map_or([0.0; 3], |rows| rows[k]));
        }
        row[field::DENSITY] = (1.0 / determinant(self.frame).abs()) as f32;
        row[field::HALF] = self.half[0] as f32;
        row[field::HALF + 1] = self.half[1] as f32;
        row[field::BOUND_RADIUS] = self.radius as f32;
    }
}

/// Luminance by Rec.709's weights, of magnitudes.
pub(crate) fn luminance(c: [f32; 3]) -> f64 {
    gonio_image::colour::luminance(c.map(|x| f64::from(x).abs()))
}

/// Fills in a distant light's cone: its radiance, its illuminance and whether it is parallel.
fn fill_distant(angle: f32, radiance: [f32; 3], row: &mut [f32]) -> ([f32; 3], f64, bool) {
    let half = (f64::from(angle) / 2.0).clamp(0.0, std::f64::consts::PI);
    let solid = std::f64::consts::PI * half.sin().powi(2);
    if half < SMALLEST_HALF_ANGLE {
        // An angle of exactly 0 gives the illuminance itself.
        let illuminance = if half > 0.0 { radiance.map(|x| (f64::from(x) * solid) as f32) } else { radiance };
        return (illuminance, luminance(illuminance), true);
    }
    row[field::ONE_MINUS_COSINE] = (2.0 * (half / 2.0).sin().powi(2)) as f32;
    row[field::SINE] = if half < std::f64::consts::FRAC_PI_2 { half.sin() as f32 } else { 1.0 };
    let facing = if half < std::f64::consts::FRAC_PI_2 { solid } else { std::f64::consts::PI };
    (radiance, luminance(radiance) * facing, false)
}

/// One light's row. `factor` is what a texture makes of its luminance in the mean and a goniogram at most, 1 without them.
pub(crate) fn fill_row(record: &LightRecord, factor: f64, row: &mut [f32]) {
    debug_assert_eq!(row.len(), ROW);
    let geometry = Geometry::new(record);
    geometry.fill(row);
    let mut radiance = record.radiance.map(|x| if x.is_finite() { x } else { 0.0 });
    let mut bits = record.kind as u32;
    let shaped = fill_shaping(&record.shaping, row) && !record.kind.is_infinite();
    let flat = record.kind.is_flat();
    let spot = fill_spot(record, geometry.aim, row) && !record.kind.is_infinite();
    let spread = fill_spread(record, geometry.axes, row);
    let emitting = if record.area > 0.0 { f64::from(record.area) } else { geometry.area };
    let bright = luminance(radiance) * factor;
    let (strength, delta) = match record.kind {
        _ if record.opening.is_some() => (bright * record.opening.map_or(1.0, |part| f64::from(part.share)), false),
        LightKind::Rectangle | LightKind::Disk | LightKind::Triangle | LightKind::FacingDisk => (bright * emitting, false),
        // A convex body shows a quarter of its surface on average (Cauchy).
        LightKind::Sphere | LightKind::Cylinder => (bright * emitting / 4.0, false),
        LightKind::Point => (bright, true),
        LightKind::Dome => (bright * std::f64::consts::PI, false),
        LightKind::Distant => {
            let (scaled, illuminance, parallel) = fill_distant(record.angle, radiance, row);
            radiance = scaled;
            (illuminance, parallel)
        }
    };
    let lit =
        !record.portal && geometry.inverse.is_some() && strength > 0.0 && (strength as f32).is_finite() && row[field::DENSITY].is_finite();
    for (set, bit) in [
        (record.visible_to_camera, flag::VISIBLE),
        (record.casts_shadow, flag::CASTS_SHADOW),
        (record.two_sided && flat, flag::TWO_SIDED),
        (shaped || spot || spread, flag::SHAPED),
        (spot, flag::SPOT),
        (spread, flag::SPREAD),
        (delta, flag::DELTA),
        (record.kind.is_infinite(), flag::INFINITE),
        (flat, flag::FLAT),
        (record.opening.is_some(), flag::OPENING),
        (record.opening.is_some_and(|part| part.area.outline != Outline::Faces), flag::ROUND),
        (record.opening.is_some_and(|part| part.area.outline == Outline::Ellipsoid), flag::ALL_ROUND),
        (lit, flag::LIT),
        (record.sampled_alone, flag::ALONE),
        (record.shaded, flag::SHADED),
    ] {
        bits |= if set { bit } else { 0 };
    }
    if let Some(part) = &record.opening {
        part.area.fill(row);
    }
    row[field::FLAGS] = f32::from_bits(bits);
    row[field::STRENGTH] = if lit && record.visible_to_scattered { strength as f32 } else { 0.0 };
    row[field::RADIANCE..field::RADIANCE + 3].copy_from_slice(&if lit { radiance } else { [0.0; 3] });
}
