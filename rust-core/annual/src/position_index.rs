//! The position index of daylight glare: how much less a source disturbs the farther it lies from the line of sight.

/// Greatest index, as evalglare has it.
const MOST: f64 = 16.0;

/// By direction in the eye's frame (right, up, ahead; unit), as evalglare has it since version 2. Above the line of sight Guth's index in the form of the
/// IESNA handbook. Below it that of Iwata and Tokura in Kikuchi's coordinates: tan β = tan σ √(1 + 0.3225 cos² τ), ln P = 6.49·10⁻³ β + 21·10⁻⁵ β².
/// Unified glare ratings have CIE 117's table instead.
pub fn position_index([right, up, ahead]: [f64; 3]) -> f64 {
    if ahead <= 0.0 {
        return MOST;
    }
    let across = right.hypot(up);
    if up < 0.0 {
        // cos τ is up / across.
        let beta = across.hypot(0.3225f64.sqrt() * up).atan2(ahead).to_degrees();
        return (6.49e-3 * beta + 21e-5 * beta * beta).exp().min(MOST);
    }
    // Degrees between the vertical and the plane of source and line of sight, and between source and line of sight.
    let tau = right.abs().atan2(up).to_degrees();
    let sigma = across.atan2(ahead).to_degrees();
    let first = (35.2 - 0.31889 * tau - 1.22 * (-2.0 * tau / 9.0).exp()) * 1e-3 * sigma;
    let second = (21.0 + 0.26667 * tau - 0.002963 * tau * tau) * 1e-5 * sigma * sigma;
    (first + second).exp().min(MOST)
}
