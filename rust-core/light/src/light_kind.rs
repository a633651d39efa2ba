//! The kinds of lights.

/// The emitter's geometry.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u8)]
pub enum LightKind {
    /// A parallelogram: origin ± axis x ± axis y, emitting towards −axis z.
    Rectangle,
    /// An ellipse: origin + a x + b y with a² + b² ≤ 1, emitting towards −axis z.
    Disk,
    /// An ellipsoid: the unit sphere under the axes, emitting outward.
    Sphere,
    /// The lateral surface of an elliptic cylinder: origin + a x + cos φ y + sin φ z with |a| ≤ 1, emitting outward, without caps.
    Cylinder,
    /// Infinitely far, seen towards +axis z under [`super::LightRecord::angle`].
    Distant,
    /// All around, +axis y up.
    Dome,
    /// A point; its radiance is a luminous intensity in cd.
    Point,
    /// Corners origin, origin + x, origin + y; emits to the side that x × y points to; −axis z is its shaping axis.
    Triangle,
    /// A disk about the origin, as large as axis x is long, that turns its face to whatever looks at it.
    FacingDisk,
}

impl LightKind {
    /// All kinds, in the order of their numbers.
    pub const ALL: [Self; 9] = [
        Self::Rectangle,
        Self::Disk,
        Self::Sphere,
        Self::Cylinder,
        Self::Distant,
        Self::Dome,
        Self::Point,
        Self::Triangle,
        Self::FacingDisk,
    ];

    /// Whether the light has no place.
    pub fn is_infinite(self) -> bool {
        matches!(self, Self::Distant | Self::Dome)
    }

    /// Whether the light is a part of a plane with a side that emits.
    pub fn is_flat(self) -> bool {
        matches!(self, Self::Rectangle | Self::Disk | Self::Triangle)
    }
}
