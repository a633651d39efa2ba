//! Samples whose scattering is known in closed form.

use super::*;

#[test]
fn a_mirror_sends_every_patch_into_its_own() {
    let reading = measured(&sheet(mirror(1.0)), &options(1 << 13)).expect("a reading");
    for side in &reading.sides {
        for (incident, from) in side.from.iter().enumerate() {
            let own = side.reflected[incident * 41 + incident][0];
            near(from.reflected.value, own, 2e-3, "borders");
            near(own, 1.0, 5e-3, "the mirrored patch");
            assert_eq!((from.transmitted.value, from.lost.value), (0.0, 0.0));
            assert!(from.absorbed.value.abs() < 5e-3, "{from:?}");
        }
    }
}

#[test]
fn paper_is_lambertian() {
    let paper = sheet(Material::diffuse(Origin::new("paper"), [0.6, 0.5, 0.4]));
    let reading = measured(&paper, &Options { colour: true, ..options(1 << 16) }).expect("a reading");
    let patches = reading.patches().expect("matrices");
    let measured = Measured::Patches(patches);
    let mut out = [0.0; 3];
    for side in &reading.sides {
        for from in &side.from {
            near(from.reflected.value, 0.2126 * 0.6 + 0.7152 * 0.5 + 0.0722 * 0.4, 0.01, "albedo");
        }
        for (place, share) in side.reflected.iter().enumerate() {
            let expected = reading.basis.projected_solid_angle(place % 41) / PI;
            near(share[0], 0.6 * expected, 0.2, "red");
            near(share[2], 0.4 * expected, 0.2, "blue");
        }
    }
    out.copy_from_slice(&measured.eval_rgb([0.0, 0.6, 0.8], [0.6, 0.0, 0.8]));
    for (found, albedo) in out.into_iter().zip([0.6, 0.5, 0.4]) {
        near(found, 0.8 * albedo / PI, 0.1, "BSDF times cosine");
    }
}

/// One model's closure of a colour.
fn of_model(model: Model, colour: f32) -> Material {
    let mut closure = Closure { model, ..Closure::default() };
    closure.set_colour("base_color", [colour; 3]);
    Material::of(Origin::new("sheet"), closure)
}

#[test]
fn a_diffusing_sheet_passes_all_patches_alike() {
    let reading = measured(&sheet(of_model(Model::Translucent, 0.55)), &options(1 << 16)).expect("a reading");
    for side in &reading.sides {
        for from in &side.from {
            near(from.transmitted.value, 0.55, 1e-3, "transmittance");
            assert_eq!(from.reflected.value, 0.0);
        }
        for outgoing in 0..41 {
            let expected = 0.55 * reading.basis.projected_solid_angle(outgoing) / PI;
            let mean = (0..41).map(|incident| side.transmitted[incident * 41 + outgoing][0]).sum::<f64>() / 41.0;
            near(mean, expected, 0.02, "a patch of light from everywhere");
        }
    }
}

#[test]
fn a_clear_pane_lets_all_straight_through() {
    let reading = measured(&sheet(of_model(Model::Transparent, 0.9)), &options(1 << 13)).expect("a reading");
    for side in &reading.sides {
        for (patch, from) in side.from.iter().enumerate() {
            near(from.transmitted.value, 0.9, 1e-5, "transmittance");
            near(side.transmitted[patch * 41 + patch][0], 0.9, 1e-3, "straight on");
        }
    }
}

/// (1 − R) / (1 + R) of a slab of glass: light is unpolarised at every surface.
fn slab(cosine: f64) -> f64 {
    let index = 1.5_f64;
    let inner = (1.0 - (1.0 - cosine * cosine) / (index * index)).sqrt();
    let s = ((cosine - index * inner) / (cosine + index * inner)).powi(2);
    let p = ((index * cosine - inner) / (index * cosine + inner)).powi(2);
    let reflected = 0.5 * (s + p);
    (1.0 - reflected) / (1.0 + reflected)
}

#[test]
fn a_slab_of_glass_passes_what_fresnel_says() {
    let mut scene = Scene::default();
    let glass = || material([1.0; 3], &[("transmission_weight", 1.0), ("specular_roughness", 0.0), ("specular_ior", 1.5)]);
    square(&mut scene, 50.0, 0.005, true, glass());
    square(&mut scene, 50.0, -0.005, false, glass());
    let reading = measured(&scene, &options(1 << 15)).expect("a reading");
    let basis = &reading.basis;
    for side in &reading.sides {
        for (patch, from) in side.from.iter().enumerate() {
            // The mean over the patch, even in sin².
            let steps = 2000;
            let cosine = |i: i32| basis.direction(patch, [(f64::from(i) + 0.5) / f64::from(steps), 0.5])[2];
            let expected = (0..steps).map(|i| slab(cosine(i))).sum::<f64>() / f64::from(steps);
            near(from.transmitted.value, expected, if patch < 33 { 0.01 } else { 0.02 }, &format!("patch {patch}"));
            near(from.reflected.value + from.transmitted.value, 1.0, 2e-3, "nothing is absorbed");
            near(side.transmitted[patch * 41 + patch][0], from.transmitted.value, 5e-3, "it goes straight on");
        }
    }
}

#[test]
fn black_louvres_shade_in_closed_form() {
    // Slats along x, as deep as they are apart: of what comes from (x, y, z) a share of |y / z| falls on them.
    let mut scene = Scene::default();
    let points = [[-0.5, 0.0, -0.05], [0.5, 0.0, -0.05], [0.5, 0.0, 0.05], [-0.5, 0.0, 0.05]];
    add(&mut scene, &points, &[[0, 1, 2], [0, 2, 3]], Material::diffuse(Origin::new("black"), [0.0; 3]));
    let window = Window { min: [-0.5, -0.05], max: [0.5, 0.05] };
    let reading = measured(&scene, &Options { window: Some(window), repeats: 60, ..options(1 << 15) }).expect("a reading");
    for side in &reading.sides {
        for patch in 0..reading.basis.count() {
            let steps = 300_u32;
            let u = |i: u32| (f64::from(i) + 0.5) / f64::from(steps);
            let through = |i: u32| {
                let [_, y, z] = reading.basis.direction(patch, [u(i / steps), u(i % steps)]);
                (1.0 - (y / z).abs()).max(0.0)
            };
            let expected = (0..steps * steps).map(through).sum::<f64>() / f64::from(steps * steps);
            let from = &side.from[patch];
            assert!((from.transmitted.value + from.lost.value - expected).abs() < 4e-3, "{patch}: {from:?} instead of {expected}");
            assert!(from.reflected.value == 0.0);
        }
    }
}
