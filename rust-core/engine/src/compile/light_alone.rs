//! What paths from lights alone leave out of a scene, told where camera paths would show it.

use crate::{
    error::Diagnostic,
    light::LightTable,
    scene::{Integrator, Origin, Scene},
    transport::MaterialTable,
};

/// Names what [`Integrator::Light`] does not show.
pub(super) fn report(scene: &Scene, materials: &MaterialTable, lights: &LightTable, diagnostics: &mut Vec<Diagnostic>) {
    if scene.settings.integrator != Integrator::Light {
        return;
    }
    let origin = Origin::new("integrator light");
    let mut warn = |message: &str| diagnostics.push(Diagnostic::warning(&origin, message));
    let surfaces = &materials.surfaces;
    if lights.is_empty() {
        warn("nothing in the scene sends light; surfaces are dark");
    }
    if surfaces.iter().any(|surface| surface.surface.lobes.smooth) {
        warn("no light path meets the camera by a mirror or clear glass: it sees lights there, and nothing else");
    }
    if surfaces.iter().any(|surface| surface.surface.lobes.walk) {
        warn("light that comes out from under surfaces lights others, but is not seen itself");
    }
    if materials.media.scatters() || materials.media.shines() {
        warn("light that media scatter lights surfaces, but is not seen itself; what they send is missing");
    }
}
