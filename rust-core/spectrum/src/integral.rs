//! Exact integrals of products of tables that are linear between their points.

/// The wavelengths of the spectral tables, nm.
pub(crate) const VISIBLE: [f64; 2] = [380.0, 780.0];

/// An integrand's integral from the first of [`VISIBLE`] on. Exact where the integrand is of third degree between knots.
#[derive(Debug)]
pub(crate) struct Integral<F, const N: usize> {
    knots: Vec<f64>,
    sums: Vec<[f64; N]>,
    integrand: F,
}

impl<F: Fn(f64) -> [f64; N], const N: usize> Integral<F, N> {
    /// Over knots at the whole nanometres and at further wavelengths, nm.
    pub(crate) fn new(further: &[f64], integrand: F) -> Self {
        let [first, last] = VISIBLE;
        let mut knots: Vec<f64> = (0..=(last - first) as u32).map(|k| first + f64::from(k)).collect();
        knots.extend(further.iter().filter(|nm| (first..last).contains(*nm)));
        knots.sort_by(f64::total_cmp);
        knots.dedup();
        let mut sums = vec![[0.0; N]];
        for pair in knots.windows(2) {
            let piece = piece(&integrand, pair[0], pair[1]);
            let before = sums[sums.len() - 1];
            sums.push(std::array::from_fn(|k| before[k] + piece[k]));
        }
        Self { knots, sums, integrand }
    }

    /// The integral up to a wavelength within [`VISIBLE`], nm.
    pub(crate) fn to(&self, nm: f64) -> [f64; N] {
        let below = self.knots.partition_point(|knot| *knot <= nm).max(1) - 1;
        let piece = piece(&self.integrand, self.knots[below], nm);
        std::array::from_fn(|k| self.sums[below][k] + piece[k])
    }

    /// The integral between two wavelengths within [`VISIBLE`], nm.
    pub(crate) fn between(&self, from: f64, to: f64) -> [f64; N] {
        let [from, to] = [from, to].map(|nm| self.to(nm));
        std::array::from_fn(|k| to[k] - from[k])
    }

    /// The integral over all of [`VISIBLE`].
    pub(crate) fn all(&self) -> [f64; N] {
        self.sums[self.sums.len() - 1]
    }
}

/// Gauss's rule of two points, which asks for no value at the ends, where spectra may jump.
fn piece<const N: usize>(integrand: impl Fn(f64) -> [f64; N], from: f64, to: f64) -> [f64; N] {
    const OFFSET: f64 = 0.577_350_269_189_625_8;
    let [middle, half] = [0.5 * (from + to), 0.5 * (to - from)];
    let [low, high] = [middle - OFFSET * half, middle + OFFSET * half].map(integrand);
    std::array::from_fn(|k| half * (low[k] + high[k]))
}
