//! From requests to textures that are paged: tile files found in the cache folder, or made.

use super::file::{TextureFacts, TileFile, VERSION};
use super::folder::CacheFolder;
use super::memory::TextureMemory;
use super::need::need;
use super::pages::{PagedTexels, TileSource};
use crate::texture::error::TextureError;
use crate::texture::load::{Source, TextureRequest, deduplicate, load};
use crate::texture::mip_map::MipMap;
use rayon::prelude::*;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

/// A texture's answer.
type Made = Result<Arc<MipMap>, TextureError>;

/// Loads many textures on rayon's threads, equal requests only once; the answers are in the requests' order.
///
/// Where all of them fit into the memory they are held whole, else tile by tile. Pictures that have no tiles yet are decoded as many at a time
/// as there is room for, one at the least.
pub fn load_paged(requests: &[TextureRequest], memory: &Arc<TextureMemory>, folder: &Arc<CacheFolder>, cancel: &AtomicBool) -> Vec<Made> {
    let (unique, places) = deduplicate(requests);
    let mut made: Vec<Option<Made>> = unique.par_iter().map(|request| find(request, memory, folder).map(Ok)).collect();
    let missing: Vec<usize> = (0..unique.len()).filter(|place| made[*place].is_none()).collect();
    for batch in batches(&missing, |place| need(&unique[place].source), memory.limit()) {
        let of_batch: Vec<Made> = batch.par_iter().map(|place| make(unique[*place], memory, folder, cancel)).collect();
        batch.iter().zip(of_batch).for_each(|(place, result)| made[*place] = Some(result));
    }
    if !missing.is_empty() {
        folder.prune();
    }
    let mut made: Vec<Made> = made.into_iter().flatten().collect();
    let total: usize = made.iter().flatten().map(|map| map.bytes()).sum();
    if total as u64 <= memory.limit() {
        made.par_iter_mut().flatten().for_each(|map| {
            if let Some(whole) = map.held_whole() {
                *map = Arc::new(whole);
            }
        });
    }
    places.into_iter().map(|place| made[place].clone()).collect()
}

/// Runs of the missing textures whose needs together stay below the limit; one of unknown need is read alone.
fn batches(missing: &[usize], need: impl Fn(usize) -> Option<u64>, limit: u64) -> Vec<Vec<usize>> {
    let mut batches: Vec<Vec<usize>> = Vec::new();
    let mut room = 0;
    for place in missing {
        let need = need(*place).unwrap_or(limit);
        match batches.last_mut() {
            Some(batch) if need <= room => {
                batch.push(*place);
                room -= need;
            }
            _ => {
                batches.push(vec![*place]);
                room = limit.saturating_sub(need);
            }
        }
    }
    batches
}

/// The texture out of the cache folder.
fn find(request: &TextureRequest, memory: &Arc<TextureMemory>, folder: &Arc<CacheFolder>) -> Option<Arc<MipMap>> {
    let (file, facts) = folder.find(key_of(request)?)?;
    Some(paged(request, TileSource::File(file), &facts, memory, folder))
}

/// Decodes and filters a picture, and writes its tiles.
fn make(request: &TextureRequest, memory: &Arc<TextureMemory>, folder: &Arc<CacheFolder>, cancel: &AtomicBool) -> Made {
    let key = key_of(request);
    let map = load(request, cancel)?;
    let (facts, pyramid) = map.into_parts();
    let source = source_of(key, &facts, pyramid, folder);
    Ok(paged(request, source, &facts, memory, folder))
}

fn source_of(key: Option<u64>, facts: &TextureFacts, pyramid: Vec<f32>, folder: &CacheFolder) -> TileSource {
    let file: Option<TileFile> = key.and_then(|key| folder.write(key, facts, &pyramid));
    file.map_or(TileSource::Whole(pyramid), TileSource::File)
}

fn paged(
    request: &TextureRequest,
    source: TileSource,
    facts: &TextureFacts,
    memory: &Arc<TextureMemory>,
    folder: &Arc<CacheFolder>,
) -> Arc<MipMap> {
    let (remade, wanted, folder) = (request.clone(), facts.clone(), folder.clone());
    let remake = Box::new(move || remake(&remade, &wanted, &folder));
    let texels = PagedTexels::new(facts.layout(), source, memory.clone(), remake);
    Arc::new(MipMap::paged(facts, texels))
}

/// The tiles anew, after some were found damaged.
fn remake(request: &TextureRequest, wanted: &TextureFacts, folder: &CacheFolder) -> Result<TileSource, String> {
    let name = request.source.name();
    let map = load(request, &AtomicBool::new(false));
    let map = map.map_err(|error| format!("{error}; the tiles of its cache file are damaged, and what is missing of it is black"))?;
    let (facts, pyramid) = map.into_parts();
    if facts != *wanted {
        return Err(format!(
            "{name}: it was changed while it was rendered, and the tiles of its cache file are damaged; what is missing of it is black"
        ));
    }
    Ok(source_of(key_of(request), &facts, pyramid, folder))
}

/// A number for what the tiles are made of: the file's place, size and time of change, or the bytes themselves; and the colour space.
fn key_of(request: &TextureRequest) -> Option<u64> {
    let mut hasher = DefaultHasher::new();
    (VERSION, request.colour_space).hash(&mut hasher);
    match &request.source {
        Source::Path(path) => {
            let path = path.canonicalize().ok()?;
            let about = path.metadata().ok()?;
            (0, &path, about.len(), about.modified().ok()).hash(&mut hasher);
        }
        Source::Bytes { bytes, .. } => (1, bytes.len(), bytes).hash(&mut hasher),
        Source::Pixels { width, height, rgba, .. } => {
            (2, width, height).hash(&mut hasher);
            hasher.write(bytemuck::cast_slice(rgba));
        }
    }
    Some(hasher.finish())
}

#[cfg(test)]
mod tests {
    use super::batches;

    #[test]
    fn batches_keep_the_limit() {
        let needs = [Some(40), Some(60), Some(1), None, Some(300), Some(50), Some(50)];
        let found = batches(&[0, 1, 2, 3, 4, 5, 6], |place| needs[place], 100);
        assert_eq!(found, [vec![0, 1], vec![2], vec![3], vec![4], vec![5, 6]]);
    }
}
