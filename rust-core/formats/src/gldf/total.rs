//! The light of a whole variant.

use super::{Emergency, EmitterUse, Gldf, Light, RatedFlux, Variant};
use crate::archive::inside;
use crate::error::{FormatError, Result};
use crate::l3d::L3d;
use crate::photometry::check::TOLERANCE;
use crate::photometry::text::{number, quote};
use crate::photometry::{Goniogram, HeaderLine, LampSet};
use crate::spectrum::SpectralPower;
use std::collections::BTreeMap;

/// Photometries of one variant: each is read, and all of their angles come together.
const MOST_FILES: usize = 32;

/// Uses of emitters in one variant.
const MOST_LIGHTS: usize = 10_000;

/// Fluxes that differ by no more than this are one that was rounded.
const ROUNDED: f64 = 0.005;

/// A file of photometry in a variant.
struct Part {
    found: Goniogram,
    flux: f64,
    /// How often it shines at its own flux.
    weight: f64,
}

/// A variant's light by the files that it comes from.
struct Parts {
    by_file: BTreeMap<usize, Part>,
    watts: Option<f64>,
    warnings: Vec<FormatError>,
}

impl Gldf<'_> {
    /// The light of a variant as it shines while there is no emergency: the sum of its emitters' photometries, each at the flux that the product
    /// rates it with, or at its photometry's own where the product states none. All have the luminaire's frame: turns are told.
    ///
    /// # Errors
    /// A variant without light, or what is wrong with a photometry, with its name inside the archive.
    pub fn goniogram(&self, variant: &Variant) -> Result<Goniogram> {
        let lights = self.lights(variant)?;
        let parts = self.parts(&lights)?;
        let Parts { by_file, watts, mut warnings } = parts;
        warnings.extend(turned(&lights));
        warnings.extend(self.object_problems(variant));
        let parts: Vec<Part> = by_file.into_values().collect();
        if parts.len() > 1 {
            let problem = format!("the light is the sum of {} photometries; the opening is that of the strongest", parts.len());
            warnings.push(FormatError::whole(problem));
        }
        let weighted: Vec<(&Goniogram, f64)> = parts.iter().map(|part| (&part.found, part.weight)).collect();
        let mut total = Goniogram::sum(&weighted)?;
        total.lamp_sets = vec![lamps(&lights, &total, watts)];
        total.lamp_set = 0;
        total.header = self.header(variant, total.header);
        total.spectrum = self.light_of_one_spectrum(&lights, &mut warnings).or(total.spectrum.take());
        total.warnings.extend(warnings);
        Ok(total)
    }

    /// The flux of a variant in lm in an emergency; `None` where none of its lights shines then.
    ///
    /// # Errors
    /// As [`Self::goniogram`].
    pub fn emergency_flux(&self, variant: &Variant) -> Result<Option<f64>> {
        let mut lights = Vec::new();
        for EmitterUse { emitter, .. } in variant.emitters.iter().take(MOST_LIGHTS) {
            let emitter = &self.emitters[emitter.clone()?];
            lights.extend(emitter.lights.iter().filter(|light| light.emergency != Emergency::None).take(MOST_LIGHTS));
        }
        let mut sum = None;
        for light in lights.into_iter().take(MOST_LIGHTS) {
            // Of a light whose flux is stated the photometry is not asked.
            let flux = match (light.emergency_flux, light.rated) {
                (Some(flux), _) => flux,
                (None, Some(RatedFlux::Luminaire(rated))) => rated,
                (None, _) => self.parts(&[light])?.by_file.values().map(|part| part.flux * part.weight).sum(),
            };
            sum = light.flux_in_emergency(flux).map(|flux| flux + sum.unwrap_or(0.0)).or(sum);
        }
        Ok(sum)
    }

    /// The lights that shine while there is no emergency, as often as the variant has them.
    fn lights(&self, variant: &Variant) -> Result<Vec<&Light>> {
        let mut lights = Vec::new();
        for EmitterUse { emitter, .. } in &variant.emitters {
            let emitter = &self.emitters[emitter.clone()?];
            lights.extend(emitter.lights.iter().filter(|light| light.is_normal()));
            if lights.len() > MOST_LIGHTS {
                return Err(FormatError::whole(format!("the variant has more than {MOST_LIGHTS} lights")));
            }
        }
        if lights.is_empty() {
            let name = quote(variant.name.shown());
            return Err(FormatError::whole(format!("the variant {name} names no emitter with a light, and so no photometry")));
        }
        Ok(lights)
    }

    fn parts(&self, lights: &[&Light]) -> Result<Parts> {
        let mut parts = Parts { by_file: BTreeMap::new(), watts: Some(0.0), warnings: Vec::new() };
        for light in lights {
            let file = light.photometry.clone()?;
            if !parts.by_file.contains_key(&file) {
                if parts.by_file.len() == MOST_FILES {
                    return Err(FormatError::whole(format!("the variant has more than {MOST_FILES} photometries")));
                }
                let found = self.photometry(file)?;
                parts.by_file.insert(file, Part { flux: found.flux(), found, weight: 0.0 });
            }
            let Some(part) = parts.by_file.get_mut(&file) else { continue };
            let (weight, told) = weight(light.rated, part);
            part.weight += weight;
            let name = self.files[file].place.as_str();
            let told = told.map(|told| inside(name, &FormatError::whole(told))).filter(|told| !parts.warnings.contains(told));
            parts.warnings.extend(told.filter(|_| parts.warnings.len() < MOST_FILES));
            parts.watts = parts.watts.zip(light.watts).map(|(sum, watts)| sum + watts);
        }
        Ok(parts)
    }

    /// The spectrum that all of the lights have; what cannot be used, and spectra of which there are several, is told and left out.
    fn light_of_one_spectrum(&self, lights: &[&Light], warnings: &mut Vec<FormatError>) -> Option<SpectralPower> {
        let first = lights.iter().find_map(|light| light.spectrum)?;
        if lights.iter().any(|light| light.spectrum != Some(first)) {
            warnings.push(FormatError::whole("its lights are not all of one spectrum: none is taken"));
            return None;
        }
        let left_out =
            |error: FormatError| warnings.push(FormatError { problem: format!("its spectrum is left out: {}", error.problem), ..error });
        self.spectrum(first).map_err(left_out).ok()
    }

    /// The head of the photometry, under the names of the product.
    fn header(&self, variant: &Variant, mut header: Vec<HeaderLine>) -> Vec<HeaderLine> {
        let (name, own) = (self.name.shown(), variant.name.shown());
        let name = if name.is_empty() || own.contains(name) { own.to_owned() } else { format!("{name}, {own}") };
        let number = [variant.number.shown(), self.number.shown()].into_iter().find(|number| !number.is_empty()).unwrap_or_default();
        for (keyword, text) in [("LUMINAIRE", name.as_str()), ("LUMCAT", number), ("MANUFAC", self.manufacturer.as_str())] {
            if !text.is_empty() {
                header.retain(|line| !line.keyword.eq_ignore_ascii_case(keyword));
                header.insert(0, HeaderLine { keyword: keyword.into(), text: crate::photometry::text::one_line(text) });
            }
        }
        header
    }

    /// What is wrong with the model's light emitting objects that a variant names, and how they are turned.
    fn object_problems(&self, variant: &Variant) -> Vec<FormatError> {
        let shines = |used: &&EmitterUse| used.emitter.as_ref().is_ok_and(|emitter| !self.emitters[*emitter].lights.is_empty());
        let names = variant.emitters.iter().filter(shines).map(|used| used.object.as_str());
        let names: Vec<&str> = names.filter(|name| !name.is_empty()).collect();
        let Some(bytes) = self.l3d(variant).filter(|_| !names.is_empty()) else { return Vec::new() };
        let found = bytes.and_then(|bytes| L3d::read(&bytes).map(|model| model.problems_of(&names)));
        found.unwrap_or_else(|problem| vec![FormatError::whole(format!("the model is not looked at: {problem}"))])
    }
}

/// Whether two fluxes are one, measured twice.
fn near(one: f64, other: f64) -> bool {
    (one / other - 1.0).abs() <= TOLERANCE
}

/// How often a photometry shines in a light of a rated flux, and what is to be told of it.
fn weight(rated: Option<RatedFlux>, part: &Part) -> (f64, Option<String>) {
    let lamps = part.found.lamps().filter(|lamps| !lamps.absolute).and_then(|lamps| lamps.flux).filter(|flux| *flux > 0.0);
    let (rated, own, whose) = match (rated, lamps) {
        (None, _) => return (1.0, None),
        // Some state the lamps' flux where the luminaire's belongs.
        (Some(RatedFlux::Luminaire(rated)), Some(lamps)) if near(rated, lamps) && !near(rated, part.flux) => {
            let left = part.flux * rated / lamps;
            let told = format!("the product's {} lm are those of the lamps here, of which {left:.1} lm leave the luminaire", number(rated));
            return (rated / lamps, Some(told));
        }
        (Some(RatedFlux::Luminaire(rated)), _) => (rated, part.flux, "light's"),
        (Some(RatedFlux::Lamps(rated)), Some(lamps)) => (rated, lamps, "lamps'"),
        (Some(RatedFlux::Lamps(rated)), None) => {
            return (1.0, Some(format!("is absolute: its {} lm are kept, whatever lamps of {} lm", number(part.flux), number(rated))));
        }
    };
    if own <= 0.0 {
        return (1.0, Some("has no light".into()));
    }
    let differs = (rated / own - 1.0).abs() > ROUNDED;
    // Products state whole lumens, which of weak lights are far from their own.
    if differs && rated.fract() == 0.0 && (rated - own).abs() <= 0.5 {
        return (1.0, None);
    }
    let told = || format!("the {whose} flux is {own:.1} lm here, the product rates it {} lm: that counts", number(rated));
    (rated / own, differs.then(told))
}

/// Emitters that the product turns.
fn turned(lights: &[&Light]) -> Option<FormatError> {
    let light = lights.iter().find(|light| light.rotation.iter().any(|angle| *angle != 0.0))?;
    let [x, y, z, g0] = light.rotation.map(number);
    let name = quote(light.name.shown());
    Some(FormatError::whole(format!(
        "the light {name} is turned by {x}°, {y}°, {z}° about X, Y, Z and {g0}° about G0: it stays as measured"
    )))
}

/// The lamps of a variant: its power, and the colour that all of its lights have.
fn lamps(lights: &[&Light], total: &Goniogram, watts: Option<f64>) -> LampSet {
    let own = total.lamps().cloned().unwrap_or_default();
    let common = |of: fn(&Light) -> Option<f64>| {
        let first = lights.first().and_then(|light| of(light));
        first.filter(|first| lights.iter().all(|light| of(light) == Some(*first)))
    };
    let name = lights.first().map(|light| light.name.shown()).filter(|name| !name.is_empty());
    LampSet {
        name: name.map_or(own.name.clone(), crate::photometry::text::one_line),
        watts: watts.filter(|watts| *watts > 0.0).unwrap_or(own.watts),
        colour: common(|light| light.temperature).map_or(own.colour.clone(), |kelvin| format!("{} K", number(kelvin))),
        colour_rendering: common(|light| light.rendering).map_or(own.colour_rendering.clone(), number),
        ..own
    }
}
