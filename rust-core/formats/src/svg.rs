//! The little of SVG that diagrams need: of goniograms, of measured materials, of roads.

use std::fmt::Write;

/// An SVG document that grows; places are in pixels from the upper left corner, texts are escaped.
#[derive(Debug)]
pub struct Canvas {
    text: String,
}

/// Where a text stands against its point.
#[derive(Clone, Copy, Debug)]
pub enum Anchor {
    /// To the right of it.
    Start,
    /// Centred on it.
    Middle,
    /// To the left of it.
    End,
}

impl Canvas {
    /// A white page of a size in pixels.
    pub fn new(width: f64, height: f64) -> Self {
        let text = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" width=\"{width}\" height=\"{height}\" \
             font-family=\"sans-serif\" font-size=\"12\">\n<rect width=\"{width}\" height=\"{height}\" fill=\"white\"/>\n"
        );
        Self { text }
    }

    /// Writing to a string cannot fail.
    fn add(&mut self, element: std::fmt::Arguments<'_>) {
        let _ = writeln!(self.text, "{element}");
    }

    /// A thin line.
    pub fn line(&mut self, [x0, y0]: [f64; 2], [x1, y1]: [f64; 2], colour: &str) {
        self.add(format_args!("<line x1=\"{x0:.2}\" y1=\"{y0:.2}\" x2=\"{x1:.2}\" y2=\"{y1:.2}\" stroke=\"{colour}\"/>"));
    }

    /// A thin line through points.
    pub fn path(&mut self, points: &[[f64; 2]], colour: &str) {
        self.add(format_args!("<polyline points=\"{}\" fill=\"none\" stroke=\"{colour}\"/>", joined(points)));
    }

    /// A circle's outline.
    pub fn circle(&mut self, [x, y]: [f64; 2], radius: f64, colour: &str) {
        self.add(format_args!("<circle cx=\"{x:.2}\" cy=\"{y:.2}\" r=\"{radius:.2}\" fill=\"none\" stroke=\"{colour}\"/>"));
    }

    /// A line through points; `dashes` as in `stroke-dasharray`, empty for none.
    pub fn curve(&mut self, points: &[[f64; 2]], colour: &str, dashes: &str) {
        let points = joined(points);
        self.add(format_args!(
            "<polyline points=\"{points}\" fill=\"none\" stroke=\"{colour}\" stroke-width=\"2\" stroke-dasharray=\"{dashes}\"/>"
        ));
    }

    /// A filled polygon.
    pub fn area(&mut self, points: &[[f64; 2]], colour: &str) {
        self.add(format_args!("<polygon points=\"{}\" fill=\"{colour}\"/>", joined(points)));
    }

    /// A line of text.
    pub fn text(&mut self, [x, y]: [f64; 2], anchor: Anchor, text: &str) {
        let anchor = match anchor {
            Anchor::Start => "start",
            Anchor::Middle => "middle",
            Anchor::End => "end",
        };
        let text = escape(text);
        self.add(format_args!("<text x=\"{x:.2}\" y=\"{y:.2}\" text-anchor=\"{anchor}\">{text}</text>"));
    }

    /// The document.
    pub fn finish(mut self) -> String {
        self.text.push_str("</svg>\n");
        self.text
    }
}

/// Points as SVG lists them.
fn joined(points: &[[f64; 2]]) -> String {
    let points: Vec<String> = points.iter().map(|[x, y]| format!("{x:.2},{y:.2}")).collect();
    points.join(" ")
}

/// A text as XML holds it; control characters, which XML forbids, become blanks.
pub fn escape(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '\u{fffe}' | '\u{ffff}' => escaped.push(' '),
            c if c.is_control() => escaped.push(' '),
            c => escaped.push(c),
        }
    }
    escaped
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texts_cannot_leave_their_element() {
        assert_eq!(escape("a<b>&\u{1}c"), "a&lt;b&gt;&amp; c");
    }
}
