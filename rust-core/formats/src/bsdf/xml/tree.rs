//! The braces of a tensor tree.

use super::super::text::{Words, shown};
use super::super::tree::{DEEPEST, Tree};
use crate::error::{FormatError, Result};

/// A branch whose children are being read.
struct Open {
    /// The first child's number.
    first: usize,
    /// How many children have begun.
    begun: usize,
}

/// Reads a tree: a branch is `{` 2^rank trees `}`, a leaf `{` the values of a grid with a power of two along each dimension `}`.
pub(super) fn parse(mut words: Words<'_>, rank: u32) -> Result<Tree> {
    let children = 1_usize << rank;
    let mut tree = Tree { rank, first: vec![0], log2: vec![0], values: Vec::new() };
    let mut open: Vec<Open> = Vec::new();
    let mut node = 0;
    loop {
        brace(&mut words, "{")?;
        if words.is_next('{') {
            if open.len() == DEEPEST {
                return Err(FormatError::line(words.line(), format!("a tree deeper than {DEEPEST} branches")));
            }
            let first = tree.first.len();
            (tree.first[node], tree.log2[node]) = (index(first, &words)?, -1);
            tree.first.resize(first + children, 0);
            tree.log2.resize(first + children, 0);
            open.push(Open { first, begun: 1 });
            node = first;
            continue;
        }
        (tree.first[node], tree.log2[node]) = leaf(&mut words, &mut tree.values, rank)?;
        brace(&mut words, "}")?;
        // Close every branch that this was the last child of.
        while open.last().is_some_and(|branch| branch.begun == children) {
            brace(&mut words, "}")?;
            open.pop();
        }
        let Some(branch) = open.last_mut() else { break };
        node = branch.first + branch.begun;
        branch.begun += 1;
    }
    match words.word() {
        Some(extra) => Err(FormatError::line(words.line(), format!("\"{}\" after the tree", shown(extra)))),
        None => Ok(tree),
    }
}

/// The values of a leaf: where they begin, and the binary logarithm of the grid's size.
fn leaf(words: &mut Words<'_>, values: &mut Vec<f32>, rank: u32) -> Result<(u32, i8)> {
    let first = values.len();
    while !words.is_next('}') {
        let value = words.number("a value or a brace")? as f32;
        if !value.is_finite() {
            return Err(FormatError::line(words.line(), format!("value {value}, expected a finite one")));
        }
        values.push(value.max(0.0));
    }
    let count = values.len() - first;
    let log2 = count.checked_ilog2().filter(|log2| count.is_power_of_two() && log2 % rank == 0);
    match log2 {
        Some(log2) => Ok((index(first, words)?, (log2 / rank) as i8)),
        None => Err(FormatError::line(words.line(), format!("{count} values in a leaf, expected a power of {}", 1 << rank))),
    }
}

fn index(i: usize, words: &Words<'_>) -> Result<u32> {
    u32::try_from(i).map_err(|_| FormatError::line(words.line(), "the tree is too large"))
}

fn brace(words: &mut Words<'_>, expected: &str) -> Result<()> {
    match words.word() {
        Some(word) if word == expected => Ok(()),
        Some(word) => Err(FormatError::line(words.line(), format!("\"{}\", expected {expected} of a tensor tree", shown(word)))),
        None => Err(FormatError::line(words.line(), format!("the text ends, expected {expected} of a tensor tree"))),
    }
}
