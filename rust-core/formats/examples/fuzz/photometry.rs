//! IES, EULUMDAT and TM-33.

use crate::Reader;
use gonio_formats::photometry::{Goniogram, PolarUnit, Symmetry, cone_diagram, ies, ldt, polar_diagram, read, tm33};

/// The readers, and everything that is done with what they give.
pub(crate) fn readers() -> Vec<Reader> {
    vec![
        // A file of tilt factors is as hostile as the one that names it.
        Reader {
            name: "ies",
            seeds: ies_seeds,
            read: |bytes| ies::read_with(bytes, &mut |_| Ok(tilt_file(bytes))).is_ok(),
            memory: 1 << 20,
        },
        Reader { name: "ldt", seeds: ldt_seeds, read: |bytes| ldt::read(bytes).is_ok(), memory: 1 << 20 },
        Reader { name: "tm33", seeds: tm33_seeds, read: |bytes| tm33::read(bytes).is_ok() | tm33::spectra(bytes).is_ok(), memory: 1 << 20 },
        // Resampling to type C has a grid of its own size.
        Reader {
            name: "goniogram",
            seeds: all_seeds,
            read: |bytes| read(bytes, "").map(|goniogram| use_all(&goniogram)).is_ok(),
            memory: 64 << 20,
        },
    ]
}

/// The lines behind the first one that names a file of tilt factors.
fn tilt_file(bytes: &[u8]) -> Vec<u8> {
    bytes.split_inclusive(|byte| *byte == b'\n').skip_while(|line| !line.starts_with(b"TILT=")).skip(1).flatten().copied().collect()
}

/// Calls everything that takes a goniogram.
fn use_all(goniogram: &Goniogram) {
    let figures = goniogram.figures();
    assert!(figures.flux.is_finite() && figures.flux >= -1e-9 * figures.peak, "flux {}", figures.flux);
    for direction in [[0.0, 0.0, -1.0], [0.3, -0.5, 0.7], [1.0, 0.0, 0.0]] {
        let intensity = goniogram.intensity(direction);
        assert!(intensity >= 0.0 && intensity <= figures.peak * (1.0 + 1e-12), "intensity {intensity}");
    }
    let grid = goniogram.expanded();
    assert_eq!(grid.intensities.len(), grid.horizontal.len() * grid.vertical.len(), "the grid's size");
    for symmetry in [Symmetry::None, Symmetry::Rotational, Symmetry::AboutC0, Symmetry::AboutC90, Symmetry::Quadrants] {
        drop(goniogram.symmetrised(symmetry));
    }
    drop([goniogram.rotated(90.0), goniogram.rotated(12.3)]);
    drop([goniogram.scaled_to_flux(1000.0), goniogram.with_lamp_set(1)]);
    drop([polar_diagram(goniogram, PolarUnit::CandelaPerKilolumen), polar_diagram(goniogram, PolarUnit::Candela), cone_diagram(goniogram)]);
    drop([ies::read(&ies::write(goniogram)), ldt::read(&ldt::write(goniogram)), tm33::read(&tm33::write(goniogram, true))]);
}

fn all_seeds() -> Vec<Vec<u8>> {
    [ies_seeds(), ldt_seeds(), tm33_seeds()].concat()
}

fn ies_seeds() -> Vec<Vec<u8>> {
    let files = [
        ("IESNA:LM-63-2002", "TILT=NONE", 1, "0.3 1.2 0", "0 45 90", "0 45 90"),
        ("IESNA91", "TILT=INCLUDE\n1\n3\n0 45 90\n1 0.9 0.8", 1, "-0.2 0 0", "0 30 60 90 180", "0 60 180"),
        ("IES:LM-63-2019", "TILT=lamp.tlt", 1, "-0.2 -0.2 -0.2", "0 90 180", "90 180 270"),
        ("", "TILT=NONE", 2, "0 0 0", "-90 0 90", "-90 -45 0 45 90"),
        ("IESNA:LM-63-1995", "TILT=NONE", 3, "0 1 -0.1", "0 10 90", "0 20 90"),
        ("IESNA:LM-63-1995", "TILT=NONE", 1, "0 0 0", "0 10 90", "0 120 240 360"),
        ("IESNA:LM-63-1995", "TILT=NONE", 1, "0 0 0", "0 10 90", "0"),
    ];
    let write = |(version, tilt, photometric_type, opening, vertical, horizontal): (&str, &str, u32, &str, &str, &str)| {
        let (v, h) = (vertical.split(' ').count(), horizontal.split(' ').count());
        let candela: String = (0..v * h).map(|index| format!("{} ", 100 + index * index % 37)).collect();
        let head = format!("{version}\n[MANUFAC] maker\n{tilt}\n1 1000 1 {v} {h} {photometric_type} 2 {opening}\n1 1 20\n");
        (head + &format!("{vertical}\n{horizontal}\n{candela}\n")).into_bytes()
    };
    files.map(write).into_iter().collect()
}

fn tm33_seeds() -> Vec<Vec<u8>> {
    let write = |bytes: Vec<u8>| ies::read(&bytes).map(|goniogram| tm33::write(&goniogram, false));
    let areas = "<EmissionAreas><BottomFace><NumberBottom>1</NumberBottom><BottomArea><Length>600</Length><Width>300</Width>\
                 <Circular>true</Circular></BottomArea></BottomFace></EmissionAreas></Emitter>";
    let with_areas = |bytes: Vec<u8>| String::from_utf8_lossy(&bytes).replace("</Emitter>", areas).into_bytes();
    let points: String = (0..21).map(|k| format!("<PwrData w=\"{}\">1.5</PwrData>\n", 380 + 20 * k)).collect();
    let spectral = format!("<SpectralData><EmitterSpectral>{points}</EmitterSpectral></SpectralData></Emitter>");
    let radiant = "<RadiantData><MinWavelength>380</MinWavelength><MaxWavelength>780</MaxWavelength><RadiantIntensity>";
    let in_watts = |bytes: &Vec<u8>| {
        let text = String::from_utf8_lossy(bytes).replace("</Emitter>", &spectral);
        text.replace("<LuminousData>\n<LuminousIntensity>", radiant)
            .replace("LuminousIntensity", "RadiantIntensity")
            .replace("</LuminousData>", "</RadiantData>")
            .into_bytes()
    };
    let luminous: Vec<Vec<u8>> = ies_seeds().into_iter().filter_map(|bytes| write(bytes).ok()).map(with_areas).collect();
    luminous.iter().map(in_watts).chain(luminous.clone()).collect()
}

fn ldt_seeds() -> Vec<Vec<u8>> {
    let stored = [8, 1, 5, 5, 3];
    let write = |symmetry: usize| {
        let mut lines: Vec<String> =
            vec!["maker".into(), "1".into(), symmetry.to_string(), "8".into(), "45".into(), "4".into(), "30".into()];
        lines.extend(
            "report;name;number;file;date;1200;300;80;1150;250;0;0;0;0;100;80;1,0;0;2;1;LED;1000;3000;80;10;-2;LED;2500;4000;90;25"
                .split(';')
                .map(String::from),
        );
        lines.extend((0..10).map(|index| format!("0.{index}")));
        lines.extend((0..8).map(|index| (index * 45).to_string()).chain((0..4).map(|index| (index * 30).to_string())));
        lines.extend((0..stored[symmetry] * 4).map(|index| (100 + index * index % 37).to_string()));
        lines.join("\r\n").into_bytes()
    };
    (0..5).map(write).collect()
}
