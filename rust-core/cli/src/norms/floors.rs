//! Floors of rooms by the surfaces and grids that a stage has.

use crate::vector::{Vector, cross, dot, minus, plus};
use gonio::{
    Error, Result,
    scene::{GridArea, Mesh, Origin, Scene, Transform},
};
use std::collections::{BTreeMap, HashMap};

/// How level a triangle of a floor is: its normal along the way up.
const LEVEL: f64 = 0.99;
/// Metres within which triangles lie at one height, and two corners are one.
const SAME: f64 = 1e-3;

/// Corners of the floor that a grid or a surface of this name covers, or of the end of its path.
///
/// # Errors
/// Nothing has the name, several have it, or what has it is not level anywhere.
pub(super) fn floor_of(scene: &Scene, name: &str, up: Vector) -> Result<Vec<Vector>> {
    let is_meant = |origin: &Origin| *origin.name == *name || origin.name.ends_with(&format!("/{}", name.trim_start_matches('/')));
    let wrong = |problem: &str| Err(Error::setting("plan", format!("surface '{name}' {problem}")));
    let mut found: BTreeMap<&str, Floor<'_>> = BTreeMap::new();
    for set in scene.instances.iter().filter(|set| is_meant(&set.origin)) {
        if let (Some(mesh), Some(transform)) = (set.geometry.mesh(), set.transforms.first()) {
            found.entry(&set.origin.name).or_default().push(&scene.meshes[mesh.index()], transform);
        }
    }
    for grid in scene.grids.iter().filter(|grid| is_meant(&grid.origin)) {
        match &grid.area {
            GridArea::Rectangle { corner, edges: [u, v] } => {
                return Ok(vec![*corner, plus(*corner, *u), plus(plus(*corner, *u), *v), plus(*corner, *v)]);
            }
            GridArea::Mesh { mesh, transform } => {
                let floor = found.entry(&grid.origin.name).or_default();
                if floor.0.is_empty() {
                    floor.push(&scene.meshes[mesh.index()], transform);
                }
            }
        }
    }
    match found.len() {
        0 => wrong("is no grid and no surface of the stage"),
        1 => found.values().next().and_then(|floor| floor.outline(up)).map_or_else(|| wrong("is level nowhere"), Ok),
        _ => wrong(&format!("may be any of {}; write more of its path", found.keys().copied().collect::<Vec<_>>().join(", "))),
    }
}

/// Placed meshes of one name.
#[derive(Debug, Default)]
struct Floor<'a>(Vec<(&'a Mesh, &'a Transform)>);

impl<'a> Floor<'a> {
    fn push(&mut self, mesh: &'a Mesh, transform: &'a Transform) {
        self.0.push((mesh, transform));
    }

    /// The outer border of the lowest level triangles that look up, or of those that look down where none does.
    fn outline(&self, up: Vector) -> Option<Vec<Vector>> {
        let level = |turn: f64| -> Vec<[Vector; 3]> {
            let triangles = self.triangles().filter(|triangle| normal(triangle).is_some_and(|normal| turn * dot(normal, up) > LEVEL));
            triangles.collect()
        };
        let triangles = Some(level(1.0)).filter(|found| !found.is_empty()).unwrap_or_else(|| level(-1.0));
        let height = |triangle: &[Vector; 3]| dot(triangle[0], up);
        let lowest = triangles.iter().map(height).min_by(f64::total_cmp)?;
        let kept: Vec<&[Vector; 3]> = triangles.iter().filter(|triangle| height(triangle) - lowest < SAME).collect();
        loops(&kept).into_iter().max_by(|a, b| area(a, up).total_cmp(&area(b, up))).map(straightened)
    }

    fn triangles(&self) -> impl Iterator<Item = [Vector; 3]> {
        self.0.iter().flat_map(|(mesh, transform)| {
            let place = |number: u32| mesh.points.get(number as usize).map(|point| transform.point(point.map(f64::from)));
            let mirrored = transform.determinant() < 0.0;
            mesh.triangles.iter().filter_map(move |[a, b, c]| {
                let [a, b, c] = [place(*a)?, place(*b)?, place(*c)?];
                Some(if mirrored { [a, c, b] } else { [a, b, c] })
            })
        })
    }
}

/// Closed ways along the edges that belong to one triangle alone.
fn loops(triangles: &[&[Vector; 3]]) -> Vec<Vec<Vector>> {
    let key = |point: Vector| point.map(|part| (part / SAME).round() as i64);
    let mut edges: HashMap<([i64; 3], [i64; 3]), Vector> = HashMap::new();
    for (a, b) in triangles.iter().flat_map(|t| [(t[0], t[1]), (t[1], t[2]), (t[2], t[0])]) {
        if edges.remove(&(key(b), key(a))).is_none() {
            edges.insert((key(a), key(b)), b);
        }
    }
    let mut next: BTreeMap<[i64; 3], Vec<([i64; 3], Vector)>> = BTreeMap::new();
    for ((from, to), point) in edges {
        next.entry(from).or_default().push((to, point));
    }
    next.values_mut().for_each(|ways| ways.sort_by_key(|(to, _)| *to));
    let mut found = Vec::new();
    while let Some(start) = next.iter().find(|(_, ways)| !ways.is_empty()).map(|(from, _)| *from) {
        let (mut at, mut way) = (start, Vec::new());
        while let Some((to, point)) = next.get_mut(&at).and_then(Vec::pop) {
            way.push(point);
            at = to;
        }
        if at == start {
            found.push(way);
        }
    }
    found
}

/// Without corners on straight ways, which would part walls.
fn straightened(mut way: Vec<Vector>) -> Vec<Vector> {
    let mut at = 0;
    while at < way.len() && way.len() > 3 {
        let count = way.len();
        let [before, here, after] = [way[(at + count - 1) % count], way[at], way[(at + 1) % count]];
        let (along, off) = (minus(after, before), cross(minus(here, before), minus(after, before)));
        if dot(off, off) <= SAME * SAME * dot(along, along) {
            way.remove(at);
        } else {
            at += 1;
        }
    }
    way
}

/// Twice the area that a way goes about, seen from above.
fn area(way: &[Vector], up: Vector) -> f64 {
    let Some(first) = way.first() else { return 0.0 };
    way.windows(2).map(|pair| dot(cross(minus(pair[0], *first), minus(pair[1], *first)), up)).sum::<f64>().abs()
}

fn normal([a, b, c]: &[Vector; 3]) -> Option<Vector> {
    let normal = cross(minus(*b, *a), minus(*c, *a));
    let length = dot(normal, normal).sqrt();
    (length > 0.0).then(|| normal.map(|part| part / length))
}
