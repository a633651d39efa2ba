//! Textures within a memory limit against the same ones held whole.

use super::lookup::Batch;
use super::made::{Random, bytes, floats, halves, png};
use crate::colour::ColourSpace;
use crate::texture::{
    CacheFolder, Filter, Image, MipMap, TextureMemory, TextureRequest, TextureTable, TileReader, Wrap, load, load_paged, tests::made::build,
};
use gonio_simd::{Execution, Lanes, Vec2, dispatch};
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

/// A folder of one test.
struct Folder(PathBuf);

impl Folder {
    fn new(name: &str) -> Self {
        let path = std::env::temp_dir().join(format!("gonio-paged-{name}-{}", std::process::id()));
        let _ = fs::remove_dir_all(&path);
        fs::create_dir_all(&path).unwrap();
        Self(path)
    }

    fn cache(&self) -> Arc<CacheFolder> {
        Arc::new(CacheFolder::new(Some(&self.0.join("cache"))))
    }

    fn tile_files(&self) -> Vec<PathBuf> {
        let mut files: Vec<PathBuf> = fs::read_dir(self.0.join("cache")).into_iter().flatten().map(|entry| entry.unwrap().path()).collect();
        files.sort();
        files
    }

    fn picture(&self, name: &str, image: &Image, space: ColourSpace) -> TextureRequest {
        let path = self.0.join(name);
        fs::write(&path, png(image)).unwrap();
        TextureRequest::path(path, space)
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}

fn never() -> AtomicBool {
    AtomicBool::new(false)
}

fn paged(requests: &[TextureRequest], memory: &Arc<TextureMemory>, cache: &Arc<CacheFolder>) -> Vec<Arc<MipMap>> {
    load_paged(requests, memory, cache, &never()).into_iter().map(|map| map.unwrap()).collect()
}

fn table_of(map: impl Into<Arc<MipMap>>) -> TextureTable {
    let mut table = TextureTable::new();
    table.push(map.into());
    table
}

fn lookups(count: usize, seed: u64) -> Vec<[f32; 3]> {
    let mut random = Random(seed);
    let mut place = || random.unit() * 3.0 - 1.0;
    let mut all: Vec<[f32; 3]> = (0..count).map(|i| [place(), place(), if i % 3 == 0 { 0.0 } else { place().abs() * 0.2 }]).collect();
    all.extend([[0.0, 0.0, 0.0], [1.0, 1.0, 0.0], [f32::NAN, 0.5, f32::NAN], [0.3, f32::INFINITY, 9.0], [1e30, -1e30, 1e-9]]);
    all
}

#[inline(always)]
fn sample_tiles<L: Lanes>(l: L, batch: &mut Batch, reader: &mut TileReader, table: &TextureTable, wrap: [Wrap; 2], filter: Filter) {
    for i in (0..batch.columns[0].len()).step_by(L::COUNT) {
        let uv = Vec2 { x: l.load(&batch.columns[0], i), y: l.load(&batch.columns[1], i) };
        let rgba = table.sample_tiles(l, (reader, L::COUNT), 0, uv, l.load(&batch.columns[2], i), (wrap, filter));
        for (channel, column) in rgba.into_iter().zip(&mut batch.rgba) {
            channel.store(column, i);
        }
    }
}

fn by_tiles(table: &TextureTable, execution: Execution, lookups: &[[f32; 3]], wrap: [Wrap; 2], filter: Filter) -> Batch {
    let (mut batch, mut reader) = (Batch::new(lookups), TileReader::default());
    dispatch!(execution, l => sample_tiles(l, &mut batch, &mut reader, table, wrap, filter));
    batch
}

#[track_caller]
fn assert_same(whole: &TextureTable, tiles: &TextureTable, lookups: &[[f32; 3]], wrap: [Wrap; 2], filter: Filter) {
    for execution in Execution::all() {
        let mut expected = Batch::new(lookups);
        expected.run(execution, whole, wrap, filter);
        let found = by_tiles(tiles, execution, lookups, wrap, filter);
        assert!(found.rgba == expected.rgba, "{} {wrap:?} {filter:?}", execution.name());
    }
}

const FILTERS: [Filter; 3] = [Filter::Trilinear, Filter::Nearest, Filter::Cubic];
const WRAPS: [Wrap; 4] = [Wrap::Repeat, Wrap::Clamp, Wrap::Mirror, Wrap::Black];

#[test]
fn tiles_give_the_same_texels_for_every_format_wrap_and_filter() {
    let folder = Folder::new("same");
    let pixels = |image: Image| {
        let rgba: Vec<f32> = (0..image.len()).flat_map(|texel| image.rgba(texel)).collect();
        let (name, rgba) = (Arc::from("pixels"), Arc::from(rgba));
        let source = crate::texture::Source::Pixels { name, width: image.width, height: image.height, rgba };
        TextureRequest { source, colour_space: ColourSpace::Raw }
    };
    let requests = [
        folder.picture("srgb.png", &bytes(150, 97, 3, 1), ColourSpace::Auto),
        folder.picture("raw.png", &bytes(130, 70, 4, 2), ColourSpace::Raw),
        folder.picture("gamma.png", &bytes(64, 129, 3, 3), ColourSpace::G22),
        folder.picture("wide.png", &bytes(70, 66, 3, 4), ColourSpace::ACES_CG),
        pixels(floats(97, 65, 4, 5)),
        pixels(halves(70, 131, 4, 6)),
        folder.picture("grey.png", &bytes(300, 1, 1, 7), ColourSpace::ACES_CG),
    ];
    for cycle in 0..2 {
        // No room at all: every tile is given up at once but for those that the reader holds.
        let memory = TextureMemory::new(1, 1);
        for (request, map) in requests.iter().zip(paged(&requests, &memory, &folder.cache())) {
            assert!(map.is_paged());
            let whole = load(request, &never()).unwrap();
            assert_eq!((map.bytes() + whole.format().words() * 4, map.resolution()), (whole.bytes(), whole.resolution()));
            let (whole, tiles) = (table_of(whole), table_of(map));
            for filter in FILTERS {
                for wrap in WRAPS {
                    assert_same(&whole, &tiles, &lookups(120, 9), [wrap, WRAPS[cycle + 1]], filter);
                }
            }
        }
        assert_eq!(folder.tile_files().len(), requests.len());
    }
}

#[test]
fn sets_of_udim_tiles_are_the_same_with_gaps() {
    let folder = Folder::new("udim");
    let numbers = [1001, 1003, 1012];
    let requests = numbers.map(|n| folder.picture(&format!("{n}.png"), &bytes(n - 920, 70, 3, u64::from(n)), ColourSpace::Auto));
    let memory = TextureMemory::new(1, 1);
    let maps = paged(&requests, &memory, &folder.cache());
    let (mut whole, mut tiles) = (TextureTable::new(), TextureTable::new());
    whole.push_tiles(numbers.iter().zip(&requests).map(|(n, request)| (*n, Arc::new(load(request, &never()).unwrap()))));
    tiles.push_tiles(numbers.into_iter().zip(maps));
    assert!(tiles.is_paged(0) && !whole.is_paged(0));
    assert_same(&whole, &tiles, &lookups(500, 3), [Wrap::Repeat; 2], Filter::Trilinear);
}

#[test]
fn threads_that_thrash_get_the_same_and_keep_the_limit() {
    let folder = Folder::new("thrash");
    let image = bytes(700, 500, 3, 8);
    let whole = table_of(build(&image, ColourSpace::Auto));
    let limit = 40 << 14;
    let memory = TextureMemory::new(limit, 1);
    let request = folder.picture("big.png", &image, ColourSpace::Auto);
    let tiles = table_of(paged(&[request], &memory, &folder.cache())[0].clone());
    let (places, wrap, execution) = (lookups(4000, 5), [Wrap::Repeat; 2], Execution::detect());
    let mut expected = Batch::new(&places);
    expected.run(execution, &whole, wrap, Filter::Trilinear);
    std::thread::scope(|scope| {
        let work = || by_tiles(&tiles, execution, &places, wrap, Filter::Trilinear).rgba == expected.rgba;
        let workers: Vec<_> = (0..4).map(|_| scope.spawn(work)).collect();
        assert!(workers.into_iter().all(|worker| worker.join().unwrap()));
    });
    let statistics = tiles.statistics().unwrap();
    assert!(statistics.evicted > 0 && statistics.tiles_read > 100, "{statistics:?}");
    assert!(statistics.hit_rate() > 0.0 && statistics.hit_rate() < 1.0, "{statistics:?}");
    // Four workers where one was planned for, each with sixteen tiles of its own and one at hand.
    assert!(statistics.most <= limit + 4 * 17 * (16 << 10), "{statistics:?}");
    assert!(statistics.used <= limit, "{statistics:?}");
    drop(tiles);
    assert_eq!((memory.statistics().used, memory.statistics().total), (0, 0));
}

#[test]
fn textures_that_fit_are_held_whole() {
    let folder = Folder::new("fits");
    let request = folder.picture("a.png", &bytes(90, 80, 3, 8), ColourSpace::Auto);
    let maps = paged(std::slice::from_ref(&request), &TextureMemory::new(1 << 20, 1), &folder.cache());
    assert!(!maps[0].is_paged());
    let bits = |map: &MipMap| map.words.iter().map(|word| word.to_bits()).collect::<Vec<_>>();
    assert!(bits(&maps[0]) == bits(&load(&request, &never()).unwrap()));
}

/// Spoils what is in the middle of a file.
fn damage(path: &Path) {
    let mut bytes = fs::read(path).unwrap();
    let middle = bytes.len() / 2;
    bytes[middle - 400..middle + 400].iter_mut().for_each(|byte| *byte = !*byte);
    fs::write(path, bytes).unwrap();
}

#[test]
fn damaged_tiles_are_made_anew() {
    let folder = Folder::new("damage");
    let image = bytes(200, 180, 3, 8);
    let request = folder.picture("a.png", &image, ColourSpace::Auto);
    let whole = table_of(build(&image, ColourSpace::Auto));
    let again = |memory: &Arc<TextureMemory>| table_of(paged(std::slice::from_ref(&request), memory, &folder.cache())[0].clone());
    let memory = TextureMemory::new(1, 1);
    let sound = {
        again(&memory);
        fs::read(&folder.tile_files()[0]).unwrap()
    };
    // Between two renders, and while one goes on.
    damage(&folder.tile_files()[0]);
    let tiles = again(&memory);
    assert_same(&whole, &tiles, &lookups(300, 2), [Wrap::Repeat; 2], Filter::Trilinear);
    assert!(fs::read(&folder.tile_files()[0]).unwrap() == sound);
    // Cut short, empty, of another kind: found when it is opened.
    for spoilt in [&sound[..sound.len() - 5], &[], b"hello"] {
        fs::write(&folder.tile_files()[0], spoilt).unwrap();
        assert_same(&whole, &again(&memory), &lookups(100, 2), [Wrap::Repeat; 2], Filter::Trilinear);
        assert!(fs::read(&folder.tile_files()[0]).unwrap() == sound);
    }
    assert!(memory.statistics().notes.is_empty());
}

#[test]
fn tiles_that_cannot_be_made_anew_are_black_and_told() {
    let folder = Folder::new("lost");
    let request = folder.picture("a.png", &bytes(200, 180, 3, 8), ColourSpace::Auto);
    let memory = TextureMemory::new(1, 1);
    let map = paged(std::slice::from_ref(&request), &memory, &folder.cache())[0].clone();
    damage(&folder.tile_files()[0]);
    fs::remove_file(folder.0.join("a.png")).unwrap();
    let execution = Execution::detect();
    by_tiles(&table_of(map), execution, &lookups(300, 2), [Wrap::Repeat; 2], Filter::Trilinear);
    let notes = memory.statistics().notes;
    assert_eq!(notes.len(), 1);
    assert!(notes[0].contains("a.png") && notes[0].contains("damaged"), "{notes:?}");
}

#[test]
fn a_limit_below_what_workers_hold_is_told() {
    for (limit, threads, is_short) in
        [(1, 1, true), (512 << 10, 1, false), (512 << 10, 2, true), (64 << 20, 8, false), (u64::MAX, 1, false)]
    {
        assert_eq!(TextureMemory::new(limit, threads).shortage().is_some(), is_short, "{limit} {threads}");
    }
}

#[test]
fn a_changed_picture_is_another() {
    let folder = Folder::new("changed");
    let memory = TextureMemory::new(1, 1);
    let first = folder.picture("a.png", &bytes(90, 80, 3, 8), ColourSpace::Auto);
    paged(&[first], &memory, &folder.cache());
    let image = bytes(91, 80, 3, 9);
    let second = folder.picture("a.png", &image, ColourSpace::Auto);
    let map = paged(&[second], &memory, &folder.cache())[0].clone();
    assert_same(&table_of(build(&image, ColourSpace::Auto)), &table_of(map), &lookups(50, 1), [Wrap::Clamp; 2], Filter::Trilinear);
    assert_eq!(folder.tile_files().len(), 2);
}

#[test]
fn a_folder_that_cannot_be_written_is_told_once_and_the_picture_stays() {
    let folder = Folder::new("readonly");
    // A file where the folder should be.
    fs::write(folder.0.join("cache"), "").unwrap();
    let image = bytes(90, 80, 3, 8);
    let requests = ["a.png", "b.png"].map(|name| folder.picture(name, &image, ColourSpace::Auto));
    let cache = folder.cache();
    let maps = paged(&requests, &TextureMemory::new(1, 1), &cache);
    assert!(cache.take_trouble().unwrap().contains("cache"));
    assert!(cache.take_trouble().is_none());
    assert_same(&table_of(build(&image, ColourSpace::Auto)), &table_of(maps[0].clone()), &lookups(50, 1), [Wrap::Clamp; 2], Filter::Cubic);
}

#[test]
fn old_files_and_parts_of_files_are_cleared_away() {
    let folder = Folder::new("prune");
    let cache = folder.cache();
    let request = folder.picture("a.png", &bytes(90, 80, 3, 8), ColourSpace::Auto);
    paged(&[request], &TextureMemory::new(1, 1), &cache);
    let day = std::time::Duration::from_secs(24 * 3600);
    let put = |name: &str, days: u32| {
        let path = folder.0.join("cache").join(name);
        fs::write(&path, "x").unwrap();
        fs::File::options().append(true).open(&path).unwrap().set_modified(std::time::SystemTime::now() - days * day).unwrap();
        path
    };
    let paths = [put("old.gtiles", 31), put("young.gtiles", 29), put("left.part", 2), put("written.part", 0), put("notes.txt", 99)];
    cache.prune();
    assert_eq!(paths.map(|path| path.exists()), [false, true, false, true, true]);
    assert_eq!(folder.tile_files().len(), 4);
}
