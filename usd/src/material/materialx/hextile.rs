//! Images that are repeated in hexagons, each turned, scaled and moved at random (Mikkelsen, Practical Real-Time Hex-Tiling, JCGT 2022): three
//! tiles are blended at each place.

use super::super::emit::{add, binary, combine, component, divide, less, mix, multiply, rest, scalar, subtract, unary};
use super::super::network::{Network, Shader};
use super::super::varying::Image;
use super::math::{dot, fract};
use super::texture::fallback;
use gonio::scene::{Graph, Input, Operation, WrapMode};

/// Edges of a tile's image in edges of the grid of triangles.
const FIT: f32 = 3.464_101_6;
/// The slant of the grid, and its way back.
const SLANT: [f32; 3] = [-0.577_350_27, 1.154_700_5, 0.866_025_4];
/// Moves the seeds of tiles away from zero.
const SEED: f32 = 0.123_45;

/// One of the three tiles at a place.
struct Tile {
    /// Where the image is looked up.
    coordinates: Input,
    /// Its share before blending.
    weight: Input,
}

pub(super) fn image(network: &mut Network<'_>, shader: &Shader, kind: &str) -> Option<Input> {
    let fallback = fallback(network, shader, kind);
    let Some(texture) = network.texture(shader, None, "auto") else { return Some(fallback) };
    let tiles = tiles(network, shader);
    let image = Image::plain(texture, [WrapMode::Repeat; 2], fallback);
    let texels = tiles.each_ref().map(|tile| image.at(&mut network.graph, tile.coordinates));
    let [contrast, falloff] = network.inputs(shader, [("falloffcontrast", 0.5), ("falloff", 0.5)]);
    let weights = network.input(shader, "lumacoeffs").unwrap_or(Input::Constant([0.272_228_7, 0.674_081_8, 0.053_689_5, 1.0]));
    let graph = &mut network.graph;
    let lights = texels.map(|texel| {
        let grey = dot(graph, texel, weights, 3);
        mix(graph, scalar(1.0), grey, contrast)
    });
    let colours = blend(graph, &tiles, lights, falloff);
    let colour = weighted(graph, texels, colours);
    if !kind.ends_with('4') {
        return Some(colour);
    }
    let alphas = blend(graph, &tiles, [scalar(1.0); 3], falloff);
    let alpha = weighted(graph, texels, alphas);
    let parts = [component(colour, 0), component(colour, 1), component(colour, 2), component(alpha, 3)];
    Some(combine(graph, &parts))
}

fn weighted(graph: &mut Graph, values: [Input; 3], weights: [Input; 3]) -> Input {
    let mut sum = scalar(0.0);
    for (value, weight) in values.into_iter().zip(weights) {
        let part = multiply(graph, value, weight);
        sum = add(graph, sum, part);
    }
    sum
}

/// Shares of the tiles: the seventh power of their weights times `factors`, made steeper or flatter by `falloff`.
fn blend(graph: &mut Graph, tiles: &[Tile; 3], factors: [Input; 3], falloff: Input) -> [Input; 3] {
    let mut shares = factors;
    for (share, tile) in shares.iter_mut().zip(tiles) {
        let square = multiply(graph, tile.weight, tile.weight);
        let cube = multiply(graph, square, tile.weight);
        let sixth = multiply(graph, cube, cube);
        let seventh = multiply(graph, sixth, tile.weight);
        *share = multiply(graph, *share, seventh);
    }
    let shares = normalized(graph, shares);
    if falloff == scalar(0.5) {
        return shares;
    }
    let gained = shares.map(|share| gain(graph, share, falloff));
    normalized(graph, gained)
}

fn normalized(graph: &mut Graph, shares: [Input; 3]) -> [Input; 3] {
    let sum = add(graph, shares[0], shares[1]);
    let sum = add(graph, sum, shares[2]);
    shares.map(|share| component(divide(graph, share, sum), 0))
}

/// Schlick's gain (Graphics Gems IV, 1994).
fn gain(graph: &mut Graph, x: Input, r: Input) -> Input {
    let r = super::super::emit::clamp(graph, r, scalar(0.001), scalar(0.999));
    let inverse = divide(graph, scalar(1.0), r);
    let steepness = subtract(graph, inverse, scalar(2.0));
    let twice = multiply(graph, x, scalar(2.0));
    let side = rest(graph, twice);
    let a = multiply(graph, steepness, side);
    let more = add(graph, a, scalar(1.0));
    let low = divide(graph, x, more);
    let (over, under) = (subtract(graph, a, x), subtract(graph, a, scalar(1.0)));
    let high = divide(graph, over, under);
    let is_low = less(graph, x, scalar(0.5));
    component(mix(graph, high, low, is_low), 0)
}

/// The tiles whose centres are the corners of the triangle that a place lies in.
fn tiles(network: &mut Network<'_>, shader: &Shader) -> [Tile; 3] {
    let coordinates = network.geometric_input(shader, "texcoord", "UV0");
    let [tiling, rotation, scale, offset] = network.inputs(shader, [("tiling", 1.0), ("rotation", 1.0), ("scale", 1.0), ("offset", 1.0)]);
    let mut pair = |name: &str, [x, y]: [f32; 2]| network.input(shader, name).unwrap_or(Input::Constant([x, y, 0.0, 1.0]));
    let turns = pair("rotationrange", [0.0, 360.0]);
    let (sizes, moves) = (pair("scalerange", [0.5, 2.0]), pair("offsetrange", [0.0, 1.0]));
    let graph = &mut network.graph;
    let place = multiply(graph, coordinates, tiling);
    let grid = multiply(graph, place, scalar(FIT));
    let slanted_x = multiply(graph, component(grid, 1), scalar(SLANT[0]));
    let slanted_x = add(graph, component(grid, 0), slanted_x);
    let slanted_y = multiply(graph, component(grid, 1), scalar(SLANT[1]));
    let slanted = combine(graph, &[component(slanted_x, 0), component(slanted_y, 0)]);
    let cell = unary(graph, Operation::Floor, slanted);
    let inside = fract(graph, &[slanted]);
    let (x, y) = (component(inside, 0), component(inside, 1));
    let sum = add(graph, x, y);
    let excess = subtract(graph, sum, scalar(1.0));
    // 1 in the upper triangle of the cell.
    let below = less(graph, excess, scalar(0.0));
    let upper = component(rest(graph, below), 0);
    let lower = rest(graph, upper);
    let (far_x, far_y) = (rest(graph, x), rest(graph, y));
    let weights = [unary(graph, Operation::Absolute, excess), mix(graph, y, far_y, upper), mix(graph, x, far_x, upper)];
    let corners = [[upper, upper], [upper, lower], [lower, upper]];
    let ranges = [(turns, rotation), (sizes, scale), (moves, offset)];
    let mut number = 0;
    weights.map(|weight| {
        let corner = combine(graph, &corners[number].map(|part| component(part, 0)));
        number += 1;
        let name = add(graph, cell, corner);
        Tile { coordinates: tile_coordinates(graph, place, name, ranges), weight: component(weight, 0) }
    })
}

/// Where a tile's image is looked up: turned and scaled about its centre, and moved.
fn tile_coordinates(graph: &mut Graph, place: Input, name: Input, [turns, sizes, moves]: [(Input, Input); 3]) -> Input {
    let half = multiply(graph, component(name, 1), scalar(0.5));
    let across = add(graph, component(name, 0), half);
    let up = multiply(graph, component(name, 1), scalar(SLANT[2]));
    let centre = combine(graph, &[component(across, 0), component(up, 0)]);
    let centre = multiply(graph, centre, scalar(1.0 / FIT));
    let random = hash(graph, name);
    let share = multiply(graph, component(random, 0), turns.1);
    let degrees = mix(graph, component(turns.0, 0), component(turns.0, 1), share);
    let angle = multiply(graph, degrees, scalar(std::f32::consts::PI / 180.0));
    let (sin, cos) = (unary(graph, Operation::Sine, angle), unary(graph, Operation::Cosine, angle));
    let size = mix(graph, component(sizes.0, 0), component(sizes.0, 1), component(random, 1));
    let size = mix(graph, scalar(1.0), size, sizes.1);
    let share = multiply(graph, random, moves.1);
    let shift = mix(graph, component(moves.0, 0), component(moves.0, 1), share);
    let from = subtract(graph, place, centre);
    let (x, y) = (component(from, 0), component(from, 1));
    let (cos_x, sin_y) = (multiply(graph, x, cos), multiply(graph, y, sin));
    let (sin_x, cos_y) = (multiply(graph, x, sin), multiply(graph, y, cos));
    let (a, b) = (subtract(graph, cos_x, sin_y), add(graph, sin_x, cos_y));
    let turned = combine(graph, &[component(a, 0), component(b, 0)]);
    let scaled = divide(graph, turned, size);
    let back = add(graph, scaled, centre);
    add(graph, back, shift)
}

/// Two numbers between 0 and 1 of a tile's name.
fn hash(graph: &mut Graph, name: Input) -> Input {
    let seed = add(graph, name, scalar(SEED));
    let spread = combine(graph, &[component(seed, 0), component(seed, 1), component(seed, 0)]);
    let scaled = multiply(graph, spread, Input::Constant([0.1031, 0.1030, 0.0973, 0.0]));
    let p = fract(graph, &[scaled]);
    let turned = combine(graph, &[component(p, 1), component(p, 2), component(p, 0)]);
    let lifted = add(graph, turned, scalar(33.33));
    let mixed = component(binary(graph, Operation::Dot, p, lifted), 0);
    let p = add(graph, p, mixed);
    let pairs = [(1, 2), (2, 1)].map(|(a, b)| {
        let sum = add(graph, component(p, 0), component(p, a));
        component(multiply(graph, sum, component(p, b)), 0)
    });
    let pairs = combine(graph, &pairs);
    fract(graph, &[pairs])
}
