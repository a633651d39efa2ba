//! How a camera meets an image: aspect ratio policies, and a camera and a light for stages without them.

use gonio::scene::{Camera, DomeFormat, Emission, Light, LightShape, Origin, Scene, Transform};

/// Vertical field of view of the automatic camera, degrees.
const AUTO_FIELD_OF_VIEW: f64 = 35.0;
/// How far the automatic camera stands to the side of the front view, degrees.
const AUTO_AZIMUTH: f64 = 30.0;
/// How far it stands above the horizon, degrees.
const AUTO_ELEVATION: f64 = 20.0;
/// Room left around the scene, as a factor on its size in the image.
const AUTO_MARGIN: f64 = 1.08;

/// UsdRender's `aspectRatioConformPolicy`: what gives way when the camera's aperture and the image differ in shape.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ConformPolicy {
    /// The aperture grows in one direction.
    #[default]
    ExpandAperture,
    /// The aperture shrinks in one direction.
    CropAperture,
    /// The aperture's width follows.
    AdjustApertureWidth,
    /// The aperture's height follows.
    AdjustApertureHeight,
    /// The pixels' shape follows.
    AdjustPixelAspectRatio,
}

impl ConformPolicy {
    /// The policy by its token.
    pub fn from_token(token: &str) -> Option<Self> {
        Some(match token {
            "expandAperture" => Self::ExpandAperture,
            "cropAperture" => Self::CropAperture,
            "adjustApertureWidth" => Self::AdjustApertureWidth,
            "adjustApertureHeight" => Self::AdjustApertureHeight,
            "adjustPixelAspectRatio" => Self::AdjustPixelAspectRatio,
            _ => return None,
        })
    }

    /// Makes the aperture and the image agree; returns the pixels' aspect ratio, which only [`Self::AdjustPixelAspectRatio`] changes.
    pub fn conform(self, aperture: &mut [f64; 2], resolution: [u32; 2], pixel_aspect: f64) -> f64 {
        let pixels = f64::from(resolution[0].max(1)) / f64::from(resolution[1].max(1));
        let [width, height] = *aperture;
        if !(width > 0.0 && height > 0.0 && pixel_aspect > 0.0) {
            return pixel_aspect;
        }
        let image = pixels * pixel_aspect;
        let is_wider = width / height > image;
        match self {
            Self::AdjustPixelAspectRatio => return width / height / pixels,
            Self::AdjustApertureWidth => aperture[0] = height * image,
            Self::AdjustApertureHeight => aperture[1] = width / image,
            Self::ExpandAperture if is_wider => aperture[1] = width / image,
            Self::ExpandAperture => aperture[0] = height * image,
            Self::CropAperture if is_wider => aperture[0] = height * image,
            Self::CropAperture => aperture[1] = width / image,
        }
        pixel_aspect
    }
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn normalized(v: [f64; 3]) -> [f64; 3] {
    let length = dot(v, v).sqrt();
    v.map(|x| x / length)
}

/// Axes right, up and back of a camera that looks at the front of a scene from the side and above.
fn three_quarter_view(is_z_up: bool) -> [[f64; 3]; 3] {
    let (azimuth, elevation) = (AUTO_AZIMUTH.to_radians(), AUTO_ELEVATION.to_radians());
    let (right, height, front) = (azimuth.sin() * elevation.cos(), elevation.sin(), azimuth.cos() * elevation.cos());
    // The front of a scene looks along +z where y is up and along -y where z is up.
    let (back, up) = if is_z_up { ([right, -front, height], [0.0, 0.0, 1.0]) } else { ([right, height, front], [0.0, 1.0, 0.0]) };
    let right = normalized(cross(up, back));
    [right, cross(back, right), back]
}

/// A camera that sees a whole box (world space, metres) in a three-quarter view; `aspect` is the image's width over its height.
///
/// An empty or unbounded box counts as a metre about the origin.
pub fn auto_camera(bounds: [[f64; 3]; 2], is_z_up: bool, aspect: f64) -> Camera {
    let [min, max] = bounds;
    let is_sound = (0..3).all(|i| min[i] <= max[i] && min[i].is_finite() && max[i].is_finite()) && min != max;
    let [min, max] = if is_sound { bounds } else { [[-0.5; 3], [0.5; 3]] };
    let aspect = if aspect > 0.0 && aspect.is_finite() { aspect } else { 1.0 };
    let axes = three_quarter_view(is_z_up);
    let centre: [f64; 3] = std::array::from_fn(|i| 0.5 * (min[i] + max[i]));
    let slope = (AUTO_FIELD_OF_VIEW.to_radians() * 0.5).tan() / AUTO_MARGIN;
    let mut distance = 0.0_f64;
    for corner in 0..8 {
        let offset: [f64; 3] = std::array::from_fn(|i| if corner >> i & 1 == 0 { min[i] } else { max[i] } - centre[i]);
        let [x, y, toward] = axes.map(|axis| dot(axis, offset));
        distance = distance.max(toward + (x.abs() / (slope * aspect)).max(y.abs() / slope));
    }
    let [right, up, back] = axes;
    let eye = std::array::from_fn(|i| centre[i] + back[i] * distance);
    let transform = Transform { columns: [right, up, back, eye] };
    let mut camera = Camera::perspective(Origin::new("automatic camera"), transform, AUTO_FIELD_OF_VIEW, aspect);
    camera.focus_distance = distance;
    camera
}

/// Limit of indirect samples where the light is at the camera, in which white is 1, nits.
pub const CAMERA_LIT_CLAMP: f32 = 2.0;

/// The name of the light at the camera.
const CAMERA_LIGHT: &str = "camera light";

/// Whether a scene has [`camera_light`], whose white is meant to be shown as white.
pub fn is_camera_lit(scene: &Scene) -> bool {
    camera_light_of(scene).is_some()
}

/// The number of [`camera_light`] among a scene's lights.
pub fn camera_light_of(scene: &Scene) -> Option<usize> {
    scene.lights.iter().position(|light| &*light.origin.name == CAMERA_LIGHT)
}

/// A light for stages without any: it shines along the camera's view without shadows, as usdrecord's, and shows a white surface that faces it as
/// white (1 cd/m²).
pub fn camera_light(camera: &Camera) -> Light {
    let emission = Emission { radiance: [std::f32::consts::PI; 3], normalized: true, ..Emission::default() };
    let shape = LightShape::Distant { angle_deg: 0.0 };
    Light { emission, casts_shadow: false, ..Light::new(Origin::new(CAMERA_LIGHT), shape, camera.transform) }
}

/// An even sky for stages without any light, in which a white surface is white (1 cd/m²).
pub fn dome_light() -> Light {
    let emission = Emission { radiance: [1.0; 3], ..Emission::default() };
    Light { emission, ..Light::new(Origin::new(CAMERA_LIGHT), LightShape::Dome { format: DomeFormat::default() }, Transform::IDENTITY) }
}

/// Width over height of a camera's aperture, for pictures whose height follows the camera.
pub fn aperture_aspect(camera: &Camera) -> f64 {
    let [width, height] = camera.aperture;
    if width > 0.0 && height > 0.0 { width / height } else { 1.0 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use gonio::scene::Projection;

    /// The half-angle tangents of a perspective camera in x and y, or half the aperture in metres of a parallel one.
    fn half_extent(camera: &Camera) -> [f64; 2] {
        match camera.projection {
            Projection::Perspective { focal_length } => camera.aperture.map(|a| 0.5 * a / focal_length),
            Projection::Orthographic => camera.aperture.map(|a| 0.5 * a),
            other => panic!("{other:?} has no aperture"),
        }
    }

    #[test]
    fn automatic_camera_sees_all_corners() {
        for is_z_up in [false, true] {
            for aspect in [0.5, 1.0, 2.4] {
                let camera = auto_camera([[-3.0, 0.0, 1.0], [7.0, 2.0, 1.5]], is_z_up, aspect);
                let to_camera = camera.transform.inverse().expect("rigid");
                let [half_x, half_y] = half_extent(&camera);
                let mut largest = 0.0_f64;
                for corner in 0..8 {
                    let p = std::array::from_fn(|i| [[-3.0, 0.0, 1.0], [7.0, 2.0, 1.5]][corner >> i & 1][i]);
                    let [x, y, z] = to_camera.point(p);
                    assert!(z < 0.0);
                    largest = largest.max((x / -z / half_x).abs()).max((y / -z / half_y).abs());
                }
                assert!(largest <= 1.0 && largest > 0.8, "{largest}");
            }
        }
    }

    #[test]
    fn automatic_camera_stands_upright() {
        assert!(auto_camera([[0.0; 3], [1.0; 3]], false, 1.0).transform.columns[1][1] > 0.9);
        assert!(auto_camera([[0.0; 3], [1.0; 3]], true, 1.0).transform.columns[1][2] > 0.9);
        assert!(auto_camera([[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]], true, 1.0).transform.is_finite());
    }

    #[test]
    fn policies_conform_the_aperture() {
        let conformed = |policy: ConformPolicy| {
            let mut aperture = [20.0, 10.0];
            let pixel_aspect = policy.conform(&mut aperture, [100, 100], 1.0);
            (aperture, pixel_aspect)
        };
        assert_eq!(conformed(ConformPolicy::ExpandAperture), ([20.0, 20.0], 1.0));
        assert_eq!(conformed(ConformPolicy::CropAperture), ([10.0, 10.0], 1.0));
        assert_eq!(conformed(ConformPolicy::AdjustApertureWidth), ([10.0, 10.0], 1.0));
        assert_eq!(conformed(ConformPolicy::AdjustApertureHeight), ([20.0, 20.0], 1.0));
        assert_eq!(conformed(ConformPolicy::AdjustPixelAspectRatio), ([20.0, 10.0], 2.0));
    }
}
