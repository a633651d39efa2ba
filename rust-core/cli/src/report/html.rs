//! One HTML page that needs nothing beside itself.

use super::head::Head;
use crate::{
    file::{ending, put},
    words::Words,
};
use base64::{Engine, engine::general_purpose::STANDARD};
use gonio::{Error, Result};
use gonio_page::{PdfError, escaped, pdf};
use std::{
    path::Path,
    sync::atomic::{AtomicBool, Ordering},
};

/// How the page looks, on a screen and on paper.
const STYLE: &str = include_str!("style.css");
/// Has tables sorted by their heads and copied; without scripts they are read as they are.
const SCRIPT: &str = include_str!("tables.js");

/// A page that grows; texts that are handed in stand in it as they are, whatever signs they hold.
#[derive(Debug)]
pub(crate) struct Page {
    text: String,
}

impl Page {
    pub(crate) fn new(Head { title, facts }: &Head, words: &Words) -> Self {
        let (title, say, language) = (escaped(title), &words.page, words.language.code());
        let device = "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">";
        let head = format!("<meta charset=\"utf-8\">\n{device}\n<title>{title}</title>\n<style>\n{STYLE}</style>");
        let facts: String = facts.iter().map(|(name, fact)| format!("<dt>{}</dt><dd>{}</dd>\n", escaped(name), escaped(fact))).collect();
        let top = format!("<header>\n<h1>{title}</h1>\n<dl>\n{facts}</dl>\n</header>");
        let texts = [("copy", &say.copy), ("copied", &say.copied), ("sort", &say.sort)];
        let texts = texts.map(|(key, text)| format!(" data-{key}=\"{}\"", escaped(text))).concat();
        Self { text: format!("<!DOCTYPE html>\n<html lang=\"{language}\">\n<head>\n{head}\n</head>\n<body{texts}>\n{top}\n") }
    }

    fn element(&mut self, tag: &str, content: &str) {
        self.text.push_str(&format!("<{tag}>{content}</{tag}>\n"));
    }

    pub(crate) fn section(&mut self, title: &str) {
        self.element("h2", &escaped(title));
    }

    pub(crate) fn part(&mut self, title: &str) {
        self.element("h3", &escaped(title));
    }

    pub(crate) fn paragraph(&mut self, text: &str) {
        self.element("p", &escaped(text));
    }

    pub(crate) fn note(&mut self, text: &str) {
        self.text.push_str(&format!("<p class=\"note\">{}</p>\n", escaped(text)));
    }

    pub(crate) fn list(&mut self, lines: &[String]) {
        let items: String = lines.iter().map(|line| format!("<li>{}</li>\n", escaped(line))).collect();
        self.element("ul", &format!("\n{items}"));
    }

    /// A table with its columns' names above and, unless it is empty, a row of totals below.
    pub(crate) fn table<T: AsRef<str>>(&mut self, names: &[T], rows: &[Vec<String>], totals: &[String]) {
        let row = |tag: &str, cells: &mut dyn Iterator<Item = &str>| {
            let end = tag.split(' ').next().unwrap_or_default();
            let cells: String = cells.map(|cell| format!("<{tag}>{}</{end}>", escaped(cell))).collect();
            format!("<tr>{cells}</tr>\n")
        };
        let head = row("th scope=\"col\"", &mut names.iter().map(AsRef::as_ref));
        let body: String = rows.iter().map(|cells| row("td", &mut cells.iter().map(String::as_str))).collect();
        let foot = if totals.is_empty() { String::new() } else { row("td", &mut totals.iter().map(String::as_str)) };
        // Where a table is wider than the page, it alone is moved aside.
        self.text.push_str("<div class=\"table\">\n");
        self.element("table", &format!("\n<thead>{head}</thead>\n<tbody>{body}</tbody>\n<tfoot>{foot}</tfoot>\n"));
        self.text.push_str("</div>\n");
    }

    /// A picture's file in the page itself; `format` as in `png`.
    pub(crate) fn picture(&mut self, format: &str, bytes: &[u8], caption: &str) {
        self.figure("", format, bytes, caption);
    }

    /// The same over the whole width of the page.
    pub(crate) fn wide_picture(&mut self, format: &str, bytes: &[u8], caption: &str) {
        self.figure(" class=\"grid\"", format, bytes, caption);
    }

    fn figure(&mut self, class: &str, format: &str, bytes: &[u8], caption: &str) {
        let (data, caption) = (STANDARD.encode(bytes), escaped(caption));
        let image = format!("<img alt=\"{caption}\" src=\"data:image/{format};base64,{data}\">");
        self.text.push_str(&format!("<figure{class}>{image}<figcaption>{caption}</figcaption></figure>\n"));
    }

    /// A drawing as `gonio_formats` makes it, whose own texts are escaped already.
    pub(crate) fn drawing(&mut self, svg: &str, caption: &str) {
        self.element("figure", &format!("{svg}<figcaption>{}</figcaption>", escaped(caption)));
    }

    /// The same over the whole width of the page.
    pub(crate) fn wide_drawing(&mut self, svg: &str, caption: &str) {
        let caption = escaped(caption);
        self.text.push_str(&format!("<figure class=\"grid\">{svg}<figcaption>{caption}</figcaption></figure>\n"));
    }

    /// A plot that has its title and its own colours for light and dark.
    pub(crate) fn plot(&mut self, svg: &str) {
        self.text.push_str(&format!("<figure class=\"plot\">{svg}</figure>\n"));
    }

    pub(crate) fn finish(mut self) -> String {
        self.text.push_str(&format!("<script>\n{SCRIPT}</script>\n</body>\n</html>\n"));
        self.text
    }
}

/// Writes a page beside the PDF that a browser did not make of it, so that nothing is lost; gives the error that says so.
pub(super) fn kept(html: &str, path: &Path, error: Error) -> Result<Vec<u8>> {
    let Error::Setting { problem, .. } = &error else { return Err(error) };
    let beside = path.with_extension("html");
    let told = format!("{problem}; the page is kept as {}", beside.display());
    put(&beside, html.as_bytes())?;
    Err(Error::setting("output", told))
}

/// A page as the bytes of a file by the ending of its name: itself, or a PDF.
pub(crate) fn as_file(html: String, path: &Path, interrupted: &AtomicBool) -> Result<Vec<u8>> {
    if ending(path) != "pdf" {
        return Ok(html.into_bytes());
    }
    let stopped = || interrupted.load(Ordering::Relaxed);
    pdf(&html, &stopped).map_err(|error| match error {
        PdfError::Stopped => Error::Cancelled,
        error => Error::setting("output", error.to_string()),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texts_cannot_leave_their_element() {
        let head = Head { title: "</title><script>".into(), facts: vec![("Place".into(), "<script>".into())] };
        let mut page = Page::new(&head, Words::english());
        page.table(&["name"], &[vec!["<i>".into()]], &[]);
        page.picture("png", b"", "\" onload=\"");
        let text = page.finish();
        assert_eq!(text.matches("<script>").count(), 1);
        assert!(!text.contains("<i>") && !text.contains("\" onload"), "{text}");
    }
}
