//! UsdRender's `dataWindowNDC`: the pixels that are rendered, fewer than the picture's or more (overscan).

use crate::render_settings::WHOLE_PICTURE;
use gonio::scene::{Camera, Crop, Projection, Scene};

/// How far a window may reach beyond the picture, in widths and heights of it.
const MOST_OVERSCAN: f64 = 16.0;

/// First pixel and the one behind the last, rows counted from the top; negative ones lie outside the picture.
type Pixels = [[i64; 2]; 2];

/// The pixels of a window: a pixel belongs to it if its centre does. `None` for windows that hold none.
fn pixels(window: [f64; 4], resolution: [u32; 2]) -> Option<Pixels> {
    let [left, bottom, right, top] = window.map(|x| if x.is_finite() { x.clamp(-MOST_OVERSCAN, 1.0 + MOST_OVERSCAN) } else { 0.0 });
    let [width, height] = resolution.map(f64::from);
    let pixel = |x: f64| (x - 0.5).ceil() as i64;
    let [min, max] = [[pixel(left * width), pixel((1.0 - top) * height)], [pixel(right * width), pixel((1.0 - bottom) * height)]];
    (min[0] < max[0] && min[1] < max[1]).then_some([min, max])
}

/// Limits the scene's picture to a window, or makes it larger; to be called when the cameras fit the picture. Gives what is wrong with it.
pub(crate) fn apply(scene: &mut Scene, window: [f64; 4]) -> Option<String> {
    if window == WHOLE_PICTURE {
        return None;
    }
    let resolution = scene.settings.resolution;
    let Some([min, max]) = pixels(window, resolution) else {
        return Some(format!("dataWindowNDC is {window:?}, which holds no pixel; the whole picture is rendered"));
    };
    let before = min.map(|first| u32::try_from(-first).unwrap_or(0));
    let behind: [u32; 2] = std::array::from_fn(|axis| u32::try_from(max[axis] - i64::from(resolution[axis])).unwrap_or(0));
    let [left, top, right, bottom] = [before[0], before[1], behind[0], behind[1]];
    let is_panorama = |camera: &Camera| !matches!(camera.projection, Projection::Perspective { .. } | Projection::Orthographic);
    let beyond = [left, top, right, bottom] != [0; 4];
    if beyond && scene.cameras.get(scene.settings.camera as usize).is_some_and(is_panorama) {
        return Some("overscan of a panorama is not supported; the whole picture is rendered".into());
    }
    scene.cameras.iter_mut().for_each(|camera| widen(camera, resolution, [left, top, right, bottom]));
    scene.settings.resolution = [resolution[0] + left + right, resolution[1] + top + bottom];
    scene.settings.overscan = [left, top, right, bottom];
    let place = |at: [i64; 2]| std::array::from_fn(|axis| u32::try_from(at[axis] + i64::from(before[axis])).unwrap_or(0));
    let crop = Crop { min: place(min), max: place(max) };
    scene.settings.crop = (crop != Crop { min: [0; 2], max: scene.settings.resolution }).then_some(crop);
    None
}

/// Makes the image plane larger by pixels on each side.
fn widen(camera: &mut Camera, resolution: [u32; 2], [left, top, right, bottom]: [u32; 4]) {
    let pixel: [f64; 2] = std::array::from_fn(|axis| camera.aperture[axis] / f64::from(resolution[axis]));
    let [left, top, right, bottom] = [left, top, right, bottom].map(f64::from);
    camera.aperture = [camera.aperture[0] + (left + right) * pixel[0], camera.aperture[1] + (top + bottom) * pixel[1]];
    camera.aperture_offset[0] += 0.5 * (right - left) * pixel[0];
    camera.aperture_offset[1] += 0.5 * (top - bottom) * pixel[1];
}

#[cfg(test)]
mod tests {
    use super::*;
    use gonio::scene::Settings;

    fn scene(resolution: [u32; 2]) -> Scene {
        let settings = Settings { resolution, ..Settings::default() };
        Scene { settings, cameras: vec![Camera { aperture: [20.0, 10.0], ..Camera::default() }], ..Scene::default() }
    }

    #[test]
    fn windows_inside_crop_and_count_rows_from_the_top() {
        let mut scene = scene([200, 100]);
        assert_eq!(apply(&mut scene, [0.5, 0.75, 1.0, 1.0]), None);
        assert_eq!(scene.settings.crop, Some(Crop { min: [100, 0], max: [200, 25] }));
        assert_eq!((scene.settings.resolution, scene.settings.overscan), ([200, 100], [0; 4]));
    }

    #[test]
    fn windows_outside_make_the_picture_larger() {
        let mut whole = scene([200, 200]);
        assert_eq!(apply(&mut whole, [-0.1_f32, -0.1, 1.1, 1.1].map(f64::from)), None);
        assert_eq!((whole.settings.resolution, whole.settings.overscan, whole.settings.crop), ([240, 240], [20; 4], None));
        assert!((whole.cameras[0].aperture[0] - 24.0).abs() < 1e-12);
        let mut part = scene([200, 100]);
        assert_eq!(apply(&mut part, [0.5, 0.5, 1.25, 1.5]), None);
        assert_eq!((part.settings.resolution, part.settings.overscan), ([250, 150], [0, 50, 50, 0]));
        assert_eq!(part.settings.crop, Some(Crop { min: [100, 0], max: [250, 100] }));
        assert!((part.cameras[0].aperture_offset[0] - 2.5).abs() < 1e-12 && (part.cameras[0].aperture_offset[1] - 2.5).abs() < 1e-12);
    }

    #[test]
    fn windows_without_a_pixel_are_told() {
        let mut scene = scene([200, 100]);
        assert!(apply(&mut scene, [0.6, 0.0, 0.4, 1.0]).is_some());
        assert_eq!(scene.settings.crop, None);
    }
}
