//! Verdicts by the standard error.

use super::{grid, meter, one, sheet};
use crate::{Verdict, bound::more_samples, estimate::Estimate};
use serde_json::json;

fn verdict(keys: &str) -> Verdict {
    one(keys, &[grid()]).expect(keys).verdict()
}

#[test]
fn two_standard_errors_part_the_verdicts() {
    // The mean is 510 ± 4.
    for (bound, expected) in [
        ("at_least = 501.9", Verdict::Met),
        ("at_least = 502", Verdict::Met),
        ("at_least = 502.1", Verdict::WithinError),
        ("at_least = 517.9", Verdict::WithinError),
        ("at_least = 518.1", Verdict::NotMet),
        ("at_most = 518", Verdict::Met),
        ("at_most = 517.9", Verdict::WithinError),
        ("at_most = 501.9", Verdict::NotMet),
    ] {
        assert_eq!(verdict(&format!("area = 'Desk'; quantity = 'mean'; {bound}")), expected, "{bound}");
    }
}

#[test]
fn a_figure_without_noise_meets_its_own_limit() {
    let road = super::road();
    let of = |bound: &str| one(&format!("area = 'road'; quantity = 'ti'; {bound}"), std::slice::from_ref(&road)).expect(bound).verdict();
    assert_eq!([of("at_most = 13.7"), of("at_most = 13.69999"), of("at_least = 13.7")], [Verdict::Met, Verdict::NotMet, Verdict::Met]);
}

#[test]
fn maintenance_scales_figure_and_error() {
    let found = one("area = 'Desk'; quantity = 'mean'; at_least = 400; maintenance_factor = 0.8", &[grid()]).expect("a sheet");
    let reached = found.rows[0].reached.clone().expect("a figure");
    assert!((reached.value - 408.0).abs() < 1e-9 && (reached.standard_error.expect("an error") - 3.2).abs() < 1e-9);
    assert_eq!(found.verdict(), Verdict::Met);
    assert_eq!(verdict("area = 'Desk'; quantity = 'mean'; at_least = 420; maintenance_factor = 0.8"), Verdict::NotMet);
}

#[test]
fn ratios_have_the_errors_of_both_parts() {
    let found = one("area = 'Desk'; quantity = 'uniformity'; at_least = 0.6", &[grid()]).expect("a sheet");
    let reached = found.rows[0].reached.clone().expect("a figure");
    assert!((reached.value - 400.0 / 510.0).abs() < 1e-12);
    let expected = 400.0 / 510.0 * (30.0f64 / 400.0).hypot(4.0 / 510.0);
    assert!((reached.standard_error.expect("an error") - expected).abs() < 1e-12);
    let diversity = one("area = 'Desk'; quantity = 'diversity'; at_least = 0.6", &[grid()]).expect("a sheet");
    assert!((diversity.rows[0].reached.as_ref().expect("a figure").value - 0.625).abs() < 1e-12);
}

#[test]
fn so_many_samples_put_the_limit_two_errors_away() {
    // A gap of 2 and an error of 4: the error has to be 1.
    let times = more_samples(Estimate::new(510.0, Some(4.0)), 2.0);
    assert!((times - 16.0).abs() < 1e-12 && ((4.0 / times.sqrt()) * 2.0 - 2.0).abs() < 1e-12);
    let on_it = one("area = 'Desk'; quantity = 'mean'; at_least = 510", &[grid()]).expect("a sheet");
    assert_eq!(on_it.rows[0].reached.as_ref().and_then(|reached| reached.more_samples), Some(f64::INFINITY));
    assert_eq!(crate::json(&on_it)["requirements"][0]["reached"]["more_samples"], json!(null));
}

#[test]
fn the_worst_line_is_the_sheets_verdict() {
    let lines = |bounds: &[&str]| {
        let each: String = bounds.iter().map(|bound| format!("[[require]]\narea = 'Desk'\nquantity = 'mean'\n{bound}\n")).collect();
        sheet(&each, &[grid()]).expect("a sheet").verdict()
    };
    assert_eq!(lines(&["at_least = 400", "at_least = 300"]), Verdict::Met);
    assert_eq!(lines(&["at_least = 400", "at_least = 509"]), Verdict::WithinError);
    assert_eq!(lines(&["at_least = 600", "at_least = 509"]), Verdict::NotMet);
    assert_eq!(verdict("area = 'Disk'; quantity = 'mean'; at_least = 1"), Verdict::NotMet);
}

#[test]
fn what_is_null_was_not_measured() {
    let found = one("area = '2,3,1.2'; quantity = 'ugr'; at_most = 19", &[meter("2,3,1.2", "ugr", "", json!(null))]).expect("a sheet");
    assert_eq!(found.rows[0].verdict, Verdict::NotMeasured);
}
