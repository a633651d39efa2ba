//! Blender's Voronoi Texture: distances to points of which each cell of a grid holds one, with their colours and places, in octaves.

mod cells;
mod edge;
mod metric;
mod nearest;
mod octaves;
mod smooth;
mod sphere;

use crate::finite::all_finite;
use gonio_simd::{F, Lanes};
use serde::{Deserialize, Serialize};

/// What is computed of the points around.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum Feature {
    /// The nearest point.
    F1,
    /// The second nearest point.
    F2,
    /// The nearest point, blended smoothly with its neighbours.
    SmoothF1,
    /// The distance to the nearest edge between two cells.
    DistanceToEdge,
    /// Half the distance from the nearest point to the point that is nearest to it: spheres of this radius touch. It has no octaves.
    NSphereRadius,
}

/// How distances are measured for [`Feature::F1`], [`Feature::F2`] and [`Feature::SmoothF1`] in more than one dimension.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum Metric {
    /// The root of the sum of squares.
    Euclidean,
    /// The sum of magnitudes.
    Manhattan,
    /// The largest magnitude.
    Chebychev,
    /// The sum of powers of magnitudes, to the inverse power.
    Minkowski,
}

/// The hash that places and colours the points.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum CellHash {
    /// Blender up to 4.5: lookup3 of the cell's coordinates as floats.
    Lookup3,
    /// Blender from 5.0 on: permuted congruential generators of the cell's coordinates as integers; in one dimension lookup3 still.
    Pcg,
}

/// Which outputs are wanted.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum Part {
    /// Red, green, blue and the distance; the edge's distance and the sphere's radius come as the distance, with black.
    ColorDistance,
    /// The point's x, y, z and w, zero where there is no such axis and for the edge and the sphere.
    Position,
}

/// The texture's settings.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub struct VoronoiTexture {
    /// 1 for w alone, 2 for x and y, 3 for x, y and z, 4 for all.
    pub dimensions: u8,
    /// What is computed.
    pub feature: Feature,
    /// How distances are measured.
    pub metric: Metric,
    /// Whether distances and colours are divided by the most that the octaves can sum to.
    pub normalize: bool,
    /// Which hash.
    pub hash: CellHash,
    /// Which outputs.
    pub part: Part,
}

/// Inputs that shape the texture, by lane.
#[derive(Clone, Copy, Debug)]
struct Shape<L: Lanes> {
    scale: F<L>,
    detail: F<L>,
    roughness: F<L>,
    lacunarity: F<L>,
    smoothness: F<L>,
    exponent: F<L>,
    randomness: F<L>,
}

impl VoronoiTexture {
    /// The inputs of [`evaluate`](Self::evaluate), in order.
    pub const INPUTS: [&str; 11] =
        ["x", "y", "z", "w", "scale", "detail", "roughness", "lacunarity", "smoothness", "exponent", "randomness"];
    /// How many outputs there are.
    pub const OUTPUTS: usize = 4;

    /// The outputs that [`Part`] names, finite for finite inputs.
    #[inline(always)]
    pub fn evaluate<L: Lanes>(&self, l: L, inputs: &[F<L>; 11]) -> [F<L>; 4] {
        let [x, y, z, w, scale, detail, roughness, lacunarity, smoothness, exponent, randomness] = *inputs;
        let shape = Shape {
            scale,
            detail: detail.clamp(0.0, 15.0),
            roughness: roughness.saturate(),
            lacunarity,
            smoothness: (smoothness * 0.5).clamp(0.0, 0.5),
            exponent,
            randomness: randomness.saturate(),
        };
        all_finite(match self.dimensions {
            1 => self.of_dimensions::<L, 1>(l, [w * scale], shape),
            2 => self.of_dimensions::<L, 2>(l, [x * scale, y * scale], shape),
            3 => self.of_dimensions::<L, 3>(l, [x * scale, y * scale, z * scale], shape),
            _ => self.of_dimensions::<L, 4>(l, [x * scale, y * scale, z * scale, w * scale], shape),
        })
    }

    /// The outputs at a scaled place; the body is one function of its own, so that callers do not each carry it.
    #[inline(always)]
    fn of_dimensions<L: Lanes, const D: usize>(&self, l: L, at: [F<L>; D], shape: Shape<L>) -> [F<L>; 4] {
        l.vectorize(
            #[inline(always)]
            || match self.feature {
                Feature::DistanceToEdge => self.edges(l, at, shape),
                Feature::NSphereRadius => self.sphere(l, at, shape),
                _ => self.points(l, at, shape),
            },
        )
    }
}
