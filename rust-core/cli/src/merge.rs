//! `gonio merge`.

use super::{
    arguments::MergeArguments,
    file::check_targets,
    messages::say,
    output::{Notes, Writer},
};
use gonio::{Error, Result, checkpoint::merge as join};
use gonio_simd::Execution;

/// Joins parts of a render's samples and writes the picture.
pub(super) fn merge(options: &MergeArguments) -> Result<i32> {
    if options.files.output.is_empty() && options.files.deep.is_none() {
        return Err(Error::setting("output", "no file was given; say -o picture.exr"));
    }
    let writer = Writer::new(&options.files, Execution::detect())?;
    check_targets(options.files.output.iter().chain(&options.files.deep))?;
    let whole = join(&options.parts)?;
    let range = whole.film.range();
    if !options.quiet {
        say(&format!("{} parts, samples {}:{} of {}", options.parts.len(), range.start, range.end, whole.identity.stamp.settings.samples));
    }
    let notes = Notes { exposure: whole.identity.exposure, attributes: &whole.identity.notes, ..Notes::default() };
    let mut image = whole.film.develop();
    writer.finish(&mut image)?;
    // What can be written is, whatever becomes of the other.
    let written = writer.write_all(&options.files.output, &image, &notes, options.quiet);
    let deep = options.files.deep.as_ref().map_or(Ok(()), |path| writer.write_deep(path, &image, &notes, options.quiet));
    written.and(deep).map(|()| 0)
}
