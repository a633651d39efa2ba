//! Images within a memory limit.

use super::harness::{Bench, scene, uniform};
use crate::compile::{CompiledScene, compile};
use crate::scene::{Scene, TextureSource};
use gonio_simd::Execution;
use serde_json::json;
use std::{path::PathBuf, sync::Arc};

/// A folder of tiles that is deleted in the end.
struct Folder(PathBuf);

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

/// A picture of 200 × 150 pixels on the hits, beyond its edges too.
fn pictured() -> Scene {
    let lookup = json!({
        "texture": 0, "wrap": ["Repeat", "Mirror"], "filter": "Linear",
        "scale": [2.0, 1.0, 1.0, 1.0], "bias": [0.0, 0.5, 0.0, 0.0], "fallback": [1.0, 1.0, 1.0, 1.0]
    });
    let mut scene = scene(&json!([
        { "operation": { "Primvar": { "name": "st", "fallback": [0.0, 0.0, 0.0, 0.0] } }, "inputs": [] },
        { "operation": { "Image": lookup }, "inputs": [{ "Node": [0, "Rgb"] }] }
    ]));
    let (width, height) = (200, 150);
    let rgba: Vec<f32> = (0..(width * height * 4) as usize).map(|i| uniform(7, i)).collect();
    scene.textures[0].source = TextureSource::Pixels { width, height, rgba: Arc::from(rgba) };
    scene
}

fn compiled(scene: &Scene, previous: Option<&CompiledScene>) -> CompiledScene {
    compile(scene, previous, &false.into()).expect("a scene that compiles")
}

#[test]
fn lookups_are_the_same_within_a_limit() {
    let mut scene = pictured();
    let whole = Bench::of(compiled(&scene, None));
    assert!(whole.compiled.tables.textures.statistics().is_none());
    let folder = Folder(std::env::temp_dir().join(format!("gonio-compile-tiles-{}", std::process::id())));
    (scene.settings.texture_memory, scene.settings.texture_cache) = (1, Some(folder.0.clone()));
    let paged = Bench::of(compiled(&scene, None));
    assert!(paged.compiled.tables.textures.is_paged(0));
    // No worker does with a byte, which is told once.
    let told: Vec<String> = paged.compiled.diagnostics.iter().map(ToString::to_string).collect();
    assert!(told.len() == 1 && told[0].contains("texture memory"), "{told:?}");
    for execution in Execution::all() {
        assert_eq!(whole.run(execution), paged.run(execution), "{}", execution.name());
    }
    let told = paged.compiled.tables.textures.statistics().expect("statistics");
    assert!(told.tiles_read > 0 && told.lookups > told.tiles_read && told.notes.is_empty(), "{told:?}");
    // The next compilation takes the memory over, one without a limit does not.
    let next = compiled(&scene, Some(&paged.compiled));
    assert_eq!(next.diagnostics.len(), 1);
    assert_eq!(next.tables.textures.statistics().expect("statistics").tiles_read, told.tiles_read);
    scene.settings.texture_memory = 0;
    assert!(compiled(&scene, Some(&next)).tables.textures.statistics().is_none());
}
