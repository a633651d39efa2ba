//! Camera rays of a tile: numbers, filter, lens and appending.

use crate::scenes::compiled;
use crate::{
    kernel::{Case, Kernel, Outcome},
    scenes,
};
use gonio::camera::sampler::Sampler;
use gonio::camera::sampler::{BATCH, Runs, TILE};
use gonio::compile::View;
use gonio::error::Result;
use gonio::scene::Settings;
use gonio::transport::{Paths, TileArea, generate};
use gonio_simd::{Execution, WavelengthColumn, dispatch};
use std::sync::atomic::AtomicBool;

struct Generation {
    view: View,
    sampler: Sampler,
    paths: Box<Paths>,
}

pub(super) fn cases(cancel: &AtomicBool) -> Result<Vec<Case>> {
    let case = |name: &str, lens_radius: f64| {
        let mut scene = scenes::room();
        scene.cameras[0].lens_radius = lens_radius;
        let settings = Settings { resolution: [TILE as u32; 2], ..Settings::default() };
        let view = View::new(&*compiled(&scene, cancel)?, &settings, Execution::best())?;
        let kernel = Generation { view, sampler: Sampler::new(0, [0, 0], settings.samples), paths: Box::default() };
        Ok(Case::new(name, "ray", BATCH, kernel))
    };
    Ok(vec![case("pinhole", 0.0)?, case("thin lens", 0.01)?])
}

impl Kernel for Generation {
    fn run(&mut self, execution: Execution) -> Result<()> {
        let Self { view, sampler, paths } = self;
        let area = TileArea { min: [0; 2], max: [TILE as u32; 2] };
        dispatch!(execution, l => generate(l, &view.camera, &view.placement, sampler, area, &Runs::whole(0), &[], WavelengthColumn::default(), paths));
        Ok(())
    }
    fn outcome(&self) -> Outcome {
        let count = self.paths.count;
        Outcome::of(self.paths.rays.direction.iter().chain(&self.paths.rays.origin).map(|column| &column[..count]))
    }
}
