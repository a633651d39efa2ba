//! Files that the crate writes, read back; damaged ones.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use gonio_volume::{Grid, GridClass, Packing, Sampler, Storage, Tile, Transform, Values, VolumeFile, from_bytes, to_bytes};
use half::f16;

const SHAPE: [usize; 3] = [17, 9, 20];

fn values() -> Vec<f32> {
    let inside = |n: usize| !n.is_multiple_of(3) && n < 2000;
    (0..SHAPE.iter().product()).map(|n| if inside(n) { n as f32 / 64.0 } else { 0.0 }).collect()
}

/// Bricks, and a tile of each size.
fn grid() -> Grid {
    let transform = Transform([[0.5, 0.0, 0.1, 0.0], [0.0, 0.25, 0.0, 0.0], [-0.1, 0.0, 0.5, 0.0], [1.0, -2.0, 3.0, 1.0]]);
    let mut grid = Grid::from_dense("density", &values(), SHAPE, transform).unwrap();
    grid.tiles = vec![
        Tile { origin: [-4096, 0, 0], log2_edge: 12, active: true, value: [0.25; 3] },
        Tile { origin: [128, 0, 0], log2_edge: 7, active: false, value: [-1.0; 3] },
        Tile { origin: [64, 8, 0], log2_edge: 3, active: true, value: [2.0; 3] },
    ];
    grid
}

fn halves(grid: &Grid) -> Grid {
    Grid { values: Values::Half((0..grid.values.len()).map(|n| f16::from_f32(grid.values.get(n)[0])).collect()), ..grid.clone() }
}

fn vectors(grid: &Grid) -> Grid {
    let values = (0..grid.values.len()).map(|n| grid.values.get(n)[0]).map(|x| [x, -x, 0.5 * x]).collect();
    let tiles = grid.tiles.iter().map(|tile| Tile { value: [1.0, 2.0, 3.0], ..*tile }).collect();
    Grid { name: "velocity".into(), values: Values::Vector(values), tiles, background: [0.0, 0.5, 1.0], ..grid.clone() }
}

fn file(grids: &[&Grid], packing: Packing) -> VolumeFile {
    from_bytes(to_bytes(grids, packing).unwrap(), "test.vdb").unwrap()
}

/// Grids are equal but for what the writer says of them, and the order of tiles.
fn assert_same(read: &Grid, written: &Grid) {
    let sorted = |grid: &Grid| {
        let mut tiles = grid.tiles.clone();
        tiles.sort_by_key(|tile| tile.origin);
        Grid { tiles, metadata: Vec::new(), ..grid.clone() }
    };
    assert_eq!(sorted(read), sorted(written));
}

#[test]
fn what_is_written_is_read_back() {
    let float = grid();
    let grids = [float.clone(), halves(&float), vectors(&float)];
    for packing in [Packing::None, Packing::Zip] {
        let file = file(&[&grids[0], &grids[1], &grids[2]], packing);
        let kinds: Vec<&str> = file.grids().iter().map(|info| info.value_type.as_str()).collect();
        assert_eq!(kinds, ["float", "float (half)", "vec3s"]);
        for (index, grid) in grids.iter().enumerate() {
            assert_same(&file.read(index).unwrap(), grid);
        }
    }
}

#[test]
fn the_list_tells_what_is_read() {
    let file = file(&[&grid()], Packing::Zip);
    let (info, read) = (&file.grids()[0], file.read_named("density").unwrap());
    assert_eq!((info.class, info.storage), (GridClass::FogVolume, Storage::Float));
    assert_eq!(info.memory, read.memory());
    let active = values().iter().filter(|value| **value != 0.0).count() as u64;
    assert_eq!(info.active_voxels, active + 512 + (1 << 36));
    assert_eq!(info.bounds, Some([[-4096, 0, 0], [71, 4095, 4095]]));
    assert_eq!((info.active_voxels, info.bounds), (read.active_voxels(), read.bounds()));
    assert_eq!(info.compression, "zip + active values");
    assert!(file.format().starts_with("OpenVDB 224"), "{}", file.format());
}

#[test]
fn dense_arrays_keep_their_values_and_leave_zeros_out() {
    let values = values();
    let grid = Grid::from_dense("a", &values, SHAPE, Transform::uniform(0.1, [0.0; 3])).unwrap();
    // 2000 values fill x = 0 to 11: two of three bricks along x, and two and three along y and z.
    assert_eq!(grid.bricks.len(), 2 * 2 * 3);
    let sampler = Sampler::new(&grid);
    for (n, value) in values.iter().enumerate() {
        let voxel = [n / (SHAPE[1] * SHAPE[2]), n / SHAPE[2] % SHAPE[1], n % SHAPE[2]].map(|x| x as i32);
        assert_eq!(sampler.value(voxel), [*value; 3]);
        assert_eq!(sampler.is_active(voxel), *value != 0.0);
    }
    assert_eq!(grid.transform.point([1.0, 2.0, 3.0]), [0.1, 0.2, 0.1 * 3.0]);
    let problem = Grid::from_dense("a", &values, [1, 2, 3], grid.transform).unwrap_err().to_string();
    assert_eq!(problem, "grid 'a': 3060 values, expected 1 × 2 × 3");
    let problem = Grid::from_dense("a", &[0.0, f32::NAN], [1, 1, 2], grid.transform).unwrap_err().to_string();
    assert_eq!(problem, "grid 'a': the value at [0, 0, 1] is NaN, expected a finite number");
}

/// A linear function is its own trilinear interpolation.
#[test]
fn a_linear_function_is_interpolated_exactly() {
    let shape = [12, 10, 9];
    let linear = |p: [f64; 3]| 1.0 + p[0] - 0.5 * p[1] + 0.25 * p[2];
    let voxel = |n: usize| [n / (shape[1] * shape[2]), n / shape[2] % shape[1], n % shape[2]].map(|x| x as f64);
    let values: Vec<f32> = (0..shape.iter().product()).map(|n| linear(voxel(n)) as f32).collect();
    let grid = Grid::from_dense("a", &values, shape, Transform::uniform(1.0, [0.0; 3])).unwrap();
    let sampler = Sampler::new(&grid);
    for n in 0..1000 {
        let part = |step: f64, length: usize| (f64::from(n) * step).fract() * (length - 1) as f64;
        let point = [part(0.618, shape[0]), part(0.7548, shape[1]), part(0.5698, shape[2])];
        assert!((sampler.trilinear(point)[0] - linear(point)).abs() < 1e-12, "{point:?}");
    }
    // Half-way to the background.
    assert_eq!(sampler.trilinear([-0.5, 0.0, 0.0])[0], 0.5);
    assert_eq!(sampler.trilinear([f64::NAN, 0.0, 0.0]), [0.0; 3]);
    assert_eq!(sampler.trilinear([1e300, 0.0, 0.0]), [0.0; 3]);
}

/// Against the values of all voxels that a block's cells touch, one by one.
#[test]
fn ranges_are_those_of_all_voxels() {
    let grid = grid();
    let sampler = Sampler::new(&grid);
    let ranges = sampler.ranges();
    assert!(ranges.iter().any(|range| range.origin == [-8, -8, -8]), "the neighbours' last cells reach in");
    for range in &ranges {
        let voxels = (0..729).map(|n| [n / 81, n / 9 % 9, n % 9]);
        let all = voxels.map(|v| sampler.value([0, 1, 2].map(|axis| range.origin[axis] + v[axis]))[0]);
        let (min, max) = all.fold((f32::INFINITY, f32::NEG_INFINITY), |(min, max), x| (min.min(x), max.max(x)));
        assert_eq!((range.min[0], range.max[0]), (min, max), "{:?}", range.origin);
    }
    let beside_tile = sampler.range([56, 0, 0]);
    assert_eq!((beside_tile.min[0], beside_tile.max[0]), (0.0, 2.0));
}

#[test]
fn files_that_are_cut_off_are_told_with_the_byte() {
    for packing in [Packing::None, Packing::Zip] {
        let bytes = to_bytes(&[&grid(), &vectors(&grid())], packing).unwrap();
        for length in (0..bytes.len()).step_by(bytes.len() / 97) {
            let error = from_bytes(&bytes[..length], "cut.vdb").unwrap_err().to_string();
            assert!(error.starts_with("cut.vdb"), "{error}");
            assert!(length < 8 || error.contains(", byte "), "{error}");
        }
    }
}

#[test]
fn a_damaged_grid_does_not_spoil_the_others() {
    let mut bytes = to_bytes(&[&grid(), &vectors(&grid())], Packing::None).unwrap();
    let at = bytes.windows(9).position(|window| window == b"AffineMap").unwrap();
    bytes[at] = b'B';
    let file = from_bytes(bytes, "damaged.vdb").unwrap();
    let refused = file.grids()[0].refused.clone().unwrap();
    assert!(refused.contains("BffineMap"), "{refused}");
    assert!(file.read(0).unwrap_err().to_string().contains("density"));
    assert_same(&file.read(1).unwrap(), &vectors(&grid()));
}

/// Headers that claim terabytes, and counts below zero.
#[test]
fn absurd_claims_are_refused() {
    let good = to_bytes(&[&grid()], Packing::None).unwrap();
    let with = |at: usize, bytes: &[u8]| {
        let mut broken = good.clone();
        broken[at..at + bytes.len()].copy_from_slice(bytes);
        from_bytes(broken, "absurd.vdb")
    };
    // After the header of 57 bytes: metadata's count, grids' count, the length of a name; the version before.
    assert!(with(57, &u32::MAX.to_le_bytes()).unwrap_err().to_string().contains("metadata takes 51539607540 bytes"));
    assert!(with(61, &(-1i32).to_le_bytes()).unwrap_err().to_string().contains("a file of -1 grids"));
    assert!(with(61, &i32::MAX.to_le_bytes()).unwrap_err().to_string().contains("truncated or damaged"));
    assert!(with(65, &u32::MAX.to_le_bytes()).unwrap_err().to_string().contains("a name of 4294967295 bytes"));
    assert!(with(8, &219u32.to_le_bytes()).unwrap_err().to_string().contains("versions 220 to 225"));
    assert!(with(0, b"x").unwrap_err().to_string().contains("neither an OpenVDB nor a NanoVDB file"));
    // The offset of the grid's end, after its name, type and parent.
    let end = 65 + 4 + 7 + 4 + 16 + 4 + 16;
    assert!(with(end, &(2i64 << 40).to_le_bytes()).unwrap_err().to_string().contains("ends at byte 2199023255552, but the file has"));
    assert!(with(end, &(-1i64).to_le_bytes()).unwrap_err().to_string().contains("before it begins"));
    let file = with(good.windows(9).position(|w| w == b"AffineMap").unwrap() + 9, &f64::NAN.to_le_bytes()).unwrap();
    assert!(file.grids()[0].refused.as_ref().is_some_and(|problem| problem.contains("not finite")));
}

#[test]
fn grids_of_one_name_and_missing_ones() {
    let (one, mut two) = (grid(), grid());
    two.background = [1.0; 3];
    let file = file(&[&one, &two], Packing::None);
    assert_eq!(file.grids().iter().map(|info| info.name.as_str()).collect::<Vec<_>>(), ["density", "density"]);
    assert_eq!(file.read(1).unwrap().background, [1.0; 3]);
    assert_eq!(file.read_named("heat").unwrap_err().to_string(), "test.vdb: there is no grid 'heat'; it has density, density");
    let mut twice = grid();
    twice.bricks[1].origin = twice.bricks[0].origin;
    assert!(to_bytes(&[&twice], Packing::None).unwrap_err().to_string().contains("two bricks or tiles at [0, 0, 0]"));
}
