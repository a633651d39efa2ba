//! A scene's lights as luminaires: what they send in all, and what they show to an eye.

use super::{
    goniograms::CompiledGoniograms,
    lights::{emitters, record},
    openings::Part,
    quantity::{self, FarFields},
};
use crate::{
    light::{FarField, LightRecord},
    scene::{Light, Scene},
};

/// Luminous flux in lm of each of the scene's lights, dimming included. None of lights at infinity, of portals, and of lights with an image over
/// them; 0 where a quantity cannot be had.
pub fn luminous_fluxes(scene: &Scene) -> Vec<Option<f64>> {
    let mut goniograms = CompiledGoniograms::default();
    let mut far_fields = FarFields::default();
    let flux = |light: &Light| {
        is_luminaire(light).then(|| {
            let records = records(light, &mut goniograms, &mut far_fields);
            quantity::flux_of(&records, &mut goniograms, &mut far_fields)
        })
    };
    scene.lights.iter().map(flux).collect()
}

/// A light as it is seen from afar.
#[derive(Debug)]
pub(crate) struct Luminaire {
    /// World space, metres.
    pub(crate) centre: [f64; 3],
    pub(crate) far_field: FarField,
    /// Whether things hide it.
    pub(crate) casts_shadow: bool,
}

/// The scene's lights that have a place and no image over them.
pub(crate) fn luminaires(scene: &Scene) -> Vec<Luminaire> {
    let mut goniograms = CompiledGoniograms::default();
    let mut far_fields = FarFields::default();
    let luminaire = |light: &Light| {
        let records = records(light, &mut goniograms, &mut far_fields);
        let far_field = FarField::new(&records, &goniograms.tables);
        Luminaire { centre: light.transform.point([0.0; 3]), far_field, casts_shadow: light.casts_shadow }
    };
    scene.lights.iter().filter(|light| is_luminaire(light)).map(luminaire).collect()
}

/// Whether a light has a place and sends the same everywhere on its surface.
pub(crate) fn is_luminaire(light: &Light) -> bool {
    !light.shape.is_at_infinity() && !light.portal && light.texture.is_none()
}

/// The light's emitters as strong as it is; what cannot be used is reported when the scene is compiled.
fn records(light: &Light, goniograms: &mut CompiledGoniograms, far_fields: &mut FarFields) -> Vec<LightRecord> {
    let mut unheard = Vec::new();
    let number = goniograms.number(light, &mut unheard);
    let table = number.and_then(|number| goniograms.tables.get(number as usize));
    let parts = emitters(light, [0.0; 3], table);
    let with_goniogram = |part: &Part| LightRecord { goniogram: number, ..record(light, part, None, &mut unheard) };
    let mut records: Vec<LightRecord> = parts.iter().map(with_goniogram).collect();
    quantity::apply(light, &mut records, goniograms, far_fields, &mut unheard);
    records
}
