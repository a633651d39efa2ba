//! Light path expressions: regular expressions over the events of a path from the camera to the light, as Open Shading Language has them.
//!
//! Light is summed by the kind of its first scattering, and by whether it comes straight from lights. An expression that asks for whole classes
//! of these costs a render nothing more. One that parts a class is followed along paths, by an automaton.

mod automaton;
mod pattern;

pub use automaton::{LightSource, MOST_EXPRESSIONS, MOST_STATES, PathAutomaton, SCATTERINGS, STEPS};

use pattern::Expression;

/// The light that an expression asks for.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum LightPath {
    /// Classes of light: bit 0 to 3 is direct light by the kind of its only scattering, 4 to 7 indirect light by the kind of the first, 8 what
    /// surfaces, media and lamps that the camera sees emit, 9 lights at infinity that it sees.
    Classes(u16),
    /// All light of a group.
    Group(String),
    /// Light whose path an automaton takes.
    Followed,
}

impl LightPath {
    /// Bits of all classes.
    pub const ALL: u16 = 1023;
}

/// Numbers of scatterings in [`SCATTERINGS`] by kind: diffuse, reflected off facets, refracted, in media. Light that is scattered through surfaces
/// diffusely counts as diffuse.
const KINDS: [[usize; 2]; 4] = [[0, 3], [1, 2], [4, 5], [6, 6]];

/// What light an expression asks for.
///
/// # Errors
/// What is wrong with it, or not supported.
pub fn light_path(expression: &str) -> Result<LightPath, String> {
    let parsed = Expression::parse(expression)?;
    let automaton = PathAutomaton::of(std::slice::from_ref(&parsed))?;
    if automaton.accepted.iter().all(|asked| *asked == 0) {
        return Err("no light comes on such paths; expressions end with the light, as C<RD>L".to_owned());
    }
    Ok(match (classes(&automaton, &parsed, 0), parsed.labels.as_slice()) {
        (Some(classes), []) => LightPath::Classes(classes),
        // Groups are summed as a whole.
        (Some(LightPath::ALL), [name]) if classes(&automaton, &parsed, 1) == Some(0) => LightPath::Group(name.clone()),
        _ => LightPath::Followed,
    })
}

/// The classes of light with a label that an automaton asks for; `None` where it asks for parts of one.
fn classes(automaton: &PathAutomaton, expression: &Expression, label: usize) -> Option<u16> {
    let asked = |state: usize, source: LightSource| {
        automaton.accepted[state * automaton.kinds() + source as usize * (automaton.labels.len() + 1) + label] == 1
    };
    // Whether light of any source is asked for, where all are treated alike.
    let alike = |state: usize| {
        let [first, rest @ ..] = LightSource::ALL.map(|source| asked(state, source));
        rest.iter().all(|other| *other == first).then_some(first)
    };
    let mut classes = 0;
    for (kind, events) in KINDS.into_iter().enumerate() {
        let [front, back] = events.map(|event| automaton.next[event] as usize);
        let of = |state: usize| Some([alike(state)?, further(automaton, state, alike)?]);
        let ([front, back], is_diffuse) = ([of(front)?, of(back)?], kind == 0);
        // What surfaces send through diffusely may be left out of a diffuse class, where it is seldom any; it cannot be shown alone.
        if front != back && !(is_diffuse && back == [false; 2]) {
            return None;
        }
        classes |= u16::from(front[0]) << kind | u16::from(front[1]) << (KINDS.len() + kind);
    }
    let [lamp, surface, infinite] = LightSource::ALL.map(|source| asked(0, source));
    let seen = if expression.names('O') { lamp || surface } else { lamp };
    Some(classes | u16::from(seen) << 8 | u16::from(infinite) << 9)
}

/// Whether light is asked for that is scattered again behind a state, whatever scatters it; `None` where that matters.
fn further(automaton: &PathAutomaton, state: usize, alike: impl Fn(usize) -> Option<bool>) -> Option<bool> {
    let behind = |state: usize| (0..SCATTERINGS.len()).map(move |event| automaton.next[state * STEPS + event] as usize);
    let (mut seen, mut waiting) = (vec![false; automaton.next.len() / STEPS], behind(state).collect::<Vec<_>>());
    let mut found = None;
    while let Some(state) = waiting.pop() {
        if std::mem::replace(&mut seen[state], true) {
            continue;
        }
        let asked = alike(state)?;
        if found.is_some_and(|found| found != asked) {
            return None;
        }
        found = Some(asked);
        waiting.extend(behind(state));
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    const DIFFUSE: u16 = 1;
    const GLOSSY: u16 = 2;
    const TRANSMITTED: u16 = 4;
    const VOLUME: u16 = 8;
    /// Bits of what surfaces and media scatter.
    const SCATTERED: u16 = 255;

    fn classes_of(expression: &str) -> u16 {
        match light_path(expression) {
            Ok(LightPath::Classes(classes)) => classes,
            other => panic!("{expression}: {other:?}"),
        }
    }

    #[test]
    fn expressions_ask_for_classes_of_light() {
        for all in ["C.*", "C.*L", "C.*[LO]", "lpe:C.*", "C.*[LOB]"] {
            assert_eq!(classes_of(all), LightPath::ALL, "{all}");
        }
        assert_eq!(classes_of("C.+[LOB]"), SCATTERED);
        for (expression, classes) in [
            ("CO", 256),
            ("CB", 512),
            ("C[LO]", 768),
            ("C<RD>L", DIFFUSE),
            ("C<RD>[<L.>O]", DIFFUSE),
            ("C <RD> .+ L", DIFFUSE << 4),
            ("C<RD>.*[LO]", DIFFUSE | DIFFUSE << 4),
            ("C<RD>{1}.{0,}L", DIFFUSE | DIFFUSE << 4),
            ("C<RS>L", GLOSSY),
            ("C<R[SG]>.*L", GLOSSY | GLOSSY << 4),
            ("C<TS>[LO]", TRANSMITTED),
            ("CVL", VOLUME),
            ("C<V.>.+L", VOLUME << 4),
            ("C[<RD>V].*L", DIFFUSE | VOLUME | DIFFUSE << 4 | VOLUME << 4),
            ("CDL", DIFFUSE),
            ("C(<RD>|<RG>)L", DIFFUSE | GLOSSY),
            ("C<[RT]S>L", GLOSSY | TRANSMITTED),
            ("C<TS>.{4,}L|C<TS>.{0,3}L", TRANSMITTED | TRANSMITTED << 4),
        ] {
            assert_eq!(classes_of(expression), classes, "{expression}");
        }
    }

    #[test]
    fn lights_of_a_group_come_whole_or_are_followed() {
        assert_eq!(light_path("C.*<L.'key'>"), Ok(LightPath::Group("key".into())));
        for other in ["C.+<L.'key'>", "C<RD><L.'key'>", "C.*[<L.'key'><L.'fill'>]", "C.*<L.[^'key']>", "C.*<O.'key'>"] {
            assert_eq!(light_path(other), Ok(LightPath::Followed), "{other}");
        }
    }

    #[test]
    fn parts_of_classes_are_followed() {
        let parts = [
            "C<RD><RD>L",
            "CDDL",
            "C<RD>D*L",
            "C<TD>L",
            "C[^<RD>]L",
            "C<RD>O",
            "C.*B",
            "C.+[LO]|CB",
            "CS*GL",
            "C.*<TS>L",
            "C.{4}L",
            "C.*V.*L",
        ];
        for other in parts {
            assert_eq!(light_path(other), Ok(LightPath::Followed), "{other}");
        }
    }

    #[test]
    fn what_is_no_expression_is_refused_by_name() {
        for (other, part) in [
            ("C<RD>", "no light"),
            ("", "no light"),
            ("C[", "ends"),
            ("C<RD", "ends"),
            ("C(L", "ends"),
            ("C<L.'key", "no end"),
            ("C.{9999}L", "up to 16"),
            ("Cx", "'x' was found at letter 2"),
            ("*", "'*'"),
            ("C<RD'skin'>L", "labels of surfaces"),
            (")", "')'"),
            ("C{", "in braces"),
            ("C<XD>L", "one of CRTVLOB."),
            ("shadow;C.*L", "'shadow;'"),
        ] {
            let problem = light_path(other).expect_err(other);
            assert!(problem.contains(part), "{other}: {problem}");
        }
    }
}
