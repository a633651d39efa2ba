//! TM-25.

use crate::{RAYS, are_the_rays, close};
use gonio_formats::bsdf::cie_1931;
use gonio_formats::rays::{FluxUnit, RayColour, RayFormat, Spectrum, read, tm25};

/// What a file is made of.
struct File {
    lumens: f32,
    watts: f32,
    rays: u64,
    spectral: i32,
    wavelength: f32,
    spectra: Vec<Vec<[f32; 2]>>,
    further: i32,
    text: i32,
    flags: [i32; 8],
    data: Vec<f32>,
}

impl Default for File {
    fn default() -> Self {
        Self {
            lumens: 100.0,
            watts: f32::NAN,
            rays: 3,
            spectral: 0,
            wavelength: f32::NAN,
            spectra: Vec::new(),
            further: 0,
            text: 0,
            flags: [1, 1, 0, 0, 1, 0, 0, 0],
            data: RAYS.as_flattened().to_vec(),
        }
    }
}

impl File {
    fn bytes(&self) -> Vec<u8> {
        let mut bytes = b"TM25".to_vec();
        let int = |bytes: &mut Vec<u8>, value: i32| bytes.extend(value.to_le_bytes());
        let float = |bytes: &mut Vec<u8>, value: f32| bytes.extend(value.to_le_bytes());
        int(&mut bytes, 2013);
        int(&mut bytes, 1);
        float(&mut bytes, self.lumens);
        float(&mut bytes, self.watts);
        bytes.extend(self.rays.to_le_bytes());
        bytes.extend(b"2013-09-04T08:30:29+01:00\0\0\0");
        int(&mut bytes, 0);
        int(&mut bytes, self.spectral);
        [self.wavelength, 380.0, 780.0].iter().for_each(|value| float(&mut bytes, *value));
        int(&mut bytes, self.spectra.len() as i32);
        int(&mut bytes, self.further);
        int(&mut bytes, self.text);
        bytes.resize(256, 0);
        self.flags.iter().for_each(|flag| int(&mut bytes, *flag));
        for text in ["a lamp", "a maker", "", "", "", "", "", "", "unknown"] {
            let end = bytes.len() + 4000;
            text.chars().for_each(|c| bytes.extend(u32::from(c).to_le_bytes()));
            bytes.resize(end, 0);
        }
        assert_eq!(bytes.len(), 36_288);
        for spectrum in &self.spectra {
            int(&mut bytes, spectrum.len() as i32);
            spectrum.iter().flatten().for_each(|value| float(&mut bytes, *value));
        }
        bytes.resize(bytes.len().next_multiple_of(32), 0);
        bytes.resize(bytes.len() + 512 * self.further.max(0) as usize + self.text.max(0) as usize, b' ');
        self.data.iter().for_each(|value| float(&mut bytes, *value));
        bytes
    }
}

/// The rays with more numbers behind each.
fn with(more: &[&[f32]]) -> Vec<f32> {
    RAYS.iter().zip(more).flat_map(|(ray, more)| ray.iter().chain(*more).copied().collect::<Vec<f32>>()).collect()
}

fn lumens(watts: f64, nanometres: f64) -> f64 {
    683.0 * watts * cie_1931(nanometres)[1]
}

#[test]
fn luminous_rays_have_the_stated_flux() {
    let file = read(&File::default().bytes(), "", false).unwrap();
    assert_eq!((file.format, file.unit, file.description.as_str()), (RayFormat::Tm25, FluxUnit::Lumens, "a lamp, a maker"));
    are_the_rays(&file, 1e-3, 100.0);
    assert_eq!(file.warnings[0].problem, "the rays' fluxes add up to 8, the head states 100: that is taken");
    let unstated = read(&File { lumens: f32::NAN, ..File::default() }.bytes(), "", false).unwrap();
    are_the_rays(&unstated, 1e-3, 8.0);
    assert_eq!(unstated.warnings, []);
    let extended = File { further: 2, text: 64, data: with(&[&[1.0, f32::NAN], &[2.0, 2.0], &[3.0, 3.0]]), ..File::default() };
    are_the_rays(&read(&extended.bytes(), "", false).unwrap(), 1e-3, 100.0);
}

#[test]
fn radiant_rays_become_lumens_by_their_colour() {
    let radiant = [1, 1, 1, 0, 0, 0, 0, 0];
    let none = File { lumens: f32::NAN, watts: 8.0, flags: radiant, ..File::default() };
    let file = read(&none.bytes(), "", false).unwrap();
    assert_eq!(file.unit, FluxUnit::Watts);
    are_the_rays(&file, 1e-3, 8.0);
    let single = read(&File { spectral: 1, wavelength: 600.0, ..none }.bytes(), "", false).unwrap();
    assert_eq!((single.unit, &single.colour), (FluxUnit::Lumens, &RayColour::Wavelength(600.0)));
    are_the_rays(&single, 1e-3, lumens(8.0, 600.0));
    let each = File {
        lumens: f32::NAN,
        watts: 16.0,
        spectral: 2,
        flags: [1, 1, 1, 1, 0, 0, 0, 0],
        data: with(&[&[450.0], &[550.0], &[650.0]]),
        ..File::default()
    };
    let file = read(&each.bytes(), "", false).unwrap();
    // The head states twice the rays' sum.
    are_the_rays(&file, 1e-3, 2.0 * (lumens(2.0, 450.0) + lumens(1.0, 550.0) + lumens(5.0, 650.0)));
    assert_eq!(file.colour, RayColour::Wavelengths(vec![450.0, 550.0, 650.0]));
    assert!(file.fluxes[0] < file.fluxes[1]);
}

#[test]
fn spectra_are_read() {
    let radiant = [1, 1, 1, 0, 0, 0, 0, 0];
    let spectra = vec![vec![[400.0, 0.0], [500.0, 1.0], [600.0, 0.0]], vec![[500.0, 1.0], [700.0, 1.0]]];
    let one = File { lumens: 60.0, watts: 0.4, spectral: 3, spectra: spectra[..1].to_vec(), flags: radiant, ..File::default() };
    let file = read(&one.bytes(), "", false).unwrap();
    are_the_rays(&file, 1e-3, 60.0);
    let triangle = Spectrum { wavelengths: vec![400.0, 500.0, 600.0], weights: vec![0.0, 1.0, 0.0] };
    assert_eq!(file.colour, RayColour::Spectrum(triangle.clone()));
    let unstated = read(&File { lumens: f32::NAN, watts: 0.4, ..one }.bytes(), "", false).unwrap();
    are_the_rays(&unstated, 1e-3, 0.4 * triangle.efficacy());
    // An independent sum over whole nanometres.
    let hat = |nanometre: u32| (100.0 - f64::from(nanometre.abs_diff(500))) / 100.0;
    let sum = (400..=600).map(|nanometre| hat(nanometre) * lumens(1.0, nanometre.into())).sum::<f64>() / 100.0;
    close(triangle.efficacy(), sum, 1e-3);
    let two = File {
        lumens: f32::NAN,
        watts: 8.0,
        spectral: 4,
        spectra,
        flags: [1, 1, 1, 0, 0, 0, 0, 1],
        data: with(&[&[1.0], &[2.0], &[1.0]]),
        ..File::default()
    };
    let file = read(&two.bytes(), "", false).unwrap();
    let RayColour::Spectra { spectra, index } = &file.colour else { panic!("expected spectra") };
    assert_eq!((spectra.len(), &index[..]), (2, &[0, 1, 0][..]));
    are_the_rays(&file, 1e-3, 7.0 * triangle.efficacy() + spectra[1].efficacy());
}

#[test]
fn tristimulus_values_are_read_past_polarisation() {
    let ray = |index: usize| {
        let mut ray = RAYS[index].to_vec();
        // Polarisation, and then X and Z.
        ray.extend([f32::NAN; 6]);
        ray.extend([0.5 * RAYS[index][6], 0.25]);
        ray
    };
    let data = (0..3).flat_map(ray).collect();
    let file = read(&File { lumens: 16.0, flags: [1, 1, 0, 0, 1, 1, 1, 0], data, ..File::default() }.bytes(), "", false).unwrap();
    are_the_rays(&file, 1e-3, 16.0);
    assert_eq!(file.colour, RayColour::Tristimulus(vec![[2.0, 4.0, 0.5], [1.0, 2.0, 0.5], [5.0, 10.0, 0.5]]));
}

#[test]
fn every_colour_comes_back() {
    let base = read(&File { lumens: 8.0, ..File::default() }.bytes(), "", false).unwrap();
    let spectrum = Spectrum { wavelengths: vec![400.0, 555.0, 700.0], weights: vec![0.1, 1.0, 0.3] };
    let spectra = vec![spectrum.clone(), Spectrum { wavelengths: vec![500.0, 600.0], weights: vec![1.0, 2.0] }];
    let colours = [
        RayColour::Unknown,
        RayColour::Wavelength(530.0),
        RayColour::Wavelengths(vec![450.0, 530.0, 620.0]),
        RayColour::Tristimulus(vec![[1.0, 2.0, 3.0], [1.0, 1.0, 1.0], [5.0, 5.0, 0.0]]),
        RayColour::Spectrum(spectrum),
        RayColour::Spectra { spectra, index: vec![1, 0, 1] },
    ];
    for colour in colours {
        let file = gonio_formats::rays::RayFile { colour, ..base.clone() };
        let again = read(&tm25::write(&file).unwrap(), "", false).unwrap();
        assert_eq!((&again.colour, again.unit, &again.warnings[..]), (&file.colour, FluxUnit::Lumens, &[][..]));
        assert_eq!((&again.description, again.left_out), (&"a lamp, a maker, gonio".replace(", gonio", ""), 0));
        are_the_rays(&again, 1e-3, 8.0);
        again.fluxes.iter().zip(&file.fluxes).for_each(|(found, expected)| close((*found).into(), (*expected).into(), 1e-5));
    }
}

#[test]
fn heads_that_contradict_themselves_are_refused() {
    let problem = |file: File| read(&file.bytes(), "", false).unwrap_err().problem;
    assert_eq!(problem(File { rays: 1_000_000_000_000, ..File::default() }), "the head states 1000000000000 rays, 3 are there");
    assert_eq!(problem(File { rays: u64::MAX, ..File::default() }), "the head states 18446744073709551615 rays, 3 are there");
    assert_eq!(problem(File { rays: 0, ..File::default() }), "the head states no ray");
    assert!(problem(File { spectral: 7, ..File::default() }).contains("the kind of spectral data is 7"));
    assert!(problem(File { spectral: 1, ..File::default() }).contains("one wavelength"));
    assert!(problem(File { spectral: 2, ..File::default() }).contains("rays have wavelengths"));
    assert!(problem(File { spectral: 3, ..File::default() }).contains("a spectrum"));
    assert!(problem(File { flags: [1, 1, 0, 0, 0, 0, 0, 0], ..File::default() }).contains("no position, direction or flux"));
    assert!(problem(File { flags: [1, 1, 2, 0, 0, 0, 0, 0], ..File::default() }).contains("a flag is 2"));
    assert!(problem(File { spectra: vec![vec![[500.0, 1.0], [400.0, 1.0]]], ..File::default() }).contains("do not increase"));
    let mut far = File::default().bytes();
    far[80..84].copy_from_slice(&i32::MAX.to_le_bytes());
    assert!(read(&far, "", false).unwrap_err().problem.contains("the names of further columns"));
    far[80..84].copy_from_slice(&(-1_i32).to_le_bytes());
    assert!(read(&far, "", false).unwrap_err().problem.contains("is -1, expected 0 or more"));
    let mut old = File::default().bytes();
    old[4] = 0;
    assert!(read(&old, "", false).unwrap_err().problem.contains("expected 2013"));
    let whole = File::default().bytes();
    for end in [3, 100, 255, 300, 20_000, 36_287, 36_290] {
        assert!(read(&whole[..end], "", true).is_err(), "{end}");
    }
    let cut = read(&whole[..whole.len() - 1], "", true).unwrap();
    assert_eq!((cut.len(), cut.total), (2, 100.0));
}
