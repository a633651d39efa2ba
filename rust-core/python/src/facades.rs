//! Groups of windows of `gonio.annual`: what is said of all or, in dictionaries, of each by its name.

use crate::{
    annual::{measured, used_steps},
    error::setting,
    scene::Scene,
};
use gonio::{
    annual::{Facade, FacadeBlinds},
    scene::Scene as Description,
};
use gonio_annual::Year;
use pyo3::{prelude::*, types::PyDict};

/// What was said of blinds.
pub(crate) struct Said<'a, 'py> {
    /// Prims by group.
    pub(crate) groups: Option<&'a Bound<'py, PyDict>>,
    pub(crate) blinds: Option<&'a Bound<'py, PyAny>>,
    pub(crate) closed: Option<&'a Bound<'py, PyAny>>,
    pub(crate) closed_hours: Option<&'a Bound<'py, PyAny>>,
}

impl<'py> Said<'_, 'py> {
    /// The groups, and the scenes with closed blinds, each once.
    pub(crate) fn facades(&self, year: &Year, samples: u32) -> PyResult<(Vec<Facade>, Vec<Description>)> {
        let mut facades = self.named()?;
        for (option, said) in [("blinds", self.blinds), ("closed", self.closed), ("closed_hours", self.closed_hours)] {
            check_names(option, said, &facades)?;
        }
        let (mut scenes, mut pointers) = (Vec::new(), Vec::new());
        for facade in &mut facades {
            let of = |said: Option<&Bound<'py, PyAny>>| of_group(said, &facade.name);
            let (share, closed, hours) = (of(self.blinds)?, of(self.closed)?, of(self.closed_hours)?);
            facade.blinds = match (share, closed) {
                (Some(_), Some(_)) => {
                    return Err(setting("blinds", "a share and a scene were found for the same blinds, expected one of both".to_owned()));
                }
                (Some(share), None) => Some(FacadeBlinds::Share(checked(share.extract()?)?)),
                (None, Some(closed)) => Some(FacadeBlinds::Scene(match pointers.iter().position(|pointer| *pointer == closed.as_ptr()) {
                    Some(known) => known,
                    None => {
                        pointers.push(closed.as_ptr());
                        scenes.push(measured(&closed.extract::<PyRef<'_, Scene>>()?.scene, samples));
                        scenes.len() - 1
                    }
                })),
                (None, None) => None,
            };
            facade.closed = hours.map(|hours| used_steps(Some(&hours), year)).transpose()?;
        }
        if self.closed_hours.is_some() && facades.iter().all(|facade| facade.blinds.is_none()) {
            return Err(setting("closed_hours", "there are no blinds; blinds or closed says what they leave".to_owned()));
        }
        Ok((facades, scenes))
    }

    /// Groups without blinds yet; one of all light where none is named.
    fn named(&self) -> PyResult<Vec<Facade>> {
        let Some(groups) = self.groups.filter(|groups| !groups.is_empty()) else { return Ok(vec![Facade::default()]) };
        let named = |(name, prims): (Bound<'py, PyAny>, Bound<'py, PyAny>)| {
            let prims = prims.extract::<String>().map(|prim| vec![prim]).or_else(|_| prims.extract())?;
            Ok(Facade { name: name.extract()?, prims, ..Facade::default() })
        };
        let facades = groups.iter().map(named).collect::<PyResult<Vec<_>>>()?;
        match facades.iter().find(|facade| facade.prims.is_empty()) {
            Some(empty) => Err(setting("groups", format!("'{}' names no prim that its light comes through", empty.name))),
            None => Ok(facades),
        }
    }
}

/// What is said of a group.
fn of_group<'py>(said: Option<&Bound<'py, PyAny>>, name: &str) -> PyResult<Option<Bound<'py, PyAny>>> {
    match said.map(|said| said.cast::<PyDict>()) {
        Some(Ok(by_name)) => by_name.get_item(name),
        _ => Ok(said.cloned()),
    }
}

fn check_names(option: &str, said: Option<&Bound<'_, PyAny>>, facades: &[Facade]) -> PyResult<()> {
    let Some(Ok(by_name)) = said.map(|said| said.cast::<PyDict>()) else { return Ok(()) };
    for name in by_name.keys() {
        let name: String = name.extract()?;
        if !facades.iter().any(|facade| facade.name == name) {
            return Err(setting(option, format!("no group is called '{name}'")));
        }
    }
    Ok(())
}

fn checked(share: f32) -> PyResult<f32> {
    let is_right = (0.0..=1.0).contains(&share);
    if is_right { Ok(share) } else { Err(setting("blinds", format!("{share} was found, expected 0 to 1"))) }
}
