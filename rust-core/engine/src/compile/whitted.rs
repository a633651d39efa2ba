//! What trees of rays leave out of a scene, told where paths would show it.

use crate::{
    error::Diagnostic,
    light::LightTable,
    scene::{Integrator, Origin, Scene},
    transport::MaterialTable,
};

/// Names what [`Integrator::Whitted`] shows otherwise than paths do, beyond the light from surface to surface that it always leaves out.
pub(super) fn report(scene: &Scene, materials: &MaterialTable, lights: &LightTable, diagnostics: &mut Vec<Diagnostic>) {
    if scene.settings.integrator != Integrator::Whitted {
        return;
    }
    let origin = Origin::new("integrator whitted");
    let mut warn = |message: String| diagnostics.push(Diagnostic::warning(&origin, message));
    let surfaces = &materials.surfaces;
    if lights.has_tree() {
        warn(format!("{} lights are more than each point can ask; it takes 64 that are chosen alike everywhere", lights.len()));
    }
    if surfaces.iter().any(|surface| surface.surface.lobes.walk) {
        warn("light does not walk under surfaces; subsurface scattering shows as diffuse".to_owned());
    }
    if (0..materials.numbers.len()).any(|material| materials.emits_unknown(material)) {
        warn("surfaces whose emission depends on the bounces before shine, but light nothing".to_owned());
    }
    if materials.media.scatters() || materials.media.shines() {
        warn("media take light away; what they scatter and send is missing".to_owned());
    }
    if scene.settings.antialiasing.is_adaptive() {
        let camera = scene.cameras.get(scene.settings.camera as usize);
        if camera.is_some_and(|camera| camera.lens_radius > 0.0) {
            warn("adaptive antialiasing looks through the middle of the lens; a regular grid shows the depth of field".to_owned());
        }
        if scene.instances.iter().any(|instances| instances.shadow_catcher) {
            warn("adaptive antialiasing knows no shadow catchers; a regular grid shows what they catch".to_owned());
        }
    }
}
