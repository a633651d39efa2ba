//! Light linking: which receivers a light lights.
//!
//! Receivers that see the same lights are one class, and lights that are linked alike are one set. Each class selects among its own lights: MoonRay
//! has a light acceleration structure a light set too, Cycles a light tree whose parts sets share.

use super::row::{ROW, field};
use super::table::{LightSampler, MOST_EXHAUSTIVE};
use super::tree::LightTree;
use gonio_simd::{Lanes, M, U};

/// Which classes of receivers see which sets of lights. Receivers of class 0 see all lights, and all receivers see those of set 0.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct LightLinks {
    /// The set of each light.
    pub set_of_light: Vec<u32>,
    /// Whether some receiver is of class 0.
    pub any_sees_all: bool,
    classes: usize,
    /// Words of 64 sets a class.
    words: usize,
    seen: Vec<u64>,
}

impl LightLinks {
    /// So many classes and sets, of which no receiver but those of class 0 sees any light but those of set 0.
    pub fn new(set_of_light: Vec<u32>, classes: usize, sets: usize) -> Self {
        let words = sets.div_ceil(64);
        Self { set_of_light, any_sees_all: true, classes, words, seen: vec![0; classes * words] }
    }
    /// Lets the receivers of a class see the lights of a set.
    pub fn allow(&mut self, class: u32, set: u32) {
        if let Some(word) = self.seen.get_mut(class as usize * self.words + set as usize / 64) {
            *word |= 1 << (set % 64);
        }
    }
    /// Whether receivers of a class see the lights of a set.
    #[inline(always)]
    pub fn allows(&self, class: u32, set: u32) -> bool {
        let word = || self.seen.get(class as usize * self.words + set as usize / 64).copied().unwrap_or(0);
        class == 0 || set == 0 || word() >> (set % 64) & 1 != 0
    }
    /// The same lane by lane.
    #[inline(always)]
    pub fn sees_set<L: Lanes>(&self, l: L, class: U<L>, set: U<L>) -> M<L> {
        if class.eq(0).all() || set.eq(0).all() {
            return l.m(true);
        }
        let (classes, sets) = (class.to_array(), set.to_array());
        let mut bits = 0;
        for lane in 0..L::COUNT {
            bits |= u64::from(self.allows(classes[lane], sets[lane])) << lane;
        }
        M(l.mask_from_bits(bits))
    }
    /// Whether receivers see lights.
    #[inline(always)]
    pub(crate) fn sees<L: Lanes>(&self, l: L, class: U<L>, light: U<L>) -> M<L> {
        self.sees_set(l, class, l.gather_integers(&self.set_of_light, light))
    }
}

/// In the place of a class' only light: it has several, or none.
pub(crate) const SEVERAL: u32 = u32::MAX;
/// Lights of all trees together. What goes beyond selects among all lights, and loses what it may not see.
const MOST_ENTRIES: usize = 1 << 21;

/// How a class selects among its lights.
#[derive(Clone, Debug)]
pub(crate) enum ClassSampler {
    /// As if it saw all; what it does not see is lost.
    All,
    /// Few enough to be weighed, by their numbers.
    Few(Vec<u32>),
    /// A light tree of its own.
    Tree(Box<LightTree>),
}

/// Links and the samplers of all classes.
#[derive(Clone, Debug)]
pub(crate) struct LinkedLights {
    pub(crate) links: LightLinks,
    pub(crate) classes: Vec<ClassSampler>,
    /// The light of each class that has one alone, else [`SEVERAL`].
    pub(crate) only: Vec<u32>,
}

impl LinkedLights {
    /// Of the lights with these rows.
    pub(crate) fn new(links: LightLinks, rows: &[f32]) -> Self {
        let rows_of = rows.as_chunks::<ROW>().0;
        let mut sets = vec![Vec::new(); links.words * 64];
        for (light, _) in rows_of.iter().enumerate().filter(|(_, row)| row[field::STRENGTH] > 0.0) {
            if let Some(set) = links.set_of_light.get(light).and_then(|set| sets.get_mut(*set as usize)) {
                set.push(light as u32);
            }
        }
        let mut left = MOST_ENTRIES;
        let mut classes = vec![ClassSampler::All];
        for class in 1..links.classes as u32 {
            let seen = |set: &usize| links.allows(class, *set as u32);
            let mut lights: Vec<u32> = (0..sets.len()).filter(seen).flat_map(|set| sets[set].iter().copied()).collect();
            lights.sort_unstable();
            classes.push(match lights.len() {
                0..=MOST_EXHAUSTIVE => ClassSampler::Few(lights),
                _ if rows_of.len() <= left => {
                    left -= rows_of.len();
                    ClassSampler::Tree(Box::new(LightTree::of(rows, |light| lights.binary_search(&light).is_ok())))
                }
                _ => ClassSampler::All,
            });
        }
        let only = |sampler: &ClassSampler| match sampler {
            ClassSampler::Few(lights) if lights.len() == 1 => lights[0],
            _ => SEVERAL,
        };
        let only = classes.iter().map(only).collect();
        Self { links, classes, only }
    }

    /// The tree that a class selects by; `whole` selects among all lights.
    pub(crate) fn tree<'a>(&'a self, class: u32, whole: &'a LightSampler) -> Option<&'a LightTree> {
        match (self.classes.get(class as usize)?, whole) {
            (ClassSampler::Tree(tree), _) => Some(tree),
            (ClassSampler::All, LightSampler::Tree(tree)) => Some(tree),
            _ => None,
        }
    }

    /// Whether any class selects by a tree that has receivers.
    pub(crate) fn has_tree(&self, whole: &LightSampler) -> bool {
        let first = u32::from(!self.links.any_sees_all);
        (first..self.classes.len() as u32).any(|class| self.tree(class, whole).is_some())
    }
}
