//! `gonio emergency`.

use super::{Found, leave_burning, loaded, measured, not_counted, plan, show, surfaces_left_out};
use crate::{arguments::EmergencyOptions, messages::tell};
use gonio::{
    Result,
    compile::{luminous_intensities, stated_directions},
    measure::{IN_PART, StraightLight},
    scene::{Integrator, Scene},
};
use gonio_norms::{
    Reading, Spot,
    emergency::{Figures, Lamp, Plan, lines},
};
use pyo3::prelude::*;
use std::{cmp::Ordering, collections::BTreeMap, sync::atomic::AtomicBool};

/// Degrees between directions in which intensities are asked for, across and down.
const STEPS_DEG: [f64; 2] = [5.0, 1.0];

/// Metres before a plane from which luminaires are looked at: it may lie on a surface.
const BEFORE: f64 = 1e-3;

/// Measures what the plan asks for and tells what it comes to.
pub(crate) fn emergency(py: Python<'_>, options: &EmergencyOptions, interrupted: &'static AtomicBool) -> Result<i32> {
    let (plan, options) = (plan(&options.plan, Plan::read)?, &options.norm);
    let (mut stage, up) = loaded(py, options, interrupted)?;
    let (scene, spots) = (&mut stage.scene, plan.spots(up));
    let burning = leave_burning(scene, (&plan.groups, &plan.lights), plan.maintenance_factor, "in an emergency")?;
    // What surfaces send on does not count (EN 1838).
    let Found { readings, straight, told } = measured(py, scene, (&spots, &before(&spots)), (options, Integrator::Direct), interrupted)?;
    let not_counted = not_counted(&straight, "points", "counted");
    // What measuring says of integrators is no way out here.
    let told = told.iter().filter(|diagnostic| not_counted.is_none() || diagnostic.message != IN_PART);
    let surfaces = surfaces_left_out(scene);
    tell(&options.stage, options.quiet, &told.chain(&not_counted).chain(&surfaces).cloned().collect::<Vec<_>>());
    // Nothing but what is not counted may be all there is: no figure, and no zero.
    let known =
        |(reading, light): (Reading, &StraightLight)| if light.sees_covered && reading.lx <= 0.0 { Reading::UNKNOWN } else { reading };
    let readings: Vec<Reading> = readings.into_iter().zip(&straight).map(known).collect();
    let notes = not_counted.into_iter().chain(surfaces).map(|note| note.message).collect();
    // Nobody may be dazzled by new lamps either.
    scene.lights.iter_mut().for_each(|light| light.maintenance = 1.0);
    let floor = &spots[..spots.len() - plan.places.len()];
    let figures = Figures::new(&plan, &spots, &readings, seen(scene, &burning, (&plan, floor), up)).with_notes(notes);
    show(options, || figures.json(), || lines(&figures));
    Ok(0)
}

/// Places just before the points' planes.
fn before(spots: &[Spot]) -> Vec<[f64; 3]> {
    let lengths = spots.iter().map(|spot| spot.normal.iter().map(|x| x * x).sum::<f64>().sqrt());
    let place = |(spot, length): (&Spot, f64)| std::array::from_fn(|k| spot.position[k] + BEFORE * spot.normal[k] / length);
    spots.iter().zip(lengths).map(place).collect()
}

/// Luminaires with their height above the plan's floor and their greatest intensity within its angles; lights of one prim at one place are one.
fn seen(scene: &Scene, burning: &[usize], (plan, floor): (&Plan, &[Spot]), up: [f64; 3]) -> Vec<Lamp> {
    let (lamps, glare) = (lamps(scene, burning), plan.glare(up));
    let evenly = directions(glare, up);
    let mut peaks = peaks(scene, &lamps, |lights| [&evenly[..], &stated(scene, lights, glare, up)].concat()).into_iter();
    let light = |lights: &[usize]| &scene.lights[lights[0]];
    let mut seen = Vec::new();
    for placements in lamps.chunk_by(|a, b| light(a).origin.name == light(b).origin.name) {
        for (number, lights) in placements.iter().enumerate() {
            let (light, peak_cd) = (light(lights), peaks.next().flatten());
            // Placements of an instancer have one name.
            let name = if placements.len() > 1 { format!("{}[{number}]", light.origin.name) } else { light.origin.name.to_string() };
            seen.push(Lamp { name, height: above(light.transform.point([0.0; 3]), (plan, floor), up), peak_cd });
        }
    }
    seen
}

/// Metres from a luminaire down to the plan's floor: to the point of its routes and areas that is next to it in plan, of those that are not above it. None
/// where there is none.
fn above(lamp: [f64; 3], (plan, floor): (&Plan, &[Spot]), up: [f64; 3]) -> Option<f64> {
    let down = |spot: &Spot| {
        let way: [f64; 3] = std::array::from_fn(|k| lamp[k] - spot.position[k]);
        let rise = way[0] * up[0] + way[1] * up[1] + way[2] * up[2];
        let square = way.iter().map(|x| x * x).sum::<f64>();
        (square - rise * rise, rise + plan.height)
    };
    // Of floors one above the other the next one down counts.
    let nearer = |a: &(f64, f64), b: &(f64, f64)| (1e4 * a.0).round().total_cmp(&(1e4 * b.0).round()).then(a.1.total_cmp(&b.1));
    floor.iter().map(down).filter(|(_, rise)| *rise > 0.0).min_by(nearer).map(|(_, rise)| rise)
}

/// The greatest intensity of each luminaire in the directions that are asked of its lights, cd: they add up. None where a picture over a light leaves no
/// intensity to tell.
fn peaks(scene: &Scene, lamps: &[Vec<usize>], asked: impl Fn(&[usize]) -> Vec<[f64; 3]>) -> Vec<Option<f64>> {
    let mut lamp_of = vec![None; scene.lights.len()];
    lamps.iter().enumerate().for_each(|(lamp, lights)| lights.iter().for_each(|light| lamp_of[*light] = Some(lamp)));
    let mut sums: Vec<Vec<f64>> = vec![Vec::new(); lamps.len()];
    let mut left: Vec<usize> = lamps.iter().map(Vec::len).collect();
    luminous_intensities(scene, |light, intensity| {
        let Some(lamp) = lamp_of[light] else { return };
        let (sum, found) = (&mut sums[lamp], asked(&lamps[lamp]).into_iter().map(intensity));
        if sum.is_empty() {
            sum.extend(found);
        } else {
            sum.iter_mut().zip(found).for_each(|(sum, part)| *sum += part);
        }
        left[lamp] -= 1;
        if left[lamp] == 0 {
            // Files of many angles and many luminaires would fill the memory.
            *sum = vec![sum.iter().copied().fold(0.0, f64::max)];
        }
    });
    sums.into_iter().zip(left).map(|(sum, left)| sum.first().copied().filter(|_| left == 0)).collect()
}

/// Numbers of the lights of each luminaire, by name: those of one prim that stand within a millimetre.
fn lamps(scene: &Scene, burning: &[usize]) -> Vec<Vec<usize>> {
    let mut lamps: BTreeMap<(&str, [i64; 3]), Vec<usize>> = BTreeMap::new();
    for number in burning {
        let light = &scene.lights[*number];
        let place = light.transform.point([0.0; 3]).map(|x| (1e3 * x).round() as i64);
        lamps.entry((&light.origin.name, place)).or_default().push(*number);
    }
    lamps.into_values().collect()
}

/// Directions within two angles from straight down in which the lights' files state intensities, and those angles in the planes of these directions.
fn stated(scene: &Scene, lights: &[usize], [from, to]: [f64; 2], up: [f64; 3]) -> Vec<[f64; 3]> {
    let [most, least] = [from, to].map(|angle| angle.to_radians().cos());
    let down = |w: &[f64; 3]| -(w[0] * up[0] + w[1] * up[1] + w[2] * up[2]);
    let all = lights.iter().flat_map(|light| stated_directions(&scene.lights[*light]));
    let within = |w: &[f64; 3]| (least - 1e-9..=most + 1e-9).contains(&down(w));
    let at_ends = |w: [f64; 3]| {
        let level: [f64; 3] = std::array::from_fn(|k| w[k] + down(&w) * up[k]);
        let length = level.iter().map(|x| x * x).sum::<f64>().sqrt();
        let end = move |cosine: f64| std::array::from_fn(|k| (1.0 - cosine * cosine).max(0.0).sqrt() * level[k] / length - cosine * up[k]);
        [most, least].into_iter().filter(move |_| length > 1e-6).map(end)
    };
    let mut found: Vec<[f64; 3]> = all.flat_map(|w| at_ends(w).chain(Some(w).filter(within))).collect();
    found.sort_by(|a, b| a.partial_cmp(b).unwrap_or(Ordering::Equal));
    found.dedup_by(|a, b| (0..3).all(|k| (a[k] - b[k]).abs() < 1e-9));
    found
}

/// Directions between two angles from straight down, all around.
fn directions([from, to]: [f64; 2], up: [f64; 3]) -> Vec<[f64; 3]> {
    let side = [up[1], up[2], up[0]];
    let other = [up[1] * side[2] - up[2] * side[1], up[2] * side[0] - up[0] * side[2], up[0] * side[1] - up[1] * side[0]];
    let [around, down] = [(360.0 / STEPS_DEG[0]) as usize, ((to - from) / STEPS_DEG[1]).ceil().max(1.0) as usize];
    let direction = |k: usize, j: usize| {
        let (sin, cos) = (from + (to - from) * j as f64 / down as f64).to_radians().sin_cos();
        let (y, x) = (STEPS_DEG[0] * k as f64).to_radians().sin_cos();
        std::array::from_fn(|axis| sin * (x * side[axis] + y * other[axis]) - cos * up[axis])
    };
    (0..around).flat_map(|k| (0..=down).map(move |j| direction(k, j))).collect()
}
