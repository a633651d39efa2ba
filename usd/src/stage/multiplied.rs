//! How many prims a text layer's references to itself multiply to: forty prims of which each holds two of the next are a million million, and the USD
//! library composes them before they can be counted.

use super::problem::format_error;
use gonio::Result;
use gonio::memory::free_memory;
use pyo3::prelude::*;
use std::collections::HashMap;
use std::path::Path;

/// Prims with references into their own layer from which on these are counted: fewer cannot multiply to much.
const LEAST_ARCS: usize = 20;
/// Bytes that a composed prim takes at least.
const BYTES: f64 = 500.0;
/// What refers to other prims, by the names of its metadata.
const ARCS: [&str; 4] = ["references", "payload", "inheritPaths", "specializes"];

/// Refuses a layer that composes to more prims than there is memory for.
pub(super) fn check(path: &Path, layer: &Bound<'_, PyAny>) -> PyResult<Result<()>> {
    let Ok(text) = std::fs::read_to_string(path) else { return Ok(Ok(())) };
    if !text.starts_with("#usda") || arcs(&text) < LEAST_ARCS {
        return Ok(Ok(()));
    }
    let count = composed(&prims(layer)?);
    let free = free_memory().map_or(f64::INFINITY, |bytes| bytes as f64);
    if count * BYTES > free {
        return Ok(Err(format_error(path, format!("its references to itself multiply to {count:.1e} prims, more than memory holds"))));
    }
    Ok(Ok(()))
}

/// How often a text may refer to its own prims.
fn arcs(text: &str) -> usize {
    let words = ["references", "payload", "inherits", "specializes"];
    let follows = |rest: &&str| rest.trim_start().strip_prefix('=').is_some_and(|rest| rest.trim_start().starts_with(['<', '[']));
    words.iter().flat_map(|word| text.split(word).skip(1)).filter(follows).count()
}

/// A prim of the layer, by numbers of others.
#[derive(Debug, Default)]
struct Spec {
    children: Vec<usize>,
    refers_to: Vec<usize>,
    /// Its prims are shared by all instances.
    instanceable: bool,
}

fn prims(layer: &Bound<'_, PyAny>) -> PyResult<Vec<Spec>> {
    let (mut specs, mut numbers, mut names): (Vec<Spec>, HashMap<String, usize>, Vec<Vec<String>>) = Default::default();
    let mut waiting: Vec<(Option<usize>, Bound<'_, PyAny>)> =
        layer.getattr("rootPrims")?.try_iter()?.map(|prim| Ok((None, prim?))).collect::<PyResult<_>>()?;
    while let Some((parent, prim)) = waiting.pop() {
        let number = specs.len();
        specs.push(Spec { instanceable: prim.getattr("instanceable")?.is_truthy()?, ..Spec::default() });
        if let Some(parent) = parent {
            specs[parent].children.push(number);
        }
        numbers.insert(prim.getattr("path")?.str()?.extract()?, number);
        names.push(targets(&prim)?);
        let children = prim.getattr("nameChildren")?.call_method0("values")?;
        waiting.extend(children.try_iter()?.map(|child| Ok((Some(number), child?))).collect::<PyResult<Vec<_>>>()?);
    }
    for (spec, names) in specs.iter_mut().zip(names) {
        spec.refers_to = names.iter().filter_map(|name| numbers.get(name).copied()).collect();
    }
    Ok(specs)
}

/// Paths of the same layer that a prim refers to.
fn targets(prim: &Bound<'_, PyAny>) -> PyResult<Vec<String>> {
    let mut found = Vec::new();
    for arc in ARCS {
        if !prim.call_method1("HasInfo", (arc,))?.is_truthy()? {
            continue;
        }
        for item in prim.call_method1("GetInfo", (arc,))?.call_method0("GetAddedOrExplicitItems")?.try_iter()? {
            let item = item?;
            match item.getattr("assetPath") {
                Ok(asset) if !asset.extract::<String>()?.is_empty() => {}
                Ok(_) => found.push(item.getattr("primPath")?.str()?.extract()?),
                Err(_) => found.push(item.str()?.extract()?),
            }
        }
    }
    Ok(found)
}

/// Prims of the whole layer once its references are followed; circles, which composing refuses, count once.
fn composed(specs: &[Spec]) -> f64 {
    let (mut below, mut begun) = (vec![None; specs.len()], vec![false; specs.len()]);
    let mut is_child = vec![false; specs.len()];
    specs.iter().flat_map(|spec| &spec.children).for_each(|child| is_child[*child] = true);
    for root in 0..specs.len() {
        let mut stack = vec![root];
        while let Some(&number) = stack.last() {
            let Spec { children, refers_to, instanceable } = &specs[number];
            let parts = || children.iter().chain(refers_to);
            if !begun[number] {
                begun[number] = true;
                stack.extend(parts().filter(|part| !begun[**part]));
                continue;
            }
            let held: f64 = children.iter().map(|child| 1.0 + below[*child].unwrap_or(0.0)).sum();
            let referred: f64 = refers_to.iter().map(|target| below[*target].unwrap_or(0.0)).sum();
            below[number].get_or_insert(if *instanceable { 0.0 } else { held + referred });
            stack.pop();
        }
    }
    below.iter().zip(is_child).filter(|(_, is_child)| !is_child).map(|(below, _)| 1.0 + below.unwrap_or(0.0)).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A chain: each prim holds two of the next.
    fn doubled(levels: usize) -> Vec<Spec> {
        let mut specs: Vec<Spec> = Vec::new();
        for level in 0..levels {
            let first = specs.len();
            specs.push(Spec { children: vec![first + 1, first + 2], ..Spec::default() });
            let next = if level + 1 < levels { vec![first + 3] } else { Vec::new() };
            specs.extend((0..2).map(|_| Spec { refers_to: next.clone(), ..Spec::default() }));
        }
        specs
    }

    #[test]
    fn what_refers_to_its_own_prims_is_counted() {
        assert_eq!(arcs("references = </A> payload=[</B>, @c.usd@] inherits =\n</K> references = @x.usda@ references"), 3);
    }

    #[test]
    fn references_multiply() {
        // A root with its 2 + 4 + … + 2^levels, for each root of the chain.
        let of = |levels: u32| (1..=levels).map(|levels| 2f64.powi(levels as i32 + 1) - 1.0).sum::<f64>();
        assert_eq!(composed(&doubled(1)), of(1));
        assert_eq!(composed(&doubled(5)), of(5));
        assert!((composed(&doubled(40)) / of(40) - 1.0).abs() < 1e-12);
    }

    #[test]
    fn circles_and_instances_do_not() {
        let mut specs = doubled(40);
        specs.iter_mut().for_each(|spec| spec.instanceable = !spec.refers_to.is_empty());
        assert_eq!(composed(&specs), 120.0);
        let circle = [Spec { refers_to: vec![1], ..Spec::default() }, Spec { refers_to: vec![0], ..Spec::default() }];
        assert_eq!(composed(&circle), 2.0);
        assert_eq!(composed(&[Spec { refers_to: vec![0], ..Spec::default() }]), 1.0);
    }
}
