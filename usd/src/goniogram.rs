//! IES and EULUMDAT files: of UsdLux's ShapingAPI, literally by its specification, factors on the light's radiance; of `gonio:photometry`, candela.

use crate::asset;
use crate::context::Context;
use crate::prim::Prim;
use crate::vt::AssetPath;
use gonio::Error;
use gonio::scene::{Goniogram, Origin, PhotometricType};
use gonio_formats::photometry;
use std::{f64::consts::PI, sync::Arc};

/// What a light asks of its file.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Request {
    /// `shaping:ies:angleScale`.
    pub(crate) angle_scale: f32,
    /// `shaping:ies:normalize`.
    pub(crate) normalized: bool,
}

/// The goniogram that a light's file holds, the same one for all lights that ask the same of it; `None`, with a warning that names the prim and
/// the file, where there is none.
pub(crate) fn goniogram<'py>(
    context: &mut Context<'_, 'py>,
    prim: &Prim<'py>,
    path: &AssetPath,
    request: Request,
) -> Option<Arc<Goniogram>> {
    let key = format!("{}\n{}\n{}\n{}", path.authored, path.resolved, request.angle_scale.to_bits(), request.normalized);
    if let Some(known) = context.goniograms.get(&key) {
        return known.clone();
    }
    let origin = prim.origin();
    let read = read(context, path, &origin).map(|found| Arc::new(requested(context, &origin, &found, request)));
    context.goniograms.insert(key, read.clone());
    read
}

/// The goniogram of a luminaire's file in candela, the same one for all lights that name it; `None`, with a warning, where there is none.
pub(crate) fn absolute<'py>(context: &mut Context<'_, 'py>, prim: &Prim<'py>, path: &AssetPath) -> Option<Arc<Goniogram>> {
    let key = format!("{}\n{}\nabsolute", path.authored, path.resolved);
    if let Some(known) = context.goniograms.get(&key) {
        return known.clone();
    }
    let read = read(context, path, &prim.origin()).map(|found| Arc::new(Goniogram::from(&found)));
    context.goniograms.insert(key, read.clone());
    read
}

fn read(context: &mut Context<'_, '_>, path: &AssetPath, origin: &Origin) -> Option<photometry::Goniogram> {
    match asset::read(context.py, path, "light distribution", photometry::read) {
        Ok(goniogram) => {
            for warning in &goniogram.warnings {
                context.note(origin, Error::in_file(&path.resolved, warning).to_string());
            }
            Some(goniogram)
        }
        Err(problem) => {
            context.warn(origin, format!("{problem}; the light counts as uniform"));
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
