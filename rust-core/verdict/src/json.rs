//! The sheet for machines.

use crate::{
    bound::Verdict,
    sheet::{Reached, Row, Sheet},
    words::words,
};
use gonio_page::Language;
use serde_json::{Value, json as object};

/// The sheet as JSON; `docs/verdict.md` lists its keys. Notes are in English. What is infinite is `null`.
pub fn json(sheet: &Sheet) -> Value {
    object!({
        "title": sheet.title(),
        "gonio": env!("CARGO_PKG_VERSION"),
        "verdict": sheet.verdict().key(),
        "counts": Verdict::ALL.iter().map(|verdict| (verdict.key().to_owned(), sheet.count(*verdict).into())).collect::<serde_json::Map<_, _>>(),
        "requirements": sheet.rows.iter().map(row).collect::<Vec<_>>(),
        "files": sheet.sources.iter().map(|source| object!({ "path": source.path.to_string_lossy(), "sha256": source.sha256 })).collect::<Vec<_>>(),
    })
}

fn row(row: &Row) -> Value {
    let (words, numbers) = words(Language::English);
    let wanted = &row.requirement;
    object!({
        "line": wanted.line,
        "area": wanted.area,
        "quantity": wanted.quantity,
        "of": wanted.of,
        "label": wanted.label,
        "bound": wanted.bound.key(),
        "required": wanted.limit,
        "unit": row.unit,
        "maintenance_factor": wanted.maintenance_factor,
        "verdict": row.verdict.key(),
        "reached": row.reached.as_ref().map(reached),
        "notes": row.notes.iter().map(|note| note.told(&words, numbers)).collect::<Vec<_>>(),
    })
}

fn reached(reached: &Reached) -> Value {
    object!({
        "area": reached.area,
        "file": reached.file.to_string_lossy(),
        "value": reached.value,
        "standard_error": reached.standard_error,
        "interval": reached.interval,
        "margin": reached.margin,
        "more_samples": reached.more_samples,
    })
}
