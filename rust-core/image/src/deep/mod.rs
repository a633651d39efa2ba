//! Deep pictures: of each pixel some samples, one behind the other, and their files in OpenEXR's `deepscanline`.

mod compress;
mod header;
mod write;

pub use header::DeepHeader;
pub use write::write_deep;

/// What is at some depth of a pixel, as compositors lay it over what is behind (premultiplied).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DeepSample {
    /// Radiance times exposure, and coverage of what is behind; the light is that of the coverage, not of the whole pixel.
    pub rgba: [f32; 4],
    /// Where it begins and ends, metres.
    pub depth: [f32; 2],
}

/// Samples of all pixels.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct DeepPicture {
    /// Width and height.
    pub size: [usize; 2],
    /// Samples of each pixel, row by row from the top.
    pub counts: Vec<u32>,
    /// The pixels' samples one after the other, each pixel's from front to back.
    pub samples: Vec<DeepSample>,
}

impl DeepPicture {
    /// The samples of each row.
    pub fn rows(&self) -> impl Iterator<Item = (&[u32], &[DeepSample])> {
        let mut rest = self.samples.as_slice();
        self.counts.chunks(self.size[0].max(1)).map(move |counts| {
            let count = counts.iter().map(|count| *count as usize).sum::<usize>().min(rest.len());
            let (row, behind) = rest.split_at(count);
            rest = behind;
            (counts, row)
        })
    }

    /// The samples of each pixel laid over one another: colour and coverage, four values a pixel.
    pub fn flattened(&self) -> Vec<f32> {
        let mut flat = Vec::with_capacity(4 * self.counts.len());
        let mut rest = self.samples.as_slice();
        for count in &self.counts {
            let (pixel, behind) = rest.split_at((*count as usize).min(rest.len()));
            rest = behind;
            let (mut sum, mut open) = ([0.0; 4], 1.0);
            for sample in pixel {
                sum.iter_mut().zip(sample.rgba).for_each(|(sum, value)| *sum += open * value);
                open *= 1.0 - sample.rgba[3];
            }
            flat.extend(sum);
        }
        flat
    }
}
