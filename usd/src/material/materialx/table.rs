//! The nodes that are computed, one row each. What the standard library defines as a graph of others needs none: the rows of those that
//! stand here serve where the library is not at hand.

use super::super::emit::{add, divide, mix, multiply, subtract};
use super::Rule::{self, Each, Later, Of, Own};
use super::{
    adjust, channels, compositing, geometric, hair, hextile, math, matrices, noise, normals, pattern, physical, texture, transform,
};
use gonio::scene::Input;

/// A node.
pub(in crate::material) struct Row {
    /// Its category: `multiply`.
    pub(in crate::material) name: &'static str,
    /// How it is computed.
    pub(in crate::material) rule: Rule,
}

const fn row(name: &'static str, rule: Rule) -> Row {
    Row { name, rule }
}

/// `in`.
const ONE: &[(&str, f32)] = &[("in", 0.0)];
/// `in1`, `in2`.
const SUM: &[(&str, f32)] = &[("in1", 0.0), ("in2", 0.0)];
/// `in1` and a factor `in2`.
const PRODUCT: &[(&str, f32)] = &[("in1", 0.0), ("in2", 1.0)];
/// `fg` laid on `bg`.
const LAID: &[(&str, f32)] = &[("fg", 0.0), ("bg", 0.0), ("mix", 1.0)];

/// All rows.
pub(in crate::material) const ROWS: &[Row] = &[
    // Arithmetic.
    row("add", Of(SUM, |graph, v| add(graph, v[0], v[1]))),
    row("subtract", Of(SUM, |graph, v| subtract(graph, v[0], v[1]))),
    row("multiply", Of(PRODUCT, |graph, v| multiply(graph, v[0], v[1]))),
    row("divide", Of(PRODUCT, |graph, v| divide(graph, v[0], v[1]))),
    row("modulo", Of(PRODUCT, math::modulo)),
    row("fract", Of(ONE, math::fract)),
    row("invert", Of(&[("in", 0.0), ("amount", 1.0)], math::invert)),
    row("absval", Of(ONE, math::absolute)),
    row("floor", Of(ONE, math::floor)),
    row("ceil", Of(ONE, math::ceil)),
    row("round", Of(ONE, math::round)),
    row("sign", Of(ONE, math::sign)),
    row("power", Of(PRODUCT, math::power)),
    row("safepower", Of(PRODUCT, math::safe_power)),
    row("sqrt", Of(ONE, math::square_root)),
    row("exp", Of(ONE, math::exponential)),
    row("ln", Of(&[("in", 1.0)], math::logarithm)),
    row("min", Of(SUM, math::minimum)),
    row("max", Of(SUM, math::maximum)),
    row("clamp", Of(&[("in", 0.0), ("low", 0.0), ("high", 1.0)], math::clamp)),
    row("trianglewave", Of(ONE, math::triangle_wave)),
    // Trigonometry.
    row("sin", Of(ONE, math::sine)),
    row("cos", Of(ONE, math::cosine)),
    row("tan", Of(ONE, math::tangent)),
    row("asin", Of(ONE, math::arc_sine)),
    row("acos", Of(ONE, math::arc_cosine)),
    row("atan2", Of(&[("iny", 0.0), ("inx", 1.0)], math::arc_tangent)),
    // Vectors.
    row("normalize", Own(math::normalize)),
    row("magnitude", Own(math::magnitude)),
    row("distance", Own(math::distance)),
    row("dotproduct", Own(math::dot_product)),
    row("crossproduct", Of(SUM, math::cross)),
    row("reflect", Own(math::reflect)),
    // Comparison and logic.
    row("ifgreater", Own(math::if_compared)),
    row("ifgreatereq", Own(math::if_compared)),
    row("ifequal", Own(math::if_compared)),
    row("switch", Own(math::switch)),
    row("and", Of(SUM, math::and)),
    row("or", Of(SUM, math::or)),
    row("xor", Of(SUM, math::xor)),
    row("not", Of(ONE, math::not)),
    // Channels.
    row("constant", Own(channels::constant)),
    row("dot", Own(channels::as_it_is)),
    row("convert", Own(channels::convert)),
    row("swizzle", Own(channels::swizzle)),
    row("extract", Own(channels::extract)),
    row("separate2", Own(channels::as_it_is)),
    row("separate3", Own(channels::as_it_is)),
    row("separate4", Own(channels::as_it_is)),
    row("combine2", Own(channels::combine_2)),
    row("combine3", Of(&[("in1", 0.0), ("in2", 0.0), ("in3", 0.0)], channels::combine_parts)),
    row("combine4", Of(&[("in1", 0.0), ("in2", 0.0), ("in3", 0.0), ("in4", 0.0)], channels::combine_parts)),
    // Compositing.
    row("mix", Of(&[("fg", 0.0), ("bg", 0.0), ("mix", 0.0)], |graph, v: &[Input]| mix(graph, v[1], v[0], v[2]))),
    row("plus", Of(LAID, compositing::plus)),
    row("minus", Of(LAID, compositing::minus)),
    row("difference", Of(LAID, compositing::difference)),
    row("burn", Of(LAID, compositing::burn)),
    row("dodge", Of(LAID, compositing::dodge)),
    row("screen", Of(LAID, compositing::screen)),
    row("overlay", Of(LAID, adjust::overlay)),
    row("disjointover", Of(LAID, compositing::disjoint_over)),
    row("in", Of(LAID, compositing::inside_ground)),
    row("mask", Of(LAID, compositing::mask)),
    row("matte", Of(LAID, compositing::matte)),
    row("out", Of(LAID, compositing::outside_ground)),
    row("over", Of(LAID, compositing::over)),
    row("inside", Of(&[("in", 0.0), ("mask", 1.0)], compositing::inside)),
    row("outside", Of(&[("in", 0.0), ("mask", 0.0)], compositing::outside)),
    row("premult", Own(|network, shader, _| network.with_opaque(shader, compositing::premultiply))),
    row("unpremult", Own(|network, shader, _| network.with_opaque(shader, compositing::unpremultiply))),
    // Adjustment.
    row("remap", Of(&[("in", 0.0), ("inlow", 0.0), ("inhigh", 1.0), ("outlow", 0.0), ("outhigh", 1.0)], adjust::remap)),
    row("smoothstep", Of(&[("in", 0.0), ("low", 0.0), ("high", 1.0)], adjust::smoothstep)),
    row("contrast", Of(&[("in", 0.0), ("amount", 1.0), ("pivot", 0.5)], adjust::contrast)),
    row(
        "range",
        Of(
            &[("in", 0.0), ("inlow", 0.0), ("inhigh", 1.0), ("gamma", 1.0), ("outlow", 0.0), ("outhigh", 1.0), ("doclamp", 0.0)],
            adjust::range,
        ),
    ),
    row("luminance", Own(adjust::luminance)),
    row("saturate", Own(adjust::saturate)),
    row("hsvadjust", Own(adjust::hsv_adjust)),
    row("rgbtohsv", Of(ONE, math::to_hsv)),
    row("hsvtorgb", Of(ONE, math::to_rgb)),
    // Patterns.
    row("ramplr", Own(pattern::ramp_lr)),
    row("ramptb", Own(pattern::ramp_tb)),
    row("ramp4", Own(pattern::ramp_4)),
    row("splitlr", Own(pattern::split_lr)),
    row("splittb", Own(pattern::split_tb)),
    row("noise2d", Own(noise::noise_2d)),
    row("noise3d", Own(noise::noise_3d)),
    row("fractal2d", Own(noise::fractal_2d)),
    row("fractal3d", Own(noise::fractal_3d)),
    row("cellnoise2d", Own(noise::cells_2d)),
    row("cellnoise3d", Own(noise::cells_3d)),
    row("worleynoise2d", Own(noise::worley_2d)),
    row("worleynoise3d", Own(noise::worley_3d)),
    row("flake2d", Later),
    row("flake3d", Later),
    row("hextilednormalmap", Later),
    // Images.
    row("image", Own(texture::image)),
    row("tiledimage", Own(texture::image)),
    row("hextiledimage", Own(hextile::image)),
    // The place on the surface, and the frame.
    row("position", Own(geometric::position)),
    row("normal", Own(geometric::normal)),
    row("tangent", Own(geometric::tangent)),
    row("bitangent", Own(geometric::bitangent)),
    row("viewdirection", Own(geometric::view_direction)),
    row("texcoord", Own(geometric::coordinates)),
    row("geomcolor", Own(geometric::colours)),
    row("geompropvalue", Own(geometric::property)),
    row("geompropvalueuniform", Own(geometric::property)),
    row("frame", Own(geometric::frame)),
    row("time", Own(geometric::time)),
    // Transforms.
    row("transformpoint", Own(geometric::transform)),
    row("transformvector", Own(geometric::transform)),
    row("transformnormal", Own(geometric::transform)),
    row("transformmatrix", Own(matrices::transform)),
    row("determinant", Own(matrices::determinant)),
    row("rotate2d", Own(transform::rotate_2d)),
    row("rotate3d", Own(transform::rotate_3d)),
    row("place2d", Own(transform::place_2d)),
    // Normals.
    row("normalmap", Own(normals::normal_map)),
    row("heighttonormal", Own(normals::height_to_normal)),
    // Physically based shading.
    row("roughness_anisotropy", Of(&[("roughness", 0.0), ("anisotropy", 0.0)], physical::roughness_anisotropy)),
    row("roughness_dual", Of(&[("roughness", 0.0)], physical::roughness_dual)),
    row("artistic_ior", Each(physical::artistic_ior)),
    row("blackbody", Own(physical::blackbody)),
    row("chiang_hair_roughness", Each(hair::roughness)),
    row("deon_hair_absorption_from_melanin", Own(hair::from_melanin)),
    row("chiang_hair_absorption_from_color", Own(hair::from_color)),
];
