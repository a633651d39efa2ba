//! The media that a ray is in (Cycles' volume stack).
//!
//! Media that fill meshes, or all of space, overlap: their coefficients add up, and each is left by its name. Solids, which bend rays at their surfaces,
//! take each other's place.

use crate::tables::media::{Coefficients, MediumTable};
use gonio_camera::Surroundings;
use gonio_simd::{Column, F, Lanes, M, Rgb, Spectrum, SpectrumColumns, U, Wavelengths};

/// Lights further away than this are infinitely far.
pub(crate) const FAR: f32 = 1e20;
/// Bits of a name, two of which stand in a word.
const BITS: u32 = 16;
const NAME: u32 = (1 << BITS) - 1;

/// One register of what rays are in.
#[derive(Clone, Copy, Debug)]
pub struct MediaSet<L: Lanes> {
    /// Rows of up to three media that fill the place, and that of the solid about it, if it scatters; 0 is none. Two bodies full of one medium stand there
    /// twice, a fourth is left out.
    names: [U<L>; 2],
    /// Absorption a metre of the solid about the place, where it has no row.
    solid: Spectrum<L>,
}

/// What is under a surface that bends rays: it absorbs, or is a row of the table.
#[derive(Clone, Copy, Debug)]
pub struct Solid<L: Lanes> {
    /// Absorption a metre of one without a row.
    pub absorption: Spectrum<L>,
    /// The row of one that scatters, 0 for none.
    pub row: u32,
}

impl<L: Lanes> MediaSet<L> {
    /// The open: nothing takes light away.
    #[inline(always)]
    pub fn open(l: L) -> Self {
        Self { names: [l.u(0); 2], solid: Spectrum::zero(l) }
    }

    /// What fills all of space alone, a row of the table.
    #[inline(always)]
    pub(crate) fn everywhere(l: L, media: &MediumTable) -> Self {
        Self { names: [l.u(media.everywhere), l.u(0)], ..Self::open(l) }
    }

    /// What a place is in, as [`crate::surroundings_at`] tells, as colour; in every lane.
    #[inline(always)]
    pub fn at_place(l: L, place: &Surroundings) -> Self {
        let [r, g, b] = place.absorption.map(|x| l.f(x));
        Self { names: place.media.map(|names| l.u(names)), solid: Wavelengths::rgb(l).coefficient(Rgb::new(r, g, b)) }
    }

    /// The same for light of some wavelengths: what the solid makes of white is a colour, and `tints` is how often a metre it does.
    #[inline(always)]
    pub(crate) fn seen_at(self, wavelengths: Wavelengths<'_, L>, tints: F<L>) -> Self {
        let tinted = tints.gt(0.0);
        if wavelengths.is_colour() || !tinted.any() {
            return self;
        }
        let left = (self.solid * -tints.max(f32::MIN_POSITIVE).recip()).exp().to_rgb();
        let left = wavelengths.reflectance(left).max(f32::MIN_POSITIVE);
        Self { solid: tinted.select(left.ln() * -tints, self.solid), ..self }
    }

    /// The names, and what the solid absorbs a metre.
    #[inline(always)]
    pub(crate) fn parts(self) -> ([U<L>; 2], Spectrum<L>) {
        (self.names, self.solid)
    }

    /// What is behind a surface that encloses a solid with this absorption, if it does, and what a row of the table fills.
    #[inline(always)]
    pub fn behind(self, solid: Option<Solid<L>>, filling: Option<u32>, entering: M<L>) -> Self {
        let filled = match filling {
            Some(row) => self.entered(row, entering).left(row, !entering),
            None => self,
        };
        match solid {
            // Leaving a solid leads to the open.
            Some(Solid { absorption, row }) => {
                let [first, second] = filled.names;
                let own = second.lanes().u(row << BITS).keep_if(entering);
                Self { solid: absorption.keep_if(entering), names: [first, (second & NAME) | own] }
            }
            None => filled,
        }
    }

    /// Where any medium has a name here; of solids those alone that scatter have one.
    #[inline(always)]
    pub(crate) fn is_filled(self) -> M<L> {
        (self.names[0] | self.names[1]).ne(0)
    }

    /// Where any medium is by a field.
    #[inline(always)]
    pub(crate) fn varies(self, media: &MediumTable) -> M<L> {
        let l = self.names[0].lanes();
        let mut varies = l.m(false);
        if media.varies() {
            for row in self.rows().into_iter().flatten() {
                varies |= media.field(l, row).ne(0);
            }
        }
        varies
    }

    /// With one medium more (Cycles' `volume_stack_enter_exit`).
    #[inline(always)]
    pub fn entered(self, row: u32, chosen: M<L>) -> Self {
        self.exchanged(0, row, chosen)
    }

    /// Without a medium, if it is there: open meshes may be left without having been entered.
    #[inline(always)]
    pub fn left(self, row: u32, chosen: M<L>) -> Self {
        self.exchanged(row, 0, chosen)
    }

    /// As it was before a boundary of what a row fills was crossed: who is in it has entered it.
    #[inline(always)]
    pub(crate) fn back_across(self, row: u32, chosen: M<L>) -> Self {
        let [first, second] = self.names;
        let inside = (first & NAME).eq(row) | (first >> BITS).eq(row) | (second & NAME).eq(row);
        self.entered(row, chosen.and_not(inside)).left(row, chosen & inside)
    }

    /// With another name in the first place that has this one.
    #[inline(always)]
    fn exchanged(mut self, from: u32, to: u32, mut chosen: M<L>) -> Self {
        for (word, shift) in [(0, 0), (0, BITS), (1, 0)] {
            let word = &mut self.names[word];
            let here = chosen & ((*word >> shift) & NAME).eq(from);
            *word = here.select(*word ^ ((from ^ to) << shift), *word);
            chosen = chosen.and_not(here);
        }
        self
    }

    /// What rays are in that leave a surface: `across` where they go behind it, `straight` where nothing bends them. What fills meshes lies behind
    /// all of them, solids behind what is bent.
    #[inline(always)]
    pub fn towards(self, behind: Self, across: M<L>, straight: M<L>) -> Self {
        let bent = across.and_not(straight);
        let [first, second] = [0, 1].map(
            #[inline(always)]
            |word| across.select(behind.names[word], self.names[word]),
        );
        let solid = bent.select(behind.names[1], self.names[1]) >> BITS << BITS;
        Self { names: [first, (second & NAME) | solid], solid: bent.select(behind.solid, self.solid) }
    }

    /// Extinction a metre of all even ones together.
    #[inline(always)]
    pub fn extinction(self, media: Coefficients<'_, L>) -> Spectrum<L> {
        self.of_names(media) + self.solid
    }

    /// The rows of the media, by their order; `None` where no lane has as many.
    #[inline(always)]
    pub(crate) fn rows(self) -> [Option<U<L>>; 4] {
        let [first, second] = self.names;
        [first & NAME, first >> BITS, second & NAME, second >> BITS].map(
            #[inline(always)]
            |row| row.ne(0).any().then_some(row),
        )
    }

    #[inline(always)]
    fn of_names(self, media: Coefficients<'_, L>) -> Spectrum<L> {
        let l = self.names[0].lanes();
        let mut sum = Spectrum::zero(l);
        if media.table.is_empty() {
            return sum;
        }
        for row in self.rows().into_iter().flatten() {
            sum += media.extinction(l, row);
        }
        sum
    }

    /// Optical depth of so many metres of even media. No solid that only absorbs reaches infinitely far: where one seems to, its mesh is open.
    #[inline(always)]
    pub fn optical_depth(self, media: Coefficients<'_, L>, distance: F<L>) -> Spectrum<L> {
        let solid = self.solid.keep_if(distance.lt(FAR));
        (self.of_names(media) + solid) * distance.min(FAR)
    }

    /// What even media leave of light after so many metres (Beer and Lambert).
    #[inline(always)]
    pub fn transmittance(self, media: Coefficients<'_, L>, distance: F<L>) -> Spectrum<L> {
        (self.optical_depth(media, distance) * distance.lanes().f(-1.0)).exp()
    }
}

/// What rays are in that wait between stages.
#[derive(Debug)]
pub struct MediaColumns {
    names: [Column<u32>; 2],
    solid: SpectrumColumns,
}

impl MediaColumns {
    /// Room for so many rays, which are in the open.
    pub fn new(room: usize) -> Self {
        Self { names: [Column::new(room), Column::new(room)], solid: SpectrumColumns::new(room) }
    }
    /// Writes the chosen lanes behind the first `len` rays.
    #[inline(always)]
    pub fn append<L: Lanes>(&mut self, media: MediaSet<L>, chosen: M<L>, len: usize) {
        media.names.iter().zip(&mut self.names).for_each(|(word, column)| word.append(chosen, column, len));
        self.solid.append(media.solid, chosen, len);
    }
    /// Writes those of a register of rays from the one at `at` on.
    #[inline(always)]
    pub fn store<L: Lanes>(&mut self, media: MediaSet<L>, at: usize) {
        media.names.iter().zip(&mut self.names).for_each(|(word, column)| word.store(column, at));
        self.solid.store(media.solid, at);
    }
    /// Those of a register of rays from the one at `at` on.
    #[inline(always)]
    pub fn load<L: Lanes>(&self, l: L, at: usize) -> MediaSet<L> {
        let [first, second] = &self.names;
        MediaSet { names: [l.load_integers(first, at), l.load_integers(second, at)], solid: self.solid.load(l, at) }
    }
    /// Those of some rays.
    #[inline(always)]
    pub fn gather<L: Lanes>(&self, l: L, ray: U<L>) -> MediaSet<L> {
        let [first, second] = &self.names;
        MediaSet { names: [l.gather_integers(first, ray), l.gather_integers(second, ray)], solid: self.solid.gather(l, ray) }
    }
    /// Copies those of one ray over another's.
    pub fn copy(&mut self, from: usize, to: usize) {
        self.names.iter_mut().for_each(|column| column[to] = column[from]);
        self.solid.copy(from, to);
    }
    /// Sets the solid about a ray to one of some absorptions, or to a row of the table.
    pub(crate) fn set_solid(&mut self, ray: usize, (absorption, from): (&SpectrumColumns, usize), row: u32) {
        self.names[1][ray] = self.names[1][ray] & NAME | row << BITS;
        self.solid.scale(ray, 0.0);
        self.solid.add(ray, absorption, from, 1.0);
    }
}
