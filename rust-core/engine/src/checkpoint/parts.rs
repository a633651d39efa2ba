//! Cutting a render into parts for several machines.

use crate::{
    compile::window,
    error::{Error, Result},
    film::{Film, GROUP, MOST_BLOCK},
    scene::Settings,
};

/// Most parts of a render.
const MOST_PARTS: u32 = 100_000;

/// Some samples of some tiles, `[first, behind the last]` each.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Part {
    /// Tiles of the window, row by row.
    pub tiles: [u32; 2],
    /// Samples a pixel.
    pub samples: [u32; 2],
}

/// Cuts what settings ask for into parts of about equal numbers of pixels and samples: `count` of them, or as many as there can be.
///
/// Tiles are cut first, since parts of them hold fewer sums than parts of samples. A noise threshold decides by all samples of a tile, which stay together.
pub fn parts(settings: &Settings, count: u32) -> Result<Vec<Part>> {
    if !(1..=MOST_PARTS).contains(&count) {
        return Err(Error::setting("parts", format!("{count} was found, expected 1 to {MOST_PARTS}")));
    }
    if settings.sample_range.is_some() || settings.tile_range.is_some() {
        return Err(Error::setting("parts", "the render is itself a part, which is not cut further"));
    }
    let tiles = Film::tiles_of(window(settings)?) as u32;
    let ranges = if settings.least_samples().is_some() { 1 } else { (settings.samples / MOST_BLOCK).max(1) };
    // One part there always is.
    let (runs, ranges) = (1..=count).rev().find_map(|count| factors(count, tiles, ranges)).unwrap_or((1, 1));
    let samples = cuts(settings.samples, ranges);
    let tiles: Vec<u32> = (0..=runs).map(|run| share(tiles, run, runs)).collect();
    let pairs = |cuts: &[u32]| cuts.windows(2).map(|pair| [pair[0], pair[1]]).collect::<Vec<_>>();
    let (tiles, samples) = (pairs(&tiles), pairs(&samples));
    Ok(tiles.iter().flat_map(|tiles| samples.iter().map(|samples| Part { tiles: *tiles, samples: *samples })).collect())
}

/// Runs of tiles and ranges of samples that make so many parts, with as many runs as can be.
fn factors(count: u32, tiles: u32, ranges: u32) -> Option<(u32, u32)> {
    let divides = |runs: &u32| count.is_multiple_of(*runs) && count / runs <= ranges;
    (1..=count.min(tiles)).rev().find(divides).map(|runs| (runs, count / runs))
}

/// Where ranges of samples start, and the end: at groups if those are enough, else at blocks.
fn cuts(samples: u32, ranges: u32) -> Vec<u32> {
    let unit = if samples / GROUP >= ranges { GROUP } else { MOST_BLOCK };
    (0..ranges).map(|range| share(samples / unit, range, ranges) * unit).chain([samples]).collect()
}

/// `total * part / parts`.
fn share(total: u32, part: u32, parts: u32) -> u32 {
    (u64::from(total) * u64::from(part) / u64::from(parts)) as u32
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::film::block_at;

    fn settings(resolution: [u32; 2], samples: u32, noise_threshold: f32) -> Settings {
        Settings { resolution, samples, noise_threshold, ..Settings::default() }
    }

    #[test]
    fn parts_cover_every_sample_of_every_tile_once() {
        for (resolution, samples, count) in
            [([130, 70], 64, 4), ([64, 64], 1000, 7), ([640, 360], 1, 16), ([100, 100], 4096, 60), ([64, 64], 33, 9)]
        {
            let settings = settings(resolution, samples, 0.0);
            let tiles = resolution[0].div_ceil(64) * resolution[1].div_ceil(64);
            let parts = parts(&settings, count).expect("parts");
            assert!(!parts.is_empty() && parts.len() <= count as usize);
            let mut seen = vec![0; (tiles * samples) as usize];
            for part in &parts {
                assert!(part.samples.iter().all(|sample| block_at(*sample, samples).is_some()), "{part:?}");
                for tile in part.tiles[0]..part.tiles[1] {
                    (part.samples[0]..part.samples[1]).for_each(|sample| seen[(tile * samples + sample) as usize] += 1);
                }
            }
            assert!(seen.iter().all(|times| *times == 1));
        }
    }

    #[test]
    fn tiles_are_cut_before_samples() {
        let counts = |samples, noise_threshold, count| {
            let parts = parts(&settings([200, 100], samples, noise_threshold), count).expect("parts");
            let first = parts[0];
            (parts.len(), first.tiles[1], first.samples[1])
        };
        assert_eq!(counts(256, 0.0, 4), (4, 2, 256));
        assert_eq!(counts(256, 0.0, 16), (16, 1, 128));
        assert_eq!(counts(1024, 0.0, 32), (32, 1, 256));
        assert_eq!(counts(256, 0.1, 16), (8, 1, 256));
        assert_eq!(counts(8, 0.0, 16), (8, 1, 8));
    }

    #[test]
    fn parts_of_parts_are_refused() {
        let whole = settings([64, 64], 64, 0.0);
        assert!(parts(&whole, 0).is_err());
        assert!(parts(&Settings { sample_range: Some([0, 16]), ..whole.clone() }, 2).is_err());
        assert!(parts(&Settings { tile_range: Some([0, 1]), ..whole }, 2).is_err());
    }
}
