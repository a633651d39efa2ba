//! Surfaces of revolution from profiles.

use super::{Axis, surface_primvars};
use crate::PolygonMesh;
use crate::vector::Vec3;

/// One ring of a profile.
#[derive(Clone, Copy)]
pub(super) struct Row {
    pub(super) radius: f32,
    pub(super) height: f32,
    /// Unit normal as (away from the axis, along the axis).
    pub(super) normal: [f32; 2],
    /// Texture coordinate t.
    pub(super) t: f32,
}

/// Collects strips of rings around the axis; strips that follow one another share their rings' points.
pub(super) struct Lathe {
    segments: u32,
    axis: Axis,
    mesh: PolygonMesh,
    normals: Vec<Vec3>,
    st: Vec<[f32; 2]>,
    /// Radius, height and first point of the ring added last.
    last_ring: Option<(f32, f32, u32)>,
}

impl Lathe {
    pub(super) fn new(segments: u32, axis: Axis) -> Self {
        let segments = segments.clamp(3, 4096);
        Self { segments, axis, mesh: PolygonMesh::default(), normals: Vec::new(), st: Vec::new(), last_ring: None }
    }

    /// Adds the bands between successive rows, given from the bottom of the outside to the top.
    pub(super) fn strip(&mut self, rows: &[Row]) {
        for pair in rows.windows(2) {
            let (low, high) = (pair[0], pair[1]);
            if low.radius == 0.0 && high.radius == 0.0 || (low.radius, low.height) == (high.radius, high.height) {
                continue;
            }
            let (first_low, first_high) = (self.ring(low), self.ring(high));
            for column in 0..self.segments {
                self.band_face(low, high, first_low, first_high, column);
            }
        }
    }

    pub(super) fn finish(mut self) -> PolygonMesh {
        self.mesh.primvars = surface_primvars(self.normals, self.st);
        self.mesh
    }

    /// The first point of the row's ring; a ring without radius is one point.
    fn ring(&mut self, row: Row) -> u32 {
        if let Some((radius, height, first)) = self.last_ring.filter(|last| (last.0, last.1) == (row.radius, row.height)) {
            self.last_ring = Some((radius, height, first));
            return first;
        }
        let first = self.mesh.points.len() as u32;
        let count = if row.radius == 0.0 { 1 } else { self.segments };
        for column in 0..count {
            let [cosine, sine] = self.direction(column as f32);
            let point = [row.radius * cosine, row.radius * sine, row.height];
            self.mesh.points.push(self.axis.turn(point));
        }
        self.last_ring = Some((row.radius, row.height, first));
        first
    }

    fn band_face(&mut self, low: Row, high: Row, first_low: u32, first_high: u32, column: u32) {
        let next = (column + 1) % self.segments;
        let (here, there, middle) = (column as f32, column as f32 + 1.0, column as f32 + 0.5);
        if low.radius == 0.0 {
            self.face(&[(low, first_low, middle), (high, first_high + next, there), (high, first_high + column, here)]);
        } else if high.radius == 0.0 {
            self.face(&[(low, first_low + column, here), (low, first_low + next, there), (high, first_high, middle)]);
        } else {
            self.face(&[
                (low, first_low + column, here),
                (low, first_low + next, there),
                (high, first_high + next, there),
                (high, first_high + column, here),
            ]);
        }
    }

    /// Adds a face of corners given as (row, point, column).
    fn face(&mut self, corners: &[(Row, u32, f32)]) {
        self.mesh.face_counts.push(corners.len() as u32);
        for &(row, point, column) in corners {
            let [cosine, sine] = self.direction(column);
            let [away, along] = row.normal;
            self.mesh.corners.push(point);
            self.normals.push(self.axis.turn([away * cosine, away * sine, along]));
            self.st.push([column / self.segments as f32, row.t]);
        }
    }

    fn direction(&self, column: f32) -> [f32; 2] {
        let (sine, cosine) = (std::f64::consts::TAU * f64::from(column) / f64::from(self.segments)).sin_cos();
        [cosine as f32, sine as f32]
    }
}

/// Rows of a quarter or half circle about `height` from angle `from` to `to` (radians, −π/2 bottom, π/2 top), with t
/// from `t[0]` to `t[1]`.
pub(super) fn arc(radius: f32, height: f32, from: f64, to: f64, rings: u32, t: [f32; 2]) -> Vec<Row> {
    let rings = rings.max(1);
    let row = |ring: u32| {
        let fraction = f64::from(ring) / f64::from(rings);
        let angle = from + (to - from) * fraction;
        // The poles are exact points, not rings of rounding error's radius.
        let is_pole = (angle.abs() - std::f64::consts::FRAC_PI_2).abs() < 1e-9;
        let cosine = if is_pole { 0.0 } else { angle.cos() as f32 };
        let sine = angle.sin() as f32;
        Row { radius: radius * cosine, height: height + radius * sine, normal: [cosine, sine], t: t[0] + (t[1] - t[0]) * fraction as f32 }
    };
    (0..=rings).map(row).collect()
}
