//! Several luminaires as one.

use super::grid::sorted;
use super::{Goniogram, LampSet, PhotometricType, Stated, Symmetry};
use crate::error::{FormatError, Result};

/// Intensities of the largest sum.
const LARGEST_GRID: usize = 1 << 22;

/// Degrees behind the end of a file's angles at which its light is gone.
const STEP: f64 = 1e-3;

impl Goniogram {
    /// The light of luminaires together, each times a factor, in one frame and as seen from afar. One alone keeps its angles, types A and B too.
    /// Of several the grid has the angles of all, on which sums of bilinear intensities are exact; what is no light comes from the strongest, a spectrum where all
    /// have it.
    ///
    /// # Errors
    /// None, or so many angles together that no grid holds them.
    pub(crate) fn sum(parts: &[(&Self, f64)]) -> Result<Self> {
        if let [(one, factor)] = parts {
            let mut one = (*one).clone().times(*factor);
            one.lamp_sets.iter_mut().filter_map(|set| set.flux.as_mut()).for_each(|flux| *flux *= factor);
            return Ok(one);
        }
        let parts: Vec<(Self, f64)> = parts.iter().map(|(part, factor)| (part.to_type_c(), *factor)).collect();
        let flux = |(part, factor): &(Self, f64)| part.flux() * factor;
        let Some(strongest) = parts.iter().max_by(|a, b| flux(a).total_cmp(&flux(b))) else {
            return Err(FormatError::whole("no luminaire was found to be summed"));
        };
        let (horizontal, vertical) = grid(&parts)?;
        let at = |c: f64, gamma: f64| parts.iter().map(|(part, factor)| factor * part.intensity_at(c, gamma)).sum::<f64>();
        let intensities = horizontal.iter().flat_map(|c| vertical.iter().map(|gamma| at(*c, *gamma))).collect();
        let lamps = strongest.0.lamps().cloned().unwrap_or_default();
        let total = Self {
            photometric_type: PhotometricType::C,
            symmetry: Symmetry::None,
            horizontal,
            vertical,
            intensities,
            lamp_sets: vec![LampSet { flux: Some(parts.iter().map(flux).sum()), absolute: true, ..lamps }],
            lamp_set: 0,
            tilt: None,
            stated: Stated::default(),
            spectrum: strongest.0.spectrum.clone().filter(|one| parts.iter().all(|(part, _)| part.spectrum.as_ref() == Some(one))),
            warnings: parts.iter().flat_map(|(part, _)| part.warnings.clone()).collect(),
            ..strongest.0.clone()
        };
        Ok(total.symmetrised(total.symmetry_found(1e-9)))
    }
}

/// The angles of all.
fn grid(parts: &[(Goniogram, f64)]) -> Result<(Vec<f64>, Vec<f64>)> {
    let mut horizontal = Vec::new();
    let mut vertical = Vec::new();
    for (part, _) in parts {
        horizontal.extend(part.expanded().horizontal);
        vertical.extend(&part.vertical);
        // Beyond its angles a file has no light, and the others' light goes on.
        vertical.extend(part.vertical.first().filter(|first| **first > STEP).map(|first| first - STEP));
        vertical.extend(part.vertical.last().filter(|last| **last < 180.0 - STEP).map(|last| last + STEP));
    }
    let (horizontal, vertical) = (sorted(horizontal), sorted(vertical));
    match horizontal.len().checked_mul(vertical.len()) {
        Some(count) if count <= LARGEST_GRID => Ok((horizontal, vertical)),
        _ => Err(FormatError::whole(format!("{} planes of {} angles are too many to be summed", horizontal.len(), vertical.len()))),
    }
}
