//! Daylight factors: light of the sky alone, indoors and on unobstructed level ground. The sun's disc counts for neither (EN 17037).

use super::sense::Probe;
use crate::{
    error::{Error, Result},
    scene::{Light, LightShape, Meter, Origin, Scene},
};

/// The scene with domes as its only lights, and portals, which only tell where to look for them.
pub(super) fn under_domes(scene: &Scene, asked: &Origin) -> Result<Scene> {
    let lights: Vec<Light> = scene.lights.iter().filter(|light| is_dome(light) || light.portal).cloned().collect();
    if !lights.iter().any(is_dome) {
        return Err(Error::scene(asked, "a daylight factor wants a sky; the scene has no dome"));
    }
    Ok(Scene { lights, ..scene.without_emission() })
}

fn is_dome(light: &Light) -> bool {
    matches!(light.shape, LightShape::Dome { .. })
}

/// The sky over nothing, and a luxmeter that faces its zenith.
pub(super) struct ExteriorSky {
    pub(super) scene: Scene,
    pub(super) probe: Probe,
}

impl ExteriorSky {
    /// The first dome tells where up is.
    pub(super) fn new(sky: &Scene) -> Result<Self> {
        let lights: Vec<Light> = sky.lights.iter().filter(|light| is_dome(light)).cloned().collect();
        let zenith = lights.first().map_or([0.0, 1.0, 0.0], |dome| dome.transform.vector([0.0, 1.0, 0.0]));
        let origin = lights.first().map_or_else(Origin::default, |dome| dome.origin.clone());
        let probe = Probe::new(&Meter { origin, normal: zenith, ..Meter::default() })?;
        let scene = Scene { lights, textures: sky.textures.clone(), settings: sky.settings.clone(), ..Scene::default() };
        Ok(Self { scene, probe })
    }
}
