//! Light path expressions that are followed along paths: their automaton as tables, and what each light counts as.

use super::compiled::CompiledScene;
use crate::{
    error::{Error, Result},
    geometry::NONE,
    scene::{Aov, LightSource, MOST_STATES, PathAutomaton, STEPS, Settings},
    transport::{KIND_BITS, PathExpressions},
};
use std::sync::Arc;

const _: () = assert!(STEPS == 8 && MOST_STATES == 256);

/// The expressions that passes show, in the passes' order; `None` where none is followed.
pub(super) fn passes(scene: &CompiledScene, settings: &Settings) -> Result<Option<Arc<PathExpressions>>> {
    let mut numbers: Vec<u16> = Vec::new();
    for aov in &settings.aovs {
        if let Aov::LightExpression(number) = aov
            && !numbers.contains(number)
        {
            numbers.push(*number);
        }
    }
    if numbers.is_empty() {
        return Ok(None);
    }
    let text = |number: &u16| settings.light_paths.get(usize::from(*number)).map_or("", String::as_str);
    let expressions: Vec<&str> = numbers.iter().map(text).collect();
    let refused = |problem: String| Error::setting("light path expressions", problem);
    let automaton = PathAutomaton::new(&expressions).map_err(refused)?;
    if automaton.kinds() > 1 << KIND_BITS {
        return Err(refused(format!("{} light groups were found, expected fewer", automaton.labels.len())));
    }
    Ok(Some(Arc::new(tables(scene, &automaton, expressions.len()))))
}

fn tables(scene: &CompiledScene, automaton: &PathAutomaton, count: usize) -> PathExpressions {
    let (tables, kinds) = (&scene.tables, automaton.kinds());
    let groups = &tables.groups;
    let kind = |source: LightSource, group: u32| automaton.kind(source, groups.names.get(group as usize).map_or("", String::as_str)) as u32;
    // Triangles that shine come last.
    let first_triangle = tables.triangle_lights.iter().filter(|first| **first != NONE).min().copied().unwrap_or(u32::MAX);
    let infinite: Vec<u32> = tables.lights.infinite_lights().collect();
    let source = |light: u32| match light {
        _ if infinite.contains(&light) => LightSource::Infinite,
        _ if light >= first_triangle => LightSource::Surface,
        _ => LightSource::Lamp,
    };
    let of_light = groups.of_light.iter().enumerate().map(|(light, group)| kind(source(light as u32), *group)).collect();
    let mut accepted = vec![0; (automaton.accepted.len() / kinds) << KIND_BITS];
    for (state, asked) in accepted.chunks_exact_mut(1 << KIND_BITS).zip(automaton.accepted.chunks_exact(kinds)) {
        state[..kinds].copy_from_slice(asked);
    }
    PathExpressions {
        next: automaton.next.clone(),
        accepted,
        of_light,
        of_set: groups.of_set.iter().map(|group| kind(LightSource::Surface, *group)).collect(),
        infinite: automaton.labels.is_empty().then(|| kind(LightSource::Infinite, u32::MAX)),
        count,
    }
}
