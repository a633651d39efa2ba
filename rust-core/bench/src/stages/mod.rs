//! The stages, one file each.

mod bsdf;
mod function;
mod generation;
mod graph;
mod light;
mod light_paths;
pub(super) mod paper;
mod render;
mod texture;
mod tone;
mod traversal;
mod triangle;

use super::{Options, kernel::Case};
use gonio::compile::{CompiledScene, compile};
use gonio::error::Result;
use gonio::scene::Scene;
use std::sync::{Arc, atomic::AtomicBool};

/// What can be measured.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stage {
    /// Camera rays.
    Generation,
    /// Rays through the trees, by class.
    Traversal,
    /// One ray against eight triangles.
    Triangle,
    /// Filtered lookups in images.
    Texture,
    /// Shading nodes.
    Graph,
    /// Surfaces: from parameters to lobes, sampling and evaluation.
    Bsdf,
    /// Sampling lights by type.
    Light,
    /// Paths that start at lights.
    LightPaths,
    /// Elementary functions, gathers, compaction.
    Function,
    /// From scene-linear light to display values.
    Tone,
    /// Whole renders.
    Render,
    /// The paper's first table: lookups in a measured BRDF.
    PaperBrdf,
    /// Its second: kinds of light.
    PaperLight,
    /// Its third and fourth: whole pictures.
    PaperPicture,
    /// Its scenes as frames to move about in.
    PaperFrame,
}

impl Stage {
    /// All stages in the order of a path.
    pub const ALL: [Self; 11] = [
        Self::Generation,
        Self::Traversal,
        Self::Triangle,
        Self::Texture,
        Self::Graph,
        Self::Bsdf,
        Self::Light,
        Self::LightPaths,
        Self::Function,
        Self::Tone,
        Self::Render,
    ];

    /// The tables of the paper, which are measured where they are asked for alone.
    pub const PAPER: [Self; 4] = [Self::PaperBrdf, Self::PaperLight, Self::PaperPicture, Self::PaperFrame];

    /// The name that the command line takes.
    pub fn name(self) -> &'static str {
        match self {
            Self::Generation => "generation",
            Self::Traversal => "traversal",
            Self::Triangle => "triangle",
            Self::Texture => "texture",
            Self::Graph => "graph",
            Self::Bsdf => "bsdf",
            Self::Light => "light",
            Self::LightPaths => "light-paths",
            Self::Function => "function",
            Self::Tone => "tone",
            Self::Render => "render",
            Self::PaperBrdf => "table 1",
            Self::PaperLight => "table 2",
            Self::PaperPicture => "table 3",
            Self::PaperFrame => "frames",
        }
    }

    /// The stage of a name.
    pub fn by_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|stage| stage.name() == name)
    }

    /// All names, for messages.
    pub fn expected() -> String {
        format!("expected one of {}", Self::ALL.map(Self::name).join(", "))
    }

    /// What it measures.
    pub(super) fn cases(self, options: &Options, cancel: &AtomicBool) -> Result<Vec<Case>> {
        match self {
            Self::Generation => generation::cases(cancel),
            Self::Traversal => traversal::cases(cancel),
            Self::Triangle => triangle::cases(cancel),
            Self::Texture => texture::cases(cancel),
            Self::Graph => Ok(graph::cases()),
            Self::Bsdf => Ok(bsdf::cases()),
            Self::Light => light::cases(cancel),
            Self::LightPaths => light_paths::cases(cancel),
            Self::Function => Ok(function::cases()),
            Self::Tone => Ok(tone::cases()),
            Self::Render => render::cases(options, cancel),
            Self::PaperBrdf => Ok(bsdf::lookups(&[100_000, 200_000, 400_000])),
            Self::PaperLight => light::paper(cancel),
            Self::PaperPicture => paper::pictures(options, cancel),
            Self::PaperFrame => paper::frames(cancel),
        }
    }
}

/// A scene laid out.
fn compiled(scene: &Scene, cancel: &AtomicBool) -> Result<Arc<CompiledScene>> {
    compile(scene, None, cancel).map(Arc::new)
}
