//! Frames one after the other: one that fails does not end the others.

use super::messages::say;
use gonio::{Error, Result};

/// The status of a run of which frames have failed.
const FAILED_STATUS: i32 = 1;

/// Does all frames. The error of one is told where others are left; what would fail alike for all ends the run, as interruption does.
pub(super) fn run(frames: &[Option<f64>], mut frame: impl FnMut(Option<f64>) -> Result<()>) -> Result<i32> {
    let mut failed = Vec::new();
    for code in frames {
        match (frame(*code), code) {
            (Ok(()), _) => {}
            (Err(error), Some(code)) if frames.len() > 1 && is_of_frame(&error) => {
                say(&format!("frame {code}: error: {error}"));
                failed.push(code.to_string());
            }
            (Err(error), _) => return Err(error),
        }
    }
    if failed.is_empty() {
        return Ok(0);
    }
    say(&format!("error: {} of {} frames failed: {}", failed.len(), frames.len(), failed.join(", ")));
    Ok(FAILED_STATUS)
}

/// Whether another frame may go well; settings are the same for all.
fn is_of_frame(error: &Error) -> bool {
    !matches!(error, Error::Cancelled | Error::Setting { .. })
}

#[cfg(test)]
mod tests {
    use super::run;
    use gonio::Error;

    #[test]
    fn a_frame_that_fails_does_not_end_the_others() {
        let frames = [Some(1.0), Some(2.0), Some(3.0)];
        let mut seen = Vec::new();
        let status = run(&frames, |frame| {
            seen.push(frame);
            if frame == Some(2.0) { Err(Error::Internal("broken".into())) } else { Ok(()) }
        });
        assert_eq!(status.expect("the others are done"), 1);
        assert_eq!(seen, frames);
        assert!(matches!(run(&frames, |_| Err(Error::Cancelled)), Err(Error::Cancelled)));
        assert!(run(&frames, |_| Err(Error::setting("aov", "unknown"))).is_err());
        assert!(run(&frames[..1], |_| Err(Error::Internal("broken".into()))).is_err());
    }
}
