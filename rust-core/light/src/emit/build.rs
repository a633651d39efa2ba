//! Building the emission sampler: what each light sends in all, and how its rays are drawn.

use super::EmissionSampler;
use super::aim::Targets;
use super::body::Body;
use super::choice::Choice;
use super::image;
use super::profile::Profiles;
use super::row::{WIDTH, at};
use crate::dome::DomeDistribution;
use crate::light_kind::LightKind;
use crate::record::LightTexture;
use crate::row::{ROW, field, flag};
use crate::table::LightTable;
use crate::texture::Placed;
use std::collections::BTreeMap;

/// The image on a row's light.
fn image_on(table: &LightTable, row: &[f32]) -> Option<LightTexture> {
    let [first, width, height] = [field::TEXTURE, field::TEXTURE_WIDTH, field::TEXTURE_HEIGHT].map(|at| row[at].to_bits());
    (width > 0).then(|| table.textures.image(Placed { first, width, height }))
}

impl EmissionSampler {
    /// Of the lights in a table, or of some of them (`lights`). `scene`: centre and radius of a sphere around all geometry and finite lights.
    /// `targets`: spheres that half of the paths ([`super::AIMED`]) are aimed at; none leaves all to the lights.
    pub fn new(table: &LightTable, lights: Option<&[u32]>, scene: ([f32; 3], f32), targets: &[([f32; 3], f32)]) -> Self {
        let targets = Targets::new(targets);
        let mut sampler = Self {
            rows: vec![0.0; table.len() * WIDTH + 4],
            choice: Choice::new(std::iter::empty()),
            powers: vec![[0.0; 3]; table.len()],
            beams: super::beams::Beams::default(),
            places: Vec::new(),
            domes: Vec::new(),
            targets,
            scene,
        };
        let (mut profiles, mut textured) = (Profiles::default(), BTreeMap::new());
        let mut wanted = vec![lights.is_none(); table.len()];
        for light in lights.unwrap_or_default() {
            if let Some(wanted) = wanted.get_mut(*light as usize) {
                *wanted = true;
            }
        }
        for (light, row) in table.rows.chunks_exact(ROW).enumerate() {
            // As in light sampling: what scattered rays do not find lights nothing.
            let sends = row[field::FLAGS].to_bits() & flag::LIT != 0 && row[field::STRENGTH] > 0.0;
            if wanted[light] && sends {
                let power = if row[field::FLAGS].to_bits() & flag::INFINITE != 0 {
                    sampler.add_infinite(table, light as u32, row)
                } else {
                    sampler.add_finite(table, light as u32, row, &mut profiles, &mut textured)
                };
                sampler.powers[light] = if power.iter().all(|x| x.is_finite()) { power } else { [0.0; 3] };
            }
        }
        let luminous = |power: &[f64; 3]| gonio_image::colour::luminance(*power);
        sampler.choice = Choice::new(sampler.powers.iter().enumerate().map(|(light, power)| (light as u32, luminous(power))));
        sampler.beams = profiles.beams;
        sampler
    }

    /// Fills in how a finite light's rays are drawn; its power.
    fn add_finite(
        &mut self,
        table: &LightTable,
        light: u32,
        row: &[f32],
        profiles: &mut Profiles,
        textured: &mut BTreeMap<u32, (usize, [f64; 3])>,
    ) -> [f64; 3] {
        let body = Body::new(table, light, row);
        let goniogram = (row[field::GONIOGRAM].to_bits() as usize).checked_sub(1).and_then(|number| table.goniograms.get(number));
        let profile = profiles.of(&body, goniogram.map(AsRef::as_ref));
        let mut number = 0;
        let mut factor = [1.0; 3];
        if body.kind == LightKind::Rectangle
            && let Some(image) = image_on(table, row)
        {
            let places = &mut self.places;
            (number, factor) = *textured.entry(row[field::TEXTURE].to_bits()).or_insert_with(|| {
                places.push(image::by_luminance(&image));
                (places.len(), image::mean(&image.rgb))
            });
        }
        let out = &mut self.rows[light as usize * WIDTH..][..WIDTH];
        for (place, axis) in [at::ACROSS, at::ACROSS + 3, at::POLE].into_iter().zip(body.frame) {
            out[place..place + 3].copy_from_slice(&crate::vector::narrow(axis));
        }
        out[at::AREA] = body.size as f32;
        let placed = profile.placed;
        let words = [placed.first, placed.columns, placed.size[0], placed.size[1], profile.model as u32, number as u32];
        for (place, word) in [at::FIRST, at::COLUMNS, at::SIZE, at::SIZE + 1, at::MODEL, at::PLACES].into_iter().zip(words) {
            out[place] = f32::from_bits(word);
        }
        [0, 1, 2].map(|k| f64::from(row[field::RADIANCE + k]).abs() * profile.integral[k] * body.unit() * factor[k])
    }

    /// Takes in an infinite light; its power through the scene's disk, or through those of the targets.
    fn add_infinite(&mut self, table: &LightTable, light: u32, row: &[f32]) -> [f64; 3] {
        let bits = row[field::FLAGS].to_bits();
        let radiance = [0, 1, 2].map(|k| f64::from(row[field::RADIANCE + k]).abs());
        let whole = if bits & flag::KIND == LightKind::Dome as u32 {
            let image = image_on(table, row).map(|image| image::refined(&image, true));
            if let Some(image) = &image {
                self.domes.push((light, DomeDistribution::of_emission(image)));
            }
            image.map_or([4.0 * std::f64::consts::PI; 3], |image| image::over_sphere(&image))
        } else if bits & flag::DELTA != 0 {
            [1.0; 3]
        } else {
            [std::f64::consts::TAU * f64::from(row[field::ONE_MINUS_COSINE]); 3]
        };
        let disk = |radius: f32| std::f64::consts::PI * f64::from(radius).powi(2);
        let aimed: f64 = self.targets.spheres.iter().map(|(_, radius)| disk(*radius)).sum();
        let area = if self.targets.is_empty() { disk(self.scene.1) } else { aimed.min(disk(self.scene.1)) };
        [0, 1, 2].map(|k| radiance[k] * whole[k] * area)
    }
}
