//! The position index: how much less a source disturbs the farther it lies from the line of sight.

/// Greatest index, and the greatest distance below the line of sight in distances ahead that it grows to, as evalglare has them.
const MOST: f64 = 16.0;
const MOST_BELOW: f64 = 3.0;

/// By direction in the eye's frame (right, up, ahead; unit). Above the line of sight Guth's index in the form of the IESNA handbook; below it that of
/// Iwata and others: 1 + 0.8 R/D up to R = 0.6 D, 1 + 1.2 R/D beyond.
pub fn position_index([right, up, ahead]: [f64; 3]) -> f64 {
    if ahead <= 0.0 {
        return MOST;
    }
    let across = right.hypot(up);
    if up < 0.0 {
        let away = (across / ahead).min(MOST_BELOW);
        let growth = if away < 0.6 { 0.8 } else { 1.2 };
        return (1.0 + growth * away).min(MOST);
    }
    // Degrees between the vertical and the plane of source and line of sight, and between source and line of sight.
    let tau = right.abs().atan2(up).to_degrees();
    let sigma = across.atan2(ahead).to_degrees();
    let first = (35.2 - 0.31889 * tau - 1.22 * (-2.0 * tau / 9.0).exp()) * 1e-3 * sigma;
    let second = (21.0 + 0.26667 * tau - 0.002963 * tau * tau) * 1e-5 * sigma * sigma;
    (first + second).exp().min(MOST)
}
