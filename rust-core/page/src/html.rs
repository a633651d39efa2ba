//! Texts in HTML.

use gonio_formats::escape;

/// A text as HTML holds it, in attributes too; control characters, which a file may have brought along, become blanks.
pub fn escaped(text: &str) -> String {
    escape(text).replace('"', "&quot;").replace('\'', "&#39;")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texts_cannot_leave_their_element() {
        assert_eq!(escaped("a<b>&\u{1}\"'"), "a&lt;b&gt;&amp; &quot;&#39;");
    }
}
