//! Rows of the light table: the words of one light, read lane by lane.

use super::light_kind::LightKind;
use gonio_simd::{F, Lanes, M, Rgb, U, Vec3};

/// Values in a row: six cache lines, some of them spare.
pub(crate) const ROW: usize = 96;

/// Where a row keeps what.
pub(crate) mod field {
    /// Centre of the shape (corner of a triangle), 3.
    pub(crate) const ORIGIN: usize = 0;
    /// Columns of the sampling frame, in which the emitter has its simplest form, 9.
    pub(crate) const FRAME: usize = 3;
    /// Rows of the frame's inverse, 9.
    pub(crate) const INVERSE: usize = 12;
    /// Magnitude of the inverse's determinant.
    pub(crate) const DENSITY: usize = 21;
    /// Half extents of a rectangle in its frame, 2; half length of a cylinder, 1; radius of a facing disk and its reciprocal square over 2π, 2.
    pub(crate) const HALF: usize = 22;
    /// Emitted radiance, 3.
    pub(crate) const RADIANCE: usize = 24;
    /// Unit shaping axis; a distant light's points the way its light goes, 3.
    pub(crate) const AXIS: usize = 27;
    /// Cone's half angle.
    pub(crate) const CUTOFF: usize = 30;
    /// Angle where the cone's falloff begins.
    pub(crate) const SMOOTH_START: usize = 31;
    /// Exponent.
    pub(crate) const FOCUS: usize = 32;
    /// Tint, 3.
    pub(crate) const TINT: usize = 33;
    /// First value of the texture in the pool, as bits.
    pub(crate) const TEXTURE: usize = 36;
    /// Width of the texture as bits, 0 without one.
    pub(crate) const TEXTURE_WIDTH: usize = 37;
    /// Height of the texture as bits.
    pub(crate) const TEXTURE_HEIGHT: usize = 38;
    /// Kind and switches as bits.
    pub(crate) const FLAGS: usize = 39;
    /// Centre of a sphere around the light, 3.
    pub(crate) const BOUND_CENTRE: usize = 40;
    /// Radius of that sphere.
    pub(crate) const BOUND_RADIUS: usize = 43;
    /// Bound of intensity in cd, or of illuminance in lx for infinite lights.
    pub(crate) const STRENGTH: usize = 44;
    /// Cosine of the cone's half angle, less a little.
    pub(crate) const CONE_COSINE: usize = 45;
    /// Normal of a flat light's emitting side, 3.
    pub(crate) const NORMAL: usize = 46;
    /// 1 − cos of a distant light's half angle.
    pub(crate) const ONE_MINUS_COSINE: usize = 49;
    /// Sine of a distant light's half angle, 1 beyond a right angle.
    pub(crate) const SINE: usize = 50;
    /// Axis x over the spot's stretch, 3.
    pub(crate) const SPOT_X: usize = 53;
    /// Axis y over the spot's stretch, 3.
    pub(crate) const SPOT_Y: usize = 56;
    /// Cosine of the spot's half angle.
    pub(crate) const SPOT_COSINE: usize = 59;
    /// Reciprocal of the cosine's range over which the spot's edge is smooth.
    pub(crate) const SPOT_STEEPNESS: usize = 60;
    /// Tangent of the spread's half angle, 1 without one.
    pub(crate) const SPREAD_TANGENT: usize = 61;
    /// Reciprocal of that tangent less its angle, 1 without one: times the tangent it is what the spread gains on the normal.
    pub(crate) const SPREAD_GAIN: usize = 62;
    /// How far from the foot of the perpendicular a flat light's spread still reaches, over the height, in the sampling frame.
    pub(crate) const REACH: usize = 63;
    /// Unit axis x across the shaping axis, 3: the luminaire's C0.
    pub(crate) const LEVEL_X: usize = 64;
    /// Unit axis y across both, 3.
    pub(crate) const LEVEL_Y: usize = 67;
    /// Number of the goniogram counted from 1 as bits, 0 without one.
    pub(crate) const GONIOGRAM: usize = 70;
    /// Cosine of the half angle of a flat light's spread, less a little; 0 without one.
    pub(crate) const SPREAD_COSINE: usize = 71;
    /// Areas of an opening's sides, as vectors along their normals, 9.
    pub(crate) const OPENING_SIDES: usize = 72;
    /// What an opening's sides show to the one side more than to the other, 3.
    pub(crate) const OPENING_TILT: usize = 81;
}

/// Switches in [`field::FLAGS`]; the kind's number is in the low byte.
pub(crate) mod flag {
    pub(crate) const KIND: u32 = 0xff;
    pub(crate) const VISIBLE: u32 = 1 << 8;
    pub(crate) const CASTS_SHADOW: u32 = 1 << 9;
    pub(crate) const TWO_SIDED: u32 = 1 << 10;
    pub(crate) const SHAPED: u32 = 1 << 11;
    pub(crate) const DELTA: u32 = 1 << 12;
    pub(crate) const INFINITE: u32 = 1 << 13;
    pub(crate) const FLAT: u32 = 1 << 14;
    /// Sends light at all.
    pub(crate) const LIT: u32 = 1 << 15;
    pub(crate) const SPOT: u32 = 1 << 16;
    pub(crate) const SPREAD: u32 = 1 << 17;
    /// The radiance is an intensity that goes through an opening.
    pub(crate) const OPENING: u32 = 1 << 18;
    /// The opening's second and third sides are one round side.
    pub(crate) const ROUND: u32 = 1 << 19;
    /// And so is the first with them.
    pub(crate) const ALL_ROUND: u32 = 1 << 20;
    /// What it sends differs by direction or place.
    pub(crate) const VARIED: u32 = 1 << 21;
    /// Light sampling alone finds it; of scattered rays those that mirrors and smooth glass sent.
    pub(crate) const ALONE: u32 = 1 << 22;
    /// A shading program knows what each point emits.
    pub(crate) const SHADED: u32 = 1 << 23;
}

/// Rows read through a light index in each lane; lanes that all have one light read its row without gathers.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Reader<'a, L: Lanes> {
    l: L,
    rows: &'a [f32],
    base: U<L>,
    common: Option<&'a [f32; ROW]>,
}

impl<'a, L: Lanes> Reader<'a, L> {
    #[inline(always)]
    pub(crate) fn new(l: L, rows: &'a [f32], light: U<L>) -> Self {
        let first = light.to_array()[0];
        let common = rows.as_chunks::<ROW>().0.get(first as usize).filter(|_| light.eq(first).all());
        Self { l, rows, base: light * ROW as u32, common }
    }
    /// The reader of a row that all lanes read, if they do.
    #[inline(always)]
    pub(crate) fn common(&self) -> Option<Self> {
        let row = self.common?;
        Some(Self { base: self.l.u(0), common: Some(row), ..*self })
    }
    #[inline(always)]
    fn common_flags(&self) -> Option<u32> {
        self.common.map(|row| row[field::FLAGS].to_bits())
    }
    /// The kind of light in all lanes, where they read the same row.
    #[inline(always)]
    pub(crate) fn common_kind(&self) -> Option<u32> {
        self.common_flags().map(|flags| flags & flag::KIND)
    }
    #[inline(always)]
    pub(crate) fn value(&self, field: usize) -> F<L> {
        match self.common {
            Some(row) => self.l.f(row[field]),
            None => self.l.gather(self.rows, self.base + field as u32),
        }
    }
    /// Three values; no row ends with them.
    #[inline(always)]
    fn triple(&self, field: usize) -> [F<L>; 3] {
        match self.common {
            Some(row) => [self.l.f(row[field]), self.l.f(row[field + 1]), self.l.f(row[field + 2])],
            None => {
                let [x, y, z, _] = self.l.gather_quads(self.rows, self.base + field as u32);
                [x, y, z]
            }
        }
    }
    #[inline(always)]
    pub(crate) fn vector(&self, field: usize) -> Vec3<L> {
        let [x, y, z] = self.triple(field);
        Vec3::new(x, y, z)
    }
    /// Three values as a colour: radiance, or a factor on it.
    #[inline(always)]
    pub(crate) fn colour(&self, field: usize) -> Rgb<L> {
        let [r, g, b] = self.triple(field);
        Rgb::new(r, g, b)
    }
    #[inline(always)]
    pub(crate) fn integer(&self, field: usize) -> U<L> {
        self.value(field).to_bits()
    }
    #[inline(always)]
    pub(crate) fn flag(&self, bit: u32) -> M<L> {
        match self.common_flags() {
            Some(flags) => self.l.m(flags & bit != 0),
            None => (self.integer(field::FLAGS) & bit).ne(0),
        }
    }
    #[inline(always)]
    pub(crate) fn is_kind(&self, kind: LightKind) -> M<L> {
        match self.common_kind() {
            Some(common) => self.l.m(common == kind as u32),
            None => (self.integer(field::FLAGS) & flag::KIND).eq(kind as u32),
        }
    }
    /// Columns of the sampling frame.
    #[inline(always)]
    pub(crate) fn frame(&self) -> [Vec3<L>; 3] {
        [self.vector(field::FRAME), self.vector(field::FRAME + 3), self.vector(field::FRAME + 6)]
    }
    /// A world vector in the sampling frame's coordinates.
    #[inline(always)]
    pub(crate) fn in_frame(&self, v: Vec3<L>) -> Vec3<L> {
        let (x, y, z) = (self.vector(field::INVERSE), self.vector(field::INVERSE + 3), self.vector(field::INVERSE + 6));
        Vec3::new(x.dot(v), y.dot(v), z.dot(v))
    }
    /// Solid angle in the sampling frame per solid angle in the world, towards unit `wi`: |det N| / |N wi|³ for the linear map N.
    #[inline(always)]
    pub(crate) fn solid_angle_ratio(&self, wi: Vec3<L>) -> F<L> {
        let squared = self.in_frame(wi).length_squared();
        self.value(field::DENSITY) / (squared * squared.sqrt())
    }
}
