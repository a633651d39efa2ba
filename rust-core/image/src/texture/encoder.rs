//! Linear values to 8-bit codes, fast enough for whole pyramids.

use crate::colour::Transfer;

/// Rounds linear values to the nearest code of a transfer function.
#[derive(Clone, Debug)]
pub(crate) struct Encoder {
    /// The linear value halfway (in stored numbers) between a code and the next.
    thresholds: [f32; 256],
    /// The code of the lower end of each step of the square root, where a search starts.
    start: [u8; STEPS],
}

const STEPS: usize = 1024;

impl Encoder {
    pub(crate) fn new(transfer: Transfer) -> Self {
        let mut thresholds = [f32::INFINITY; 256];
        for (code, threshold) in thresholds.iter_mut().enumerate().take(255) {
            *threshold = transfer.decode((code as f64 + 0.5) / 255.0) as f32;
        }
        let mut encoder = Self { thresholds, start: [0; STEPS] };
        let mut code = 0;
        for step in 0..STEPS {
            // A little below the step's lower end, against rounding of the square root.
            let root = (step as f32 - 0.01) / STEPS as f32;
            code = encoder.search(root.max(0.0) * root, code);
            encoder.start[step] = code;
        }
        encoder
    }

    fn search(&self, linear: f32, from: u8) -> u8 {
        let mut code = from;
        while linear >= self.thresholds[usize::from(code)] {
            code += 1;
        }
        code
    }

    /// The code nearest to `linear`; NaN gives 0.
    pub(crate) fn encode(&self, linear: f32) -> u8 {
        let linear = if linear > 0.0 { linear.min(1.0) } else { 0.0 };
        let step = (linear.sqrt() * STEPS as f32) as usize;
        self.search(linear, self.start[step.min(STEPS - 1)])
    }
}
