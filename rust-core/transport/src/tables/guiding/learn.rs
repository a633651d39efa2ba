//! Fills the guiding field from what paths found, and decides in each cell how often it is followed: as often as serves one half of the paths best,
//! with a field that the other half has made.

use super::{COLUMNS, GuidingField, PARTS, ROWS, SHARE, SUMS, WORDS, hashed, place_of};
use gonio_simd::{One, U, Vec3};
use std::f32::consts::{FRAC_1_PI, TAU};

/// A vertex that a path went on from by a diffuse lobe, and what it found.
#[derive(Clone, Copy, Debug)]
pub struct GuidingNote {
    /// The vertex, rebased world space.
    pub position: [f32; 3],
    /// Its shading normal.
    pub normal: [f32; 3],
    /// Where the path went on.
    pub direction: [f32; 3],
    /// Density of that direction per solid angle.
    pub pdf: f32,
    /// What the path carried on, the largest component.
    pub throughput: f32,
    /// Scatterings of the path, this one included.
    pub bounces: u32,
    /// In which half of the notes it is: those of one path are together.
    pub half: bool,
    /// How far the next such vertex is, metres; 0 where there is none.
    pub distance: f32,
    /// What the path brought to the picture from there on, the mean over channels.
    pub found: f32,
}

/// What came of learning.
#[derive(Debug)]
pub struct Learning {
    /// The field.
    pub field: GuidingField,
    /// By which factor following it lowers the mean square of what paths bring that are scattered diffusely a few times, as far as the notes can tell.
    pub gain: f64,
    /// Cells of which anything is known, and those in which the field is followed.
    pub cells: [usize; 2],
}

/// A cell is this part of the way to the next vertices wide, in the median.
const CELL: f32 = 0.3;
/// Shares of samples that follow the field, of which each cell takes the best, or none.
const SHARES: [f32; 3] = [0.3, 0.6, 0.85];
/// Parts of the hemisphere that are taken together along both sides, of which each cell takes the best: few notes tell little of many parts.
const TOGETHER: [usize; 3] = [1, 2, 4];
/// Places of the table for each cell.
const SPARSE: usize = 4;
/// A cell of fewer notes knows nothing.
const LEAST_NOTES: usize = 8;
/// What neighbouring parts of the hemisphere take of what is found in one: few notes leave gaps.
const BLUR: f64 = 0.25;
/// No note counts for more than so many of its cell's in the mean: rare bright ones would decide alone.
const MOST_WORTH: f64 = 16.0;
/// Scatterings of which a path's gain is the product; later ones bring little.
const BOUNCES: usize = 4;

/// A note in its cell.
#[derive(Clone, Copy, Debug)]
struct Entry {
    place: u32,
    key: u32,
    part: u32,
    half: bool,
    /// Radiance times cosine over the density: what the sample estimates the reflected light by.
    worth: f32,
    cosine: f32,
    pdf: f32,
    bounce: usize,
}

impl GuidingField {
    /// Learns from notes. `None` where they tell nothing.
    pub fn learn(notes: &[GuidingNote]) -> Option<Learning> {
        let per_metre = 1.0 / (CELL * middle_distance(notes)?).max(f32::MIN_POSITIVE);
        let mut entries: Vec<Entry> = notes.iter().filter_map(|note| entry(note, per_metre)).collect();
        // Stable, so that sums have one order.
        entries.sort_by_key(|entry| (entry.place, entry.key));
        entries.chunk_by_mut(|a, b| (a.place, a.key) == (b.place, b.key)).for_each(limit);
        let in_cells = || entries.chunk_by(|a, b| (a.place, a.key) == (b.place, b.key));
        let cells = in_cells().count();
        let count = (SPARSE * cells).next_power_of_two();
        let mut field = Self { cells: vec![0.0; count * WORDS], mask: count as u32 - 1, per_metre };
        // Of cells that share a place, the one with more notes stays.
        let mut known = vec![0; count];
        let mut gains = [[0.0; 2]; BOUNCES];
        for cell in in_cells() {
            let (choice, gain) = best_choice(cell);
            for entry in cell.iter().filter(|entry| entry.bounce < BOUNCES) {
                gains[entry.bounce][0] += gain.ln();
                gains[entry.bounce][1] += 1.0;
            }
            let number = (cell[0].place & field.mask) as usize;
            if choice.share > 0.0 && cell.len() > known[number] {
                known[number] = cell.len();
                fill(cell, choice, &mut field.cells[number * WORDS..(number + 1) * WORDS]);
            }
        }
        let gain = gains.iter().map(|[sum, count]| sum / f64::max(*count, 1.0)).sum::<f64>().exp();
        let followed = known.iter().filter(|notes| **notes > 0).count();
        Some(Learning { field, gain, cells: [cells, followed] })
    }
}

/// The median way to the next vertices, metres.
fn middle_distance(notes: &[GuidingNote]) -> Option<f32> {
    let mut ways: Vec<f32> = notes.iter().map(|note| note.distance).filter(|distance| *distance > 0.0).collect();
    let middle = ways.len() / 2;
    (!ways.is_empty()).then(|| *ways.select_nth_unstable_by(middle, f32::total_cmp).1)
}

fn entry(note: &GuidingNote, per_metre: f32) -> Option<Entry> {
    let (face, part) = place_of(note.normal, note.direction);
    let cosine = (0..3).map(|axis| note.normal[axis] * note.direction[axis]).sum::<f32>();
    let worth = note.found / note.throughput * cosine / note.pdf;
    if !(cosine > 0.02 && worth.is_finite() && worth > 0.0) {
        return None;
    }
    let [place, key] = hashed(Vec3::splat(One, note.position), per_metre, U(face)).map(|word| word.0);
    let bounce = note.bounces.max(1) as usize - 1;
    Some(Entry { place, key, part: part? as u32, half: note.half, worth, cosine, pdf: note.pdf, bounce })
}

/// Limits what each note of a cell tells.
fn limit(cell: &mut [Entry]) {
    let mean = cell.iter().map(|entry| f64::from(entry.worth)).sum::<f64>() / cell.len() as f64;
    let most = (MOST_WORTH * mean) as f32;
    cell.iter_mut().for_each(|entry| entry.worth = entry.worth.min(most));
}

/// How a cell is followed.
#[derive(Clone, Copy, Debug)]
struct Choice {
    /// By which share of the samples.
    share: f32,
    /// Parts of the hemisphere that are taken together along both sides.
    together: usize,
}

/// The shares of the parts of the hemisphere in what some notes tell of; neighbours lend each other a part.
fn shares<'a>(entries: impl Iterator<Item = &'a Entry>, together: usize) -> Option<Vec<f64>> {
    let mut parts = vec![0.0f64; PARTS];
    entries.for_each(|entry| parts[entry.part as usize] += f64::from(entry.worth));
    let parts = blurred(&merged(&parts, together));
    let total: f64 = parts.iter().sum();
    (total > 0.0).then(|| parts.iter().map(|part| part / total).collect())
}

/// Means over squares of parts.
fn merged(from: &[f64], together: usize) -> Vec<f64> {
    let mut to = vec![0.0; PARTS];
    let square = |row: usize, column: usize| row / together * together * COLUMNS + column / together * together;
    let places = || (0..ROWS).flat_map(|row| (0..COLUMNS).map(move |column| (row, column)));
    for (row, column) in places() {
        to[square(row, column)] += from[row * COLUMNS + column];
    }
    places().map(|(row, column)| to[square(row, column)] / (together * together) as f64).collect()
}

/// Gives a part of each to the eight around it.
fn blurred(from: &[f64]) -> Vec<f64> {
    let mut to: Vec<f64> = from.iter().map(|part| part * (1.0 - BLUR)).collect();
    for row in 0..ROWS {
        for column in 0..COLUMNS {
            let each = from[row * COLUMNS + column] * BLUR / 8.0;
            for (down, right) in [(-1, -1), (-1, 0), (-1, 1), (0, -1), (0, 1), (1, -1), (1, 0), (1, 1)] {
                // Columns go around; what would leave at the rim or at the pole stays in its row.
                let to_row = row.saturating_add_signed(down).min(ROWS - 1);
                let to_column = (column + COLUMNS).wrapping_add_signed(right) % COLUMNS;
                to[to_row * COLUMNS + to_column] += each;
            }
        }
    }
    to
}

/// The choice with which the mean square is least, and by which factor it falls.
fn best_choice(cell: &[Entry]) -> (Choice, f64) {
    let unguided = Choice { share: 0.0, together: 1 };
    if cell.len() < LEAST_NOTES {
        return (unguided, 1.0);
    }
    let alone = square(cell, [&[], &[]], 0.0);
    let mut best = (unguided, alone);
    for together in TOGETHER {
        let halves = [false, true].map(|half| shares(cell.iter().filter(move |entry| entry.half == half), together));
        let [Some(first), Some(second)] = halves else { break };
        for share in SHARES {
            let sum = square(cell, [&first, &second], share);
            if sum < best.1 {
                best = (Choice { share, together }, sum);
            }
        }
    }
    (best.0, alone / best.1.max(f64::MIN_POSITIVE))
}

/// The mean square of notes by a share of samples that follow what the other half has told.
fn square(cell: &[Entry], [of_first, of_second]: [&[f64]; 2], share: f32) -> f64 {
    let one = |entry: &Entry| {
        let field = if entry.half { of_first } else { of_second };
        let guided = field.get(entry.part as usize).map_or(0.0, |part| *part as f32 * (PARTS as f32 / TAU));
        let pdf = share * guided + (1.0 - share) * entry.cosine * FRAC_1_PI;
        f64::from(entry.worth).powi(2) * f64::from(entry.pdf) / f64::from(pdf)
    };
    cell.iter().map(one).sum()
}

/// Writes a cell's words.
fn fill(cell: &[Entry], choice: Choice, words: &mut [f32]) {
    let Some(parts) = shares(cell.iter(), choice.together) else { return };
    (words[0], words[SHARE as usize]) = (f32::from_bits(cell[0].key), choice.share);
    let mut sum = 0.0;
    let sums = &mut words[SUMS as usize..];
    for (word, part) in sums.iter_mut().zip(&parts) {
        *word = sum as f32;
        sum += part;
    }
    sums[PARTS] = 1.0;
}
