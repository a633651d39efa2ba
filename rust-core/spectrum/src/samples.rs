//! Samples of surfaces, as an observer sees them under a light.

use crate::{source::Node, table::Table};

/// What an observer gets of a light's power at each point of its sums: of the light itself, and of it as samples reflect it.
#[derive(Debug)]
pub(crate) struct Samples {
    white: Vec<[f64; 3]>,
    reflected: Vec<Vec<[f64; 3]>>,
}

/// Tristimulus values of a light and of samples under it, in any unit.
#[derive(Debug)]
pub(crate) struct Seen {
    pub(crate) white: [f64; 3],
    pub(crate) samples: Vec<[f64; 3]>,
}

impl Samples {
    /// The first `count` samples of a table of reflectances at the points of some sums.
    pub(crate) fn new(nodes: &[Node], observer: impl Fn(f64) -> [f64; 3], table: &Table, count: usize) -> Self {
        let white: Vec<[f64; 3]> = nodes.iter().map(|node| observer(node.nm)).collect();
        let of_sample = |sample: usize| {
            let at = |(node, observed): (&Node, &[f64; 3])| observed.map(|part| part * table.at(sample, node.nm));
            nodes.iter().zip(&white).map(at).collect()
        };
        let reflected = (0..count).map(of_sample).collect();
        Self { white, reflected }
    }

    /// Under a light whose sums have the same points.
    pub(crate) fn under(&self, nodes: &[Node]) -> Seen {
        let power: Vec<f64> = nodes.iter().map(|node| node.width * node.power).collect();
        let sum = |responses: &Vec<[f64; 3]>| {
            let mut sum = [0.0; 3];
            for (power, response) in power.iter().zip(responses) {
                sum.iter_mut().zip(response).for_each(|(sum, response)| *sum += power * response);
            }
            sum
        };
        Seen { white: sum(&self.white), samples: self.reflected.iter().map(sum).collect() }
    }
}
