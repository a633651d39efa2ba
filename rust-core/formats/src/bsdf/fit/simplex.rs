//! Minimising a function of a few numbers without its derivatives (Nelder and Mead, A Simplex Method for Function Minimization, 1965).

/// Rounds after which the best place counts as found.
const ROUNDS: usize = 160;

/// Ends earlier when the values of the simplex differ by less than that part of themselves.
const TOLERANCE: f64 = 1e-7;

/// The place with the least value near `start`, and the value; the first simplex reaches `steps` far.
pub(super) fn minimise<const N: usize>(start: [f64; N], steps: [f64; N], value: impl Fn([f64; N]) -> f64) -> ([f64; N], f64) {
    let mut points = vec![(start, value(start))];
    for (i, step) in steps.into_iter().enumerate().filter(|(_, step)| *step != 0.0) {
        let mut point = start;
        point[i] += step;
        points.push((point, value(point)));
    }
    let last = points.len() - 1;
    for _ in 0..ROUNDS {
        points.sort_by(|a, b| a.1.total_cmp(&b.1));
        if last == 0 || points[last].1 - points[0].1 <= TOLERANCE * points[0].1.abs() {
            break;
        }
        let middle: [f64; N] = core::array::from_fn(|i| points[..last].iter().map(|(p, _)| p[i]).sum::<f64>() / last as f64);
        let along = |t: f64| -> ([f64; N], f64) {
            let place = core::array::from_fn(|i| middle[i] + t * (points[last].0[i] - middle[i]));
            (place, value(place))
        };
        let reflected = along(-1.0);
        let better = if reflected.1 < points[0].1 {
            let expanded = along(-2.0);
            if expanded.1 < reflected.1 { Some(expanded) } else { Some(reflected) }
        } else if reflected.1 < points[last - 1].1 {
            Some(reflected)
        } else {
            let contracted = along(if reflected.1 < points[last].1 { -0.5 } else { 0.5 });
            (contracted.1 < points[last].1.min(reflected.1)).then_some(contracted)
        };
        match better {
            Some(point) => points[last] = point,
            None => shrink(&mut points, &value),
        }
    }
    points.into_iter().min_by(|a, b| a.1.total_cmp(&b.1)).unwrap_or((start, f64::INFINITY))
}

/// Moves all points half the way to the best.
fn shrink<const N: usize>(points: &mut [([f64; N], f64)], value: &impl Fn([f64; N]) -> f64) {
    let Some(((best, _), others)) = points.split_first_mut() else { return };
    for (point, found) in others {
        *point = core::array::from_fn(|i| 0.5 * (best[i] + point[i]));
        *found = value(*point);
    }
}

#[cfg(test)]
mod tests {
    use super::minimise;

    #[test]
    fn a_curved_valley_is_followed() {
        // Rosenbrock's function, from the other end of its valley; the last coordinate is not moved.
        let value = |[x, y, z]: [f64; 3]| (1.0 - x).powi(2) + 10.0 * (y - x * x).powi(2) + z;
        let ([x, y, z], least) = minimise([-1.2, 1.0, 3.0], [0.5, 0.5, 0.0], value);
        assert!((x - 1.0).abs() < 1e-2 && (y - 1.0).abs() < 2e-2 && z == 3.0, "{x} {y} {z}");
        assert!((least - 3.0).abs() < 1e-4);
    }
}
