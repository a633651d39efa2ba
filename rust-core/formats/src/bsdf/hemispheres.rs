//! Which side light comes from and which side it leaves to.

use super::direction::{Direction, through};

/// A pair of hemispheres. Front is the side that z points to; the word names the side light comes *from*.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Hemispheres {
    /// From the front, back to the front.
    ReflectionFront,
    /// From the back, back to the back.
    ReflectionBack,
    /// From the front through to the back.
    TransmissionFront,
    /// From the back through to the front.
    TransmissionBack,
}

impl Hemispheres {
    /// All of them, in the order of their index.
    pub const ALL: [Self; 4] = [Self::ReflectionFront, Self::ReflectionBack, Self::TransmissionFront, Self::TransmissionBack];

    /// The pair that two directions away from the surface belong to; none if one lies in the surface.
    pub fn of(wi: Direction, wo: Direction) -> Option<Self> {
        match (wi[2].partial_cmp(&0.0)?, wo[2].partial_cmp(&0.0)?) {
            (core::cmp::Ordering::Greater, core::cmp::Ordering::Greater) => Some(Self::ReflectionFront),
            (core::cmp::Ordering::Less, core::cmp::Ordering::Less) => Some(Self::ReflectionBack),
            (core::cmp::Ordering::Greater, core::cmp::Ordering::Less) => Some(Self::TransmissionFront),
            (core::cmp::Ordering::Less, core::cmp::Ordering::Greater) => Some(Self::TransmissionBack),
            _ => None,
        }
    }

    /// Whether light comes from the side that z points to.
    pub fn is_from_front(self) -> bool {
        matches!(self, Self::ReflectionFront | Self::TransmissionFront)
    }

    /// Whether light stays on its side.
    pub fn is_reflection(self) -> bool {
        matches!(self, Self::ReflectionFront | Self::ReflectionBack)
    }

    /// The pair of light that goes the same way in the opposite sense.
    pub fn reversed(self) -> Self {
        match self {
            Self::TransmissionFront => Self::TransmissionBack,
            Self::TransmissionBack => Self::TransmissionFront,
            reflection => reflection,
        }
    }

    /// Its name in files: `reflection-front` and so on.
    pub fn name(self) -> &'static str {
        match self {
            Self::ReflectionFront => "reflection-front",
            Self::ReflectionBack => "reflection-back",
            Self::TransmissionFront => "transmission-front",
            Self::TransmissionBack => "transmission-back",
        }
    }

    /// The pair with that name.
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|pair| pair.name() == name)
    }

    /// Both directions moved to the front: those of a back side are mirrored in the surface, x and y stay.
    pub(crate) fn to_front(self, wi: Direction, wo: Direction) -> (Direction, Direction) {
        let up = |d: Direction| if d[2] < 0.0 { through(d) } else { d };
        (up(wi), up(wo))
    }
}
