//! What meters' own paths miss behind rough glass, and where glass sends light into fog. Two rough faces in a row hide a small lamp from them as smooth
//! ones do, and fog behind smooth ones; but no path is specular there, and so none is left to light paths. So these follow all light once more, and take
//! the place of the meters' paths where they find more.

use super::{
    brought::{Brought, brought},
    discs::Discs,
    reading::Reading,
    sensing::Sensing,
    watch::Watch,
};
use crate::{
    compile::light_paths_measure,
    error::Result,
    scene::{Integrator, Settings},
};

/// Standard errors, and part of a reading, by which light paths must find more. Paths that have not met a lamp yet know little of their own error.
const ERRORS: f64 = 2.5;
const PART: f64 = 0.02;

/// Readings with what was missed, and at how many meters that was.
pub(super) fn with_missed(
    sensing: &Sensing<'_>,
    discs: &Discs,
    readings: Vec<Reading>,
    watch: &mut Watch<'_>,
) -> Result<(Vec<Reading>, usize)> {
    let settings = Settings { integrator: Integrator::Direct, ..sensing.settings.clone() };
    let direct = Sensing { settings: &settings, ..*sensing }.readings(watch.progress)?;
    let sampler = light_paths_measure::all_light(sensing.scene);
    let scattered = brought(sensing, discs, &direct, &Brought { sampler: &sampler, whole: true }, watch)?;
    let mut missed = 0;
    let found = readings.iter().zip(discs.all()).zip(direct.iter().zip(&scattered)).map(|((reading, disc), (direct, scattered))| {
        let whole = direct.plus(scattered);
        let more = whole.value - reading.value;
        let apart = more > ERRORS * whole.standard_error.hypot(reading.standard_error) && more > PART * whole.value;
        if disc.radius > 0.0 && apart {
            missed += 1;
            return whole;
        }
        // Paths that have met no lamp at all know of no error.
        let unmet = reading.standard_error <= 0.0 && disc.radius > 0.0;
        Reading { standard_error: if unmet { whole.standard_error } else { reading.standard_error }, ..*reading }
    });
    let found = found.collect();
    Ok((found, missed))
}
