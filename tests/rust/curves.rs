//! Curves and points against dense meshes of the same shape, values along them, and what makes no sense.

use gonio::{
    Severity,
    compile::compile,
    film::Image,
    scene::{
        Aov, Closure, CurveBasis, CurveShape, CurveWrap, Curves, Geometry, LightShape, Material, Mesh, Origin, PointShape, Points, Primvar,
        PrimvarInterpolation, Scene,
    },
};
use gonio_simd::Execution;
use gonio_tests::{
    picture::{compiled, mean, render, settings},
    scenes::{camera_from_above, facing_down, floor, layered, light, place},
};
use serde_json::json;
use std::sync::{Arc, atomic::AtomicBool};

const PIXELS: u32 = 64;
/// Side of the blocks whose means are compared, pixels.
const BLOCK: usize = 8;

/// A floor under a panel and a small lamp, seen from above.
fn stage() -> Scene {
    let mut scene = floor(0.5);
    scene.lights.push(light(LightShape::Rectangle { width: 1.0, height: 1.0 }, facing_down([0.6, 2.5, 0.4]), [3.0; 3]));
    scene.lights.push(light(LightShape::Sphere { radius: 0.2 }, facing_down([-1.2, 1.0, 0.9]), [4.0; 3]));
    scene.cameras.push(camera_from_above([0.0, 4.0, 0.0], 2.2));
    scene
}

fn skin() -> Material {
    layered([0.7, 0.4, 0.2], &[("specular_roughness", 0.4)])
}

/// Points of a wavy Catmull–Rom curve above the floor.
fn wave() -> Vec<[f32; 3]> {
    (0..8).map(|i| i as f32).map(|i| [0.35 * i - 1.22, 0.3 + 0.08 * (1.3 * i).sin(), 0.5 * (1.1 * i).cos()]).collect()
}

fn wave_width(i: f32) -> f32 {
    0.14 + 0.05 * (0.9 * i).sin()
}

fn wave_curves(shape: CurveShape) -> Curves {
    let points = wave();
    let widths: Vec<f32> = (0..points.len()).map(|i| wave_width(i as f32)).collect();
    Curves {
        counts: Arc::from([points.len() as u32]),
        points: points.into(),
        basis: CurveBasis::CatmullRom,
        wrap: CurveWrap::Pinned,
        shape,
        widths: vertex("widths", 1, widths),
        ..Curves::default()
    }
}

fn vertex(name: &str, components: u8, values: Vec<f32>) -> Primvar {
    Primvar { name: name.into(), interpolation: PrimvarInterpolation::Vertex, components, values: values.into(), indices: None }
}

/// Catmull and Rom's cubic between b and c.
fn spline(a: f32, b: f32, c: f32, d: f32, t: f32) -> f32 {
    0.5 * (2.0 * b + (c - a) * t + (2.0 * a - 5.0 * b + 4.0 * c - d) * t * t + (3.0 * b - a - 3.0 * c + d) * t * t * t)
}

/// Centre and radius of the wave at a parameter, its ends mirrored.
fn on_wave(s: f32) -> ([f32; 3], f32) {
    let points = wave();
    let rows: Vec<[f32; 4]> = (0..points.len()).map(|i| [points[i][0], points[i][1], points[i][2], 0.5 * wave_width(i as f32)]).collect();
    let last = rows.len() - 1;
    let span = (s as usize).min(last - 1);
    let at = |i: isize, k: usize| match i {
        i if i < 0 => 2.0 * rows[0][k] - rows[1][k],
        i if i as usize > last => 2.0 * rows[last][k] - rows[last - 1][k],
        i => rows[i as usize][k],
    };
    let span_at = |k: usize| {
        let i = span as isize;
        spline(at(i - 1, k), at(i, k), at(i + 1, k), at(i + 2, k), s - span as f32)
    };
    ([span_at(0), span_at(1), span_at(2)], span_at(3))
}

fn cross(a: [f32; 3], b: [f32; 3]) -> [f32; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn unit(v: [f32; 3]) -> [f32; 3] {
    let length = v.iter().map(|x| x * x).sum::<f32>().sqrt();
    v.map(|x| x / length)
}

/// The wave as a tube of triangles with smooth normals, round at its ends.
fn wave_mesh() -> Mesh {
    const ROUND: u32 = 48;
    let (mut points, mut normals, mut triangles) = (Vec::new(), Vec::new(), Vec::new());
    let steps = 400;
    let end = wave().len() as f32 - 1.0;
    let mut ring = |centre: [f32; 3], radius: f32, tangent: [f32; 3], lean: f32| {
        let side = unit(cross(tangent, [0.0, 1.0, 0.0]));
        let up = cross(side, tangent);
        let upright = (1.0 - lean * lean).max(0.0).sqrt();
        for i in 0..ROUND {
            let (sin, cos) = (i as f32 / ROUND as f32 * std::f32::consts::TAU).sin_cos();
            let n = [0, 1, 2].map(|k| (side[k] * cos + up[k] * sin) * upright + tangent[k] * lean);
            points.push([0, 1, 2].map(|k| centre[k] + radius * n[k]));
            normals.extend(n);
        }
    };
    let tangent = |s: f32| {
        let (a, b) = (on_wave((s - 1e-3).max(0.0)).0, on_wave((s + 1e-3).min(end)).0);
        unit([0, 1, 2].map(|k| b[k] - a[k]))
    };
    let mut rings = 0;
    for i in (0..=24).map(|i| i as f32 / 24.0) {
        ring(on_wave(0.0).0, on_wave(0.0).1, tangent(0.0), i - 1.0);
        rings += 1;
    }
    for s in (1..steps).map(|i| i as f32 / steps as f32 * end) {
        ring(on_wave(s).0, on_wave(s).1, tangent(s), 0.0);
        rings += 1;
    }
    for i in (0..=24).map(|i| i as f32 / 24.0) {
        ring(on_wave(end).0, on_wave(end).1, tangent(end), i);
        rings += 1;
    }
    for row in 0..rings - 1 {
        for i in 0..ROUND {
            let [a, b] = [i, (i + 1) % ROUND].map(|i| row * ROUND + i);
            triangles.extend([[a, b, a + ROUND], [b, b + ROUND, a + ROUND]]);
        }
    }
    Mesh { points: points.into(), triangles: triangles.into(), normals: Some(vertex("normals", 3, normals)), ..Mesh::default() }
}

const CENTRES: [[f32; 4]; 4] = [[-0.5, 0.25, -0.4, 0.25], [0.4, 0.3, -0.3, 0.3], [-0.2, 0.5, 0.45, 0.2], [0.6, 0.1, 0.5, 0.08]];

fn cloud(shape: PointShape) -> Points {
    Points {
        points: CENTRES.iter().map(|[x, y, z, _]| [*x, *y, *z]).collect(),
        widths: vertex("widths", 1, CENTRES.iter().map(|centre| 2.0 * centre[3]).collect()),
        shape,
        ..Points::default()
    }
}

/// The spheres as triangles with smooth normals.
fn cloud_mesh() -> Mesh {
    let (mut points, mut normals, mut triangles) = (Vec::new(), Vec::new(), Vec::new());
    let (rows, round) = (64, 128);
    for centre in CENTRES {
        let first = points.len() as u32;
        for row in 0..=rows {
            for i in 0..round {
                let (polar, around) = (row as f32 / rows as f32 * std::f32::consts::PI, i as f32 / round as f32 * std::f32::consts::TAU);
                let n = [polar.sin() * around.cos(), polar.cos(), -polar.sin() * around.sin()];
                points.push([0, 1, 2].map(|k| centre[k] + centre[3] * n[k]));
                normals.extend(n);
                if row < rows {
                    let [a, b] = [i, (i + 1) % round].map(|i| first + row * round + i);
                    triangles.extend([[a, a + round, b], [b, a + round, b + round]]);
                }
            }
        }
    }
    Mesh { points: points.into(), triangles: triangles.into(), normals: Some(vertex("normals", 3, normals)), ..Mesh::default() }
}

fn picture(scene: &Scene, aovs: &[Aov], samples: u32) -> Image {
    render(&compiled(scene), &settings(PIXELS, samples, aovs), Execution::best())
}

/// Means of blocks of a channel.
fn blocks(image: &Image, aov: Aov, channel: usize) -> Vec<f64> {
    let layer = image.layer(aov).expect("the pass was asked for");
    let side = PIXELS as usize;
    let mut sums = vec![0.0; (side / BLOCK).pow(2)];
    for (pixel, values) in layer.values.chunks(layer.channels).enumerate() {
        let (x, y) = (pixel % side / BLOCK, pixel / side / BLOCK);
        sums[y * (side / BLOCK) + x] += f64::from(values[channel]) / (BLOCK * BLOCK) as f64;
    }
    sums
}

/// The largest difference of two pictures' block means, over the mean of all.
fn difference(a: &Image, b: &Image, aov: &Aov, channel: usize) -> f64 {
    let [a, b] = [a, b].map(|image| blocks(image, *aov, channel));
    let mean = a.iter().map(|x| x.abs()).sum::<f64>() / a.len() as f64;
    a.iter().zip(&b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max) / mean
}

fn with(geometry: impl FnOnce(&mut Scene) -> Geometry, material: Material) -> Scene {
    let mut scene = stage();
    let geometry = geometry(&mut scene);
    place(&mut scene, geometry, material);
    scene
}

#[test]
fn a_round_curve_is_the_tube_of_its_shape() {
    let aovs = [Aov::Color, Aov::Depth, Aov::Normal];
    let curve = picture(&with(|scene| scene.add_curves(wave_curves(CurveShape::Round)).into(), skin()), &aovs, 256);
    let mesh = picture(&with(|scene| scene.add_mesh(wave_mesh()).into(), skin()), &aovs, 256);
    for (channel, aov) in [(0, &aovs[0]), (1, &aovs[0]), (2, &aovs[0]), (0, &aovs[1]), (1, &aovs[2])] {
        let off = difference(&curve, &mesh, aov, channel);
        // Pieces may leave the curve by a tenth of its radius.
        assert!(off < 0.045, "{aov:?} {channel}: {off}");
    }
}

#[test]
fn spheres_are_the_balls_of_their_shape() {
    let aovs = [Aov::Color, Aov::Depth, Aov::Normal];
    let points = picture(&with(|scene| scene.add_points(cloud(PointShape::Sphere)).into(), skin()), &aovs, 256);
    let mesh = picture(&with(|scene| scene.add_mesh(cloud_mesh()).into(), skin()), &aovs, 256);
    for (channel, aov) in [(0, &aovs[0]), (1, &aovs[0]), (0, &aovs[1]), (0, &aovs[2]), (1, &aovs[2])] {
        let off = difference(&points, &mesh, aov, channel);
        assert!(off < 0.03, "{aov:?} {channel}: {off}");
    }
}

/// Seen from above, what faces the ray covers what its round twin covers, and curves have the same shading normals.
#[test]
fn flat_shapes_cover_what_round_ones_cover() {
    let without_floor = |geometry: &dyn Fn(&mut Scene) -> Geometry| {
        let mut scene = with(geometry, skin());
        scene.instances.remove(0);
        picture(&scene, &[Aov::Alpha, Aov::Normal], 64)
    };
    let round = without_floor(&|scene| scene.add_curves(wave_curves(CurveShape::Round)).into());
    let flat = without_floor(&|scene| scene.add_curves(wave_curves(CurveShape::Ribbon)).into());
    let ball = without_floor(&|scene| scene.add_points(cloud(PointShape::Sphere)).into());
    let disc = without_floor(&|scene| scene.add_points(cloud(PointShape::Disc)).into());
    // Alpha: ribbons have no rounded ends.
    let off = difference(&round, &flat, &Aov::Alpha, 0);
    assert!(off < 0.25, "{off}");
    assert!((mean(&round, Aov::Alpha, 0) / mean(&flat, Aov::Alpha, 0) - 1.0).abs() < 0.04);
    let off = difference(&ball, &disc, &Aov::Alpha, 0);
    assert!(off < 0.02, "{off}");
    let off = difference(&round, &flat, &Aov::Normal, 1);
    assert!(off < 0.3, "normals {off}");
}

/// A material that shows a primvar as the albedo.
fn showing(name: &str) -> Material {
    let mut closure = Closure::default();
    closure.set("specular_weight", 0.0);
    let graph = json!({ "nodes": [{ "operation": { "Primvar": { "name": name, "fallback": [0.0, 0.0, 0.0, 0.0] } }, "inputs": [] }] });
    let graph = serde_json::from_value(graph).expect("a graph");
    closure.set_input("base_color", gonio::scene::Input::Node(gonio::scene::NodeId(0), gonio::scene::Channel::Rgb));
    Material { graph, ..Material::of(Origin::new("test"), closure) }
}

/// Two straight strands of 2 m along x, 0.2 m wide, at z = −0.4 and 0.4.
fn strands(primvars: Vec<Primvar>) -> Curves {
    let points = [-0.4f32, 0.4].iter().flat_map(|z| (0..5).map(|i| [0.5 * i as f32 - 1.0, 0.2, *z])).collect();
    Curves { points, counts: Arc::from([5, 5]), widths: Primvar::constant("widths", 0.2), primvars, ..Curves::default() }
}

/// The albedo at a place of the picture, the mean of 2 × 2 pixels.
fn albedo(image: &Image, x: f64, z: f64) -> [f64; 3] {
    let layer = image.layer(Aov::Albedo).expect("asked for");
    let pixel = |v: f64| ((v / 2.2 + 0.5) * f64::from(PIXELS)) as usize;
    let at = |x: usize, y: usize, channel: usize| f64::from(layer.values[(y * PIXELS as usize + x) * layer.channels + channel]);
    let (x, y) = (pixel(x), pixel(z));
    [0, 1, 2].map(|channel| [(0, 0), (1, 0), (0, 1), (1, 1)].iter().map(|(i, j)| at(x - i, y - j, channel)).sum::<f64>() / 4.0)
}

#[test]
fn values_change_along_curves_and_from_one_to_the_next() {
    let ramp: Vec<f32> = (0..10).map(|i| (i % 5) as f32 / 4.0).flat_map(|s| [s, 1.0 - s, 0.25]).collect();
    let uniform = |values: Vec<f32>| Primvar { interpolation: PrimvarInterpolation::Uniform, ..vertex("one", 3, values) };
    let primvars = vec![vertex("ramp", 3, ramp), uniform(vec![0.1, 0.2, 0.3, 0.6, 0.5, 0.4])];
    let shown = |name: &str| {
        let scene = with(|scene| scene.add_curves(strands(primvars.clone())).into(), showing(name));
        picture(&scene, &[Aov::Albedo], 16)
    };
    let close = |found: [f64; 3], expected: [f64; 3]| {
        assert!(found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 0.02), "{found:?}, expected {expected:?}");
    };
    let image = shown("ramp");
    for x in [-0.8, -0.3, 0.1, 0.7] {
        let s = 0.5 * (x + 1.0);
        close(albedo(&image, x, 0.4), [s, 1.0 - s, 0.25]);
    }
    let image = shown("one");
    close(albedo(&image, 0.3, -0.4), [0.1, 0.2, 0.3]);
    close(albedo(&image, -0.3, 0.4), [0.6, 0.5, 0.4]);
    let image = shown("hair:intercept");
    close(albedo(&image, 0.5, 0.4), [0.75, 0.0, 0.0]);
    let image = shown("hair:thickness");
    close(albedo(&image, 0.5, 0.4), [0.2, 0.0, 0.0]);
    let image = shown("hair:strand");
    close(albedo(&image, 0.5, -0.4), [1.0, 0.0, 0.0]);
}

/// A ray meets a strand from outside alone: a half transparent one lets half of the light pass, wherever its pieces join.
#[test]
fn a_strand_is_passed_once() {
    let lit = |opacity: Option<f32>| {
        let mut scene = floor(0.8);
        scene.cameras.push(camera_from_above([0.0, 4.0, 0.0], 0.1));
        // Looks through nothing: the strand is wider than the picture, and hidden from the camera.
        scene.lights.push(light(LightShape::Point, facing_down([0.0, 3.0, 0.0]), [5.0; 3]));
        if let Some(opacity) = opacity {
            let points: Vec<[f32; 3]> = (0..41).map(|i| [0.05 * i as f32 - 1.0, 1.0, 0.02 * (i as f32 * 0.7).sin()]).collect();
            let curves =
                Curves { counts: Arc::from([41]), points: points.into(), widths: Primvar::constant("widths", 0.5), ..Curves::default() };
            let curves = scene.add_curves(curves);
            place(&mut scene, curves, layered([0.0; 3], &[("geometry_opacity", opacity), ("specular_weight", 0.0)]));
            scene.instances[1].visibility.camera = false;
            scene.instances[1].visibility.diffuse = false;
        }
        mean(&picture(&scene, &[Aov::Color], 64), Aov::Color, 0)
    };
    let (free, half, none) = (lit(None), lit(Some(0.5)), lit(Some(1.0)));
    assert!(none < 0.01 * free, "{none} of {free}");
    assert!((half / free - 0.5).abs() < 0.01, "{half} of {free}");
}

#[test]
fn threads_and_levels_make_the_same_picture() {
    let scene = compiled(&with(|scene| scene.add_curves(wave_curves(CurveShape::Ribbon)).into(), skin()));
    let aovs = [Aov::Color];
    let one = render(&scene, &gonio::scene::Settings { threads: 1, ..settings(PIXELS, 4, &aovs) }, Execution::best());
    let two = render(&scene, &settings(PIXELS, 4, &aovs), Execution::best());
    assert!(one.layer(Aov::Color).map(|l| &l.values) == two.layer(Aov::Color).map(|l| &l.values));
    let scalar = render(&scene, &settings(PIXELS, 4, &aovs), Execution::Scalar);
    let off = difference(&one, &scalar, &Aov::Color, 0);
    assert!(off < 0.02, "{off}");
}

#[test]
fn what_makes_no_sense_is_told_and_the_rest_is_shown() {
    let nan = f32::NAN;
    let mut scene = stage();
    let mut curves = strands(Vec::new());
    curves.widths = vertex("widths", 1, vec![-0.1, 0.0, nan, 0.1, 0.1, 0.1, 0.1, 0.1, 0.1, 0.1]);
    let curves = scene.add_curves(curves);
    let one_point = Curves {
        points: Arc::from([[0.0, 0.3, 0.0]]),
        counts: Arc::from([1]),
        widths: Primvar::constant("widths", 0.1),
        ..Curves::default()
    };
    let one_point = scene.add_curves(one_point);
    let absurd = Curves { points: Arc::from([[0.0, 0.3, 0.0], [nan, 0.0, 0.0]]), counts: Arc::from([u32::MAX, 2]), ..Curves::default() };
    let absurd = scene.add_curves(absurd);
    let points = scene.add_points(Points {
        points: Arc::from([[nan; 3], [0.0, 0.5, 0.0]]),
        widths: Primvar::constant("w", 1e30),
        ..Points::default()
    });
    let mut glowing = layered([0.5; 3], &[("subsurface_weight", 1.0)]);
    glowing.closures[0].set_colour("emission_color", [1.0; 3]);
    place(&mut scene, curves, glowing);
    place(&mut scene, one_point, skin());
    place(&mut scene, absurd, skin());
    place(&mut scene, points, skin());
    let compiled = Arc::new(compile(&scene, None, &AtomicBool::new(false)).expect("the scene compiles"));
    let told = |part: &str, severity: Severity| compiled.diagnostics.iter().any(|d| d.severity == severity && d.message.contains(part));
    assert!(told("negative", Severity::Warning) && told("too few points", Severity::Warning), "{:?}", compiled.diagnostics);
    assert!(told("by their counts", Severity::Warning) && told("not finite", Severity::Warning), "{:?}", compiled.diagnostics);
    assert!(told("subsurface", Severity::Warning) && told("shine", Severity::Info), "{:?}", compiled.diagnostics);
    let image = render(&compiled, &settings(PIXELS, 4, &[Aov::Color]), Execution::best());
    let layer = image.layer(Aov::Color).expect("a picture");
    assert!(layer.values.iter().all(|x| x.is_finite()));
}

/// Trees are kept for the same arrays.
#[test]
fn curves_that_did_not_change_keep_their_trees() {
    let scene = with(|scene| scene.add_curves(wave_curves(CurveShape::Round)).into(), skin());
    let first = compile(&scene, None, &AtomicBool::new(false)).expect("the scene compiles");
    let second = compile(&scene, Some(&first), &AtomicBool::new(false)).expect("the scene compiles");
    let of = |compiled: &gonio::compile::CompiledScene| Arc::as_ptr(&compiled.tables.bvh.meshes()[1]);
    assert_eq!(of(&first), of(&second));
    assert!(first.statistics.segments >= 14, "{}", first.statistics.segments);
}
