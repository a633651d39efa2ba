//! The table of shading nodes: a row each, with its name, inputs, outputs, meaning and kernel.
//!
//! Three sections: `each` works component by component, `whole` on the components of all inputs, `hit` asks the surface point, the ray or a
//! table of the scene and has its kernel in light transport. From the rows come [`Operation`], the form that scene descriptions hold; its
//! [`signature`](Operation::signature); and [`run`], which computes it for columns.

use crate::{
    arithmetic::{fresnel, modulo, power, sin_cos},
    blackbody,
    brick::BrickTexture,
    columns::Io,
    gabor::GaborTexture,
    hair,
    magic::MagicTexture,
    mx_noise::{MxFractal, MxNoise},
    mx_worley::{MxCellNoise, MxWorley},
    noise::NoiseTexture,
    radial_tiling::RadialTiling,
    vector::{hsv_to_rgb, luminance, matrix_transform, normalize, rgb_to_hsv},
    voronoi::VoronoiTexture,
    wave::WaveTexture,
    wavelength::Wavelength,
    white_noise::WhiteNoise,
    words::{LightPathValue, Quantity, Space, TextureFilter, TextureId, WrapMode},
};
use gonio_simd::{F, Lanes, Vec3};
use serde::{Deserialize, Serialize};

/// What the components of a value beyond the outputs of its kernel are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rest {
    /// The only output fills all four.
    Splat,
    /// Zero.
    Zero,
    /// Those of the first input.
    Keep,
}

/// How an operation is wired.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Signature {
    /// Its name in scene descriptions.
    pub name: &'static str,
    /// Names of the inputs, and how many components of each count.
    pub inputs: &'static [(&'static str, usize)],
    /// Components that the kernel gives.
    pub outputs: usize,
    /// What the others are.
    pub rest: Rest,
    /// How it is computed.
    pub kind: KernelKind,
}

/// How an operation is computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum KernelKind {
    /// Component by component.
    Each,
    /// From the components of all inputs.
    Whole,
    /// From the surface point, the ray or a table of the scene too.
    Hit,
}

macro_rules! operations {
    (
        each { $( $(#[$each_meta:meta])* $each:ident($each_l:ident, $($each_input:ident),+) = $each_body:expr; )+ }
        whole { $( $(#[$whole_meta:meta])* $whole:ident
            $({ $($(#[$whole_field_meta:meta])* $whole_field:ident: $whole_type:ty),+ $(,)? })? $(< $inner:ident: $inner_type:ty >)?
            ($whole_l:ident, $($whole_input:ident: $whole_width:literal),+) -> $whole_count:literal, $whole_rest:ident = $whole_body:expr; )+ }
        hit { $( $(#[$hit_meta:meta])* $hit:ident
            $({ $($(#[$hit_field_meta:meta])* $hit_field:ident: $hit_type:ty),+ $(,)? })? $(< $hit_inner:ident: $hit_inner_type:ty >)?
            ($($hit_input:ident: $hit_width:literal),*) -> $hit_count:literal, $hit_rest:ident; )+ }
    ) => {
        /// What a node computes; all values have four components.
        #[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
        pub enum Operation {
            $( $(#[$each_meta])* $each, )+
            $( $(#[$whole_meta])* $whole $({ $($(#[$whole_field_meta])* $whole_field: $whole_type),+ })? $(($inner_type))?, )+
            $( $(#[$hit_meta])* $hit $({ $($(#[$hit_field_meta])* $hit_field: $hit_type),+ })? $(($hit_inner_type))?, )+
        }

        impl Operation {
            /// Its wiring.
            pub fn signature(&self) -> Signature {
                match self {
                    $( Self::$each => Signature {
                        name: stringify!($each), inputs: &[$((stringify!($each_input), 4)),+], outputs: 1, rest: Rest::Splat, kind: KernelKind::Each,
                    }, )+
                    $( Self::$whole { .. } => Signature {
                        name: stringify!($whole), inputs: &[$((stringify!($whole_input), $whole_width)),+], outputs: $whole_count,
                        rest: Rest::$whole_rest, kind: KernelKind::Whole,
                    }, )+
                    $( Self::$hit { .. } => Signature {
                        name: stringify!($hit), inputs: &[$((stringify!($hit_input), $hit_width)),*], outputs: $hit_count,
                        rest: Rest::$hit_rest, kind: KernelKind::Hit,
                    }, )+
                }
            }
        }

        /// Computes an operation of the sections `each` and `whole` for all entries of the columns.
        #[inline(always)]
        pub(crate) fn run<L: Lanes>(l: L, operation: &Operation, io: &mut Io<'_>) {
            match operation {
                $( Operation::$each => kernels::$each(l, io), )+
                $( Operation::$whole { .. } => kernels::$whole(l, operation, io), )+
                $( Operation::$hit { .. } => {} )+
            }
        }

        /// One function an operation, compiled apart.
        #[expect(non_snake_case, reason = "kernels have the names of their operations")]
        mod kernels {
            use super::*;
            $(
                #[inline(never)]
                pub(super) fn $each<L: Lanes>($each_l: L, io: &mut Io<'_>) {
                    $each_l.vectorize(
                        #[inline(always)]
                        || {
                            for at in (0..io.count).step_by(L::COUNT) {
                                let [$($each_input),+] = io.load($each_l, at);
                                let value: F<L> = $each_body;
                                io.store(at, [value]);
                            }
                        },
                    );
                }
            )+
            $(
                #[inline(never)]
                pub(super) fn $whole<L: Lanes>($whole_l: L, operation: &Operation, io: &mut Io<'_>) {
                    $whole_l.vectorize(
                        #[inline(always)]
                        || {
                            let Operation::$whole $({ $($whole_field),+ })? $(($inner))? = operation else { return };
                            for at in (0..io.count).step_by(L::COUNT) {
                                $(
                                    let $whole_input: [F<L>; $whole_width] = io.load_next($whole_l, at);
                                )+
                                io.rewind();
                                let value: [F<L>; $whole_count] = $whole_body;
                                io.store(at, value);
                            }
                        },
                    );
                }
            )+
        }
    };
}

operations! {
    each {
        /// `a + b`.
        Add(l, a, b) = a + b;
        /// `a - b`.
        Subtract(l, a, b) = a - b;
        /// `a · b`.
        Multiply(l, a, b) = a * b;
        /// `a / b`, zero where the divisor is zero.
        Divide(l, a, b) = b.eq(0.0).select(l.f(0.0), a / b);
        /// `a` where `share` is 0, `b` where it is 1 (MaterialX's bg, fg, mix).
        Mix(l, a, b, share) = a.lerp(b, share);
        /// `a` to the power `b`; zero for negative bases unless `b` is whole; zero to the power zero is one, to any other zero.
        Power(l, a, b) = power(a, b);
        /// `b - a`, MaterialX's invert with its amount.
        Invert(l, a, b) = b - a;
        /// `a` held between `low` and `high`.
        Clamp(l, a, low, high) = a.max(low).min(high);
        /// The lesser.
        Minimum(l, a, b) = a.min(b);
        /// The greater.
        Maximum(l, a, b) = a.max(b);
        /// The magnitude.
        Absolute(l, a) = a.abs();
        /// −1, 0 or 1, as `a` is negative, zero or positive.
        Sign(l, a) = a.gt(0.0).select(l.f(1.0), l.f(-1.0).keep_if(a.lt(0.0)));
        /// The largest integer not above `a`.
        Floor(l, a) = a.floor();
        /// The remainder of `a / b` with the sign of `a` (C's `fmod`); zero where the divisor is zero.
        Modulo(l, a, b) = modulo(a, b);
        /// The square root, zero below zero.
        SquareRoot(l, a) = a.max(0.0).sqrt();
        /// e to the power `a`, which is held to 88.
        Exponential(l, a) = a.min(LARGEST_EXPONENT).exp();
        /// The natural logarithm, zero where `a` is not positive. Denormals count as the smallest normal number, so that results are finite.
        Logarithm(l, a) = a.max(f32::MIN_POSITIVE).ln().keep_if(a.gt(0.0));
        /// The sine, radians.
        Sine(l, a) = sin_cos(a)[0];
        /// The cosine, radians.
        Cosine(l, a) = sin_cos(a)[1];
        /// The angle in radians whose sine is `a`, held to [-1, 1].
        ArcSine(l, a) = a.clamp(-1.0, 1.0).asin();
        /// The angle in radians whose cosine is `a`, held to [-1, 1].
        ArcCosine(l, a) = a.clamp(-1.0, 1.0).acos();
        /// The angle in radians of the point whose ordinate is `y` and whose abscissa is `x`.
        ArcTangent2(l, y, x) = y.atan2(x);
        /// 1 where `a` is less than `b`, else 0.
        Less(l, a, b) = l.f(1.0).keep_if(a.lt(b));
        /// The unpolarised reflectance of a smooth dielectric at the cosine `cosine`, either sign; `eta` is the index of refraction on the far
        /// side over that on the near side.
        Fresnel(l, cosine, eta) = fresnel(l, cosine, eta);
    }
    whole {
        /// The luminance in all components.
        Luminance(l, rgb: 3) -> 1, Splat = [luminance(rgb)];
        /// The inner product of the first three components in all components.
        Dot(l, a: 3, b: 3) -> 1, Splat = [Vec3::from(a).dot(Vec3::from(b))];
        /// The cross product.
        Cross(l, a: 3, b: 3) -> 3, Zero = Vec3::from(a).cross(Vec3::from(b)).into();
        /// The unit vector; zero stays zero.
        Normalize(l, a: 3) -> 3, Zero = normalize(l, Vec3::from(a)).into();
        /// Hue in turns, saturation and value of a colour; the fourth component stays.
        RgbToHsv(l, rgb: 3) -> 3, Keep = rgb_to_hsv(l, rgb);
        /// The colour of a hue in turns, saturation and value; the fourth component stays.
        HsvToRgb(l, hsv: 3) -> 3, Keep = hsv_to_rgb(l, hsv);
        /// A point to which the rows are applied; the fourth component stays.
        Transform3d {
            /// Three rows of a 3×4 matrix.
            rows: [[f32; 4]; 3],
        }(l, point: 3) -> 3, Keep = matrix_transform(point, rows);
        /// Blender's Noise Texture: the value, then red, green and blue.
        NoiseTexture<texture: NoiseTexture>(
            l, vector: 3, w: 1, scale: 1, detail: 1, roughness: 1, lacunarity: 1, offset: 1, gain: 1, distortion: 1
        ) -> 4, Zero = {
            let ([x, y, z], [w], [scale], [detail], [roughness], [lacunarity]) = (vector, w, scale, detail, roughness, lacunarity);
            texture.evaluate(l, &[x, y, z, w, scale, detail, roughness, lacunarity, offset[0], gain[0], distortion[0]])
        };
        /// Blender's White Noise Texture: the value, then red, green and blue.
        WhiteNoise<texture: WhiteNoise>(l, vector: 3, w: 1) -> 4, Zero = {
            let [x, y, z] = vector;
            texture.evaluate(l, &[x, y, z, w[0]])
        };
        /// Blender's Wave Texture.
        WaveTexture<texture: WaveTexture>(
            l, vector: 3, scale: 1, distortion: 1, detail: 1, detail_scale: 1, detail_roughness: 1, phase: 1
        ) -> 1, Splat = {
            let ([x, y, z], [scale], [distortion], [detail]) = (vector, scale, distortion, detail);
            texture.evaluate(l, &[x, y, z, scale, distortion, detail, detail_scale[0], detail_roughness[0], phase[0]])
        };
        /// Blender's Magic Texture: the mean, then red, green and blue.
        MagicTexture<texture: MagicTexture>(l, vector: 3, scale: 1, distortion: 1) -> 4, Zero = {
            let [x, y, z] = vector;
            texture.evaluate(l, &[x, y, z, scale[0], distortion[0]])
        };
        /// Blender's Brick Texture: how far bricks go from the first colour to the second, and the share of mortar.
        BrickTexture<texture: BrickTexture>(
            l, vector: 2, scale: 1, mortar_size: 1, mortar_smooth: 1, bias: 1, brick_width: 1, row_height: 1
        ) -> 2, Zero = {
            let ([x, y], [scale], [mortar_size]) = (vector, scale, mortar_size);
            texture.evaluate(l, &[x, y, scale, mortar_size, mortar_smooth[0], bias[0], brick_width[0], row_height[0]])
        };
        /// Blender's Gabor Texture: value, phase and intensity.
        GaborTexture<texture: GaborTexture>(
            l, vector: 3, scale: 1, frequency: 1, anisotropy: 1, angle: 1, direction: 3
        ) -> 3, Zero = {
            let ([x, y, z], [u, v, w], [scale], [frequency]) = (vector, direction, scale, frequency);
            texture.evaluate(l, &[x, y, z, scale, frequency, anisotropy[0], angle[0], u, v, w])
        };
        /// Blender's Radial Tiling: the outputs of its [`TilingPart`](crate::TilingPart).
        RadialTiling<tiling: RadialTiling>(l, vector: 2, sides: 1, roundness: 1) -> 3, Zero =
            tiling.evaluate(l, &[vector[0], vector[1], sides[0], roundness[0]]);
        /// The linear Rec.709 colour of light of a wavelength in nanometres, as Blender's Wavelength node has it.
        Wavelength<light: Wavelength>(l, wavelength: 1) -> 3, Zero = light.evaluate(l, &wavelength);
        /// The linear Rec.709 colour of a black body of a temperature in kelvin, as Blender's Blackbody node has it.
        Blackbody(l, temperature: 1) -> 3, Zero = blackbody::Blackbody.evaluate(l, &temperature);
        /// Variance along a fibre and width about it of roughnesses 0 to 1, as Chiang's hair model maps them.
        HairRoughness(l, longitudinal: 1, azimuthal: 1) -> 2, Zero = hair::roughness(longitudinal[0], azimuthal[0]);
        /// The absorption coefficient with which much hair has a colour, for the roughness about it.
        HairAbsorption(l, color: 3, azimuthal: 1) -> 3, Zero = hair::absorption(color, azimuthal[0]);
        /// MaterialX's gradient noise, about in [-1, 1].
        MxNoise<noise: MxNoise>(l, texcoord: 3) -> 4, Zero = noise.evaluate(l, &texcoord);
        /// MaterialX's fractal of that noise.
        MxFractal<noise: MxFractal>(l, texcoord: 3, octaves: 1, lacunarity: 1, diminish: 1) -> 4, Zero = {
            let [x, y, z] = texcoord;
            noise.evaluate(l, &[x, y, z, octaves[0], lacunarity[0], diminish[0]])
        };
        /// MaterialX's noise of whole cells, in [0, 1].
        MxCellNoise<noise: MxCellNoise>(l, texcoord: 3) -> 3, Zero = noise.evaluate(l, &texcoord);
        /// MaterialX's Worley noise: distances to points, or the cell.
        MxWorley<noise: MxWorley>(l, texcoord: 3, jitter: 1) -> 3, Zero = {
            let [x, y, z] = texcoord;
            noise.evaluate(l, &[x, y, z, jitter[0]])
        };
        /// Blender's Voronoi Texture; the outputs are those of its [`Part`](crate::voronoi::Part).
        VoronoiTexture<texture: VoronoiTexture>(
            l, vector: 3, w: 1, scale: 1, detail: 1, roughness: 1, lacunarity: 1, smoothness: 1, exponent: 1, randomness: 1
        ) -> 4, Zero = {
            let ([x, y, z], [w], [scale], [detail], [roughness], [lacunarity]) = (vector, w, scale, detail, roughness, lacunarity);
            texture.evaluate(l, &[x, y, z, w, scale, detail, roughness, lacunarity, smoothness[0], exponent[0], randomness[0]])
        };
    }
    hit {
        /// The first components of four inputs.
        Combine(x: 1, y: 1, z: 1, w: 1) -> 4, Zero;
        /// Coordinates scaled, then rotated by degrees counter-clockwise, then moved (UsdTransform2d's order).
        Transform2d {
            /// Factors.
            scale: [f32; 2],
            /// Degrees, counter-clockwise.
            rotation_deg: f32,
            /// Offset.
            translation: [f32; 2],
        }(uv: 2) -> 2, Keep;
        /// Each component looked up in its own column of the table, whose rows are evenly spread over the range.
        Curve {
            /// Rows of four components, at most 65,536.
            table: Vec<[f32; 4]>,
            /// What the first and the last row stand for.
            range: [f32; 2],
            /// Whether values between rows are interpolated; else the row below counts.
            linear: bool,
            /// Whether the first and last two rows are prolonged beyond the range; else the outer rows are held.
            extrapolate: bool,
        }(argument: 4) -> 4, Zero;
        /// An image lookup; gives `fallback` where the texture, or the tile of a set, could not be had. Output = texel · scale + bias.
        Image {
            /// The image.
            texture: TextureId,
            /// What lies beyond it in u and v.
            wrap: [WrapMode; 2],
            /// How texels are filtered.
            filter: TextureFilter,
            /// Multiplies the texel.
            scale: [f32; 4],
            /// Added afterwards.
            bias: [f32; 4],
            /// Taken without a texture.
            fallback: [f32; 4],
        }(uv: 2) -> 4, Zero;
        /// The named primvar at the hit, or `fallback` where the mesh has none.
        Primvar {
            /// The name without prefix.
            name: String,
            /// Taken where there is none.
            fallback: [f32; 4],
        }() -> 4, Zero;
        /// A value carried from one space to another; zero where the object is flat and its inverse would be needed.
        Transform {
            /// The space it is given in.
            from: Space,
            /// The space of the result.
            to: Space,
            /// What it stands for.
            quantity: Quantity,
        }(value: 3) -> 3, Zero;
        /// A shading normal in world space, on the side the surface is seen from, from a tangent-space normal in [-1, 1], scaled in x and y by
        /// `scale`.
        NormalMap {
            /// Strength of the bend.
            scale: f32,
            /// The primvar whose coordinates it lies along, mirrored parts turning the bitangent round, or those of the surface's first image.
            #[serde(default)]
            uv: Option<String>,
        }(normal: 3) -> 3, Zero;
        /// The hit's position in the world, metres.
        Position() -> 3, Zero;
        /// The unit shading normal on the side the surface is seen from, world space, before the material bends it.
        Normal() -> 3, Zero;
        /// The triangle's unit normal on the side it is seen from, world space.
        GeometricNormal() -> 3, Zero;
        /// The unit direction to where the ray came from, world space.
        Incoming() -> 3, Zero;
        /// 1 where the front is seen, 0 where the back is.
        FrontFacing() -> 1, Splat;
        /// What is known of the ray; for shadow rays its depths are zero.
        LightPath<value: LightPathValue>() -> 1, Splat;
        /// The world-space vector in the surface to the next pixel along one of two directions that span it.
        PositionStep {
            /// 0 or 1: which of the two.
            axis: u8,
        }() -> 3, Zero;
        /// How much the named primvar changes over that step.
        PrimvarStep {
            /// The name without prefix.
            name: String,
            /// 0 or 1: which of the two directions.
            axis: u8,
        }() -> 4, Zero;
        /// The unit tangent along the first of the coordinates of the named primvar, world space; zero where the mesh has none.
        UvTangent {
            /// The primvar.
            uv: String,
        }() -> 3, Zero;
        /// The share of rays over the hemisphere about a normal, denser about it, that meet nothing opaque within a distance in metres; 1 for no distance.
        Occlusion {
            /// Rays a hit.
            samples: u32,
            /// Whether they go into the hemisphere under the surface.
            inside: bool,
            /// Whether only the object that was hit counts.
            only_local: bool,
        }(normal: 3, distance: 1) -> 1, Splat;
        /// The mean of the shading normals around the hit on its object, as if edges were rounded by a radius in metres; unit, world space, on the side
        /// the surface is seen from. After diffuse scattering the hit's own.
        RoundedNormal {
            /// Rays a hit.
            samples: u32,
        }(radius: 1) -> 3, Zero;
    }
}

/// Largest argument of the exponential; beyond it the result would not be finite.
const LARGEST_EXPONENT: f32 = 88.0;
