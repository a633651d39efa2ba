//! Haze that fills all of space: prims with `gonio:haze` attributes, on any Xform; `docs/media.md` lists them.

use crate::context::Context;
use crate::prim::Prim;
use gonio::scene::{HAZE_ANISOTROPY, Medium, VISIBILITY_CONTRAST};

/// Every attribute's name begins so.
const PREFIX: &str = "gonio:haze:";

/// Whether the prim says how far one sees.
pub(crate) fn is_haze(prim: &Prim<'_>) -> bool {
    prim.has_authored_prefix(PREFIX)
}

/// Fills space with what the prim says; what is wrong with it is told, and the air stays as it was.
pub(crate) fn fill<'py>(context: &mut Context<'_, 'py>, prim: &Prim<'py>) {
    if !context.scene.atmosphere.is_clear() {
        return context.warn(&prim.origin(), "another prim says what fills all of space; this one's haze is left out".to_owned());
    }
    match read(context, prim) {
        Ok(medium) => context.scene.atmosphere = medium,
        Err(problem) => context.warn(&prim.origin(), format!("{problem}; there is no haze")),
    }
}

fn read<'py>(context: &mut Context<'_, 'py>, prim: &Prim<'py>) -> Result<Medium, String> {
    let mut number = |name: &str| context.get_authored::<f64>(prim, &format!("{PREFIX}{name}"));
    let (visibility, extinction) = (number("visibility"), number("extinction"));
    let contrast = number("contrast").unwrap_or(VISIBILITY_CONTRAST);
    let anisotropy = number("anisotropy").map_or(HAZE_ANISOTROPY, |g| g as f32);
    let albedo = context.get_authored::<[f32; 3]>(prim, &format!("{PREFIX}albedo")).unwrap_or([1.0; 3]);
    if !(contrast > 0.0 && contrast < 1.0) {
        return Err(format!("gonio:haze:contrast is {contrast}, expected a number between 0 and 1"));
    }
    if !albedo.iter().all(|part| (0.0..=1.0).contains(part)) {
        return Err(format!("gonio:haze:albedo is {albedo:?}, expected numbers from 0 to 1"));
    }
    if !(-0.999..=0.999).contains(&anisotropy) {
        return Err(format!("gonio:haze:anisotropy is {anisotropy}, expected a number from -0.999 to 0.999"));
    }
    let extinction = match (visibility, extinction) {
        (None, Some(extinction)) if extinction >= 0.0 && extinction.is_finite() => extinction,
        (Some(visibility), None) if visibility > 0.0 && visibility.is_finite() => Medium::extinction_of(visibility, contrast),
        _ => return Err("expected either gonio:haze:visibility, metres above 0, or gonio:haze:extinction, 0 or more a metre".to_owned()),
    };
    Ok(Medium::haze(extinction, albedo, anisotropy))
}
