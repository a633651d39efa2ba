//! Metrics by hand.

use super::{group, made_up, settings};
use crate::{
    Blinds, Coefficients, Control, Division, ElectricLight, Grid, Group, Level, Schedule, Sensor, Settings, Year, evaluate, sky::SkyMatrix,
};

fn year() -> Year {
    made_up()
}

/// What an unobstructed level point has of each patch, times a factor.
fn level(factor: f64) -> Vec<f32> {
    let division = Division::new(1).expect("a division");
    division.patches().iter().map(|patch| (factor * patch.direction()[2].max(0.0) * patch.solid_angle) as f32).collect()
}

fn found(groups: &[Group], settings: &Settings) -> Grid {
    let year = year();
    let schedule = Schedule::daily(&year, 8.0, 18.0).expect("a schedule");
    evaluate(&year, &schedule, groups, settings, &mut |_| true).expect("fits").expect("not stopped")
}

/// Light of a level surface outside by the patches, in each used step, lx.
fn outside() -> Vec<f64> {
    let year = year();
    let matrix = SkyMatrix::new(&year, settings().sky).expect("a matrix");
    let used: Vec<usize> = (0..year.steps.len()).filter(|step| (8.0..18.0).contains(&year.steps[*step].hour)).collect();
    let columns = matrix.columns(&used, 1);
    columns.chunks(146).map(|column| column.iter().zip(level(1.0)).map(|(a, b)| f64::from(*a) * f64::from(b)).sum()).collect()
}

#[test]
fn autonomy_and_useful_light_are_counted() {
    let (outside, factor) = (outside(), 0.02);
    let grid = found(&[group(&[level(factor), level(0.0)])], &settings());
    let share = |has: &dyn Fn(f64) -> bool| outside.iter().filter(|value| has(**value * factor)).count() as f64 / 3650.0;
    let point = grid.points[0];
    assert_eq!(grid.used_hours, 3650.0);
    assert_eq!(point.da_300, share(&|lux| lux >= 300.0));
    assert_eq!(point.udi_100_300, share(&|lux| (100.0..300.0).contains(&lux)));
    assert_eq!(point.udi_300_3000, share(&|lux| (300.0..=3000.0).contains(&lux)));
    assert_eq!(point.udi_above_3000, share(&|lux| lux > 3000.0));
    assert!((point.udi_below_100 - share(&|lux| lux < 100.0)).abs() < 1e-12);
    assert!((point.udi_100_3000 - point.udi_100_300 - point.udi_300_3000).abs() < 1e-12);
    let mean = outside.iter().sum::<f64>() * factor / 3650.0;
    let credit = outside.iter().map(|value| (value * factor / 300.0).min(1.0)).sum::<f64>() / 3650.0;
    assert!((point.mean_lx / mean - 1.0).abs() < 1e-5 && (point.cda_300 / credit - 1.0).abs() < 1e-5);
    assert!(point.da_300 > 0.3 && point.da_300 < 0.9 && point.udi_above_3000 == 0.0);
    let dark = grid.points[1];
    assert_eq!((dark.mean_lx, dark.da_300, dark.udi_below_100), (0.0, 0.0, 1.0));
    assert!(grid.ase_1000_250.is_none() && dark.hours_direct_1000.is_none());
    assert_eq!(grid.sda_300_50, if point.da_300 >= 0.5 { 0.5 } else { 0.0 });
}

#[test]
fn chunks_and_threads_change_nothing() {
    let groups = [group(&[level(0.03), level(0.01), level(0.2)])];
    let whole = found(&groups, &settings());
    assert_eq!(whole, found(&groups, &Settings { memory: 1, threads: 1, ..settings() }));
}

#[test]
fn daylight_factors_are_shares_of_the_outside() {
    let grid = found(&[group(&[level(0.02), level(0.04), level(0.5)])], &settings());
    for (point, expected) in grid.points.iter().zip([2.0, 4.0, 50.0]) {
        // The patches' light is that of the level surface to the rounding of 32 bits.
        assert!((point.daylight_factor / expected - 1.0).abs() < 1e-5);
    }
    assert!((grid.median_daylight_factor / 4.0 - 1.0).abs() < 1e-5);
}

#[test]
fn en_17037_asks_for_target_and_minimum() {
    // All of the daylight hours lie among the 3285 lit ones, so half of the 4380 are 2190 lit steps.
    let sorted = {
        let year = year();
        let matrix = SkyMatrix::new(&year, settings().sky).expect("a matrix");
        let lit: Vec<usize> = (0..year.steps.len()).filter(|step| matrix.conditions(*step).is_some()).collect();
        assert_eq!(lit.len(), 3285);
        let columns = matrix.columns(&lit, 1);
        let mut lux: Vec<f64> =
            columns.chunks(146).map(|column| column.iter().zip(level(1.0)).map(|(a, b)| f64::from(*a) * f64::from(b)).sum()).collect();
        lux.sort_by(|a, b| b.total_cmp(a));
        lux
    };
    // The light outside that is there in 2190 steps.
    let there = sorted[2189];
    let at = |lux: f64| level(lux / there * 1.001);
    let level_of = |points: &[f64]| found(&[group(&points.iter().map(|lux| at(*lux)).collect::<Vec<_>>())], &settings()).en17037.hourly;
    assert_eq!(level_of(&[300.0, 100.0]).level, Level::Minimum);
    assert_eq!(level_of(&[500.0, 300.0]).level, Level::Medium);
    assert_eq!(level_of(&[750.0, 500.0]).level, Level::High);
    assert_eq!(level_of(&[750.0, 299.0]).level, Level::Minimum);
    assert_eq!(level_of(&[299.0, 299.0]).level, Level::None);
    assert_eq!(level_of(&[750.0, 750.0, 99.0]).level, Level::None);
    assert_eq!(level_of(&[500.0, 300.0]).area_100_300_500_750, [1.0, 1.0, 0.5, 0.0]);
}

/// Coefficients of the suns: every sun gives a share of its light on a facing surface.
fn suns(shares: &[f32]) -> Coefficients {
    let count = year().sunny_steps().len();
    let disc = (std::f64::consts::PI * (0.533_f64 / 2.0).to_radians().powi(2)) as f32;
    let rows: Vec<f32> = shares.iter().flat_map(|share| std::iter::repeat_n(share * disc, count)).collect();
    Coefficients::new(shares.len(), count, vec![rows]).expect("coefficients")
}

/// Used steps in which the sun's light on a facing surface, times a share, is at least some lux.
fn sunny(share: f64, lux: f64) -> usize {
    let year = year();
    let matrix = SkyMatrix::new(&year, settings().sky).expect("a matrix");
    let used = year.sunny_steps().into_iter().filter(|step| (8.0..18.0).contains(&year.steps[*step].hour));
    used.filter(|step| matrix.conditions(*step).is_some_and(|now| now.direct_normal * share >= lux)).count()
}

#[test]
fn direct_sun_is_counted_at_its_real_place() {
    let shares = [0.5, 0.02, 0.012, 0.0];
    let mut with_sun = group(&[level(0.02), level(0.02), level(0.02), level(0.02)]);
    with_sun.direct = Some(suns(&shares));
    let grid = found(&[with_sun], &settings());
    for (point, share) in grid.points.iter().zip(shares) {
        assert_eq!(point.hours_direct_1000, Some(sunny(f64::from(share), 1000.0) as f64));
    }
    let beyond = shares.iter().filter(|share| sunny(f64::from(**share), 1000.0) > 250).count();
    assert!((1..4).contains(&beyond));
    assert_eq!(grid.ase_1000_250, Some(beyond as f64 / 4.0));
}

#[test]
fn blinds_close_while_more_than_two_per_cent_of_the_points_are_in_the_sun() {
    // One of fifty points is not more than two per cent, two are.
    for (bright, closes) in [(1, false), (2, true)] {
        let mut shares = vec![0.0; 50];
        shares[..bright].fill(0.5);
        let mut with_blinds = group(&vec![level(0.02); 50]);
        let open = found(&[with_blinds.clone()], &settings());
        with_blinds.direct = Some(suns(&shares));
        with_blinds.blinds = Some(Blinds::Share(0.0));
        let grid = found(&[with_blinds], &settings());
        let closed = grid.points[0].udi_below_100 - open.points[0].udi_below_100;
        assert_eq!(closed > 0.1, closes, "{closed}");
        // Exposure is that of open blinds.
        assert_eq!(grid.points[0].hours_direct_1000, Some(sunny(0.5, 1000.0) as f64));
        assert_eq!(grid.ase_1000_250, Some(bright as f64 / 50.0));
    }
}

#[test]
fn groups_have_blinds_of_their_own_and_their_light_adds_up() {
    let plain = Group { direct: Some(suns(&[0.0])), blinds: Some(Blinds::Share(0.0)), ..group(&[level(0.01)]) };
    let sunny =
        Group { direct: Some(suns(&[0.5])), blinds: Some(Blinds::Coefficients(group(&[level(0.002)]).open)), ..group(&[level(0.01)]) };
    let both = found(&[plain.clone(), sunny.clone()], &settings()).points[0].mean_lx;
    let [of_plain, of_sunny] = [plain, sunny.clone()].map(|group| found(&[group], &settings()).points[0].mean_lx);
    let open = found(&[Group { blinds: None, ..sunny }], &settings()).points[0].mean_lx;
    assert!((both / (of_plain + of_sunny) - 1.0).abs() < 1e-5 && of_sunny < 0.9 * open && (of_plain / open - 1.0).abs() < 1e-5);
}

#[test]
fn schedules_close_blinds_in_their_hours() {
    let closed = Schedule::daily(&year(), 12.0, 24.0).expect("a schedule");
    let open = group(&[level(0.01)]);
    let scheduled = Group { blinds: Some(Blinds::Share(0.0)), closed: Some(closed), ..open.clone() };
    let [open, scheduled] = [open, scheduled].map(|group| found(&[group], &settings()));
    // Five hours with light of each day's ten, which lasts until 17 o'clock.
    assert!(scheduled.closed_hours == [5.0 * 365.0] && open.closed_hours.is_empty());
    let share = scheduled.points[0].mean_lx / open.points[0].mean_lx;
    let light = outside();
    let morning = light.iter().enumerate().filter(|(used, _)| used % 10 < 4).map(|(_, lux)| lux).sum::<f64>() / light.iter().sum::<f64>();
    assert!((share / morning - 1.0).abs() < 1e-5, "{share} {morning}");
}

#[test]
fn a_sun_with_all_its_bounces_takes_the_place_of_the_one_in_the_patches() {
    let only_sky = group(&[level(0.02)]);
    let with_sun = Group { sun: Some(suns(&[0.0])), ..only_sky.clone() };
    let [all, sky] = [only_sky, with_sun].map(|group| found(&[group], &settings()).points[0].mean_lx);
    assert!(sky < 0.9 * all && sky > 0.0);
}

#[test]
fn blocks_give_standard_errors() {
    // Two estimates that are 10 % above and below: the mean's standard error is 10 % of it.
    let blocks = vec![level(0.018), level(0.022)];
    let open = Coefficients::new(1, 146, blocks).expect("coefficients");
    let grid = found(&[Group { open, direct: None, sun: None, scattered: None, blinds: None, closed: None }], &settings());
    let errors = grid.standard_errors.as_ref().expect("errors");
    assert!((errors.points[0].mean_lx / grid.points[0].mean_lx - 0.1).abs() < 1e-4);
    assert!((errors.median_daylight_factor / grid.median_daylight_factor - 0.1).abs() < 1e-4);
    assert!(errors.points[0].da_300 > 0.0 && errors.ase_1000_250.is_none());
    // Blocks of the direct light alone: its hours have an error, all else has none.
    let both = Coefficients {
        blocks: vec![suns(&[0.5]).blocks.concat(), suns(&[0.02]).blocks.concat(), suns(&[0.0]).blocks.concat()],
        ..suns(&[0.5])
    };
    let grid = found(&[Group { direct: Some(both), ..group(&[level(0.02)]) }], &settings());
    let errors = grid.standard_errors.as_ref().expect("errors");
    assert!(errors.points[0].hours_direct_1000.is_some_and(|error| error > 0.0));
    assert_eq!((errors.points[0].mean_lx, errors.median_daylight_factor), (0.0, 0.0));
}

#[test]
fn electric_light_gives_what_daylight_lacks() {
    let sensor = Sensor::Least;
    let lamps =
        ElectricLight { power_w_m2: 10.0, target_lx: 400.0, sensor, presence: 0.8, standby_kwh_m2: 1.5, ..ElectricLight::default() };
    let electric = |lamps: ElectricLight| {
        found(&[group(&[level(0.03), level(0.01)])], &Settings { electric: Some(lamps), ..settings() }).electric.expect("lamps")
    };
    // Light falls from 8 to 17 by the records' rule; the other used hours are dark.
    let lit: Vec<f64> = outside().into_iter().filter(|value| *value > 0.0).collect();
    let dimmed = |daylight: f64| (1.0 - daylight / 400.0).clamp(0.1, 1.0);
    let hours = |load: &dyn Fn(f64) -> f64| lit.iter().map(|value| load(*value)).sum::<f64>() + 3650.0 - lit.len() as f64;
    let close = |a: f64, b: f64| assert!((a / b - 1.0).abs() < 1e-5, "{a} {b}");
    let least = electric(lamps);
    close(least.full_load_hours, hours(&|value| dimmed(0.01 * value)));
    close(least.leni_kwh_m2, 10.0 * 0.8 * least.full_load_hours * 1e-3 + 1.5);
    close(least.leni_without_daylight_kwh_m2, 10.0 * 0.8 * 3.65 + 1.5);
    close(least.daylight_hours, lit.len() as f64);
    close(least.daylight_dependency.expect("light"), (least.full_load_hours - 3650.0 + least.daylight_hours) / least.daylight_hours);
    let of_sensor = |sensor| electric(ElectricLight { sensor, ..lamps }).full_load_hours;
    close(of_sensor(Sensor::Mean), hours(&|value| dimmed(0.02 * value)));
    close(of_sensor(Sensor::Points), hours(&|value| 0.5 * (dimmed(0.03 * value) + dimmed(0.01 * value))));
    let switched = electric(ElectricLight { control: Control::Switching, ..lamps }).full_load_hours;
    close(switched, hours(&|value| f64::from(0.01 * value < 400.0)));
}

#[test]
fn lamps_out_of_their_range_are_told() {
    let year = year();
    let schedule = Schedule::daily(&year, 8.0, 18.0).expect("a schedule");
    for (lamps, words) in [
        (ElectricLight { target_lx: 0.0, ..ElectricLight::default() }, "lighting-target"),
        (ElectricLight { least: 2.0, ..ElectricLight::default() }, "expected 0 to 1"),
        (ElectricLight { power_w_m2: f64::NAN, ..ElectricLight::default() }, "lighting-power"),
    ] {
        let settings = Settings { electric: Some(lamps), ..settings() };
        let error = evaluate(&year, &schedule, &[group(&[level(0.1)])], &settings, &mut |_| true).expect_err("out of range");
        assert!(error.to_string().contains(words), "{error}");
    }
}
