//! Drawings as files: SVG as it is, PNG as it looks.

use super::file::ending;
use gonio::{Error, Result, output::encode_png};
use resvg::{
    tiny_skia::{Pixmap, Transform},
    usvg::{Options, Tree},
};
use std::path::Path;

/// Endings of drawings' files.
pub(super) const ENDINGS: &[&str] = &["svg", "png"];

/// Pixels of a PNG file across one of the drawing's: thin lines and small letters want more than one.
const DENSITY: f32 = 2.0;

/// An SVG document as the bytes of a file by the ending of its name, one of [`ENDINGS`].
///
/// # Errors
/// A document that cannot be drawn.
pub(super) fn encoded(svg: String, path: &Path) -> Result<Vec<u8>> {
    if ending(path) != "png" {
        return Ok(svg.into_bytes());
    }
    let pixels = drawn(&svg).map_err(|error| Error::io(path, error))?;
    let [width, height] = [pixels.width(), pixels.height()];
    encode_png(&pixels.take_demultiplied(), width, height).map_err(|error| Error::io(path, error))
}

/// The document's pixels. Letters are DejaVu Sans on every machine, whatever fonts it has.
fn drawn(svg: &str) -> std::io::Result<Pixmap> {
    let mut options = Options::default();
    let fonts = options.fontdb_mut();
    fonts.load_font_data(dejavu::sans::regular().to_vec());
    fonts.set_sans_serif_family("DejaVu Sans");
    let tree = Tree::from_str(svg, &options).map_err(std::io::Error::other)?;
    let size = tree.size().to_int_size().scale_by(DENSITY).ok_or_else(|| std::io::Error::other("a drawing without a size"))?;
    let mut pixels = Pixmap::new(size.width(), size.height()).ok_or_else(|| std::io::Error::other("a drawing beyond all sizes"))?;
    resvg::render(&tree, Transform::from_scale(DENSITY, DENSITY), &mut pixels.as_mut());
    Ok(pixels)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn letters_are_drawn_without_fonts_of_the_machine() {
        let page = |text: &str| {
            let white = "<rect width=\"60\" height=\"20\" fill=\"white\"/>";
            let text = format!("<text x=\"4\" y=\"15\">{text}</text>");
            format!("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"60\" height=\"20\" font-family=\"sans-serif\">{white}{text}</svg>")
        };
        let dark = |text: &str| drawn(&page(text)).expect("a page").pixels().iter().filter(|pixel| pixel.red() < 128).count();
        assert_eq!(dark(""), 0);
        // A sign that a font lacks is an empty box, the same for all: these differ.
        let signs = ["0", "ü", "°", "–", "²"].map(dark);
        assert!(signs.iter().all(|count| *count > 4) && signs.windows(2).all(|pair| pair[0] != pair[1]), "{signs:?}");
    }
}
