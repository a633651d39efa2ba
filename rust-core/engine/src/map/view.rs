//! A finished map as a camera sees it: one set of first hits, and values looked up where they are.

use super::{
    gather::{Chart, IlluminationMaps, SurfaceMap},
    side::{PartColour, SideMap},
    smooth::{Facet, Smooth},
    within_errors::{Seen, smoothed},
};
use crate::{
    accel::NONE,
    camera::{CameraTable, Lens, sampler::BATCH},
    compile::{CompiledScene, View},
    error::{Error, Result},
    geometry::GeometryTable,
    scene::{Antialiasing, Measurand, Settings},
    threads::in_pool,
    transport::{Start, Tracer, Workspace},
};
use gonio_simd::Execution;
use rayon::prelude::*;

/// What is shown.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Quantity {
    /// All light.
    #[default]
    Illuminance,
    /// What came straight from lights.
    Direct,
    /// What surfaces have scattered.
    Indirect,
    /// The standard error of all light.
    StandardError,
    /// A figure of the light's colour, one of [`PartColour::FIGURES`](super::PartColour::FIGURES).
    Figure(Measurand),
    /// Its standard error.
    ErrorOf(Measurand),
}

impl Quantity {
    /// By name: illuminance, direct, indirect, error, or that of a figure of colour.
    ///
    /// # Errors
    /// Other names, with those that there are.
    pub fn by_name(name: &str) -> Result<Self> {
        match name {
            "illuminance" => Ok(Self::Illuminance),
            "direct" => Ok(Self::Direct),
            "indirect" => Ok(Self::Indirect),
            "error" => Ok(Self::StandardError),
            _ => {
                let figures = PartColour::FIGURES.map(Measurand::name).join(", ");
                let problem =
                    || format!("'{name}' was found, expected illuminance, direct, indirect, error or a figure of colour: {figures}");
                let found = Measurand::by_name(name).filter(|measurand| PartColour::FIGURES.contains(measurand));
                found.map(Self::Figure).ok_or_else(|| Error::setting("quantity", problem()))
            }
        }
    }

    /// Whether it is of the colour of light and not of how much there is.
    pub fn is_of_colour(self) -> bool {
        matches!(self, Self::Figure(measurand) if measurand.is_of_colour())
    }

    /// The sign of its unit.
    pub fn unit(self) -> &'static str {
        match self {
            Self::Figure(measurand) | Self::ErrorOf(measurand) => measurand.unit(),
            _ => "lx",
        }
    }

    /// Its standard error, which has none of its own.
    fn error(self) -> Option<Self> {
        match self {
            Self::Illuminance | Self::Direct | Self::Indirect => Some(Self::StandardError),
            Self::Figure(measurand) => Some(Self::ErrorOf(measurand)),
            Self::StandardError | Self::ErrorOf(_) => None,
        }
    }
}

/// How a map is looked at.
#[derive(Clone, Copy, Debug)]
pub struct Looks {
    /// Looks along a pixel's side.
    pub side: u32,
    /// Whether differences that the values' standard errors explain are smoothed away.
    pub smooth: bool,
}

/// Lux by pixel of the settings' window, rows from the top; not a number where no map is seen.
///
/// # Errors
/// Settings and cameras that make no view.
pub fn view(
    maps: &IlluminationMaps,
    scene: &CompiledScene,
    settings: &Settings,
    quantity: Quantity,
    looks: Looks,
    execution: Execution,
) -> Result<(Vec<f32>, [usize; 2])> {
    let settings = Settings { antialiasing: Antialiasing::Sampled, aovs: Vec::new(), shader_passes: Vec::new(), ..settings.clone() };
    let View { camera, placement, transport, window, .. } = View::new(scene, &settings, execution)?;
    let tracer = Tracer { tables: &scene.tables, start: Start::Camera(&camera, &placement), transport };
    let size = [0, 1].map(|axis| (window.max[axis] - window.min[axis]) as usize);
    let smooth = maps.surfaces.iter().map(|map| smooth(map, &scene.tables.geometry, quantity)).collect();
    let looking = Looking {
        maps,
        smooth,
        tracer: &tracer,
        camera: &camera,
        min: window.min,
        width: size[0],
        quantity,
        side: looks.side.clamp(1, MOST_SIDE),
    };
    let mut seen = vec![Seen::NOTHING; size[0] * size[1]];
    let pixels = BATCH / (looking.side * looking.side) as usize;
    let values = in_pool(|| {
        let chunks = seen.par_chunks_mut(pixels).enumerate();
        chunks.for_each_init(|| scene.workspaces.take(), |workspace, (number, seen)| looking.look(number * pixels, seen, workspace));
        let smooths = looks.smooth && quantity.error().is_some();
        if smooths { smoothed(&seen, size[0]) } else { seen.iter().map(|pixel| pixel.value).collect() }
    });
    Ok((values, size))
}

/// Looks along a pixel's side, at most: those of a pixel fit into a batch.
const MOST_SIDE: u32 = 16;

struct Looking<'a> {
    maps: &'a IlluminationMaps,
    /// Both sides of each surface that is divided by triangles.
    smooth: Vec<[Option<Smooth<'a>>; 2]>,
    tracer: &'a Tracer<'a>,
    camera: &'a CameraTable,
    min: [u32; 2],
    width: usize,
    quantity: Quantity,
    side: u32,
}

impl Looking<'_> {
    /// Fills some pixels in a row.
    fn look(&self, first: usize, seen: &mut [Seen], workspace: &mut Workspace) {
        let rays = (self.side * self.side) as usize;
        let (mut places, mut slots) = ([Vec::new(), Vec::new()], Vec::new());
        for pixel in 0..seen.len() {
            let corner = [(first + pixel) % self.width, (first + pixel) / self.width];
            for ray in 0..rays as u32 {
                let part = [ray % self.side, ray / self.side];
                for (axis, places) in places.iter_mut().enumerate() {
                    places.push((self.min[axis] + corner[axis] as u32) as f32 + (part[axis] as f32 + 0.5) / self.side as f32);
                }
                slots.push((pixel * rays) as u32 + ray);
            }
        }
        self.tracer.first_hits_at([&places[0], &places[1]], &slots, workspace);
        let mut counts = vec![0u32; seen.len()];
        let (slots, hits) = workspace.hits_by_slot();
        for (ray, slot) in slots.enumerate() {
            let instance = hits.instance[ray];
            if instance == NONE {
                continue;
            }
            let Some(surface) = self.maps.of_instance.get(instance as usize).map(|number| *number as usize) else { continue };
            let Some(map) = self.maps.surfaces.get(surface) else { continue };
            let place = [hits.u[ray], hits.v[ray]];
            let (back, normal) = self.facing(instance, hits.primitive[ray], place);
            let side = usize::from(back);
            let value = match &self.smooth[surface][side] {
                Some(smooth) => smooth.at(hits.primitive[ray], place),
                None => map.at(side, hits.primitive[ray], place, self.quantity),
            };
            let error = self.quantity.error().map_or(0.0, |error| map.at(side, hits.primitive[ray], place, error));
            let pixel = slot as usize / rays;
            if value.is_finite() {
                counts[pixel] += 1;
                let part = 1.0 / counts[pixel] as f32;
                let found = &mut seen[pixel];
                // The first look says which surface it is.
                let before = if part < 1.0 { *found } else { Seen { value, standard_error: error, surface: 2 * surface + side, normal } };
                *found = Seen {
                    value: before.value + (value - before.value) * part,
                    standard_error: before.standard_error + (error - before.standard_error) * part,
                    ..before
                };
            }
        }
    }

    /// Whether the camera sees a triangle's back at a place, and its unit normal.
    fn facing(&self, instance: u32, primitive: u32, place: [f32; 2]) -> (bool, [f32; 3]) {
        let (position, normal) = point(&self.tracer.tables.geometry, instance, primitive, place);
        let direction = match self.camera.lens {
            Lens::Orthographic => self.camera.axes[2].map(|x| -x),
            _ => [0, 1, 2].map(|k| position[k] - self.camera.position[k]),
        };
        let length = normal.iter().map(|x| x * x).sum::<f32>().sqrt().max(f32::MIN_POSITIVE);
        ((0..3).map(|k| normal[k] * direction[k]).sum::<f32>() > 0.0, normal.map(|x| x / length))
    }
}

/// Both sides of a surface that is divided by triangles, made smooth.
fn smooth<'a>(map: &'a SurfaceMap, geometry: &GeometryTable, quantity: Quantity) -> [Option<Smooth<'a>>; 2] {
    let Chart::Cells(chart) = &map.chart else { return [None, None] };
    let first = geometry.instances[map.surface.instance as usize].first_triangle as usize;
    let facet = |(triangle, area): (usize, &f64)| {
        let (_, normal) = point(geometry, map.surface.instance, triangle as u32, [1.0 / 3.0; 2]);
        let length = normal.iter().map(|x| x * x).sum::<f32>().sqrt();
        let at = 3 * (first + triangle);
        let points = [geometry.corners[at], geometry.corners[at + 1], geometry.corners[at + 2]];
        (*area > 0.0).then(|| Facet { points, normal: normal.map(|x| x / length) })
    };
    let facets: Vec<Option<Facet>> = map.surface.areas.iter().enumerate().map(facet).collect();
    [0, 1].map(|side| {
        let side = map.sides[side].as_ref()?;
        Some(Smooth::new(chart, &side.level, &facets, |cell| side.value(cell, quantity)))
    })
}

/// Position and normal (not unit) at a place of a triangle, rebased world space.
fn point(geometry: &GeometryTable, instance: u32, primitive: u32, [u, v]: [f32; 2]) -> ([f32; 3], [f32; 3]) {
    let row = &geometry.instances[instance as usize];
    let map = &geometry.instance_transform[instance as usize * 12..instance as usize * 12 + 12];
    let vector = |p: [f32; 3]| [0, 1, 2].map(|k| map[k] * p[0] + map[3 + k] * p[1] + map[6 + k] * p[2]);
    let corner = |number: usize| {
        let point = geometry.corners[(row.first_triangle + primitive) as usize * 3 + number] as usize * 3;
        vector([geometry.points[point], geometry.points[point + 1], geometry.points[point + 2]])
    };
    let [a, b, c] = [corner(0), corner(1), corner(2)];
    let cross = |u: [f32; 3], v: [f32; 3]| [0, 1, 2].map(|k| u[(k + 1) % 3] * v[(k + 2) % 3] - u[(k + 2) % 3] * v[(k + 1) % 3]);
    let edge = |end: [f32; 3]| [0, 1, 2].map(|k| end[k] - a[k]);
    let column = |number: usize| [map[3 * number], map[3 * number + 1], map[3 * number + 2]];
    let turned = cross(column(0), column(1));
    // A mirroring map turns the winding round.
    let sign = (0..3).map(|k| turned[k] * column(2)[k]).sum::<f32>().signum();
    let position = [0, 1, 2].map(|k| a[k] * (1.0 - u - v) + b[k] * u + c[k] * v + map[9 + k]);
    (position, cross(edge(b), edge(c)).map(|x| x * sign))
}

impl SurfaceMap {
    /// The value at barycentric coordinates of corners 1 and 2, between texels by their distances; 0 where nothing arrived.
    pub fn at(&self, side: usize, triangle: u32, place: [f32; 2], quantity: Quantity) -> f32 {
        let Some(map) = self.sides.get(side).and_then(Option::as_ref) else { return 0.0 };
        let value = |cell: usize| map.value(cell, quantity);
        match &self.chart {
            Chart::Cells(chart) => value(chart.cell(triangle, place)),
            Chart::Texels(chart) => between(chart.coordinates(triangle, place), chart.size(), value),
        }
    }
}

impl SideMap {
    /// The value of a cell; not a number where it has no area.
    pub(super) fn value(&self, cell: usize, quantity: Quantity) -> f32 {
        match quantity {
            Quantity::Illuminance => self.illuminance[cell],
            Quantity::Direct => self.direct[cell],
            Quantity::Indirect => self.illuminance[cell] - self.direct[cell],
            Quantity::StandardError => self.standard_error[cell],
            Quantity::Figure(figure) => self.figures.get(cell).map_or(f32::NAN, |colour| colour.of(figure)[0]),
            Quantity::ErrorOf(figure) => self.figures.get(cell).map_or(f32::NAN, |colour| colour.of(figure)[1]),
        }
    }
}

/// A value between the middles of texels, by those of the four that have one.
fn between([u, v]: [f32; 2], [width, height]: [u32; 2], value: impl Fn(usize) -> f32) -> f32 {
    let place = [u * width as f32 - 0.5, (1.0 - v) * height as f32 - 0.5];
    let part = place.map(|x| x - x.floor());
    let (mut sum, mut weights) = (0.0, 0.0);
    for (y, across) in [(0, 1.0 - part[1]), (1, part[1])] {
        for (x, along) in [(0, 1.0 - part[0]), (1, part[0])] {
            let wrapped = |at: f32, step: i64, side: u32| (at.floor() as i64 + step).rem_euclid(i64::from(side)) as usize;
            let found = value(wrapped(place[1], y, height) * width as usize + wrapped(place[0], x, width));
            if found.is_finite() {
                sum += found * along * across;
                weights += along * across;
            }
        }
    }
    if weights > 0.0 { sum / weights } else { f32::NAN }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_between_texels_leave_out_what_has_none() {
        let values = [1.0, 3.0, f32::NAN, 7.0];
        let at = |u, v| between([u, v], [2, 2], |texel| values[texel]);
        assert_eq!(at(0.25, 0.75), 1.0);
        assert_eq!(at(0.5, 0.75), 2.0);
        assert!((at(0.5, 0.5) - 11.0 / 3.0).abs() < 1e-6);
    }
}
