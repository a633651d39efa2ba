//! Shading graphs over batches of hits: arithmetic, colours, procedural textures.

use crate::{
    kernel::{Case, Kernel, Outcome},
    numbers::{BATCH, cube},
};
use gonio::error::Result;
use gonio::scene::{Channel, Graph, Input, NodeId, Operation};
use gonio_nodes::{
    BrickTexture, CHUNK, Code, GaborTexture, Hit, MagicTexture, NoiseKind, NoiseTexture, Program, Registers, Source, WaveTexture,
    voronoi::{CellHash, Feature, Metric, Part, VoronoiTexture},
};
use gonio_simd::{Column, Execution, Lanes, dispatch};

/// Nodes of the graph of arithmetic alone.
const ARITHMETIC_NODES: usize = 60;
/// Texture coordinates in units of a texture.
const EXTENT: f32 = 40.0;

/// A program over positions all over a cube.
struct Shading {
    program: Program<()>,
    sources: Vec<Source>,
    positions: [Column; 3],
    registers: Registers,
    out: Column,
}

pub(super) fn cases() -> Vec<Case> {
    let noise = |dimensions, kind| Operation::NoiseTexture(NoiseTexture { dimensions, kind, normalize: true, color: false });
    let voronoi = |feature, metric| {
        let hash = CellHash::Pcg;
        Operation::VoronoiTexture(VoronoiTexture { dimensions: 3, feature, metric, normalize: false, hash, part: Part::ColorDistance })
    };
    // Scale, detail, roughness, lacunarity, offset, gain, distortion.
    let octaves = [1.0, 4.0, 0.5, 2.0, 0.0, 1.0, 0.0];
    // Scale, detail, roughness, lacunarity, smoothness, exponent, randomness.
    let cells = [1.0, 0.0, 0.5, 2.0, 1.0, 0.5, 1.0];
    let bricks = BrickTexture { offset: 0.5, offset_frequency: 2, squash: 1.0, squash_frequency: 2 };
    vec![
        shading("60 nodes of arithmetic", arithmetic),
        shading("hue and back", |graph, place| {
            let turned = graph.add(Operation::RgbToHsv, vec![place]);
            graph.add(Operation::HsvToRgb, vec![whole(turned)])
        }),
        texture("noise fBm 3D", noise(3, NoiseKind::Fbm), true, &octaves),
        texture("noise ridged 4D", noise(4, NoiseKind::RidgedMultifractal), true, &octaves),
        texture("Voronoi F1 3D", voronoi(Feature::F1, Metric::Euclidean), true, &cells),
        texture("Voronoi smooth F1 3D", voronoi(Feature::SmoothF1, Metric::Euclidean), true, &cells),
        texture("Voronoi edges 3D", voronoi(Feature::DistanceToEdge, Metric::Euclidean), true, &cells),
        texture("wave", Operation::WaveTexture(WaveTexture::default()), false, &[1.0, 2.0, 2.0, 1.0, 0.5, 0.0]),
        texture("magic", Operation::MagicTexture(MagicTexture { depth: 2 }), false, &[1.0, 1.0]),
        texture("brick", Operation::BrickTexture(bricks), false, &[1.0, 0.02, 0.1, 0.0, 0.5, 0.25]),
        texture("Gabor 3D", Operation::GaborTexture(GaborTexture { dimensions: 3 }), false, &[1.0, 2.0, 1.0, 0.785, 0.577]),
    ]
}

fn whole(node: NodeId) -> Input {
    Input::Node(node, Channel::Rgb)
}

/// One texture at the positions, after `w` where it has that, with constants for the other inputs.
fn texture(name: &str, operation: Operation, has_w: bool, inputs: &[f32]) -> Case {
    shading(name, |graph, place| {
        let Input::Node(node, _) = place else { return graph.add(operation, Vec::new()) };
        let w = has_w.then_some(Input::Node(node, Channel::R));
        let constants = inputs.iter().map(|value| Input::Constant([*value; 4]));
        graph.add(operation, [place].into_iter().chain(w).chain(constants).collect())
    })
}

/// Sums, products, ramps and roots in a row, each reading the one before and the position.
fn arithmetic(graph: &mut Graph, place: Input) -> NodeId {
    let mut last = graph.add(Operation::Absolute, vec![place]);
    for number in 1..ARITHMETIC_NODES {
        let half = Input::Constant([0.5; 4]);
        last = match number % 6 {
            0 => graph.add(Operation::Add, vec![whole(last), place]),
            1 => graph.add(Operation::Multiply, vec![whole(last), half]),
            2 => graph.add(Operation::Mix, vec![whole(last), place, half]),
            3 => graph.add(Operation::SquareRoot, vec![whole(last)]),
            4 => graph.add(Operation::Sine, vec![whole(last)]),
            _ => graph.add(Operation::Maximum, vec![whole(last), half]),
        };
    }
    last
}

/// A graph whose last node `build` gives, for a place that varies; a distance is the fourth component, other values are the first.
fn shading(name: &str, build: impl FnOnce(&mut Graph, Input) -> NodeId) -> Case {
    let mut graph = Graph::default();
    let place = whole(graph.add(Operation::Position, Vec::new()));
    let last = build(&mut graph, place);
    let code = Code::new(&graph, |_, _| Hit::Step(()));
    let value = code.value(whole(last));
    let looked_at = if matches!(graph.nodes[usize::from(last.0)].operation, Operation::VoronoiTexture(_)) { value[3] } else { value[0] };
    let (program, sources) = Program::new(&code, &[looked_at]);
    let mut positions = cube();
    positions.iter_mut().flat_map(|column| column.iter_mut()).for_each(|x| *x *= EXTENT);
    let out = Column::new(BATCH);
    Case::new(name, "hit", BATCH, Shading { program, sources, positions, registers: Registers::default(), out })
}

impl Kernel for Shading {
    fn run(&mut self, execution: Execution) -> Result<()> {
        dispatch!(execution, l => shade(l, self));
        Ok(())
    }
    fn outcome(&self) -> Outcome {
        Outcome::of([&self.out[..]])
    }
}

#[inline(always)]
fn shade<L: Lanes>(l: L, shading: &mut Shading) {
    let Shading { program, sources, positions, registers, out } = shading;
    let piece = program.piece();
    for first in (0..BATCH).step_by(piece) {
        program.run(l, piece.min(CHUNK), registers, |(), io| {
            for (component, column) in positions.iter().enumerate() {
                io.output(component)[..piece].copy_from_slice(&column[first..first + piece]);
            }
        });
        for at in (0..piece).step_by(L::COUNT) {
            registers.read(l, sources[0], at).store(out, first + at);
        }
    }
}
