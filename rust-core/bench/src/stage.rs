//! What can be measured, by name.

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
    /// Whole renders of haze, smoke and a cloud.
    Media,
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
    pub const ALL: [Self; 12] = [
        Self::Generation,
        Self::Traversal,
        Self::Triangle,
        Self::Texture,
        Self::Graph,
        Self::Bsdf,
        Self::Light,
        Self::LightPaths,
        Self::Media,
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
            Self::Media => "media",
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
}
