//! The options' part of `docs/usd.md`; `GONIO_WRITE_DOCS=1 cargo test -p gonio-cli` writes it anew.

use super::table::{ROWS, State};
use std::path::Path;

const START: &str = "<!-- options: begin -->\n";
const END: &str = "<!-- options: end -->\n";

/// The table in Markdown.
fn page() -> String {
    let mut text = "| option | whose | state | gonio's own | note |\n| --- | --- | --- | --- | --- |\n".to_owned();
    for row in ROWS {
        let names: Vec<String> = row.names.iter().map(|name| format!("`{name}`")).collect();
        let own = match row.state {
            State::Works(own) | State::Read(own) => format!("`{own}`"),
            State::Idle | State::Refused => "–".to_owned(),
        };
        let note = row.note.replace('|', "\\|").replace('<', "&lt;").replace('*', "\\*");
        text += &format!("| {} | {} | {} | {own} | {note} |\n", names.join(", "), row.program.name(), row.state.name());
    }
    text
}

#[test]
fn the_page_is_the_table() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/usd.md");
    let text = std::fs::read_to_string(&path).expect("docs/usd.md");
    let (before, rest) = text.split_once(START).expect("a mark where the table begins");
    let (found, after) = rest.split_once(END).expect("a mark where the table ends");
    if std::env::var_os("GONIO_WRITE_DOCS").is_some() {
        std::fs::write(&path, format!("{before}{START}{}{END}{after}", page())).expect("docs/usd.md can be written");
    } else {
        assert!(found == page(), "docs/usd.md is old: GONIO_WRITE_DOCS=1 cargo test -p gonio-cli the_page");
    }
}
