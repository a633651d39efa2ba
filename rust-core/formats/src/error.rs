//! What is wrong with a file: the place first, then what was found and what was expected.

/// The result of reading a file's bytes.
pub(crate) type Result<T> = std::result::Result<T, FormatError>;

/// Where in a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Place {
    /// A line, counted from one.
    Line(u64),
    /// A byte, counted from zero.
    Byte(u64),
}

/// Why a file cannot be used. The caller knows the file's name and puts it in front.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{}{problem}", place.map(|place| format!("{place}: ")).unwrap_or_default())]
pub struct FormatError {
    /// Where, if it is at one place.
    pub place: Option<Place>,
    /// What was found and what was expected.
    pub problem: String,
}

impl FormatError {
    /// A problem of the file as a whole.
    pub fn whole(problem: impl Into<String>) -> Self {
        Self { place: None, problem: problem.into() }
    }
    /// A problem in a line, counted from one.
    pub fn line(line: u64, problem: impl Into<String>) -> Self {
        Self { place: Some(Place::Line(line)), problem: problem.into() }
    }
    /// A problem at a byte, counted from zero.
    pub fn byte(byte: u64, problem: impl Into<String>) -> Self {
        Self { place: Some(Place::Byte(byte)), problem: problem.into() }
    }
}

impl std::fmt::Display for Place {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Line(line) => write!(f, "line {line}"),
            Self::Byte(byte) => write!(f, "byte {byte}"),
        }
    }
}
