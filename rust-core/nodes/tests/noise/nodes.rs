//! All noise nodes under one name, for tests.

use gonio_nodes::{
    MagicTexture, MxCellNoise, MxFractal, MxNoise, MxWorley, MxWorleyStyle, NoiseKind, NoiseTexture, WaveProfile, WaveShape, WaveTexture,
    WhiteNoise,
};
use gonio_simd::{Execution, F, Lanes, dispatch};

/// Points that are worked on together.
pub(crate) const POINTS: usize = 16;

/// A node with its settings.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Node {
    Noise(NoiseTexture),
    White(WhiteNoise),
    Wave(WaveTexture),
    Magic(MagicTexture),
    MxNoise(MxNoise),
    MxCell(MxCellNoise),
    MxFractal(MxFractal),
    MxWorley(MxWorley),
}

pub(crate) const KINDS: [NoiseKind; 5] =
    [NoiseKind::Fbm, NoiseKind::Multifractal, NoiseKind::HybridMultifractal, NoiseKind::RidgedMultifractal, NoiseKind::HeteroTerrain];
pub(crate) const SHAPES: [WaveShape; 8] = [
    WaveShape::BandsX,
    WaveShape::BandsY,
    WaveShape::BandsZ,
    WaveShape::BandsDiagonal,
    WaveShape::RingsX,
    WaveShape::RingsY,
    WaveShape::RingsZ,
    WaveShape::RingsSpherical,
];
pub(crate) const PROFILES: [WaveProfile; 3] = [WaveProfile::Sine, WaveProfile::Saw, WaveProfile::Triangle];

impl Node {
    /// The inputs' names.
    pub(crate) fn inputs(&self) -> &'static [&'static str] {
        match self {
            Self::Noise(_) => &NoiseTexture::INPUTS,
            Self::White(_) => &WhiteNoise::INPUTS,
            Self::Wave(_) => &WaveTexture::INPUTS,
            Self::Magic(_) => &MagicTexture::INPUTS,
            Self::MxNoise(_) => &MxNoise::INPUTS,
            Self::MxCell(_) => &MxCellNoise::INPUTS,
            Self::MxFractal(_) => &MxFractal::INPUTS,
            Self::MxWorley(_) => &MxWorley::INPUTS,
        }
    }

    /// What the node gives for the points, by output, zero beyond its outputs.
    pub(crate) fn evaluate(&self, execution: Execution, inputs: &[[f32; POINTS]]) -> [[f32; POINTS]; 4] {
        let node = *self;
        let mut out = [[0.0; POINTS]; 4];
        dispatch!(execution, l => run(l, node, inputs, &mut out));
        out
    }

    /// The nodes with every setting.
    pub(crate) fn all() -> Vec<Self> {
        let mut all = Vec::new();
        for dimensions in 1..=4 {
            for kind in KINDS {
                for (normalize, color) in [(true, true), (false, false)] {
                    all.push(Self::Noise(NoiseTexture { dimensions, kind, normalize, color }));
                }
            }
            all.push(Self::White(WhiteNoise { dimensions, color: true }));
        }
        for shape in SHAPES {
            all.extend(PROFILES.map(|profile| Self::Wave(WaveTexture { shape, profile })));
        }
        all.extend((0..=11).map(|depth| Self::Magic(MagicTexture { depth })));
        for dimensions in [2, 3] {
            for channels in 1..=4 {
                all.push(Self::MxNoise(MxNoise { dimensions, channels }));
                all.push(Self::MxFractal(MxFractal { dimensions, channels }));
                all.push(Self::MxCell(MxCellNoise { dimensions, channels: if channels == 1 { 1 } else { 3 } }));
                for style in [MxWorleyStyle::Distance, MxWorleyStyle::Solid] {
                    all.push(Self::MxWorley(MxWorley { dimensions, channels: channels.min(3), style }));
                }
            }
        }
        all
    }
}

#[inline(always)]
fn run<L: Lanes>(l: L, node: Node, inputs: &[[f32; POINTS]], out: &mut [[f32; POINTS]; 4]) {
    macro_rules! pass {
        ($node:expr) => {
            for at in (0..POINTS).step_by(L::COUNT) {
                let outputs = $node.evaluate(l, &load(l, inputs, at));
                for (out, output) in out.iter_mut().zip(outputs) {
                    output.store(out, at);
                }
            }
        };
    }
    match node {
        Node::Noise(node) => pass!(node),
        Node::White(node) => pass!(node),
        Node::Wave(node) => pass!(node),
        Node::Magic(node) => pass!(node),
        Node::MxNoise(node) => pass!(node),
        Node::MxCell(node) => pass!(node),
        Node::MxFractal(node) => pass!(node),
        Node::MxWorley(node) => pass!(node),
    }
}

#[inline(always)]
fn load<L: Lanes, const N: usize>(l: L, inputs: &[[f32; POINTS]], at: usize) -> [F<L>; N] {
    let mut out = [l.f(0.0); N];
    for (out, input) in out.iter_mut().zip(inputs) {
        *out = l.load(input, at);
    }
    out
}
