//! Light and shadow linking: UsdLux's collections `lightLink` and `shadowLink`, asked once a light, and what of the stage they name.
//!
//! A collection's membership query is a map from paths to expansion rules. The maps of all lights are turned into one, from paths to lights, so that
//! a shape asks the prims above it and not every light.

use super::Placement;
use crate::context::Context;
use crate::light::is_link_authored;
use crate::model::{Element, Group, Kind, Model};
use crate::prim::Prim;
use crate::pxr::Module;
use gonio::scene::{Link, Linking};
use pyo3::{intern, prelude::*};
use std::collections::{BTreeMap, HashMap};

/// What a collection says of a path and what is below.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
enum Rule {
    /// The path and all below are in it.
    Expand,
    /// The path alone is in it.
    Explicit,
    /// Neither is in it.
    Exclude,
}

/// A collection, by its rules; those of many lights may be the same.
#[derive(Debug)]
struct Collection<'py> {
    /// Whether the stage's root is in it.
    is_whole: bool,
    /// The query itself, where it goes by an expression and not by rules.
    query: Option<Bound<'py, PyAny>>,
}

/// The numbers of a light's collections of receivers and of blockers; none where they hold all.
pub(super) type Collections = [Option<u32>; 2];

/// The collections of all lights of a stage.
#[derive(Debug, Default)]
pub(super) struct LinkTable<'py> {
    collections: Vec<Collection<'py>>,
    by_rules: HashMap<Vec<(String, Rule)>, u32>,
    by_path: HashMap<String, Vec<(u32, Rule)>>,
    of_light: HashMap<String, Collections>,
}

impl<'py> LinkTable<'py> {
    /// Those of the lights of a world.
    pub(super) fn new(context: &mut Context<'_, 'py>, world: &Model, placement: &Placement) -> Self {
        let mut table = Self::default();
        table.collect(context, world, placement);
        table
    }

    fn collect(&mut self, context: &mut Context<'_, 'py>, model: &Model, placement: &Placement) {
        for element in &model.elements {
            match &element.kind {
                Kind::Group(group) => self.collect(context, &group.model, &placement.inside(element, group)),
                Kind::Light => self.add_light(context, &placement.path(&element.path)),
                Kind::Shape(shape) if shape.is_light => self.add_light(context, &placement.path(&element.path)),
                _ => {}
            }
        }
    }

    fn add_light(&mut self, context: &mut Context<'_, 'py>, path: &str) {
        if self.of_light.contains_key(path) {
            return;
        }
        let Some(prim) = context.prim_at(path) else { return };
        let mut own = [None; 2];
        let kinds = [("lightLink", "GetLightLinkCollectionAPI"), ("shadowLink", "GetShadowLinkCollectionAPI")];
        for (number, (name, getter)) in own.iter_mut().zip(kinds) {
            if is_link_authored(&prim, name) {
                for rule in ["includes", "excludes"] {
                    context.targets(&prim, &format!("collection:{name}:{rule}"));
                }
                let read = self.collection(&prim, getter);
                *number = context.attempt_at(&prim, "the collection of its links cannot be read", read).flatten();
            }
        }
        if own != [None; 2] {
            self.of_light.insert(path.to_owned(), own);
        }
    }

    /// The number of a collection; none where it holds all.
    fn collection(&mut self, prim: &Prim<'py>, getter: &str) -> PyResult<Option<u32>> {
        let py = prim.py();
        let api = Module::UsdLux.item(py, "LightAPI")?.call1((prim.object(),))?.call_method0(getter)?;
        let query = api.call_method0(intern!(py, "ComputeMembershipQuery"))?;
        let uses_rules = query.call_method0(intern!(py, "UsesPathExpansionRuleMap")).and_then(|uses| uses.is_truthy()).unwrap_or(true);
        let rules = if uses_rules { rules(&query)? } else { BTreeMap::new() };
        let is_whole = rules.get("/") == Some(&Rule::Expand);
        if is_whole && rules.len() == 1 {
            return Ok(None);
        }
        let key: Vec<(String, Rule)> = rules.into_iter().collect();
        if let (true, Some(known)) = (uses_rules, self.by_rules.get(&key)) {
            return Ok(Some(*known));
        }
        let number = self.collections.len() as u32;
        for (path, rule) in &key {
            self.by_path.entry(path.clone()).or_default().push((number, *rule));
        }
        if uses_rules {
            self.by_rules.insert(key, number);
        }
        self.collections.push(Collection { is_whole, query: (!uses_rules).then_some(query) });
        Ok(Some(number))
    }

    /// Whether nothing is linked.
    pub(super) fn is_empty(&self) -> bool {
        self.collections.is_empty()
    }

    /// The collections of a light.
    pub(super) fn of_light(&self, path: &str) -> Collections {
        self.of_light.get(path).copied().unwrap_or_default()
    }

    /// The collections that hold a path and not the root, or the root and not the path.
    pub(super) fn naming(&self, path: &str) -> Vec<u32> {
        let mut decided: HashMap<u32, bool> = HashMap::new();
        let mut above = path;
        loop {
            for (collection, rule) in self.by_path.get(above).into_iter().flatten() {
                match rule {
                    Rule::Explicit if above != path => {}
                    rule => {
                        decided.entry(*collection).or_insert(*rule != Rule::Exclude);
                    }
                }
            }
            if above == "/" {
                break;
            }
            above = match above.rfind('/') {
                Some(0) | None => "/",
                Some(end) => &above[..end],
            };
        }
        for (number, collection) in (0..).zip(&self.collections) {
            if let Some(query) = &collection.query {
                let holds = query.call_method1(intern!(query.py(), "IsPathIncluded"), (path,)).and_then(|holds| holds.is_truthy());
                decided.insert(number, holds.unwrap_or(true));
            }
        }
        let differs = |(number, holds): (u32, bool)| (holds != self.collections[number as usize].is_whole).then_some(number);
        let mut naming: Vec<u32> = decided.into_iter().filter_map(differs).collect();
        naming.sort_unstable();
        naming
    }

    /// A light's links to sets of instances, each of which stands for shapes that the same collections name.
    pub(super) fn linking(&self, collections: Collections, naming: &[Vec<u32>]) -> Linking {
        let link = |number: Option<u32>| {
            let Some(number) = number else { return Link::All };
            let named = |(set, naming): (u32, &Vec<u32>)| naming.binary_search(&number).is_ok().then_some(set);
            let sets: Vec<u32> = (0..).zip(naming).filter_map(named).collect();
            match self.collections[number as usize].is_whole {
                true if sets.is_empty() => Link::All,
                true => Link::Except(sets),
                false => Link::Only(sets),
            }
        };
        let [receivers, blockers] = collections;
        Linking { receivers: link(receivers), blockers: link(blockers) }
    }
}

/// The rules of a query, by path.
fn rules(query: &Bound<'_, PyAny>) -> PyResult<BTreeMap<String, Rule>> {
    let py = query.py();
    let map = query.call_method0(intern!(py, "GetAsPathExpansionRuleMap"))?;
    let mut rules = BTreeMap::new();
    for item in map.call_method0(intern!(py, "items"))?.try_iter()? {
        let (path, rule): (Bound<'_, PyAny>, String) = item?.extract()?;
        let rule = match rule.as_str() {
            "exclude" => Rule::Exclude,
            "explicitOnly" => Rule::Explicit,
            _ => Rule::Expand,
        };
        rules.insert(path.getattr(intern!(py, "pathString")).and_then(|text| text.extract()).or_else(|_| path.str()?.extract())?, rule);
    }
    Ok(rules)
}

/// The path that stands for what a point instancer draws of prototypes that are not its own: that of the instancer.
pub(super) fn stand_in(placement: &Placement, element: &Element, group: &Group) -> Option<String> {
    let is_foreign = group.instance.is_none() && !group.model.root.starts_with(&format!("{}/", element.path));
    placement.stand_in.clone().or_else(|| is_foreign.then(|| placement.path(&element.path)))
}
