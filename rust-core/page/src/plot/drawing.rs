//! An SVG document that grows. Colours are attributes, which every program knows; those of dark surroundings are a style, which browsers know.

use super::Head;
use crate::escaped;
use std::fmt::Write;

/// Width of every plot in pixels.
pub(super) const WIDTH: f64 = 720.0;
/// Height of letters.
pub(super) const LETTERS: f64 = 14.0;
/// Height of a title's letters, and of a text's at least.
const TITLE: f64 = 16.0;
const LEAST: f64 = 8.0;
/// How wide a letter is to its height, about.
pub(super) const LETTER: f64 = 0.58;
/// Height of a line of text.
pub(super) const LINE: f64 = 20.0;
/// Colours over dark paper.
const DARK: &str = "@media screen and (prefers-color-scheme:dark){.gonio-plot .paper{fill:#14171b}.gonio-plot .ink{fill:#e6e9ed}\
.gonio-plot .soft{fill:#9aa4af}.gonio-plot .line{stroke:#59636e}.gonio-plot .night{fill:#23282e}.gonio-plot .curve{stroke:#e6e9ed}}";

/// Where a text stands against its point.
#[derive(Clone, Copy, Debug)]
pub(super) enum Anchor {
    Start,
    Middle,
    End,
}

/// A text's colour.
#[derive(Clone, Copy, Debug)]
pub(super) enum Ink {
    Full,
    Soft,
}

#[derive(Debug)]
pub(super) struct Drawing {
    body: String,
}

impl Drawing {
    pub(super) fn new() -> Self {
        Self { body: String::new() }
    }

    /// Writing to a string cannot fail.
    pub(super) fn add(&mut self, element: std::fmt::Arguments<'_>) {
        let _ = writeln!(self.body, "{element}");
    }

    pub(super) fn text(&mut self, [x, y]: [f64; 2], anchor: Anchor, ink: Ink, text: &str) {
        let anchor = match anchor {
            Anchor::Start => "start",
            Anchor::Middle => "middle",
            Anchor::End => "end",
        };
        let (class, fill) = match ink {
            Ink::Full => ("ink", "#1d2126"),
            Ink::Soft => ("soft", "#5b6470"),
        };
        let text = escaped(text);
        self.add(format_args!("<text class=\"{class}\" x=\"{x:.1}\" y=\"{y:.1}\" text-anchor=\"{anchor}\" fill=\"{fill}\">{text}</text>"));
    }

    /// A thin line of an axis.
    pub(super) fn line(&mut self, [x0, y0]: [f64; 2], [x1, y1]: [f64; 2]) {
        self.add(format_args!("<path class=\"line\" d=\"M{x0:.1} {y0:.1}L{x1:.1} {y1:.1}\" fill=\"none\" stroke=\"#9aa4af\"/>"));
    }

    pub(super) fn rectangle(&mut self, [x, y]: [f64; 2], [width, height]: [f64; 2], colour: &str) {
        self.add(format_args!(
            "<rect x=\"{x:.2}\" y=\"{y:.2}\" width=\"{width:.2}\" height=\"{height:.2}\" fill=\"{colour}\" shape-rendering=\"crispEdges\"/>"
        ));
    }

    /// A text over the whole width, smaller where it is long.
    fn headline(&mut self, y: f64, height: f64, style: &str, text: &str) {
        let height = height.min(WIDTH / (LETTER * text.chars().count().max(1) as f64)).max(LEAST);
        let text = escaped(text);
        self.add(format_args!("<text {style} x=\"0\" y=\"{y:.0}\" font-size=\"{height:.1}\">{text}</text>"));
    }

    /// The document, of a height below its head.
    pub(super) fn finish(self, head: &Head, height: f64) -> String {
        let (top, title) = (top(head), escaped(&head.title));
        let whole = top + height;
        let mut texts = Self::new();
        let bold = "class=\"ink\" font-weight=\"bold\" fill=\"#1d2126\"";
        texts.headline(18.0, TITLE, bold, &head.title);
        for (number, line) in head.lines.iter().enumerate() {
            texts.headline(18.0 + LINE * (number + 1) as f64, LETTERS, "class=\"soft\" fill=\"#5b6470\"", line);
        }
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"gonio-plot\" viewBox=\"-8 -4 {:.0} {:.0}\" width=\"{:.0}\" height=\"{:.0}\" role=\"img\" \
             font-family=\"system-ui, 'Helvetica Neue', Arial, 'Liberation Sans', sans-serif\" font-size=\"{LETTERS}\">\n<title>{title}</title>\n\
             <style>{DARK}</style>\n<rect class=\"paper\" x=\"-8\" y=\"-4\" width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n{}<g transform=\"translate(0 {top:.0})\">\n{}</g>\n</svg>\n",
            WIDTH + 16.0,
            whole + 8.0,
            WIDTH + 16.0,
            whole + 8.0,
            texts.body,
            self.body
        )
    }
}

/// Height of the head.
fn top(head: &Head) -> f64 {
    38.0 + LINE * head.lines.len() as f64
}
