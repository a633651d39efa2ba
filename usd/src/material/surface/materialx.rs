//! MaterialX's surface shaders as parameters of the surface block. Arnold's of the same names have the same parameters.

use super::lobes::direction;
use super::parts::cut_by;
use super::solid;
use crate::material::emit::{component, constant_scalar, is_constant, luminance, multiply, scalar};
use crate::material::network::{Network, Shader};
use gonio::scene::{Closure, Input, Model, NodeId, Operation};

/// Nanometres in a micrometre.
const NM_PER_UM: f32 = 1000.0;

/// A surface that is being filled from a shader.
struct Surface<'n, 'h> {
    network: &'n mut Network<'h>,
    shader: &'n Shader,
    closure: Closure,
}

impl Surface<'_, '_> {
    fn scalar(&mut self, name: &str, default: f32) -> Input {
        self.network.scalar(self.shader, name, default)
    }
    fn share(&mut self, name: &str, default: f32) -> Input {
        self.network.share(self.shader, name, default)
    }
    fn colour(&mut self, name: &str, default: [f32; 3]) -> Input {
        self.network.colour(self.shader, name, default)
    }
    /// Sets scalar parameters from inputs: (parameter, input, default).
    fn scalars(&mut self, table: &[(&str, &str, f32)]) {
        for (parameter, input, default) in table {
            let value = self.scalar(input, *default);
            self.closure.set_input(parameter, value);
        }
    }
    /// Sets colour parameters from inputs: (parameter, input, default).
    fn colours(&mut self, table: &[(&str, &str, [f32; 3])]) {
        for (parameter, input, default) in table {
            let value = self.colour(input, *default);
            self.closure.set_input(parameter, value);
        }
    }
    /// Sets a parameter to the product of two inputs.
    fn product(&mut self, parameter: &str, a: Input, b: Input) {
        let product = multiply(&mut self.network.graph, a, b);
        self.closure.set_input(parameter, product);
    }
    /// Lengths are in units of the stage.
    fn length(&mut self, parameter: &str, input: Input) {
        let metres = scalar(self.network.host.metres_per_unit() as f32);
        self.product(parameter, input, metres);
    }
    /// What scatters under the surface, over the depth by which it absorbs.
    fn scattering(&mut self, anisotropy: &str) {
        let scatter = self.colour("transmission_scatter", [0.0; 3]);
        let depth = self.closure.input("transmission_depth");
        if is_constant(scatter, 0.0) || depth.is_none_or(|depth| is_constant(depth, 0.0)) {
            return;
        }
        let cosine = self.network.number(self.shader, anisotropy, 0.0);
        match solid::scattering(&self.closure, scatter, cosine) {
            Some(medium) => self.closure.solid = medium,
            None => self.network.unsupported(&format!("input 'transmission_scatter' that varies, of {}", self.shader.id), self.shader),
        }
    }
    /// Says by name which inputs are left out although they are not at the value that means off.
    fn left_out(&mut self, inputs: &[(&str, f32)]) {
        for (name, off) in inputs {
            if self.network.input(self.shader, name).is_some_and(|input| !is_constant(input, *off)) {
                self.network.unsupported(&format!("input '{name}' of {}", self.shader.id), self.shader);
            }
        }
    }
    /// A direction of the world that an input reads from a node; images hold none.
    fn direction(&mut self, name: &str) -> Option<NodeId> {
        let node = direction(self.network, self.shader, name)?;
        let is_image = matches!(self.network.graph.nodes.get(usize::from(node.0))?.operation, Operation::Image { .. });
        if is_image {
            self.network.warn(self.shader, format!("input '{name}' is an image without a normal map; the surface's own is used"));
        }
        (!is_image).then_some(node)
    }
}

/// The material of a MaterialX surface shader; `None` where the node is not one that is known.
pub(super) fn convert(network: &mut Network<'_>, shader: &Shader) -> Option<Closure> {
    let fill = match &*shader.id {
        "ND_standard_surface_surfaceshader" | "arnold:standard_surface" => standard_surface,
        "ND_standard_surface_surfaceshader_100" => standard_surface_100,
        "ND_open_pbr_surface_surfaceshader" | "arnold:openpbr_surface" => open_pbr_surface,
        "ND_gltf_pbr_surfaceshader" => gltf_pbr,
        _ => return None,
    };
    let mut surface = Surface { network, shader, closure: Closure::default() };
    fill(&mut surface);
    Some(surface.closure)
}

/// No glass has a lower Abbe number.
const LEAST_ABBE: f32 = 1.0;

impl Surface<'_, '_> {
    /// How much what passes is bent by its wavelength: 1 over the Abbe number.
    fn disperses(&mut self, inverse_abbe: f32) {
        if inverse_abbe > 0.0 {
            self.closure.set("transmission_dispersion", inverse_abbe);
        }
    }
}

/// OpenPBR 1.1: the block's own model.
fn open_pbr_surface(surface: &mut Surface<'_, '_>) {
    surface.closure.model = Model::OpenPbr;
    let (weight, base) = (surface.share("base_weight", 1.0), surface.colour("base_color", [0.8; 3]));
    surface.product("base_color", base, weight);
    surface.scalars(&[
        ("diffuse_roughness", "base_diffuse_roughness", 0.0),
        ("metalness", "base_metalness", 0.0),
        ("metal_weight", "specular_weight", 1.0),
        ("specular_weight", "specular_weight", 1.0),
        ("specular_roughness", "specular_roughness", 0.3),
        ("specular_anisotropy", "specular_roughness_anisotropy", 0.0),
        ("specular_ior", "specular_ior", 1.5),
        ("transmission_weight", "transmission_weight", 0.0),
        ("subsurface_weight", "subsurface_weight", 0.0),
        ("subsurface_scatter_anisotropy", "subsurface_scatter_anisotropy", 0.0),
        ("coat_weight", "coat_weight", 0.0),
        ("coat_roughness", "coat_roughness", 0.0),
        ("coat_ior", "coat_ior", 1.6),
        ("coat_darkening", "coat_darkening", 1.0),
        ("fuzz_weight", "fuzz_weight", 0.0),
        ("fuzz_roughness", "fuzz_roughness", 0.5),
        ("thin_film_weight", "thin_film_weight", 0.0),
        ("thin_film_ior", "thin_film_ior", 1.4),
        ("geometry_opacity", "geometry_opacity", 1.0),
    ]);
    surface.colours(&[
        ("metal_edge_tint", "specular_color", [1.0; 3]),
        ("specular_color", "specular_color", [1.0; 3]),
        ("transmission_color", "transmission_color", [1.0; 3]),
        ("subsurface_color", "subsurface_color", [0.8; 3]),
        ("coat_color", "coat_color", [1.0; 3]),
        ("fuzz_color", "fuzz_color", [1.0; 3]),
    ]);
    let depth = surface.scalar("transmission_depth", 0.0);
    surface.length("transmission_depth", depth);
    let (radius, scale) = (surface.scalar("subsurface_radius", 1.0), surface.colour("subsurface_radius_scale", [1.0, 0.5, 0.25]));
    let radius = multiply(&mut surface.network.graph, scale, radius);
    surface.length("subsurface_radius", radius);
    let thickness = surface.scalar("thin_film_thickness", 0.5);
    surface.product("thin_film_thickness", thickness, scalar(NM_PER_UM));
    let (luminance, emission) = (surface.scalar("emission_luminance", 0.0), surface.colour("emission_color", [1.0; 3]));
    surface.product("emission_color", emission, luminance);
    surface.closure.thin_walled = surface.network.number(surface.shader, "geometry_thin_walled", 0.0) != 0.0;
    surface.closure.normal = surface.direction("geometry_normal");
    surface.scattering("transmission_scatter_anisotropy");
    let abbe = surface.network.number(surface.shader, "transmission_dispersion_abbe_number", 20.0);
    let scale = surface.network.number(surface.shader, "transmission_dispersion_scale", 0.0);
    surface.disperses(scale / abbe.max(LEAST_ABBE));
    surface.left_out(&[("coat_roughness_anisotropy", 0.0)]);
    surface.closure.coat_normal = surface.direction("geometry_coat_normal");
    surface.closure.tangent = surface.direction("geometry_tangent");
}

/// Version 1.0.1 of standard_surface.
fn standard_surface(surface: &mut Surface<'_, '_>) {
    fill_standard_surface(surface, 1.0, 0.8);
}

/// Version 1.0.0, which differs in two defaults.
fn standard_surface_100(surface: &mut Surface<'_, '_>) {
    fill_standard_surface(surface, 0.8, 1.0);
}

fn fill_standard_surface(surface: &mut Surface<'_, '_>, base_weight: f32, base_color: f32) {
    surface.closure.model = Model::StandardSurface;
    let (weight, base) = (surface.share("base", base_weight), surface.colour("base_color", [base_color; 3]));
    surface.product("base_color", base, weight);
    surface.scalars(&[
        ("diffuse_roughness", "diffuse_roughness", 0.0),
        ("metalness", "metalness", 0.0),
        ("specular_roughness", "specular_roughness", 0.2),
        ("specular_anisotropy", "specular_anisotropy", 0.0),
        ("specular_rotation", "specular_rotation", 0.0),
        ("specular_ior", "specular_IOR", 1.5),
        ("transmission_weight", "transmission", 0.0),
        ("transmission_extra_roughness", "transmission_extra_roughness", 0.0),
        ("subsurface_weight", "subsurface", 0.0),
        ("subsurface_scatter_anisotropy", "subsurface_anisotropy", 0.0),
        ("coat_weight", "coat", 0.0),
        ("coat_roughness", "coat_roughness", 0.1),
        ("coat_ior", "coat_IOR", 1.5),
        ("coat_affect_color", "coat_affect_color", 0.0),
        ("coat_affect_roughness", "coat_affect_roughness", 0.0),
        ("fuzz_weight", "sheen", 0.0),
        ("fuzz_roughness", "sheen_roughness", 0.3),
        ("thin_film_thickness", "thin_film_thickness", 0.0),
        ("thin_film_ior", "thin_film_IOR", 1.5),
    ]);
    surface.colours(&[
        ("specular_color", "specular_color", [1.0; 3]),
        ("transmission_color", "transmission_color", [1.0; 3]),
        ("subsurface_color", "subsurface_color", [1.0; 3]),
        ("coat_color", "coat_color", [1.0; 3]),
        ("fuzz_color", "sheen_color", [1.0; 3]),
    ]);
    surface.closure.set("coat_darkening", 0.0);
    // The metal's edge tint is specular · specular_color, its whole lobe has the weight 1.
    let (specular, tint) = (surface.share("specular", 1.0), surface.colour("specular_color", [1.0; 3]));
    surface.closure.set_input("specular_scale", specular);
    surface.product("metal_edge_tint", tint, specular);
    let depth = surface.scalar("transmission_depth", 0.0);
    surface.length("transmission_depth", depth);
    let (radius, scale) = (surface.colour("subsurface_radius", [1.0; 3]), surface.scalar("subsurface_scale", 1.0));
    let radius = multiply(&mut surface.network.graph, radius, scale);
    surface.length("subsurface_radius", radius);
    let has_film = surface.closure.input("thin_film_thickness").and_then(constant_scalar).is_none_or(|nm| nm > 0.0);
    surface.closure.set("thin_film_weight", f32::from(u8::from(has_film)));
    let (weight, emission) = (surface.scalar("emission", 0.0), surface.colour("emission_color", [1.0; 3]));
    surface.product("emission_color", emission, weight);
    let opacity = surface.colour("opacity", [1.0; 3]);
    let opacity = luminance(&mut surface.network.graph, opacity);
    surface.closure.set_input("geometry_opacity", opacity);
    surface.closure.thin_walled = surface.network.number(surface.shader, "thin_walled", 0.0) != 0.0;
    surface.closure.normal = surface.direction("normal");
    surface.scattering("transmission_scatter_anisotropy");
    let abbe = surface.network.number(surface.shader, "transmission_dispersion", 0.0);
    surface.disperses(if abbe > 0.0 { abbe.max(LEAST_ABBE).recip() } else { 0.0 });
    surface.left_out(&[("coat_anisotropy", 0.0)]);
    surface.closure.coat_normal = surface.direction("coat_normal");
    surface.closure.tangent = surface.direction("tangent");
}

/// glTF 2.0's metallic-roughness material with its extensions.
fn gltf_pbr(surface: &mut Surface<'_, '_>) {
    surface.closure.model = Model::Gltf;
    surface.scalars(&[
        ("metalness", "metallic", 1.0),
        ("specular_roughness", "roughness", 1.0),
        ("specular_scale", "specular", 1.0),
        ("specular_ior", "ior", 1.5),
        ("specular_anisotropy", "anisotropy_strength", 0.0),
        ("transmission_weight", "transmission", 0.0),
        ("coat_weight", "clearcoat", 0.0),
        ("coat_roughness", "clearcoat_roughness", 0.0),
        ("thin_film_weight", "iridescence", 0.0),
        ("thin_film_ior", "iridescence_ior", 1.3),
        ("thin_film_thickness", "iridescence_thickness", 100.0),
    ]);
    surface.colours(&[("base_color", "base_color", [1.0; 3]), ("specular_color", "specular_color", [1.0; 3])]);
    surface.closure.set("coat_ior", 1.5);
    surface.closure.set("coat_darkening", 0.0);
    surface.closure.set_colour("metal_edge_tint", [1.0; 3]);
    let radians = surface.scalar("anisotropy_rotation", 0.0);
    surface.product("specular_rotation", radians, scalar(std::f32::consts::TAU.recip()));
    gltf_sheen(surface);
    gltf_volume(surface);
    let (emissive, strength) = (surface.colour("emissive", [0.0; 3]), surface.scalar("emissive_strength", 1.0));
    surface.product("emission_color", emissive, strength);
    let mode = surface.network.number(surface.shader, "alpha_mode", 0.0);
    if mode != 0.0 {
        let alpha = surface.scalar("alpha", 1.0);
        let threshold = if mode == 1.0 { surface.scalar("alpha_cutoff", 0.5) } else { scalar(0.0) };
        cut_by(surface.network, &mut surface.closure, alpha, threshold);
    }
    surface.closure.normal = surface.direction("normal");
    // 20 over the Abbe number (KHR_materials_dispersion).
    let dispersion = surface.network.number(surface.shader, "dispersion", 0.0);
    surface.disperses(dispersion / 20.0);
    surface.closure.coat_normal = surface.direction("clearcoat_normal");
    surface.closure.tangent = surface.direction("tangent");
}

/// The fuzz takes by its largest coloured channel, so the colour may keep its strength and the weight be one.
fn gltf_sheen(surface: &mut Surface<'_, '_>) {
    let sheen = surface.colour("sheen_color", [0.0; 3]);
    surface.closure.set("fuzz_weight", f32::from(u8::from(!is_constant(sheen, 0.0))));
    surface.closure.set_input("fuzz_color", sheen);
    let roughness = surface.scalar("sheen_roughness", 0.0);
    surface.product("fuzz_roughness", roughness, roughness);
}

/// What passes is tinted by the base colour; thickness 0 is a sheet, other surfaces enclose an absorbing volume.
fn gltf_volume(surface: &mut Surface<'_, '_>) {
    let transmits = surface.closure.input("transmission_weight").is_some_and(|weight| !is_constant(weight, 0.0));
    let base = surface.colour("base_color", [1.0; 3]);
    let is_sheet = is_constant(component(surface.scalar("thickness", 0.0), 0), 0.0);
    surface.closure.thin_walled = transmits && is_sheet;
    let attenuation = surface.colour("attenuation_color", [1.0; 3]);
    let distance = surface.scalar("attenuation_distance", 0.0);
    if is_sheet || is_constant(attenuation, 1.0) || is_constant(distance, 0.0) {
        surface.closure.set_input("transmission_color", base);
        return;
    }
    surface.closure.set_input("transmission_color", attenuation);
    surface.length("transmission_depth", distance);
    if transmits && !is_constant(base, 1.0) {
        surface
            .network
            .warn(surface.shader, "a base colour that tints an absorbing volume is not supported; the attenuation alone is used");
    }
}
