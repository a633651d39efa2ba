//! The sheet for a terminal.

use crate::{
    bound::{Bound, Verdict},
    estimate::Estimate,
    sheet::{Row, Sheet},
    words::{Words, words},
};
use gonio_formats::tame;
use gonio_page::{Language, Numbers};

/// The columns of a line.
const COLUMNS: usize = 5;

/// The sheet as lines of a table, a line for each requirement, with what a reader should know below it.
pub fn lines(sheet: &Sheet) -> Vec<String> {
    let (words, numbers) = words(Language::English);
    let head = [&words.verdict, &words.area, &words.quantity, &words.required, &words.reached].map(|name| name.to_lowercase());
    let rows: Vec<[String; COLUMNS]> = sheet.rows.iter().map(|row| cells(row, &words, numbers)).collect();
    let width = |column: usize| rows.iter().chain([&head]).map(|cells| cells[column].chars().count()).max().unwrap_or(0);
    let widths: [usize; COLUMNS] = std::array::from_fn(width);
    let line = |cells: &[String; COLUMNS]| {
        let padded = cells.iter().zip(widths).map(|(cell, width)| format!("{cell:width$}"));
        padded.collect::<Vec<_>>().join("  ").trim_end().to_owned()
    };
    let mut lines = vec![sheet.title(), line(&head)];
    for (row, cells) in sheet.rows.iter().zip(&rows) {
        lines.push(line(cells));
        lines.extend(row.requirement.label.iter().map(|label| format!("  {label}")));
        lines.extend(row.notes.iter().map(|note| format!("  {}", note.told(&words, numbers))));
    }
    lines.push(counted(sheet, &words));
    lines.push(words.no_certificate.clone());
    // Texts of files must not reach into the terminal.
    lines.iter().map(|line| tame(&line.replace('\u{a0}', " "))).collect()
}

/// How many lines have each verdict.
pub(crate) fn counted(sheet: &Sheet, words: &Words) -> String {
    let told = |verdict: &Verdict| {
        let count = sheet.count(*verdict);
        (count > 0).then(|| format!("{count} {}", words.of_verdict(*verdict)))
    };
    Verdict::ALL.iter().filter_map(told).collect::<Vec<_>>().join(", ")
}

fn cells(row: &Row, words: &Words, numbers: Numbers) -> [String; COLUMNS] {
    let wanted = &row.requirement;
    [
        words.of_verdict(row.verdict).to_owned(),
        wanted.area.clone(),
        words.of_quantity(&wanted.quantity, wanted.of.as_deref()),
        required(row, numbers),
        reached(row, numbers),
    ]
}

/// The limit with its sign.
pub(crate) fn required(row: &Row, numbers: Numbers) -> String {
    let sign = if row.requirement.bound == Bound::AtLeast { '≥' } else { '≤' };
    format!("{sign}\u{a0}{}", numbers.limit(row.requirement.limit, &row.unit))
}

/// What was reached; a dash where nothing was measured.
pub(crate) fn reached(row: &Row, numbers: Numbers) -> String {
    let figure = row.reached.as_ref().map(|reached| Estimate::new(reached.value, reached.standard_error));
    figure.map_or("–".to_owned(), |figure| numbers.beside(figure.value, figure.error, row.requirement.limit, &row.unit))
}
