//! Quantities: what a light of so many lm, cd, lx, cd/m² or W sends.

use super::{goniogram, illuminance, placed, table};
use crate::light::{FarField, LightKind, LightRecord, Shaping as Narrowing};
use crate::scene::{DomeFormat, LUMENS_PER_WATT, Light, LightQuantity, LightShape, Opening, OpeningShape, Shaping, Spot};
use std::f64::consts::PI;
use std::sync::Arc;

fn with(light: Light, quantity: LightQuantity) -> Light {
    Light { quantity: Some(quantity), ..light }
}

/// Illuminance of a light one metre (or so) straight on, its colour uneven.
fn straight_on(mut light: Light, distance: f64) -> f64 {
    light.emission.radiance = [3.0, 0.7, 0.2];
    let down = light.transform.vector([0.0, 0.0, -1.0]);
    let p = [0, 1, 2].map(|k| light.transform.columns[3][k] + distance * down[k]);
    let (table, problems) = table(light);
    assert_eq!(problems, Vec::<String>::new());
    illuminance(&table, p, down.map(|x| -x), 64)[0]
}

fn close(found: f64, expected: f64, relative: f64, case: &str) {
    assert!((found / expected - 1.0).abs() < relative, "{case}: {found} for {expected}");
}

#[test]
fn a_hundred_lumens() {
    let flux = LightQuantity::Lumens(100.0);
    let small = 0.002;
    for (shape, expected) in [
        (LightShape::Point, 100.0 / (4.0 * PI)),
        (LightShape::Sphere { radius: small }, 100.0 / (4.0 * PI)),
        (LightShape::Opening(Opening::default()), 100.0 / (4.0 * PI)),
        (LightShape::Opening(Opening::new(OpeningShape::Box, [small; 3])), 100.0 / (4.0 * PI)),
        (LightShape::Rectangle { width: small, height: small }, 100.0 / PI),
        (LightShape::Disk { radius: small }, 100.0 / PI),
        (LightShape::Ellipse { width: small, height: 2.0 * small }, 100.0 / PI),
        // A cylinder's intensity across its axis, along which it has no caps: Φ / π².
        (LightShape::Cylinder { radius: small, length: 0.01 }, 100.0 / (PI * PI)),
    ] {
        close(straight_on(with(placed(shape, None), flux), 1.0), expected, 2e-3, &format!("{shape:?}"));
    }
    let isotropic = straight_on(with(placed(LightShape::Point, None), flux), 1.0);
    assert!((isotropic - 7.96).abs() < 0.005, "{isotropic}");
}

#[test]
fn directed_spots_and_cones() {
    // I = I₀ cosⁿ θ on both sides of the axis: Φ = 4π I₀ / (n + 1).
    for n in [1.0_f32, 3.0, 20.0] {
        let light = Light { shaping: Shaping { focus: n, ..Shaping::default() }, ..placed(LightShape::Point, None) };
        close(straight_on(with(light, LightQuantity::Lumens(100.0)), 1.0), 100.0 * f64::from(n + 1.0) / (4.0 * PI), 1e-4, "directed");
    }
    // A hard cone of half angle h: Φ = 2π (1 − cos h) I.
    let half = 25.0_f64.to_radians();
    let expected = 100.0 / (2.0 * PI * (1.0 - half.cos()));
    let spot = Some(Spot { angle_deg: 50.0, blend: 0.0, stretch: [1.0; 2] });
    let light = Light { spot, ..placed(LightShape::Point, None) };
    close(straight_on(with(light, LightQuantity::Lumens(100.0)), 1.0), expected, 1e-4, "spot");
    let shaping = Shaping { cone_angle_deg: Some(25.0), ..Shaping::default() };
    let light = Light { shaping, ..placed(LightShape::Point, None) };
    close(straight_on(with(light, LightQuantity::Lumens(100.0)), 1.0), expected, 1e-4, "cone");
}

#[test]
fn narrow_beams_keep_their_flux() {
    let flux = |record: LightRecord| FarField::new(&[record], &[]).flux();
    // A rectangle of 4 m² whose spread keeps its flux, Φ = π A L.
    for degrees in [0.05_f32, 0.2, 0.3, 0.5, 0.7, 2.0, 30.0] {
        let record = LightRecord { spread: degrees.to_radians(), ..LightRecord::new(LightKind::Rectangle) };
        close(flux(record), 4.0 * PI, 2e-3, &format!("spread of {degrees} degrees"));
    }
    // Rounding of a cosine in single precision, 3e-8, to the power.
    for (focus, tolerance) in [(100.0_f32, 1e-3), (1e4, 2e-3), (1e6, 5e-2)] {
        let record = LightRecord { shaping: Narrowing { focus, ..Narrowing::default() }, ..LightRecord::new(LightKind::Point) };
        close(flux(record), 4.0 * PI / f64::from(focus + 1.0), tolerance, &format!("focus of {focus}"));
    }
}

#[test]
fn candela_lux_nits_and_watts() {
    let disk = placed(LightShape::Disk { radius: 0.1 }, None);
    close(straight_on(with(disk.clone(), LightQuantity::Candela(50.0)), 20.0), 50.0 / 400.0, 1e-3, "cd");
    close(straight_on(with(disk.clone(), LightQuantity::Lux { illuminance: 80.0, distance: 30.0 }), 30.0), 80.0, 1e-3, "lx");
    close(straight_on(with(disk.clone(), LightQuantity::Nits(1000.0)), 0.3), 1000.0 * PI * 0.1, 1e-3, "cd/m²");
    close(straight_on(with(disk, LightQuantity::Watts(1.0)), 20.0), LUMENS_PER_WATT / PI / 400.0, 1e-3, "W");
    let globe = placed(LightShape::Opening(Opening::new(OpeningShape::Ellipsoid, [0.2; 3])), None);
    close(straight_on(with(globe, LightQuantity::Nits(1000.0)), 1.0), 1000.0 * PI * 0.01, 1e-3, "cd/m² of an opening");
}

#[test]
fn parallel_light_and_domes() {
    for angle_deg in [0.0, 0.53, 20.0] {
        let sun = placed(LightShape::Distant { angle_deg }, None);
        let lux = LightQuantity::Lux { illuminance: 9e4, distance: 1.0 };
        close(straight_on(with(sun, lux), 1.0), 9e4, 2e-3, &format!("{angle_deg} degrees"));
    }
    let sky = placed(LightShape::Dome { format: DomeFormat::Automatic }, None);
    close(straight_on(with(sky.clone(), LightQuantity::Lux { illuminance: 1e4, distance: 1.0 }), 1.0), 1e4, 5e-3, "sky in lx");
    close(straight_on(with(sky, LightQuantity::Nits(2000.0)), 1.0), 2000.0 * PI, 5e-3, "sky in cd/m²");
}

#[test]
fn goniograms_keep_their_shape() {
    let measured = goniogram(180.0);
    let on_axis = f64::from(measured.factors[0]);
    let light = |quantity| with(placed(LightShape::Point, Some(measured.clone())), quantity);
    close(straight_on(light(LightQuantity::Measured), 2.0), on_axis / 4.0, 1e-4, "as measured");
    let peak = measured.factors.iter().copied().fold(0.0, f32::max);
    close(straight_on(light(LightQuantity::Candela(1000.0)), 1.0), 1000.0 * on_axis / f64::from(peak), 1e-3, "peak");
    let once = straight_on(light(LightQuantity::Lumens(100.0)), 1.0);
    close(straight_on(light(LightQuantity::Lumens(300.0)), 1.0), 3.0 * once, 1e-4, "flux");
    // The opening changes nothing of the flux.
    let globe = LightShape::Opening(Opening::new(OpeningShape::Ellipsoid, [0.01; 3]));
    close(straight_on(with(placed(globe, Some(measured.clone())), LightQuantity::Lumens(100.0)), 1.0), once, 2e-2, "opening");
    let mut lamps = (*measured).clone();
    lamps.lamp_flux = Some(500.0);
    let light = with(placed(LightShape::Point, Some(Arc::new(lamps))), LightQuantity::LampLumens(250.0));
    close(straight_on(Light { dimming: 0.8, ..light }, 1.0), 0.4 * on_axis, 1e-4, "half the lamps, dimmed");
}

#[test]
fn what_has_no_such_quantity_stays_dark_and_says_so() {
    let problem = |light: Light| {
        let (table, problems) = table(light);
        assert!(illuminance(&table, [5.0; 3], [0.0, 0.0, 1.0], 4)[0] == 0.0);
        problems.first().cloned().unwrap_or_default()
    };
    let point = placed(LightShape::Point, None);
    assert!(problem(with(point.clone(), LightQuantity::Nits(5.0))).contains("no surface"));
    assert!(problem(with(point.clone(), LightQuantity::Measured)).contains("no goniogram"));
    assert!(problem(with(point.clone(), LightQuantity::LampLumens(5.0))).contains("lamps' flux"));
    assert!(problem(with(point, LightQuantity::Lumens(-5.0))).contains("expected a number"));
    let sun = placed(LightShape::Distant { angle_deg: 0.0 }, None);
    assert!(problem(with(sun.clone(), LightQuantity::Lumens(5.0))).contains("expected lx"));
    assert!(problem(with(sun, LightQuantity::Nits(5.0))).contains("parallel"));
}
