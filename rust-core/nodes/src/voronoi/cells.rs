//! Cells around a place, and the point in each.

use super::CellHash;
use crate::hash::{hash1, hash2, hash3, hash4, to_unit};
use gonio_simd::{F, Lanes, U};

/// Multiplier and summand of the linear step with which a PCG hash begins.
const STEP: [u32; 2] = [1_664_525, 1_013_904_223];
/// The greatest hash of a PCG, without the sign bit, as a reciprocal; a power of two, as Cycles rounds it.
const PCG_UNIT: f32 = 1.0 / 2_147_483_648.0;

/// Bits for each axis in the code of a neighbour.
const DIGIT_BITS: u32 = 4;

/// A cell, the place in it, and `S` cells along each axis around it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cells<L: Lanes, const D: usize, const S: usize> {
    hash: CellHash,
    cell: [F<L>; D],
    local: [F<L>; D],
    randomness: F<L>,
    words: [[U<L>; S]; D],
    offsets: [[F<L>; S]; D],
}

/// What the hash takes for a coordinate of a cell: `offset` cells beside `cell`, both whole.
#[inline(always)]
fn word<L: Lanes, const D: usize>(hash: CellHash, cell: F<L>, offset: F<L>) -> U<L> {
    if D == 1 || hash == CellHash::Lookup3 { (cell + offset).to_bits() } else { (cell.to_i32() + offset.to_i32()) * STEP[0] + STEP[1] }
}

#[inline(always)]
fn pcg_unit<L: Lanes>(x: U<L>) -> F<L> {
    (x & 0x7fff_ffff).i32_to_float() * PCG_UNIT
}

#[inline(always)]
fn fold<L: Lanes>(x: U<L>) -> U<L> {
    x ^ x.sar(16)
}

/// PCG in two dimensions (Jarzynski and Olano, Hash Functions for GPU Rendering, JCGT 9(3), 2020), with signed shifts; as in the next two, the
/// words have gone through the linear step.
#[inline(always)]
fn pcg2<L: Lanes>([x, y]: [U<L>; 2]) -> [F<L>; 2] {
    let x = x + y * STEP[0];
    let y = y + x * STEP[0];
    let (x, y) = (fold(x), fold(y));
    let x = x + y * STEP[0];
    let y = y + x * STEP[0];
    [pcg_unit(x), pcg_unit(y)]
}

#[inline(always)]
fn pcg3<L: Lanes>([x, y, z]: [U<L>; 3]) -> [F<L>; 3] {
    let x = x + y * z;
    let y = y + z * x;
    let z = z + x * y;
    let (x, y, z) = (fold(x), fold(y), fold(z));
    let x = x + y * z;
    let y = y + z * x;
    let z = z + x * y;
    [pcg_unit(x), pcg_unit(y), pcg_unit(z)]
}

#[inline(always)]
fn pcg4<L: Lanes>([x, y, z, w]: [U<L>; 4]) -> [F<L>; 4] {
    let x = x + y * w;
    let y = y + z * x;
    let z = z + x * y;
    let w = w + y * z;
    let (x, y, z, w) = (fold(x), fold(y), fold(z), fold(w));
    let x = x + y * w;
    let y = y + z * x;
    let z = z + x * y;
    let w = w + y * z;
    [pcg_unit(x), pcg_unit(y), pcg_unit(z), pcg_unit(w)]
}

/// The bits of 1 or 2, which tell the second and third number of a cell from its first.
#[inline(always)]
fn salt<L: Lanes>(l: L, number: f32) -> U<L> {
    l.u(number.to_bits())
}

/// The point of a cell in the unit cube, by the cell's words. A `match` on the dimensions leaves the others ungenerated, where `if` would not.
#[inline(always)]
fn point_by_lookup3<L: Lanes, const D: usize>(l: L, k: [U<L>; D]) -> [F<L>; D] {
    let mut point = [l.f(0.0); D];
    match D {
        1 => point[0] = to_unit(hash1(l, k[0])),
        2 => {
            point[0] = to_unit(hash2(l, k[0], k[1]));
            point[1] = to_unit(hash3(l, k[0], k[1], salt(l, 1.0)));
        }
        3 => {
            point[0] = to_unit(hash3(l, k[0], k[1], k[2]));
            point[1] = to_unit(hash4(l, k[0], k[1], k[2], salt(l, 1.0)));
            point[2] = to_unit(hash4(l, k[0], k[1], k[2], salt(l, 2.0)));
        }
        _ => {
            point[0] = to_unit(hash4(l, k[0], k[1], k[2], k[3]));
            point[1] = to_unit(hash4(l, k[3], k[0], k[1], k[2]));
            point[2] = to_unit(hash4(l, k[2], k[3], k[0], k[1]));
            point[3] = to_unit(hash4(l, k[1], k[2], k[3], k[0]));
        }
    }
    point
}

#[inline(always)]
fn point_by_pcg<L: Lanes, const D: usize>(l: L, k: [U<L>; D]) -> [F<L>; D] {
    let mut point = [l.f(0.0); D];
    match D {
        1 => {}
        2 => [point[0], point[1]] = pcg2([k[0], k[1]]),
        3 => [point[0], point[1], point[2]] = pcg3([k[0], k[1], k[2]]),
        _ => [point[0], point[1], point[2], point[3]] = pcg4([k[0], k[1], k[2], k[3]]),
    }
    point
}

/// The colour of a cell by its words; `point` is the point of the same cell, whose numbers it shares where the hash has it so.
#[inline(always)]
fn color<L: Lanes, const D: usize>(l: L, hash: CellHash, k: [U<L>; D], point: [F<L>; D]) -> [F<L>; 3] {
    match D {
        1 => [point[0], to_unit(hash2(l, k[0], salt(l, 1.0))), to_unit(hash2(l, k[0], salt(l, 2.0)))],
        2 => match hash {
            CellHash::Lookup3 => [point[0], point[1], to_unit(hash3(l, k[0], k[1], salt(l, 2.0)))],
            CellHash::Pcg => pcg3([k[0], k[1], l.u(STEP[1])]),
        },
        3 => [point[0], point[1], point[2]],
        _ => match hash {
            CellHash::Lookup3 => [point[0], to_unit(hash4(l, k[2], k[0], k[3], k[1])), to_unit(hash4(l, k[3], k[2], k[1], k[0]))],
            CellHash::Pcg => [point[0], point[1], point[2]],
        },
    }
}

impl<L: Lanes, const D: usize, const S: usize> Cells<L, D, S> {
    /// How many cells there are, and the number of the middle one.
    pub(super) const COUNT: usize = S.pow(D as u32);

    /// The cells around a place.
    #[inline(always)]
    pub(super) fn around(l: L, hash: CellHash, at: [F<L>; D], randomness: F<L>) -> Self {
        let (mut cell, mut local) = (at, at);
        for axis in 0..D {
            cell[axis] = at[axis].floor();
            local[axis] = at[axis] - cell[axis];
        }
        Self::within(l, hash, cell, local, randomness)
    }

    /// The cells around `cell`, at the place `local` relative to its corner.
    #[inline(always)]
    pub(super) fn within(l: L, hash: CellHash, cell: [F<L>; D], local: [F<L>; D], randomness: F<L>) -> Self {
        let (mut words, mut offsets) = ([[l.u(0); S]; D], [[l.f(0.0); S]; D]);
        for axis in 0..D {
            for digit in 0..S {
                let offset = l.f(digit as f32 - (S / 2) as f32);
                words[axis][digit] = word::<L, D>(hash, cell[axis], offset);
                offsets[axis][digit] = offset - local[axis];
            }
        }
        Self { hash, cell, local, randomness, words, offsets }
    }

    /// The digits of a neighbour's number, x the fastest.
    #[inline(always)]
    pub(super) fn digits(number: usize) -> [usize; D] {
        let (mut digits, mut rest) = ([0; D], number);
        for digit in &mut digits {
            (*digit, rest) = (rest % S, rest / S);
        }
        digits
    }

    /// The least that a vector to a point can have along an axis; the most is more by the randomness.
    #[inline(always)]
    pub(super) fn low(&self, axis: usize, digit: usize) -> F<L> {
        self.offsets[axis][digit]
    }

    /// The digits of a neighbour's number in one word.
    #[inline(always)]
    pub(super) fn code(number: usize) -> u32 {
        let mut code = 0;
        for (axis, digit) in Self::digits(number).into_iter().enumerate() {
            code |= (digit as u32) << (DIGIT_BITS * axis as u32);
        }
        code
    }

    #[inline(always)]
    fn unit_point(&self, l: L, words: [U<L>; D]) -> [F<L>; D] {
        match D {
            1 => point_by_lookup3(l, words),
            _ => match self.hash {
                CellHash::Lookup3 => point_by_lookup3(l, words),
                CellHash::Pcg => point_by_pcg(l, words),
            },
        }
    }

    /// The words of a neighbour.
    #[inline(always)]
    fn words(&self, l: L, number: usize) -> [U<L>; D] {
        let mut words = [l.u(0); D];
        for (axis, digit) in Self::digits(number).into_iter().enumerate() {
            words[axis] = self.words[axis][digit];
        }
        words
    }

    /// The point of a neighbour in the unit cube and the vector to it from the place.
    #[inline(always)]
    fn unit_point_and_vector(&self, l: L, number: usize) -> [[F<L>; D]; 2] {
        let unit = self.unit_point(l, self.words(l, number));
        let mut vector = unit;
        for (axis, digit) in Self::digits(number).into_iter().enumerate() {
            vector[axis] = unit[axis].mul_add(self.randomness, self.offsets[axis][digit]);
        }
        [unit, vector]
    }

    /// The vector to a neighbour's point.
    #[inline(always)]
    pub(super) fn vector(&self, l: L, number: usize) -> [F<L>; D] {
        let [_, vector] = self.unit_point_and_vector(l, number);
        vector
    }

    /// The vector to a neighbour's point and its colour.
    #[inline(always)]
    pub(super) fn vector_and_color(&self, l: L, number: usize) -> ([F<L>; D], [F<L>; 3]) {
        let [unit, vector] = self.unit_point_and_vector(l, number);
        (vector, color(l, self.hash, self.words(l, number), unit))
    }

    /// The place that a vector from here leads to.
    #[inline(always)]
    pub(super) fn place(&self, vector: [F<L>; D]) -> [F<L>; D] {
        let mut place = vector;
        for axis in 0..D {
            place[axis] = vector[axis] + self.local[axis] + self.cell[axis];
        }
        place
    }

    /// The neighbour that a lane's code names.
    #[inline(always)]
    pub(super) fn chosen(&self, l: L, code: U<L>) -> Chosen<L, D> {
        let (mut cell, mut words) = (self.cell, [l.u(0); D]);
        let mut place = cell;
        for axis in 0..D {
            let digit = (code >> (DIGIT_BITS * axis as u32)) & ((1 << DIGIT_BITS) - 1);
            let offset = digit.i32_to_float() - (S / 2) as f32;
            words[axis] = word::<L, D>(self.hash, cell[axis], offset);
            place[axis] = offset;
            cell[axis] += offset;
        }
        let unit = self.unit_point(l, words);
        let mut within = unit;
        for axis in 0..D {
            within[axis] = unit[axis] * self.randomness;
            place[axis] = place[axis] + within[axis] + self.cell[axis];
        }
        Chosen { cell, within, place, color: color(l, self.hash, words, unit) }
    }
}

/// A neighbour that differs by lane.
#[derive(Clone, Copy, Debug)]
pub(super) struct Chosen<L: Lanes, const D: usize> {
    /// The cell's corner.
    pub(super) cell: [F<L>; D],
    /// Its point relative to the corner.
    pub(super) within: [F<L>; D],
    /// Its point.
    pub(super) place: [F<L>; D],
    /// Its colour.
    pub(super) color: [F<L>; 3],
}
