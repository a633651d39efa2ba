//! The rooms of a UGR table and what their walls get of light by reflection (CIE 52, CIE 190).

use std::f64::consts::PI;

/// Sides of the table's rooms, across and along the line of sight, in luminaires' heights above the eye.
pub const ROOMS: [[f64; 2]; 19] = [
    [2.0, 2.0],
    [2.0, 3.0],
    [2.0, 4.0],
    [2.0, 6.0],
    [2.0, 8.0],
    [2.0, 12.0],
    [4.0, 2.0],
    [4.0, 3.0],
    [4.0, 4.0],
    [4.0, 6.0],
    [4.0, 8.0],
    [4.0, 12.0],
    [8.0, 4.0],
    [8.0, 6.0],
    [8.0, 8.0],
    [8.0, 12.0],
    [12.0, 4.0],
    [12.0, 6.0],
    [12.0, 8.0],
];

/// Reflectances of ceiling, walls and reference plane.
pub const REFLECTANCES: [[f64; 3]; 5] = [[0.7, 0.5, 0.2], [0.7, 0.3, 0.2], [0.5, 0.5, 0.2], [0.5, 0.3, 0.2], [0.3, 0.3, 0.2]];

/// Reflections that are followed: below 1e-9 of the light is left.
const REFLECTIONS: usize = 100;

/// Lumens that the walls get by reflection for each lumen that first reaches ceiling, walls or reference plane: CIE 190's transfer factors F_T,CW,
/// F_T,WW − 1 and F_T,FW. Between diffuse surfaces, each lit evenly, in a room of unit height.
pub(super) fn transfer(room: [f64; 2], reflectances: [f64; 3]) -> [f64; 3] {
    let shares = exchange(room);
    [0, 1, 2].map(|first| {
        let mut arriving = [0.0; 3];
        arriving[first] = 1.0;
        let mut on_walls = 0.0;
        for _ in 0..REFLECTIONS {
            let leaving = [0, 1, 2].map(|from| arriving[from] * reflectances[from]);
            arriving = [0, 1, 2].map(|to| (0..3).map(|from| leaving[from] * shares[from][to]).sum());
            on_walls += arriving[1];
        }
        on_walls
    })
}

/// Form factors from ceiling, walls and reference plane to each of them.
fn exchange([x, y]: [f64; 2]) -> [[f64; 3]; 3] {
    let across = facing(x, y);
    let to_walls = 1.0 - across;
    // By reciprocity: the walls' area is 2 (x + y).
    let from_walls = to_walls * x * y / (2.0 * (x + y));
    [[0.0, to_walls, across], [from_walls, 1.0 - 2.0 * from_walls, from_walls], [across, to_walls, 0.0]]
}

/// The form factor of equal rectangles that face each other at unit distance.
fn facing(x: f64, y: f64) -> f64 {
    let (a, b) = ((1.0 + x * x).sqrt(), (1.0 + y * y).sqrt());
    let corner = (a * a * b * b / (1.0 + x * x + y * y)).sqrt().ln();
    let sides = x * b * (x / b).atan() + y * a * (y / a).atan() - x * x.atan() - y * y.atan();
    2.0 / (PI * x * y) * (corner + sides)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn transfer_factors_are_the_standards() {
        // CIE 190 table 5, printed with three digits: F_T,CW, F_T,WW-1, F_T,FW.
        for (room, reflectances, expected) in [
            ([2.0, 2.0], [0.7, 0.5, 0.2], [0.646, 0.422, 0.220]),
            ([4.0, 8.0], [0.7, 0.5, 0.2], [0.307, 0.211, 0.115]),
            ([4.0, 8.0], [0.5, 0.3, 0.2], [0.196, 0.104, 0.093]),
            ([12.0, 8.0], [0.3, 0.3, 0.2], [0.069, 0.059, 0.049]),
        ] {
            let found = transfer(room, reflectances);
            let near = (0..3).all(|k| (found[k] - expected[k]).abs() < 2e-3);
            assert!(near, "{room:?} {reflectances:?}: {found:?} instead of {expected:?}");
        }
    }

    #[test]
    fn cubes_see_a_fifth_of_each_side() {
        assert!((facing(1.0, 1.0) - 0.199_825).abs() < 1e-6);
    }
}
