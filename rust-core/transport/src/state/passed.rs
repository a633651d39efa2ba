//! Hits that rays have passed, which go straight on through surfaces: items of four words, a [`Passed`] each.

use bytemuck::{cast_slice, cast_slice_mut};
use gonio_accel::{BEFORE_EDGE, NONE, Passed};
use gonio_simd::{Column, F, Lanes, M, U};
use std::ops::Range;

/// One register of hits that rays have passed.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PassedLanes<L: Lanes> {
    pub(crate) t: F<L>,
    pub(crate) instance: U<L>,
    pub(crate) primitive: U<L>,
    pub(crate) barycentric: [F<L>; 2],
}

impl<L: Lanes> PassedLanes<L> {
    /// The chosen ones alone.
    #[inline(always)]
    pub(crate) fn only(self, chosen: M<L>) -> Self {
        let none = self.instance.lanes().u(NONE);
        Self {
            t: self.t.keep_if(chosen),
            instance: chosen.select(self.instance, none),
            primitive: chosen.select(self.primitive, none),
            ..self
        }
    }

    /// See [`Passed`].
    #[inline(always)]
    fn item(&self) -> [F<L>; 4] {
        let [u, v] = self.barycentric;
        let on_edge = u.le(0.0) | v.le(0.0) | (u + v).ge(BEFORE_EDGE);
        [self.t, F::from_bits(self.instance), F::from_bits(self.primitive), F::from_bits(u.lanes().u(1).keep_if(on_edge))]
    }
}

/// What each ray has passed; nobody pays for it before one has.
#[derive(Debug, Default)]
pub(crate) struct PassedHits {
    any: bool,
    items: Column,
}

impl PassedHits {
    /// No ray has passed anything.
    pub(crate) fn clear(&mut self) {
        self.any = false;
    }

    /// Those of some rays; empty where no ray has passed anything.
    pub(crate) fn of(&self, rays: Range<usize>) -> &[Passed] {
        if self.any { &cast_slice(&self.items)[rays] } else { &[] }
    }

    /// Writes the chosen lanes behind the first `count` of `room`; `None` where none has passed anything.
    #[inline(always)]
    pub(crate) fn append<L: Lanes>(&mut self, l: L, passed: Option<&PassedLanes<L>>, chosen: M<L>, [count, room]: [usize; 2]) {
        let item = match passed {
            None if !self.any => return,
            None => [l.f(0.0), F::from_bits(l.u(NONE)), F::from_bits(l.u(NONE)), l.f(0.0)],
            Some(passed) => {
                self.begin(count, room);
                passed.item()
            }
        };
        l.append_quads(item, chosen, &mut self.items, count);
    }

    /// Makes room; the first `count` rays have passed nothing.
    fn begin(&mut self, count: usize, room: usize) {
        if !self.any {
            self.any = true;
            if self.items.len() < 4 * room {
                self.items = Column::new(4 * room);
            }
            cast_slice_mut(&mut self.items)[..count].fill(Passed::NOTHING);
        }
    }

    /// What the first `count` rays have passed, to be written for each.
    pub(crate) fn of_first(&mut self, count: usize) -> &mut [Passed] {
        self.begin(0, count);
        &mut cast_slice_mut(&mut self.items)[..count]
    }

    /// How far some rays had come when they passed something last.
    #[inline(always)]
    pub(crate) fn distance<L: Lanes>(&self, l: L, ray: U<L>) -> F<L> {
        if self.any { l.gather(&self.items, ray << 2) } else { l.f(0.0) }
    }

    /// Instances and primitives that some rays passed last; `None` where no ray has passed anything.
    #[inline(always)]
    pub(crate) fn last<L: Lanes>(&self, l: L, ray: U<L>) -> Option<[U<L>; 2]> {
        if !self.any {
            return None;
        }
        let [_, instance, primitive, _] = l.gather_quads(&self.items, ray << 2);
        Some([instance.to_bits(), primitive.to_bits()])
    }

    /// Copies an entry over another.
    pub(crate) fn copy(&mut self, from: usize, to: usize) {
        if self.any {
            self.items.copy_within(4 * from..4 * from + 4, 4 * to);
        }
    }

    /// Takes chosen entries of others, in that order.
    pub(crate) fn select(&mut self, from: &Self, chosen: &[u32]) {
        self.clear();
        if from.any {
            self.begin(0, chosen.len());
            let entries = cast_slice::<_, Passed>(&from.items);
            cast_slice_mut(&mut self.items).iter_mut().zip(chosen).for_each(|(to, ray)| *to = entries[*ray as usize]);
        }
    }
}
