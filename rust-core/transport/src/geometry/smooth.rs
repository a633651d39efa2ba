//! Surface points on curves and points: what the two numbers of a hit say, on lanes. Their writer is `intersect/smooth.rs` of `gonio-accel`.

use super::{GeometryTable, HitLanes, SurfacePoint, surface_point::gamma};
use gonio_simd::{F, Frame, Lanes, M, U, Vec3};

/// What a geometry's primitives are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PrimitiveShape {
    /// Triangles.
    Triangle = 0,
    /// Pieces of round curves.
    Tube = 1,
    /// Pieces of ribbons that face each ray.
    Ribbon = 2,
    /// Spheres.
    Sphere = 3,
    /// Discs that face each ray.
    Disc = 4,
}

/// Bit of an entry of [`GeometryTable::pieces`]: it is the first piece of its curve.
pub const FIRST_PIECE: u32 = 1 << 31;
/// Bit of an entry of [`GeometryTable::pieces`]: it is the last piece of its curve.
pub const LAST_PIECE: u32 = 1 << 30;

/// The two numbers of a hit on curves or points, and what they are of.
#[derive(Clone, Copy, Debug)]
pub struct SmoothHit<L: Lanes> {
    /// A [`PrimitiveShape`].
    pub shape: U<L>,
    /// The entry in [`GeometryTable::pieces`]; of points the point.
    pub piece: U<L>,
    /// The two numbers.
    pub code: [F<L>; 2],
}

impl<L: Lanes> SmoothHit<L> {
    /// Hits on triangles alone.
    #[inline(always)]
    pub(super) fn none(l: L) -> Self {
        Self { shape: l.u(0), piece: l.u(0), code: [l.f(0.0); 2] }
    }

    #[inline(always)]
    fn is(&self, shape: PrimitiveShape) -> M<L> {
        self.shape.eq(shape as u32)
    }

    /// Whether hits are on curves.
    #[inline(always)]
    pub(super) fn is_curve(&self) -> M<L> {
        self.is(PrimitiveShape::Tube) | self.is(PrimitiveShape::Ribbon)
    }

    /// Whether hits are on curves or points.
    #[inline(always)]
    pub(crate) fn is_smooth(&self) -> M<L> {
        self.shape.ne(PrimitiveShape::Triangle as u32)
    }
}

/// A unit vector in a plane from a turn about it: see `turn` of the writer.
#[inline(always)]
fn around<L: Lanes>(turn: F<L>) -> [F<L>; 2] {
    let size = turn.abs();
    let x = 1.0 - size;
    let y = size.gt(1.0).select(2.0 - size, size).copysign(turn);
    let scale = (x * x + y * y).max(1e-12).inverse_root();
    [x * scale, y * scale]
}

/// The unit vector of octahedral coordinates.
#[inline(always)]
fn from_octahedral<L: Lanes>(x: F<L>, y: F<L>) -> Vec3<L> {
    let z = 1.0 - x.abs() - y.abs();
    let fold = (-z).max(0.0);
    Vec3::new(x - fold.copysign(x), y - fold.copysign(y), z).normalize()
}

/// Two numbers from −1 to 1 in 15 bits each.
#[inline(always)]
fn unpacked<L: Lanes>(packed: F<L>) -> [F<L>; 2] {
    let bits = packed.to_bits();
    [(bits >> 15).to_float() * (2.0 / 32767.0) - 1.0, (bits & 0x7fff).to_float() * (2.0 / 32767.0) - 1.0]
}

/// A point on a curve or a point, object space.
struct Local<L: Lanes> {
    position: Vec3<L>,
    normal: Vec3<L>,
    shading: Vec3<L>,
    tangent: Vec3<L>,
    radius: F<L>,
}

/// Ends and axis of pieces of curves, object space.
struct Axis<L: Lanes> {
    centre: Vec3<L>,
    radius: F<L>,
    /// How much less the radius is at the second end, over the length.
    taper: F<L>,
    frame: Frame<L>,
    /// Unit tangent of the curve.
    tangent: Vec3<L>,
}

impl GeometryTable {
    /// Whether there are curves or points.
    #[inline(always)]
    pub fn any_smooth(&self) -> bool {
        !self.shapes.is_empty()
    }

    /// Turns lanes on curves and points of triangle hits into hits on them.
    #[inline(always)]
    pub(super) fn with_smooth<L: Lanes>(&self, l: L, hit: HitLanes<L>, first_piece: U<L>) -> HitLanes<L> {
        let shape = l.gather_integers(&self.shapes, hit.mesh);
        let mut smooth = SmoothHit { shape, piece: l.u(0), code: [hit.u, hit.v] };
        let (is_smooth, is_curve) = (smooth.is_smooth(), smooth.is_curve());
        if !is_smooth.any() {
            return hit;
        }
        let entry = l.gather_integers(&self.pieces, (first_piece + hit.primitive).keep_if(is_curve));
        smooth.piece = is_curve.select(entry, hit.first_point + hit.primitive);
        let first = is_curve.select(hit.first_point + (entry & !(FIRST_PIECE | LAST_PIECE)), hit.first_point + hit.primitive);
        let second = first + l.u(1).keep_if(is_curve);
        // Values change along a piece as between corners 0 and 1 of a triangle.
        let share = hit.u.clamp(0.0, 1.0).keep_if(is_curve);
        let [a, b, c] = hit.points;
        HitLanes {
            points: [is_smooth.select(first, a), is_smooth.select(second, b), is_smooth.select(first, c)],
            u: is_smooth.select(share, hit.u),
            v: hit.v.keep_if(!is_smooth),
            smooth,
            ..hit
        }
    }

    /// Radii of points over all geometry; of those of meshes a number that means nothing.
    #[inline(always)]
    fn radii<L: Lanes>(&self, l: L, points: U<L>, smooth: M<L>) -> F<L> {
        l.gather(&self.radii, (points - self.first_radius).keep_if(smooth))
    }

    /// Replaces what lanes on curves and points have of a triangle's surface point.
    #[inline(always)]
    pub(super) fn smooth_point<L: Lanes>(
        &self,
        l: L,
        hit: &HitLanes<L>,
        (columns, origin): ([Vec3<L>; 3], Vec3<L>),
        (cofactors, sign): ([Vec3<L>; 3], F<L>),
        triangles: SurfacePoint<L>,
    ) -> SurfacePoint<L> {
        let smooth = hit.smooth.is_smooth();
        if !smooth.any() {
            return triangles;
        }
        let [curve, round] = [hit.smooth.is_curve(), smooth.and_not(hit.smooth.is_curve())];
        let none = Vec3::splat(l, [0.0; 3]);
        let mut local = Local { position: none, normal: none, shading: none, tangent: none, radius: l.f(0.0) };
        if curve.any() {
            local = self.on_curve(l, hit, smooth);
        }
        if round.any() {
            let point = self.on_point(l, hit, smooth);
            local = Local {
                position: round.select(point.position, local.position),
                normal: round.select(point.normal, local.normal),
                shading: round.select(point.shading, local.shading),
                tangent: round.select(point.tangent, local.tangent),
                radius: round.select(point.radius, local.radius),
            };
        }
        let geometric = (local.normal.transform(cofactors) * sign).normalize_or(Vec3::splat(l, [0.0, 0.0, 1.0]));
        let own = (local.shading.transform(cofactors) * sign).normalize_or(geometric);
        let shading = self.shading_normal(l, hit, cofactors, sign, own);
        let stretch = columns[0].max_abs() + columns[1].max_abs() + columns[2].max_abs();
        let moved = stretch * (local.position.max_abs() + local.radius) * gamma(16);
        let error = origin.max_abs().mul_add(gamma(5), moved);
        SurfacePoint {
            position: smooth.select(local.position.transform(columns) + origin, triangles.position),
            error: smooth.select(error, triangles.error),
            geometric_normal: smooth.select(geometric, triangles.geometric_normal),
            shading_normal: smooth.select(shading, triangles.shading_normal),
            edges: [smooth.select(none, triangles.edges[0]), smooth.select(none, triangles.edges[1])],
            double_area: triangles.double_area.keep_if(!smooth),
            tangent: curve.select(local.tangent.transform(columns), none),
        }
    }

    /// A point by its number over all geometry, at the hits' times.
    #[inline(always)]
    fn place<L: Lanes>(&self, l: L, hit: &HitLanes<L>, number: U<L>) -> Vec3<L> {
        let still = Vec3::gather(l, &self.points, number * 3);
        if self.mesh_keys.is_empty() { still } else { self.moved_place(l, hit, number, still) }
    }

    /// Ends, frames and tangents of pieces at the hits' shares.
    #[inline(always)]
    fn axis<L: Lanes>(&self, l: L, hit: &HitLanes<L>, smooth: M<L>) -> Axis<L> {
        let (start, end) = (self.point(l, hit, 0), self.point(l, hit, 1));
        let (radius, end_radius) = (self.radii(l, hit.points[0], smooth), self.radii(l, hit.points[1], smooth));
        let axis = end - start;
        let unit = axis.normalize_or(Vec3::splat(l, [0.0, 0.0, 1.0]));
        let curve = hit.smooth.is_curve();
        let [first, last] = [(hit.smooth.piece & FIRST_PIECE).ne(0), (hit.smooth.piece & LAST_PIECE).ne(0)];
        let before = hit.points[0] - l.u(1).keep_if(curve.and_not(first));
        let after = hit.points[1] + l.u(1).keep_if(curve.and_not(last));
        let starts = (end - self.place(l, hit, before)).normalize_or(unit);
        let ends = (self.place(l, hit, after) - start).normalize_or(unit);
        Axis {
            centre: axis.mul_add(hit.u, start),
            radius: radius.lerp(end_radius, hit.u),
            taper: ((radius - end_radius) / axis.length().max(1e-30)).clamp(-1.0, 1.0),
            frame: Frame::from_normal(unit),
            tangent: (starts * (1.0 - hit.u) + ends * hit.u).normalize_or(unit),
        }
    }

    #[inline(always)]
    fn on_curve<L: Lanes>(&self, l: L, hit: &HitLanes<L>, smooth: M<L>) -> Local<L> {
        let axis = self.axis(l, hit, smooth);
        let [u, v] = hit.smooth.code;
        let ribbon = hit.smooth.is(PrimitiveShape::Ribbon);
        let [across, turn] = unpacked(v);
        let [x, y] = around(ribbon.select(turn * 2.0, v));
        let out = axis.frame.x * x + axis.frame.y * y;
        let [end_cap, start_cap] = [u.gt(1.0).and_not(ribbon), u.lt(0.0).and_not(ribbon)];
        // The normal's part along the axis.
        let lean = end_cap.select(u - 2.0, start_cap.select(u + 2.0, axis.taper)).clamp(-1.0, 1.0);
        let upright = (1.0 - lean * lean).safe_sqrt();
        let tube = out * upright + axis.frame.z * lean;
        // Shading follows the curve's tangent, which does not jump between pieces.
        let flat = (out - axis.tangent * axis.tangent.dot(out)).normalize_or(out);
        let bent = flat * upright + axis.tangent * lean;
        let high = (1.0 - across * across).safe_sqrt();
        let bowed = flat.cross(axis.tangent) * high + flat * across;
        Local {
            position: ribbon.select(out * across, tube).mul_add(axis.radius, axis.centre),
            // Light that comes along a ribbon lights the tube that it stands for, as in Cycles.
            normal: ribbon.select(bowed, tube),
            shading: ribbon.select(bowed, (end_cap | start_cap).select(tube, bent)),
            tangent: axis.tangent,
            radius: axis.radius,
        }
    }

    #[inline(always)]
    fn on_point<L: Lanes>(&self, l: L, hit: &HitLanes<L>, smooth: M<L>) -> Local<L> {
        let [u, v] = hit.smooth.code;
        let disc = hit.smooth.is(PrimitiveShape::Disc);
        let [[x, y], [a, b]] = [unpacked(u), unpacked(v)];
        let normal = from_octahedral(disc.select(a, u), disc.select(b, v));
        let frame = Frame::from_normal(normal);
        let radius = self.radii(l, hit.points[0], smooth);
        let out = disc.select(frame.x * x + frame.y * y, normal);
        Local { position: out.mul_add(radius, self.point(l, hit, 0)), normal, shading: normal, tangent: Vec3::splat(l, [0.0; 3]), radius }
    }
}
