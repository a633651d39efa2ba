//! Light path expressions as one deterministic automaton: renderers take a step a scattering, and look up which expressions ask for light.

use super::pattern::{Event, Expression, Pattern};
use std::collections::BTreeMap;

/// Scatterings that paths tell apart: reflected and transmitted, each diffuse, glossy and sharp, and in media.
pub const SCATTERINGS: [(char, char); 7] = [('R', 'D'), ('R', 'G'), ('R', 'S'), ('T', 'D'), ('T', 'G'), ('T', 'S'), ('V', 'V')];
/// Entries of a state in [`PathAutomaton::next`], so that shifts find them.
pub const STEPS: usize = 8;
/// Most states of all expressions together.
pub const MOST_STATES: usize = 256;
/// Most expressions.
pub const MOST_EXPRESSIONS: usize = 32;
/// Most parts of expressions, with repetitions written out.
const MOST_PARTS: usize = 8192;

/// What light comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LightSource {
    /// A lamp.
    Lamp,
    /// A surface that emits.
    Surface,
    /// A light at infinity.
    Infinite,
}

impl LightSource {
    /// All of them, in the order of their numbers.
    pub const ALL: [Self; 3] = [Self::Lamp, Self::Surface, Self::Infinite];
}

/// The automaton of some expressions. It starts behind the camera, in state 0.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct PathAutomaton {
    /// By state and scattering, the state behind; [`STEPS`] entries a state.
    pub next: Vec<u32>,
    /// By state and kind of light, the expressions that ask for light that is found there, as bits.
    pub accepted: Vec<u32>,
    /// Labels of lights that are told apart; all others are one more.
    pub labels: Vec<String>,
}

/// An event of a path.
#[derive(Clone, Copy, Debug)]
struct Symbol<'a> {
    kind: char,
    mode: char,
    label: Option<&'a str>,
}

/// A step of the automaton that is not yet deterministic.
#[derive(Clone, Debug)]
enum Step {
    /// One of these events, or none of them.
    Event(Vec<Event>, bool),
    Split(usize, usize),
    Jump(usize),
    /// The end of an expression.
    End(usize),
}

impl PathAutomaton {
    /// The automaton of some expressions.
    ///
    /// # Errors
    /// An expression is wrong, or all together are too much.
    pub fn new(expressions: &[&str]) -> Result<Self, String> {
        let parsed = expressions.iter().map(|text| Expression::parse(text)).collect::<Result<Vec<_>, _>>()?;
        Self::of(&parsed)
    }

    /// Kinds of light: sources times labels.
    pub fn kinds(&self) -> usize {
        LightSource::ALL.len() * (self.labels.len() + 1)
    }

    /// The number of a kind of light, by the name of its group.
    pub fn kind(&self, source: LightSource, group: &str) -> usize {
        let label = self.labels.iter().position(|label| label == group).unwrap_or(self.labels.len());
        source as usize * (self.labels.len() + 1) + label
    }

    pub(super) fn of(expressions: &[Expression]) -> Result<Self, String> {
        if expressions.len() > MOST_EXPRESSIONS {
            return Err(format!("{} expressions were found, expected {MOST_EXPRESSIONS} at most", expressions.len()));
        }
        let mut labels: Vec<String> = expressions.iter().flat_map(|expression| expression.labels.iter().cloned()).collect();
        labels.sort();
        labels.dedup();
        let steps = steps(expressions)?;
        let starts: Vec<usize> = (0..expressions.len()).collect();
        let start = after(&steps, &closure(&steps, &starts), Symbol { kind: 'C', mode: '.', label: None });
        let mut automaton = Self { next: Vec::new(), accepted: Vec::new(), labels };
        let mut numbers = BTreeMap::from([(start.clone(), 0_u32)]);
        let mut states = vec![start];
        let mut at = 0;
        while at < states.len() {
            let state = states[at].clone();
            let mut next = [0; STEPS];
            for (place, (kind, mode)) in next.iter_mut().zip(SCATTERINGS) {
                let behind = after(&steps, &state, Symbol { kind, mode, label: None });
                let fresh = states.len() as u32;
                *place = *numbers.entry(behind.clone()).or_insert(fresh);
                if *place == fresh {
                    states.push(behind);
                }
            }
            if states.len() > MOST_STATES {
                return Err(format!("the expressions together count more than {MOST_STATES} cases"));
            }
            automaton.next.extend(next);
            let kinds = automaton.accepted_in(expressions, &steps, &state);
            automaton.accepted.extend(kinds);
            at += 1;
        }
        Ok(automaton)
    }

    /// By kind of light, the expressions that end with it.
    fn accepted_in(&self, expressions: &[Expression], steps: &[Step], state: &[usize]) -> Vec<u32> {
        let labels = || self.labels.iter().map(|label| Some(label.as_str())).chain([None]);
        // L stands for all light where an expression does not say O for what surfaces emit, or B for what is at infinity.
        let without = |letter: char| (0..expressions.len()).filter(|at| !expressions[*at].names(letter)).fold(0, |bits, at| bits | 1 << at);
        LightSource::ALL
            .into_iter()
            .flat_map(|source| {
                labels().map(move |label| {
                    let ends = |kind: char| ended(steps, &after(steps, state, Symbol { kind, mode: '.', label }));
                    match source {
                        LightSource::Lamp => ends('L'),
                        LightSource::Surface => ends('O') | ends('L') & without('O'),
                        LightSource::Infinite => ends('B') | ends('L') & without('B'),
                    }
                })
            })
            .collect()
    }
}

/// All expressions as steps; the first so many are where they start.
fn steps(expressions: &[Expression]) -> Result<Vec<Step>, String> {
    let mut steps: Vec<Step> = expressions.iter().map(|_| Step::Jump(0)).collect();
    for (number, expression) in expressions.iter().enumerate() {
        steps[number] = Step::Jump(steps.len());
        let facets = [expression.names('G'), expression.names('S')] != [true; 2];
        write(&expression.pattern, facets, &mut steps)?;
        steps.push(Step::End(number));
    }
    Ok(steps)
}

/// Appends the steps of a pattern, behind which the next one stands. Where G and S mean the same, `facets` says so.
fn write(pattern: &Pattern, facets: bool, steps: &mut Vec<Step>) -> Result<(), String> {
    if steps.len() > MOST_PARTS {
        return Err(format!("it has more than {MOST_PARTS} parts"));
    }
    match pattern {
        Pattern::Event(events, wanted) => {
            let mut events = events.clone();
            for event in events.iter_mut().filter(|event| facets && "GS".contains(event.mode)) {
                event.mode = FACETS;
            }
            steps.push(Step::Event(events, *wanted));
        }
        Pattern::Sequence(parts) => parts.iter().try_for_each(|part| write(part, facets, steps))?,
        Pattern::Either(parts) => {
            let mut ends = Vec::new();
            for (number, part) in parts.iter().enumerate() {
                let split = steps.len();
                if number + 1 < parts.len() {
                    steps.push(Step::Split(split + 1, 0));
                }
                write(part, facets, steps)?;
                if number + 1 < parts.len() {
                    ends.push(steps.len());
                    steps.push(Step::Jump(0));
                    steps[split] = Step::Split(split + 1, steps.len());
                }
            }
            for end in ends {
                steps[end] = Step::Jump(steps.len());
            }
        }
        Pattern::Repeated(part, least, most) => {
            (0..*least).try_for_each(|_| write(part, facets, steps))?;
            if *most == usize::MAX {
                let split = steps.len();
                steps.push(Step::Jump(0));
                write(part, facets, steps)?;
                steps.push(Step::Jump(split));
                steps[split] = Step::Split(split + 1, steps.len());
            } else {
                let mut splits = Vec::new();
                for _ in *least..*most {
                    splits.push(steps.len());
                    steps.push(Step::Jump(0));
                    write(part, facets, steps)?;
                }
                for split in splits {
                    steps[split] = Step::Split(split + 1, steps.len());
                }
            }
        }
    }
    Ok(())
}

/// The mode of what facets scatter, glossy or sharp.
const FACETS: char = 'F';

impl Event {
    /// Whether an event of a path is one of these.
    fn is(&self, symbol: Symbol<'_>) -> bool {
        let mode = match self.mode {
            '.' => true,
            FACETS => "GS".contains(symbol.mode),
            mode => mode == symbol.mode,
        };
        let label = self.labels.as_ref().is_none_or(|(labels, wanted)| {
            let named = symbol.label.is_some_and(|label| labels.iter().any(|known| known == label));
            named == *wanted
        });
        (self.kind == '.' || self.kind == symbol.kind) && mode && label
    }
}

/// The steps that wait for an event or end, from some steps on; sorted.
fn closure(steps: &[Step], from: &[usize]) -> Vec<usize> {
    let (mut seen, mut waiting, mut found) = (vec![false; steps.len()], from.to_vec(), Vec::new());
    while let Some(at) = waiting.pop() {
        if std::mem::replace(&mut seen[at], true) {
            continue;
        }
        match &steps[at] {
            Step::Split(one, other) => waiting.extend([*one, *other]),
            Step::Jump(to) => waiting.push(*to),
            Step::Event(..) | Step::End(_) => found.push(at),
        }
    }
    found.sort_unstable();
    found
}

/// Where an event leads from a state.
fn after(steps: &[Step], state: &[usize], symbol: Symbol<'_>) -> Vec<usize> {
    let goes = |at: &&usize| match &steps[**at] {
        Step::Event(events, wanted) => events.iter().any(|event| event.is(symbol)) == *wanted,
        _ => false,
    };
    let next: Vec<usize> = state.iter().filter(goes).map(|at| at + 1).collect();
    closure(steps, &next)
}

/// The expressions that end in a state, as bits.
fn ended(steps: &[Step], state: &[usize]) -> u32 {
    state.iter().fold(0, |bits, at| if let Step::End(number) = steps[*at] { bits | 1 << number } else { bits })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Whether the only expression asks for light of a path, written as `RD TS`, of a source and a group.
    fn asks(expression: &str, path: &str, source: LightSource, group: &str) -> bool {
        let automaton = PathAutomaton::new(&[expression]).expect("an expression");
        let state = path.split_whitespace().fold(0, |state, event| {
            let at = SCATTERINGS.iter().position(|(kind, mode)| event == format!("{kind}{mode}")).expect("an event");
            automaton.next[state * STEPS + at] as usize
        });
        automaton.accepted[state * automaton.kinds() + automaton.kind(source, group)] == 1
    }

    #[test]
    fn expressions_take_paths_as_osl_does() {
        use LightSource::{Infinite, Lamp, Surface};
        for (expression, path, source, asked) in [
            ("C<RD>L", "RD", Lamp, true),
            ("C<RD>L", "RD", Infinite, true),
            ("C<RD>L", "TD", Lamp, false),
            ("C<RD>L", "RD RD", Lamp, false),
            ("CD+L", "RD TD RD", Lamp, true),
            ("CD+L", "RD RG", Lamp, false),
            ("C<RD><RD>L", "RD RD", Surface, true),
            ("C[DS]*<TS>.*L", "RD TS RD", Lamp, true),
            ("C[DS]*<TS>.*L", "RD RD", Lamp, false),
            ("CS*DL", "RG RS RD", Lamp, true),
            ("CS*GDL", "RS RG RD", Lamp, true),
            ("CS*GDL", "RG RG RD", Lamp, false),
            ("C<R[GS]>L", "RS", Lamp, true),
            ("C<RG>L", "RS", Lamp, true),
            ("C<RG>L|C<TS>S", "RS", Lamp, false),
            ("C.{2}L", "RD RG", Lamp, true),
            ("C.{2}L", "RD RG TS", Lamp, false),
            ("C.{1,2}L", "RD", Lamp, true),
            ("C.{2,}L", "RD RD RD RD", Lamp, true),
            ("C(<RD>|<TS>D)*L", "RD TS RD RD", Lamp, true),
            ("C(<RD>|<TS>D)*L", "RD TS", Lamp, false),
            ("C.*O", "RD", Surface, true),
            ("C.*O", "RD", Lamp, false),
            ("C.*[LO]", "RD", Infinite, true),
            ("C.*[LOB]", "RD", Infinite, true),
            ("C<RD>[LO]|C<RG>B", "RD", Infinite, false),
            ("C[^<RD>]+L", "RG TD", Lamp, true),
            ("C[^<RD>]+L", "RG RD", Lamp, false),
            ("C.*B", "RD", Infinite, true),
            ("C.*B", "", Surface, false),
            ("C.?L", "", Lamp, true),
        ] {
            assert_eq!(asks(expression, path, source, ""), asked, "{expression}: {path} {source:?}");
        }
    }

    #[test]
    fn labels_are_groups_of_lights() {
        use LightSource::{Lamp, Surface};
        for (expression, group, asked) in [
            ("C<RG>[^L]*<L.'key'>", "key", true),
            ("C<RG>[^L]*<L.'key'>", "fill", false),
            ("C<RG>[^L]*<L.'key'>", "", false),
            ("C.*<L.['key''fill']>", "fill", true),
            ("C.*<L.[^'key']>", "fill", true),
            ("C.*<L.[^'key']>", "", true),
            ("C.*<L.[^'key']>", "key", false),
        ] {
            assert_eq!(asks(expression, "RG RD", Lamp, group), asked, "{expression}: {group}");
        }
        assert!(asks("C.*<O.'sign'>", "RD", Surface, "sign") && !asks("C.*<O.'sign'>", "RD", Lamp, "sign"));
    }

    #[test]
    fn several_expressions_are_told_apart_by_bits() {
        let automaton = PathAutomaton::new(&["C<RD>L", "C<RD>.*L", "C.*L"]).expect("three");
        let behind = automaton.next[0] as usize;
        let at = |state: usize| automaton.accepted[state * automaton.kinds()];
        assert_eq!([at(0), at(behind), at(automaton.next[behind * STEPS] as usize)], [4, 7, 6]);
    }

    #[test]
    fn too_much_is_refused() {
        assert!(PathAutomaton::new(&["C.*D.{12}L"]).expect_err("2^12 cases").contains("cases"));
        assert!(PathAutomaton::new(&["C(((.{16}){16}){16}){16}L"]).expect_err("too many parts").contains("parts"));
        assert!(PathAutomaton::new(&["C.*L"; 33]).expect_err("too many").contains("33"));
        assert!(PathAutomaton::new(&[&"(".repeat(10_000)]).is_err());
    }
}
