//! JSON values with their place in the file.

use crate::vector::Vec3;
use serde_json::Value;

/// A value, and where it stands: `rooms[0].faces[2]`.
#[derive(Clone, Debug)]
pub(super) struct Node<'a> {
    pub(super) value: &'a Value,
    pub(super) path: String,
}

impl<'a> Node<'a> {
    pub(super) fn root(value: &'a Value) -> Self {
        Self { value, path: String::new() }
    }

    /// What a key holds, unless that is null.
    pub(super) fn get(&self, key: &str) -> Option<Self> {
        let value = self.value.get(key).filter(|value| !value.is_null())?;
        let dot = if self.path.is_empty() { "" } else { "." };
        Some(Self { value, path: format!("{}{dot}{key}", self.path) })
    }

    /// What a list holds; nothing where it is none.
    pub(super) fn items(&self) -> impl Iterator<Item = Node<'a>> + use<'a> {
        let (values, path) = (self.value.as_array().map(Vec::as_slice).unwrap_or_default(), self.path.clone());
        values.iter().enumerate().map(move |(number, value)| Node { value, path: format!("{path}[{number}]") })
    }

    /// What the list at a key holds; nothing where there is none.
    pub(super) fn list(&self, key: &str) -> Vec<Node<'a>> {
        self.get(key).map(|list| list.items().collect()).unwrap_or_default()
    }

    pub(super) fn text(&self, key: &str) -> Option<&'a str> {
        self.value.get(key)?.as_str()
    }

    pub(super) fn flag(&self, key: &str) -> bool {
        self.value.get(key).and_then(Value::as_bool).unwrap_or(false)
    }

    /// The object's type.
    pub(super) fn kind(&self) -> &'a str {
        self.text("type").unwrap_or("")
    }

    pub(super) fn identifier(&self) -> &'a str {
        self.text("identifier").unwrap_or("")
    }

    /// A number, or what stands for it where there is none.
    ///
    /// # Errors
    /// It is no number.
    pub(super) fn number(&self, key: &str, otherwise: f64) -> Result<f64, String> {
        match self.get(key) {
            None => Ok(otherwise),
            Some(node) => {
                node.value.as_f64().filter(|x| x.is_finite()).ok_or_else(|| format!("{} is {}, expected a number", key, node.value))
            }
        }
    }

    /// Three numbers at a key.
    pub(super) fn triple(&self, key: &str) -> Result<Vec3, String> {
        self.get(key).ok_or_else(|| format!("{key} is missing, expected three numbers"))?.vector()
    }

    /// The value itself as three numbers.
    pub(super) fn vector(&self) -> Result<Vec3, String> {
        let numbers: Option<Vec<f64>> = self.value.as_array().and_then(|list| list.iter().map(Value::as_f64).collect());
        let found = numbers.and_then(|numbers| Vec3::try_from(numbers).ok());
        found.ok_or_else(|| format!("{} was found, expected three numbers", short(self.value)))
    }
}

/// The beginning of a value's text.
fn short(value: &Value) -> String {
    let text = value.to_string();
    match text.char_indices().nth(40) {
        Some((end, _)) => format!("{}…", &text[..end]),
        None => text,
    }
}
