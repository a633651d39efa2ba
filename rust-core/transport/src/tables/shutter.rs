//! The shutter: how samples spread over the time that it is open.

/// The shutter of a view in which something moves. Times count from 0 to 1 over the keys of what moves.
#[derive(Clone, Debug, PartialEq)]
pub struct Shutter {
    /// When it opens and when it is closed again.
    pub interval: [f32; 2],
    /// Shares of the way from open to closed that light gets in by, at even steps of a random number: the inverse of the summed shutter curve.
    /// Empty for a shutter that opens and closes at once.
    pub curve: Vec<f32>,
    /// Rows that are exposed one after the other, if they are.
    pub rolling: Option<Rolling>,
}

/// A rolling shutter, from the top row of the picture to the bottom one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rolling {
    /// Share of the interval that a row is exposed.
    pub duration: f32,
    /// Rows of the picture.
    pub rows: u32,
}

impl Default for Shutter {
    fn default() -> Self {
        Self { interval: [0.0, 1.0], curve: Vec::new(), rolling: None }
    }
}

impl Shutter {
    /// The time for a random number of a sample in a row of pixels.
    pub fn time(&self, random: f32, row: u32) -> f32 {
        let mut share = self.share(random);
        if let Some(Rolling { duration, rows }) = self.rolling {
            let start = (row as f32 + 0.5) / rows.max(1) as f32 * (1.0 - duration);
            share = start + share * duration;
        }
        self.interval[0] + share * (self.interval[1] - self.interval[0])
    }

    fn share(&self, random: f32) -> f32 {
        let Some(last) = self.curve.len().checked_sub(2) else { return random };
        let place = random.clamp(0.0, 1.0) * (last + 1) as f32;
        let number = (place as usize).min(last);
        let [from, to] = [self.curve[number], self.curve[number + 1]];
        from + (to - from) * (place - number as f32)
    }
}
