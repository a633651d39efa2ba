//! Numbers of Radiance 6.0a's `gendaymtx -c 1 1 1 -of`, made with the tool itself of an EPW file of the records of `made_up_weather`.

use super::made_up;
use crate::sky::{Light, Quantity, SkyMatrix, SkyOptions};

/// Steps of the year.
const STEPS: [usize; 7] = [1952, 4140, 4141, 4142, 4143, 4144, 8292];
/// Lumens in a watt of Radiance's.
const EFFICACY: f64 = 179.0;

/// Holds columns to Radiance's numbers at some patches, and to the brightest patch of the sky.
fn check(options: SkyOptions, patches: [usize; 5], expected: [([f64; 5], usize); 7]) {
    let year = made_up();
    let matrix = SkyMatrix::new(&year, options).expect("a matrix");
    let columns = matrix.columns(&STEPS, 2);
    let unit = if options.quantity == Quantity::Luminance { EFFICACY } else { 1.0 };
    for ((column, (values, brightest)), step) in columns.chunks(matrix.division().patches().len()).zip(expected).zip(STEPS) {
        for (patch, value) in patches.into_iter().zip(values) {
            let found = f64::from(column[patch]) / unit;
            assert!((found - value).abs() <= 1e-5 * value, "step {step}, patch {patch}: {found}, {value}");
        }
        let found = (1..column.len()).max_by(|a, b| column[*a].total_cmp(&column[*b]));
        assert_eq!(found, Some(brightest), "step {step}");
    }
}

#[test]
fn tregenzas_patches() {
    check(
        SkyOptions::default(),
        [0, 1, 46, 110, 145],
        [
            ([10.0616, 24.6515, 21.0615, 7.96151, 6.73511], 40),
            ([8.18944, 21.9676, 32.1157, 13.9772, 34.1643], 133),
            ([30.0305, 22.4655, 19.4913, 6.80344, 13.2914], 134),
            ([35.5101, 39.4488, 61.8019, 37.9177, 71.8853], 121),
            ([27.1259, 38.0445, 48.3775, 31.9081, 47.5789], 102),
            ([18.8271, 34.8653, 36.3823, 24.7271, 29.9108], 103),
            ([9.55771, 26.6037, 2371.55, 18.6774, 19.6621], 46),
        ],
    );
}

#[test]
fn reinharts_patches_2() {
    check(
        SkyOptions { factor: 2, ..SkyOptions::default() },
        [0, 3, 200, 430, 577],
        [
            ([10.0616, 25.6289, 10544.7, 8.08826, 6.79009], 200),
            ([8.18944, 22.2367, 22.2801, 14.0012, 34.4299], 517),
            ([30.0305, 27.0364, 11.2561, 7.56684, 13.3544], 490),
            ([35.5101, 38.9566, 40.5728, 45.188, 72.1405], 456),
            ([27.1259, 37.2089, 35.3756, 42.2702, 47.6434], 418),
            ([18.8271, 33.8433, 29.9835, 36.343, 29.936], 324),
            ([9.55771, 26.7349, 34.8467, 19.7862, 19.7623], 151),
        ],
    );
}

#[test]
fn reinharts_patches_4() {
    check(
        SkyOptions { factor: 4, ..SkyOptions::default() },
        [0, 5, 900, 1800, 2305],
        [
            ([10.0616, 25.7387, 19.0346, 7.52786, 6.80067], 639),
            ([8.18944, 22.2884, 34.5775, 13.8534, 34.4793], 2041),
            ([30.0305, 28.0939, 17.842, 7.14459, 13.371], 1987),
            ([35.5101, 38.8946, 64.117, 41.6297, 72.1832], 1848),
            ([27.1259, 37.1571, 47.5689, 36.5061, 47.6743], 1604),
            ([18.8271, 33.8185, 34.3592, 29.3338, 29.9546], 1319),
            ([9.55771, 26.7496, 207.751, 18.9483, 19.779], 662),
        ],
    );
}

#[test]
fn solar_radiance() {
    check(
        SkyOptions { quantity: Quantity::SolarRadiance, ..SkyOptions::default() },
        [0, 1, 46, 110, 145],
        [
            ([17.1153, 28.5147, 24.362, 9.20915, 7.79056], 40),
            ([12.5971, 31.9982, 46.7801, 20.3593, 49.7641], 133),
            ([50.9928, 29.5618, 25.6481, 8.95247, 17.4898], 134),
            ([60.5136, 62.8645, 98.4857, 60.4245, 114.554], 121),
            ([45.3692, 58.3866, 74.2444, 48.9691, 73.0188], 102),
            ([31.178, 53.7146, 56.0518, 38.0953, 46.0815], 103),
            ([16.1093, 40.2577, 5017.16, 28.2634, 29.7534], 46),
        ],
    );
}

#[test]
fn the_sky_alone_in_a_turned_scene() {
    check(
        SkyOptions { light: Light::WithoutSun, rotation_deg: 30.0, ..SkyOptions::default() },
        [0, 1, 46, 110, 145],
        [
            ([10.0616, 25.6994, 16.0708, 10.2186, 6.70664], 38),
            ([8.18944, 21.9644, 29.0588, 15.1517, 34.1789], 132),
            ([30.0305, 23.6738, 21.8378, 6.86802, 13.2765], 133),
            ([35.5101, 38.5534, 88.3797, 36.256, 71.7657], 119),
            ([27.1259, 36.7248, 75.2038, 29.6824, 47.5619], 100),
            ([18.8271, 33.583, 54.2846, 22.6383, 29.9108], 77),
            ([9.55771, 26.7197, 101.907, 19.1722, 19.6726], 44),
        ],
    );
}

#[test]
fn the_sun_alone() {
    check(
        SkyOptions { light: Light::SunAlone { sun_patches: 4 }, ..SkyOptions::default() },
        [76, 77, 78, 110, 111],
        [
            ([0.0, 0.0, 0.0, 0.0, 0.0], 40),
            ([0.0, 0.0, 0.0, 0.0, 0.0], 133),
            ([0.0, 0.0, 0.0, 0.0, 0.0], 134),
            ([0.0, 0.0, 0.0, 0.0, 0.0], 121),
            ([0.0, 0.0, 0.0, 0.0, 0.0], 102),
            ([0.0, 0.0, 931.171, 0.0, 0.0], 103),
            ([0.0, 0.0, 0.0, 0.0, 0.0], 46),
        ],
    );
}
