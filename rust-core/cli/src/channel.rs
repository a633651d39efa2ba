//! One quantity of an EXR file.

use gonio::{
    Error, Result,
    output::{Channels, read_exr},
};
use std::path::Path;

/// The channels of a file, with width and height, and the place of the one that was asked for.
pub(super) struct Picture {
    pub(super) channels: Channels,
    pub(super) size: [usize; 2],
    chosen: usize,
}

impl Picture {
    /// Reads a file. A channel is found by its whole name, or by a part of it between points that no other has: Blender's files call it
    /// `ViewLayer.Luminance.X`.
    pub(super) fn read(path: &Path, quantity: &str) -> Result<Self> {
        let (channels, size) = read_exr(path)?;
        let by_name = channels.iter().position(|(name, _)| name == quantity);
        let has_part = |index: &usize| channels[*index].0.split('.').any(|part| part.eq_ignore_ascii_case(quantity));
        let by_part: Vec<usize> = (0..channels.len()).filter(has_part).collect();
        let names = |of: &[usize]| of.iter().map(|index| channels[*index].0.as_str()).collect::<Vec<_>>().join(", ");
        let chosen = match (by_name, &by_part[..]) {
            (Some(whole), _) => whole,
            (None, [part]) => *part,
            (None, []) => {
                let known = names(&(0..channels.len()).collect::<Vec<_>>());
                let problem =
                    format!("there is no channel '{quantity}' (gonio render writes it with --aov {quantity}); the file has {known}");
                return Err(Error::Format { path: path.to_owned(), line: None, problem });
            }
            (None, several) => {
                let problem = format!("'{quantity}' names several channels, expected one of {}", names(several));
                return Err(Error::setting("quantity", problem));
            }
        };
        Ok(Self { channels, size, chosen })
    }

    /// The channel that was asked for.
    pub(super) fn values(&self) -> &[f32] {
        &self.channels[self.chosen].1
    }

    /// The unit of a quantity as a legend shows it; empty where none is known.
    pub(super) fn unit(quantity: &str) -> &'static str {
        match quantity.to_ascii_lowercase().as_str() {
            "luminance" => "cd/m²",
            "illuminance" => "lx",
            _ => "",
        }
    }
}
