//! Dynamic groups: which of their states is shown.

use super::node::Node;
use gonio_scene::{Error, Result};
use std::collections::BTreeMap;

/// The states that are asked for, and the groups that were met.
#[derive(Debug)]
pub(super) struct States<'a> {
    asked: &'a [(String, usize)],
    /// How many states each group has.
    met: BTreeMap<String, usize>,
}

impl<'a> States<'a> {
    pub(super) fn new(asked: &'a [(String, usize)]) -> Self {
        Self { asked, met: BTreeMap::new() }
    }

    /// The state of an object that is shown; `None` where it has none.
    pub(super) fn of<'n>(&mut self, node: &Node<'n>) -> Option<Node<'n>> {
        let states = super::radiance(node, "states")?;
        let group = super::radiance(node, "dynamic_group_identifier");
        let group = group.and_then(|group| group.value.as_str()).unwrap_or_else(|| node.identifier()).to_owned();
        let states: Vec<Node<'n>> = states.items().collect();
        let count = self.met.entry(group.clone()).or_default();
        *count = states.len().max(*count);
        let number = self.asked.iter().find(|(name, _)| *name == group).map_or(0, |(_, number)| *number);
        states.get(number).cloned()
    }

    /// Groups that are shown in their first state without anybody having said so.
    pub(super) fn told(&self) -> Vec<(usize, String)> {
        let is_asked = |group: &str| self.asked.iter().any(|(name, _)| name == group);
        let rest = self.met.iter().filter(|(group, count)| **count > 1 && !is_asked(group));
        rest.map(|(group, count)| (*count, group.clone())).collect()
    }

    /// # Errors
    /// A group or a state was asked for that there is not.
    pub(super) fn check(&self) -> Result<()> {
        for (group, number) in self.asked {
            match self.met.get(group) {
                Some(count) if number < count => {}
                Some(count) => {
                    let problem = format!("{group}={number} was found; the group's states are 0 to {}", count.saturating_sub(1));
                    return Err(Error::setting("state", problem));
                }
                None => {
                    let known: Vec<&str> = self.met.keys().map(String::as_str).collect();
                    let known = if known.is_empty() { "none".to_owned() } else { known.join(", ") };
                    return Err(Error::setting("state", format!("there is no dynamic group '{group}'; the model has {known}")));
                }
            }
        }
        Ok(())
    }
}
