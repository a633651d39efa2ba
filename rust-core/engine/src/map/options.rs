//! What is asked of illumination maps.

use crate::error::{Error, Result};

/// How large the parts of a surface are that have a value each.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum TexelSize {
    /// About 65,000 parts over all surfaces.
    #[default]
    Automatic,
    /// Their side in metres: the mean over a surface.
    Metres(f64),
    /// Width and height in texels; with texture coordinates alone.
    Resolution([u32; 2]),
}

/// What is asked for.
#[derive(Clone, Debug, PartialEq)]
pub struct MapOptions {
    /// Names of objects: they and all below them get maps; empty: all do.
    pub prims: Vec<String>,
    /// The texture coordinates whose texels keep the light; without, triangles are divided.
    pub uv: Option<String>,
    /// How fine.
    pub texel: TexelSize,
    /// Relative standard error, averaged over the lit area, at which there is enough light; 0: none is.
    pub error: f64,
    /// Most light paths.
    pub paths: u64,
    /// Most seconds; 0: no limit.
    pub time_limit_s: f64,
    /// Red, green and blue beside the luminous flux.
    pub colours: bool,
    /// Figures of the light's colour too: lamps want spectra.
    pub figures: bool,
    /// Most bytes.
    pub memory: u64,
    /// Scatterings of a path.
    pub max_bounces: u32,
}

/// Most paths of a map: the sums hold more, but nobody waits for them.
pub const MOST_PATHS: u64 = 1 << 34;

impl Default for MapOptions {
    fn default() -> Self {
        Self {
            prims: Vec::new(),
            uv: None,
            texel: TexelSize::Automatic,
            error: 0.05,
            paths: 1 << 24,
            time_limit_s: 0.0,
            colours: false,
            figures: false,
            memory: 1 << 30,
            max_bounces: crate::measure::MOST_BOUNCES,
        }
    }
}

impl MapOptions {
    /// Refuses what makes no map.
    pub(super) fn check(&self) -> Result<()> {
        let wrong =
            |name: &str, found: String, expected: &str| Err(Error::setting(name, format!("{found} was found, expected {expected}")));
        if !(self.error >= 0.0 && self.error < 1.0) {
            return wrong("error", self.error.to_string(), "a share from 0 to below 1");
        }
        if !(1..=MOST_PATHS).contains(&self.paths) {
            return wrong("paths", self.paths.to_string(), &format!("1 to {MOST_PATHS}"));
        }
        if !(self.time_limit_s >= 0.0 && self.time_limit_s.is_finite()) {
            return wrong("time limit", self.time_limit_s.to_string(), "seconds");
        }
        match self.texel {
            TexelSize::Metres(side) if !(side > 0.0 && side.is_finite()) => wrong("texel", side.to_string(), "metres"),
            TexelSize::Resolution([width, height]) if !(1..=MOST_SIDE).contains(&width) || !(1..=MOST_SIDE).contains(&height) => {
                wrong("resolution", format!("{width} x {height}"), &format!("1 to {MOST_SIDE} each way"))
            }
            TexelSize::Resolution(_) if self.uv.is_none() => {
                Err(Error::setting("resolution", "a number of texels wants texture coordinates; divided triangles take metres"))
            }
            _ => Ok(()),
        }
    }
}

/// Texels of a map's side, at most.
pub(super) const MOST_SIDE: u32 = 16_384;
