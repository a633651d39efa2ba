//! Displaced and diced meshes as they are compiled.

use crate::{
    compile::{CompiledScene, compile},
    scene::{
        Camera, Channel, Dicing, Displacement, DisplacementKind, Input, Instances, Material, Mesh, MeshKey, NodeId, Operation, Origin,
        Primvar, PrimvarInterpolation, Quantity, Scene, Space, TextureFilter, TextureId, Transform, WrapMode,
    },
};
use std::sync::{Arc, atomic::AtomicBool};

fn compiled(scene: &Scene) -> CompiledScene {
    compile(scene, None, &AtomicBool::new(false)).expect("a scene that compiles")
}

fn messages(compiled: &CompiledScene) -> Vec<String> {
    compiled.diagnostics.iter().map(|diagnostic| diagnostic.message.clone()).collect()
}

/// The points that are traced, the first of the mesh that an instance shows.
fn points(compiled: &CompiledScene, instance: usize, count: usize) -> Vec<[f32; 3]> {
    let table = &compiled.tables.geometry;
    let first = 3 * table.instances[instance].first_point as usize;
    table.points[first..first + 3 * count].as_chunks::<3>().0.to_vec()
}

fn primvar(name: &str, interpolation: PrimvarInterpolation, components: u8, values: Vec<f32>) -> Primvar {
    Primvar { name: name.into(), interpolation, components, values: values.into(), indices: None }
}

/// A square of 2 × 2 quads in the plane z = 0, with smooth normals and its place as `st`.
fn grid() -> Mesh {
    let points: Vec<[f32; 3]> = (0..9).map(|n| [(n % 3) as f32, (n / 3) as f32, 0.0]).collect();
    let quads = [[0, 1, 4, 3], [1, 2, 5, 4], [3, 4, 7, 6], [4, 5, 8, 7]];
    let triangles: Vec<[u32; 3]> = quads.iter().flat_map(|[a, b, c, d]| [[*a, *b, *c], [*a, *c, *d]]).collect();
    let st = points.iter().flat_map(|[x, y, _]| [*x, *y]).collect();
    Mesh {
        origin: Origin::new("grid"),
        points: points.into(),
        triangles: triangles.into(),
        normals: Some(primvar("normals", PrimvarInterpolation::Vertex, 3, [0.0, 0.0, 1.0].repeat(9))),
        primvars: vec![primvar("st", PrimvarInterpolation::Vertex, 2, st)],
        ..Mesh::default()
    }
}

/// A material that is displaced by nodes' last value.
fn material(nodes: Vec<(Operation, Vec<Input>)>, displacement: Displacement) -> Material {
    let mut material = Material::diffuse(Origin::new("moved"), [0.5; 3]);
    for (operation, inputs) in nodes {
        let _ = material.graph.add(operation, inputs);
    }
    material.displacement = Some(displacement);
    material
}

fn read(node: u16, channel: Channel) -> Input {
    Input::Node(NodeId(node), channel)
}

fn st() -> (Operation, Vec<Input>) {
    (Operation::Primvar { name: "st".into(), fallback: [0.0; 4] }, vec![])
}

fn scene(mesh: Mesh, material: Material, transforms: Vec<Transform>) -> Scene {
    let mut scene = Scene::default();
    let (mesh, material) = (scene.add_mesh(mesh), scene.add_material(material));
    scene.instances.push(Instances::new(Origin::new("placed"), mesh, vec![material], transforms));
    scene
}

fn once(mesh: Mesh, material: Material) -> Scene {
    scene(mesh, material, vec![Transform::default()])
}

#[test]
fn heights_move_points_along_the_normal_and_normals_follow() {
    let height = Displacement { value: read(0, Channel::R), midlevel: 1.0, scale: 0.5, ..Displacement::default() };
    let compiled = compiled(&once(grid(), material(vec![st()], height)));
    assert!(messages(&compiled).is_empty(), "{:?}", messages(&compiled));
    for [x, _, z] in points(&compiled, 0, 9) {
        assert_eq!(z, 0.5 * (x - 1.0));
    }
    // The plane is tilted: its normal is (-1, 0, 2) / √5 everywhere.
    let table = &compiled.tables.geometry;
    assert!(table.any_normals);
    let expected = [-1.0, 0.0, 2.0].map(|x| x / 5.0_f32.sqrt());
    let found = table.values.as_chunks::<3>().0.iter().find(|n| n[2] > 0.0 && n[0] < 0.0).expect("a normal");
    assert!((0..3).all(|k| (found[k] - expected[k]).abs() < 1e-6), "{found:?}");
}

#[test]
fn vectors_move_points_in_their_spaces() {
    // Turned a quarter about z, and twice as large.
    let turned = Transform { columns: [[0.0, 2.0, 0.0], [-2.0, 0.0, 0.0], [0.0, 0.0, 2.0], [5.0, 0.0, 0.0]] };
    let moved = |kind| {
        let value = Input::Constant([1.0, 0.0, 3.0, 0.0]);
        let displacement = Displacement { value, kind, ..Displacement::default() };
        points(&compiled(&scene(grid(), material(vec![st()], displacement), vec![turned])), 0, 9)[4]
    };
    assert_eq!(moved(DisplacementKind::Object), [2.0, 1.0, 3.0]);
    assert_eq!(moved(DisplacementKind::World), [1.0, 0.5, 1.5]);
}

#[test]
fn tangent_vectors_follow_the_texture_that_is_read() {
    let mut mesh = grid();
    // Coordinates turned: u along y, v along -x.
    let st_values: Vec<f32> = mesh.points.iter().flat_map(|[x, y, _]| [*y, -*x]).collect();
    mesh.primvars = vec![primvar("st", PrimvarInterpolation::Vertex, 2, st_values)];
    let image = Operation::Image {
        texture: TextureId(0),
        wrap: [WrapMode::Repeat; 2],
        filter: TextureFilter::Linear,
        scale: [1.0; 4],
        bias: [0.0; 4],
        fallback: [0.25, 0.5, 1.0, 1.0],
    };
    let displacement = Displacement { value: read(1, Channel::Rgb), kind: DisplacementKind::Tangent, ..Displacement::default() };
    let mut scene = once(mesh, material(vec![st(), (image, vec![read(0, Channel::Rgb)])], displacement));
    scene.add_texture(crate::scene::Texture {
        origin: Origin::new("vectors"),
        source: crate::scene::TextureSource::Pixels { width: 1, height: 1, rgba: Arc::from([0.25, 0.5, 1.0, 1.0]) },
        colour_space: "raw".to_owned(),
    });
    let found = points(&compiled(&scene), 0, 9)[4];
    assert!((0..3).all(|k| (found[k] - [0.5, 1.25, 1.0][k]).abs() < 1e-5), "{found:?}");
}

#[test]
fn seams_stay_closed_where_corners_say_different_things() {
    // Each triangle has points of its own, and a value of its own.
    let whole = grid();
    let own: Vec<[f32; 3]> = whole.triangles.iter().flatten().map(|point| whole.points[*point as usize]).collect();
    let count = whole.triangles.len();
    let mesh = Mesh {
        points: own.clone().into(),
        triangles: (0..count as u32).map(|n| [3 * n, 3 * n + 1, 3 * n + 2]).collect(),
        normals: None,
        primvars: vec![primvar("st", PrimvarInterpolation::FaceVarying, 1, (0..3 * count).map(|n| n as f32).collect())],
        ..whole
    };
    let found = points(
        &compiled(&once(mesh, material(vec![st()], Displacement { value: read(0, Channel::R), ..Displacement::default() }))),
        0,
        3 * count,
    );
    for (a, from) in found.iter().zip(&own) {
        let alike = found.iter().zip(&own).filter(|(_, other)| *other == from).map(|(b, _)| b);
        assert!(alike.clone().all(|b| a[2].to_bits() == b[2].to_bits()), "{a:?}");
        let said: Vec<f32> = own.iter().enumerate().filter(|(_, other)| *other == from).map(|(n, _)| n as f32).collect();
        assert!((a[2] - said.iter().sum::<f32>() / said.len() as f32).abs() < 1e-5);
    }
}

#[test]
fn what_is_not_a_number_stays_and_is_told() {
    let nodes = vec![
        st(),
        (
            Operation::Image {
                texture: TextureId(7),
                wrap: [WrapMode::Repeat; 2],
                filter: TextureFilter::Linear,
                scale: [1.0; 4],
                bias: [0.0; 4],
                fallback: [f32::NAN; 4],
            },
            vec![read(0, Channel::Rgb)],
        ),
    ];
    let compiled_one = compiled(&once(grid(), material(nodes, Displacement { value: read(1, Channel::R), ..Displacement::default() })));
    assert!(points(&compiled_one, 0, 9).iter().all(|[_, _, z]| *z == 0.0));
    assert!(messages(&compiled_one).iter().any(|text| text.contains("not a number at 9 of 9 points")), "{:?}", messages(&compiled_one));
    // Huge heights, meshes without area, and nothing at all.
    let huge = Displacement { value: Input::Constant([3e38; 4]), scale: 10.0, ..Displacement::default() };
    compiled(&once(grid(), material(vec![], huge)));
    let flat = Mesh { points: Arc::from([[1.0; 3]; 9]), ..grid() };
    compiled(&once(flat, material(vec![st()], Displacement { value: read(0, Channel::R), ..Displacement::default() })));
    let none = Mesh { points: Arc::from([]), triangles: Arc::from([]), normals: None, primvars: vec![], ..Mesh::default() };
    compiled(&once(none, material(vec![], huge)));
    let squashed = scene(grid(), material(vec![], huge), vec![Transform::scale(0.0)]);
    compiled(&squashed);
}

#[test]
fn a_limit_leaves_meshes_as_they_are_and_tells() {
    let mut scene = once(grid(), material(vec![st()], Displacement { value: read(0, Channel::R), ..Displacement::default() }));
    scene.settings.displacement_memory = 100;
    let found = compiled(&scene);
    assert!(points(&found, 0, 9).iter().all(|[_, _, z]| *z == 0.0));
    assert!(messages(&found).iter().any(|text| text.contains("limit of displacement; it keeps its shape")), "{:?}", messages(&found));
}

#[test]
fn placements_share_a_shape_and_other_materials_have_others() {
    let height = |z: f32| material(vec![], Displacement { value: Input::Constant([z; 4]), ..Displacement::default() });
    let apart = |x: f64| Transform { columns: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [x, 0.0, 0.0]] };
    let mut all = scene(grid(), height(1.0), vec![apart(0.0), apart(10.0)]);
    let mesh = all.instances[0].geometry;
    for (name, made) in [("higher", height(2.0)), ("plain", Material::diffuse(Origin::new("plain"), [0.5; 3]))] {
        let made = all.add_material(made);
        all.instances.push(Instances {
            geometry: mesh,
            ..Instances::new(Origin::new(name), crate::scene::MeshId(0), vec![made], vec![apart(20.0)])
        });
    }
    let found = compiled(&all);
    assert!(messages(&found).is_empty(), "{:?}", messages(&found));
    assert_eq!([0, 1, 2, 3].map(|instance| points(&found, instance, 9)[4][2]), [1.0, 1.0, 2.0, 0.0]);
    let row = |instance: usize| found.tables.geometry.instances[instance].mesh;
    assert_eq!(row(0), row(1));
}

#[test]
fn shapes_that_depend_on_the_placement_are_told() {
    let apart = |x: f64| Transform { columns: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [x, 0.0, 0.0]] };
    let by_place = Displacement { value: read(0, Channel::R), ..Displacement::default() };
    let position = vec![(Operation::Position, vec![])];
    let found = compiled(&scene(grid(), material(position.clone(), by_place), vec![apart(0.0), apart(10.0)]));
    assert!(messages(&found).iter().any(|text| text.contains("depends on where the mesh is placed")), "{:?}", messages(&found));
    assert_eq!(points(&found, 0, 9)[5][2], 2.0);
    // In the object's own space it does not.
    let own = Operation::Transform { from: Space::World, to: Space::Object, quantity: Quantity::Point };
    let nodes = [position, vec![(own, vec![read(0, Channel::Rgb)])]].concat();
    let found =
        compiled(&scene(grid(), material(nodes, Displacement { value: read(1, Channel::R), ..by_place }), vec![apart(0.0), apart(10.0)]));
    assert!(messages(&found).is_empty(), "{:?}", messages(&found));
}

#[test]
fn every_key_of_a_mesh_that_deforms_is_displaced() {
    let mut mesh = grid();
    let lifted: Arc<[[f32; 3]]> = mesh.points.iter().map(|[x, y, z]| [*x, *y, z + 1.0]).collect();
    mesh.motion = [mesh.points.clone(), lifted].map(|points| MeshKey { points, normals: None }).to_vec();
    let found = compiled(&once(mesh, material(vec![st()], Displacement { value: read(0, Channel::R), ..Displacement::default() })));
    let heights: Vec<f32> = found.tables.geometry.key_points.as_chunks::<3>().0.iter().map(|point| point[2]).collect();
    let expected: Vec<f32> = (0..18).map(|n| (n % 3) as f32 + (n / 9) as f32).collect();
    assert_eq!(heights, expected);
}

#[test]
fn the_next_compilation_keeps_what_did_not_change() {
    let height = Displacement { value: read(0, Channel::R), ..Displacement::default() };
    let mut scene = once(Mesh { dicing: Some(Dicing { length: 0.25, ..Dicing::default() }), ..grid() }, material(vec![st()], height));
    let first = compiled(&scene);
    scene.materials[0].closures[0].set("specular_weight", 1.0);
    let second = compile(&scene, Some(&first), &AtomicBool::new(false)).expect("a scene that compiles");
    let of = |compiled: &CompiledScene| compiled.tables.bvh.meshes()[0].clone();
    assert!(Arc::ptr_eq(&of(&first), &of(&second)));
    scene.materials[0].displacement = Some(Displacement { scale: 2.0, ..height });
    let third = compile(&scene, Some(&second), &AtomicBool::new(false)).expect("a scene that compiles");
    assert!(!Arc::ptr_eq(&of(&first), &of(&third)));
    assert_eq!(points(&third, 0, 9)[5][2], 4.0);
}

#[test]
fn meshes_are_diced_to_pixels_of_the_camera() {
    let camera = |distance: f64| Camera {
        transform: Transform { columns: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [1.0, 1.0, distance]] },
        ..Camera::default()
    };
    let triangles = |distance: f64| {
        let mut scene =
            once(Mesh { dicing: Some(Dicing { pixels: 8.0, ..Dicing::default() }), ..grid() }, material(vec![], Displacement::default()));
        scene.cameras.push(camera(distance));
        scene.settings.resolution = [64, 64];
        let compiled = compiled(&scene);
        assert!(messages(&compiled).is_empty(), "{:?}", messages(&compiled));
        compiled.statistics.triangles
    };
    let counts = [2.0, 4.0, 8.0, 1e4].map(triangles);
    assert!(counts[0] > 2 * counts[1] && counts[1] >= 2 * counts[2], "{counts:?}");
    assert_eq!(counts[3], 8);
}

#[test]
fn values_and_slots_are_diced_along() {
    let mut mesh = grid();
    mesh.slots = Some((0..8).map(|n| u16::from(n > 3)).collect());
    mesh.primvars.push(primvar(
        "corner",
        PrimvarInterpolation::FaceVarying,
        1,
        (0..24).map(|n| mesh.points[mesh.triangles[n / 3][n % 3] as usize][0]).collect(),
    ));
    mesh.primvars.push(primvar("face", PrimvarInterpolation::Uniform, 1, (0..8).map(|n| n as f32).collect()));
    mesh.dicing = Some(Dicing { length: 0.3, ..Dicing::default() });
    let corner = (Operation::Primvar { name: "corner".into(), fallback: [0.0; 4] }, vec![]);
    let faces = (Operation::Primvar { name: "face".into(), fallback: [0.0; 4] }, vec![]);
    // Heights are x by points less x by corners: nothing, if both are carried along alike.
    let nodes = vec![st(), corner, faces, (Operation::Subtract, vec![read(0, Channel::R), read(1, Channel::R)])];
    let found =
        compiled(&once(mesh, material(nodes, Displacement { value: read(3, Channel::R), scale: 100.0, ..Displacement::default() })));
    let count = found.statistics.triangles as usize;
    assert!(count > 100, "{count}");
    assert!(found.tables.geometry.points.as_chunks::<3>().0.iter().all(|point| point[2].abs() < 1e-3));
    // Behind them stands what pads the table.
    assert_eq!(found.tables.geometry.slots.len(), count + 4);
}
