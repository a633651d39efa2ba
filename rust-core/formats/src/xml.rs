//! XML of files that nobody vouches for: no document type, so that no entity expands.

use crate::error::{FormatError, Result};
use crate::photometry::text::{decode, parse, quote};
use roxmltree::{Document, Node, ParsingOptions};
use std::borrow::Cow;

/// More elements than that no such file has; each takes memory several times its text.
const MOST_NODES: u32 = 1 << 20;
/// Longer tags, in bytes, no such file has; reading their attributes takes time by the square of their number.
const LONGEST_TAG: usize = 1 << 16;

/// The text of a file: UTF-16 with its mark, else what [`decode`] takes.
///
/// # Errors
/// Half a letter of UTF-16, or what [`decode`] refuses.
pub(crate) fn text_of(bytes: &[u8]) -> Result<Cow<'_, str>> {
    let word = match bytes {
        [0xff, 0xfe, ..] => u16::from_le_bytes,
        [0xfe, 0xff, ..] => u16::from_be_bytes,
        _ => return decode(bytes),
    };
    let (words, rest) = bytes[2..].as_chunks::<2>();
    let text: std::result::Result<String, _> = char::decode_utf16(words.iter().map(|pair| word(*pair))).collect();
    let text = text.ok().filter(|_| rest.is_empty()).map(Cow::Owned);
    text.ok_or_else(|| FormatError::line(1, "text of UTF-16 was found with half a letter in it"))
}

/// The tree of a text.
///
/// # Errors
/// What is no XML, or has a document type or a tag without end.
pub(crate) fn document(text: &str) -> Result<Document<'_>> {
    if let Some(place) = long_tag(text) {
        let line = text[..place].matches('\n').count() as u64 + 1;
        return Err(FormatError::line(line, format!("an XML tag of more than {LONGEST_TAG} bytes was found")));
    }
    let options = ParsingOptions { allow_dtd: false, nodes_limit: MOST_NODES, ..ParsingOptions::default() };
    Document::parse_with_options(text, options).map_err(|error| FormatError::line(error.pos().row.into(), format!("not XML: {error}")))
}

/// Where a tag begins that is longer than any should be; comments and other text may be.
fn long_tag(text: &str) -> Option<usize> {
    let tags = text.match_indices('<').map(|(place, _)| (place, &text[place + 1..]));
    let mut tags = tags.filter(|(_, rest)| !rest.starts_with('!') && rest.len() > LONGEST_TAG);
    let found = tags.find(|(_, rest)| !rest.as_bytes()[..LONGEST_TAG].contains(&b'>'));
    found.map(|(place, _)| place)
}

/// Children of a name.
pub(crate) fn children<'a, 'input>(node: Node<'a, 'input>, name: &'static str) -> impl Iterator<Item = Node<'a, 'input>> {
    node.children().filter(move |child| child.tag_name().name() == name)
}

/// The first node along a path of names.
pub(crate) fn descend<'a, 'input>(node: Node<'a, 'input>, path: &[&str]) -> Option<Node<'a, 'input>> {
    path.iter().try_fold(node, |node, name| node.children().find(|child| child.tag_name().name() == *name))
}

/// A node's text without the white space around it.
pub(crate) fn content<'a>(node: Node<'a, '_>) -> &'a str {
    node.text().unwrap_or("").trim()
}

/// The text at the end of a path, empty where nothing is.
pub(crate) fn text_at(node: Node<'_, '_>, path: &[&str]) -> String {
    descend(node, path).map(content).unwrap_or_default().to_owned()
}

/// The number at the end of a path.
pub(crate) fn value_at(node: Node<'_, '_>, path: &[&str]) -> Option<f64> {
    descend(node, path).and_then(|node| parse(content(node)))
}

/// An attribute without the white space around it; empty where there is none.
pub(crate) fn attribute<'a>(node: Node<'a, '_>, name: &str) -> &'a str {
    node.attribute(name).unwrap_or("").trim()
}

/// An element as messages name it.
pub(crate) fn tag(node: Node<'_, '_>) -> String {
    format!("<{}>", quote(node.tag_name().name()).trim_matches('\''))
}

/// The line that a node begins in. Looking it up takes as long as the file is.
pub(crate) fn line(node: Node<'_, '_>) -> u64 {
    node.document().text_pos_at(node.range().start).row.into()
}

/// Where the lines of a text begin, for files of which many lines are asked for.
#[derive(Debug)]
pub(crate) struct LineNumbers(Vec<usize>);

impl LineNumbers {
    pub(crate) fn new(text: &str) -> Self {
        Self(text.bytes().enumerate().filter(|(_, byte)| *byte == b'\n').map(|(at, _)| at).collect())
    }

    /// The line that a node begins in.
    pub(crate) fn line(&self, node: Node<'_, '_>) -> u64 {
        let start = node.range().start;
        1 + self.0.partition_point(|end| *end < start) as u64
    }

    /// A problem at a node.
    pub(crate) fn at(&self, node: Node<'_, '_>, problem: String) -> FormatError {
        FormatError::line(self.line(node), problem)
    }
}

/// A text as a name that identifiers may be: letters, digits, hyphens and underscores; it is to begin with a letter.
pub(crate) fn nc_name(text: &str) -> String {
    text.chars().map(|c| if c.is_ascii_alphanumeric() || c == '-' { c } else { '_' }).collect()
}

/// A problem at a node.
pub(crate) fn at(node: Node<'_, '_>, problem: String) -> FormatError {
    FormatError::line(line(node), problem)
}
