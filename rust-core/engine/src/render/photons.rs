//! The photon maps of a render: one for each block of samples, shared by all tiles, with radii that shrink from block to block.
//!
//! The estimate is that of stochastic progressive photon mapping (Hachisuka and Jensen 2009; Knaus and Zwicker 2011): its error from the radius
//! goes to zero as samples grow.

use super::{covered::Ground, light_paths::LightPaths, seen};
use crate::{
    compile::{CompiledScene, View},
    transport::{
        ArrivalCells, Arrivals, Arriving, Bright, Emission, Escapes, LIGHT_BATCH, LightTracer, Photon, Photons, Receiver, Transport,
        Wanted, Workspace,
    },
};
use gonio_simd::Column;
use std::{
    collections::BTreeMap,
    sync::{Arc, Mutex, OnceLock, PoisonError},
};

/// Batches of light paths that a map takes for each sample of its block, and most of them.
const BATCHES_PER_SAMPLE: u64 = 16;
const MOST_BATCHES: u64 = 128;
/// Maps that are kept: tiles are never further apart than that.
const KEPT: usize = 3;
/// The first radius in pixels, as the nearest thing that casts caustics is seen.
const PIXELS: f64 = 3.0;
/// Part of its square that the radius keeps as blocks go on (alpha of Knaus and Zwicker).
const KEEPS: f64 = 2.0 / 3.0;
/// Numbers of batches that no splats use.
const OTHER_BATCHES: u64 = 1 << 63;

/// A map, made by the first who wants it.
type Slot = Arc<OnceLock<Option<Arc<Photons>>>>;

/// The maps of a render.
#[derive(Debug)]
pub(super) struct PhotonMaps {
    /// Of the first block, metres.
    radius: f64,
    /// That as many pixels as light paths of a sample spread over, m²; where no camera sees any, no place is bright.
    seen: Option<f64>,
    /// Number of the render among those that are to be independent of each other.
    round: u32,
    maps: Mutex<BTreeMap<u32, Slot>>,
}

impl PhotonMaps {
    /// Those of a view, or of what is seen by no camera.
    pub(super) fn new(scene: &CompiledScene, view: Option<&View>, round: u32) -> Self {
        let room = scene.bounds.radius().max(f64::MIN_POSITIVE);
        let pixel = |target: &([f32; 3], f32)| view.and_then(|view| view.camera.pixel_width(target.0)).map(f64::from);
        let pixel = scene.casters.targets.iter().filter_map(pixel).fold(f64::INFINITY, f64::min);
        let radius = if pixel.is_finite() { pixel * PIXELS } else { room * 2e-3 };
        let radius = radius.clamp(room * 1e-4, room * 1e-2);
        Self { radius, seen: view.map(|view| seen::area(scene, view, surfaces(room))), round, maps: Mutex::default() }
    }

    /// The photons of a block with so many samples; none where making them was cancelled.
    pub(super) fn of_block(
        &self,
        (block, samples): (u32, u32),
        scene: &CompiledScene,
        transport: &Transport,
        light_paths: &LightPaths,
        workspace: &mut Workspace,
        cancelled: &dyn Fn() -> bool,
    ) -> Option<Arc<Photons>> {
        let slot = {
            let mut maps = self.maps.lock().unwrap_or_else(PoisonError::into_inner);
            let slot = maps.entry(block).or_default().clone();
            while maps.len() > KEPT {
                maps.pop_first();
            }
            slot
        };
        let make = || {
            let batches = (u64::from(samples) * BATCHES_PER_SAMPLE).min(MOST_BATCHES);
            let none = || ArrivalCells::new(scene.bounds.radius());
            let ground = Ground::new(&scene.tables, transport.execution);
            let mut arrived = Arrived { photons: Vec::new(), direct: none(), caustic: none(), ground, triangles: Default::default() };
            let wanted = Wanted { arrivals: Arriving::Photons, specular_only: true, picture: None };
            let tracer = LightTracer { tables: &scene.tables, transport, emission: Emission::Lights(light_paths.sampler()), wanted };
            for batch in 0..batches {
                if cancelled() {
                    return None;
                }
                let number = OTHER_BATCHES | u64::from(self.round) << 56 | u64::from(block) << 32 | batch;
                tracer.trace(number, &mut arrived, &mut Vec::new(), workspace, cancelled);
            }
            let shrinks = f64::from(self.round + block + 1).powf(0.5 * (KEEPS - 1.0));
            let share = 1.0 / (batches * LIGHT_BATCH as u64) as f64;
            let bright = self.seen.map_or_else(Bright::default, |seen| {
                let [direct, caustic] = [&arrived.direct, &arrived.caustic].map(|cells| cells.bright_places(share, seen));
                Bright { direct, caustic }
            });
            let area = surfaces(scene.bounds.radius());
            let numbers = [self.radius * shrinks, shrinks, share, area];
            let covered = |photons: &[Photon], radius: f32| arrived.ground.covered(photons, radius);
            Some(Arc::new(Photons::new(&arrived.photons, bright, numbers, covered)))
        };
        slot.get_or_init(make).clone()
    }
}

/// About the area of the surfaces of a scene of some radius: that of its sphere, m².
fn surfaces(radius: f64) -> f64 {
    4.0 * std::f64::consts::PI * radius.powi(2)
}

/// Keeps what arrives: photons after a scattering, and how much comes where straight from lights and by mirrors and smooth glass.
struct Arrived<'a> {
    photons: Vec<Photon>,
    direct: ArrivalCells,
    caustic: ArrivalCells,
    ground: Ground<'a>,
    /// Of the bounce under way.
    triangles: [Column; 4],
}

impl Receiver for Arrived<'_> {
    fn arrived(&mut self, arrivals: &Arrivals) {
        if (0..arrivals.count).any(|entry| arrivals.bounces(entry) > 0) {
            let room = gonio_simd::padded(arrivals.count);
            if self.triangles[0].len() < room {
                self.triangles = std::array::from_fn(|_| Column::new(room));
            }
            self.ground.triangles(arrivals, &mut self.triangles);
        }
        for entry in 0..arrivals.count {
            let position = [0, 1, 2].map(|axis| arrivals.position[axis][entry]);
            let flux = [0, 1, 2].map(|axis| arrivals.flux[axis][entry]);
            let mean = flux.map(f64::from).iter().sum::<f64>() / 3.0;
            if arrivals.bounces(entry) == 0 {
                self.direct.add(position, mean);
                continue;
            }
            self.caustic.add(position, mean);
            self.ground.note(arrivals, entry);
            let direction = [0, 1, 2].map(|axis| arrivals.direction[axis][entry]);
            let [normal @ .., inside] = [0, 1, 2, 3].map(|column| self.triangles[column][entry]);
            self.photons.push(Photon { position, direction, normal, inside, flux, light: arrivals.light[entry] });
        }
    }
    fn escaped(&mut self, _: &Escapes) {}
}
