//! A screen near the luminaire: a rectangle on which illuminance is wanted.

use super::frame::{Frame, cross, dot};
use crate::error::{Error, Result};

/// Most points of a screen.
const MOST_POINTS: usize = 4_000_000;

/// A rectangle that measures what arrives on one side of it and hinders nothing, in the luminaire's frame, metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Screen {
    /// A corner.
    pub corner: [f64; 3],
    /// From there along the columns.
    pub across: [f64; 3],
    /// From there along the rows. The side that `across × along` shows to is lit.
    pub along: [f64; 3],
    /// Columns and rows.
    pub size: [usize; 2],
}

impl Screen {
    /// A screen below the luminaire that looks up at it: `distance` metres from the origin against z, `width` along C0 and `height` along C90
    /// about the axis. Columns run along C0, rows along C90.
    pub fn below(distance: f64, [width, height]: [f64; 2], size: [usize; 2]) -> Self {
        Self { corner: [-0.5 * width, -0.5 * height, -distance], across: [width, 0.0, 0.0], along: [0.0, height, 0.0], size }
    }

    /// # Errors
    /// A screen without area, or with numbers that are not finite, or without points or with more than fit.
    pub(super) fn checked(&self) -> Result<()> {
        let normal = cross(self.across, self.along);
        let area = dot(normal, normal).sqrt();
        let points = self.size[0].saturating_mul(self.size[1]);
        if !(area > 0.0 && area.is_finite() && self.corner.iter().all(|x| x.is_finite())) {
            return Err(Error::setting("screen", "the rectangle has no area or numbers that are not finite"));
        }
        if points == 0 || points > MOST_POINTS {
            return Err(Error::setting("screen", format!("{points} points were asked for, expected 1 to {MOST_POINTS}")));
        }
        Ok(())
    }
}

/// The screen as rays meet it, in the world.
#[derive(Clone, Debug)]
pub(super) struct ScreenPlane {
    corner: [f64; 3],
    normal: [f64; 3],
    /// A point's products with these are its places in columns and rows.
    to_columns: [f64; 3],
    to_rows: [f64; 3],
    size: [usize; 2],
    /// Square metres of a cell.
    pub(super) cell_area: f64,
}

impl ScreenPlane {
    pub(super) fn new(screen: &Screen, frame: &Frame) -> Self {
        let [across, along] = [screen.across, screen.along].map(|v| frame.world_vector(v));
        let normal = cross(across, along);
        let square = dot(normal, normal);
        let [columns, rows] = screen.size.map(|count| count as f64);
        let scaled = |v: [f64; 3], factor: f64| v.map(|x| x * factor / square);
        Self {
            corner: frame.world_point(screen.corner),
            normal,
            to_columns: scaled(cross(along, normal), columns),
            to_rows: scaled(cross(normal, across), rows),
            size: screen.size,
            cell_area: square.sqrt() / (columns * rows),
        }
    }

    pub(super) fn len(&self) -> usize {
        self.size[0] * self.size[1]
    }

    /// The cell in which a ray from a point arrives on the lit side.
    #[inline]
    pub(super) fn find(&self, origin: [f64; 3], direction: [f64; 3]) -> Option<usize> {
        let towards = dot(direction, self.normal);
        let from_corner = [0, 1, 2].map(|k| origin[k] - self.corner[k]);
        let above = dot(from_corner, self.normal);
        if towards >= 0.0 || above < 0.0 {
            return None;
        }
        let way = -above / towards;
        let place = [0, 1, 2].map(|k| from_corner[k] + way * direction[k]);
        let (column, row) = (dot(place, self.to_columns), dot(place, self.to_rows));
        let inside = column >= 0.0 && row >= 0.0 && column < self.size[0] as f64 && row < self.size[1] as f64;
        inside.then(|| row as usize * self.size[0] + column as usize)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rays_arrive_in_their_cells_on_the_lit_side() {
        let screen = Screen::below(2.0, [4.0, 2.0], [4, 2]);
        let plane = ScreenPlane::new(&screen, &Frame::default());
        assert!((plane.cell_area - 1.0).abs() < 1e-12);
        let down = [0.0, 0.0, -1.0];
        assert_eq!(plane.find([-1.5, -0.5, 0.0], down), Some(0));
        assert_eq!(plane.find([1.5, -0.5, 0.0], down), Some(3));
        assert_eq!(plane.find([1.5, 0.5, 0.0], down), Some(7));
        assert_eq!(plane.find([2.5, 0.5, 0.0], down), None);
        assert_eq!(plane.find([1.5, 0.5, -3.0], down), None);
        assert_eq!(plane.find([1.5, 0.5, -3.0], [0.0, 0.0, 1.0]), None);
        // Slanted by 45°.
        assert_eq!(plane.find([0.5, 0.5, 0.0], [-0.5_f64.sqrt(), 0.0, -0.5_f64.sqrt()]), Some(4));
    }

    #[test]
    fn screens_that_make_no_sense_are_refused() {
        for (distance, size, points) in
            [(1.0, [0.0, 1.0], [2, 2]), (f64::NAN, [1.0; 2], [2, 2]), (1.0, [1.0; 2], [0, 2]), (1.0, [1.0; 2], [1 << 40, 1 << 40])]
        {
            assert!(Screen::below(distance, size, points).checked().is_err());
        }
    }
}
