//! Where a scene element came from.

use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// A prim path or an object's name, and the file if it is known: the first thing every message says.
#[derive(Clone, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(from = "Written")]
pub struct Origin {
    /// Prim path, object name or variable name.
    pub name: Arc<str>,
    /// The file it stands in, empty if unknown.
    pub file: Arc<str>,
}

/// How an origin may be written down: the name alone, or name and file.
#[derive(Deserialize)]
#[serde(untagged)]
enum Written {
    Name(Arc<str>),
    Whole {
        #[serde(default)]
        name: Arc<str>,
        #[serde(default)]
        file: Arc<str>,
    },
}

impl From<Written> for Origin {
    fn from(written: Written) -> Self {
        match written {
            Written::Name(name) => Self { name, file: Arc::default() },
            Written::Whole { name, file } => Self { name, file },
        }
    }
}

impl Origin {
    /// An origin without a file.
    pub fn new(name: impl AsRef<str>) -> Self {
        Self { name: Arc::from(name.as_ref()), file: Arc::from("") }
    }
    /// Whether its path is another or lies below it.
    pub fn is_below(&self, root: &str) -> bool {
        is_below(&self.name, root)
    }
}

/// Whether a path is another or lies below it.
pub fn is_below(path: &str, root: &str) -> bool {
    let root = root.trim_end_matches('/');
    path.strip_prefix(root).is_some_and(|rest| rest.is_empty() || rest.starts_with('/'))
}

impl std::fmt::Display for Origin {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match (self.name.is_empty(), self.file.is_empty()) {
            (false, false) => write!(f, "{} ({})", self.name, self.file),
            (true, false) => write!(f, "{}", self.file),
            (false, true) => write!(f, "{}", self.name),
            (true, true) => write!(f, "scene"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn paths_lie_below_whole_names() {
        let is_below = |path: &str, root: &str| Origin::new(path).is_below(root);
        assert!(is_below("/Room/Floor", "/Room") && is_below("/Room/Floor", "/Room/Floor") && is_below("/Room", "/"));
        assert!(!is_below("/Room/Floor2", "/Room/Floor") && !is_below("/Room", "/Room/Floor"));
    }
}
