//! Sources from ray files.

use super::Rays;
use crate::{
    colour::{Gamut, apply, inverse, luminance},
    error::{Error, Result},
    light_paths::Channels,
    scene::{Origin, Transform},
};
use gonio_formats::rays::{FluxUnit, RayColour, RayFile};

impl Rays {
    /// A file's rays in the axes of something that is placed in the world. Lengths are the file's: of the map's scale only what is beyond
    /// `metres`, the size of the stage's unit, counts. Colours are those of tristimulus values; other rays are white.
    ///
    /// # Errors
    /// Fluxes that are no lumens.
    pub fn of(file: &RayFile, name: &str, placed: &Transform, metres: f64) -> Result<Self> {
        if file.unit != FluxUnit::Lumens {
            let problem = format!("its fluxes are {}; say how many lumens they are together", unit_name(file.unit));
            return Err(Error::scene(&Origin::new(name), problem));
        }
        let placed = placed.after(&Transform::scale(metres.recip()));
        let double = |v: &[f32; 3]| v.map(f64::from);
        Ok(Self {
            name: name.to_owned(),
            origins: file.origins.iter().map(|origin| placed.point(double(origin))).collect(),
            directions: file.directions.iter().map(|direction| placed.vector(double(direction))).collect(),
            flux: (0..file.len()).map(|ray| flux(file, ray)).collect(),
        })
    }
}

fn unit_name(unit: FluxUnit) -> &'static str {
    match unit {
        FluxUnit::Lumens => "lumens",
        FluxUnit::Watts => "watts of an unknown spectrum",
        FluxUnit::Relative => "in proportion alone",
    }
}

/// A ray's flux, whose luminance is in lm. Colours beyond Rec.709 come as near as it goes.
fn flux(file: &RayFile, ray: usize) -> Channels {
    let lumens = f64::from(file.fluxes[ray]);
    let RayColour::Tristimulus(values) = &file.colour else { return [lumens; 3] };
    let to_rgb = Gamut::Rec709.primaries().to_xyz().as_ref().and_then(inverse);
    let seen = values.get(ray).zip(to_rgb).map(|(xyz, matrix)| apply(&matrix, xyz.map(f64::from)).map(|x| x.max(0.0)));
    let seen = seen.filter(|rgb| luminance(*rgb) > 0.0);
    seen.map_or([lumens; 3], |rgb| rgb.map(|x| x * lumens / luminance(rgb)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use gonio_formats::rays::{LengthUnit, RayFormat};

    fn file(unit: FluxUnit, colour: RayColour) -> RayFile {
        RayFile {
            format: RayFormat::Tm25,
            origins: vec![[0.01, 0.0, 0.0]],
            directions: vec![[0.0, 0.0, 1.0]],
            fluxes: vec![2.0],
            unit,
            total: 2.0,
            colour,
            description: String::new(),
            length_unit: LengthUnit::Metres,
            left_out: 0,
            warnings: Vec::new(),
        }
    }

    #[test]
    fn rays_stand_where_their_prim_does() {
        // A stage in centimetres, turned by 90° about y and moved by a metre along x.
        let placed = Transform { columns: [[0.0, 0.0, -0.01], [0.0, 0.01, 0.0], [0.01, 0.0, 0.0], [1.0, 0.0, 0.0]] };
        let rays = Rays::of(&file(FluxUnit::Lumens, RayColour::Unknown), "led", &placed, 0.01).expect("lumens");
        let near = |a: [f64; 3], b: [f64; 3]| (0..3).all(|k| (a[k] - b[k]).abs() < 1e-8);
        assert!(near(rays.origins[0], [1.0, 0.0, -0.01]) && near(rays.directions[0], [1.0, 0.0, 0.0]), "{rays:?}");
        assert_eq!(rays.flux, [[2.0; 3]]);
    }

    #[test]
    fn colours_keep_their_lumens() {
        let warm = file(FluxUnit::Lumens, RayColour::Tristimulus(vec![[2.2, 2.0, 0.7]]));
        let rays = Rays::of(&warm, "led", &Transform::IDENTITY, 1.0).expect("lumens");
        let [r, g, b] = rays.flux[0];
        assert!(r > g && g > b && (luminance(rays.flux[0]) - 2.0).abs() < 1e-6, "{rays:?}");
        assert!(Rays::of(&file(FluxUnit::Watts, RayColour::Unknown), "led", &Transform::IDENTITY, 1.0).is_err());
    }
}
