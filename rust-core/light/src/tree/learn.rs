//! Fills the learned light cache from the arrivals of the pilot pass: which lights arrive in which cells.

use super::light_cache::{LightCache, MOST, WORDS, place};
use super::{LightTree, NONE};

/// Light that arrived at a surface, or did not.
#[derive(Clone, Copy, Debug)]
pub struct Arrival {
    /// The surface's place, rebased world space.
    pub position: [f32; 3],
    /// Distance from the light, metres.
    pub distance: f32,
    /// The light; `None` where the one that was selected did not arrive.
    pub light: Option<u32>,
    /// Its contribution, summed over channels.
    pub value: f32,
    /// The surface's class of receivers.
    pub receiver: u32,
}

impl Arrival {
    /// A light was selected and did not arrive.
    pub fn nothing(position: [f32; 3], receiver: u32) -> Self {
        Self { position, distance: 0.0, light: None, value: 0.0, receiver }
    }
}

/// A cell is this part of the way to the lights wide, in the median.
const CELL: f32 = 0.3;
/// Largest share of selections among a cell's lights, however sure: the others find what was overlooked.
const MOST_CERTAIN: f32 = 0.99;
/// Largest share of selections given up in a cell where no light arrived: an overlooked light then weighs at most ten times as much.
const MOST_DARK: f32 = 0.9;
/// After so many arrivals half of what they tell is trusted.
const DOUBTS: f32 = 2.0;

/// Places of the table for each cell: of two that fall on the same one, one is lost, and with it its walls are forgotten. Of twice as many places as
/// cells an eighth of a room's surface was.
const SPARSE: usize = 8;

/// In the place of a leaf: an infinite light, which is outside the tree, and behind it [`NONE`] for none at all.
const FAR: u32 = NONE - 1;

/// An arrival in its cell.
#[derive(Clone, Copy, Debug)]
struct Entry {
    place: u32,
    key: u32,
    leaf: u32,
    value: f32,
}

impl LightCache {
    /// Learns from arrivals and from blocked samples; `None` if no light of a tree arrived anywhere. `tree_of` gives the tree by which a class of
    /// receivers selects, if it does.
    pub(crate) fn learn<'a>(arrivals: &[Arrival], tree_of: impl Fn(u32) -> Option<&'a LightTree>) -> Option<Self> {
        let of_light = |tree: &LightTree, light: u32| tree.leaves.get(light as usize).map_or(FAR, |leaf| (*leaf).min(FAR));
        let leaf = |arrival: &Arrival| {
            let tree = tree_of(arrival.receiver);
            arrival.light.map_or(NONE, |light| tree.map_or(FAR, |tree| of_light(tree, light)))
        };
        let mut ways: Vec<f32> = arrivals.iter().filter(|arrival| leaf(arrival) < FAR).map(|arrival| arrival.distance).collect();
        if ways.is_empty() {
            return None;
        }
        let middle = ways.len() / 2;
        let median = *ways.select_nth_unstable_by(middle, f32::total_cmp).1;
        let per_metre = 1.0 / (CELL * median).max(f32::MIN_POSITIVE);
        let entry = |arrival: &Arrival| {
            let [place, key] = place(arrival.position, per_metre, arrival.receiver);
            Entry { place, key, leaf: leaf(arrival), value: arrival.value }
        };
        let mut entries: Vec<Entry> = arrivals.iter().filter(|arrival| tree_of(arrival.receiver).is_some()).map(entry).collect();
        // Stable, so that sums have one order.
        entries.sort_by_key(|entry| (entry.place, entry.key, entry.leaf));
        Some(Self::of_entries(&entries, per_metre))
    }

    fn of_entries(entries: &[Entry], per_metre: f32) -> Self {
        let in_cells = || entries.chunk_by(|a, b| (a.place, a.key) == (b.place, b.key));
        let count = (SPARSE * in_cells().count()).next_power_of_two();
        let mut cache = Self { cells: vec![0.0; count * WORDS], mask: count as u32 - 1, per_metre };
        // Of cells that share a place, the one that more arrived in stays.
        let mut arrived = vec![0; count];
        for cell in in_cells() {
            let number = (cell[0].place & cache.mask) as usize;
            if cell.len() > arrived[number] {
                arrived[number] = cell.len();
                fill(cell, &mut cache.cells[number * WORDS..(number + 1) * WORDS]);
            }
        }
        cache
    }
}

/// Writes a cell's words: the lights that brought most, and their share of selections. Where none brought anything, that share is given up.
///
/// What none of the arrivals has told of is as likely as lights that one alone has told of (Good, The Population Frequencies of Species and the
/// Estimation of Population Parameters, Biometrika 40, 1953).
fn fill(entries: &[Entry], words: &mut [f32]) {
    let sum = |entries: &[Entry]| entries.iter().map(|entry| entry.value).sum::<f32>();
    // Samples that did not arrive stand behind all leaves.
    let arrived = &entries[..entries.partition_point(|entry| entry.leaf != NONE)];
    let by_light = || arrived.chunk_by(|a, b| a.leaf == b.leaf);
    let mut lights: Vec<(u32, f32)> = by_light().map(|entries| (entries[0].leaf, sum(entries))).filter(|light| light.0 != FAR).collect();
    lights.sort_by(|a, b| b.1.total_cmp(&a.1));
    lights.truncate(MOST);
    let of_known = lights.iter().map(|light| light.1).sum::<f32>();
    let share = match arrived.len() {
        0 => MOST_DARK * trust(entries.len()),
        count => {
            let once = by_light().filter(|entries| entries.len() == 1).count() as f32;
            (1.0 - once / count as f32).min(MOST_CERTAIN) * trust(count) * (of_known / sum(arrived).max(f32::MIN_POSITIVE)).min(1.0)
        }
    };
    words.fill(0.0);
    words[..3].copy_from_slice(&[f32::from_bits(entries[0].key), share, f32::from_bits(lights.len() as u32)]);
    words[3..].iter_mut().zip(&lights).for_each(|(word, light)| *word = f32::from_bits(light.0));
}

/// How far so many samples are trusted.
fn trust(count: usize) -> f32 {
    count as f32 / (count as f32 + DOUBTS)
}
