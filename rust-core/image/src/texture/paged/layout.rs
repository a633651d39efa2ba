//! How the texels of a pyramid are cut into square tiles, and where each tile lies among all of them.
//!
//! Tiles follow level by level, finest first, row by row. Those at the right and lower edges hold what is there, so that nothing is padded.

use crate::texture::pyramid::half_size;
use crate::texture::texel::TexelFormat;

/// The tiles of one level.
#[derive(Clone, Copy, Debug)]
struct LevelTiles {
    width: u32,
    height: u32,
    /// Tiles in a row.
    columns: u32,
    /// The level's first tile and first texel.
    first_tile: u32,
    first_texel: usize,
}

/// All tiles of a pyramid.
#[derive(Clone, Debug)]
pub(crate) struct TileLayout {
    format: TexelFormat,
    /// A tile's side is this power of two.
    shift: u32,
    /// 32-bit words a texel.
    words: usize,
    levels: Vec<LevelTiles>,
    tiles: u32,
    texels: usize,
}

/// A tile's place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct TileSpan {
    pub(crate) level: usize,
    /// The first texel's column and row in the level.
    pub(crate) corner: [usize; 2],
    pub(crate) width: usize,
    pub(crate) height: usize,
    /// The first texel among those of all tiles.
    pub(crate) first_texel: usize,
}

impl TileLayout {
    /// The tiles of a pyramid whose finest level is `width` × `height`.
    pub(crate) fn new(format: TexelFormat, width: u32, height: u32) -> Self {
        let words = format.words();
        // 16 KiB a tile, 32 for halves.
        let shift = if words == 4 { 5 } else { 6 };
        let mut layout = Self { format, shift, words, levels: Vec::new(), tiles: 0, texels: 0 };
        let mut size = [width.max(1) as usize, height.max(1) as usize];
        loop {
            let [width, height] = size.map(|side| side as u32);
            let columns = width.div_ceil(1 << shift);
            layout.levels.push(LevelTiles { width, height, columns, first_tile: layout.tiles, first_texel: layout.texels });
            layout.tiles += columns * height.div_ceil(1 << shift);
            layout.texels += size[0] * size[1];
            if size == [1, 1] {
                return layout;
            }
            size = size.map(half_size);
        }
    }

    /// Tiles of all levels.
    pub(crate) fn tiles(&self) -> u32 {
        self.tiles
    }

    /// How texels are stored.
    pub(crate) fn format(&self) -> TexelFormat {
        self.format
    }

    /// 32-bit words a texel.
    pub(crate) fn words(&self) -> usize {
        self.words
    }

    /// Bytes of all texels.
    pub(crate) fn bytes(&self) -> usize {
        self.texels * self.words * 4
    }

    /// Where a tile lies.
    pub(crate) fn span(&self, tile: u32) -> TileSpan {
        let level = self.levels.partition_point(|level| level.first_tile <= tile).saturating_sub(1);
        let of = &self.levels[level];
        let (side, number) = (1_usize << self.shift, (tile - of.first_tile) as usize);
        let corner = [number % of.columns as usize * side, number / of.columns as usize * side];
        let (width, height) = (side.min(of.width as usize - corner[0]), side.min(of.height as usize - corner[1]));
        // The rows above are whole, the tiles to the left are as high as this one.
        let first_texel = of.first_texel + corner[1] * of.width as usize + corner[0] * height;
        TileSpan { level, corner, width, height, first_texel }
    }

    /// The tile of a texel, and the texel's number in it; places beyond the level count as its last.
    #[inline]
    pub(crate) fn place(&self, level: u32, x: u32, y: u32) -> (u32, usize) {
        let (tile, [texel, ..]) = self.quad(level, [x, x], [y, y]).unwrap_or_default();
        (tile, texel)
    }

    /// The tile of the texels in two columns and two rows, and their numbers in it, row by row; `None` where they are in several.
    #[inline]
    pub(crate) fn quad(&self, level: u32, x: [u32; 2], y: [u32; 2]) -> Option<(u32, [usize; 4])> {
        let of = &self.levels[(level as usize).min(self.levels.len() - 1)];
        let (x, y) = (x.map(|x| x.min(of.width - 1)), y.map(|y| y.min(of.height - 1)));
        let (column, row) = (x[0] >> self.shift, y[0] >> self.shift);
        if x[1] >> self.shift != column || y[1] >> self.shift != row {
            return None;
        }
        let (left, top) = (column << self.shift, row << self.shift);
        let width = (1 << self.shift).min(of.width - left);
        let texel = |x: u32, y: u32| ((y - top) * width + (x - left)) as usize;
        let texels = [texel(x[0], y[0]), texel(x[1], y[0]), texel(x[0], y[1]), texel(x[1], y[1])];
        Some((of.first_tile + row * of.columns + column, texels))
    }

    /// The words of a tile, out of those of a level-by-level pyramid.
    pub(crate) fn cut(&self, pyramid: &[f32], tile: u32, out: &mut Vec<f32>) {
        out.clear();
        self.rows(tile, |row| out.extend_from_slice(&pyramid[row]));
    }

    /// Puts the words of a tile into a level-by-level pyramid.
    pub(crate) fn paste(&self, tile: u32, words: &[f32], pyramid: &mut [f32]) {
        let mut rest = words;
        self.rows(tile, |row| {
            let (own, others) = rest.split_at(row.len());
            pyramid[row].copy_from_slice(own);
            rest = others;
        });
    }

    /// Visits the words of a tile's rows in the pyramid.
    fn rows(&self, tile: u32, mut visit: impl FnMut(std::ops::Range<usize>)) {
        let TileSpan { level, corner, width, height, .. } = self.span(tile);
        let of = &self.levels[level];
        for row in corner[1]..corner[1] + height {
            let first = (of.first_texel + row * of.width as usize + corner[0]) * self.words;
            visit(first..first + width * self.words);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tiles_hold_every_texel_once() {
        for (format, width, height) in [(TexelFormat::Byte, 200, 130), (TexelFormat::Half, 1, 300), (TexelFormat::Float, 65, 31)] {
            let layout = TileLayout::new(format, width, height);
            let pyramid: Vec<f32> = (0..layout.bytes() / 4).map(|i| i as f32).collect();
            let (mut again, mut words, mut seen) = (vec![-1.0; pyramid.len()], Vec::new(), 0);
            for tile in 0..layout.tiles() {
                layout.cut(&pyramid, tile, &mut words);
                let span = layout.span(tile);
                assert_eq!((words.len(), span.first_texel), (span.width * span.height * format.words(), seen));
                seen += span.width * span.height;
                layout.paste(tile, &words, &mut again);
                let [x, y] = span.corner.map(|place| place as u32);
                let last = (x + span.width as u32 - 1, y + span.height as u32 - 1);
                assert_eq!(layout.place(span.level as u32, x, y), (tile, 0));
                assert_eq!(layout.place(span.level as u32, last.0, last.1), (tile, span.width * span.height - 1));
            }
            assert_eq!(again, pyramid);
        }
    }
}
