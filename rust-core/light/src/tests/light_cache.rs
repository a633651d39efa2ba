//! Light selection where some lights are known to arrive.

use super::harness::{NO_IMAGES, draw_with_cache, estimate, numbers};
use super::light_sampler::hall;
use crate::{Arrival, LightCache, LightKind, LightRecord, LightTable};
use gonio_simd::Execution;

const UP: [f32; 3] = [0.0, 0.0, 1.0];
const HERE: [f32; 3] = [19.3, 19.1, 0.2];

fn away(lamp: &LightRecord) -> f32 {
    (0..3).map(|axis| (lamp.to_world[3][axis] - HERE[axis]).powi(2)).sum::<f32>().sqrt()
}

/// A hall of 400 lamps in which walls stand around the ten nearest.
fn walled() -> (Vec<LightRecord>, LightTable, Vec<u32>, LightCache) {
    let lamps = hall(20);
    let table = LightTable::build(&lamps, NO_IMAGES, &[]);
    let mut nearest: Vec<u32> = (0..lamps.len() as u32).collect();
    nearest.sort_by(|a, b| away(&lamps[*a as usize]).total_cmp(&away(&lamps[*b as usize])));
    nearest.truncate(10);
    let arrival = |i: usize| {
        let light = nearest[i % 10];
        let distance = away(&lamps[light as usize]);
        Arrival { position: HERE, distance, light: Some(light), value: distance.powi(-2), receiver: 0 }
    };
    let arrivals: Vec<Arrival> = (0..200).map(arrival).collect();
    let cache = table.learn(&arrivals).expect("there is a tree");
    (lamps, table, nearest, cache)
}

#[test]
fn most_draws_are_among_known_lights() {
    let (_, table, nearest, cache) = walled();
    for execution in Execution::all() {
        let count = 1 << 14;
        let drawn = draw_with_cache(execution, &table, Some(&cache), HERE, UP, &numbers(41, count));
        let among = (0..count).filter(|i| nearest.contains(&drawn.light[*i]) && drawn.pdf[*i] > 0.0).count();
        assert!(among as f64 > 0.93 * count as f64, "{execution:?}: {among} of {count}");
    }
}

/// What is known changes the noise and not the light, also that of lights nobody knew, and at places nobody was.
#[test]
fn what_is_known_changes_no_light() {
    let (lamps, table, _, cache) = walled();
    for place in [HERE, [5.2, 31.7, 0.4]] {
        let lit = |lamp: &LightRecord| super::shape::illuminance(lamp, place.map(f64::from), UP.map(f64::from), 40)[1];
        let expected: f64 = lamps.iter().map(lit).sum();
        let count = 1 << 18;
        let drawn = draw_with_cache(Execution::best(), &table, Some(&cache), place, UP, &numbers(43, count));
        let (mean, error) = estimate(&drawn, UP.map(f64::from), count);
        assert!((mean[1] - expected).abs() < 4.9 * error[1] + 1e-3 * expected, "{place:?}: {} ± {} for {expected}", mean[1], error[1]);
    }
}

/// Where no draw has brought anything most are given up, and the others weigh what those would have brought.
#[test]
fn draws_in_vain_are_given_up_and_change_no_light() {
    let (lamps, table, ..) = walled();
    let elsewhere = Arrival { position: [100.0; 3], distance: 5.0, light: Some(0), value: 1.0, receiver: 0 };
    let arrivals: Vec<Arrival> = [elsewhere].into_iter().chain((0..200).map(|_| Arrival::nothing(HERE, 0))).collect();
    let cache = table.learn(&arrivals).expect("something has arrived");
    let count = 1 << 18;
    let drawn = draw_with_cache(Execution::best(), &table, Some(&cache), HERE, UP, &numbers(53, count));
    let going_on = (0..count).filter(|i| drawn.pdf[*i] > 0.0).count();
    assert!(going_on < count / 8, "{going_on} of {count}");
    let lit = |lamp: &LightRecord| super::shape::illuminance(lamp, HERE.map(f64::from), UP.map(f64::from), 40)[1];
    let expected: f64 = lamps.iter().map(lit).sum();
    let (mean, error) = estimate(&drawn, UP.map(f64::from), count);
    assert!((mean[1] - expected).abs() < 4.9 * error[1] + 1e-3 * expected, "{} ± {} for {expected}", mean[1], error[1]);
}

/// A sun has no leaf in the tree; where it alone has arrived, something has.
#[test]
fn light_from_far_is_no_draw_in_vain() {
    let mut lights = hall(20);
    lights.push(LightRecord { radiance: [10.0; 3], ..LightRecord::new(LightKind::Distant) });
    let sun = Arrival { position: HERE, distance: 1e6, light: Some(lights.len() as u32 - 1), value: 1.0, receiver: 0 };
    let lamp = Arrival { position: [100.0; 3], distance: 5.0, light: Some(0), value: 1.0, receiver: 0 };
    let table = LightTable::build(&lights, NO_IMAGES, &[]);
    let cache = table.learn(&[vec![sun; 200], vec![lamp]].concat()).expect("something has arrived");
    let count = 1 << 14;
    let drawn = draw_with_cache(Execution::best(), &table, Some(&cache), HERE, UP, &numbers(59, count));
    let going_on = (0..count).filter(|i| drawn.pdf[*i] > 0.0).count();
    assert!(going_on as f64 > 0.95 * count as f64, "{going_on} of {count}");
}

#[test]
fn rays_that_meet_a_light_weigh_it_as_it_was_drawn() {
    let (_, table, _, cache) = walled();
    for execution in Execution::all() {
        let drawn = draw_with_cache(execution, &table, Some(&cache), HERE, UP, &numbers(47, 4096));
        let mut compared = 0;
        for i in (0..4096).filter(|i| drawn.pdf[*i] > 0.0) {
            let (pdf, again) = (f64::from(drawn.pdf[i]), f64::from(drawn.eval_pdf[i]));
            assert!((pdf - again).abs() < 2e-3 * pdf, "{execution:?}: {pdf} drawn, {again} weighed");
            compared += 1;
        }
        assert!(compared > 3500);
    }
}

#[test]
fn few_lights_and_no_arrivals_teach_nothing() {
    let (_, table, ..) = walled();
    assert!(table.learn(&[]).is_none());
    let few = LightTable::build(&hall(3), NO_IMAGES, &[]);
    assert!(few.learn(&[Arrival { position: HERE, distance: 1.0, light: Some(0), value: 1.0, receiver: 0 }]).is_none());
}
