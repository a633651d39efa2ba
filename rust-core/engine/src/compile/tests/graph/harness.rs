//! Graphs in the form of scene descriptions, run over random hits of a small scene at any level.

use crate::{
    compile::{CompiledScene, compile},
    geometry::GeometryTable,
    graph::{Around, CHUNK, GraphScratch, HitStep, OutputColumns, Program, SurfaceColumns, Wanted, WantedOutput, evaluate},
    scene::{
        Channel, Graph, Input, Instances, Material, Mesh, NodeId, Origin, Primvar, PrimvarInterpolation, Scene, ShaderOutput, Texture,
        TextureSource, Transform,
    },
};
use gonio_nodes::Code;
use gonio_simd::{Column, Execution, Lanes, One, Vec3, dispatch};
use serde_json::{Value, json};
use std::sync::{Arc, atomic::AtomicBool};

/// An uneven map of the scene's instance, which mirrors, and where it stands.
pub(super) const COLUMNS: [[f64; 3]; 3] = [[2.0, 0.5, 0.0], [0.25, -0.5, 0.75], [0.0, 0.125, 1.5]];
pub(super) const PLACE: [f64; 3] = [1000.0, -2000.0, 500.0];

pub(super) const POINTS: [[f32; 3]; 6] =
    [[0.0, 0.0, 0.0], [1.0, 0.0, 0.25], [1.0, 1.0, 0.0], [0.0, 1.0, 0.5], [-1.0, 0.5, 0.0], [0.5, 2.0, 1.0]];
pub(super) const TRIANGLES: [[u32; 3]; 4] = [[0, 1, 2], [0, 2, 3], [0, 3, 4], [3, 2, 5]];

/// Texture coordinates of a triangle's corner; those of the last two triangles are mirrored.
pub(super) fn st(triangle: usize, corner: usize) -> [f32; 2] {
    let [x, y, _] = POINTS[TRIANGLES[triangle][corner] as usize];
    let u = if triangle < 2 { x } else { -x };
    [u * 0.5 + y * 0.125, y * 0.75 + triangle as f32]
}

/// Uniform numbers in [0, 1): a counter through a 64-bit mixer (SplitMix64).
pub(super) fn uniform(seed: u64, index: usize) -> f32 {
    let mut z = (seed << 40 ^ index as u64).wrapping_add(1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    ((z ^ (z >> 31)) >> 40) as f32 / (1u32 << 24) as f32
}

/// A compiled graph and hits to run it over.
pub(super) struct Bench {
    pub(super) compiled: CompiledScene,
    pub(super) points: SurfaceColumns,
}

fn primvar(name: &str, interpolation: PrimvarInterpolation, components: u8, values: Vec<f32>) -> Primvar {
    Primvar { name: name.to_owned(), interpolation, components, values: Arc::from(values), indices: None }
}

/// The instance with a material of nodes, and a texture of one texel.
pub(super) fn scene(nodes: &Value) -> Scene {
    let mut scene = Scene::default();
    scene.add_texture(Texture {
        origin: Origin::new("test"),
        source: TextureSource::Pixels { width: 1, height: 1, rgba: Arc::from([0.25, 0.5, 0.75, 1.0]) },
        colour_space: "raw".to_owned(),
    });
    let corners = (0..12).flat_map(|i| st(i / 3, i % 3)).collect();
    let heat = POINTS.iter().flat_map(|[x, y, z]| [x + 2.0 * y, y - z, x * 3.0]).collect();
    let normals = (0..POINTS.len()).flat_map(|i| [uniform(9, i) - 0.5, uniform(9, i + 10) - 0.5, 1.0]).collect();
    let mesh = scene.add_mesh(Mesh {
        points: Arc::from(POINTS),
        triangles: Arc::from(TRIANGLES),
        normals: Some(primvar("normals", PrimvarInterpolation::Vertex, 3, normals)),
        primvars: vec![
            primvar("st", PrimvarInterpolation::FaceVarying, 2, corners),
            primvar("heat", PrimvarInterpolation::Vertex, 3, heat),
            primvar("tone", PrimvarInterpolation::Constant, 4, vec![1.0, 2.0, 3.0, 4.0]),
        ],
        ..Mesh::default()
    });
    let graph: Graph = serde_json::from_value(json!({ "nodes": nodes })).expect("nodes in the form of scene descriptions");
    let mut material = Material::diffuse(Origin::new("test"), [0.5; 3]);
    // Shader outputs keep the graph whole.
    let last = read(graph.nodes.len() as u16 - 1);
    material.shader_outputs.push(ShaderOutput { name: "last".into(), color: last, value: last });
    let material = scene.add_material(Material { graph, ..material });
    let [x, y, z] = COLUMNS;
    scene.instances.push(Instances::new(Origin::new("test"), mesh, vec![material], vec![Transform { columns: [x, y, z, PLACE] }]));
    scene
}

/// The value of a node.
pub(super) fn read(node: u16) -> Input {
    Input::Node(NodeId(node), Channel::Rgb)
}

/// Fills what follows from the hits' numbers.
#[inline(always)]
fn place<L: Lanes>(l: L, geometry: &GeometryTable, points: &mut SurfaceColumns) {
    let store = |v: Vec3<L>, columns: &mut [Column; 3], at: usize| {
        let [x, y, z] = columns;
        v.store([x, y, z], at);
    };
    for at in (0..CHUNK).step_by(L::COUNT) {
        let [u, v] = [l.load(&points.barycentric[0], at), l.load(&points.barycentric[1], at)];
        let hit = geometry.hit_lanes(l, l.load_integers(&points.instance, at), l.load_integers(&points.primitive, at), u, v);
        let point = geometry.surface_point(l, &hit);
        let wo = Vec3::load(l, [&points.wo[0], &points.wo[1], &points.wo[2]], at);
        let side = l.f(1.0).copysign(wo.dot(point.geometric_normal));
        side.store(&mut points.side, at);
        store(point.position, &mut points.position, at);
        store(point.geometric_normal * side, &mut points.geometric_normal, at);
        store(point.shading_normal * side, &mut points.shading_normal, at);
    }
}

impl Bench {
    /// Compiles nodes, given as JSON, and places hits on all triangles, seen from both sides.
    pub(super) fn new(nodes: &Value) -> Self {
        Self::of(compile(&scene(nodes), None, &AtomicBool::new(false)).expect("a scene that compiles"))
    }

    /// The same of a scene that was compiled.
    pub(super) fn of(compiled: CompiledScene) -> Self {
        let mut points = SurfaceColumns { origin: compiled.tables.origin.map(|x| x as f32), ..SurfaceColumns::default() };
        for i in 0..CHUNK {
            let (a, b) = (uniform(1, i).sqrt(), uniform(2, i));
            points.primitive[i] = (i % TRIANGLES.len()) as u32;
            [points.barycentric[0][i], points.barycentric[1][i]] = [a * (1.0 - b), a * b];
            points.cone[i] = 0.5 + uniform(3, i);
            let wo = [uniform(4, i) - 0.5, uniform(5, i) - 0.5, uniform(6, i) - 0.5];
            let length = wo.iter().map(|x| x * x).sum::<f32>().sqrt();
            (0..3).for_each(|k| points.wo[k][i] = wo[k] / length);
        }
        place(One, &compiled.tables.geometry, &mut points);
        Self { compiled, points }
    }

    /// The same with numbers in place of positions, directions and normals: `value` of the column (0 to 8) and the entry.
    pub(super) fn with_numbers(nodes: &Value, value: impl Fn(usize, usize) -> f32) -> Self {
        let mut bench = Self::new(nodes);
        bench.points.origin = [0.0; 3];
        for i in 0..CHUNK {
            for k in 0..3 {
                bench.points.position[k][i] = value(k, i);
                bench.points.wo[k][i] = value(3 + k, i);
                bench.points.geometric_normal[k][i] = value(6 + k, i);
            }
        }
        bench
    }

    /// The graph as it was compiled.
    pub(super) fn code(&self) -> &Code<HitStep> {
        &self.compiled.tables.materials.shader_outputs[0].code
    }

    /// The program of what is wanted.
    pub(super) fn program(&self, wanted: Wanted) -> Program {
        Program::new(self.code(), &Wanted { uv: self.compiled.tables.materials.shader_outputs[0].uv, ..wanted })
    }

    /// The program of the last node's four components.
    pub(super) fn last(&self) -> Program {
        let value = self.compiled.tables.materials.shader_outputs[0].outputs[0].color;
        self.program(Wanted { outputs: vec![WantedOutput { offset: 0, width: 4, value, range: None }], ..Wanted::default() })
    }

    /// The last node's value at all hits.
    pub(super) fn run(&self, execution: Execution) -> Vec<[f32; 4]> {
        let (_, values) = self.run_program(&self.last(), execution);
        (0..CHUNK).map(|i| [0, 1, 2, 3].map(|component| values.column(component)[i])).collect()
    }

    /// The columns that a program leaves, and its outputs.
    pub(super) fn run_program(&self, program: &Program, execution: Execution) -> (SurfaceColumns, OutputColumns) {
        let (mut points, mut scratch, mut values) = (self.points.clone(), GraphScratch::default(), OutputColumns::default());
        let tables = &self.compiled.tables;
        let around = Around { bvh: &tables.bvh, any_transparent: tables.any_transparent };
        let asked = (&tables.geometry, &tables.textures, &around);
        dispatch!(execution, l => evaluate(l, program, asked, &mut points, CHUNK, &mut scratch, &mut values));
        (points, values)
    }

    /// Checks the last node's value at every hit and every level.
    pub(super) fn check(&self, mut check: impl FnMut(usize, [f32; 4])) {
        for execution in Execution::all() {
            self.run(execution).into_iter().enumerate().for_each(|(i, value)| check(i, value));
        }
    }
}

/// Three columns at an entry, in double precision.
pub(super) fn triple(columns: &[Column; 3], i: usize) -> [f64; 3] {
    [0, 1, 2].map(|k| f64::from(columns[k][i]))
}

/// The first three components, in double precision.
pub(super) fn three(v: [f32; 4]) -> [f64; 3] {
    [0, 1, 2].map(|k| f64::from(v[k]))
}

pub(super) fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    (0..3).map(|k| a[k] * b[k]).sum()
}

/// A graph of one node without inputs.
pub(super) fn leaf(operation: &Value) -> Bench {
    Bench::new(&json!([{ "operation": operation, "inputs": [] }]))
}

/// Nodes that give three four-component inputs from the nine number columns, and an operation on them.
pub(super) fn on_numbers(operation: &Value) -> Value {
    let part = |column: usize| {
        let channel = ["R", "G", "B"][column % 3];
        json!({ "Node": [column / 3, channel] })
    };
    let combine = |first: usize| {
        let inputs: Vec<Value> = (0..4).map(|k| part((first + k) % 9)).collect();
        json!({ "operation": "Combine", "inputs": inputs })
    };
    let leaf = |name: &str| json!({ "operation": name, "inputs": [] });
    let inputs: Vec<Value> = (3..6).map(|number| json!({ "Node": [number, "Rgb"] })).collect();
    let operation = json!({ "operation": operation, "inputs": inputs });
    json!([leaf("Position"), leaf("Incoming"), leaf("GeometricNormal"), combine(0), combine(3), combine(6), operation])
}

/// The inputs that [`on_numbers`] gives at an entry.
pub(super) fn inputs(value: impl Fn(usize, usize) -> f32, i: usize) -> [[f32; 4]; 3] {
    [0, 3, 6].map(|first| [0, 1, 2, 3].map(|k| value((first + k) % 9, i)))
}

/// Asserts that a value is the expected one rounded, or within a tolerance.
#[track_caller]
pub(super) fn close(found: f32, expected: f64, tolerance: f64, what: &str) {
    let same = found == expected as f32 || (f64::from(found) - expected).abs() <= tolerance;
    assert!(same, "{what}: found {found}, expected {expected} within {tolerance}");
}
