//! Which samples settings ask for, and what of it does not go together.

use crate::{
    antialias::Rule,
    error::{Error, Result},
    film::block_at,
    scene::{Antialiasing, Integrator, MOST_LIGHT_SAMPLES, Settings},
};

/// Refuses samples that cannot be taken.
pub(super) fn check(settings: &Settings) -> Result<()> {
    if settings.samples == 0 || settings.time_limit_s.is_nan() || settings.time_limit_s < 0.0 {
        let problem = format!("{} samples and a limit of {} s, expected 1 or more and 0 or more", settings.samples, settings.time_limit_s);
        return Err(Error::Setting { name: "samples".into(), problem });
    }
    check_range(settings)?;
    check_antialiasing(settings)?;
    if !(1..=MOST_LIGHT_SAMPLES).contains(&settings.light_samples) {
        let problem = format!("{} was found, expected 1 to {MOST_LIGHT_SAMPLES}", settings.light_samples);
        return Err(Error::setting("light_samples", problem));
    }
    if !(settings.noise_threshold >= 0.0 && settings.noise_white >= 0.0 && settings.noise_white.is_finite()) {
        let problem = format!("{} with white at {}, expected 0 or more", settings.noise_threshold, settings.noise_white);
        return Err(Error::setting("noise_threshold", problem));
    }
    Ok(())
}

/// What counts as a discontinuity, where samples follow them.
pub(super) fn rule(antialiasing: Antialiasing) -> Option<Rule> {
    match antialiasing {
        Antialiasing::Sampled | Antialiasing::Grid(_) => None,
        Antialiasing::Adaptive => Some(Rule::STANDARD),
        Antialiasing::High => Some(Rule::HIGH),
        Antialiasing::Paper => Some(Rule::PAPER),
    }
}

/// Refuses places in the pixel that the number of samples or the light transport does not go with.
fn check_antialiasing(settings: &Settings) -> Result<()> {
    let (antialiasing, samples) = (settings.antialiasing, settings.samples);
    let problem = if let Some(wanted) = antialiasing.samples().filter(|wanted| *wanted != samples) {
        format!("{samples} samples a pixel do not go with it, which takes {wanted}; leave out the number of samples")
    } else if antialiasing.is_adaptive() && settings.integrator != Integrator::Whitted {
        "adaptive antialiasing compares rays without noise; choose the integrator whitted".to_owned()
    } else {
        return Ok(());
    };
    Err(Error::setting("antialiasing", problem))
}

/// Refuses ranges of samples that are empty or would cut a block.
fn check_range(settings: &Settings) -> Result<()> {
    let (range, samples) = (settings.range(), settings.samples);
    let problem = if range.start >= range.end || range.end > samples {
        format!("the range {}:{} was found, expected a part of 0:{samples}", range.start, range.end)
    } else if [range.start, range.end].iter().any(|end| block_at(*end, samples).is_none()) {
        format!("the range {}:{} was found, expected ends at 0, 1, 2, 4, 8, a multiple of 16 or {samples}", range.start, range.end)
    } else if settings.least_samples().is_some() && range != (0..samples) {
        "a part of the samples cannot know which pixels have enough; leave out the noise threshold or the range".to_owned()
    } else {
        return Ok(());
    };
    Err(Error::setting("samples", problem))
}
