//! `_gonio`: what the Python package `gonio` is made of.

mod annual;
mod annual_glare;
mod array;
mod artist_sky;
mod bake;
mod buffer;
mod curves;
mod daylight;
mod description;
mod dim;
mod error;
mod facades;
mod field;
mod film;
mod glare;
mod goniometer;
mod light;
mod luminaire_reading;
mod map;
mod measure;
mod measured;
#[cfg_attr(not(unix), path = "system_memory.rs")]
mod memory;
mod mesh;
mod mesh_file;
mod nodes;
mod pass;
mod photometry;
mod picture;
mod pixels;
mod ray_caster;
mod render;
mod road;
mod sample;
mod scene;
mod settings;
mod spectral_picture;
mod spectrum;
mod sunlight;
mod table;
mod usd;
mod view;
mod view_out;
mod watched;

use pyo3::prelude::*;

/// Physically exact rendering on SIMD lanes.
#[pymodule]
mod _gonio {
    #[pymodule_export]
    use crate::annual::{AnnualReading, annual};
    #[pymodule_export]
    use crate::annual_glare::{AnnualGlareReading, annual_glare};
    #[pymodule_export]
    use crate::array::Array;
    #[pymodule_export]
    use crate::artist_sky::{artist_sky, sky_formula, sky_table};
    #[pymodule_export]
    use crate::daylight::{Daylight, daylight, read_weather};
    #[pymodule_export]
    use crate::dim::dim;
    #[pymodule_export]
    use crate::error::{_setting_error, Cancelled, Error, FormatError, SceneError, SettingError, UnsupportedError};
    #[pymodule_export]
    use crate::film::Film;
    #[pymodule_export]
    use crate::glare::{Coverage, Glare, GlareSource, glare};
    #[pymodule_export]
    use crate::goniometer::goniometer;
    #[pymodule_export]
    use crate::light::blackbody_rgb;
    #[pymodule_export]
    use crate::luminaire_reading::LuminaireReading;
    #[pymodule_export]
    use crate::map::{IlluminationMaps, SurfaceMap, illumination_map};
    #[pymodule_export]
    use crate::measure::{GridReading, Measurements, Reading, measure_scene};
    #[pymodule_export]
    use crate::measured::MeasuredBsdf;
    #[pymodule_export]
    use crate::nodes::compute;
    #[pymodule_export]
    use crate::pass::Pass;
    #[pymodule_export]
    use crate::photometry::{goniogram_figures, read_goniogram, ugr_table};
    #[pymodule_export]
    use crate::picture::{Picture, false_colour};
    #[pymodule_export]
    use crate::ray_caster::{RayCaster, RayHits};
    #[pymodule_export]
    use crate::render::{Progress, Render, Tile, merge};
    #[pymodule_export]
    use crate::road::road;
    #[pymodule_export]
    use crate::sample::{SampleReading, sample_bsdf};
    #[pymodule_export]
    use crate::scene::Scene;
    #[pymodule_export]
    use crate::spectral_picture::{SpectralPicture, spectral_picture};
    #[pymodule_export]
    use crate::spectrum::{colour_reflectance, glass, illuminant, metal, read_glass, read_metal, read_spectrum, spectrum_figures};
    #[pymodule_export]
    use crate::sunlight::sunlight;
    #[pymodule_export]
    use crate::usd::{_files_of_stage, _main, _scene, _view_scene, load_usd};
    #[pymodule_export]
    use crate::view_out::view_out;

    use pyo3::{prelude::*, types::PyDict};

    #[pymodule_init]
    fn init(module: &Bound<'_, PyModule>) -> PyResult<()> {
        // Numbers that each parameter of surfaces takes.
        let parameters = PyDict::new(module.py());
        for parameter in gonio::bsdf::parameter::NAMES {
            parameters.set_item(parameter.name, parameter.width())?;
        }
        module.add("surface_parameters", parameters)?;
        module.add("__version__", env!("CARGO_PKG_VERSION"))?;
        module.add("simd_level", gonio_simd::Execution::detect().name())
    }
}
