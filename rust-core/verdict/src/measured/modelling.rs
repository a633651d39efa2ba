//! Modelling: cylindrical over horizontal illuminance of one place (EN 12464-1).

use super::area::{Area, Figure};
use crate::{estimate::Estimate, note::Note, unit::Unit};

/// Gives areas whose cylindrical and horizontal illuminances were both measured, in one file or in two, their ratio.
pub(super) fn add(areas: &mut [Area]) {
    let mean = |area: &Area, of: &str| {
        let is_mean = |figure: &&Figure| figure.of.as_deref() == Some(of) && figure.is("mean", None);
        area.figures.iter().find(is_mean).and_then(|figure| figure.value)
    };
    let level: Vec<(String, usize, Option<Estimate>)> =
        areas.iter().map(|area| (area.name.clone(), area.file, mean(area, "illuminance"))).collect();
    for area in areas {
        let Some(cylindrical) = mean(area, "cylindrical") else { continue };
        let same: Vec<_> = level.iter().filter(|(name, _, value)| *name == area.name && value.is_some()).collect();
        let own: Vec<_> = same.iter().filter(|(_, file, _)| *file == area.file).copied().collect();
        let candidates = if own.is_empty() { same } else { own };
        let [(_, _, Some(level))] = candidates[..] else { continue };
        let mut figure = Figure::new("modelling", cylindrical.over(*level), Unit::plain());
        figure.notes = vec![Note::RatioOfMeans];
        area.figures.push(figure);
    }
}
