//! Spectra of lamps and what they say.

use crate::error::{exception, setting};
use gonio_spectrum::{AlphaOpic, Figures, GlassIndex, MetalIndex, OPSINS, REC709_TO_REC2020, Spectrum, White, named, upsampling};
use pyo3::{prelude::*, types::PyDict};

/// The spectrum of a file's bytes, text of nm and power, IES TM-27 or TM-33: `name`, `wavelengths_nm`, `power` over its largest, and `notes` on the data.
#[pyfunction]
pub(crate) fn read_spectrum<'py>(py: Python<'py>, data: &[u8], name: &str) -> PyResult<Bound<'py, PyDict>> {
    let found = gonio_spectrum::read(data, name).map_err(|error| exception(gonio::Error::in_file(name, &error)))?;
    described(py, &found)
}

/// The spectrum of a name, as `read_spectrum` gives it: an illuminant of the CIE such as FL11, LED-B3 or D65; 2700K is a blackbody, D5700K
/// daylight.
#[pyfunction]
pub(crate) fn illuminant<'py>(py: Python<'py>, name: &str) -> PyResult<Bound<'py, PyDict>> {
    let unknown = || setting("name", format!("'{name}' was found, expected one of {}", gonio_spectrum::NAMES));
    let found = named(name).ok_or_else(unknown)?.map_err(|error| setting("name", error.problem))?;
    described(py, &found)
}

/// The metal of a name such as `gold`, `Au` or `Au-McPeak`: `name`, `wavelengths_nm`, `n`, `k` (index and extinction at each), `color` (linear Rec.709 at
/// normal incidence by daylight) and `notes` on the data.
#[pyfunction]
pub(crate) fn metal<'py>(py: Python<'py>, name: &str) -> PyResult<Bound<'py, PyDict>> {
    let unknown = || setting("metal", format!("'{name}' was found, expected one of {}", gonio_spectrum::metal_sets().join(", ")));
    metal_described(py, &gonio_spectrum::metal(name).ok_or_else(unknown)?)
}

/// The metal of a file's bytes as `metal` gives it: rows of wavelength (nm or micrometres), n and k.
#[pyfunction]
pub(crate) fn read_metal<'py>(py: Python<'py>, data: &[u8], name: &str) -> PyResult<Bound<'py, PyDict>> {
    let found = gonio_spectrum::read_metal(data, name).map_err(|error| exception(gonio::Error::in_file(name, &error)))?;
    metal_described(py, &found)
}

fn metal_described<'py>(py: Python<'py>, metal: &MetalIndex) -> PyResult<Bound<'py, PyDict>> {
    let described = PyDict::new(py);
    described.set_item("name", &metal.name)?;
    described.set_item("wavelengths_nm", &metal.wavelengths_nm)?;
    described.set_item("n", &metal.n)?;
    described.set_item("k", &metal.k)?;
    described.set_item("color", metal.colour(1.0).to_vec())?;
    described.set_item("notes", &metal.notes)?;
    Ok(described)
}

/// The glass or liquid of a name such as `N-BK7`, `water` or `SiO2-Malitson`: `name`, `wavelengths_nm`, `n` (the index at each), `ior` (at 587.56 nm), `abbe`
/// (the Abbe number by the lines d, F and C; None without dispersion) and `notes` on the data.
#[pyfunction]
pub(crate) fn glass<'py>(py: Python<'py>, name: &str) -> PyResult<Bound<'py, PyDict>> {
    let unknown = || setting("glass", format!("'{name}' was found, expected one of {}", gonio_spectrum::glass_sets().join(", ")));
    glass_described(py, &gonio_spectrum::glass(name).ok_or_else(unknown)?)
}

/// The glass of a file's bytes as `glass` gives it: rows of wavelength (nm or micrometres) and n, or the refractiveindex.info database's YAML.
#[pyfunction]
pub(crate) fn read_glass<'py>(py: Python<'py>, data: &[u8], name: &str) -> PyResult<Bound<'py, PyDict>> {
    let found = gonio_spectrum::read_glass(data, name).map_err(|error| exception(gonio::Error::in_file(name, &error)))?;
    glass_described(py, &found)
}

fn glass_described<'py>(py: Python<'py>, glass: &GlassIndex) -> PyResult<Bound<'py, PyDict>> {
    let described = PyDict::new(py);
    described.set_item("name", &glass.name)?;
    described.set_item("wavelengths_nm", &glass.wavelengths_nm)?;
    described.set_item("n", &glass.n)?;
    described.set_item("ior", glass.stated())?;
    described.set_item("abbe", Some(glass.abbe()).filter(|abbe| abbe.is_finite()))?;
    described.set_item("notes", &glass.notes)?;
    Ok(described)
}

/// The reflectance that a linear Rec.709 colour within 0 to 1 stands for in spectral renders, at wavelengths in nm (Jakob and Hanika 2019).
#[pyfunction]
pub(crate) fn colour_reflectance(colour: [f32; 3], wavelengths_nm: Vec<f32>) -> Vec<f32> {
    let wide = REC709_TO_REC2020.map(|row| row.iter().zip(colour).map(|(part, value)| part * value).sum());
    wavelengths_nm.into_iter().map(|nm| upsampling().reflectance(wide, nm)).collect()
}

fn described<'py>(py: Python<'py>, spectrum: &Spectrum) -> PyResult<Bound<'py, PyDict>> {
    let described = PyDict::new(py);
    described.set_item("name", &spectrum.name)?;
    described.set_item("wavelengths_nm", &spectrum.wavelengths_nm)?;
    described.set_item("power", &spectrum.power)?;
    described.set_item("notes", &spectrum.notes)?;
    Ok(described)
}

/// What a lamp's spectrum says: x, y, u_prime, v_prime, peak_nm, ler in lm/W, melanopic_der and alpha_opic, cct in K, duv, ra, r (R1 to R15),
/// ra_in_range, rf, rg, hue_bins (rf, rcs_percent, rhs), notes. What is undefined for the light is None.
/// wavelengths_nm: increasing; power: in any unit, per nm.
#[pyfunction]
pub(crate) fn spectrum_figures<'py>(py: Python<'py>, wavelengths_nm: Vec<f64>, power: Vec<f64>) -> PyResult<Bound<'py, PyDict>> {
    let spectrum = Spectrum::new("", &wavelengths_nm, &power).map_err(|error| setting("spectrum", error.problem))?;
    let figures = py.detach(|| gonio_spectrum::figures(&spectrum));
    figures_described(py, &figures)
}

/// All figures of a spectrum; what is undefined is None.
pub(crate) fn figures_described<'py>(py: Python<'py>, figures: &Figures) -> PyResult<Bound<'py, PyDict>> {
    let described = PyDict::new(py);
    for (key, value) in [
        ("x", figures.xy[0]),
        ("y", figures.xy[1]),
        ("u_prime", figures.uv[0]),
        ("v_prime", figures.uv[1]),
        ("peak_nm", figures.peak_nm),
        ("ler", figures.ler),
    ] {
        described.set_item(key, value)?;
    }
    described.set_item("melanopic_der", figures.melanopic_der())?;
    described.set_item("alpha_opic", figures.alpha_opic.as_ref().map(|all| receptors(py, all)).transpose()?)?;
    of_white(&described, figures.white.as_ref())?;
    described.set_item("notes", &figures.notes)?;
    Ok(described)
}

/// What each receptor gets.
fn receptors<'py>(py: Python<'py>, all: &[AlphaOpic; 5]) -> PyResult<Bound<'py, PyDict>> {
    let receptors = PyDict::new(py);
    for ((short, _), found) in OPSINS.iter().zip(all) {
        let receptor = PyDict::new(py);
        receptor.set_item("elr_mw_per_lm", found.elr_mw_per_lm)?;
        receptor.set_item("der", found.der)?;
        receptors.set_item(*short, receptor)?;
    }
    Ok(receptors)
}

/// Figures of white light.
fn of_white(described: &Bound<'_, PyDict>, white: Option<&White>) -> PyResult<()> {
    let rendering = white.and_then(|white| white.rendering.as_ref());
    let tm30 = white.and_then(|white| white.rendition.as_ref());
    described.set_item("cct", white.map(|white| white.cct))?;
    described.set_item("duv", white.map(|white| white.duv))?;
    described.set_item("ra", rendering.map(|rendering| rendering.ra))?;
    described.set_item("r", rendering.map(|rendering| rendering.r.to_vec()))?;
    described.set_item("ra_in_range", rendering.map(|rendering| rendering.distance <= gonio_spectrum::TOLERANCE))?;
    described.set_item("rf", tm30.map(|tm30| tm30.rf))?;
    described.set_item("rg", tm30.map(|tm30| tm30.rg))?;
    let bins = tm30.map(|tm30| {
        tm30.bins
            .iter()
            .map(|bin| {
                let described_bin = PyDict::new(described.py());
                described_bin.set_item("rf", bin.fidelity)?;
                described_bin.set_item("rcs_percent", bin.chroma_shift)?;
                described_bin.set_item("rhs", bin.hue_shift)?;
                Ok(described_bin)
            })
            .collect::<PyResult<Vec<_>>>()
    });
    described.set_item("hue_bins", bins.transpose()?)
}
