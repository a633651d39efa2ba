//! Tensor trees on lanes (Ward, Kurt and Bonneel 2012): the reference is [`gonio_formats::bsdf::TensorTree`].

use core::f32::consts::FRAC_PI_4;
use gonio_formats::bsdf::{Band, Channels, Hemispheres, TensorTree, Tree};
use gonio_simd::{F, Lanes, Rgb, U, Vec3};

/// The largest number below one.
const BELOW_ONE: f32 = 0.999_999_94;

/// The trees of one pair of hemispheres, 1/sr, without the cosine.
#[derive(Clone, Debug)]
pub(super) struct ColourTree {
    main: LaneTree,
    colour: Colour,
    /// What the trees were measured for is light going the other way.
    reversed: bool,
    /// Each tristimulus value's weights in linear Rec.709.
    to_rgb: [[f32; 3]; 3],
}

/// What makes a colour of the luminance.
#[derive(Clone, Debug)]
enum Colour {
    Grey,
    /// Trees of X and Z.
    Tristimulus(Box<[LaneTree; 2]>),
    /// Trees of CIE 1976 u′ and v′.
    Chromaticity(Box<[LaneTree; 2]>),
}

#[derive(Clone, Debug)]
struct LaneTree {
    rank: usize,
    first: Vec<u32>,
    /// 0 for a branch, else one more than the binary logarithm of a leaf's grid.
    leaf: Vec<u32>,
    values: Vec<f32>,
}

impl ColourTree {
    /// The trees for light between two sides, from those of the opposite sense if there are no others; none if there are neither.
    pub(super) fn new(found: &TensorTree, pair: Hemispheres) -> Option<Self> {
        for (pair, reversed) in [(pair, false), (pair.reversed(), true)] {
            let Some(main) = found.tree(pair, Band::Visible) else { continue };
            let coloured = *found.channels() == Channels::Xyz;
            let both = |bands: [Band; 2]| {
                let [a, b] = bands.map(|band| found.tree(pair, band).filter(|_| coloured));
                Some(Box::new([LaneTree::new(a?), LaneTree::new(b?)]))
            };
            let tristimulus = both([Band::CieX, Band::CieZ]).map(Colour::Tristimulus);
            let colour = tristimulus.or_else(|| both([Band::CieU, Band::CieV]).map(Colour::Chromaticity)).unwrap_or(Colour::Grey);
            return Some(Self { main: LaneTree::new(main), colour, reversed, to_rgb: to_rgb() });
        }
        None
    }

    /// The BSDF of two directions at the front.
    #[inline(always)]
    pub(super) fn value<L: Lanes>(&self, l: L, wi: Vec3<L>, wo: Vec3<L>) -> Rgb<L> {
        let (wi, wo) = if self.reversed { (wo, wi) } else { (wi, wo) };
        let y = self.main.value(l, wi, wo);
        let [x, z] = match &self.colour {
            Colour::Grey => return Rgb::grey(y),
            Colour::Tristimulus(trees) => [trees[0].value(l, wi, wo), trees[1].value(l, wi, wo)],
            Colour::Chromaticity(trees) => {
                // CIE 15: x = 9u′/(6u′ − 16v′ + 12), y = 4v′/(6u′ − 16v′ + 12).
                let (u, v) = (trees[0].value(l, wi, wo), trees[1].value(l, wi, wo));
                let scale = y / (v * 4.0).max(1e-30);
                let z = (scale * (12.0 - u * 3.0 - v * 20.0)).max(0.0);
                let known = v.gt(0.0);
                [known.select(scale * u * 9.0, y), known.select(z, y)]
            }
        };
        let [from_x, from_y, from_z] = self.to_rgb;
        let [from_x, from_y, from_z] = [Rgb::splat(l, from_x), Rgb::splat(l, from_y), Rgb::splat(l, from_z)];
        from_x.mul_add(x, from_y.mul_add(y, from_z * z))
    }
}

fn to_rgb() -> [[f32; 3]; 3] {
    let weights = Channels::Xyz.rgb_weights();
    core::array::from_fn(|c| weights[c].map(|x| x as f32))
}

impl LaneTree {
    fn new(found: &Tree) -> Self {
        let leaf = found.log2.iter().map(|log2| u32::try_from(log2 + 1).unwrap_or(0)).collect();
        Self { rank: found.rank as usize, first: found.first.clone(), leaf, values: found.values.clone() }
    }

    /// The value for two directions at the front. Where light comes from counts by where it goes to: x and y negated.
    #[inline(always)]
    fn value<L: Lanes>(&self, l: L, wi: Vec3<L>, wo: Vec3<L>) -> F<L> {
        if self.rank == 4 {
            let ([a, b], [c, d]) = (disk_to_square(-wi.x, -wi.y), disk_to_square(wo.x, wo.y));
            return self.at(l, [a, b, c, d]);
        }
        // Isotropic: the incident direction goes along x, and its half of the axis is the lower one.
        let sine = super::angles::sine(wi);
        let [cos, sin] = super::angles::azimuth(Vec3::new(-wi.x, -wi.y, wi.z));
        let [c, d] = disk_to_square(cos.mul_add(wo.x, sin * wo.y), cos.mul_add(wo.y, -(sin * wo.x)));
        self.at(l, [0.5 - sine.min(1.0) * 0.5 - 1e-7, c, d, l.f(0.0)])
    }

    /// The value at a place of the unit cube.
    #[inline(always)]
    fn at<L: Lanes>(&self, l: L, place: [F<L>; 4]) -> F<L> {
        let [a, b, c, d] = place;
        let mut place = [a.clamp(0.0, BELOW_ONE), b.clamp(0.0, BELOW_ONE), c.clamp(0.0, BELOW_ONE), d.clamp(0.0, BELOW_ONE)];
        let mut node = l.u(0);
        let mut leaf = l.gather_integers(&self.leaf, node);
        while leaf.eq(0).any() {
            let branch = leaf.eq(0);
            let mut child = l.gather_integers(&self.first, node);
            for (d, x) in place.iter_mut().enumerate().take(self.rank) {
                let doubled = *x * 2.0;
                let upper = doubled.ge(1.0);
                child += l.u(1 << d).keep_if(upper);
                *x = branch.select(upper.select(doubled - 1.0, doubled), *x);
            }
            node = branch.select(child, node);
            leaf = l.gather_integers(&self.leaf, node);
        }
        // 2 to the power of the logarithm, by the exponent of a float.
        let side = F::from_bits((leaf + 126) << 23);
        let mut cell: U<L> = l.u(0);
        for x in place.iter().take(self.rank) {
            cell = cell * side.to_i32() + (*x * side).to_i32();
        }
        l.gather(&self.values, l.gather_integers(&self.first, node) + cell)
    }
}

/// Shirley and Chiu, A Low Distortion Map Between Disk and Square (1997), undone: a place in the unit disk to one in the unit square.
#[inline(always)]
fn disk_to_square<L: Lanes>(x: F<L>, y: F<L>) -> [F<L>; 2] {
    let radius = x.mul_add(x, y * y).sqrt();
    // In each quarter about an axis one coordinate is the radius, the other goes with the angle from that axis.
    let about_x = x.abs().gt(y.abs());
    let angle = about_x.select(y, x).atan2(about_x.select(x, y).abs());
    let along = angle * radius * FRAC_PI_4.recip();
    let [a, b] = [about_x.select(radius.copysign(x), along), about_x.select(along, radius.copysign(y))];
    [a * 0.5 + 0.5, b * 0.5 + 0.5]
}
