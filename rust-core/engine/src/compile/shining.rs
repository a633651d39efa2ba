//! Surfaces that shine by a spectrum: it stands in for their colour.

use crate::{
    colour::LUMINANCE,
    scene::{Channel, Input, Material, Operation},
};

/// The material with emission as bright as its own in a colour of unit luminance.
pub(super) fn emission_of_colour(material: &Material, [r, g, b]: [f32; 3]) -> Material {
    let mut coloured = material.clone();
    let Material { closures, graph, .. } = &mut coloured;
    let [red, green, blue] = LUMINANCE.map(|weight| weight as f32);
    for closure in closures {
        let Some(emission) = closure.input("emission_color") else { continue };
        let luminance = graph.add(Operation::Dot, vec![emission, Input::Constant([red, green, blue, 0.0])]);
        let product = graph.add(Operation::Multiply, vec![Input::Node(luminance, Channel::Rgb), Input::Constant([r, g, b, 0.0])]);
        closure.set_input("emission_color", Input::Node(product, Channel::Rgb));
    }
    coloured
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Closure;

    #[test]
    fn what_does_not_shine_stays() {
        let dark = Material { closures: vec![Closure::default()], ..Material::default() };
        assert_eq!(emission_of_colour(&dark, [1.1, 1.0, 0.5]), dark);
    }
}
