//! The stages, one file each.

mod bsdf;
mod function;
mod generation;
mod graph;
mod light;
mod light_paths;
mod media;
pub(super) mod paper;
mod render;
mod texture;
mod tone;
mod traversal;
mod triangle;

use super::{Options, kernel::Case, stage::Stage};
use gonio::error::Result;
use std::sync::atomic::AtomicBool;

/// What a stage measures.
pub(super) fn cases(stage: Stage, options: &Options, cancel: &AtomicBool) -> Result<Vec<Case>> {
    match stage {
        Stage::Generation => generation::cases(cancel),
        Stage::Traversal => traversal::cases(cancel),
        Stage::Triangle => triangle::cases(cancel),
        Stage::Texture => texture::cases(cancel),
        Stage::Graph => Ok(graph::cases()),
        Stage::Bsdf => Ok(bsdf::cases()),
        Stage::Light => light::cases(cancel),
        Stage::LightPaths => light_paths::cases(cancel),
        Stage::Media => media::cases(options, cancel),
        Stage::Function => Ok(function::cases()),
        Stage::Tone => Ok(tone::cases()),
        Stage::Render => render::cases(options, cancel),
        Stage::PaperBrdf => Ok(bsdf::lookups(&[100_000, 200_000, 400_000])),
        Stage::PaperLight => light::paper(cancel),
        Stage::PaperPicture => paper::pictures(options, cancel),
        Stage::PaperFrame => paper::frames(cancel),
    }
}
