//! What moves while the shutter is open.

use super::Transform;
use serde::{Deserialize, Serialize};

/// The shutter. Keys of what moves lie at evenly spaced times from 0 to 1; it may be open for a part of that only.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Shutter {
    /// Whether what moves is blurred. Else all stands where it rests.
    pub blur: bool,
    /// When it opens and when it is closed again, within 0 to 1.
    pub interval: [f32; 2],
    /// How far it is open at evenly spaced times from opening to closing; empty where it opens and closes at once.
    pub curve: Vec<f32>,
    /// Share of the interval that a row of pixels is exposed, from the top row to the bottom one (rolling shutter); 1 exposes all at once.
    pub row_exposure: f32,
    /// Whether the numbers of maps go straight from key to key. Else rotations turn evenly.
    pub linear: bool,
}

impl Default for Shutter {
    fn default() -> Self {
        Self { blur: true, interval: [0.0, 1.0], curve: Vec::new(), row_exposure: 1.0, linear: false }
    }
}

/// What is wrong with the keys of some placements, at each time one for each of them; no keys at all are right.
pub fn key_problem(keys: &[Vec<Transform>], placements: usize) -> Option<String> {
    if keys.is_empty() {
        return None;
    }
    if keys.len() < 2 {
        return Some("one motion key was found, expected two or more".into());
    }
    if let Some(key) = keys.iter().find(|key| key.len() != placements) {
        return Some(format!("a motion key places {} times, expected {placements}", key.len()));
    }
    (!keys.iter().flatten().all(Transform::is_finite)).then(|| "a motion key is not finite".into())
}
