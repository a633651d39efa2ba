//! From slabs to a deep picture, row by row.

use super::deep::Scales;
use super::{Film, Layer, zone_of};
use crate::{camera::sampler::tile_code, deep::DeepPicture};

impl Film {
    /// The deep picture of a film that is asked for one; `colour` is its developed colour pass, which it flattens to.
    pub(super) fn develop_deep(&self, tolerance: f32, colour: &Layer) -> DeepPicture {
        let size = [0, 1].map(|axis| (self.window.max[axis] - self.window.min[axis]) as usize);
        let mut picture = DeepPicture { size, counts: Vec::with_capacity(size[0] * size[1]), samples: Vec::new() };
        let columns = (self.columns as usize).max(1);
        for band in 0..self.tile_count() / columns {
            let tiles: Vec<_> = (band * columns..(band + 1) * columns).map(|tile| (self.tile_area(tile), self.tile(tile))).collect();
            let Some(rows) = tiles.first().map(|(area, _)| area.min[1]..area.max[1]) else { continue };
            for y in rows {
                for (area, film) in &tiles {
                    for x in area.min[0]..area.max[0] {
                        let code = tile_code([(x - area.min[0]) as usize, (y - area.min[1]) as usize]);
                        let scale = 1.0 / f64::from(film.samples[zone_of(code)].max(1));
                        let (pixel, before) = (picture.counts.len(), picture.samples.len());
                        if let Some(deep) = &film.deep {
                            let scales = Scales { tolerance, exposure: self.exposure };
                            deep.append_samples(code, scale, scales, &colour.values[4 * pixel..4 * pixel + 3], &mut picture.samples);
                        }
                        picture.counts.push((picture.samples.len() - before) as u32);
                    }
                }
            }
        }
        picture
    }
}
