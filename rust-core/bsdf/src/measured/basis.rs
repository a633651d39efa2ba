//! Many spectra by few: the sums of some that come nearest to them all.
//!
//! Orthonormal spectra by subspace iteration on the matrix of second moments (principal components about zero). Each spectrum counts by its own size, so
//! that dark parts of a lobe keep their colour as bright ones do.

/// Components of one gather.
pub(super) const QUAD: usize = 4;
/// The most components.
const MOST: usize = 4 * QUAD;
/// Components are added until spectra differ by less than this, rms over their own.
const AIM: f64 = 1e-3;
/// Spectra of less than this share of the largest count as if they had it: they are noise.
const FAINT: f64 = 1e-3;
/// Rounds of the iteration: parts that matter differ in size, and are told apart in few.
const ROUNDS: usize = 40;

/// Spectra that others are sums of.
#[derive(Clone, Debug)]
pub(super) struct Basis {
    /// Orthonormal, the most important first; a multiple of four, the last of which may be zero.
    pub(super) components: Vec<Vec<f64>>,
    /// What is left out of a spectrum over the whole of it, rms.
    pub(super) error: f64,
}

impl Basis {
    /// A basis of spectra of as many bands each.
    pub(super) fn of(spectra: &[Vec<f64>], bands: usize) -> Self {
        let sizes: Vec<f64> = spectra.iter().map(|spectrum| dot(spectrum, spectrum).sqrt()).collect();
        let faint = FAINT * sizes.iter().copied().fold(0.0, f64::max);
        let mut moments = vec![vec![0.0; bands]; bands];
        let mut whole = 0.0;
        for (spectrum, size) in spectra.iter().zip(sizes).filter(|(_, size)| *size > 0.0) {
            let weight = size.max(faint).powi(-2) / spectra.len() as f64;
            whole += weight * size * size;
            for (row, one) in moments.iter_mut().zip(spectrum) {
                row.iter_mut().zip(spectrum).for_each(|(sum, other)| *sum += weight * one * other);
            }
        }
        let mut components = iterated(&moments, bands);
        let kept = |component: &Vec<f64>| dot(component, &times(&moments, component));
        let mut left = whole;
        let mut count = 0;
        while count < components.len() && (count % QUAD != 0 || left > AIM * AIM * whole) {
            left -= kept(&components[count]);
            count += 1;
        }
        components.truncate(count);
        components.resize(count.next_multiple_of(QUAD).max(QUAD), vec![0.0; bands]);
        Self { components, error: if whole > 0.0 { (left.max(0.0) / whole).sqrt() } else { 0.0 } }
    }

    /// How much of each of four components is in a spectrum.
    pub(super) fn shares(&self, quad: usize, spectrum: &[f64]) -> [f32; QUAD] {
        std::array::from_fn(|part| dot(&self.components[quad * QUAD + part], spectrum) as f32)
    }
}

/// The directions in which the moments are largest, from smooth ones on.
fn iterated(moments: &[Vec<f64>], bands: usize) -> Vec<Vec<f64>> {
    let wave = |number: usize| {
        let at = |band: usize| (std::f64::consts::PI * number as f64 * (band as f64 + 0.5) / bands as f64).cos();
        (0..bands).map(at).collect::<Vec<f64>>()
    };
    let mut found = orthonormal((0..MOST.min(bands)).map(wave));
    for _ in 0..ROUNDS {
        found = orthonormal(found.iter().map(|component| times(moments, component)));
    }
    found
}

fn times(matrix: &[Vec<f64>], vector: &[f64]) -> Vec<f64> {
    matrix.iter().map(|row| dot(row, vector)).collect()
}

fn dot(one: &[f64], other: &[f64]) -> f64 {
    one.iter().zip(other).map(|(a, b)| a * b).sum()
}

/// Vectors at right angles to those before (Gram and Schmidt, twice against rounding); without those in which nothing new is left.
fn orthonormal(vectors: impl Iterator<Item = Vec<f64>>) -> Vec<Vec<f64>> {
    let mut found: Vec<Vec<f64>> = Vec::new();
    for mut vector in vectors {
        let before = dot(&vector, &vector).sqrt();
        for known in [&found, &found].into_iter().flatten() {
            let share = dot(known, &vector);
            vector.iter_mut().zip(known).for_each(|(x, known)| *x -= share * known);
        }
        let size = dot(&vector, &vector).sqrt();
        if size > 1e-12 * before {
            vector.iter_mut().for_each(|x| *x /= size);
            found.push(vector);
        }
    }
    found
}
