//! Windows whose blinds are operated together.

use crate::{
    error::{Error, Result},
    measure::is_of,
    scene::Scene,
    transport::Openings,
};
use gonio_annual::Schedule;

/// Windows whose blinds are operated together.
#[derive(Clone, Debug, Default)]
pub struct Facade {
    /// What it is called.
    pub name: String,
    /// The prims through which its light comes, each with all below it: panes, and blinds if light goes through these. Without any it is all light.
    pub prims: Vec<String>,
    /// The blinds; `None` where there are none.
    pub blinds: Option<FacadeBlinds>,
    /// When they are closed; `None` leaves it to direct sun.
    pub closed: Option<Schedule>,
}

/// What blinds leave of the light when they are closed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum FacadeBlinds {
    /// This share of that through open ones.
    Share(f32),
    /// What is traced in this one of the scenes with closed blinds.
    Scene(usize),
}

/// Refuses facades that cannot be told apart in a scene.
pub(super) fn check(scene: &Scene, facades: &[Facade]) -> Result<()> {
    if facades.len() > Openings::MOST {
        return Err(Error::setting("group", format!("{} were found, expected at most {}", facades.len(), Openings::MOST)));
    }
    for set in &scene.instances {
        for placement in 0..set.transforms.len() {
            let mut owners = facades.iter().filter(|facade| is_of(set, placement, &facade.prims)).map(|facade| &facade.name);
            if let (Some(first), Some(second)) = (owners.next(), owners.next()) {
                return Err(Error::scene(&set.origin, format!("it is of the groups '{first}' and '{second}'; light comes by one")));
            }
        }
    }
    let has_prim = |prim: &String| {
        let prims = std::slice::from_ref(prim);
        scene.instances.iter().any(|set| (0..set.transforms.len()).any(|placement| is_of(set, placement, prims)))
    };
    for facade in facades {
        if let Some(prim) = facade.prims.iter().find(|prim| !has_prim(prim)) {
            let problem = format!("'{}' has no surface at or below {prim} that light could come through", facade.name);
            return Err(Error::setting("group", problem));
        }
    }
    Ok(())
}
