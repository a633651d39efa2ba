//! A stage's light groups, their power, and the levels that they may have.

use super::told::note;
use crate::arguments::DimOptions;
use gonio::{
    Error, Result,
    compile::luminous_fluxes,
    scene::{Light, OTHER_LIGHTS},
};
use gonio_dimming::Group;
use gonio_usd::Loaded;

/// What counts as the efficacy of lights whose power nobody states.
const LUMENS_PER_WATT: f64 = 100.0;

/// Where a group's power is from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum PowerSource {
    /// The command line.
    Option,
    /// Its luminaires' files.
    Files,
    /// Its flux, for some of its lights at least.
    Flux,
}

impl PowerSource {
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Option => "option",
            Self::Files => "files",
            Self::Flux => "flux",
        }
    }
}

/// Lights of the scene that are dimmed together.
#[derive(Clone, Debug)]
pub(super) struct LightGroup {
    pub(super) group: Group,
    pub(super) source: PowerSource,
    /// Their numbers in the scene.
    pub(super) lights: Vec<usize>,
    /// Their prims.
    pub(super) prims: Vec<String>,
}

impl LightGroup {
    /// All that a stage names, in its order.
    pub(super) fn all(options: &DimOptions, loaded: &Loaded) -> Result<Vec<Self>> {
        let names = names(options, loaded)?;
        let (watts, fixed) = (numbers("watts", &options.watts, &names)?, numbers("fixed", &options.fixed, &names)?);
        if let Some((name, level)) = fixed.iter().find(|(_, level)| *level > 1.0) {
            return Err(Error::setting("fixed", format!("group '{name}' is fixed at {level}, expected a level from 0 to 1")));
        }
        let of = |list: &[(String, f64)], name: &str| list.iter().rev().find(|(known, _)| known == name).map(|(_, number)| *number);
        let fluxes = luminous_fluxes(&loaded.scene);
        let group = |name: &String| {
            let belongs = |light: &Light| light.group == *name && !light.portal;
            let lights: Vec<usize> = (0..loaded.scene.lights.len()).filter(|k| belongs(&loaded.scene.lights[*k])).collect();
            let mut prims: Vec<String> = lights.iter().map(|k| loaded.scene.lights[*k].origin.name.to_string()).collect();
            prims.sort();
            prims.dedup();
            let (watts, source) = of(&watts, name).map_or_else(|| power(loaded, &lights, &fluxes), |watts| (watts, PowerSource::Option));
            if source == PowerSource::Flux {
                let shown = "no power is stated for it, or for some of it; its flux counts at 100 lm/W. --watts GROUP=W states it";
                note(options, &format!("light group '{name}': {shown}"));
            }
            let range = of(&fixed, name).map_or([options.min_level, 1.0], |level| [level, level]);
            Self { group: Group { name: name.clone(), watts, range }, source, lights, prims }
        };
        Ok(names.iter().map(group).collect())
    }
}

/// Names of the groups that hold lights; surfaces that shine have no dimmer, which is told.
fn names(options: &DimOptions, loaded: &Loaded) -> Result<Vec<String>> {
    let scene = &loaded.scene;
    let mut names = scene.light_groups();
    names.retain(|name| name != OTHER_LIGHTS);
    names.retain(|name| {
        let is_shining = scene.instances.iter().any(|set| set.light_group == *name);
        if is_shining {
            note(options, &format!("warning: light group '{name}' holds surfaces; what they send themselves is not dimmed"));
        }
        scene.lights.iter().any(|light| light.group == *name && !light.portal)
    });
    if names.is_empty() {
        let problem = "no light of the stage is in a light group; token gonio:lightGroup = \"NAME\" on lights makes groups";
        return Err(Error::setting("target", problem));
    }
    Ok(names)
}

/// Power in W of lights at level 1, by their files or else by their flux; light from infinity takes none.
fn power(loaded: &Loaded, lights: &[usize], fluxes: &[Option<f64>]) -> (f64, PowerSource) {
    let stated = |k: &usize| {
        let file = loaded.luminaires.iter().find(|file| file.is_of(&loaded.scene.lights[*k]))?;
        file.photometry.figures().watts
    };
    let mut source = PowerSource::Files;
    let mut watts = 0.0;
    for k in lights.iter().filter(|k| !loaded.scene.lights[**k].shape.is_at_infinity()) {
        watts += stated(k).unwrap_or_else(|| {
            source = PowerSource::Flux;
            fluxes.get(*k).copied().flatten().unwrap_or(0.0) / LUMENS_PER_WATT
        });
    }
    (watts, source)
}

/// Groups' numbers of zero or more, as an option has them.
pub(super) fn numbers(option: &str, texts: &[String], names: &[String]) -> Result<Vec<(String, f64)>> {
    let number = |text: &String| {
        let wrong = || Error::setting(option, format!("'{text}' was found, expected GROUP=NUMBER with a number of zero or more"));
        let (name, number) = text.rsplit_once('=').ok_or_else(wrong)?;
        let number = number.trim().parse().ok().filter(|x: &f64| x.is_finite() && *x >= 0.0).ok_or_else(wrong)?;
        if !names.iter().any(|known| known == name) {
            return Err(Error::setting(option, format!("there is no light group '{name}', expected one of {}", names.join(", "))));
        }
        Ok((name.to_owned(), number))
    };
    texts.iter().map(number).collect()
}
