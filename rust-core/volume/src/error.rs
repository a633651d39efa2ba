//! What is wrong with a file: its name and the place first, then what was found and what was expected.

/// The result of reading or writing a volume file.
pub type Result<T> = std::result::Result<T, VolumeError>;

/// Why a file or a grid cannot be used.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{file}{}: {problem}", byte.map(|byte| format!(", byte {byte}")).unwrap_or_default())]
pub struct VolumeError {
    /// The file's name as it was given.
    pub file: String,
    /// Where in the file, counted from zero, if it is at one place.
    pub byte: Option<u64>,
    /// What was found and what was expected.
    pub problem: String,
}

impl VolumeError {
    /// The place and the problem, for those who have named the file.
    pub fn in_file(&self) -> String {
        self.byte.map_or_else(|| self.problem.clone(), |byte| format!("byte {byte}: {}", self.problem))
    }

    pub(crate) fn whole(file: &str, problem: impl Into<String>) -> Self {
        Self { file: file.into(), byte: None, problem: problem.into() }
    }
}
