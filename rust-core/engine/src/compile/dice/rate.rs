//! How long edges are in pixels of the camera that renders.

use crate::scene::{Dicing, Projection, Scene, Transform};

/// Placements of a mesh that count: the nearest.
const PLACEMENTS: usize = 16;
/// What the camera does not see may be coarser by this factor.
const OFFSCREEN: f64 = 4.0;
/// Beside the picture something counts as seen up to this factor of its size.
const MARGIN: f64 = 1.1;
/// Metres within which everything is as far as this.
const NEAREST: f64 = 1e-3;

/// What of a camera tells how large pixels are.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct View {
    /// Camera to world; unit axes.
    axes: [[f64; 3]; 3],
    place: [f64; 3],
    /// Size of a pixel at a metre, metres; of parallel rays anywhere.
    pixel: f64,
    is_parallel: bool,
    /// Half of what is seen at a metre, or of parallel rays, about the middle; none for panoramas.
    seen: Option<[f64; 4]>,
    near: f64,
}

impl View {
    /// The view of the camera that renders; of a scene without one a metre is a thousand pixels.
    pub(super) fn of(scene: &Scene) -> Self {
        let none = Self {
            axes: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
            place: [0.0; 3],
            pixel: 1e-3,
            is_parallel: true,
            seen: None,
            near: NEAREST,
        };
        let Some(camera) = scene.cameras.get(scene.settings.camera as usize).filter(|camera| camera.transform.is_finite()) else {
            return none;
        };
        let [width, height] = scene.settings.resolution.map(|pixels| f64::from(pixels.max(1)));
        let [x, y, z, place] = camera.transform.columns;
        let axes = [x, y, z].map(|axis| {
            let length = axis.iter().map(|x| x * x).sum::<f64>().sqrt().max(f64::MIN_POSITIVE);
            axis.map(|x| x / length)
        });
        let near = camera.clipping[0].max(NEAREST);
        let at = |pixel: f64| Self { axes, place, pixel, near, is_parallel: false, ..none };
        let window = |unit: f64| {
            let [half, offset] = [camera.aperture.map(|x| 0.5 * x / unit), camera.aperture_offset.map(|x| x / unit)];
            Some([half[0], half[1], offset[0], offset[1]])
        };
        let smaller = |size: [f64; 2]| (size[0] / width).min(size[1] / height);
        match camera.projection {
            Projection::Perspective { focal_length } => {
                let unit = focal_length.max(f64::MIN_POSITIVE);
                Self { seen: window(unit), ..at(smaller(camera.aperture.map(|x| x / unit))) }
            }
            Projection::Orthographic => Self { seen: window(1.0), is_parallel: true, ..at(smaller(camera.aperture)) },
            Projection::Equirectangular { longitude, latitude } => {
                at(smaller([(longitude[1] - longitude[0]).abs(), (latitude[1] - latitude[0]).abs()]))
            }
            Projection::FisheyeEquidistant { fov_deg } | Projection::FisheyeEquisolid { fov_deg, .. } => {
                at(fov_deg.to_radians() / width.max(height))
            }
        }
    }

    /// A world point as the camera sees it: right, up, ahead.
    fn seen_from(&self, point: [f64; 3]) -> [f64; 3] {
        let way = [0, 1, 2].map(|k| point[k] - self.place[k]);
        let along = |axis: [f64; 3]| (0..3).map(|k| axis[k] * way[k]).sum::<f64>();
        [along(self.axes[0]), along(self.axes[1]), -along(self.axes[2])]
    }

    /// Whether a point within `reach` metres of another is in the picture.
    fn shows(&self, point: [f64; 3], reach: f64) -> bool {
        let Some([width, height, right, up]) = self.seen else { return true };
        let [x, y, ahead] = self.seen_from(point);
        let scale = if self.is_parallel { 1.0 } else { ahead.max(0.0) };
        ahead > -reach
            && (x - right * scale).abs() < width * scale * MARGIN + reach
            && (y - up * scale).abs() < height * scale * MARGIN + reach
    }
}

/// How long a mesh's edges are, in lengths that are asked for.
pub(super) struct Rate<'a> {
    view: &'a View,
    placements: &'a [Transform],
    dicing: Dicing,
}

impl<'a> Rate<'a> {
    pub(super) fn new(view: &'a View, placements: &'a [Transform], dicing: Dicing) -> Self {
        Self { view, placements, dicing }
    }

    /// How many times too long an edge between two points of the mesh is.
    pub(super) fn of(&self, a: &[f32; 3], b: &[f32; 3]) -> f32 {
        let [a, b] = [a.map(f64::from), b.map(f64::from)];
        if self.dicing.length > 0.0 {
            return (distance(a, b) / f64::from(self.dicing.length)) as f32;
        }
        let view = self.view;
        let pixels = |placement: &Transform| {
            let [a, b] = [placement.point(a), placement.point(b)];
            let length = distance(a, b);
            let away = distance(a, view.place).min(distance(b, view.place)).max(view.near);
            let pixel = if view.is_parallel { view.pixel } else { view.pixel * away };
            let coarser = if view.shows(a, length) || view.shows(b, length) { 1.0 } else { OFFSCREEN };
            length / (pixel * coarser)
        };
        let most = self.placements.iter().map(pixels).filter(|x| x.is_finite()).fold(0.0, f64::max);
        (most / f64::from(self.dicing.pixels.max(0.05))) as f32
    }
}

fn distance(a: [f64; 3], b: [f64; 3]) -> f64 {
    (0..3).map(|k| (a[k] - b[k]).powi(2)).sum::<f64>().sqrt()
}

/// The placements of a mesh that are nearest to the camera.
pub(super) fn nearest(scene: &Scene, mesh: usize, view: &View) -> Vec<Transform> {
    let sets = scene.instances.iter().filter(|set| set.geometry.mesh().is_some_and(|shown| shown.index() == mesh));
    let transforms: Vec<Transform> = sets.flat_map(|set| set.transforms.iter().copied()).filter(Transform::is_finite).collect();
    let points = &scene.meshes[mesh].points;
    let step = points.len().div_ceil(64).max(1);
    let away = |transform: &Transform| {
        let looked = points.iter().step_by(step).map(|point| distance(transform.point(point.map(f64::from)), view.place));
        looked.fold(f64::INFINITY, f64::min)
    };
    let mut ordered: Vec<(f64, Transform)> = transforms.iter().map(|transform| (away(transform), *transform)).collect();
    ordered.sort_by(|a, b| a.0.total_cmp(&b.0));
    ordered.into_iter().take(PLACEMENTS).map(|(_, transform)| transform).collect()
}
