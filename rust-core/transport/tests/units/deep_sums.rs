//! Parts of samples along depth.

use gonio_camera::sampler::BATCH;
use gonio_simd::{Column, F, M, One, Rgb, U};
use gonio_transport::{DeepPart, DeepSums};

/// Sums of a batch whose slot 3 has this radiance and coverage.
fn settled(sums: &mut DeepSums, radiance: f32, coverage: f32) -> Vec<DeepPart> {
    let mut columns: [Column; 3] = std::array::from_fn(|_| Column::new(BATCH));
    let mut alpha = Column::new(BATCH);
    columns[0][3] = radiance;
    alpha[3] = coverage;
    let first = sums.parts.len();
    sums.settle(&columns, &alpha);
    sums.parts[first..].to_vec()
}

fn part(depth: f32, coverage: f32, red: f32) -> DeepPart {
    DeepPart { slot: 3, depth, coverage, light: [red, 0.0, 0.0], soft: false }
}

fn meet(sums: &mut DeepSums, depth: f32, share: f32) {
    sums.add::<One>(U(3), F(depth), F(share), M(true), false);
}

#[test]
fn a_batch_adds_to_what_its_samples_met() {
    let mut sums = DeepSums::default();
    sums.prepare(true);
    meet(&mut sums, 2.0, 1.0);
    assert_eq!(settled(&mut sums, 5.0, 1.0), [part(2.0, 1.0, 5.0)]);
    meet(&mut sums, 4.0, 1.0);
    assert_eq!(settled(&mut sums, 6.0, 2.0), [part(4.0, 1.0, 1.0)]);
    // Nothing was met: light from infinity, with coverage and without.
    assert_eq!(settled(&mut sums, 8.0, 2.0), [part(f32::INFINITY, 0.0, 2.0)]);
    assert_eq!(settled(&mut sums, 9.0, 3.0), [part(f32::INFINITY, 1.0, 1.0)]);
    assert_eq!(settled(&mut sums, 9.0, 3.0), []);
}

#[test]
fn shares_of_a_sample_stand_one_behind_the_other() {
    let mut sums = DeepSums::default();
    sums.prepare(true);
    meet(&mut sums, 4.0, 0.25);
    meet(&mut sums, 2.0, 0.5);
    let expected = [part(2.0, 0.5, 4.0), part(4.0, 0.25, 2.0), part(f32::INFINITY, 0.25, 2.0)];
    assert_eq!(settled(&mut sums, 8.0, 1.0), expected);
    // Clear glass before nothing takes its coverage back.
    meet(&mut sums, 1.0, 1.0);
    assert_eq!(settled(&mut sums, 10.0, 1.25), [part(1.0, 0.25, 2.0)]);
}

#[test]
fn light_of_a_depth_of_its_own_covers_nothing() {
    let mut sums = DeepSums::default();
    sums.prepare(true);
    meet(&mut sums, 4.0, 1.0);
    let red = Rgb { r: F(2.0), g: F(0.0), b: F(0.0) };
    sums.add_light::<One>(U(3), F(1.5), red, M(true));
    assert_eq!(settled(&mut sums, 5.0, 1.0), [DeepPart { soft: true, ..part(1.5, 0.0, 2.0) }, part(4.0, 1.0, 3.0)]);
}
