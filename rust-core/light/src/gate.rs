//! Filters before lights: cards with an opening and slides, met by the ray from the very point of a light, so that large lights throw soft edges.

use super::record::LightTexture;
use super::table::LightTable;
use super::texture::{Placed, TexturePool};
use gonio_simd::{F, Lanes, M, Rgb, U, Vec3};
use std::sync::Arc;

/// What the plane of a filter lets through, in the filter's own units.
#[derive(Clone, Debug)]
pub enum Slide {
    /// An opening in an endless black card.
    Opening {
        /// Left and bottom.
        low: [f32; 2],
        /// Right and top.
        high: [f32; 2],
        /// Of its corners.
        radius: f32,
        /// Width of the border outside in which light fades linearly.
        edge: f32,
    },
    /// A picture about the middle, x to its right and y up.
    Picture {
        /// Linear, row by row from the top.
        image: Arc<LightTexture>,
        /// Width and height of its frame.
        size: [f32; 2],
        /// What passes where there is no picture; none: it goes on beyond its frame.
        fill: Option<[f32; 3]>,
        /// Beyond its frame it stands again and again; else its border goes on.
        repeats: bool,
        /// Factor and summand that make texture coordinates, left to right and top to bottom, of places in the frame from 0 to 1.
        to_texture: [[f32; 2]; 2],
    },
}

/// A filter.
#[derive(Clone, Debug)]
pub struct Filter {
    /// Rows of the map from the world of the light table, metres, to the filter's space, whose plane z = 0 it is.
    pub from_world: [[f32; 4]; 3],
    /// What it lets through.
    pub slide: Slide,
    /// Of light that does not come to the plane.
    pub missed: [f32; 3],
    /// Whether what passes is what did not.
    pub inverted: bool,
    /// On what passes.
    pub factor: [f32; 3],
    /// 0 is no filter, 1 all of it.
    pub density: f32,
}

/// Filters of a table's lights.
#[derive(Clone, Debug, Default)]
pub(crate) struct Gates {
    /// By light, the number of its gate counted from 1, 0 without one; empty where no light has any.
    numbers: Vec<f32>,
    gates: Vec<Vec<(Filter, Option<Placed>)>>,
    pictures: TexturePool,
}

impl LightTable {
    /// The same lights behind filters: `numbers` gives each light's place in `gates` counted from 1, or 0.
    pub fn with_filters(mut self, gates: &[Vec<Filter>], numbers: &[u32]) -> Self {
        let mut pictures = TexturePool::default();
        let mut placed = |filter: &Filter| match &filter.slide {
            Slide::Opening { .. } => None,
            Slide::Picture { image, .. } => pictures.insert(image),
        };
        let mut numbered = Vec::with_capacity(gates.len());
        for gate in gates {
            numbered.push(gate.iter().map(|filter| (filter.clone(), placed(filter))).collect());
        }
        let number = |light: usize| f32::from_bits(numbers.get(light).copied().unwrap_or_default());
        self.gates = Gates { numbers: (0..self.count).map(number).collect(), gates: numbered, pictures };
        self
    }

    /// What is left behind the filters of lights of what their points `on` send towards unit `direction`, over a way in metres.
    #[inline(always)]
    pub(crate) fn filtered<L: Lanes>(&self, l: L, light: U<L>, on: Vec3<L>, direction: Vec3<L>, way: F<L>, sent: Rgb<L>) -> Rgb<L> {
        if self.gates.numbers.is_empty() {
            return sent;
        }
        let number = l.gather(&self.gates.numbers, light).to_bits();
        let mut left = number.ne(0);
        let mut passed = Rgb::grey(l.f(1.0));
        // Each gate that some lane has, for all lanes that have it.
        while left.any() {
            let one = number.to_array()[left.bits().trailing_zeros() as usize];
            let same = left & number.eq(one);
            if let Some(gate) = self.gates.gates.get(one as usize - 1) {
                for (filter, placed) in gate {
                    let through = filter.passed(l, &self.gates.pictures, *placed, on, direction, way);
                    let both = passed * through;
                    passed = same.select(both, passed);
                }
            }
            left = left.and_not(same);
        }
        sent * passed
    }
}

impl Filter {
    #[inline(always)]
    fn passed<L: Lanes>(&self, l: L, pictures: &TexturePool, placed: Option<Placed>, on: Vec3<L>, direction: Vec3<L>, way: F<L>) -> Rgb<L> {
        let [x, y, z] = self.from_world;
        let (height, along) = (row(l, z, on) + z[3], row(l, z, direction));
        let distance = -height / along;
        let comes = distance.gt(0.0) & distance.lt(way) & distance.is_finite();
        let distance = distance.keep_if(comes);
        let place =
            [row(l, x, direction).mul_add(distance, row(l, x, on) + x[3]), row(l, y, direction).mul_add(distance, row(l, y, on) + y[3])];
        let shown = match &self.slide {
            Slide::Opening { low, high, radius, edge } => Rgb::grey(opening(l, place, [*low, *high], *radius, *edge)),
            Slide::Picture { size, fill, repeats, to_texture, .. } => {
                picture(l, pictures, placed, place, *size, *fill, *repeats, *to_texture)
            }
        };
        let mut passed = comes.select(shown, Rgb::splat(l, self.missed));
        if self.inverted {
            passed = Rgb::new(1.0 - passed.r, 1.0 - passed.g, 1.0 - passed.b);
        }
        let (kept, [r, g, b]) = (1.0 - self.density, self.factor);
        let scaled = Rgb::new(passed.r * (r * self.density), passed.g * (g * self.density), passed.b * (b * self.density));
        Rgb::new(scaled.r + kept, scaled.g + kept, scaled.b + kept).max(0.0)
    }
}

/// A row's linear part of a vector.
#[inline(always)]
fn row<L: Lanes>(l: L, row: [f32; 4], v: Vec3<L>) -> F<L> {
    Vec3::splat(l, [row[0], row[1], row[2]]).dot(v)
}

/// 1 in an opening with round corners, falling to 0 over its edge.
#[inline(always)]
fn opening<L: Lanes>(l: L, place: [F<L>; 2], [low, high]: [[f32; 2]; 2], radius: f32, edge: f32) -> F<L> {
    let half = [0.5 * (high[0] - low[0]), 0.5 * (high[1] - low[1])];
    if half[0] <= 0.0 || half[1] <= 0.0 {
        return l.f(0.0);
    }
    let radius = radius.clamp(0.0, half[0].min(half[1]));
    let x = (place[0] - 0.5 * (low[0] + high[0])).abs() - (half[0] - radius);
    let y = (place[1] - 0.5 * (low[1] + high[1])).abs() - (half[1] - radius);
    let corner = (x.max(0.0) * x.max(0.0) + y.max(0.0) * y.max(0.0)).sqrt();
    let outside = corner + x.max(y).min(0.0) - radius;
    if edge > 0.0 { (1.0 - outside * (1.0 / edge)).saturate() } else { l.f(1.0).keep_if(outside.le(0.0)) }
}

/// A picture in its frame.
#[inline(always)]
#[expect(clippy::too_many_arguments, reason = "a picture's fields")]
fn picture<L: Lanes>(
    l: L,
    pictures: &TexturePool,
    placed: Option<Placed>,
    place: [F<L>; 2],
    size: [f32; 2],
    fill: Option<[f32; 3]>,
    repeats: bool,
    to_texture: [[f32; 2]; 2],
) -> Rgb<L> {
    let Some(Placed { first, width, height }) = placed else { return Rgb::splat(l, fill.unwrap_or([1.0; 3])) };
    let within = [place[0] * (1.0 / size[0]) + 0.5, 0.5 - place[1] * (1.0 / size[1])];
    let mut uv = [within[0] * to_texture[0][0] + to_texture[0][1], within[1] * to_texture[1][0] + to_texture[1][1]];
    let inside = unit(within[0]) & unit(within[1]) & unit(uv[0]) & unit(uv[1]);
    if repeats {
        uv = [uv[0] - uv[0].floor(), uv[1] - uv[1].floor()];
    }
    let shown = pictures.lookup(l, l.u(first), [l.u(width), l.u(height)], uv, repeats);
    match fill {
        Some(fill) => inside.select(shown, Rgb::splat(l, fill)),
        None => shown,
    }
}

#[inline(always)]
fn unit<L: Lanes>(x: F<L>) -> M<L> {
    x.ge(0.0) & x.le(1.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{LightKind, LightRecord, LightSampleContext};
    use gonio_simd::One;

    const BARN: Slide = Slide::Opening { low: [-0.5; 2], high: [0.5; 2], radius: 0.0, edge: 0.0 };

    /// A filter that stands a metre below the origin.
    fn below(slide: Slide) -> Filter {
        let from_world = [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 1.0]];
        Filter { from_world, slide, missed: [0.0; 3], inverted: false, factor: [1.0; 3], density: 1.0 }
    }

    /// Illuminance that a rectangle of 0.4 m at the origin throws on a floor two metres below, relative to the same without a filter, at a
    /// place along x.
    fn share(filter: &Filter, x: f32) -> f64 {
        let axes = [[0.2, 0.0, 0.0], [0.0, 0.2, 0.0], [0.0, 0.0, 1.0], [0.0; 3]];
        let records = [LightRecord { to_world: axes, ..LightRecord::new(LightKind::Rectangle) }];
        let plain = LightTable::build(&records, &[] as &[LightTexture], &[]);
        let behind = plain.clone().with_filters(&[vec![filter.clone()]], &[1]);
        let [position, normal] = [[x, 0.0, -2.0], [0.0, 0.0, 1.0]].map(|v| Vec3::splat(One, v));
        let from = LightSampleContext { position, normal, receiver: U(0) };
        let sum = |table: &LightTable| -> f64 {
            let places = (0..1600).map(|i| [(i % 40) as f32 * 0.025 + 0.0125, (i / 40) as f32 * 0.025 + 0.0125]);
            let mut others = 0;
            let sent = places.map(|u| {
                let sample = table.sample_li(One, None, &from, One.f(0.5), &u.map(|u| One.f(u)));
                let hit = sample.wi * sample.distance + position;
                let (met, _) = table.eval_hit(One, None, &from, U(0), [sample.wi, hit], One.m(true));
                others += u32::from((met.mean().0 - sample.radiance.mean().0).abs() > 1e-4);
                f64::from(sample.radiance.mean().0 / sample.pdf.0 * sample.wi.z.0)
            });
            let sum: f64 = sent.sum();
            // What light sampling brings, hits bring too, but for rounding at an edge.
            assert!(others <= 8, "{others} of 1600 hits differ");
            sum
        };
        sum(&behind) / sum(&plain)
    }

    #[test]
    fn a_large_light_throws_a_soft_edge() {
        // The opening's edge at 0.5 lies half way down: a point s of the light throws it to 1 - s.
        let filter = below(BARN);
        for x in [0.0, 0.75, 0.9, 1.0, 1.1, 1.25] {
            let (mut seen, mut all) = (0.0, 0.0);
            for i in 0..40_000 {
                let [s, t] = [i % 200, i / 200].map(|k| (f64::from(k) + 0.5) / 500.0 - 0.2);
                let squared = (x - s).powi(2) + t * t + 4.0;
                all += squared.powi(-2);
                seen += if s + x <= 1.0 { squared.powi(-2) } else { 0.0 };
            }
            let found = share(&filter, x as f32);
            assert!((found - seen / all).abs() < 0.02, "{x}: {found} {}", seen / all);
        }
    }

    #[test]
    fn what_ends_before_the_plane_or_goes_away_misses_it() {
        let mut filter = below(BARN);
        filter.missed = [0.25; 3];
        filter.from_world[2][3] = 3.0;
        assert!((share(&filter, 1.7) - 0.25).abs() < 1e-5);
        filter.from_world[2][3] = -1.0;
        assert!((share(&filter, 0.0) - 0.25).abs() < 1e-5);
    }

    #[test]
    fn strengths_and_pictures() {
        let half = Filter { density: 0.5, factor: [2.0; 3], ..below(BARN) };
        assert!((share(&half, 0.0) - 1.5).abs() < 1e-5 && (share(&half, 1.5) - 0.5).abs() < 1e-5);
        let inverted = Filter { inverted: true, ..below(BARN) };
        assert!(share(&inverted, 0.0).abs() < 1e-5 && (share(&inverted, 1.5) - 1.0).abs() < 1e-5);
        let image = LightTexture { width: 2, height: 1, rgb: vec![0.0, 0.0, 0.0, 1.0, 1.0, 1.0] };
        let picture = |fill, repeats| Slide::Picture {
            image: Arc::new(image.clone()),
            size: [1.0; 2],
            fill,
            repeats,
            to_texture: [[1.0, 0.0], [1.0, 0.0]],
        };
        // Black to the left and white to the right, thrown to a width of two metres.
        let filled = below(picture(Some([0.5; 3]), false));
        for (x, expected) in [(-0.75, 0.0), (0.75, 1.0), (1.5, 0.5), (-1.5, 0.5)] {
            assert!((share(&filled, x) - expected).abs() < 0.03, "{x}: {}", share(&filled, x));
        }
        let clamped = below(picture(None, false));
        assert!((share(&clamped, 1.5) - 1.0).abs() < 1e-5 && share(&clamped, -1.5).abs() < 1e-5);
        let repeated = below(picture(None, true));
        assert!(share(&repeated, 1.5) < 0.2 && share(&repeated, -1.5) > 0.8);
    }
}
