//! A scene of which only a part sends light: its lights, or surfaces that are chosen.

use super::{Closure, Input, Material, MaterialId, Medium, Scene};

impl Scene {
    /// The scene with its lights as they are, and nothing else that sends light: surfaces, solids, what fills meshes and all of space. What these reflect,
    /// absorb and scatter stays.
    pub fn without_emission(&self) -> Self {
        self.with_surfaces_alone(|_| false)
    }

    /// The same with the surfaces of the materials that are wanted, which shine on.
    pub fn with_surfaces_alone(&self, wanted: impl Fn(&Material) -> bool) -> Self {
        let lit = self.with_surfaces(wanted);
        let materials = lit.materials.iter().map(without_glow).collect();
        Self { materials, atmosphere: dark_medium(&self.atmosphere), ..lit }
    }

    /// The scene with all that sends light but the surfaces of materials that are not wanted.
    pub fn with_surfaces(&self, wanted: impl Fn(&Material) -> bool) -> Self {
        let materials =
            self.materials.iter().map(|material| if wanted(material) { material.clone() } else { dark_surface(material) }).collect();
        Self { materials, ..self.clone() }
    }
}

impl Scene {
    /// Whether anything may send light that is no light: a surface, a solid, what fills meshes or all of space.
    pub fn shines_without_lights(&self) -> bool {
        self.media_shine() || self.materials.iter().any(Material::shines)
    }

    /// Whether the surfaces of a material shine by themselves, or take light away.
    pub fn shines(&self, material: MaterialId) -> bool {
        self.materials.get(material.index()).is_some_and(Material::shines)
    }

    /// Whether any of that has no spectrum: media, and surfaces whose materials name none.
    pub fn shines_without_spectra(&self) -> bool {
        self.media_shine() || self.materials.iter().any(|material| material.spectrum.is_none() && material.shines())
    }

    /// Whether a medium sends light: a solid, what fills meshes or all of space.
    pub fn media_shine(&self) -> bool {
        let shines = |medium: &Medium| medium.emission != [0.0; 3];
        let within = |material: &Material| shines(&material.medium) || material.closures.iter().any(|closure| shines(&closure.solid));
        shines(&self.atmosphere) || self.materials.iter().any(within)
    }
}

impl Material {
    /// Whether its surface shines by itself, or takes light away.
    pub fn shines(&self) -> bool {
        let sends = |input: Input| !matches!(input, Input::Constant(colour) if colour[..3].iter().all(|part| *part == 0.0));
        let counts = self.closures.iter().filter(|closure| sends(closure.weight));
        counts.filter_map(|closure| closure.input("emission_color")).any(sends)
    }
}

/// A material whose media send nothing.
fn without_glow(material: &Material) -> Material {
    let closures = material.closures.iter().map(dark_solid).collect();
    Material { closures, medium: dark_medium(&material.medium), ..material.clone() }
}

/// A material whose surface sends nothing.
fn dark_surface(material: &Material) -> Material {
    let mut dark = material.clone();
    for closure in dark.closures.iter_mut().filter(|closure| closure.input("emission_color").is_some()) {
        closure.set_colour("emission_color", [0.0; 3]);
    }
    dark
}

fn dark_solid(closure: &Closure) -> Closure {
    let mut dark = Closure { solid: dark_medium(&closure.solid), ..closure.clone() };
    if dark.solid.is_clear() && !closure.solid.is_clear() {
        // A clear one would give its place to absorption by depth.
        dark.solid.absorption = [f32::MIN_POSITIVE; 3];
    }
    dark
}

fn dark_medium(medium: &Medium) -> Medium {
    Medium { emission: [0.0; 3], ..*medium }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Channel, Field, Input, Lattice, Light, LightShape, Mesh, NodeId, Origin, Transform};

    /// Something of every kind that may send light, and does so much of it.
    fn sending(radiance: f32, textured: Input) -> Scene {
        let medium = |scattering| Medium { absorption: [0.1, 0.2, 0.3], scattering, emission: [radiance; 3], ..Medium::default() };
        let mut scene = Scene { atmosphere: medium([0.0; 3]), ..Scene::default() };
        scene.lights.push(Light::new(Origin::new("lamp"), LightShape::Point, Transform::default()));
        let lattice = || Lattice::of_values(&[1.0; 8], [2; 3]).expect("a lattice");
        let fire = Field { density: lattice(), heat: Some(lattice()), glow: vec![[1.0; 3]; 2], hottest: 1.0, ..Field::default() };
        scene.add_volume(fire, medium([0.4; 3]));
        scene.add_filled(Mesh::of_box([0.0; 3], [1.0; 3]), medium([0.5; 3]), Transform::default());
        let mut even = Closure { solid: medium([0.6; 3]), ..Closure::default() };
        even.set_colour("emission_color", [radiance; 3]);
        even.set_colour("base_color", [0.5; 3]);
        let mut patterned = Closure::default();
        patterned.set_input("emission_color", textured);
        scene.add_material(Material { closures: vec![even, patterned, Closure::default()], ..Material::default() });
        scene
    }

    #[test]
    fn lights_alone_send_light() {
        assert!(sending(5.0, Input::Node(NodeId(0), Channel::Rgb)).shines_without_lights() && !Scene::default().shines_without_lights());
        let glowing = sending(5.0, Input::Node(NodeId(0), Channel::Rgb));
        let (dark, expected) = (glowing.without_emission(), sending(0.0, Input::Constant([0.0, 0.0, 0.0, 1.0])));
        assert_eq!((&dark.materials, dark.atmosphere), (&expected.materials, expected.atmosphere));
        assert_eq!(dark.lights[0].emission.radiance, glowing.lights[0].emission.radiance);
        assert_eq!((dark.lights.len(), dark.fields.len(), dark.instances.len()), (1, 1, 2));
    }

    #[test]
    fn solids_that_only_send_stay_solids() {
        let solid = Medium { emission: [5.0; 3], ..Medium::default() };
        let scene = Scene { materials: vec![Material::of(Origin::default(), Closure { solid, ..Closure::default() })], ..Scene::default() };
        let dark = scene.without_emission().materials[0].closures[0].solid;
        assert!(!dark.is_clear() && dark.emission == [0.0; 3], "{dark:?}");
        // Over a light year less than a millionth.
        assert!(dark.absorption[0] * 1e16 < 1e-6);
    }
}
