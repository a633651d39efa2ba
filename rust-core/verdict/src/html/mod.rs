//! One page that needs nothing beside itself.

mod gauge;
mod plan;

use crate::{
    bound::Verdict,
    measured::Area,
    plan::Plan,
    sheet::{Row, Sheet},
    text::{counted, reached, required},
    words::{Words, words},
};
use gonio_page::{Language, Numbers, escaped, fill};

/// How the page looks, on screens of any size, light and dark, and on A4.
const STYLE: &str = include_str!("style.css");
/// The verdicts' signs: a tick, waves, a cross, a dash, each in a circle.
const SIGNS: &str = include_str!("signs.svg");

/// A page that grows.
struct Page<'a> {
    sheet: &'a Sheet,
    words: Words,
    numbers: Numbers,
    text: String,
}

/// The sheet as HTML, made on a day.
pub fn page(sheet: &Sheet, language: Language, date: &str) -> String {
    let (words, numbers) = words(language);
    let mut page = Page { sheet, words, numbers, text: String::new() };
    let (code, title) = (language.code(), escaped(&sheet.title()));
    page.add(&format!("<!DOCTYPE html>\n<html lang=\"{code}\">\n<head>\n<meta charset=\"utf-8\">\n"));
    page.add("<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n");
    page.add(&format!("<title>{title}</title>\n<style>\n{STYLE}</style>\n</head>\n<body>\n{SIGNS}"));
    page.head(&title, date);
    page.lines();
    page.plans();
    page.reading();
    page.files();
    page.add("</body>\n</html>\n");
    page.text
}

impl Page<'_> {
    fn add(&mut self, text: &str) {
        self.text.push_str(text);
    }

    fn section(&mut self, title: &str) {
        self.add(&format!("<h2>{}</h2>\n", escaped(title)));
    }

    fn head(&mut self, title: &str, date: &str) {
        let (words, wanted) = (&self.words, &self.sheet.requirements);
        let program = format!("gonio {}", env!("CARGO_PKG_VERSION"));
        let file = wanted.path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let free = [(&words.project, &wanted.project), (&words.place, &wanted.place), (&words.author, &wanted.author)];
        let given = free.into_iter().filter_map(|(name, text)| Some((name, text.clone()?)));
        let known = [(&words.date, date.to_owned()), (&words.program, program), (&words.requirements, file)];
        let facts: String =
            given.chain(known).map(|(name, fact)| format!("<dt>{}</dt><dd>{}</dd>\n", escaped(name), escaped(&fact))).collect();
        let verdict = self.sheet.verdict();
        let (key, all, counts) = (verdict.key(), escaped(words.of_all(verdict)), escaped(&counted(self.sheet, words)));
        let kind = escaped(&words.sheet);
        let head = format!("<header>\n<p class=\"kind\">{kind}</p>\n<h1>{title}</h1>\n<dl>\n{facts}</dl>\n");
        let sum = format!("<div class=\"all {key}\">{}<div><strong>{all}</strong>{counts}</div></div>\n</header>\n", sign(verdict));
        self.add(&(head + &sum));
    }

    fn lines(&mut self) {
        let words = &self.words;
        let what = format!("{}: {}", words.area, words.quantity);
        let names = [&words.verdict, &what, &words.required, &words.reached];
        let names = names.map(|name| format!("<th scope=\"col\">{}</th>", escaped(name))).concat();
        let rows: String = self.sheet.rows.iter().enumerate().map(|(number, row)| self.line(number, row)).collect();
        let head = format!("<thead><tr><th scope=\"col\">#</th>{names}</tr></thead>");
        self.add(&format!("<table class=\"lines\">\n{head}\n<tbody>\n{rows}</tbody>\n</table>\n"));
    }

    fn line(&self, number: usize, row: &Row) -> String {
        let (words, wanted, key) = (&self.words, &row.requirement, row.verdict.key());
        let quantity = escaped(&words.of_quantity(&wanted.quantity, wanted.of.as_deref()));
        let label = wanted.label.iter().map(|label| format!("<span class=\"label\">{}</span>", escaped(label)));
        let notes = row.notes.iter().map(|note| format!("<span class=\"note\">{}</span>", escaped(&note.told(words, self.numbers))));
        let more: String = label.chain(notes).collect();
        let verdict = format!("<span class=\"badge\">{}{}</span>", sign(row.verdict), escaped(words.of_verdict(row.verdict)));
        let gauge = row.reached.as_ref().map_or(String::new(), |reached| gauge::gauge(reached, &row.requirement));
        let figure = |name: &str, text: &str, more: &str| {
            format!("<td class=\"figure\" data-name=\"{}\"><div>{}{more}</div></td>", escaped(name), escaped(text))
        };
        format!(
            "<tr class=\"{key}\"><td class=\"line\">{}</td><td>{verdict}</td><td class=\"what\"><b>{}</b>, {quantity}{more}</td>{}{}</tr>\n",
            number + 1,
            escaped(&wanted.area),
            figure(&words.required, &required(row, self.numbers), ""),
            figure(&words.reached, &reached(row, self.numbers), &gauge)
        )
    }

    fn plans(&mut self) {
        let plans = self.sheet.plans();
        if plans.is_empty() {
            return;
        }
        let title = self.words.plans.clone();
        let figures: String = plans.into_iter().map(|(area, plan, lines)| self.plan(area, plan, &lines)).collect();
        self.section(&title);
        self.add(&figures);
    }

    fn plan(&self, area: &Area, plan: &Plan, lines: &[usize]) -> String {
        let words = &self.words;
        let drawn = plan::Drawn::new(plan, self.numbers);
        let lines = lines.iter().map(|line| (line + 1).to_string()).collect::<Vec<_>>().join(", ");
        let sizes = [0, 1].map(|axis| format!("{:.2}", plan.size[axis] as f64 * plan.spacing[axis]));
        let size = self.numbers.form(&format!("{} × {} m", sizes[0], sizes[1]));
        let unit = if plan.unit.is_empty() { String::new() } else { format!(", {}", plan.unit) };
        let mut notes = vec![fill(&words.for_lines, &[("lines", &lines)]), size, words.least_point.clone()];
        notes.extend((drawn.block > 1).then(|| fill(&words.blocks, &[("count", &drawn.block.to_string())])));
        let what = words.of_quantity(&plan.of, None);
        format!(
            "<figure><figcaption><b>{}</b>: {}{} <span class=\"soft\">({})</span></figcaption>{}</figure>\n",
            escaped(&area.name),
            escaped(&what),
            escaped(&unit),
            escaped(&notes.join("; ")),
            drawn.svg
        )
    }

    fn reading(&mut self) {
        let title = self.words.reading.clone();
        let texts: String = self.words.explained.iter().map(|text| format!("<p>{}</p>\n", escaped(text))).collect();
        self.section(&title);
        self.add(&format!("<div class=\"reading\">\n{texts}</div>\n"));
    }

    fn files(&mut self) {
        let title = self.words.files.clone();
        let row = |path: &str, sum: &str| format!("<tr><td>{}</td><td><code>{sum}</code></td></tr>\n", escaped(path));
        let rows: String = self.sheet.sources.iter().map(|source| row(&source.path.to_string_lossy(), &source.sha256)).collect();
        let head = format!("<thead><tr><th scope=\"col\">{}</th><th scope=\"col\">SHA-256</th></tr></thead>", escaped(&self.words.file));
        let end = escaped(&self.words.no_certificate);
        self.section(&title);
        self.add(&format!("<table class=\"sums\">\n{head}\n<tbody>\n{rows}</tbody>\n</table>\n<footer>{end}</footer>\n"));
    }
}

/// A verdict's sign.
fn sign(verdict: Verdict) -> String {
    format!("<svg class=\"icon\" aria-hidden=\"true\"><use href=\"#{}\"/></svg>", verdict.key())
}
