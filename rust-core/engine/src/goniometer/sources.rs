//! What of a scene is the luminaire, and what shines in it.

use crate::{
    compile::Bounds,
    error::{Diagnostic, Error, Result},
    scene::{Light, Origin, Scene, Transform},
    transport::RayTable,
};

/// Why light that is taken away is not measured.
pub(super) const NEGATIVE: &str = "and a luminaire's intensities are zero or more: leave out what takes light away";

/// Rays that were measured of a source, placed in the world.
#[derive(Clone, Debug, Default)]
pub struct Rays {
    /// The file.
    pub name: String,
    /// Where they start, metres.
    pub origins: Vec<[f64; 3]>,
    /// Where they go; they need not be of length 1.
    pub directions: Vec<[f64; 3]>,
    /// What each carries: R, G, B, whose luminance is in lm.
    pub flux: Vec<[f64; 3]>,
}

impl Rays {
    /// The table of those that make sense, in an order of chance: files are often sorted, and any number of rays is to stand for all.
    ///
    /// # Errors
    /// No ray that carries light, or columns of different lengths.
    pub(super) fn table(&self, origin: [f64; 3], diagnostics: &mut Vec<Diagnostic>) -> Result<RayTable> {
        let count = self.flux.len();
        let of_file = Origin::new(&self.name);
        if self.origins.len() != count || self.directions.len() != count {
            return Err(Error::scene(&of_file, "there are not as many places and directions as rays"));
        }
        let mut order: Vec<usize> = (0..count).filter(|ray| self.is_usable(*ray)).collect();
        if order.is_empty() {
            return Err(Error::scene(&of_file, format!("none of the {count} rays carries light")));
        }
        if order.len() < count {
            let problem = format!(
                "{} of {count} rays have no direction, no flux or numbers that are not finite; they are left out",
                count - order.len()
            );
            diagnostics.push(Diagnostic::warning(&of_file, problem));
        }
        order.sort_by_key(|ray| mixed(*ray as u64));
        let mut table = RayTable::default();
        let share = order.len() as f64;
        for ray in order {
            let length = self.directions[ray].iter().map(|x| x * x).sum::<f64>().sqrt();
            let push = |columns: &mut [Vec<f32>; 3], value: [f64; 3]| {
                columns.iter_mut().zip(value).for_each(|(column, value)| column.push(value as f32));
            };
            push(&mut table.origin, [0, 1, 2].map(|k| self.origins[ray][k] - origin[k]));
            push(&mut table.direction, self.directions[ray].map(|x| x / length));
            push(&mut table.flux, self.flux[ray].map(|x| x * share));
        }
        Ok(table)
    }

    fn is_usable(&self, ray: usize) -> bool {
        let finite = |v: &[f64; 3]| v.iter().all(|x| x.is_finite());
        let [place, direction, flux] = [&self.origins[ray], &self.directions[ray], &self.flux[ray]];
        let length = direction.iter().map(|x| x * x).sum::<f64>();
        finite(place) && finite(flux) && length > 0.0 && length.is_finite() && flux.iter().all(|x| *x >= 0.0) && *flux != [0.0; 3]
    }
}

/// A number of chance for each number: the finalizer of SplitMix64 (Steele, Lea and Flood 2014).
fn mixed(number: u64) -> u64 {
    let z = number.wrapping_add(1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    let z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

/// The luminaire's scene: without lights at infinity, portals, and what a picture needs.
///
/// # Errors
/// A light that takes light away: intensities are not negative.
pub(super) fn luminaire(scene: &Scene, diagnostics: &mut Vec<Diagnostic>) -> Result<Scene> {
    let belongs = |light: &Light| !light.portal && !light.shape.is_at_infinity();
    if let Some(light) = scene.lights.iter().find(|light| belongs(light) && light.takes_away()) {
        return Err(Error::scene(&light.origin, format!("its radiance is {:?}, {NEGATIVE}", light.emission.radiance)));
    }
    for light in scene.lights.iter().filter(|light| !belongs(light)) {
        diagnostics.push(Diagnostic::warning(&light.origin, "lights at infinity and portals are no part of a luminaire; it is left out"));
    }
    for light in scene.lights.iter().filter(|light| belongs(light) && light.share() != 1.0) {
        let message = format!(
            "dimming and maintenance make it {:.4} of what it is in full, which is in the figures: leave them out where the file is placed",
            light.share()
        );
        diagnostics.push(Diagnostic::warning(&light.origin, message));
    }
    Ok(Scene {
        lights: scene.lights.iter().filter(|light| belongs(light)).cloned().collect(),
        cameras: Vec::new(),
        meters: Vec::new(),
        grids: Vec::new(),
        ..scene.clone()
    })
}

/// Bounds of surfaces, lights and rays' starts after a map of the world.
pub(super) fn bounds(scene: &Scene, rays: &[Rays], map: &Transform) -> Bounds {
    let mut bounds = Bounds::of_all(scene, map);
    rays.iter().flat_map(|rays| &rays.origins).for_each(|origin| bounds.extend(map.point(*origin)));
    bounds
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rays_that_carry_nothing_are_left_out() {
        let rays = Rays {
            name: "lamp.ray".into(),
            origins: vec![[1.0, 2.0, 3.0], [0.0; 3], [f64::NAN; 3], [0.0; 3]],
            directions: vec![[0.0, 0.0, 2.0], [1.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0; 3]],
            flux: vec![[1.0, 2.0, 3.0], [0.5; 3], [1.0; 3], [1.0; 3]],
        };
        let mut diagnostics = Vec::new();
        let table = rays.table([1.0, 0.0, 0.0], &mut diagnostics).expect("two rays");
        assert_eq!((table.len(), diagnostics.len()), (2, 1));
        let first = table.flux[2].iter().position(|flux| *flux == 6.0).expect("twice 3");
        assert_eq!([0, 1, 2].map(|k| table.origin[k][first]), [0.0, 2.0, 3.0]);
        assert_eq!([0, 1, 2].map(|k| table.direction[k][first]), [0.0, 0.0, 1.0]);
        assert!(Rays { flux: vec![[0.0; 3]; 4], ..rays }.table([0.0; 3], &mut diagnostics).is_err());
    }
}
