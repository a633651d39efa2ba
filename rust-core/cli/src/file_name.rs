//! Which frame output names with a place for one are for.

use gonio::{Error, Result};
use gonio_usd::frame_name::{for_frame, has_frame};
use std::path::{Path, PathBuf};

/// The frame that names are for: the one that is rendered, else the stage's first, else 1. Default values are of no frame.
pub(super) fn named_frame(frame: Option<f64>, range: Option<[f64; 2]>, default_time: bool) -> Option<f64> {
    frame.or_else(|| (!default_time).then(|| range.map_or(1.0, |[first, _]| first)))
}

/// The name for a frame; one with a place for it cannot be had without.
pub(super) fn filled_in(path: &Path, frame: Option<f64>) -> Result<PathBuf> {
    match frame {
        Some(frame) => Ok(for_frame(path, frame)),
        None if has_frame(path) => {
            let problem = format!("{} has a place for the frame number, and --default-time is of no frame", path.display());
            Err(Error::setting("output", problem))
        }
        None => Ok(path.to_owned()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_take_the_stages_first_frame_where_none_is_asked_for() {
        let name = |frame| filled_in(Path::new("a.$F4.exr"), frame);
        let shown = |frame, range, is_default| name(named_frame(frame, range, is_default)).ok();
        assert_eq!(shown(Some(3.0), Some([7.0, 8.0]), false), Some("a.0003.exr".into()));
        assert_eq!(shown(None, Some([7.0, 8.0]), false), Some("a.0007.exr".into()));
        assert_eq!(shown(None, None, false), Some("a.0001.exr".into()));
        assert_eq!(shown(None, Some([7.0, 8.0]), true), None);
        assert_eq!(filled_in(Path::new("a.exr"), None).ok(), Some("a.exr".into()));
    }
}
