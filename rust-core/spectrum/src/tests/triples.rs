use crate::{Spectrum, Triples, named, observer::cie_1931, source::sums, triples, white};

fn lamp(name: &str) -> Spectrum {
    named(name).expect("a name").expect("a spectrum")
}

/// A lamp at whole nanometres from 380 to 780, linear between its points.
pub(super) fn fine(name: &str) -> Spectrum {
    let lamp = lamp(name);
    let wavelengths: Vec<f64> = (380..=780).map(f64::from).collect();
    let power = |nm: &f64| {
        let above = lamp.wavelengths_nm.partition_point(|point| point < nm).max(1);
        let [low, high] = [lamp.wavelengths_nm[above - 1], lamp.wavelengths_nm[above]];
        lamp.power[above - 1] + (nm - low) / (high - low) * (lamp.power[above] - lamp.power[above - 1])
    };
    let powers: Vec<f64> = wavelengths.iter().map(power).collect();
    Spectrum::new(name, &wavelengths, &powers).expect("a spectrum")
}

/// The colour of each cell whose wavelengths have these values.
fn colours(values: &[[f32; 3]]) -> Vec<[f64; 3]> {
    let colour = |(film, values): (&[[f32; 3]; 3], &[f32; 3])| {
        std::array::from_fn(|c| film.iter().zip(values).map(|(film, value)| f64::from(film[c]) * f64::from(*value)).sum())
    };
    triples().film().iter().zip(values).map(colour).collect()
}

fn mean(colours: &[[f64; 3]]) -> [f64; 3] {
    std::array::from_fn(|c| colours.iter().map(|colour| colour[c]).sum::<f64>() / colours.len() as f64)
}

#[track_caller]
fn near(what: &str, found: [f64; 3], expected: [f64; 3], tolerance: f64) {
    assert!(
        found.iter().zip(expected).all(|(found, expected)| (found - expected).abs() < tolerance),
        "{what}: {found:?}, expected {expected:?} ± {tolerance}"
    );
}

#[test]
fn edges_cover_the_visible_once() {
    let edges = &triples().edges;
    assert_eq!(edges.len(), Triples::COUNT + 1);
    let [first, last] = [edges[0], edges[Triples::COUNT]];
    assert_eq!([first[2], last[2], last[1], last[0]], [380.0, first[1], first[0], 780.0]);
    for (cell, pair) in edges.windows(2).enumerate() {
        let widths: [f64; 3] = std::array::from_fn(|k| pair[1][k] - pair[0][k]);
        assert!(widths.iter().all(|width| (0.1..20.0).contains(width)), "cell {cell}: {widths:?} nm");
    }
    for (pair, centre) in edges.windows(2).zip(triples().centres()) {
        assert!((0..3).all(|k| pair[0][k] < f64::from(centre[k]) && f64::from(centre[k]) < pair[1][k]), "{pair:?}: {centre:?}");
    }
}

#[test]
fn daylight_is_white_in_each_cell() {
    let ones = vec![[1.0; 3]; Triples::COUNT];
    let cells = colours(&ones);
    cells.iter().enumerate().for_each(|(k, cell)| near(&format!("cell {k}"), *cell, [1.0; 3], 1e-6));
    near("all", mean(&cells), [1.0; 3], 1e-7);
    for (k, cell) in triples().tabulate(&lamp("D65")).iter().enumerate() {
        near(&format!("D65 in cell {k}"), cell.map(f64::from), [1.0; 3], 1e-5);
    }
}

/// Against sums at whole nanometres.
#[test]
fn lamps_have_their_colours() {
    for name in ["A", "LED-B3", "FL11", "HP1", "E", "LED-RGB1", "D50"] {
        let found = mean(&colours(&triples().tabulate(&lamp(name))));
        let xyz = sums(&fine(name).nodes(), cie_1931);
        let expected = white::turned(&white::XYZ_TO_REC709, xyz.map(|value| value / xyz[1]));
        near(name, found, expected, 2e-3);
    }
}

/// A line of a tenth of a nanometre, and light that the range leaves out.
#[test]
fn narrow_light_is_not_lost() {
    let line = Spectrum::new("", &[545.9, 546.0, 546.05, 546.1, 546.2], &[0.0, 1.0, 1.0, 1.0, 0.0]).expect("a spectrum");
    let found = mean(&colours(&triples().tabulate(&line)));
    let xyz = cie_1931(546.05);
    near("546 nm", found, white::turned(&white::XYZ_TO_REC709, xyz.map(|value| value / xyz[1])), 2e-2);
    let red = Spectrum::new("", &[785.0, 790.0, 795.0, 800.0, 805.0], &[1.0; 5]).expect("a spectrum");
    assert!(triples().tabulate(&red).iter().flatten().all(|value| *value == 0.0));
}

/// Against sums at whole nanometres.
#[test]
fn reflectances_have_their_colours() {
    let reflectance = |nm: f64| 0.1 + 0.8 * ((nm - 380.0) / 400.0).powi(2);
    let found = mean(&colours(&triples().filter(reflectance)));
    let light = sums(&fine("D65").nodes(), |nm| cie_1931(nm).map(|value| reflectance(nm) * value));
    let expected = white::turned(&white::XYZ_TO_REC709, light.map(|value| value / sums(&fine("D65").nodes(), cie_1931)[1]));
    near("a ramp", found, expected, 5e-4);
    assert!(triples().filter(|_| 1.5).iter().flatten().all(|value| (value - 1.5).abs() < 1e-6));
}
