//! A tile as a pinhole sees it: where points of the world lie in its raster, and back.

use crate::{
    accel::Beam,
    camera::{CameraTable, Lens},
    geometry::GeometryTable,
};

/// How far axes may be from square to one another, as a cosine.
const SQUARE: f32 = 1e-4;
/// Pixels that a tile's beam is wider on each side, for rounding.
const MARGIN: f32 = 0.1;

/// Three rows, each of factors of x, y, z and one.
pub(super) type Rows = [[f32; 4]; 3];

/// The raster of a tile: pixels from its top left corner, and depths along the camera's axis in metres.
#[derive(Clone, Copy, Debug)]
pub(super) struct TileView {
    /// From the world to raster x and y, both times the depth, and the depth.
    rows: Rows,
    /// The point of the plane at depth 1 that lies at the raster's origin, and its steps from pixel to pixel.
    pub(super) corner: [f32; 2],
    pub(super) pixel: [f32; 2],
    /// Depths that the camera sees.
    pub(super) clipping: [f32; 2],
    /// Width and height in pixels.
    pub(super) size: [usize; 2],
    beam: Beam,
}

impl TileView {
    /// None for cameras that are no pinhole.
    pub(super) fn new(camera: &CameraTable, min: [u32; 2], size: [usize; 2]) -> Option<Self> {
        let axes = camera.axes;
        let square = [[0, 1], [1, 2], [2, 0]].iter().all(|[a, b]| dot(axes[*a], axes[*b]).abs() < SQUARE);
        // Of a polygon's opening the rays take a point beside the middle.
        let pinhole = camera.lens_radius == 0.0 || camera.aperture.blades < 3;
        if camera.lens != Lens::Perspective || !camera.planes.is_empty() || !square || !pinhole {
            return None;
        }
        let pixel = [camera.pixel[0], -camera.pixel[1]];
        let corner = [0, 1].map(|axis| camera.corner[axis] + pixel[axis] * min[axis] as f32);
        let depth = axes[2].map(|x| -x);
        let row = |axis: usize| {
            let [over, moved] = [pixel[axis].recip(), corner[axis] / pixel[axis]];
            [0, 1, 2].map(|k| axes[axis][k] * over - depth[k] * moved)
        };
        let rows = [row(0), row(1), depth].map(|row| [row[0], row[1], row[2], -dot(row, camera.position)]);
        let [width, height] = size.map(|side| side as f32 + MARGIN);
        let rim = [[-MARGIN, -MARGIN], [width, -MARGIN], [width, height], [-MARGIN, height]].map(|place: [f32; 2]| {
            let [x, y] = [0, 1].map(|axis| corner[axis] + pixel[axis] * place[axis]);
            [0, 1, 2].map(|k| axes[0][k] * x + axes[1][k] * y + depth[k])
        });
        Some(Self { rows, corner, pixel, clipping: camera.clipping, size, beam: Beam { apex: camera.position, rim } })
    }

    /// What the tile's rays fill.
    pub(super) fn beam(&self) -> &Beam {
        &self.beam
    }

    /// The rows for the world.
    pub(super) fn world(&self) -> &Rows {
        &self.rows
    }

    /// The rows for an instance's own space.
    pub(super) fn of_instance(&self, geometry: &GeometryTable, instance: u32) -> Rows {
        let map = &geometry.instance_transform[instance as usize * 12..][..12];
        let column = |k: usize| [map[3 * k], map[3 * k + 1], map[3 * k + 2]];
        self.rows.map(|row| {
            let [x, y, z, moved] = [0, 1, 2, 3].map(|k| dot([row[0], row[1], row[2]], column(k)));
            [x, y, z, moved + row[3]]
        })
    }

    /// First and last column and row of the pixels that may show a box of the world; `None` if none does.
    pub(super) fn pixels_of(&self, bounds: [[f32; 3]; 2]) -> Option<[[usize; 2]; 2]> {
        let (mut low, mut high) = ([f32::INFINITY; 2], [-f32::INFINITY; 2]);
        // Sides that all corners lie beyond: left, above, right, below, and behind the camera.
        let (mut beyond, mut behind) = ([true; 5], false);
        for corner in 0..8 {
            let point = [0, 1, 2].map(|k| bounds[corner >> k & 1][k]);
            let [x, y, depth] = self.rows.map(|row| dot([row[0], row[1], row[2]], point) + row[3]);
            for (axis, place) in [x, y].into_iter().enumerate() {
                beyond[axis] &= place < -depth;
                beyond[axis + 2] &= place > depth * (self.size[axis] as f32 + 1.0);
                (low[axis], high[axis]) = (low[axis].min(place / depth - 1.0), high[axis].max(place / depth + 1.0));
            }
            beyond[4] &= depth <= 0.0;
            behind |= depth <= 0.0;
        }
        if beyond.contains(&true) {
            return None;
        }
        // Around the camera: anywhere.
        self.clipped(if behind { [[-1.0; 2], self.size.map(|side| side as f32)] } else { [low, high] })
    }

    fn clipped(&self, [low, high]: [[f32; 2]; 2]) -> Option<[[usize; 2]; 2]> {
        let inside = |axis: usize| high[axis] >= 0.0 && low[axis] < self.size[axis] as f32;
        let ends = |axis: usize| [low[axis].max(0.0) as usize, (high[axis] as usize).min(self.size[axis] - 1)];
        (inside(0) && inside(1)).then(|| [ends(0), ends(1)])
    }
}

/// Whether an instance's map mirrors: −1 if so, else 1.
pub(super) fn handedness(geometry: &GeometryTable, instance: u32) -> f32 {
    let map = &geometry.instance_transform[instance as usize * 12..][..12];
    let [x, y, z] = [0, 1, 2].map(|k| [map[3 * k], map[3 * k + 1], map[3 * k + 2]]);
    let cross = [0, 1, 2].map(|k| x[(k + 1) % 3] * y[(k + 2) % 3] - x[(k + 2) % 3] * y[(k + 1) % 3]);
    dot(cross, z).signum()
}

fn dot(a: [f32; 3], b: [f32; 3]) -> f32 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}
