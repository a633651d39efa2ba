//! Tensor trees: a BSDF over squares of directions, refined where it changes (Ward, Kurt and Bonneel, A Practical Framework for Sharing and
//! Rendering Real-World Bidirectional Scattering Distribution Functions, LBNL 2012).
//!
//! Directions lie on a disk by their x and y, and the disk on a square by Shirley and Chiu's concentric map, so that equal areas of the square
//! are equal projected solid angles.

use core::f64::consts::FRAC_PI_4;

use super::colour::Channels;
use super::direction::Direction;
use super::hemispheres::Hemispheres;
use super::patches::Band;
use crate::error::{FormatError, Result};

/// Deeper nodes than that have no area that a number tells apart.
pub(crate) const DEEPEST: usize = 24;

/// A tree of constant cells over the unit cube of `rank` dimensions, in 1/sr, without the cosine.
///
/// Flat arrays, as a lane kernel walks them: node 0 is the root.
#[derive(Clone, Debug, PartialEq)]
pub struct Tree {
    /// 3 (θi and the outgoing square) or 4 (both squares).
    pub rank: u32,
    /// A branch's first child (its 2^rank children lie side by side, bit `d` of a child's number is its half of dimension `d`), or a leaf's
    /// first value.
    pub first: Vec<u32>,
    /// −1 for a branch, else the binary logarithm of a leaf's grid size along each dimension.
    pub log2: Vec<i8>,
    /// The leaves' grids, the last dimension fastest.
    pub values: Vec<f32>,
}

/// A tree for one band and one pair of hemispheres.
#[derive(Clone, Debug, PartialEq)]
pub struct Component {
    /// Which sides light goes between.
    pub hemispheres: Hemispheres,
    /// What part of the spectrum it is for; u′ and v′ are colours, not scattering.
    pub band: Band,
    /// Its values.
    pub tree: Tree,
}

/// A material of tensor trees.
#[derive(Clone, Debug, PartialEq)]
pub struct TensorTree {
    components: Vec<Component>,
    channels: Channels,
}

impl Tree {
    /// The value at a place of the unit cube.
    pub fn value(&self, at: &[f64]) -> f64 {
        let rank = self.rank as usize;
        let mut place = [0.0; 4];
        for (x, &given) in place.iter_mut().zip(at) {
            *x = given.clamp(0.0, 1.0 - f64::EPSILON);
        }
        let mut node = 0;
        while self.log2[node] < 0 {
            let mut child = 0;
            for (d, x) in place[..rank].iter_mut().enumerate() {
                *x *= 2.0;
                if *x >= 1.0 {
                    child |= 1 << d;
                    *x -= 1.0;
                }
            }
            node = self.first[node] as usize + child;
        }
        let side = 1_usize << self.log2[node];
        let cell = place[..rank].iter().fold(0, |cell, x| cell * side + ((x * side as f64) as usize).min(side - 1));
        f64::from(self.values[self.first[node] as usize + cell])
    }
}

impl TensorTree {
    /// Trees of one material.
    ///
    /// # Errors
    /// When there is none for scattering.
    pub fn new(components: Vec<Component>) -> Result<Self> {
        let has = |band| components.iter().any(|c| c.band == band);
        if !components.iter().any(|c| !matches!(c.band, Band::CieU | Band::CieV)) {
            return Err(FormatError::whole("no scattering data"));
        }
        let coloured = has(Band::Visible) && (has(Band::CieX) && has(Band::CieZ) || has(Band::CieU) && has(Band::CieV));
        let channels = if coloured { Channels::Xyz } else { Channels::Luminance };
        Ok(Self { components, channels })
    }

    /// All trees.
    pub fn components(&self) -> &[Component] {
        &self.components
    }

    /// What evaluation gives: luminance, or XYZ where the file has it.
    pub fn channels(&self) -> &Channels {
        &self.channels
    }

    /// The tree of a band.
    pub fn tree(&self, hemispheres: Hemispheres, band: Band) -> Option<&Tree> {
        self.components.iter().find(|c| c.hemispheres == hemispheres && c.band == band).map(|c| &c.tree)
    }

    /// Whether there is light from the one side to the other, measured or by reciprocity.
    pub(crate) fn has(&self, hemispheres: Hemispheres) -> bool {
        let fits = |c: &Component| c.hemispheres == hemispheres || c.hemispheres == hemispheres.reversed();
        self.components.iter().any(|c| fits(c) && c.band == Band::Visible)
    }

    /// The BSDF in 1/sr for each channel. Transmission that only the other side has is taken from there by reciprocity.
    pub(crate) fn value(&self, hemispheres: Hemispheres, wi: Direction, wo: Direction, out: &mut [f64]) {
        out.fill(0.0);
        let (up_wi, up_wo) = hemispheres.to_front(wi, wo);
        for (pair, wi, wo) in [(hemispheres, up_wi, up_wo), (hemispheres.reversed(), up_wo, up_wi)] {
            // What the eye does not see says nothing of what it sees.
            let Some(main) = self.tree(pair, Band::Visible) else { continue };
            let luminance = scattering(main, wi, wo);
            out.fill(luminance);
            if self.channels == Channels::Xyz {
                self.colour(pair, wi, wo, out);
            }
            return;
        }
    }

    /// X and Z beside the Y that is there.
    fn colour(&self, pair: Hemispheres, wi: Direction, wo: Direction, out: &mut [f64]) {
        let at = |band| self.tree(pair, band).map(|tree| scattering(tree, wi, wo));
        if let (Some(x), Some(z)) = (at(Band::CieX), at(Band::CieZ)) {
            (out[0], out[2]) = (x, z);
        } else if let (Some(u), Some(v)) = (at(Band::CieU), at(Band::CieV))
            && v > 0.0
        {
            // CIE 15: x = 9u′/(6u′ − 16v′ + 12), y = 4v′/(6u′ − 16v′ + 12).
            let y = out[1];
            (out[0], out[2]) = (y * 9.0 * u / (4.0 * v), (y * (12.0 - 3.0 * u - 20.0 * v) / (4.0 * v)).max(0.0));
        }
    }
}

/// The value for two directions at the front. Where light comes from counts by where it goes to: x and y negated.
fn scattering(tree: &Tree, wi: Direction, wo: Direction) -> f64 {
    if tree.rank == 4 {
        let [a, b] = disk_to_square([-wi[0], -wi[1]]);
        let [c, d] = disk_to_square([wo[0], wo[1]]);
        return tree.value(&[a, b, c, d]);
    }
    // Isotropic: the incident direction goes along x, and its half of the axis is the lower one.
    let sine = wi[0].hypot(wi[1]);
    let (cos, sin) = if sine > 0.0 { (-wi[0] / sine, -wi[1] / sine) } else { (1.0, 0.0) };
    let [c, d] = disk_to_square([cos * wo[0] + sin * wo[1], cos * wo[1] - sin * wo[0]]);
    tree.value(&[0.5 - 0.5 * sine.min(1.0) - 1e-9, c, d])
}

/// Shirley and Chiu, A Low Distortion Map Between Disk and Square (1997), undone: a place in the unit disk to one in the unit square.
pub fn disk_to_square(d: [f64; 2]) -> [f64; 2] {
    let radius = d[0].hypot(d[1]);
    let mut phi = d[1].atan2(d[0]);
    if phi < -FRAC_PI_4 {
        phi += 8.0 * FRAC_PI_4;
    }
    let [a, b] = if phi < FRAC_PI_4 {
        [radius, phi * radius / FRAC_PI_4]
    } else if phi < 3.0 * FRAC_PI_4 {
        [-(phi - 2.0 * FRAC_PI_4) * radius / FRAC_PI_4, radius]
    } else if phi < 5.0 * FRAC_PI_4 {
        [-radius, -(phi - 4.0 * FRAC_PI_4) * radius / FRAC_PI_4]
    } else {
        [(phi - 6.0 * FRAC_PI_4) * radius / FRAC_PI_4, -radius]
    };
    [0.5 + 0.5 * a, 0.5 + 0.5 * b]
}

/// Shirley and Chiu's map: a place in the unit square to one in the unit disk, equal areas to equal areas.
pub fn square_to_disk(s: [f64; 2]) -> [f64; 2] {
    let (a, b) = (2.0 * s[0] - 1.0, 2.0 * s[1] - 1.0);
    let (radius, phi) = match (a > -b, a > b, a < b) {
        (true, true, _) => (a, FRAC_PI_4 * b / a),
        (true, false, _) => (b, FRAC_PI_4 * (2.0 - a / b)),
        (false, _, true) => (-a, FRAC_PI_4 * (4.0 + b / a)),
        (false, ..) if b != 0.0 => (-b, FRAC_PI_4 * (6.0 - a / b)),
        _ => (0.0, 0.0),
    };
    [radius * phi.cos(), radius * phi.sin()]
}
