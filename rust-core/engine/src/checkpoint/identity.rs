//! What a checkpoint of a render is of.

use super::Stamp;
use crate::{
    compile::{picture_view, window},
    film::{Besides, PictureView},
    scene::{Manifests, Scene},
};
use gonio_simd::Execution;
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// What a checkpoint is of.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Identity {
    /// Of which scene and settings.
    #[serde(flatten)]
    pub stamp: Stamp,
    /// Factor on the colour pass.
    pub exposure: f32,
    /// What its film keeps besides passes.
    #[serde(flatten)]
    pub(super) besides: Besides,
    /// The names in its mattes.
    #[serde(default)]
    pub(super) manifests: Arc<Manifests>,
    /// How the picture is seen.
    #[serde(default)]
    pub(super) view: Option<PictureView>,
    /// Text for the header of EXR files.
    pub notes: Vec<(String, String)>,
}

impl Identity {
    /// The identity of a render of a scene, all files of which are read again. `notes` are for the header of EXR files.
    pub fn new(scene: &Scene, execution: Execution, notes: Vec<(String, String)>) -> Self {
        Self {
            stamp: Stamp::new(scene, execution),
            exposure: scene.cameras.get(scene.settings.camera as usize).map_or(1.0, |camera| camera.exposure.0),
            besides: Besides::of(scene),
            manifests: Arc::new(Manifests::of(scene)),
            view: view_of(scene),
            notes,
        }
    }
}

/// How a scene's camera sees the window that its settings ask for.
fn view_of(scene: &Scene) -> Option<PictureView> {
    let camera = scene.cameras.get(scene.settings.camera as usize)?;
    picture_view(camera, &scene.settings, window(&scene.settings).ok()?)
}
