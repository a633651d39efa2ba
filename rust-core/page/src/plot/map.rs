//! A grid's values where they lie.

use super::{
    Head, Scale,
    axis::ticks,
    drawing::{Anchor, Drawing, Ink, LETTER, LETTERS, WIDTH},
};
use crate::Numbers;

/// Room for the cells.
const ROOM: [f64; 2] = [560.0, 460.0];
/// Room for the numbers beside the axis of the rows and below that of the columns.
const LEFT: f64 = 46.0;
const BELOW: f64 = 44.0;
/// Height of the legend at least.
const LEGEND: f64 = 230.0;
/// The greatest height of a cell's letters, and the least that can be read.
const HEIGHTS: [f64; 2] = [18.0, 7.5];
/// Steps of an axis at most.
const STEPS: usize = 10;

/// Values on a rectangle of equal cells, row by row from the lower left corner on, seen from above.
#[derive(Clone, Debug)]
pub struct Map<'a> {
    /// Title and what else is to be said.
    pub head: Head,
    /// Cells along a row, and rows.
    pub size: [usize; 2],
    /// Width and depth of a cell, m.
    pub spacing: [f64; 2],
    /// A value a cell; `None` where there is no point.
    pub values: &'a [Option<f64>],
    /// Colours.
    pub scale: &'a Scale,
    /// How the values are written, with so many decimals.
    pub decimals: usize,
}

impl Map<'_> {
    /// The plot.
    pub fn svg(&self, numbers: Numbers) -> String {
        let extent = [0, 1].map(|axis| self.size[axis].max(1) as f64 * self.spacing[axis]);
        let per_metre = (ROOM[0] / extent[0]).min(ROOM[1] / extent[1]);
        let cell = self.spacing.map(|length| length * per_metre);
        let [width, height] = extent.map(|length| length * per_metre);
        let mut drawing = Drawing::new();
        for (index, value) in self.values.iter().enumerate() {
            let Some(value) = *value else { continue };
            let [x, y] = [LEFT + (index % self.size[0]) as f64 * cell[0], height - (index / self.size[0] + 1) as f64 * cell[1]];
            let class = self.scale.class(value);
            drawing.rectangle([x, y], cell, &self.scale.colour(class));
            let text = cell_text(&numbers.fixed(value, self.decimals), [x + 0.5 * cell[0], y + 0.5 * cell[1]], cell, self.scale.ink(class));
            drawing.add(format_args!("{text}"));
        }
        self.axes(&mut drawing, [width, height], per_metre, numbers);
        let legend = height.max(LEGEND);
        self.scale.legend(&mut drawing, [WIDTH - 96.0, 0.0], legend, numbers);
        drawing.finish(&self.head, legend.max(height + BELOW))
    }

    /// Metres along both sides.
    fn axes(&self, drawing: &mut Drawing, [width, height]: [f64; 2], per_metre: f64, numbers: Numbers) {
        let told = |place: f64| numbers.form(&((1e6 * place).round() / 1e6).to_string());
        for place in ticks(width / per_metre, STEPS) {
            let x = LEFT + place * per_metre;
            drawing.line([x, height], [x, height + 5.0]);
            drawing.text([x, height + 7.0 + LETTERS], Anchor::Middle, Ink::Soft, &told(place));
        }
        let most = ((height / (1.6 * LETTERS)) as usize).clamp(1, STEPS);
        for place in ticks(height / per_metre, most) {
            let y = height - place * per_metre;
            drawing.line([LEFT - 5.0, y], [LEFT, y]);
            drawing.text([LEFT - 9.0, y + 0.35 * LETTERS], Anchor::End, Ink::Soft, &told(place));
        }
        drawing.text([LEFT + width, height + 9.0 + 2.0 * LETTERS], Anchor::End, Ink::Soft, "m");
    }
}

/// A value in its cell, as an element of SVG; nothing where it could not be read.
pub fn cell_text(value: &str, [x, y]: [f64; 2], cell: [f64; 2], ink: &str) -> String {
    let height = (0.84 * cell[0] / (LETTER * value.chars().count().max(4) as f64)).min(0.5 * cell[1]).min(HEIGHTS[0]);
    if height < HEIGHTS[1] {
        return String::new();
    }
    let y = y + 0.35 * height;
    format!(
        "<text x=\"{x:.1}\" y=\"{y:.1}\" font-size=\"{height:.1}\" text-anchor=\"middle\" fill=\"{ink}\">{}</text>",
        crate::escaped(value)
    )
}
