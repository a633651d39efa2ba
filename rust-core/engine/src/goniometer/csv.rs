//! Readings as comma-separated values (RFC 4180).

use super::{Reading, ScreenReading, colour, frame::Frame};
use std::fmt::Write;

impl Reading {
    /// One line a direction: C and γ in degrees, luminous intensity and its standard error in cd, tristimulus values in cd, chromaticity x and y,
    /// the colour temperature in K, Duv, and chromaticity u' and v'; these are empty where there is no light, or none of a black body's colour.
    pub fn csv(&self) -> String {
        let mut out =
            String::from("c_deg,gamma_deg,intensity_cd,standard_error_cd,X_cd,Y_cd,Z_cd,x,y,colour_temperature_k,duv,u_prime,v_prime\r\n");
        for (place, rgb) in self.rgb.iter().enumerate() {
            let ([c, gamma], [x, y, z]) = (self.direction(place), colour::tristimulus(*rgb));
            let (intensity, error) = (self.intensities[place], self.errors[place]);
            let chromaticity = colour::chromaticity(*rgb).map_or(",".to_owned(), |[x, y]| format!("{x:.5},{y:.5}"));
            let white = colour::colour_temperature(*rgb).map_or(",".to_owned(), |[kelvin, duv]| format!("{kelvin:.0},{duv:.5}"));
            let uniform = colour::uniform_chromaticity(*rgb).map_or(",".to_owned(), |[u, v]| format!("{u:.5},{v:.5}"));
            // Writing to a string does not fail.
            let _ = write!(out, "{c},{gamma},{intensity:.6},{error:.6},{x:.6},{y:.6},{z:.6},{chromaticity},{white},{uniform}\r\n");
        }
        out
    }
}

impl ScreenReading {
    /// One line a point: row, column, its place in the luminaire's frame in metres, illuminance and its standard error in lx.
    pub fn csv(&self) -> String {
        let mut out = String::from("row,column,x_m,y_m,z_m,illuminance_lx,standard_error_lx\r\n");
        for (point, (value, error)) in self.illuminance.iter().zip(&self.errors).enumerate() {
            let [column, row] = [point % self.screen.size[0], point / self.screen.size[0]];
            let [x, y, z] = self.place(column, row);
            let _ = write!(out, "{row},{column},{x:.6},{y:.6},{z:.6},{value:.6},{error:.6}\r\n");
        }
        out
    }

    /// The middle of a cell in the luminaire's frame, metres.
    pub fn place(&self, column: usize, row: usize) -> [f64; 3] {
        let screen = &self.screen;
        let share = |number: usize, count: usize| (number as f64 + 0.5) / count as f64;
        let (u, v) = (share(column, screen.size[0]), share(row, screen.size[1]));
        [0, 1, 2].map(|k| screen.corner[k] + u * screen.across[k] + v * screen.along[k])
    }

    /// The same in the world.
    pub fn world_place(&self, frame: &Frame, column: usize, row: usize) -> [f64; 3] {
        frame.world_point(self.place(column, row))
    }
}
