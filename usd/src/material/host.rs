//! What a network asks of whoever reads the scene: messages, files, and what is known of the stage.

use super::definition::Definition;
use super::neutral::{Said, Value};
use crate::vt::AssetPath;
use gonio::scene::{MeasuredId, TextureId};
use std::sync::Arc;

/// The scene's reader, as the translator of materials sees it.
pub(in crate::material) trait Host {
    /// Reports something that changes the picture, at a path.
    fn warn(&mut self, path: &str, message: String);
    /// Warns once for each `kind` and `name`.
    fn once(&mut self, kind: &'static str, name: &str, path: &str, message: String);
    /// Says once for each feature that it is not supported.
    fn unsupported(&mut self, feature: &str, path: &str);
    /// Metres in a unit of length.
    fn metres_per_unit(&self) -> f64;
    /// The frame that is shown, and frames a second.
    fn frame(&self) -> [f64; 2];
    /// The image of a file, in a colour space that is known; `None`, with a warning, where it cannot be had.
    fn texture(&mut self, path: &str, file: &AssetPath, space: &str) -> Option<TextureId>;
    /// The measurement in a file; `None`, with a warning, where it cannot be had.
    fn measured(&mut self, path: &str, file: &AssetPath) -> Option<MeasuredId>;
    /// The text in a primvar of the shaded prim, with the file that it names.
    fn text_of_primvar(&mut self, name: &str) -> Option<(Value, Said)>;
    /// The definition of a node, of a document or of the standard library where that is at hand.
    fn definition(&mut self, name: &str) -> Option<Arc<Definition>>;
    /// Whether the standard library is not installed.
    fn lacks_library(&mut self) -> bool;
}
