//! A scene's light groups, their power, and the levels that they may have.

use super::DimTask;
use crate::{
    compile::luminous_fluxes_of_all,
    error::{Diagnostic, Error, Result},
    scene::{Light, OTHER_LIGHTS, Origin, Scene},
};
use gonio_dimming::Group;

/// What counts as the efficacy of lights whose power nobody states.
const LUMENS_PER_WATT: f64 = 100.0;

/// Where a group's power is from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PowerSource {
    /// Who asks.
    Option,
    /// Its luminaires' files.
    Files,
    /// Its flux, for some of its lights at least.
    Flux,
}

impl PowerSource {
    /// In a word.
    pub fn name(self) -> &'static str {
        match self {
            Self::Option => "option",
            Self::Files => "files",
            Self::Flux => "flux",
        }
    }
}

/// Lights of the scene that are dimmed together.
#[derive(Clone, Debug)]
pub struct LightGroup {
    /// Its name, power and levels.
    pub group: Group,
    /// Where its power is from.
    pub source: PowerSource,
    /// Their numbers in the scene.
    pub lights: Vec<usize>,
    /// Their prims.
    pub prims: Vec<String>,
}

impl LightGroup {
    /// All that a scene names, in its order; what cannot be dimmed is told, what is to be known of them goes into the notes.
    pub(super) fn all(task: &DimTask<'_>, scene: &Scene, told: &mut Vec<Diagnostic>, notes: &mut Vec<String>) -> Result<Vec<Self>> {
        let names = names(scene, told)?;
        let (watts, fixed) = (task.watts, task.fixed);
        check_numbers("watts", watts, &names)?;
        check_numbers("fixed", fixed, &names)?;
        if !(0.0..=1.0).contains(&task.min_level) {
            return Err(Error::setting("min-level", format!("{} was found, expected 0 to 1", task.min_level)));
        }
        if let Some((name, level)) = fixed.iter().find(|(_, level)| *level > 1.0) {
            return Err(Error::setting("fixed", format!("group '{name}' is fixed at {level}, expected a level from 0 to 1")));
        }
        let of = |list: &[(String, f64)], name: &str| list.iter().rev().find(|(known, _)| known == name).map(|(_, number)| *number);
        let fluxes = luminous_fluxes_of_all(scene);
        let group = |name: &String| {
            let belongs = |light: &Light| light.group == *name && !light.portal;
            let lights: Vec<usize> = (0..scene.lights.len()).filter(|k| belongs(&scene.lights[*k])).collect();
            let mut prims: Vec<String> = lights.iter().map(|k| scene.lights[*k].origin.name.to_string()).collect();
            prims.sort();
            prims.dedup();
            let (watts, source) = of(watts, name).map_or_else(|| power(scene, (&lights, &fluxes)), |watts| (watts, PowerSource::Option));
            if source == PowerSource::Flux {
                notes.push(format!("light group '{name}': no power is stated for it, or for some of it; its flux counts at 100 lm/W"));
            }
            let range = of(fixed, name).map_or([task.min_level, 1.0], |level| [level, level]);
            Self { group: Group { name: name.clone(), watts, range }, source, lights, prims }
        };
        Ok(names.iter().map(group).collect())
    }
}

/// Names of the groups that hold lights; surfaces that shine have no dimmer, which is told.
fn names(scene: &Scene, told: &mut Vec<Diagnostic>) -> Result<Vec<String>> {
    let mut names = scene.light_groups();
    names.retain(|name| name != OTHER_LIGHTS);
    names.retain(|name| {
        let is_shining = scene.instances.iter().any(|set| set.light_group == *name);
        if is_shining {
            let origin = Origin::new(format!("light group '{name}'"));
            told.push(Diagnostic::warning(&origin, "it holds surfaces; what they send themselves is not dimmed"));
        }
        scene.lights.iter().any(|light| light.group == *name && !light.portal)
    });
    if names.is_empty() {
        let problem = "no light is in a light group; token gonio:lightGroup = \"NAME\" on lights makes groups";
        return Err(Error::setting("target", problem));
    }
    Ok(names)
}

/// Power in W of lights at level 1, as they are dimmed in the scene, by their files or else by their flux when new; light from infinity takes none.
fn power(scene: &Scene, (lights, fluxes): (&[usize], &[Option<f64>])) -> (f64, PowerSource) {
    let mut source = PowerSource::Files;
    let mut watts = 0.0;
    for k in lights.iter().filter(|k| !scene.lights[**k].shape.is_at_infinity()) {
        let light = &scene.lights[*k];
        let stated = light.goniogram.as_ref().and_then(|file| file.watts);
        watts += stated.map(|watts| watts * f64::from(light.dimming)).unwrap_or_else(|| {
            source = PowerSource::Flux;
            let flux = fluxes.get(*k).copied().flatten().unwrap_or(0.0);
            if light.maintenance > 0.0 { flux / f64::from(light.maintenance) / LUMENS_PER_WATT } else { 0.0 }
        });
    }
    (watts, source)
}

/// Says which of the groups' numbers is below zero or of none.
pub(super) fn check_numbers(setting: &'static str, numbers: &[(String, f64)], names: &[String]) -> Result<()> {
    for (name, number) in numbers {
        if !(number.is_finite() && *number >= 0.0) {
            return Err(Error::setting(setting, format!("{number} of group '{name}' was found, expected a number of zero or more")));
        }
        if !names.contains(name) {
            return Err(Error::setting(setting, format!("there is no light group '{name}', expected one of {}", names.join(", "))));
        }
    }
    Ok(())
}
