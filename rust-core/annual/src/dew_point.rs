//! Dew points as `gendaymtx` takes them.

/// Dew point where a file tells none, °C: `gendaymtx`'s.
pub const USUAL_DEW_POINT_C: f64 = 11.0;

/// The mean over three records that `gendaymtx` takes.
#[derive(Default)]
pub(crate) struct DewPoints {
    before: Option<[f64; 2]>,
    last: Option<f64>,
}

impl DewPoints {
    /// Takes a record's dew point, and gives the mean of it and the two before.
    pub(crate) fn mean(&mut self, found: Option<f64>) -> f64 {
        if let Some(value) = found {
            let [first, second] = self.before.unwrap_or([value; 2]);
            self.last = Some((first + second + value) / 3.0);
            self.before = Some([second, value]);
        } else {
            self.before = None;
        }
        self.last.unwrap_or(USUAL_DEW_POINT_C)
    }
}
