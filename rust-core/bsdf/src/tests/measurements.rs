//! Measurements of every kind, made up from closed forms and from random numbers.

use core::f64::consts::{FRAC_PI_2, PI, TAU};
use gonio_formats::bsdf::{
    Axis, Band, Basis, Channels, Component, Coordinates, Direction, Hemispheres, Layout, Matrix, Measured, Mode, Patches, Rgl, RglGrid,
    Table, TensorTree, Tree,
};

/// Uniform numbers in [0, 1): a counter through a 64-bit mixer (SplitMix64).
pub(super) fn uniform(counter: u64) -> f64 {
    let mut z = counter.wrapping_mul(0x9e37_79b9_7f4a_7c15);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
}

/// GGX with height-correlated Smith shadowing (Heitz 2014) and Fresnel 1, 1/sr.
pub(super) fn ggx(alpha: [f64; 2], wi: Direction, wo: Direction) -> f64 {
    let sum = [wi[0] + wo[0], wi[1] + wo[1], wi[2] + wo[2]];
    let length = (sum[0] * sum[0] + sum[1] * sum[1] + sum[2] * sum[2]).sqrt();
    if wi[2] <= 0.0 || wo[2] <= 0.0 || length == 0.0 {
        return 0.0;
    }
    let h = sum.map(|x| x / length);
    let slope = (h[0] / alpha[0]).powi(2) + (h[1] / alpha[1]).powi(2) + h[2] * h[2];
    let stretch = |d: Direction| ((alpha[0] * d[0]).powi(2) + (alpha[1] * d[1]).powi(2) + d[2] * d[2]).sqrt();
    0.5 / (PI * alpha[0] * alpha[1] * slope * slope * (stretch(wi) * wo[2] + stretch(wo) * wi[2]))
}

/// A grey GGX and a coloured diffuse part.
fn coated(alpha: [f64; 2], wi: Direction, wo: Direction) -> [f64; 3] {
    let glossy = 0.6 * ggx(alpha, wi, wo);
    [0.3, 0.2, 0.1].map(|diffuse| glossy + diffuse / PI)
}

fn axis(knots: Vec<f64>, mode: Mode) -> Axis {
    Axis::new(knots, mode).expect("increasing knots")
}

/// Angles that lie denser near the start.
fn uneven(last: f64, count: usize) -> Axis {
    axis((0..count).map(|i| last * (i as f64 / (count - 1) as f64).powf(1.3)).collect(), Mode::Linear)
}

fn turn(count: usize) -> Axis {
    axis((0..count).map(|i| TAU * i as f64 / count as f64).collect(), Mode::Periodic { period: TAU })
}

/// A table of what `value` says in the four pairs of hemispheres' common frame.
fn table(
    coordinates: Coordinates,
    axes: Vec<Axis>,
    hemispheres: Hemispheres,
    [reciprocal, bilateral]: [bool; 2],
    value: impl Fn(Direction, Direction) -> [f64; 3],
) -> Table {
    let layout = Layout { coordinates, axes, channels: Channels::Rgb, hemispheres, reciprocal, bilateral };
    let fill = |wi: Direction, wo: Direction, out: &mut [f32]| {
        let near = |d: Direction| [d[0], d[1], d[2].max(1e-3)];
        value(near(wi), near(wo)).iter().zip(out).for_each(|(value, out)| *out = *value as f32);
    };
    Table::from_function(layout, fill).expect("a value for each cell")
}

/// θi, θo, Δφ of half a turn, reflection alone.
pub(super) fn isotropic() -> Measured {
    let axes = vec![uneven(1.5, 24), uneven(1.5, 24), uneven(PI, 36)];
    Measured::Tables(vec![table(Coordinates::Isotropic, axes, Hemispheres::ReflectionFront, [true, true], |wi, wo| {
        coated([0.3, 0.3], wi, wo)
    })])
}

/// θi, φi, θo, φo on the paper's grid, some cells not measured: of these the other sense holds.
pub(super) fn anisotropic() -> Measured {
    let axes = vec![uneven(1.4, 17), turn(7), uneven(1.5, 17), turn(13)];
    let whole = table(Coordinates::Anisotropic, axes, Hemispheres::ReflectionFront, [true, false], |wi, wo| coated([0.25, 0.5], wi, wo));
    let mut values = whole.values().to_vec();
    for (cell, values) in values.chunks_exact_mut(3).enumerate() {
        if uniform(cell as u64) < 0.02 || uniform(7_000_000 + (cell / 13) as u64) < 0.02 {
            values.fill(f32::NAN);
        }
    }
    Measured::Tables(vec![Table::new(whole.layout().clone(), values).expect("as many values as before")])
}

/// θh, θd, φd: MERL's coordinates.
pub(super) fn half_difference() -> Measured {
    let theta_h = axis((0..90).map(|i| FRAC_PI_2 * ((i as f64 + 0.5) / 90.0).powi(2)).collect(), Mode::Linear);
    let axes = vec![theta_h, uneven(FRAC_PI_2, 30), axis((0..60).map(|i| PI * i as f64 / 60.0).collect(), Mode::Periodic { period: PI })];
    Measured::Tables(vec![table(Coordinates::HalfDifference, axes, Hemispheres::ReflectionFront, [false, false], |wi, wo| {
        coated([0.2, 0.2], wi, wo)
    })])
}

/// Zemax's coordinates: reflection of both sides, and transmission about the straight direction from the front.
pub(super) fn specular() -> Measured {
    let axes = || vec![turn(5), uneven(1.4, 12), turn(16), uneven(2.5, 40)];
    let about = |pair, scale: f64| {
        table(Coordinates::Specular, axes(), pair, [false, false], move |wi, wo| coated([0.4, 0.3], wi, wo).map(|x| scale * x))
    };
    let pairs = [(Hemispheres::ReflectionFront, 0.3), (Hemispheres::ReflectionBack, 0.5), (Hemispheres::TransmissionFront, 0.4)];
    Measured::Tables(pairs.map(|(pair, scale)| about(pair, scale)).to_vec())
}

/// An isotropic adaptive measurement.
pub(super) fn adaptive() -> Measured {
    let grid = RglGrid::isotropic(8, 1.45, [64, 32], 32);
    let value = |wi: Direction, wo: Direction| coated([0.3, 0.3], wi, wo).map(|x| x * wi[2].max(0.0));
    Measured::Rgl(Box::new(Rgl::from_function(&grid, "", value).expect("a sound grid")))
}

/// An anisotropic one.
pub(super) fn adaptive_anisotropic() -> Measured {
    let grid = RglGrid::anisotropic(9, 5, 1.4, [32, 48], 20);
    let value = |wi: Direction, wo: Direction| coated([0.25, 0.5], wi, wo).map(|x| x * wi[2].max(0.0));
    Measured::Rgl(Box::new(Rgl::from_function(&grid, "", value).expect("a sound grid")))
}

/// Adaptive measurements by wavelength, in uneven steps and beyond what is seen: at each a mixture of the three channels of one in colour, under a film
/// that is thicker from node to node.
pub(super) fn by_wavelength(measured: Measured) -> Measured {
    let Measured::Rgl(mut rgl) = measured else { return measured };
    let wavelengths: Vec<f64> = (0..50).map(|i| f64::from(360 + 10 * i + 3 * (i % 3))).collect();
    let nodes = rgl.spectra.rows * rgl.spectra.columns;
    let mut data = Vec::new();
    for slice in rgl.spectra.data.chunks_exact(3 * nodes) {
        for nm in &wavelengths {
            let shares = [nm / 500.0, 1.0 + (nm / 30.0).sin(), 0.5 + 0.5 * (nm / 90.0).cos()];
            let film = |node: usize| (1.0 + 0.5 * (TAU * 900.0 * node as f64 / nodes as f64 / nm).cos()) as f32;
            let mixture = |node: usize| (0..3).map(|c| shares[c] as f32 * slice[c * nodes + node]).sum::<f32>();
            data.extend((0..nodes).map(|node| film(node) * mixture(node)));
        }
    }
    rgl.spectra.data = data;
    rgl.spectra.parameters[2] = (0..wavelengths.len()).map(|band| band as f32).collect();
    rgl.channels = Channels::bands(wavelengths).expect("increasing wavelengths");
    Measured::Rgl(rgl)
}

/// Coloured matrices of reflection and transmission over two bases.
pub(super) fn patches() -> Measured {
    let own = Basis::new("own", &[0.0, 12.0, 40.0, 90.0], &[1, 6, 9]).expect("a sound basis");
    let bases = vec![Basis::known("LBNL/Klems Half").expect("a known basis"), own];
    let mut matrices = Vec::new();
    for (seed, pair) in [Hemispheres::ReflectionFront, Hemispheres::ReflectionBack, Hemispheres::TransmissionFront].into_iter().enumerate()
    {
        for (band, scale) in [(Band::Visible, 0.2), (Band::CieX, 0.18), (Band::CieZ, 0.1)] {
            let count = bases[0].count() * bases[1].count();
            let values = (0..count).map(|i| (scale * uniform((seed * 100_000 + i) as u64)) as f32).collect();
            matrices.push(Matrix::new(pair, band, 0, 1, values));
        }
    }
    Measured::Patches(Patches::new(bases, matrices).expect("sound matrices"))
}

/// Trees of reflection and transmission with leaves at several depths.
pub(super) fn trees(rank: u32) -> Measured {
    let children = 1_u32 << rank;
    let tree = |seed: u64| {
        let mut tree = Tree { rank, first: vec![1, 1 + children], log2: vec![-1, -1], values: Vec::new() };
        for (leaves, log2) in [(children - 1, 2_u32), (children, 0)] {
            for _ in 0..leaves {
                tree.first.push(tree.values.len() as u32);
                tree.log2.push(log2 as i8);
                let first = tree.values.len() as u64;
                tree.values.extend((0..1_u64 << (log2 * rank)).map(|i| (0.3 * uniform(seed + first + i)) as f32));
            }
        }
        tree
    };
    let mut components = Vec::new();
    for (seed, hemispheres) in [Hemispheres::ReflectionFront, Hemispheres::TransmissionFront].into_iter().enumerate() {
        for (place, band) in [Band::Visible, Band::CieX, Band::CieZ].into_iter().enumerate() {
            components.push(Component { hemispheres, band, tree: tree(((seed * 3 + place) << 20) as u64) });
        }
    }
    Measured::Tree(TensorTree::new(components).expect("trees"))
}

/// One of each kind.
pub(super) fn all() -> Vec<(&'static str, Measured)> {
    vec![
        ("isotropic table", isotropic()),
        ("anisotropic table", anisotropic()),
        ("half/difference table", half_difference()),
        ("specular table", specular()),
        ("adaptive", adaptive()),
        ("anisotropic adaptive", adaptive_anisotropic()),
        ("patches", patches()),
        ("tree of rank 3", trees(3)),
        ("tree of rank 4", trees(4)),
    ]
}
