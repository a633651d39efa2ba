//! Views of maps made smooth as far as their values are uncertain: differences that noise explains go away, others stay.
//!
//! A mean over a surface's pixels that grows pass by pass (à-trous wavelets, Dammertz et al. 2010), weighed by how many standard errors values differ.

use rayon::prelude::*;

/// What a pixel shows.
#[derive(Clone, Copy, Debug)]
pub(super) struct Seen {
    /// Not a number where no map is seen.
    pub(super) value: f32,
    pub(super) standard_error: f32,
    /// A number of the surface and its side.
    pub(super) surface: usize,
    /// Unit.
    pub(super) normal: [f32; 3],
}

impl Seen {
    /// No map.
    pub(super) const NOTHING: Self = Self { value: f32::NAN, standard_error: 0.0, surface: usize::MAX, normal: [0.0; 3] };
}

/// Pixels between those of a window, pass by pass.
const STEPS: [usize; 5] = [1, 2, 4, 8, 16];
/// Weights of a window's rows and columns by their distance (a cubic B-spline's).
const KERNEL: [f32; 3] = [0.375, 0.25, 0.0625];
/// Standard errors of a difference that are still noise.
const ERRORS: f32 = 1.5;
/// Least cosine between the normals of what is alike.
const ALONGSIDE: f32 = 0.9;

/// Values of a picture that is so many pixels wide.
pub(super) fn smoothed(seen: &[Seen], width: usize) -> Vec<f32> {
    let values = seen.iter().map(|pixel| pixel.value).collect();
    STEPS.into_iter().fold(values, |values: Vec<f32>, step| {
        (0..seen.len()).into_par_iter().map(|pixel| mean_about(pixel, (seen, &values), width, step)).collect()
    })
}

fn mean_about(pixel: usize, (seen, values): (&[Seen], &[f32]), width: usize, step: usize) -> f32 {
    let own = values[pixel];
    if !own.is_finite() {
        return own;
    }
    let height = seen.len() / width;
    let (mut sum, mut weights) = (0.0, 0.0);
    for (y, across) in window(pixel / width, height, step) {
        for (x, along) in window(pixel % width, width, step) {
            let other = y * width + x;
            let weight = along * across * alike(&seen[pixel], &seen[other], values[other] - own);
            if weight > 0.0 {
                sum += weight * values[other];
                weights += weight;
            }
        }
    }
    sum / weights
}

/// Places of a window about one of `count`, with their weights.
fn window(middle: usize, count: usize, step: usize) -> impl Iterator<Item = (usize, f32)> {
    (-2..=2_isize).filter_map(move |k| {
        let place = middle.checked_add_signed(k * step as isize)?;
        (place < count).then_some((place, KERNEL[k.unsigned_abs()]))
    })
}

/// How much two pixels are alike whose values differ by so much: 1 for the same, 0 for other surfaces.
fn alike(a: &Seen, b: &Seen, difference: f32) -> f32 {
    let cosine: f32 = (0..3).map(|k| a.normal[k] * b.normal[k]).sum();
    if a.surface != b.surface || cosine < ALONGSIDE || !difference.is_finite() {
        return 0.0;
    }
    let variance = ERRORS * ERRORS * (a.standard_error * a.standard_error + b.standard_error * b.standard_error);
    if variance > 0.0 { (-0.5 * difference * difference / variance).exp() } else { f32::from(u8::from(difference == 0.0)) }
}

#[cfg(test)]
mod tests {
    use super::*;

    const WIDTH: usize = 64;

    fn wall(value: impl Fn(usize, usize) -> f32) -> Vec<Seen> {
        let pixel = |i: usize| Seen { value: value(i % WIDTH, i / WIDTH), standard_error: 5.0, surface: 0, normal: [0.0, 0.0, 1.0] };
        (0..WIDTH * WIDTH).map(pixel).collect()
    }

    /// Noise of about 5, the same in blocks as texels are.
    fn noise(x: usize, y: usize) -> f32 {
        let hash = ((x / 4) as u32).wrapping_mul(0x9e37_79b9) ^ ((y / 4) as u32).wrapping_mul(0x85eb_ca6b);
        let hash = (hash ^ (hash >> 15)).wrapping_mul(0x2c1b_3c6d);
        17.3 * ((hash >> 8) as f32 / (1 << 24) as f32 - 0.5)
    }

    #[test]
    fn noise_goes_and_steps_stay() {
        let lit = |x: usize| if x < WIDTH / 2 { 100.0 } else { 200.0 };
        let seen = wall(|x, y| lit(x) + noise(x, y));
        let smooth = smoothed(&seen, WIDTH);
        let off = |values: &mut dyn Iterator<Item = (usize, f32)>| {
            (values.map(|(i, value)| (value - lit(i % WIDTH)).powi(2)).sum::<f32>() / (WIDTH * WIDTH) as f32).sqrt()
        };
        let before = off(&mut seen.iter().map(|pixel| pixel.value).enumerate());
        let after = off(&mut smooth.iter().copied().enumerate());
        assert!(after < 0.4 * before, "{after} of {before}");
        let mean = smooth.iter().sum::<f32>() / smooth.len() as f32;
        let given = seen.iter().map(|pixel| pixel.value).sum::<f32>() / seen.len() as f32;
        assert!((mean - given).abs() < 1.0, "light is neither lost nor made: {mean} for {given}");
    }

    #[test]
    fn what_is_certain_and_other_surfaces_are_left_alone() {
        let mut seen = wall(|x, _| x as f32);
        seen.iter_mut().for_each(|pixel| pixel.standard_error = 0.0);
        assert!(smoothed(&seen, WIDTH).iter().zip(&seen).all(|(value, pixel)| *value == pixel.value));
        let mut seen = wall(|_, _| 10.0);
        for (i, pixel) in seen.iter_mut().enumerate() {
            match i % 3 {
                0 => {}
                1 => (pixel.surface, pixel.value) = (1, 12.0),
                _ => *pixel = Seen::NOTHING,
            }
        }
        let smooth = smoothed(&seen, WIDTH);
        assert!(
            smooth.iter().zip(&seen).all(|(value, pixel)| (value - pixel.value).abs() < 1e-4 || pixel.value.is_nan() && value.is_nan())
        );
    }
}
