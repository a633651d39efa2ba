//! Other lamps in a picture by wavelength that has light groups: no path is traced anew.
//!
//! Light is linear: what a group brings to a pixel in a band is what its lamps send there times what walls, air and glass leave of it. So the new lamp's
//! spectrum over the old one's is the factor. Both have the same lumens.

use super::{SpectralLayer, SpectralPicture};
use crate::{
    error::{Error, Result},
    scene::Aov,
};
use gonio_spectrum::{Bands, Spectrum};

/// What becomes of a light group.
#[derive(Clone, Debug)]
pub struct NewLamp {
    /// The group's name.
    pub group: String,
    /// Its lamps' lumens over those that it had.
    pub factor: f64,
    /// Their spectrum; none keeps what it was.
    pub spectrum: Option<Spectrum>,
}

/// Share of a picture's light that its groups may lack.
const MOST_MISSING: f64 = 0.01;
/// Below this share of its most a lamp sends nothing in a band.
const LEAST: f32 = 1e-6;

impl SpectralPicture {
    /// The picture with other lamps in its light groups, of which it is the sum; groups that are not named stay as they are. Illuminance, which is not known
    /// by groups, is left out. Gives what a reader should know beside it.
    ///
    /// # Errors
    /// No light groups; a group that there is not; a new spectrum where the old one is not known.
    pub fn relit(mut self, lamps: &[NewLamp]) -> Result<(Self, Vec<String>)> {
        let had_luminance = self.image.layer(Aov::Luminance).is_some();
        self.check_groups(lamps)?;
        let share = 1.0 - self.power(|layer| layer.group().is_some()) / self.power(|layer| layer.aov == Aov::Color);
        let missing = || format!("{:.0} % of the light belongs to no group of the picture and is left out", 100.0 * share);
        let bands = self.bands;
        let mut notes: Vec<String> = (share > MOST_MISSING).then(missing).into_iter().collect();
        for lamp in lamps {
            let Some(layer) = self.layers.iter_mut().find(|layer| layer.group() == Some(lamp.group.as_str())) else { continue };
            notes.extend(layer.relight(bands, lamp)?);
        }
        let is_kept = |aov: Aov| matches!(aov, Aov::Color | Aov::LightGroup(_));
        self.layers.retain(|layer| is_kept(layer.aov));
        self.image.layers.retain(|layer| is_kept(layer.aov));
        self.add_groups();
        self.sum(had_luminance);
        Ok((self, notes))
    }

    fn check_groups(&self, lamps: &[NewLamp]) -> Result<()> {
        let names: Vec<&str> = self.layers.iter().filter_map(SpectralLayer::group).collect();
        if names.is_empty() {
            let problem = "the picture has no light groups by wavelength; gonio render --by-wavelength FILE --light-groups writes them";
            return Err(Error::setting("group", problem));
        }
        let unknown = lamps.iter().find(|lamp| !names.contains(&lamp.group.as_str()));
        unknown.map_or(Ok(()), |lamp| {
            let problem = format!("there is no light group '{}', expected one of {}", lamp.group, names.join(", "));
            Err(Error::setting("group", problem))
        })
    }

    /// All power of some passes.
    fn power(&self, of: impl Fn(&SpectralLayer) -> bool) -> f64 {
        let bands = self.layers.iter().filter(|layer| of(layer)).flat_map(|layer| &layer.bands);
        bands.flatten().copied().filter(|value| value.is_finite()).map(f64::from).sum()
    }

    /// Makes the colour the sum of the groups.
    fn add_groups(&mut self) {
        let (colours, groups): (Vec<&mut SpectralLayer>, Vec<&mut SpectralLayer>) =
            self.layers.iter_mut().partition(|layer| layer.aov == Aov::Color);
        for colour in colours {
            for (band, sum) in colour.bands.iter_mut().enumerate() {
                sum.fill(0.0);
                for values in groups.iter().filter_map(|group| group.bands.get(band)) {
                    sum.iter_mut().zip(values).for_each(|(sum, value)| *sum += value);
                }
            }
        }
    }
}

impl SpectralLayer {
    /// Gives a light group other lamps.
    fn relight(&mut self, bands: &Bands, lamp: &NewLamp) -> Result<Option<String>> {
        let Some(spectrum) = &lamp.spectrum else {
            self.bands.iter_mut().flatten().for_each(|value| *value *= lamp.factor as f32);
            return Ok(None);
        };
        let old = self.lamp.take().ok_or_else(|| {
            let problem = format!(
                "what the lamps of '{}' send is not known: they differ in spectrum or colour, a picture tells it, or surfaces that shine are among them",
                lamp.group
            );
            Error::setting("spectrum", problem)
        })?;
        let new = bands.tabulate(spectrum);
        let sources = sources(&old);
        let before = self.bands.clone();
        for (number, (values, source)) in self.bands.iter_mut().zip(&sources).enumerate() {
            let Some(source) = *source else { continue };
            let factor =
                lamp.factor * f64::from(new[number]) / f64::from(old[source]) * bands.power(number, 1.0) / bands.power(source, 1.0);
            values.iter_mut().zip(&before[source]).for_each(|(value, before)| *value = (factor * f64::from(*before)) as f32);
        }
        self.lamp = Some(new.clone());
        let dark: Vec<usize> = (0..old.len()).filter(|band| sources[*band] != Some(*band) && new[*band] > 0.0).collect();
        Ok(dark.first().zip(dark.last()).map(|(first, last)| {
            let half = 0.5 * bands.width_nm();
            let [from, to] = [bands.centre(*first) - half, bands.centre(*last) + half];
            format!(
                "'{}' had no light in {} bands within {from} to {to} nm: there its surroundings count as in the nearest band",
                lamp.group,
                dark.len()
            )
        }))
    }
}

/// For each band the nearest in which a lamp sends light, itself where it does; none where there is none.
fn sources(lamp: &[f32]) -> Vec<Option<usize>> {
    let most = lamp.iter().copied().fold(0.0, f32::max);
    let lit: Vec<usize> = (0..lamp.len()).filter(|band| lamp[*band] > LEAST * most).collect();
    (0..lamp.len()).map(|band| lit.iter().copied().min_by_key(|lit| lit.abs_diff(band))).collect()
}
