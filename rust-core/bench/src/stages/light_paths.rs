//! Light paths: from the lights through the stages of camera paths until they end.

use crate::scenes::compiled;
use crate::{
    kernel::{Case, Kernel, Outcome},
    scenes,
};
use gonio::compile::{CompiledScene, View};
use gonio::error::Result;
use gonio::light::EmissionSampler;
use gonio::scene::{Scene, Settings};
use gonio::transport::{Arrivals, Arriving, Emission, Escapes, LIGHT_BATCH, LightTracer, Receiver, Transport, Wanted, Workspace};
use gonio_simd::Execution;
use std::sync::{Arc, atomic::AtomicBool};

struct LightPaths {
    scene: Arc<CompiledScene>,
    sampler: EmissionSampler,
    transport: Transport,
    workspace: Workspace,
    arrived: Arrived,
}

/// The flux that arrived, and how often.
#[derive(Default)]
struct Arrived {
    flux: f64,
    count: usize,
}

pub(super) fn cases(cancel: &AtomicBool) -> Result<Vec<Case>> {
    let case = |name: &str, scene: &Scene| {
        let scene = compiled(scene, cancel)?;
        let (centre, radius) = (scene.bounds.centre().map(|x| x as f32), scene.bounds.radius() as f32);
        let sampler = EmissionSampler::new(&scene.tables.lights, None, (centre, radius), &[]);
        let transport = View::new(&scene, &Settings::default(), Execution::best())?.transport;
        let kernel = LightPaths { scene, sampler, transport, workspace: Workspace::default(), arrived: Arrived::default() };
        Ok(Case::new(name, "path", LIGHT_BATCH, kernel))
    };
    Ok(vec![case("car", &scenes::car())?, case("glass", &scenes::glass())?, case("room", &scenes::room())?])
}

impl Kernel for LightPaths {
    fn run(&mut self, execution: Execution) -> Result<()> {
        self.arrived = Arrived::default();
        self.transport.execution = execution;
        let wanted = Wanted { arrivals: Arriving::All, specular_only: false, picture: None };
        let emission = Emission::Lights(&self.sampler);
        let tracer = LightTracer { tables: &self.scene.tables, transport: &self.transport, emission, wanted };
        tracer.trace(0, &mut self.arrived, &mut Vec::new(), &mut self.workspace, &|| false);
        Ok(())
    }

    fn outcome(&self) -> Outcome {
        // Levels part where rounding turns a choice.
        Outcome { value: self.arrived.flux, tolerance: 10.0 / (self.arrived.count as f64).sqrt() }
    }
}

impl Receiver for Arrived {
    fn arrived(&mut self, arrivals: &Arrivals) {
        self.count += arrivals.count;
        self.flux += arrivals.flux.iter().map(|column| column[..arrivals.count].iter().map(|x| f64::from(*x)).sum::<f64>()).sum::<f64>();
    }
    fn escaped(&mut self, _: &Escapes) {}
}
