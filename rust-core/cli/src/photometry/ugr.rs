//! UGR tables for readers, pages and machines.

use crate::words::{UgrWords, Words};
use gonio_formats::{
    photometry::{Goniogram, REFLECTANCES, ROOMS, UgrTable},
    tame,
};
use gonio_page::fill;
use serde_json::{Value, json};

/// What a table holds beside its numbers.
pub(crate) fn caption(table: &UgrTable, words: &Words) -> String {
    fill(&words.ugr.caption, &[("spacing", &words.numbers.form(&table.spacing.to_string()))])
}

/// Names of the columns.
pub(crate) fn names(say: &UgrWords) -> Vec<String> {
    let of = |[ceiling, walls, plane]: [f64; 3]| [ceiling, walls, plane].map(|x| format!("{:.0}", 100.0 * x)).join("/");
    let directions = [&say.crosswise, &say.endwise].into_iter();
    let columns = directions.flat_map(|direction| REFLECTANCES.map(|reflectances| fill(direction, &[("reflectances", &of(reflectances))])));
    [say.room.clone()].into_iter().chain(columns).collect()
}

/// Rows of the room and its ten values.
pub(crate) fn rows(table: &UgrTable) -> Vec<Vec<String>> {
    let cell = |value: &Option<f64>| value.map_or("–".to_owned(), |value| format!("{value:.1}"));
    let row =
        |(values, [x, y]): (&[Option<f64>; 10], [f64; 2])| [format!("{x}H × {y}H")].into_iter().chain(values.iter().map(cell)).collect();
    table.values.iter().zip(ROOMS).map(row).collect()
}

/// The table line by line.
pub(super) fn as_text(goniogram: &Goniogram, table: &UgrTable) -> Vec<String> {
    let name = goniogram.text("LUMINAIRE").or_else(|| goniogram.text("LUMCAT")).unwrap_or("luminaire");
    let name = tame(name);
    let percents = |k: usize| REFLECTANCES.iter().chain(&REFLECTANCES).map(|all| format!("{:>6.0}", 100.0 * all[k])).collect::<String>();
    let mut lines = vec![format!("{name}: {}", caption(table, Words::english()))];
    lines.extend(["ceiling, %", "walls, %", "plane, %"].iter().enumerate().map(|(k, name)| format!("{name:<11}{}", percents(k))));
    lines.push(format!("{:<11}{:>30}{:>30}", "room", "crosswise (C0–C180)", "endwise (C90–C270)"));
    lines.extend(
        rows(table).iter().map(|row| format!("{:<11}{}", row[0], row[1..].iter().map(|cell| format!("{cell:>6}")).collect::<String>())),
    );
    lines
}

/// The table for machines.
pub(super) fn as_json(table: &UgrTable) -> Value {
    let half = |from: usize| table.values.iter().map(|row| &row[from..from + 5]).collect::<Vec<_>>();
    json!({
        "spacing_to_height": table.spacing,
        "rooms": ROOMS,
        "reflectances": REFLECTANCES,
        "crosswise": half(0),
        "endwise": half(5),
    })
}
