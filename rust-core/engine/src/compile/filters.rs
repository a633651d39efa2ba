//! Filters before lights, in the rebased world.

use crate::error::Diagnostic;
use crate::light::{self, LightTexture};
use crate::scene::{Light, LightFilter, Slide, Transform};
use std::sync::Arc;

/// The most that a filter may multiply light by.
const MOST_FACTOR: f32 = 1e6;

/// The filters of a scene's lights.
#[derive(Clone, Debug, Default)]
pub(super) struct CompiledFilters {
    pub(super) gates: Vec<Vec<light::Filter>>,
    /// By record, the place of its filters counted from 1; 0 without any.
    pub(super) numbers: Vec<u32>,
    /// What they were made of.
    sources: Vec<(Vec<LightFilter>, [[f64; 3]; 4])>,
}

impl CompiledFilters {
    /// The records up to `end` that have no number yet are those of a light, which is placed so in the rebased world.
    pub(super) fn add(&mut self, light: &Light, placed: &Transform, end: usize, diagnostics: &mut Vec<Diagnostic>) {
        let mut number = 0;
        if !light.filters.is_empty() && !light.shape.is_at_infinity() {
            let gate: Vec<light::Filter> = light.filters.iter().filter_map(|filter| compiled(filter, placed)).collect();
            if gate.len() < light.filters.len() {
                diagnostics.push(Diagnostic::warning(&light.origin, "a filter before the light is flat or not of numbers; it is left out"));
            }
            let beyond = |filter: &LightFilter| filter.factor.iter().any(|x| !(0.0..=MOST_FACTOR).contains(x));
            if let Some(filter) = light.filters.iter().find(|filter| beyond(filter)) {
                let problem = format!("a filter's factor is {:?}, outside 0 to {MOST_FACTOR}; it is held there", filter.factor);
                diagnostics.push(Diagnostic::warning(&light.origin, problem));
            }
            self.gates.push(gate);
            self.sources.push((light.filters.clone(), placed.columns));
            number = self.gates.len() as u32;
        }
        self.numbers.resize(end, number);
    }

    /// Whether nothing differs.
    pub(super) fn is_of_same(&self, other: &Self) -> bool {
        let used = |filters: &Self| filters.numbers.iter().rposition(|number| *number != 0).map_or(0, |last| last + 1);
        self.sources == other.sources && self.numbers[..used(self)] == other.numbers[..used(other)]
    }
}

fn compiled(filter: &LightFilter, placed: &Transform) -> Option<light::Filter> {
    let from_world = placed.after(&filter.to_light).inverse().filter(|map| map.is_finite())?;
    let numbers = filter.missed.iter().chain(&filter.factor).chain([&filter.density]);
    if numbers.into_iter().any(|x| !x.is_finite()) {
        return None;
    }
    let slide = match &filter.slide {
        Slide::Opening { low, high, radius, edge } => light::Slide::Opening { low: *low, high: *high, radius: *radius, edge: *edge },
        Slide::Picture { width, height, rgb, size, fill, repeats, to_texture } => light::Slide::Picture {
            image: Arc::new(LightTexture { width: *width as usize, height: *height as usize, rgb: rgb.to_vec() }),
            size: *size,
            fill: *fill,
            repeats: *repeats,
            to_texture: *to_texture,
        },
    };
    Some(light::Filter {
        from_world: std::array::from_fn(|row| std::array::from_fn(|column| from_world.columns[column][row] as f32)),
        slide,
        missed: filter.missed.map(|x| x.clamp(0.0, MOST_FACTOR)),
        inverted: filter.inverted,
        factor: filter.factor.map(|x| x.clamp(0.0, MOST_FACTOR)),
        density: filter.density.clamp(0.0, 1.0),
    })
}
