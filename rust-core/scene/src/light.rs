//! Light sources.

use super::lamp_spectrum::LampSpectrum;
use super::{Goniogram, LightFilter, LightQuantity, Linking, Opening, Origin, TextureId, Transform, Visibility};
use gonio_spectrum::ColourSpectra;
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// How a dome's image is laid out.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum DomeFormat {
    /// By the image's shape; latitude–longitude for every shape but those that say otherwise.
    #[default]
    Automatic,
    /// Latitude–longitude by the OpenEXR convention: top row +Y, centre column +Z, longitude growing to the left.
    LatLong,
    /// A mirrored ball.
    MirroredBall,
    /// An angular map.
    Angular,
    /// A cube map unfolded to a vertical cross.
    CubeMapVerticalCross,
}

/// The emitter's geometry, in the light's own space.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum LightShape {
    /// `width` along x, `height` along y, emitting along −z.
    Rectangle {
        /// Local units.
        width: f64,
        /// Local units.
        height: f64,
    },
    /// In the plane z = 0, emitting along −z.
    Disk {
        /// Local units.
        radius: f64,
    },
    /// In the plane z = 0, `width` along x, `height` along y, emitting along −z.
    Ellipse {
        /// Local units.
        width: f64,
        /// Local units.
        height: f64,
    },
    /// About the origin, emitting outward.
    Sphere {
        /// Local units.
        radius: f64,
    },
    /// A disk about the origin that turns its face to whatever it lights or is seen by: what a sphere becomes that is not to cut into surfaces.
    FacingDisk {
        /// Local units, along x.
        radius: f64,
    },
    /// The origin alone; the emission's radiance is a luminous intensity in cd. No ray sees it.
    Point,
    /// About the x axis, emitting outward, without caps.
    Cylinder {
        /// Local units.
        radius: f64,
        /// Local units.
        length: f64,
    },
    /// A luminaire's: the emission's radiance is a luminous intensity in cd, which each part of the opening sends in the share that it has in the
    /// area seen from there. From afar it is the intensity in every direction; from near it is as if every part sent alike.
    Opening(Opening),
    /// Infinitely far, shining along −z, seen under `angle_deg` (full angle).
    Distant {
        /// Full angle in degrees; 0 gives parallel light.
        angle_deg: f64,
    },
    /// All around, +Y up in the light's own space.
    Dome {
        /// Layout of the image.
        format: DomeFormat,
    },
}

impl LightShape {
    /// Whether the light has no place.
    pub fn is_at_infinity(&self) -> bool {
        matches!(self, Self::Distant { .. } | Self::Dome { .. })
    }
}

/// How strong the light is.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Emission {
    /// Radiance (linear Rec.709, luminance in cd/m²), or what `normalized` makes of it.
    pub radiance: [f32; 3],
    /// Divide by the emitter's size factor: area in square local-stage units for shapes, projected solid angle for distant lights.
    pub normalized: bool,
    /// Metres in the unit that `normalized` measures areas in.
    pub metres_per_unit: f64,
}

impl Default for Emission {
    fn default() -> Self {
        Self { radiance: [1.0; 3], normalized: false, metres_per_unit: 1.0 }
    }
}

/// UsdLux's shaping: what narrows the beam.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Shaping {
    /// Half angle in degrees beyond which nothing is emitted; `None` means no cone.
    pub cone_angle_deg: Option<f32>,
    /// 0 is a hard edge, 1 falls off from the axis on.
    pub cone_softness: f32,
    /// Exponent of the cosine to the axis.
    pub focus: f32,
    /// Colour away from the axis.
    pub focus_tint: [f32; 3],
}

impl Default for Shaping {
    fn default() -> Self {
        Self { cone_angle_deg: None, cone_softness: 0.0, focus: 0.0, focus_tint: [0.0; 3] }
    }
}

/// A spot's cone about −z, which cuts the light and leaves the strength of what remains. Towards a direction at angle θ from −z the emission is
/// multiplied by `smoothstep((cos θ − cos(angle / 2)) / ((1 − cos(angle / 2)) · blend))`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Spot {
    /// Full angle of the cone in degrees.
    pub angle_deg: f32,
    /// 0 is a hard edge, 1 falls off from the axis on.
    pub blend: f32,
    /// Widens the cone along x and y: θ is taken of directions whose x and y are divided by these.
    #[serde(default = "unit_stretch")]
    pub stretch: [f32; 2],
}

fn unit_stretch() -> [f32; 2] {
    [1.0; 2]
}

fn whole() -> f32 {
    1.0
}

#[expect(clippy::trivially_copy_pass_by_ref, reason = "serde asks for it")]
fn is_whole(share: &f32) -> bool {
    *share == 1.0
}

fn lambertian_deg() -> f32 {
    180.0
}

/// How light falls with distance where that is not nature's way: the radiance is multiplied by the distance in metres to a power, and by
/// d² / (smooth + d²).
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Falloff {
    /// 0 is nature's way (the square of the distance), 1 makes light fall linearly, 2 not at all.
    pub power: u32,
    /// Keeps the light's strength near by within bounds, m²; 0 does nothing.
    #[serde(default)]
    pub smooth: f32,
}

/// A light source.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Light {
    /// Where it came from.
    pub origin: Origin,
    /// The emitter.
    pub shape: LightShape,
    /// Its strength.
    pub emission: Emission,
    /// Its strength in another unit, in place of the emission's, whose radiance then tells the colour alone.
    #[serde(default)]
    pub quantity: Option<LightQuantity>,
    /// Factor on its strength and on its power: a dimmer's.
    #[serde(default = "whole")]
    pub dimming: f32,
    /// Factor on its strength alone: what ageing and soiling leave (CIE 97).
    #[serde(default = "whole", skip_serializing_if = "is_whole")]
    pub maintenance: f32,
    /// The spectrum of what it sends, whose colour takes the place of the emission's; none: the spectrum is made of the colour.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub spectrum: Option<Arc<LampSpectrum>>,
    /// Where light has wavelengths and it has no spectrum: the spectra of its colour's red, green and blue. Sun and sky have them.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub colour_spectra: Option<Arc<ColourSpectra>>,
    /// Narrowing of the beam.
    pub shaping: Shaping,
    /// A spot's cone.
    #[serde(default)]
    pub spot: Option<Spot>,
    /// The light group that it belongs to; the nameless ones are together in [`super::OTHER_LIGHTS`].
    #[serde(default)]
    pub group: String,
    /// Measured factors by direction; lights at infinity have no use for them.
    #[serde(default)]
    pub goniogram: Option<Arc<Goniogram>>,
    /// Full angle in degrees of the beam of rectangles, disks and ellipses, which keeps its flux: h being half the angle, the radiance at angle θ from
    /// −z is multiplied by `max(tan h − tan θ, 0) / (tan h − h)`. 180 is Lambert's law.
    #[serde(default = "lambertian_deg")]
    pub spread_deg: f32,
    /// A rectangle that is no light but an opening (a window) through which domes shine along −z: it only tells where to look for them.
    #[serde(default)]
    pub portal: bool,
    /// Multiplies the radiance over a rectangle or a dome.
    pub texture: Option<TextureId>,
    /// Local to world, metres.
    pub transform: Transform,
    /// The same at evenly spaced times over the shutter, two or more; empty where it stands still.
    #[serde(default)]
    pub motion: Vec<Transform>,
    /// Which rays see the emitter itself; `shadow` is not used.
    pub visibility: Visibility,
    /// Whether things block it.
    pub casts_shadow: bool,
    /// Factor on what surfaces scatter diffusely of its light; no light does that by itself.
    #[serde(default = "whole")]
    pub diffuse: f32,
    /// Factor on what surfaces reflect and transmit of it otherwise.
    #[serde(default = "whole")]
    pub specular: f32,
    /// Factor on what media scatter of it.
    #[serde(default = "whole")]
    pub volume: f32,
    /// How it falls with distance; lights at infinity, light paths and luminaires that are measured have no use for it.
    #[serde(default)]
    pub falloff: Falloff,
    /// What stands before it; lights at infinity and luminaires that are measured have no use for it.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub filters: Vec<LightFilter>,
    /// What it lights, and what casts its shadows. Cameras see it either way.
    #[serde(default, skip_serializing_if = "Linking::is_whole")]
    pub linking: Linking,
}

impl Default for Light {
    /// A point of 1 cd.
    fn default() -> Self {
        Self {
            origin: Origin::default(),
            shape: LightShape::Point,
            emission: Emission::default(),
            quantity: None,
            spectrum: None,
            colour_spectra: None,
            dimming: whole(),
            maintenance: whole(),
            shaping: Shaping::default(),
            spot: None,
            group: String::new(),
            goniogram: None,
            spread_deg: lambertian_deg(),
            portal: false,
            texture: None,
            transform: Transform::IDENTITY,
            motion: Vec::new(),
            visibility: Visibility::default(),
            casts_shadow: true,
            diffuse: whole(),
            specular: whole(),
            volume: whole(),
            falloff: Falloff::default(),
            filters: Vec::new(),
            linking: Linking::default(),
        }
    }
}

impl Light {
    /// The spectrum of what it sends where light has wavelengths: its own; without one, and without a colour, that of its luminaire's file.
    pub fn lamp_spectrum(&self) -> Option<&Arc<LampSpectrum>> {
        let of_file = self.file_spectrum().filter(|_| !self.has_colour());
        self.spectrum.as_ref().or(of_file)
    }

    /// Whether its colour stands for the spectrum that its luminaire's file has.
    pub fn colour_hides_spectrum(&self) -> bool {
        self.spectrum.is_none() && self.has_colour() && self.file_spectrum().is_some()
    }

    fn file_spectrum(&self) -> Option<&Arc<LampSpectrum>> {
        let goniogram = self.goniogram.as_ref().filter(|_| !self.shape.is_at_infinity());
        goniogram.and_then(|goniogram| goniogram.spectrum.as_ref())
    }

    fn has_colour(&self) -> bool {
        let [r, g, b] = self.emission.radiance;
        r != g || g != b
    }

    /// Share of its full strength: dimming times maintenance.
    pub fn share(&self) -> f32 {
        self.dimming * self.maintenance
    }
    /// Whether it has a place, and shines itself.
    pub fn is_luminaire(&self) -> bool {
        !self.shape.is_at_infinity() && !self.portal
    }
    /// A light of a shape at a place, of radiance 1 (cd/m²; 1 cd for a point) and with nothing else set.
    pub fn new(origin: Origin, shape: LightShape, transform: Transform) -> Self {
        Self { origin, shape, transform, ..Self::default() }
    }

    /// Whether it takes light away, in some colour.
    pub fn takes_away(&self) -> bool {
        self.emission.radiance.iter().any(|x| *x < 0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lights_of_older_bundles_are_plain() {
        let light = Light::new(Origin::new("lamp"), LightShape::Disk { radius: 2.0 }, Transform::IDENTITY);
        let mut json = serde_json::to_value(&light).expect("plain data");
        let fields = json.as_object_mut().expect("a structure");
        for name in ["spot", "spread_deg", "portal", "goniogram", "quantity", "dimming", "group", "diffuse", "specular", "falloff"] {
            assert!(fields.remove(name).is_some(), "{name}");
        }
        let older: Light = serde_json::from_value(json).expect("older form");
        assert_eq!((older.spot, older.spread_deg, older.portal), (None, 180.0, false));
        assert_eq!((older.quantity, older.dimming), (None, 1.0));
        assert_eq!((older.diffuse, older.specular, older.falloff), (1.0, 1.0, Falloff::default()));
        assert_eq!(older.shape, light.shape);
    }
}
