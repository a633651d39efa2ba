//! What can be wrong with a texture.

use std::fmt;
use std::sync::Arc;

/// The sort of trouble, for callers that treat some apart.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TextureErrorKind {
    /// The file is not there or cannot be read.
    Unreadable,
    /// The file's contents are damaged or cut short.
    Malformed,
    /// The file is sound but of a sort that is not supported.
    Unsupported,
    /// The image is larger than the limits allow.
    TooLarge,
    /// The caller raised the cancel flag.
    Cancelled,
}

/// Why a texture could not be loaded: one line, place first.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TextureError {
    /// The file's path, or the name given with its bytes.
    pub path: Arc<str>,
    /// The sort of trouble.
    pub kind: TextureErrorKind,
    /// What was found, and what was expected.
    pub what: String,
    /// What to do about it; may be empty.
    pub hint: String,
}

impl TextureError {
    /// A sound file of a sort that is not supported where it is used.
    pub fn unsupported(path: &str, what: &str) -> Self {
        Self::new(TextureErrorKind::Unsupported, what).at(path)
    }

    pub(crate) fn new(kind: TextureErrorKind, what: impl Into<String>) -> Self {
        Self { path: Arc::from(""), kind, what: one_line(&what.into()), hint: String::new() }
    }

    pub(crate) fn malformed(what: impl fmt::Display) -> Self {
        Self::new(TextureErrorKind::Malformed, what.to_string())
    }

    pub(crate) fn hint(mut self, hint: impl Into<String>) -> Self {
        self.hint = hint.into();
        self
    }

    pub(crate) fn at(mut self, path: &str) -> Self {
        self.path = Arc::from(path);
        self
    }
}

/// Decoders' messages can hold line breaks and bytes of the file.
fn one_line(text: &str) -> String {
    text.chars().map(|c| if c.is_control() { ' ' } else { c }).take(300).collect()
}

impl fmt::Display for TextureError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.path, self.what)?;
        if self.hint.is_empty() { Ok(()) } else { write!(f, "; {}", self.hint) }
    }
}

impl std::error::Error for TextureError {}
