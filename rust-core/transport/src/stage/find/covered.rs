//! Places that an opaque surface lies on, as the floor does on the underside of what stands on it: nothing arrives there, and nothing leaves.
//!
//! Rays start off the surface that they leave, by what rounding asks for, and so would start beyond what lies on it. Pictures do not show such
//! places; textures do. A short ray from before each place to behind it tells them: it meets the place's own triangle, and what lies on that.

use crate::geometry::NONE;
use crate::state::nearest::NearestHits;
use crate::tables::Tables;
use gonio_accel::{BEFORE_EDGE, Passed};
use gonio_simd::{Execution, F, Lanes, M, One, U, Vec3};

/// Faces that lie on each other and are looked through, at most.
const MOST_FACES: usize = 8;
/// How far before the place its ray starts, and how far behind it ends, in bounds of its error. Rays that leave it start two of these before it.
pub(crate) const BEFORE: f32 = 8.0;
pub(crate) const BEHIND: f32 = 3.0;
/// Faces of the same mesh lie on each other only if they face each other: others are neighbours.
const OPPOSITE: f32 = 0.5;

/// Fills `covered`, 1 for each of the first rays behind, towards the places of the hits, that meets what lies there.
pub(crate) fn find_covered(tables: &Tables, execution: Execution, count: usize, nearest: &mut NearestHits, covered: &mut Vec<u8>) {
    covered.clear();
    covered.resize(count, 0);
    let NearestHits { hits: places, behind_rays: rays, behind: met, .. } = nearest;
    rays.set_times(None::<std::iter::Empty<f32>>);
    rays.passed.clear();
    for _ in 0..MOST_FACES {
        tables.bvh.first_hit_in_tree(execution, &rays.batch(0..count), false, met);
        if met.instance.iter().all(|instance| *instance == NONE) {
            break;
        }
        let passed = rays.passed.of_first(count);
        for i in 0..count {
            let (face, own) = ([met.instance[i], met.primitive[i]], [places.instance[i], places.primitive[i]]);
            let is_over = face[0] == NONE;
            let direction = [0, 1, 2].map(|axis| rays.direction[axis][i]);
            covered[i] |= u8::from(!is_over && lies_on(tables, face, own, direction));
            if is_over || covered[i] == 1 {
                rays.t_max[i] = -1.0;
                passed[i] = Passed::NOTHING;
                continue;
            }
            let (t, u, v) = (met.t[i], met.u[i], met.v[i]);
            let on_edge = u32::from(u <= 0.0 || v <= 0.0 || u + v >= BEFORE_EDGE);
            passed[i] = Passed { t, instance: face[0], primitive: face[1], on_edge };
            rays.t_min[i] = f32::from_bits(t.max(f32::MIN_POSITIVE).to_bits() - 1);
        }
    }
    rays.passed.clear();
}

/// Whether a face, as instance and triangle, hides a place's own that it coincides with.
fn lies_on(tables: &Tables, face: [u32; 2], own: [u32; 2], direction: [f32; 3]) -> bool {
    if face == own || face[0] >= tables.first_light_instance {
        return false;
    }
    let [instance, primitive] = face.map(U::<One>);
    let material = tables.geometry.material_lanes(One, instance, primitive);
    if !tables.materials.is_opaque(material.0) {
        return false;
    }
    let hit = tables.geometry.hit_lanes(One, instance, primitive, F(1.0 / 3.0), F(1.0 / 3.0));
    face[0] != own[0] || tables.geometry.surface_point(One, &hit).geometric_normal.dot(Vec3::splat(One, direction)).0 > OPPOSITE
}

/// The covered ones of places that are counted lane by lane, of which `count` come before.
#[inline(always)]
pub(crate) fn covered_lanes<L: Lanes>(l: L, covered: &[u8], count: usize, inside: M<L>) -> M<L> {
    let (mut bits, mut left, mut next) = (0_u64, inside.bits(), count);
    while left != 0 {
        bits |= u64::from(covered[next]) << left.trailing_zeros();
        next += 1;
        left &= left - 1;
    }
    M(l.mask_from_bits(bits))
}
