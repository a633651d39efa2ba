//! A scene's lights as luminaires: what they send in all, and what shines of them.

use super::{
    goniograms::CompiledGoniograms,
    light_images::picture_means,
    lights::{emitters, record},
    openings::Part,
    quantity::{self, FarFields},
};
use crate::{
    light::{FarField, LightRecord, LightTable, LightTexture},
    scene::{Light, Scene},
};

/// Luminous flux in lm of each of the scene's lights, dimming included. None of lights at infinity, of portals, and of lights with an image over
/// them; 0 where a quantity cannot be had.
pub fn luminous_fluxes(scene: &Scene) -> Vec<Option<f64>> {
    of_luminaires(scene, &[], |_, records, goniograms, far_fields| quantity::flux_of(records, goniograms, far_fields))
}

/// The same with those that have a picture over them, which is read for it.
pub(crate) fn luminous_fluxes_of_all(scene: &Scene) -> Vec<Option<f64>> {
    of_luminaires(scene, &picture_means(scene), |_, records, goniograms, far_fields| quantity::flux_of(records, goniograms, far_fields))
}

/// What `asked` makes of the luminous intensity of each of the scene's lights that [`luminous_fluxes`] knows, by its number: cd, dimming included, towards a
/// direction of length 1.
pub fn luminous_intensities<T>(scene: &Scene, mut asked: impl FnMut(usize, &dyn Fn([f64; 3]) -> f64) -> T) -> Vec<Option<T>> {
    of_luminaires(scene, &[], |number, records, goniograms, _| {
        let far_field = FarField::new(records, &goniograms.tables);
        asked(number, &|direction| far_field.in_direction(direction)[0])
    })
}

/// Unit directions in which a light's file states intensities, as the light is turned: between them intensities are linear in both angles, and greatest at
/// one of them. None of lights without a file.
pub fn stated_directions(light: &Light) -> Vec<[f64; 3]> {
    let Some(goniogram) = &light.goniogram else { return Vec::new() };
    let turned = light.transform.without_scale();
    let of = |h: &f32, v: &f32| turned.vector(goniogram.photometric_type.direction(f64::from(*h), f64::from(*v)));
    goniogram.horizontal_deg.iter().flat_map(|h| goniogram.vertical_deg.iter().map(move |v| of(h, v))).collect()
}

/// What is asked of the number and the records of each light that sends the same everywhere on its surface, or has a mean of its picture in `means`.
fn of_luminaires<T>(
    scene: &Scene,
    means: &[Option<[f32; 3]>],
    mut asked: impl FnMut(usize, &[LightRecord], &mut CompiledGoniograms, &mut FarFields) -> T,
) -> Vec<Option<T>> {
    let mut goniograms = CompiledGoniograms::default();
    let mut far_fields = FarFields::default();
    let of_light = |(number, light): (usize, &Light)| {
        let mean = means.get(number).copied().flatten();
        (light.is_luminaire() && (light.texture.is_none() || mean.is_some())).then(|| {
            let records = dimmed(records(light, [0.0; 3], &mut goniograms, &mut far_fields), mean);
            asked(number, &records, &mut goniograms, &mut far_fields)
        })
    };
    scene.lights.iter().enumerate().map(of_light).collect()
}

/// A light as an eye sees it.
#[derive(Debug)]
pub(crate) struct Luminaire {
    /// World space, metres.
    pub(crate) centre: [f64; 3],
    /// What shines of it, each part in a table of its own.
    pub(crate) emitters: Vec<LightTable>,
    /// Whether a maker's file describes it: then it is one source, wherever its parts lie.
    pub(crate) is_one: bool,
    /// Whether things hide it.
    pub(crate) casts_shadow: bool,
}

/// The scene's lights that have a place and take no light away, seen from an origin in world space. Pictures over them count by their `means`.
pub(crate) fn luminaires(scene: &Scene, origin: [f64; 3], means: &[Option<[f32; 3]>]) -> Vec<Luminaire> {
    let mut goniograms = CompiledGoniograms::default();
    let mut far_fields = FarFields::default();
    let luminaire = |(number, light): (usize, &Light)| {
        let records = dimmed(records(light, origin, &mut goniograms, &mut far_fields), means.get(number).copied().flatten());
        let alone = |record: LightRecord| LightTable::build(&[record], &[] as &[LightTexture], &goniograms.tables);
        let emitters = records.into_iter().map(alone).collect();
        Luminaire { centre: light.transform.point([0.0; 3]), emitters, is_one: light.goniogram.is_some(), casts_shadow: light.casts_shadow }
    };
    scene.lights.iter().enumerate().filter(|(_, light)| light.is_luminaire() && !light.takes_away()).map(luminaire).collect()
}

/// Emitters that send what a picture over them lets through in the mean, where there is one.
fn dimmed(mut records: Vec<LightRecord>, mean: Option<[f32; 3]>) -> Vec<LightRecord> {
    let mean = mean.unwrap_or([1.0; 3]);
    records.iter_mut().for_each(|record| record.radiance = std::array::from_fn(|k| record.radiance[k] * mean[k]));
    records
}

/// The light's emitters as strong as it is; what cannot be used is reported when the scene is compiled.
fn records(light: &Light, origin: [f64; 3], goniograms: &mut CompiledGoniograms, far_fields: &mut FarFields) -> Vec<LightRecord> {
    let mut unheard = Vec::new();
    let number = goniograms.number(light, &mut unheard);
    let table = number.and_then(|number| goniograms.tables.get(number as usize));
    let parts = emitters(light, origin, table);
    let with_goniogram = |part: &Part| LightRecord { goniogram: number, ..record(light, part, None, &mut unheard) };
    let mut records: Vec<LightRecord> = parts.iter().map(with_goniogram).collect();
    quantity::apply(light, &mut records, goniograms, far_fields, &mut unheard);
    records
}
