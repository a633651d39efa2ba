use crate::{REC709_TO_REC2020, named, observer::cie_1931, rendering::SAMPLES, source::sums, upsampling, white};

/// The linear Rec.709 of a reflectance under D65, summed at whole nanometres.
fn seen(reflectance: impl Fn(f64) -> f64) -> [f64; 3] {
    let mut sum = [0.0; 3];
    for nm in (380..=780).map(f64::from) {
        let width = if nm == 380.0 || nm == 780.0 { 0.5 } else { 1.0 };
        let [colour, reflectance] = [white::colour(nm), [reflectance(nm); 3]];
        sum = std::array::from_fn(|k| sum[k] + width * colour[k] * reflectance[k]);
    }
    sum
}

fn rec2020(rec709: [f32; 3]) -> [f32; 3] {
    REC709_TO_REC2020.map(|row| row[0] * rec709[0] + row[1] * rec709[1] + row[2] * rec709[2])
}

/// The reflectance of a linear Rec.709 colour.
fn reflectance(rec709: [f32; 3]) -> impl Fn(f64) -> f64 {
    move |nm| f64::from(upsampling().reflectance(rec2020(rec709), nm as f32))
}

/// By how much the spectra's colours differ, over the greatest component, for linear Rec.709 colours between two values (a linear congruential
/// generator); sorted.
fn differences(least: f32, most: f32) -> Vec<f64> {
    let mut state = 1_u32;
    let mut next = || {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        least + (most - least) * (state >> 8) as f32 / (1 << 24) as f32
    };
    let mut differences: Vec<f64> = (0..1000)
        .map(|_| {
            let colour = [next(), next(), next()];
            let largest =
                seen(reflectance(colour)).iter().zip(colour).map(|(seen, wanted)| (seen - f64::from(wanted)).abs()).fold(0.0, f64::max);
            largest / f64::from(colour.into_iter().fold(0.0, f32::max))
        })
        .collect();
    differences.sort_by(f64::total_cmp);
    differences
}

/// Median, 99 of 100 and the worst.
#[test]
fn colours_come_back() {
    for (least, most, expected) in [(0.02, 0.98, [1e-3, 3e-3, 8e-3]), (0.002, 0.02, [1e-3, 1.2e-2, 2e-2])] {
        let sorted = differences(least, most);
        let found = [sorted[500], sorted[990], sorted[999]];
        assert!(found.iter().zip(expected).all(|(found, expected)| *found < expected), "{least} to {most}: {found:?}");
    }
}

#[test]
fn greys_are_grey() {
    for value in [1e-5_f32, 1e-3, 0.02, 0.18, 0.5, 0.8, 0.99] {
        for nm in [380.0, 500.0, 640.5, 780.0] {
            let found = upsampling().reflectance([value; 3], nm);
            assert!((found - value).abs() < 2e-6 * value, "{value} at {nm} nm: {found}");
        }
    }
}

/// Also of colours that no reflectance has, and of no colours.
#[test]
fn reflectances_are_between_0_and_1() {
    let values = [-1.0, 0.0, 1e-30, 1e-6, 0.01, 0.5, 0.999, 1.0, 7.0, f32::INFINITY];
    for k in 0..values.len().pow(3) {
        let colour = [k / 100, k / 10, k].map(|k| values[k % 10]);
        for nm in [380.0, 450.0, 550.0, 650.0, 780.0] {
            let found = upsampling().reflectance(colour, nm);
            assert!((0.0..=1.0).contains(&found), "{colour:?} at {nm} nm: {found}");
        }
    }
    for grey in [0.0, 1.0] {
        for nm in [380.0, 555.0, 780.0] {
            let found = upsampling().reflectance([grey; 3], nm);
            assert!((found - grey).abs() <= 1.1e-6, "{grey}: {found}");
        }
    }
}

/// Without regard to which component is the greatest.
#[test]
fn equal_components_do_not_part_the_table() {
    for (a, b) in [([0.4, 0.4, 0.1], 1e-6), ([0.1, 0.4, 0.4], 1e-6), ([0.4, 0.1, 0.4], 1e-6), ([0.9, 0.9, 0.7], 1e-6)] {
        for component in 0..3 {
            let mut other: [f32; 3] = a;
            other[component] += b;
            for nm in [400.0, 480.0, 560.0, 640.0, 720.0] {
                let [found, beside] = [a, other].map(|colour| upsampling().reflectance(colour, nm));
                assert!((found - beside).abs() < 1e-4, "{a:?} at {nm} nm: {found}, beside {beside}");
            }
        }
    }
}

/// CIE 13.3's samples, and spectra of their colours under D65, under other lamps: differences in CIE 1976 L*a*b*.
#[test]
fn samples_look_alike_under_other_lamps() {
    for (lamp, mean, most) in [("A", 2.5, 8.0), ("LED-B3", 2.5, 8.0), ("FL11", 3.5, 10.0)] {
        let nodes = named(lamp).expect("a name").expect("a spectrum").nodes();
        let white = sums(&nodes, cie_1931);
        let lab = |reflectance: &dyn Fn(f64) -> f64| {
            let light = sums(&nodes, |nm| cie_1931(nm).map(|value| value * reflectance(nm)));
            let [x, y, z] = std::array::from_fn(|k| (light[k] / white[k]).cbrt());
            [116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)]
        };
        let differences: Vec<f64> = (0..15)
            .map(|sample| {
                let measured = |nm: f64| SAMPLES.at(sample, nm);
                let upsampled = reflectance(seen(measured).map(|value| value as f32));
                lab(&measured).iter().zip(lab(&upsampled)).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt()
            })
            .collect();
        let worst = differences.iter().copied().fold(0.0, f64::max);
        let found = differences.iter().sum::<f64>() / 15.0;
        assert!(found < mean && worst < most, "{lamp}: mean {found}, largest {worst}");
    }
}
