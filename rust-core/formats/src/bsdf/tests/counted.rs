//! Matrices from counts, through XML and back.

use core::f64::consts::PI;

use super::super::direction::through;
use super::super::{Basis, Channels, Hemispheres, Measured, PatchCounts, Patches, Shares, read, xml};
use super::Random;

const BASES: [&str; 3] = ["LBNL/Klems Full", "LBNL/Klems Half", "LBNL/Klems Quarter"];

fn shares(basis: &Basis, share: impl Fn(usize, usize) -> f64) -> Shares {
    let count = basis.count();
    Shares::Visible((0..count * count).map(|index| share(index / count, index % count)).collect())
}

/// Written as XML and read again.
fn again(patches: &Patches) -> Measured {
    let text = xml::write_patches(patches, "counted");
    let found = read(text.as_bytes(), "").unwrap();
    assert_eq!(found, Measured::Patches(patches.clone()));
    found
}

#[test]
fn directions_of_a_patch_are_uniform_and_found_again() {
    let mut random = Random(41);
    for basis in BASES.map(|name| Basis::known(name).unwrap()) {
        for patch in 0..basis.count() {
            for from_front in [true, false] {
                let ends = [[1e-9, 1e-9], [1.0 - 1e-9, 1.0 - 1e-9]];
                let many: Vec<[f64; 2]> = (0..30).map(|_| [random.next(), random.next()]).chain(ends).collect();
                for u in many {
                    let wi = basis.incident_direction(patch, u, from_front);
                    assert_eq!(wi[2] >= 0.0, from_front, "{wi:?}");
                    assert_eq!(basis.incident_patch(wi), patch);
                    // Light goes on straight, and mirrored, into the patch of the same number.
                    assert_eq!(basis.outgoing_patch([-wi[0], -wi[1], -wi[2]]), patch);
                    assert_eq!(basis.outgoing_patch([-wi[0], -wi[1], wi[2]]), patch);
                }
            }
        }
        // Of directions in proportion to the cosine each patch gets its projected solid angle's share, and within it half lie on either side of
        // the middle of sin².
        let patch = basis.count() - 1;
        let lowest = basis.direction(patch, [0.0, 0.5])[2].powi(2);
        let below = (0..10_000).filter(|_| 1.0 - basis.direction(patch, [random.next(), 0.5])[2].powi(2) < 1.0 - lowest / 2.0).count();
        assert!((4800..5200).contains(&below), "{below}");
    }
}

#[test]
fn a_diffuse_sample_comes_back() {
    let mut random = Random(43);
    for basis in BASES.map(|name| Basis::known(name).unwrap()) {
        let diffuse = |of: f64| shares(&basis, |_, outgoing| of * basis.projected_solid_angle(outgoing) / PI);
        let counts = [
            PatchCounts { hemispheres: Hemispheres::ReflectionFront, shares: diffuse(0.5) },
            PatchCounts { hemispheres: Hemispheres::ReflectionBack, shares: diffuse(0.2) },
            PatchCounts { hemispheres: Hemispheres::TransmissionFront, shares: diffuse(0.3) },
        ];
        let patches = Patches::counted(basis, &counts).unwrap();
        let material = again(&patches);
        for _ in 0..200 {
            let (wi, wo) = (random.direction(), random.direction());
            let near = |found: f64, expected: f64| assert!((found / expected - 1.0).abs() < 1e-5, "{found} {expected}");
            near(material.eval_luminance(wi, wo), 0.5 / PI * wi[2]);
            near(material.eval_luminance(through(wi), through(wo)), 0.2 / PI * wi[2]);
            near(material.eval_luminance(wi, through(wo)), 0.3 / PI * wi[2]);
            near(material.eval_luminance(through(wi), wo), 0.3 / PI * wi[2]);
            near(material.albedo(wi).reflected[0], 0.5);
        }
    }
}

#[test]
fn counted_rays_are_the_sample() {
    // A sample that sends light straight through by a fifth, and bends the rest aside: its counts by rays.
    let basis = Basis::known("LBNL/Klems Half").unwrap();
    let (count, rays, mut random) = (basis.count(), 400, Random(47));
    let mut found = vec![0.0; count * count];
    for incident in 0..count {
        for _ in 0..rays {
            let wi = basis.incident_direction(incident, [random.next(), random.next()], true);
            let wo = if random.next() < 0.2 { [-wi[0], -wi[1], -wi[2]] } else { through(random.direction()) };
            found[incident * count + basis.outgoing_patch(wo)] += 1.0 / f64::from(rays);
        }
    }
    let counts = [PatchCounts { hemispheres: Hemispheres::TransmissionFront, shares: Shares::Visible(found) }];
    let patches = Patches::counted(basis.clone(), &counts).unwrap();
    let Measured::Patches(patches) = again(&patches) else { panic!("expected patches") };
    let matrix = &patches.matrices()[0];
    for (incident, total) in patches.totals(matrix).into_iter().enumerate() {
        assert!((total - 1.0).abs() < 1e-5, "{total}");
        // Straight through: its own patch has a fifth and its part of the rest.
        let straight = f64::from(matrix.values[incident * count + incident]) * basis.projected_solid_angle(incident);
        let expected = 0.2 + 0.8 * basis.projected_solid_angle(incident) / PI;
        assert!((straight - expected).abs() < 5.0 * (expected / f64::from(rays)).sqrt(), "{straight} {expected}");
    }
}

#[test]
fn colours_come_back() {
    let basis = Basis::known("LBNL/Klems Quarter").unwrap();
    let count = basis.count();
    let mut random = Random(53);
    let colours: Vec<[f64; 3]> = (0..count * count).map(|_| [0, 1, 2].map(|_| (0.2 + 0.8 * random.next()) / count as f64)).collect();
    let counts = [PatchCounts { hemispheres: Hemispheres::ReflectionFront, shares: Shares::Rgb(colours.clone()) }];
    let material = again(&Patches::counted(basis.clone(), &counts).unwrap());
    assert_eq!(material.channels(), &Channels::Xyz);
    for _ in 0..300 {
        let (wi, wo) = (random.direction(), random.direction());
        let (incident, outgoing) = (basis.incident_patch(wi), basis.outgoing_patch(wo));
        let found = material.eval_rgb(wi, wo);
        for channel in 0..3 {
            let expected = colours[incident * count + outgoing][channel] / basis.projected_solid_angle(outgoing) * wi[2];
            assert!((found[channel] - expected).abs() < 1e-5 * (1.0 + expected), "{found:?} {expected}");
        }
    }
}

#[test]
fn counts_that_cannot_be_are_refused() {
    let basis = Basis::known("LBNL/Klems Quarter").unwrap();
    let count = basis.count();
    let problem = |all: &[(Hemispheres, Shares)]| {
        let counts: Vec<PatchCounts> =
            all.iter().map(|(hemispheres, shares)| PatchCounts { hemispheres: *hemispheres, shares: shares.clone() }).collect();
        Patches::counted(basis.clone(), &counts).unwrap_err().problem
    };
    let even = |of: f64| shares(&basis, |_, _| of / count as f64);
    let [reflected, through] = [Hemispheres::ReflectionFront, Hemispheres::TransmissionFront];
    assert_eq!(problem(&[(reflected, Shares::Visible(vec![0.0; 7]))]), "7 shares, expected 41 × 41");
    assert_eq!(problem(&[(reflected, Shares::Rgb(vec![[0.0; 3]; 7]))]), "7 shares, expected 41 × 41");
    assert_eq!(problem(&[(reflected, shares(&basis, |_, _| f64::NAN))]), "a share is NaN, expected 0 to 1");
    assert_eq!(problem(&[(reflected, shares(&basis, |_, _| -0.1))]), "a share is -0.1, expected 0 to 1");
    assert_eq!(problem(&[(reflected, even(0.6)), (through, even(0.6))]), "1.200 of the light from patch 1 left the sample");
    assert_eq!(problem(&[]), "no scattering data");
    // What comes from the other side is another light.
    let both = [(reflected, even(0.6)), (Hemispheres::ReflectionBack, even(0.6))];
    let both: Vec<PatchCounts> = both.into_iter().map(|(hemispheres, shares)| PatchCounts { hemispheres, shares }).collect();
    assert!(Patches::counted(basis.clone(), &both).is_ok());
}
