//! What cameras and meters stand in; [`super::start_media`] and [`super::index`] look around them.

use super::index::squared_indices_at;
use super::start_media::media_at;
use crate::tables::Tables;
use gonio_camera::Surroundings;

/// What places in world space stand in, metres.
pub fn surroundings_at(tables: &Tables, places: &[[f64; 3]]) -> Vec<Surroundings> {
    let rebased: Vec<[f32; 3]> = places.iter().map(|place| [0, 1, 2].map(|axis| (place[axis] - tables.origin[axis]) as f32)).collect();
    let squared = squared_indices_at(tables, &rebased);
    let media = rebased.iter().map(|place| media_at(tables, *place));
    media.zip(squared).map(|(media, squared_index)| Surroundings { squared_index, ..media }).collect()
}
