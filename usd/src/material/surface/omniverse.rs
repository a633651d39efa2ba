//! Omniverse's materials, whose code is in MDL files: `OmniPBR` with its variants and `OmniGlass`.

use super::parts::cut_by;
use crate::material::emit::{binary, colour, component, is_constant, luminance, mix, multiply, scalar, subtract};
use crate::material::network::{Network, Shader};
use crate::material::neutral::{Source, Value};
use crate::material::varying::{Image, placed};
use gonio::scene::{Closure, Input, Model, Operation, WrapMode};

/// Normal reflectance of a dielectric whose `specular_level` is 1.
const FULL_LEVEL: f32 = 0.08;

/// The closures of a material of Omniverse; `None` for other shaders.
pub(super) fn convert(network: &mut Network<'_>, shader: &Shader) -> Option<Vec<Closure>> {
    match shader.id.strip_prefix("mdl:")? {
        "OmniPBR" | "OmniPBRBase" | "OmniPBR_Opacity" | "OmniPBR_ClearCoat" | "OmniPBR_ClearCoat_Opacity" => {
            Some(vec![omni_pbr(network, shader)])
        }
        "OmniGlass" | "OmniGlass_Opacity" => Some(vec![omni_glass(network, shader)]),
        _ => None,
    }
}

/// The image of an input over the material's own placement; `None` where no image is named.
fn image(network: &mut Network<'_>, shader: &Shader, name: &str, unstated: &str) -> Option<Input> {
    match network.source(shader, name) {
        Source::Value(Value::Asset(path), _) if !path.authored.is_empty() => {}
        _ => return None,
    }
    let texture = network.texture_of(shader, name, None, unstated)?;
    let [scale, moved, turn] = network.inputs(shader, [("texture_scale", 1.0), ("texture_translate", 0.0), ("texture_rotate", 0.0)]);
    let mut coordinates = network.texture_coordinates(0);
    let is_as_it_lies =
        matches!((scale, moved, turn), (Input::Constant([1.0, 1.0, ..]), Input::Constant([0.0, 0.0, ..]), Input::Constant([0.0, ..])));
    if !is_as_it_lies {
        coordinates = placed(&mut network.graph, coordinates, scale, turn, moved);
    }
    let fallback = Input::Constant([0.0, 0.0, 0.0, 1.0]);
    Some(Image::plain(texture, [WrapMode::Repeat; 2], fallback).at(&mut network.graph, coordinates))
}

fn is_on(network: &mut Network<'_>, shader: &Shader, name: &str) -> bool {
    network.number(shader, name, 0.0) != 0.0
}

fn omni_pbr(network: &mut Network<'_>, shader: &Shader) -> Closure {
    let mut closure = Closure { model: Model::OpenPbr, ..Closure::default() };
    closure.set_input("base_color", albedo(network, shader));
    // Occlusion, roughness and metal may share an image.
    let shared = if is_on(network, shader, "enable_ORM_texture") { image(network, shader, "ORM_texture", "raw") } else { None };
    let roughness = shared.map(|image| component(image, 1)).or_else(|| image_value(network, shader, "reflectionroughness_texture"));
    let roughness =
        influenced(network, shader, ["reflection_roughness_constant", "reflection_roughness_texture_influence"], 0.5, roughness);
    closure.set_input("specular_roughness", roughness);
    let metal = shared.map(|image| component(image, 2)).or_else(|| image_value(network, shader, "metallic_texture"));
    closure.set_input("metalness", influenced(network, shader, ["metallic_constant", "metallic_texture_influence"], 0.0, metal));
    let reflectance = (FULL_LEVEL * network.number(shader, "specular_level", 0.5).max(0.0)).sqrt().min(0.99);
    closure.set("specular_ior", (1.0 + reflectance) / (1.0 - reflectance));
    if is_on(network, shader, "enable_emission") {
        closure.set_input("emission_color", emission(network, shader));
    }
    if is_on(network, shader, "enable_clearcoat") {
        clear_coat(network, shader, &mut closure);
    }
    opacity(network, shader, &mut closure);
    closure.normal = normal(network, shader);
    if is_on(network, shader, "project_uvw") {
        network.unsupported("projected texture coordinates of OmniPBR", shader);
    }
    closure
}

fn image_value(network: &mut Network<'_>, shader: &Shader, name: &str) -> Option<Input> {
    image(network, shader, name, "raw").map(|image| component(image, 0))
}

/// A constant, and as much of an image's value as its influence says.
fn influenced(network: &mut Network<'_>, shader: &Shader, [constant, influence]: [&str; 2], default: f32, image: Option<Input>) -> Input {
    let constant = network.scalar(shader, constant, default);
    let Some(image) = image else { return constant };
    let influence = network.scalar(shader, influence, 0.0);
    mix(&mut network.graph, constant, image, influence)
}

/// The image or else the constant, desaturated, brightened and tinted.
fn albedo(network: &mut Network<'_>, shader: &Shader) -> Input {
    let mut base = match image(network, shader, "diffuse_texture", "auto") {
        Some(image) => image,
        None => network.colour(shader, "diffuse_color_constant", [0.2; 3]),
    };
    let [grey, added, factor] = [("albedo_desaturation", 0.0), ("albedo_add", 0.0), ("albedo_brightness", 1.0)]
        .map(|(name, default)| network.scalar(shader, name, default));
    let tint = network.colour(shader, "diffuse_tint", [1.0; 3]);
    let graph = &mut network.graph;
    if !is_constant(grey, 0.0) {
        let without_colour = luminance(graph, base);
        base = mix(graph, base, without_colour, grey);
    }
    if !is_constant(added, 0.0) {
        base = binary(graph, Operation::Add, base, added);
    }
    base = multiply(graph, base, factor);
    multiply(graph, base, tint)
}

fn emission(network: &mut Network<'_>, shader: &Shader) -> Input {
    let mut radiance = match image(network, shader, "emissive_color_texture", "auto") {
        Some(image) => image,
        None => network.colour(shader, "emissive_color", [1.0, 0.1, 0.1]),
    };
    if let Some(mask) = image(network, shader, "emissive_mask_texture", "auto") {
        radiance = multiply(&mut network.graph, radiance, mask);
    }
    let strength = network.scalar(shader, "emissive_intensity", 40.0);
    multiply(&mut network.graph, radiance, strength)
}

fn clear_coat(network: &mut Network<'_>, shader: &Shader, closure: &mut Closure) {
    closure.set_input("coat_weight", network.scalar(shader, "clearcoat_weight", 1.0));
    closure.set_input("coat_color", network.colour(shader, "clearcoat_tint", [1.0; 3]));
    closure.set_input("coat_roughness", network.scalar(shader, "clearcoat_reflection_roughness", 0.0));
    closure.set_input("coat_ior", network.scalar(shader, "clearcoat_ior", 1.56));
}

fn opacity(network: &mut Network<'_>, shader: &Shader, closure: &mut Closure) {
    if !is_on(network, shader, "enable_opacity") {
        return;
    }
    let from_image = is_on(network, shader, "enable_opacity_texture");
    let image = if from_image { image(network, shader, "opacity_texture", "raw") } else { None };
    let opacity = match image {
        Some(image) => luminance(&mut network.graph, image),
        None => network.scalar(shader, "opacity_constant", 1.0),
    };
    let threshold = network.scalar(shader, "opacity_threshold", 0.0);
    cut_by(network, closure, opacity, threshold);
}

/// The normal map; its green runs up unless `flip_tangent_v` is taken back.
fn normal(network: &mut Network<'_>, shader: &Shader) -> Option<gonio::scene::NodeId> {
    let image = image(network, shader, "normalmap_texture", "raw")?;
    let scale = network.number(shader, "bump_factor", 1.0);
    let side = |flipped: bool| if flipped { -1.0 } else { 1.0 };
    let signs = [side(is_on(network, shader, "flip_tangent_u")), side(network.number(shader, "flip_tangent_v", 1.0) == 0.0), 1.0];
    let graph = &mut network.graph;
    let doubled = multiply(graph, image, scalar(2.0));
    let signed = subtract(graph, doubled, scalar(1.0));
    let turned = multiply(graph, signed, colour(signs));
    Some(graph.add(Operation::NormalMap { scale, uv: None }, vec![turned]))
}

fn omni_glass(network: &mut Network<'_>, shader: &Shader) -> Closure {
    let mut closure = Closure { model: Model::OpenPbr, ..Closure::default() };
    closure.set("transmission_weight", 1.0);
    let tint = match image(network, shader, "glass_color_texture", "auto") {
        Some(image) => image,
        None => network.colour(shader, "glass_color", [1.0; 3]),
    };
    closure.set_input("transmission_color", tint);
    closure.set_input("specular_ior", network.scalar(shader, "glass_ior", 1.491));
    let rough = image_value(network, shader, "roughness_texture");
    let roughness = influenced(network, shader, ["frosting_roughness", "roughness_texture_influence"], 0.0, rough);
    closure.set_input("specular_roughness", roughness);
    closure.thin_walled = is_on(network, shader, "thin_walled");
    if is_on(network, shader, "enable_opacity") {
        closure.set_input("geometry_opacity", network.scalar(shader, "cutout_opacity", 1.0));
    }
    closure.normal = normal(network, shader);
    closure
}
