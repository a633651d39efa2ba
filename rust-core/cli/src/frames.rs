//! Frame specifications as usdrecord has them: `101`, `101:110`, `101:110x2`, separated by commas.

use gonio::{Error, Result};

/// Most frames of one run.
const MOST_FRAMES: usize = 1_000_000;

/// The frames in order.
pub(super) fn parse(text: &str) -> Result<Vec<f64>> {
    let mut frames = Vec::new();
    for part in text.split(',') {
        append(part.trim(), &mut frames).ok_or_else(|| Error::Setting {
            name: "frames".into(),
            problem: format!("'{part}' was found, expected a frame (12), a range (1:10) or a range with a step (1:10x2)"),
        })?;
    }
    Ok(frames)
}

/// So many frames from the one named on, else from the stage's first, else from 1; `step` apart.
pub(super) fn counted(named: Option<&[f64]>, first: Option<f64>, count: u32, step: Option<f64>) -> Result<Vec<f64>> {
    let start = match named {
        None => first.unwrap_or(1.0),
        Some([start]) => *start,
        Some(_) => return Err(Error::setting("frame-count", "it counts from one frame on, and --frames names several")),
    };
    let step = step.unwrap_or(1.0);
    if !step.is_finite() || step == 0.0 {
        return Err(Error::setting("frame-inc", format!("{step} was found, expected a number other than 0")));
    }
    Ok((0..count).map(|number| start + step * f64::from(number)).collect())
}

fn append(part: &str, frames: &mut Vec<f64>) -> Option<()> {
    let number = |text: &str| text.parse::<f64>().ok().filter(|x| x.is_finite());
    let Some((start, rest)) = part.split_once(':') else {
        frames.push(number(part)?);
        return Some(());
    };
    let (end, step) = match rest.split_once('x') {
        Some((end, step)) => (number(end)?, number(step)?),
        None => (number(rest)?, 1.0),
    };
    let start = number(start)?;
    let step = if end < start { -step.abs() } else { step.abs() };
    let count = if step == 0.0 { return None } else { ((end - start) / step + 1e-9).floor() };
    if !(0.0..MOST_FRAMES as f64).contains(&count) {
        return None;
    }
    frames.extend((0..=count as usize).map(|i| start + step * i as f64));
    Some(())
}

#[cfg(test)]
mod tests {
    use super::{counted, parse};

    #[test]
    fn counted_frames() {
        assert_eq!(counted(Some(&[1.0]), None, 3, Some(2.0)).expect("valid"), [1.0, 3.0, 5.0]);
        assert_eq!(counted(None, Some(101.0), 2, None).expect("valid"), [101.0, 102.0]);
        assert!(counted(Some(&[1.0, 2.0]), None, 2, None).is_err() && counted(None, None, 2, Some(0.0)).is_err());
    }

    #[test]
    fn ranges_and_steps() {
        assert_eq!(parse("1:10x3,20").expect("valid"), [1.0, 4.0, 7.0, 10.0, 20.0]);
        assert_eq!(parse("3:1").expect("valid"), [3.0, 2.0, 1.0]);
        assert_eq!(parse("-2:0").expect("valid"), [-2.0, -1.0, 0.0]);
        for bad in ["", "a", "1:", "1:2x0", "1:1e30", "nan"] {
            assert!(parse(bad).is_err(), "{bad}");
        }
    }
}
