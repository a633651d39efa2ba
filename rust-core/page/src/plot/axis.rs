//! Numbers along axes.

/// Round places from 0 to an end: 1, 2 or 5 times a power of ten apart, at most so many steps.
pub(super) fn ticks(end: f64, most: usize) -> Vec<f64> {
    if !(end > 0.0 && end.is_finite()) {
        return vec![0.0];
    }
    let least = end / most.max(1) as f64;
    let power = 10f64.powf(least.log10().floor());
    let step = [1.0, 2.0, 5.0, 10.0].map(|factor| factor * power).into_iter().find(|step| *step >= least * (1.0 - 1e-9)).unwrap_or(end);
    (0..=most).map(|number| step * number as f64).take_while(|place| *place <= end * (1.0 + 1e-9)).collect()
}
