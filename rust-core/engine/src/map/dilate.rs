//! Values beyond the borders of charts, for textures: filters that read a little further find what is next to it.

/// Gives texels without a value the mean of their neighbours that have one, so many texels outwards; coordinates repeat at the picture's border.
pub(super) fn dilate(values: &mut [f32], [width, height]: [u32; 2], steps: u32) {
    let (width, height) = (width as usize, height as usize);
    let mut empty: Vec<usize> = (0..values.len()).filter(|at| values[*at].is_nan()).collect();
    for _ in 0..steps {
        if empty.is_empty() || empty.len() == values.len() {
            return;
        }
        let found: Vec<(usize, f32)> = empty.iter().filter_map(|at| Some((*at, mean_about(values, [width, height], *at)?))).collect();
        found.into_iter().for_each(|(at, value)| values[at] = value);
        empty.retain(|at| values[*at].is_nan());
    }
}

/// The mean of the eight neighbours that have a value.
fn mean_about(values: &[f32], [width, height]: [usize; 2], at: usize) -> Option<f32> {
    let (x, y) = (at % width, at / width);
    let (mut sum, mut count) = (0.0, 0.0);
    for row in [y + height - 1, y, y + 1] {
        for column in [x + width - 1, x, x + 1] {
            let value = values[row % height * width + column % width];
            if value.is_finite() {
                sum += value;
                count += 1.0;
            }
        }
    }
    (count > 0.0).then(|| sum / count)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn borders_grow_step_by_step() {
        let mut values = [f32::NAN; 49];
        values[24] = 5.0;
        dilate(&mut values, [7, 7], 2);
        assert_eq!(values.iter().filter(|value| **value == 5.0).count(), 25);
        dilate(&mut values, [7, 7], 9);
        assert_eq!(values, [5.0; 49]);
        let mut nothing = [f32::NAN; 9];
        dilate(&mut nothing, [3, 3], 4);
        assert!(nothing.iter().all(|value| value.is_nan()));
    }
}
