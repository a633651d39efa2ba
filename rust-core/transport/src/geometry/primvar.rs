//! Primvars at hits: which value each triangle corner has, and their interpolation, on lanes.

use super::{GeometryTable, HitLanes, NONE};
use gonio_simd::{F, Lanes, M, U, Vec3};

/// What a compiled primvar's values belong to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PrimvarKind {
    /// The mesh has none.
    Absent = 0,
    /// One value.
    Constant = 1,
    /// One value a triangle, or an instance for instances' own primvars.
    Uniform = 2,
    /// One value a point.
    Vertex = 3,
    /// One value a triangle corner.
    FaceVarying = 4,
}

/// A primvar of a mesh in the tables.
#[derive(Clone, Copy, Debug)]
pub struct PrimvarRef {
    /// What the values belong to.
    pub kind: PrimvarKind,
    /// Floats a value.
    pub components: u32,
    /// First float in `values`.
    pub first_value: u32,
    /// First entry in `value_indices`, or [`NONE`] for values in order.
    pub first_index: u32,
}

impl PrimvarRef {
    /// No primvar.
    pub const ABSENT: Self = Self { kind: PrimvarKind::Absent, components: 1, first_value: 0, first_index: NONE };

    /// As the table stores it.
    pub fn words(self) -> [u32; 4] {
        [self.kind as u32 | self.components << 8, self.first_value, self.first_index, 0]
    }
}

/// A primvar's references for hits on different meshes.
#[derive(Clone, Copy, Debug)]
pub(super) struct RefLanes<L: Lanes> {
    kind: U<L>,
    components: U<L>,
    first_value: U<L>,
    first_index: U<L>,
    per_instance: M<L>,
}

impl<L: Lanes> RefLanes<L> {
    /// References of meshes' own, by their numbers.
    #[inline(always)]
    fn gather(l: L, table: &[u32], number: U<L>) -> Self {
        let [head, first_value, first_index, _] = l.gather_integer_quads(table, number << 2);
        Self { kind: head & 0xff, components: head >> 8, first_value, first_index, per_instance: l.m(false) }
    }

    /// Where there is a value.
    #[inline(always)]
    pub(super) fn present(&self) -> M<L> {
        self.kind.ne(PrimvarKind::Absent as u32)
    }
}

impl GeometryTable {
    /// Four components of a primvar column at hits, missing components zero, and where there is a value at all.
    #[inline(always)]
    pub fn primvar<L: Lanes>(&self, l: L, hit: &HitLanes<L>, column: usize) -> ([F<L>; 4], M<L>) {
        let reference = self.reference(l, hit, column);
        let present = reference.present();
        let mut value = [l.f(0.0); 4];
        if !present.any() {
            return (value, present);
        }
        let weights = [l.f(1.0) - hit.u - hit.v, hit.u, hit.v];
        for (corner, weight) in weights.into_iter().enumerate() {
            let at = self.value_place(l, hit, &reference, corner as u32);
            for (component, (part, sum)) in l.gather_quads(&self.values, at).iter().zip(&mut value).enumerate() {
                let inside = l.u(component as u32).lt(reference.components);
                *sum = part.keep_if(inside).mul_add(weight, *sum);
            }
        }
        (value, present)
    }

    /// The shading normal at one corner of the hit triangles, at the hits' times.
    #[inline(always)]
    pub(super) fn corner_vector<L: Lanes>(&self, l: L, hit: &HitLanes<L>, reference: &RefLanes<L>, corner: u32) -> Vec3<L> {
        let place = self.value_place(l, hit, reference, corner);
        let still = Vec3::gather(l, &self.values, place);
        if self.mesh_keys.is_empty() { still } else { self.moved_normal(l, hit, place - reference.first_value, still) }
    }

    /// Four components of a primvar column at the three corners; missing ones are zero.
    #[inline(always)]
    pub(super) fn corner_values<L: Lanes>(&self, l: L, hit: &HitLanes<L>, column: usize) -> [[F<L>; 4]; 3] {
        let reference = self.reference(l, hit, column);
        let present = reference.present();
        let mut corners = [[l.f(0.0); 4]; 3];
        for (corner, values) in corners.iter_mut().enumerate() {
            let at = self.value_place(l, hit, &reference, corner as u32);
            for (component, (part, value)) in l.gather_quads(&self.values, at).iter().zip(values).enumerate() {
                let inside = present & l.u(component as u32).lt(reference.components);
                *value = part.keep_if(inside);
            }
        }
        corners
    }

    /// The first two components at the three corners; zeros where there is no value.
    #[inline(always)]
    pub fn corner_uvs<L: Lanes>(&self, l: L, hit: &HitLanes<L>, column: usize) -> [[F<L>; 2]; 3] {
        let reference = self.reference(l, hit, column);
        let present = reference.present() & l.u(1).lt(reference.components);
        let mut corners = [[l.f(0.0); 2]; 3];
        for (corner, uv) in corners.iter_mut().enumerate() {
            let at = self.value_place(l, hit, &reference, corner as u32);
            let [u, v] = l.gather_pairs(&self.values, at);
            *uv = [u.keep_if(present), v.keep_if(present)];
        }
        corners
    }

    #[inline(always)]
    pub(super) fn reference<L: Lanes>(&self, l: L, hit: &HitLanes<L>, column: usize) -> RefLanes<L> {
        let own = RefLanes::gather(l, &self.primvars, hit.mesh * self.columns as u32 + column as u32);
        let instead = hit.first_primvar.ne(NONE).and_not(own.present());
        if !instead.any() {
            return own;
        }
        let other = RefLanes::gather(l, &self.instance_primvars, hit.first_primvar + column as u32);
        RefLanes {
            kind: instead.select(other.kind, own.kind),
            components: instead.select(other.components, own.components),
            first_value: instead.select(other.first_value, own.first_value),
            first_index: instead.select(other.first_index, own.first_index),
            per_instance: instead,
        }
    }

    /// First float of a corner's value.
    #[inline(always)]
    fn value_place<L: Lanes>(&self, l: L, hit: &HitLanes<L>, reference: &RefLanes<L>, corner: u32) -> U<L> {
        let kind = |k: PrimvarKind| reference.kind.eq(k as u32);
        let point = hit.points[corner as usize] - hit.first_point;
        let own = reference.per_instance;
        let uniform = if own.any() { own.select(self.number_lanes(l, hit.instance), hit.primitive) } else { hit.primitive };
        let element = kind(PrimvarKind::Vertex).select(
            point,
            kind(PrimvarKind::FaceVarying).select(hit.primitive * 3 + corner, kind(PrimvarKind::Uniform).select(uniform, l.u(0))),
        );
        let indexed = reference.first_index.ne(NONE);
        let element = if indexed.any() {
            indexed.select(l.gather_integers(&self.value_indices, reference.first_index + element), element)
        } else {
            element
        };
        reference.first_value + element * reference.components
    }
}
