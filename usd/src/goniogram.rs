//! Luminaires' files: of UsdLux's ShapingAPI, literally by its specification, factors on the light's radiance; of `gonio:photometry`, candela.

use crate::asset;
use crate::context::Context;
use crate::luminaire_file::LuminaireFile;
use crate::prim::Prim;
use crate::vt::AssetPath;
use gonio::Error;
use gonio::scene::{Goniogram, Origin, PhotometricType};
use gonio_formats::{FormatError, photometry};
use std::{f64::consts::PI, sync::Arc};

/// The attribute that names the variant of a GLDF file, or the mode of a GDTF file.
const VARIANT: &str = "gonio:photometry:variant";

/// What a light asks of its file.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Request {
    /// `shaping:ies:angleScale`.
    pub(crate) angle_scale: f32,
    /// `shaping:ies:normalize`.
    pub(crate) normalized: bool,
}

/// The goniogram that a light's file holds, the same one for all lights that ask the same of it; `None` where there is none, which is told with the
/// prim and the file.
pub(crate) fn goniogram<'py>(
    context: &mut Context<'_, 'py>,
    prim: &Prim<'py>,
    path: &AssetPath,
    request: Request,
) -> Option<Arc<Goniogram>> {
    let asked = format!("{}\n{}", request.angle_scale.to_bits(), request.normalized);
    known_or_read(context, prim, path, &asked, "the light shines as without a distribution", |context, origin, found| {
        let goniogram = requested(context, origin, &found, request);
        (found, goniogram)
    })
}

/// How a luminaire is lamped and hung.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Lamping {
    /// Number of the file's lamp set, from 1.
    pub(crate) lamp_set: Option<i32>,
    /// Degrees for the file's tilt factors.
    pub(crate) tilt_deg: f64,
}

/// The goniogram of a luminaire's file in candela, the same one for all lights that ask the same of it; `None` where there is none, and what is done
/// `instead` is told. What the file has not is a warning, and the luminaire is as the file has it.
pub(crate) fn absolute<'py>(
    context: &mut Context<'_, 'py>,
    prim: &Prim<'py>,
    path: &AssetPath,
    lamping: Lamping,
    instead: &str,
) -> Option<Arc<Goniogram>> {
    let asked = format!("absolute {:?} {}", lamping.lamp_set, lamping.tilt_deg.to_bits());
    known_or_read(context, prim, path, &asked, instead, |context, origin, found| {
        let found = lamped(context, origin, path, found, lamping);
        let goniogram = Goniogram::from(&found);
        (found, goniogram)
    })
}

/// The goniogram that was made of a file for the same wishes before, or is made of it now; the file is noted down then.
fn known_or_read<'py>(
    context: &mut Context<'_, 'py>,
    prim: &Prim<'py>,
    path: &AssetPath,
    asked: &str,
    instead: &str,
    make: impl FnOnce(&mut Context<'_, 'py>, &Origin, photometry::Goniogram) -> (photometry::Goniogram, Goniogram),
) -> Option<Arc<Goniogram>> {
    let variant = context.get_authored::<String>(prim, VARIANT).filter(|variant| !variant.is_empty());
    let key = format!("{}\n{}\n{variant:?}\n{asked}", path.authored, path.resolved);
    if let Some(known) = context.goniograms.get(&key) {
        return known.clone();
    }
    let origin = prim.origin();
    let read = read(context, path, variant.as_deref(), &origin, instead).map(|found| {
        let (photometry, goniogram) = make(context, &origin, found);
        let goniogram = Arc::new(goniogram);
        context.luminaires.push(LuminaireFile { path: path.authored.clone(), photometry, goniogram: goniogram.clone() });
        goniogram
    });
    context.goniograms.insert(key, read.clone());
    read
}

/// The luminaire with its lamps and its tilt.
fn lamped(
    context: &mut Context<'_, '_>,
    origin: &Origin,
    path: &AssetPath,
    found: photometry::Goniogram,
    lamping: Lamping,
) -> photometry::Goniogram {
    let set = lamping.lamp_set.map(|number| found.with_lamp_set(usize::try_from(i64::from(number) - 1).unwrap_or(usize::MAX)));
    let chosen = or_warn(context, origin, path, set).unwrap_or(found);
    let tilted = chosen.tilted(lamping.tilt_deg);
    or_warn(context, origin, path, Some(tilted)).unwrap_or(chosen)
}

fn or_warn<T>(context: &mut Context<'_, '_>, origin: &Origin, path: &AssetPath, result: Option<Result<T, FormatError>>) -> Option<T> {
    let failed = |error: &FormatError| context.warn(origin, format!("{}; it is ignored", Error::in_file(&path.resolved, error)));
    result?.inspect_err(failed).ok()
}

fn read(
    context: &mut Context<'_, '_>,
    path: &AssetPath,
    variant: Option<&str>,
    origin: &Origin,
    instead: &str,
) -> Option<photometry::Goniogram> {
    let py = context.py;
    let reader = |bytes: &[u8], name: &str| photometry::read_variant(bytes, name, variant, &mut |tilt| asset::beside(py, name, tilt));
    match asset::read(py, path, "light distribution", reader) {
        Ok(goniogram) => {
            for warning in &goniogram.warnings {
                context.warn(origin, Error::in_file(&path.resolved, warning).to_string());
            }
            let tilt = goniogram.stated.measurement_tilt;
            if tilt != 0.0 {
                let problem = format!(
                    "{}: it was measured at a tilt of {tilt}°, which roads alone take off; it shines as it was measured",
                    path.resolved
                );
                context.warn(origin, problem);
            }
            Some(goniogram)
        }
        Err(problem) => {
            context.refuse(origin, &problem, instead);
            None
        }
    }
}

/// The factors as the light asks for them.
fn requested(context: &mut Context<'_, '_>, origin: &Origin, found: &photometry::Goniogram, request: Request) -> Goniogram {
    let mut goniogram = Goniogram::from(found);
    if request.normalized {
        let factor = normalization(found) as f32;
        goniogram.factors.iter_mut().for_each(|intensity| *intensity *= factor);
    }
    if goniogram.photometric_type == PhotometricType::C {
        goniogram.vertical_deg.iter_mut().for_each(|angle| *angle = scaled(*angle, request.angle_scale));
    } else if request.angle_scale != 0.0 {
        context.warn(origin, "ies:angleScale is for distributions of type C; it is ignored");
    }
    goniogram
}

/// One over the mean of the intensities over the sphere, or over the half of it that the file covers.
fn normalization(found: &photometry::Goniogram) -> f64 {
    let span = found.vertical.last().zip(found.vertical.first()).map_or(0.0, |(last, first)| (last - first).to_radians());
    let solid_angle = if span > PI / 2.0 + 0.1 { 4.0 * PI } else { 2.0 * PI };
    let mean = found.flux() / solid_angle;
    if mean > 0.0 { 1.0 / mean } else { 0.0 }
}

/// Where a polar angle of the file comes to lie, degrees: scaled about nadir, or about the zenith where the scale is negative.
fn scaled(angle: f32, scale: f32) -> f32 {
    if scale > 0.0 {
        angle * scale
    } else if scale < 0.0 {
        180.0 - (180.0 - angle) * -scale
    } else {
        angle
    }
}
