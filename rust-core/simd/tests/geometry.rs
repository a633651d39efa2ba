//! Vectors, frames and columns.

use gonio_simd::{Column, Execution, F, Frame, Lanes, PADDING, Rgb, Vec3, dispatch, padded};

/// Unit vectors: axes with zeros of both signs, the neighbourhood of the poles, and a spiral over the sphere; a multiple of 16 of them.
fn directions() -> [Vec<f32>; 3] {
    let mut all = vec![
        [0.0, 0.0, 1.0],
        [0.0, 0.0, -1.0],
        [-0.0, -0.0, -1.0],
        [1.0, 0.0, 0.0],
        [0.0, 1.0, -0.0],
        [-1.0, 0.0, 0.0],
        [0.0, -1.0, 0.0],
        [1e-4, 0.0, -1.0],
        [0.0, -1e-7, -1.0],
        [1e-7, 1e-7, 1.0],
        [3e-5, -2e-5, -1.0],
        [1e-20, 0.0, -1.0],
    ];
    for i in 0..10_004 {
        let z = 1.0 - 2.0 * (f64::from(i) + 0.5) / 10_004.0;
        let (sin, cos) = (f64::from(i) * 2.399_963).sin_cos();
        let r = (1.0 - z * z).sqrt();
        all.push([(r * cos) as f32, (r * sin) as f32, z as f32]);
    }
    assert_eq!(all.len() % PADDING, 0);
    [0, 1, 2].map(|k| all.iter().map(|v| v[k]).collect())
}

#[inline(always)]
fn near<L: Lanes>(what: &str, got: F<L>, expected: f32, tolerance: f32) {
    for x in got.to_array().into_iter().take(L::COUNT) {
        assert!((x - expected).abs() <= tolerance, "{what}: {x}, expected {expected}");
    }
}

#[inline(always)]
fn check_frame<L: Lanes>(frame: Frame<L>) {
    for axis in [frame.x, frame.y, frame.z] {
        near("length of an axis", axis.length(), 1.0, 1e-6);
    }
    near("x · y", frame.x.dot(frame.y), 0.0, 1e-6);
    near("y · z", frame.y.dot(frame.z), 0.0, 1e-6);
    near("z · x", frame.z.dot(frame.x), 0.0, 1e-6);
    // The volume multiplies the errors of three lengths.
    near("handedness", frame.x.cross(frame.y).dot(frame.z), 1.0, 2e-6);
}

#[inline(always)]
fn check_frames<L: Lanes>(l: L, columns: [&[f32]; 3]) {
    let v = Vec3::splat(l, [0.3, -0.8, 0.4]);
    for at in (0..columns[0].len()).step_by(L::COUNT) {
        let n = Vec3::load(l, columns, at);
        let any = Frame::from_normal(n);
        check_frame(any);
        near("there and back", (any.to_world(any.to_local(v)) - v).max_abs(), 0.0, 1e-6);
        near("normal", (any.to_local(n) - Vec3::splat(l, [0.0, 0.0, 1.0])).max_abs(), 0.0, 1e-6);
        check_frame(Frame::from_tangent(n, Vec3::splat(l, [0.6, 0.64, 0.48])));
        for scale in [1e-15, 1.0, 1e15] {
            check_frame(Frame::from_tangent(n, Vec3::splat(l, [0.3, 0.4, -0.9]) * scale));
            check_frame(Frame::from_tangent(n, n * scale));
            check_frame(Frame::from_tangent(n, (n + any.x * 4e-4) * scale));
        }
        // Useless tangents fall back to any frame.
        check_frame(Frame::from_tangent(n, n));
        check_frame(Frame::from_tangent(n, Vec3::splat(l, [0.0; 3])));
        check_frame(Frame::from_tangent(n, Vec3::splat(l, [f32::NAN; 3])));
    }
    let toward = Frame::from_tangent(Vec3::splat(l, [0.0, 0.0, 1.0]), Vec3::splat(l, [0.0, 3.0, 5.0]));
    near("projected tangent", (toward.x - Vec3::splat(l, [0.0, 1.0, 0.0])).max_abs(), 0.0, 1e-6);
}

#[test]
fn frames_are_orthonormal() {
    let [x, y, z] = directions();
    for execution in Execution::all() {
        dispatch!(execution, l => check_frames(l, [&x, &y, &z]));
    }
}

#[inline(always)]
fn check_vectors<L: Lanes>(l: L) {
    let vector = |v| Vec3::splat(l, v);
    let equal = |what: &str, got: Vec3<L>, expected: [f32; 3]| {
        for (got, expected) in [got.x, got.y, got.z].into_iter().zip(expected) {
            near(what, got, expected, 1e-6);
        }
    };
    let (a, b) = (vector([1.0, 2.0, 3.0]), vector([-4.0, 0.5, 2.0]));
    near("dot", a.dot(b), 3.0, 0.0);
    equal("cross", a.cross(b), [2.5, -14.0, 8.5]);
    equal("mul_add", a.mul_add(l.f(2.0), b), [-2.0, 4.5, 8.0]);
    equal("reflect", vector([0.6, 0.0, 0.8]).reflect(vector([0.0, 0.0, 1.0])), [-0.6, 0.0, 0.8]);
    equal("transform", a.transform([b, a, vector([0.0, 1.0, 0.0])]), [-2.0, 7.5, 8.0]);
    equal("normalize", vector([3.0, 0.0, 4.0]).normalize(), [0.6, 0.0, 0.8]);
    equal("normalize_or", vector([0.0; 3]).normalize_or(a), [1.0, 2.0, 3.0]);
    equal("normalize_or", vector([f32::INFINITY, 0.0, 0.0]).normalize_or(a), [1.0, 2.0, 3.0]);
    let colour = Rgb::splat(l, [1.0, 0.5, 0.25]);
    near("luminance", colour.luminance(), 0.2126 + 0.3576 + 0.01805, 1e-6);
}

#[test]
fn vectors_and_colours() {
    for execution in Execution::all() {
        dispatch!(execution, l => check_vectors(l));
    }
}

#[test]
fn columns_are_aligned_and_padded() {
    for len in [0, 1, 15, 16, 17, 4096, 5001] {
        let floats: Column = Column::new(len);
        let mut integers: Column<u32> = Column::new(len);
        assert_eq!((floats.len(), integers.len()), (padded(len), padded(len)));
        assert!(floats.len() >= len && floats.len() < len + PADDING);
        assert_eq!(floats.as_ptr() as usize % 64, 0);
        assert!(floats.iter().all(|x| *x == 0.0));
        integers.iter_mut().for_each(|x| *x = 5);
        let copy = integers.clone();
        assert_eq!(copy.as_ptr() as usize % 64, 0);
        assert!(copy.iter().all(|x| *x == 5));
    }
}

#[test]
fn levels_have_names() {
    let all = Execution::all();
    assert_eq!(all.last().map(Execution::name), Some("scalar"));
    for execution in &all {
        let again = Execution::named(&execution.name().to_uppercase());
        assert_eq!(again.map(|e| e.name()), Ok(execution.name()));
        assert!(execution.lanes().is_power_of_two() && execution.lanes() <= PADDING);
    }
    let message = Execution::named("abacus").map(|_| ()).expect_err("no such level").to_string();
    assert!(message.contains("'abacus'") && message.contains("scalar"), "{message}");
}
