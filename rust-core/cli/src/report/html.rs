//! One HTML page that needs nothing beside itself.

use super::head::Head;
use base64::{Engine, engine::general_purpose::STANDARD};
use gonio_formats::escape;

/// How the page looks, on a screen and on paper.
const STYLE: &str = include_str!("style.css");

/// A page that grows; texts that are handed in stand in it as they are, whatever signs they hold.
#[derive(Debug)]
pub(crate) struct Page {
    text: String,
}

impl Page {
    pub(crate) fn new(Head { title, facts }: &Head) -> Self {
        let title = escaped(title);
        let device = "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">";
        let head = format!("<meta charset=\"utf-8\">\n{device}\n<title>{title}</title>\n<style>\n{STYLE}</style>");
        let facts: String = facts.iter().map(|(name, fact)| format!("<dt>{}</dt><dd>{}</dd>\n", escaped(name), escaped(fact))).collect();
        let top = format!("<header>\n<h1>{title}</h1>\n<dl>\n{facts}</dl>\n</header>");
        Self { text: format!("<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n{head}\n</head>\n<body>\n{top}\n") }
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
    pub(crate) fn table(&mut self, names: &[&str], rows: &[Vec<String>], totals: &[String]) {
        let row = |tag: &str, cells: &mut dyn Iterator<Item = &str>| {
            let cells: String = cells.map(|cell| format!("<{tag}>{}</{tag}>", escaped(cell))).collect();
            format!("<tr>{cells}</tr>\n")
        };
        let head = row("th", &mut names.iter().copied());
        let body: String = rows.iter().map(|cells| row("td", &mut cells.iter().map(String::as_str))).collect();
        let foot = if totals.is_empty() { String::new() } else { row("td", &mut totals.iter().map(String::as_str)) };
        self.element("table", &format!("\n<thead>{head}</thead>\n<tbody>{body}</tbody>\n<tfoot>{foot}</tfoot>\n"));
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

    pub(crate) fn finish(mut self) -> String {
        self.text.push_str("</body>\n</html>\n");
        self.text
    }
}

/// A text as HTML holds it, in attributes too; control characters, which a file may have brought along, become blanks.
fn escaped(text: &str) -> String {
    escape(text).replace('"', "&quot;").replace('\'', "&#39;")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texts_cannot_leave_their_element() {
        assert_eq!(escaped("a<b>&\u{1}\"'"), "a&lt;b&gt;&amp; &quot;&#39;");
        let mut page = Page::new(&Head { title: "</title><script>".into(), facts: vec![("Place", "<script>".into())] });
        page.table(&["name"], &[vec!["<i>".into()]], &[]);
        page.picture("png", b"", "\" onload=\"");
        let text = page.finish();
        assert!(!text.contains("<script>") && !text.contains("<i>") && !text.contains("\" onload"), "{text}");
    }
}
