//! `gonio compare`.

use super::{
    arguments::CompareOptions,
    file::{check_targets, put},
    messages::print,
    messages::say,
};
use gonio::{
    Error, Result,
    output::{compare as compare_images, difference_picture, encode_png, read_exr},
};

/// Compares two EXR files; status 1 past the limit.
pub(super) fn compare(options: &CompareOptions) -> Result<i32> {
    check_targets(&options.difference)?;
    let (mut image, size) = read_exr(&options.image)?;
    let (mut reference, expected) = read_exr(&options.reference)?;
    if size != expected {
        return Err(Error::Format {
            path: options.image.clone(),
            line: None,
            problem: format!("{} x {} pixels, the reference has {} x {}", size[0], size[1], expected[0], expected[1]),
        });
    }
    if !options.channels.is_empty() {
        image.retain(|(name, _)| options.channels.contains(name));
        reference.retain(|(name, _)| options.channels.contains(name));
    }
    let comparison = compare_images(&image, &reference, size[0], size[1]);
    print("channel            relMSE        max   mean image    mean ref  block median     95 %");
    for c in &comparison.channels {
        print(&format!(
            "{:<14} {:>10.3e} {:>10.3e} {:>12.5e} {:>11.5e} {:>12.3} % {:>7.3} %{}",
            c.name,
            c.relative_mse,
            c.largest,
            c.means[0],
            c.means[1],
            c.blocks[0] * 100.0,
            c.blocks[1] * 100.0,
            if c.not_finite > 0 { format!("  {} pixels not finite in one image", c.not_finite) } else { String::new() }
        ));
    }
    for name in &comparison.unmatched {
        say(&format!("only one image has channel '{name}'"));
    }
    if let Some(path) = &options.difference {
        let rgba = difference_picture(&image, &reference);
        let picture = encode_png(&rgba, size[0] as u32, size[1] as u32).map_err(|error| Error::io(path, error))?;
        put(path, &picture)?;
    }
    let worst = comparison.worst();
    Ok(i32::from(comparison.channels.is_empty() || options.max.is_some_and(|max| worst > max)))
}
