//! Measured materials.

use crate::Reader;
use gonio_formats::bsdf::gbsdf::{self, Encoding};
use gonio_formats::bsdf::{
    Axis, Band, Basis, Channels, Component, Coordinates, Hemispheres, Layout, Matrix, Measured, Mode, Patches, Resolution, Rgl, RglGrid,
    Sampler, Table, TensorTree, Tree, merl, read, utia, xml, zemax,
};

/// The readers, and everything that is done with what they give.
pub(crate) fn readers() -> Vec<Reader> {
    vec![
        Reader { name: "merl", seeds: merl_seeds, read: |bytes| merl::read(bytes).is_ok(), memory: 1 << 20 },
        // Every file of the one right size is read whole; the database's own grid is added to.
        Reader { name: "utia", seeds: utia_seeds, read: |bytes| utia::read(bytes).is_ok(), memory: 16 << 20 },
        Reader { name: "rgl", seeds: rgl_seeds, read: |bytes| Rgl::read(bytes).is_ok(), memory: 1 << 20 },
        Reader { name: "pbrdf", seeds: pbrdf_seeds, read: |bytes| read(bytes, "").is_ok(), memory: 1 << 20 },
        Reader { name: "bsdf-xml", seeds: xml_seeds, read: |bytes| xml::read(bytes).is_ok(), memory: 1 << 20 },
        Reader {
            name: "zemax",
            seeds: zemax_seeds,
            read: |bytes| std::str::from_utf8(bytes).is_ok_and(|text| zemax::read(text).is_ok()),
            memory: 1 << 20,
        },
        Reader { name: "gbsdf", seeds: gbsdf_seeds, read: |bytes| gbsdf::read(bytes).is_ok(), memory: 1 << 20 },
        // Sampling tables have a size of their own.
        Reader { name: "measured", seeds: all_seeds, read: |bytes| read(bytes, "").map(|m| use_all(&m)).is_ok(), memory: 64 << 20 },
    ]
}

/// Calls everything that takes a measurement.
fn use_all(measured: &Measured) {
    let mut values = vec![0.0; measured.channels().count()];
    let directions = [[0.0, 0.0, 1.0], [0.6, 0.0, 0.8], [0.0, -0.96, 0.28], [0.0, 0.6, -0.8], [0.0, 0.0, -1.0], [1.0, 0.0, 0.0]];
    let coarse = Resolution { theta: 2, phi: 1, columns: 4, rows: 4, points: 1, cosine_share: 0.1 };
    let sampler = Sampler::new(measured, &coarse);
    for wo in directions {
        for wi in directions {
            measured.eval(wi, wo, &mut values);
            assert!(values.iter().all(|v| *v >= 0.0), "values {values:?}");
            assert!(sampler.pdf(wo, wi) >= 0.0, "density {}", sampler.pdf(wo, wi));
        }
        for u in [[0.0; 3], [0.5; 3], [0.999_999; 3]] {
            let sample = sampler.sample(wo, u);
            assert!(sample.is_none_or(|s| s.pdf > 0.0 && s.wi.iter().all(|x| x.is_finite())), "sample {sample:?}");
        }
    }
}

fn all_seeds() -> Vec<Vec<u8>> {
    [merl_seeds, rgl_seeds, pbrdf_seeds, xml_seeds, zemax_seeds, gbsdf_seeds].into_iter().flat_map(|seeds| seeds()).collect()
}

fn merl_seeds() -> Vec<Vec<u8>> {
    let write = |bins: [usize; 3]| {
        let layout = merl::layout(bins).ok()?;
        let values = vec![0.1; layout.value_count().ok()?];
        merl::write(&Table::new(layout, values).ok()?).ok()
    };
    let mut seeds: Vec<Vec<u8>> = [[2, 3, 4], [1, 1, 1], [1, 2, 360]].into_iter().filter_map(write).collect();
    // A header that claims forty gigabytes.
    let mut huge: Vec<u8> = [1400_i32, 1400, 850].iter().flat_map(|n| n.to_le_bytes()).collect();
    huge.resize(100, 0);
    seeds.push(huge);
    seeds
}

fn utia_seeds() -> Vec<Vec<u8>> {
    let write = || {
        let layout = utia::layout().ok()?;
        let values = vec![0.2; layout.value_count().ok()?];
        utia::write(&Table::new(layout, values).ok()?).ok()
    };
    write().into_iter().collect()
}

fn rgl_seeds() -> Vec<Vec<u8>> {
    let grids = [RglGrid::isotropic(3, 1.4, [6, 5], 4), RglGrid::anisotropic(4, 2, 1.4, [5, 6], 3)];
    let lambertian = |wi: [f64; 3], _| [0.1, 0.2, 0.3].map(|rho| rho * wi[2].max(0.0));
    grids.iter().filter_map(|grid| Rgl::from_function(grid, "a seed", lambertian).ok()).map(|rgl| rgl.write()).collect()
}

/// A polarised file of one matrix for each of two wavelengths, with axes and without.
fn pbrdf_seeds() -> Vec<Vec<u8>> {
    let file = |axis_length: u64| {
        let fields: [(&str, u8, &[u64], usize); 5] = [
            ("theta_d", 10, &[1, axis_length], 4 * axis_length as usize),
            ("theta_h", 10, &[1, axis_length], 4 * axis_length as usize),
            ("phi_d", 10, &[1, axis_length], 4 * axis_length as usize),
            ("wvls", 3, &[2], 4),
            ("M", 10, &[1, 1, 1, 2, 4, 4], 128),
        ];
        let header: usize = 18 + fields.iter().map(|f| 13 + f.0.len() + 8 * f.2.len()).sum::<usize>();
        let mut bytes = b"tensor_file\0\x01\0\x05\0\0\0".to_vec();
        let mut offset = header as u64;
        for (name, kind, shape, size) in fields {
            bytes.extend((name.len() as u16).to_le_bytes());
            bytes.extend(name.as_bytes());
            bytes.extend((shape.len() as u16).to_le_bytes());
            bytes.push(kind);
            bytes.extend(offset.to_le_bytes());
            shape.iter().for_each(|n| bytes.extend(n.to_le_bytes()));
            offset += size as u64;
        }
        (0..3 * axis_length).for_each(|_| bytes.extend(0.5_f32.to_le_bytes()));
        [450_u16, 650].iter().for_each(|w| bytes.extend(w.to_le_bytes()));
        (0..32).for_each(|i| bytes.extend((0.01 * i as f32).to_le_bytes()));
        bytes
    };
    vec![file(0), file(1)]
}

fn xml_seeds() -> Vec<Vec<u8>> {
    let patches = || {
        let bases = vec![Basis::new("rings", &[0.0, 30.0, 90.0], &[1, 3]).ok()?];
        let matrix = |pair, band| Matrix::new(pair, band, 0, 0, vec![0.25; 16]);
        let matrices = vec![matrix(Hemispheres::ReflectionFront, Band::Visible), matrix(Hemispheres::TransmissionBack, Band::CieX)];
        Some(xml::write_patches(&Patches::new(bases, matrices).ok()?, "a seed").into_bytes())
    };
    let tree = |rank: u32| {
        let children = 1_u32 << rank;
        let leaves = children as usize;
        let first = core::iter::once(1).chain(0..children).collect();
        let log2 = core::iter::once(-1).chain(core::iter::repeat_n(0, leaves)).collect();
        let tree = Tree { rank, first, log2, values: vec![0.2; leaves] };
        let component = |hemispheres| Component { hemispheres, band: Band::Visible, tree: tree.clone() };
        let pairs = [Hemispheres::ReflectionFront, Hemispheres::TransmissionBack];
        Some(xml::write_tree(&TensorTree::new(pairs.map(component).to_vec()).ok()?, "a seed").into_bytes())
    };
    [patches(), tree(3), tree(4)].into_iter().flatten().collect()
}

/// A table of three angles along each axis.
fn table(coordinates: Coordinates, channels: Channels) -> Option<Table> {
    let axes = coordinates.axis_names().iter().map(|_| Axis::uniform(0.0, 1.2, 3, Mode::Linear)).collect::<Result<_, _>>().ok()?;
    let hemispheres = Hemispheres::ReflectionFront;
    let layout = Layout { coordinates, axes, channels, hemispheres, reciprocal: true, bilateral: true };
    let values = vec![0.25; layout.value_count().ok()?];
    Table::new(layout, values).ok()
}

fn zemax_seeds() -> Vec<Vec<u8>> {
    let write = |channels| Some(zemax::write(&table(Coordinates::Specular, channels)?).ok()?.into_bytes());
    [Channels::Luminance, Channels::Xyz].into_iter().filter_map(write).collect()
}

fn gbsdf_seeds() -> Vec<Vec<u8>> {
    let kinds = [(Coordinates::Isotropic, Channels::Rgb), (Coordinates::HalfDifference, Channels::Luminance)];
    let tables = kinds.into_iter().filter_map(|(coordinates, channels)| table(coordinates, channels));
    tables.flat_map(|table| [Encoding::Text, Encoding::Binary].map(|e| gbsdf::write(std::slice::from_ref(&table), "a seed", e))).collect()
}
