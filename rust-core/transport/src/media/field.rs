//! Lookups in fields along rays: densities, heats, and cells whose density has a bound.

use crate::tables::fields::{FieldTable, GLOW, LOG2_BRICK, LOG2_COARSE, ROW, WORDS};
use crate::tables::media::Coefficients;
use gonio_simd::{F, Lanes, M, Spectrum, U, Vec3};

/// A register of rays in the coordinates of their fields.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FieldRays<L: Lanes> {
    /// Rows of the field table.
    field: U<L>,
    origin: Vec3<L>,
    direction: Vec3<L>,
    inverse: Vec3<L>,
    /// The box that the field fills, or comes to.
    reach: [Vec3<L>; 2],
    hottest: F<L>,
    /// The part of the shutter's time since the numbers held, 0 where nothing flows; none where no field does.
    since: Option<F<L>>,
    /// See [`FieldTable::bricks`] and [`FieldTable::coarse`].
    bricks: [U<L>; 4],
    coarse: [U<L>; 4],
    /// See [`FieldTable::colours`]; none where no field has any.
    colours: Option<[[U<L>; 3]; 3]>,
    /// Metres that stand for nothing: a thousandth of a cell.
    step: F<L>,
}

/// How what fields hold moves, by straight ways.
#[derive(Clone, Copy, Debug)]
struct Flow<L: Lanes> {
    /// See [`FieldTable::flow`].
    first: [U<L>; 4],
    /// The box of the numbers.
    domain: [Vec3<L>; 2],
    /// See [`FieldRays`].
    since: F<L>,
}

/// A stretch of a ray over which the density has a bound.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Cell<L: Lanes> {
    /// The greatest density on it.
    pub(crate) most: F<L>,
    /// Metres at which it ends.
    pub(crate) exit: F<L>,
}

/// Where a lattice is looked up: bricks, cells within them, and parts of a cell; whether anything is there.
struct Place<L: Lanes> {
    brick: U<L>,
    row: U<L>,
    part: Vec3<L>,
    holds: M<L>,
}

impl<L: Lanes> FieldRays<L> {
    /// Rays in rebased world space, at times of the shutter.
    #[inline(always)]
    pub(crate) fn new(l: L, table: &FieldTable, field: U<L>, [origin, direction]: [Vec3<L>; 2], time: F<L>) -> Self {
        let at = field * ROW as u32;
        let rows = [0, 1, 2].map(
            #[inline(always)]
            |axis| l.gather_quads(&table.to_lattice[axis], at),
        );
        let rows = match &table.moving {
            Some(moving) => moving.place(field, time, rows),
            None => rows,
        };
        let [x, y, z] = rows.map(
            #[inline(always)]
            |[x, y, z, _]| Vec3::new(x, y, z),
        );
        let moved = Vec3::new(rows[0][3], rows[1][3], rows[2][3]);
        let [low, high] = [0, 1].map(
            #[inline(always)]
            |end| l.gather_quads(&table.reach[end], at),
        );
        let direction = turned([x, y, z], direction);
        Self {
            field,
            origin: turned([x, y, z], origin) + moved,
            direction,
            inverse: Vec3::new(inverse(direction.x), inverse(direction.y), inverse(direction.z)),
            reach: [Vec3::new(low[0], low[1], low[2]), Vec3::new(high[0], high[1], high[2])],
            hottest: low[3],
            since: match table.flows {
                true => Some((time - l.gather(&table.domain[0], at + 3)).keep_if(l.gather_integers(&table.flow, at).ne(0))),
                false => None,
            },
            bricks: l.gather_integer_quads(&table.bricks, at),
            coarse: l.gather_integer_quads(&table.coarse, at),
            colours: match table.is_coloured {
                true => Some(table.colours.each_ref().map(
                    #[inline(always)]
                    |colours| {
                        let [r, g, b, _] = l.gather_integer_quads(colours, at);
                        [r, g, b]
                    },
                )),
                false => None,
            },
            step: direction.max_abs().max(1e-20).recip() * 1e-3,
        }
    }

    /// Where they have a field.
    #[inline(always)]
    pub(crate) fn any(&self) -> M<L> {
        self.field.ne(0)
    }

    /// Lattice coordinates after so many metres.
    #[inline(always)]
    fn at(&self, distance: F<L>) -> Vec3<L> {
        self.direction.mul_add(distance, self.origin)
    }

    /// Whether a point is in the box.
    #[inline(always)]
    fn holds(&self, point: Vec3<L>) -> M<L> {
        self.any() & is_within(point, self.reach)
    }

    /// The cell in which rays go on behind so many metres.
    #[inline(always)]
    pub(crate) fn cell(&self, l: L, table: &FieldTable, distance: F<L>) -> Cell<L> {
        let point = self.at(distance + self.step);
        let ([low, high], inside) = (self.reach, self.holds(point));
        let [x, y, z] = [point.x, point.y, point.z].map(
            #[inline(always)]
            |x| x.max(0.0).to_i32(),
        );
        let at = [x, y, z];
        let block = number(at, LOG2_BRICK + LOG2_COARSE, self.coarse) + self.coarse[2];
        let filled = l.gather(&table.filled, block.keep_if(inside)).gt(0.0) & inside;
        let fine = (number(at, LOG2_BRICK, self.bricks) + self.bricks[2]).keep_if(filled);
        let most = l.gather(&table.bounds, fine * ROW as u32 + 2).keep_if(filled);
        let edge = filled.select(l.u(1 << LOG2_BRICK), l.u(1 << (LOG2_BRICK + LOG2_COARSE)));
        let leaving = leaving(x, edge, [low.x, high.x], [self.origin.x, self.inverse.x])
            .min(leaving(y, edge, [low.y, high.y], [self.origin.y, self.inverse.y]))
            .min(leaving(z, edge, [low.z, high.z], [self.origin.z, self.inverse.z]));
        let exit = inside.select(leaving, self.entry(l, distance)).max(distance + self.step);
        Cell { most, exit }
    }

    /// Where rays outside come into the box, infinitely far if they do not.
    #[inline(always)]
    fn entry(&self, l: L, distance: F<L>) -> F<L> {
        let [low, high] = self.reach;
        let mut range = [distance, l.f(f32::INFINITY)];
        for (low, high, origin, inverse) in [
            (low.x, high.x, self.origin.x, self.inverse.x),
            (low.y, high.y, self.origin.y, self.inverse.y),
            (low.z, high.z, self.origin.z, self.inverse.z),
        ] {
            let (a, b) = ((low - origin) * inverse, (high - origin) * inverse);
            range = [range[0].max(a.min(b)), range[1].min(a.max(b))];
        }
        (self.any() & range[0].lt(range[1]) & range[0].gt(distance)).select(range[0], l.f(f32::INFINITY))
    }

    #[inline(always)]
    fn place(&self, l: L, table: &FieldTable, distance: F<L>) -> Place<L> {
        let point = self.at(distance);
        let Some(since) = self.since else { return self.place_of(point, self.reach) };
        let flow = Flow::of(l, table, self.field * ROW as u32, since);
        // What is here now was a way back (semi-Lagrangian advection, as Cycles has it): by the flow here, and then by that where this leads.
        let near = flow.back(l, table, &self.place_of(point, self.reach), point);
        let from = flow.back(l, table, &self.place_of(near, self.reach), point);
        let place = self.place_of(from, flow.domain);
        Place { holds: place.holds & (is_within(from, flow.domain) | flow.first[0].eq(0)), ..place }
    }

    /// Where a point is, held within a box.
    #[inline(always)]
    fn place_of(&self, point: Vec3<L>, [low, high]: [Vec3<L>; 2]) -> Place<L> {
        let held = [(point.x, low.x, high.x), (point.y, low.y, high.y), (point.z, low.z, high.z)].map(
            #[inline(always)]
            |(x, low, high)| x.clamp(low, high),
        );
        let [x, y, z] = held.map(
            #[inline(always)]
            |x| x.to_i32(),
        );
        let [u, v, w] = held.map(
            #[inline(always)]
            |x| x - x.floor(),
        );
        let brick = number([x, y, z], LOG2_BRICK, self.bricks);
        let row = ((x & 7) * 9 + (y & 7)) * 8 + (z & 7);
        Place { brick, row, part: Vec3::new(u, v, w), holds: self.any() }
    }

    /// The density after so many metres.
    #[inline(always)]
    pub(crate) fn density(&self, l: L, table: &FieldTable, distance: F<L>) -> F<L> {
        let place = self.place(l, table, distance);
        value(l, table, &place, self.bricks[2]).keep_if(place.holds)
    }

    /// Where their fields have colours that vary.
    #[inline(always)]
    pub(crate) fn coloured(&self, l: L) -> M<L> {
        match &self.colours {
            Some([extinction, ..]) => extinction[0].ne(0),
            None => l.m(false),
        }
    }

    /// Scattering and extinction a metre after so many metres, where the density is this; `even` are those of their rows of the table at a density of 1.
    #[inline(always)]
    pub(crate) fn taken(
        &self,
        l: L,
        media: Coefficients<'_, L>,
        (row, even): (U<L>, [Spectrum<L>; 2]),
        distance: F<L>,
        density: F<L>,
    ) -> [Spectrum<L>; 2] {
        let [scattering, extinction] = even.map(
            #[inline(always)]
            |part| part * density,
        );
        let vary = self.coloured(l);
        let (Some([taken, scattered, _]), true) = (&self.colours, vary.any()) else { return [scattering, extinction] };
        let table = &media.table.fields;
        let place = self.place(l, table, distance);
        let factors = [scattered, taken].map(
            #[inline(always)]
            |first| {
                colour(l, table, &place, first).map(
                    #[inline(always)]
                    |part| part.keep_if(place.holds),
                )
            },
        );
        let varied = media.varied(l, row, factors, even);
        [vary.select(varied[0], scattering), vary.select(varied[1], extinction)]
    }

    /// Factor on the emission after so many metres; 0 outside.
    #[inline(always)]
    pub(crate) fn glow(&self, l: L, media: Coefficients<'_, L>, distance: F<L>) -> Spectrum<L> {
        let fields = &media.table.fields;
        let holds = match self.since {
            Some(_) => self.place(l, fields, distance).holds,
            None => self.holds(self.at(distance)),
        };
        let inside = Spectrum::constant(l.f(1.0).keep_if(holds));
        let is_hot = self.bricks[3].ne(0);
        let inside = match &self.colours {
            Some([_, _, sent]) if sent[0].ne(0).any() => {
                let factor = media.sent(colour(l, fields, &self.place(l, fields, distance), sent));
                inside * sent[0].ne(0).select(factor, Spectrum::one(l))
            }
            _ => inside,
        };
        if !is_hot.any() {
            return inside;
        }
        let heat = value(l, fields, &self.place(l, fields, distance), self.bricks[3]);
        let last = (GLOW - 1) as f32;
        let at = (heat / self.hottest.max(f32::MIN_POSITIVE) * last).clamp(0.0, last);
        let below = at.floor().min(last - 1.0);
        let factor = media.glow(l, self.coarse[3] * GLOW as u32 + below.to_i32(), at - below);
        inside * is_hot.select(factor, Spectrum::one(l))
    }
}

impl<L: Lanes> Flow<L> {
    /// That of fields by their places in the table, so long after their numbers held.
    #[inline(always)]
    fn of(l: L, table: &FieldTable, at: U<L>, since: F<L>) -> Self {
        let [low, high] = [0, 1].map(
            #[inline(always)]
            |end| l.gather_quads(&table.domain[end], at),
        );
        let first = l.gather_integer_quads(&table.flow, at);
        let domain = [Vec3::new(low[0], low[1], low[2]), Vec3::new(high[0], high[1], high[2])];
        Self { first, domain, since }
    }

    /// Where what is at a point now was when the numbers held, by the flow at a place.
    #[inline(always)]
    fn back(&self, l: L, table: &FieldTable, place: &Place<L>, point: Vec3<L>) -> Vec3<L> {
        let [x, y, z, _] = self.first;
        let flow = Vec3::new(value(l, table, place, x), value(l, table, place, y), value(l, table, place, z));
        flow.mul_add(-self.since, point)
    }
}

/// Whether a point is in a box.
#[inline(always)]
fn is_within<L: Lanes>(point: Vec3<L>, [low, high]: [Vec3<L>; 2]) -> M<L> {
    let above = point.x.ge(low.x) & point.y.ge(low.y) & point.z.ge(low.z);
    above & point.x.le(high.x) & point.y.le(high.y) & point.z.le(high.z)
}

/// A vector in the space whose axes these rows ask for.
#[inline(always)]
fn turned<L: Lanes>([x, y, z]: [Vec3<L>; 3], v: Vec3<L>) -> Vec3<L> {
    Vec3::new(x.dot(v), y.dot(v), z.dot(v))
}

/// One over a number, very large where that is 0.
#[inline(always)]
fn inverse<L: Lanes>(x: F<L>) -> F<L> {
    x.abs().max(1e-20).copysign(x).recip()
}

/// The number within its lattice of the brick that holds a cell, of edges of so many cells as a power of two, by a row of the table.
#[inline(always)]
fn number<L: Lanes>([x, y, z]: [U<L>; 3], log2: u32, [ny, nz, ..]: [U<L>; 4]) -> U<L> {
    ((x >> log2) * ny + (y >> log2)) * nz + (z >> log2)
}

/// Metres at which rays leave a cube of cells along an axis, cut off at the box's faces.
#[inline(always)]
fn leaving<L: Lanes>(cell: U<L>, edge: U<L>, [low, high]: [F<L>; 2], [origin, inverse]: [F<L>; 2]) -> F<L> {
    let first = cell & (cell.lanes().u(0) - edge);
    // Not by the direction: where that is 0, its inverse is large and positive.
    let face = inverse.gt(0.0).select((first + edge).i32_to_float().min(high), first.i32_to_float().max(low));
    (face - origin) * inverse
}

/// A colour R, G, B at a place, by the first bricks of its components.
#[inline(always)]
fn colour<L: Lanes>(l: L, table: &FieldTable, place: &Place<L>, [r, g, b]: &[U<L>; 3]) -> [F<L>; 3] {
    [value(l, table, place, *r), value(l, table, place, *g), value(l, table, place, *b)]
}

/// The trilinear value at a place of the lattice whose bricks begin at one.
#[inline(always)]
fn value<L: Lanes>(l: L, table: &FieldTable, place: &Place<L>, first: U<L>) -> F<L> {
    let [least, span, _, words] = l.gather_quads(&table.bounds, (place.brick + first) * ROW as u32);
    let at = words.to_bits() * WORDS as u32 + place.row;
    let Vec3 { x: u, y: v, z: w } = place.part;
    let [a, b, c, d] = [0, 8, 72, 80].map(
        #[inline(always)]
        |offset| {
            let pair = l.gather_integers(&table.words, at + offset);
            (pair & 0xffff).i32_to_float().lerp((pair >> 16).i32_to_float(), w)
        },
    );
    let code = a.lerp(b, v).lerp(c.lerp(d, v), u);
    span.mul_add(code, least)
}
