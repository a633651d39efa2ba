//! Light records: what the compile step says about each light, in plain data.

use super::light_kind::LightKind;
use super::projected_area::ProjectedArea;

/// What narrows the beam (UsdLux ShapingAPI): the emission towards a direction at angle θ from −axis z is multiplied by
/// `lerp(focus_tint, 1, |cos θ|^focus) · (1 − smoothstep(θ; cone_angle (1 − softness), cone_angle))`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shaping {
    /// Half angle in radians beyond which nothing is emitted; infinite means no cone.
    pub cone_angle: f32,
    /// 0 is a hard edge, 1 falls off from the axis on.
    pub softness: f32,
    /// Exponent of the cosine to the axis; not positive means none.
    pub focus: f32,
    /// Colour where the cosine's power is 0.
    pub focus_tint: [f32; 3],
}

impl Default for Shaping {
    fn default() -> Self {
        Self { cone_angle: f32::INFINITY, softness: 0.0, focus: 0.0, focus_tint: [0.0; 3] }
    }
}

/// A spot's cone, smooth in the cosine: the emission towards a direction at angle θ from −axis z is multiplied by
/// `smoothstep((cos θ − cos h) / ((1 − cos h) · blend))`, h being the half angle. The cone cuts; what is left keeps its strength.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spot {
    /// Full angle of the cone in radians.
    pub angle: f32,
    /// 0 is a hard edge, 1 falls off from the axis on.
    pub blend: f32,
    /// Widens the cone along axes x and y: directions are taken with their x and y divided by these.
    pub stretch: [f32; 2],
}

/// A luminaire's opening as one of its parts knows it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OpeningPart {
    /// What the whole opening shows.
    pub area: ProjectedArea,
    /// The part's share of the opening's surface, for light selection.
    pub share: f32,
    /// Axes x, y and z of the luminaire, which shaping, spot and goniogram refer to.
    pub axes: [[f32; 3]; 3],
}

/// A factor by distance on a light's radiance: d to a power, times d² / (smooth + d²).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Falloff {
    /// 0 is nature's way, 1 makes light fall linearly, 2 not at all.
    pub power: u32,
    /// Keeps the light's strength near by within bounds, m²; 0 does nothing.
    pub smooth: f32,
}

impl Falloff {
    /// Nature's way.
    pub const NATURAL: Self = Self { power: 0, smooth: 0.0 };

    pub(crate) fn words(self) -> [f32; 2] {
        [self.power as f32, self.smooth]
    }
}

/// A light, in world space and metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LightRecord {
    /// The emitter.
    pub kind: LightKind,
    /// Axis columns x, y, z and the origin. The axes carry the light's size (half width, half height, radius, half length) and need not be
    /// orthogonal; see [`LightKind`] for what they span. Domes and distant lights use the axes' directions alone.
    pub to_world: [[f32; 3]; 4],
    /// Emitted radiance (cd/m², Rec.709) before shaping and texture, already divided by the normalize factor. Cd for points, lx on a facing
    /// surface for distant lights of angle 0.
    pub radiance: [f32; 3],
    /// The luminaire that the light is a part of: the radiance is then an intensity in cd, and what the opening shows of itself to a direction divides it.
    pub opening: Option<OpeningPart>,
    /// Narrowing of the beam; domes and distant lights ignore it.
    pub shaping: Shaping,
    /// A spot's cone; domes and distant lights ignore it.
    pub spot: Option<Spot>,
    /// Measured factors by direction, for lights that have a place: an index into the goniograms given to [`super::LightTable::build`].
    pub goniogram: Option<u32>,
    /// Full angle in radians of the beam of flat lights, as slats before them would cut it: the radiance at angle θ from the normal is multiplied by
    /// `max(tan h − tan θ, 0) / (tan h − h)`, h being half of it, which keeps the flux. π and more is Lambert's law.
    pub spread: f32,
    /// Rectangles: not a light but an opening that domes emit through, towards −axis z; domes are looked for there too.
    pub portal: bool,
    /// Multiplies the radiance over a rectangle or a dome: an index into the textures given to [`super::LightTable::build`].
    pub texture: Option<u32>,
    /// Full angle of a distant light in radians.
    pub angle: f32,
    /// Emitting area in m² for light selection; 0 lets the table find it.
    pub area: f32,
    /// Rectangles, disks and triangles: emits from both sides alike.
    pub two_sided: bool,
    /// Whether camera rays see the emitter.
    pub visible_to_camera: bool,
    /// Whether scattered rays find the emitter; without it the light is not sampled either.
    pub visible_to_scattered: bool,
    /// Factors on what is scattered of its light: diffusely, glossily, transmitted, by media. Kinds of scattered rays of factor 0 do not find the emitter.
    /// Light sampling alone is exact for what is neither 0 nor 1.
    pub scattered: [f32; 4],
    /// How it falls with distance; lights at infinity have no use for it.
    pub falloff: Falloff,
    /// Whether things block it.
    pub casts_shadow: bool,
    /// Whether light sampling alone is to find it, but for what mirrors and smooth glass show: what scattered rays meet tells nothing of what
    /// blocks it.
    pub sampled_alone: bool,
    /// Whether a shading program knows what each point emits: the radiance is then the mean, grey, and light samples carry that.
    pub shaded: bool,
}

impl LightRecord {
    /// A light of `kind` with identity axes at the origin, radiance 1 and nothing else set.
    pub fn new(kind: LightKind) -> Self {
        Self {
            kind,
            to_world: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [0.0; 3]],
            radiance: [1.0; 3],
            opening: None,
            shaping: Shaping::default(),
            spot: None,
            goniogram: None,
            spread: std::f32::consts::PI,
            portal: false,
            texture: None,
            angle: 0.0,
            area: 0.0,
            two_sided: false,
            visible_to_camera: true,
            visible_to_scattered: true,
            casts_shadow: true,
            scattered: [1.0; 4],
            falloff: Falloff::NATURAL,
            sampled_alone: false,
            shaded: false,
        }
    }
}

/// A linear Rec.709 image, top row first: seen upright by what a rectangle lights; latitude–longitude for domes, top row +Y, centre column +Z,
/// longitude growing to the left (OpenEXR).
#[derive(Clone, Debug, Default)]
pub struct LightTexture {
    /// Pixels across.
    pub width: usize,
    /// Pixels down.
    pub height: usize,
    /// Three values a pixel, row by row.
    pub rgb: Vec<f32>,
}
