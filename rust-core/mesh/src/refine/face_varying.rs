//! Topology of face-varying values: a value is a vertex of its own, seams are boundaries.
//!
//! A value belongs to one point: where several points name the same element each gets a value of its own. Inside a
//! continuous region the values follow the rules of the points; along seams they follow a crease or stay, as
//! [`FaceVaryingInterpolation`] says (the rules of OpenSubdiv's face-varying channels).

use super::FaceVaryingInterpolation as Interpolation;
use super::topology::{INFINITE, Level, NONE};

/// Values of one face-varying channel on the base level.
pub(super) struct Channel {
    pub(super) level: Level,
    /// Element of each value in the primvar's `values`.
    pub(super) elements: Vec<u32>,
}

/// Face corners sorted by their vertices: (start of each vertex's run and the end, corners).
pub(super) fn corners_by_vertex(vertex_count: usize, corner_vertex: &[u32]) -> (Vec<u32>, Vec<u32>) {
    let mut starts = vec![0u32; vertex_count + 1];
    for &vertex in corner_vertex {
        starts[vertex as usize + 1] += 1;
    }
    for vertex in 0..vertex_count {
        starts[vertex + 1] += starts[vertex];
    }
    let mut fill = starts.clone();
    let mut order = vec![0; corner_vertex.len()];
    for (corner, &vertex) in corner_vertex.iter().enumerate() {
        order[fill[vertex as usize] as usize] = corner as u32;
        fill[vertex as usize] += 1;
    }
    (starts, order)
}

/// For each corner the first corner of the same vertex with the same value: unindexed values made continuous where
/// they agree. `value_of` gives a corner's floats.
pub(super) fn welded<'a>(vertex_count: usize, corner_vertex: &[u32], value_of: impl Fn(u32) -> &'a [f32]) -> Vec<u32> {
    let (starts, mut order) = corners_by_vertex(vertex_count, corner_vertex);
    // Adding 0 makes −0 the same as 0.
    let bits = |corner: u32| value_of(corner).iter().map(|x| (x + 0.0).to_bits());
    let mut representative = vec![0; corner_vertex.len()];
    for run in starts.windows(2) {
        let corners = &mut order[run[0] as usize..run[1] as usize];
        corners.sort_by(|&a, &b| bits(a).cmp(bits(b)));
        let mut first = 0;
        for place in 0..corners.len() {
            if !bits(corners[place]).eq(bits(corners[first])) {
                first = place;
            }
            representative[corners[place] as usize] = corners[first];
        }
    }
    representative
}

/// The channel whose corners have these elements, over the sharpened base level of the points.
pub(super) fn channel(geometry: &Level, corner_element: &[u32], interpolation: Interpolation) -> Channel {
    let (starts, mut order) = corners_by_vertex(geometry.vertex_count, &geometry.corner_vertex);
    let mut value_start = Vec::with_capacity(geometry.vertex_count + 1);
    let mut corner_value = vec![0; corner_element.len()];
    let mut elements: Vec<u32> = Vec::new();
    for run in starts.windows(2) {
        value_start.push(elements.len());
        let corners = &mut order[run[0] as usize..run[1] as usize];
        corners.sort_unstable_by_key(|&corner| (corner_element[corner as usize], corner));
        let mut last = None;
        for &corner in &*corners {
            let element = corner_element[corner as usize];
            if last.replace(element) != Some(element) {
                elements.push(element);
            }
            corner_value[corner as usize] = (elements.len() - 1) as u32;
        }
    }
    value_start.push(elements.len());
    let mut level = Level::new(elements.len(), geometry.face_start.clone(), corner_value);
    sharpen(&mut level, geometry, &value_start, interpolation);
    Channel { level, elements }
}

/// What surrounds one value.
#[derive(Clone, Copy, Default)]
struct Span {
    faces: u32,
    boundaries: u32,
    on_mesh_boundary: bool,
    on_seam: bool,
    has_infinite: bool,
    semi_sharp: f32,
}

impl Span {
    /// Whether the value has more than one run of faces around its vertex.
    fn is_disjoint(&self) -> bool {
        self.boundaries > 2
    }
}

fn sharpen(level: &mut Level, geometry: &Level, value_start: &[usize], interpolation: Interpolation) {
    let spans = spans(level, geometry);
    for (vertex, run) in value_start.windows(2).enumerate() {
        let sharpness = geometry.vertex_sharpness[vertex];
        let values = &mut level.vertex_sharpness[run[0]..run[1]];
        values.fill(sharpness);
        sharpen_vertex(values, &spans[run[0]..run[1]], interpolation);
    }
}

/// Gives each continuous edge the sharpness of its edge of the mesh, and gathers what is around each value.
fn spans(level: &mut Level, geometry: &Level) -> Vec<Span> {
    let mut spans = vec![Span::default(); level.vertex_count];
    let mut is_done = vec![false; level.edge_vertices.len()];
    for corner in 0..level.corner_vertex.len() {
        spans[level.corner_vertex[corner] as usize].faces += 1;
        let edge = level.corner_edge[corner] as usize;
        if std::mem::replace(&mut is_done[edge], true) {
            continue;
        }
        let mesh_edge = geometry.corner_edge[corner] as usize;
        let is_inside = level.is_manifold(edge);
        let is_mesh_boundary = geometry.edge_corners[mesh_edge][1] == NONE;
        level.edge_sharpness[edge] = level.edge_sharpness[edge].max(geometry.edge_sharpness[mesh_edge]);
        let sharpness = level.edge_sharpness[edge];
        for &value in &level.edge_vertices[edge] {
            let span = &mut spans[value as usize];
            if !is_inside {
                span.boundaries += 1;
                span.on_mesh_boundary |= is_mesh_boundary;
                span.on_seam |= !is_mesh_boundary;
            } else if sharpness >= INFINITE {
                span.has_infinite = true;
            } else {
                span.semi_sharp = span.semi_sharp.max(sharpness);
            }
        }
    }
    spans
}

/// Sets the sharpness of the values of one vertex, which come in with the sharpness of the vertex.
fn sharpen_vertex(sharpness: &mut [f32], spans: &[Span], interpolation: Interpolation) {
    let linear_boundaries = matches!(interpolation, Interpolation::Boundaries | Interpolation::All);
    let sharp_corners = interpolation != Interpolation::None;
    if spans.len() < 2 && spans.iter().all(|span| !span.on_seam) {
        for (entry, span) in sharpness.iter_mut().zip(spans).filter(|(_, span)| span.boundaries > 0) {
            if linear_boundaries || (span.faces == 1 && sharp_corners) {
                *entry = INFINITE;
            }
        }
        return;
    }
    let all_sharp = linear_boundaries || is_all_sharp(spans, interpolation);
    let semi_sharp = spans.iter().fold(0.0f32, |most, span| most.max(span.semi_sharp));
    let is_dependent = spans.len() == 2 && matches!(interpolation, Interpolation::CornersPlus1 | Interpolation::CornersPlus2);
    for (entry, span) in sharpness.iter_mut().zip(spans) {
        if all_sharp || span.is_disjoint() || span.has_infinite || (span.faces == 1 && sharp_corners) {
            *entry = INFINITE;
        } else if is_dependent && span.semi_sharp == 0.0 {
            *entry = entry.max(semi_sharp);
        }
    }
}

/// Whether the values of a vertex on a seam are all corners because of one another.
fn is_all_sharp(spans: &[Span], interpolation: Interpolation) -> bool {
    let plus_two = interpolation == Interpolation::CornersPlus2;
    if !plus_two && interpolation != Interpolation::CornersPlus1 {
        return false;
    }
    match spans {
        [dart] => plus_two && !dart.on_mesh_boundary,
        [a, b] => {
            let is_sharp = |span: &Span| span.has_infinite || span.is_disjoint() || (plus_two && span.faces == 1);
            is_sharp(a) || is_sharp(b)
        }
        _ => true,
    }
}
