//! What is to be reached, by the quantity of what it names.

use super::{
    DimTask, Near,
    groups::{LightGroup, check_numbers},
    told,
};
use crate::{
    error::{Error, Result},
    scene::{Measurand, Scene},
};
use gonio_dimming::{Goal, Target};

/// Targets, and what is sought beyond them.
#[derive(Debug)]
pub(super) struct Asked {
    /// Of quantities that are linear in the light.
    pub(super) light: Vec<Target>,
    /// Of glare, which is rated once the levels are known.
    pub(super) glare: Vec<Target>,
    pub(super) goal: Goal,
}

impl Asked {
    pub(super) fn new(task: &DimTask<'_>, scene: &Scene, groups: &[LightGroup]) -> Result<Self> {
        let targets = task.targets.iter().map(|text| Target::parse(text)).collect::<std::result::Result<Vec<_>, _>>();
        let mut asked = Self { light: Vec::new(), glare: Vec::new(), goal: goal(&task.near, groups)? };
        let mut known: Vec<(&str, Measurand)> = scene.meters.iter().map(|meter| (&*meter.origin.name, meter.measurand)).collect();
        known.extend(scene.grids.iter().map(|grid| (&*grid.origin.name, grid.measurand)));
        for target in targets.map_err(|error| told("target", error))? {
            let found = target.find(&known, |(name, _)| name).map_err(|error| told("target", error))?;
            if target.limit.is_of_colour() {
                check_coloured(&target, found.1, scene)?;
                asked.light.push(target);
                continue;
            }
            match found.1 {
                Measurand::Ugr => asked.glare.push(target),
                Measurand::DaylightFactor => {
                    let problem = format!("'{}' measures the daylight factor, which no dimming changes", target.area);
                    return Err(Error::setting("target", problem));
                }
                Measurand::Cct | Measurand::Duv | Measurand::Ra | Measurand::Rf | Measurand::Rg => {
                    let problem = format!("'{}' measures a colour: name NAME.cct, or measure its illuminance", target.area);
                    return Err(Error::setting("target", problem));
                }
                _ => asked.light.push(target),
            }
        }
        if asked.light.iter().all(|target| target.limit.is_of_colour()) {
            let problem = "glare and colour alone say nothing of how much light there is; name a target of that, as NAME.mean>=500";
            return Err(Error::setting("target", problem));
        }
        Ok(asked)
    }

    /// Whether a target of light names what has this name.
    pub(super) fn names_light(&self, name: &str) -> bool {
        self.light.iter().any(|target| target.names(name))
    }

    /// Whether a target of the light's colour names what has this name.
    pub(super) fn names_colour(&self, name: &str) -> bool {
        self.light.iter().any(|target| target.limit.is_of_colour() && target.names(name))
    }

    /// Whether a target of glare names what has this name.
    pub(super) fn names_glare(&self, name: &str) -> bool {
        self.glare.iter().any(|target| target.names(name))
    }
}

/// The colour of the light is known where a plane is measured.
fn check_coloured(target: &Target, measurand: Measurand, scene: &Scene) -> Result<()> {
    let wrong = |problem: String| Err(Error::setting("target", problem));
    if !matches!(measurand, Measurand::Illuminance | Measurand::Cct) {
        return wrong(format!("'{}' measures {}, expected illuminance or cct for NAME.cct", target.area, measurand.name()));
    }
    if scene.grids.iter().any(|grid| grid.eyes.is_some() && target.names(&grid.origin.name)) {
        return wrong(format!("'{}' has eyes, expected a plane for NAME.cct", target.area));
    }
    Ok(())
}

/// What is sought by the groups' order.
fn goal(near: &Near, groups: &[LightGroup]) -> Result<Goal> {
    let wished = match near {
        Near::LeastPower => return Ok(Goal::LeastPower),
        Near::Equal => return Ok(Goal::Equal),
        Near::Levels(wished) => wished,
    };
    let names: Vec<String> = groups.iter().map(|group| group.group.name.clone()).collect();
    check_numbers("near", wished, &names)?;
    if let Some((name, level)) = wished.iter().find(|(_, level)| *level > 1.0) {
        return Err(Error::setting("near", format!("group '{name}' is to be near {level}, expected a level from 0 to 1")));
    }
    let of = |name: &String| wished.iter().rev().find(|(known, _)| known == name).map(|(_, level)| *level);
    Ok(Goal::Near(names.iter().map(of).collect()))
}
