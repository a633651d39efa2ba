//! Groups of windows as options tell them: names, prims, and what is said of all or of one.

use super::inputs::{schedule, share};
use crate::arguments::FacadeArguments;
use gonio::{
    Error, Result,
    annual::{Facade, FacadeBlinds},
};
use gonio_annual::Year;

/// The groups, and the variants of each scene with closed blinds.
pub(super) fn facades(options: &FacadeArguments, year: &Year) -> Result<(Vec<Facade>, Vec<Vec<String>>)> {
    let mut facades = named(&options.group)?;
    if facades.is_empty() {
        facades.push(Facade::default());
    }
    let mut scenes: Vec<Vec<String>> = Vec::new();
    for facade in &mut facades {
        let shares = said("blinds", &options.blinds, &options.group, &facade.name)?;
        let variants = said("closed-variant", &options.closed_variant, &options.group, &facade.name)?;
        let hours = said("closed-hours", &options.closed_hours, &options.group, &facade.name)?;
        facade.blinds = match (shares.last(), variants.is_empty()) {
            (Some(_), false) => {
                return Err(Error::setting("blinds", "a share and a variant were found for the same blinds, expected one of both"));
            }
            (Some(text), true) => {
                let number = text.trim().parse().map_err(|_| Error::setting("blinds", format!("'{text}' was found, expected 0 to 1")))?;
                share(Some(number))?.map(FacadeBlinds::Share)
            }
            (None, true) => None,
            (None, false) => {
                let known = scenes.iter().position(|scene| *scene == variants);
                Some(FacadeBlinds::Scene(known.unwrap_or_else(|| {
                    scenes.push(variants);
                    scenes.len() - 1
                })))
            }
        };
        facade.closed = hours.last().map(|hours| schedule(hours, year)).transpose()?;
    }
    match options.closed_hours.first() {
        Some(hours) if facades.iter().all(|facade| facade.blinds.is_none()) => {
            let problem = format!("'{hours}' was found, but no blinds; --blinds or --closed-variant says what they leave");
            Err(Error::setting("closed-hours", problem))
        }
        _ => Ok((facades, scenes)),
    }
}

/// Groups without blinds yet, in the order of their first prims.
fn named(texts: &[String]) -> Result<Vec<Facade>> {
    let mut facades: Vec<Facade> = Vec::new();
    for text in texts {
        let pair = text.split_once('=').filter(|(name, prim)| !name.is_empty() && prim.starts_with('/'));
        let (name, prim) = pair.ok_or_else(|| Error::setting("group", format!("'{text}' was found, expected NAME=/Prim")))?;
        let known = facades.iter().position(|facade| facade.name == name).unwrap_or_else(|| {
            facades.push(Facade { name: name.to_owned(), ..Facade::default() });
            facades.len() - 1
        });
        facades[known].prims.push(prim.to_owned());
    }
    Ok(facades)
}

/// What an option says of a group: what is said of it by name, else what is said of all.
fn said(option: &'static str, texts: &[String], groups: &[String], name: &str) -> Result<Vec<String>> {
    let (mut of_all, mut of_it) = (Vec::new(), Vec::new());
    for text in texts {
        // Neither prims nor files of hours begin with a name and '='.
        match text.split_once('=').filter(|(front, _)| !front.contains(['/', '{'])) {
            None => of_all.push(text.clone()),
            Some((front, rest)) if front == name => of_it.push(rest.to_owned()),
            Some((front, _)) if groups.iter().any(|group| group.split_once('=').is_some_and(|(other, _)| other == front)) => {}
            Some((front, _)) => {
                return Err(Error::setting(option, format!("no group is called '{front}'; --group {front}=/Prim makes one")));
            }
        }
    }
    Ok(if of_it.is_empty() { of_all } else { of_it })
}
