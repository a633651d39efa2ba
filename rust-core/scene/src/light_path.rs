//! Light path expressions: regular expressions over the events of a path from the camera to the light, as Open Shading Language has them.
//!
//! Light is summed by the kind of its first scattering, and by whether it comes straight from lights. An expression that asks for whole classes
//! of these can be shown, and costs a render nothing more; one that parts a class can not.

use super::ScatteringKind;

/// The light that an expression asks for.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum LightPath {
    /// Classes of light: bit 0 to 2 is direct light by the kind of its only scattering, 3 to 5 indirect light by the kind of the first, 6 what
    /// surfaces and lamps that the camera sees emit, 7 lights at infinity that it sees.
    Classes(u8),
    /// All light of a group.
    Group(String),
}

impl LightPath {
    /// Bits of all classes.
    pub const ALL: u8 = 255;
}

/// Bits of those that surfaces scatter.
const SCATTERED: u8 = 63;

/// Reads an expression; `None` where it is none, or parts a class of light. White space means nothing.
pub fn light_path(expression: &str) -> Option<LightPath> {
    let text: Vec<char> = expression.trim().trim_start_matches("lpe:").chars().filter(|c| !c.is_whitespace()).collect();
    let mut reader = Reader { text: &text, at: 0, labels: Vec::new() };
    let pattern = reader.alternatives()?;
    if reader.at < text.len() {
        return None;
    }
    let classes = classes(&pattern).filter(|classes| *classes != 0)?;
    match reader.labels.as_slice() {
        [] => Some(LightPath::Classes(classes)),
        // Groups are summed as a whole.
        [name] if classes & SCATTERED == SCATTERED => Some(LightPath::Group(name.clone())),
        _ => None,
    }
}

/// An event: where a path is, and how it scatters there.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Event(char, char);

const CAMERA: Event = Event('C', '.');
const LIGHT: Event = Event('L', '.');
const EMITTER: Event = Event('O', '.');
const BACKGROUND: Event = Event('B', '.');
const SCATTERINGS: [Event; 6] = [Event('R', 'D'), Event('R', 'G'), Event('R', 'S'), Event('T', 'D'), Event('T', 'G'), Event('T', 'S')];

/// A part of an expression.
#[derive(Clone, Debug)]
enum Pattern {
    /// One event of those listed, or none of them.
    Event(Vec<Event>, bool),
    Sequence(Vec<Pattern>),
    Either(Vec<Pattern>),
    /// So many times, at least and at most.
    Repeated(Box<Pattern>, usize, usize),
}

impl Pattern {
    /// Where a match may end that starts at one of some places; places are bits.
    fn ends(&self, path: &[Event], starts: u32) -> u32 {
        match self {
            Self::Event(events, wanted) => {
                let fits = |at: &usize| starts >> at & 1 == 1 && events.iter().any(|event| event.is(path[*at])) == *wanted;
                (0..path.len()).filter(fits).fold(0, |ends, at| ends | 2 << at)
            }
            Self::Sequence(parts) => parts.iter().fold(starts, |starts, part| part.ends(path, starts)),
            Self::Either(parts) => parts.iter().fold(0, |ends, part| ends | part.ends(path, starts)),
            Self::Repeated(part, least, most) => {
                let (mut ends, mut all) = (starts, if *least == 0 { starts } else { 0 });
                for times in 1..=(*most).min(path.len() + least) {
                    ends = part.ends(path, ends);
                    all |= if times >= *least { ends } else { 0 };
                }
                all
            }
        }
    }

    fn accepts(&self, path: &[Event]) -> bool {
        self.ends(path, 1) >> path.len() & 1 == 1
    }
}

impl Event {
    /// Whether an event of a pattern, in which dots stand for anything, is one of a path.
    fn is(self, event: Self) -> bool {
        [(self.0, event.0), (self.1, event.1)].iter().all(|(asked, found)| *asked == '.' || asked == found)
    }
}

/// The classes that a pattern asks for; `None` where it asks for parts of one.
fn classes(pattern: &Pattern) -> Option<u8> {
    let direct = |event: Event| pattern.accepts(&[CAMERA, event, LIGHT]);
    let mut classes = 0;
    for (kind, events) in kinds(|event| direct(event) || indirect(pattern, event) != Some(false)) {
        classes |= u8::from(events.iter().any(|event| direct(*event))) << kind as u8;
        let further = events.iter().map(|event| indirect(pattern, *event)).collect::<Option<Vec<bool>>>()?;
        classes |= u8::from(further.contains(&true)) << (3 + kind as u8);
    }
    let seen = |ends: [Event; 2]| ends.into_iter().any(|end| pattern.accepts(&[CAMERA, end]));
    Some(classes | u8::from(seen([EMITTER, LIGHT])) << 6 | u8::from(seen([BACKGROUND, LIGHT])) << 7)
}

/// The kinds of scattering with their events. Light that is scattered through surfaces diffusely is told from that of their front nowhere: it
/// is diffuse, unless it alone is asked for.
fn kinds(is_asked: impl Fn(Event) -> bool) -> [(ScatteringKind, Vec<Event>); 3] {
    let [diffuse, glossy, mirrored, through, refracted, clear] = SCATTERINGS;
    let only_through = is_asked(through) && !is_asked(diffuse);
    let mut transmitted = vec![refracted, clear];
    transmitted.extend(only_through.then_some(through));
    [
        (ScatteringKind::Diffuse, vec![diffuse]),
        (ScatteringKind::Glossy, vec![glossy, mirrored]),
        (ScatteringKind::Transmission, transmitted),
    ]
}

/// Whether a pattern asks for light that is scattered again after an event, whatever scatters it; `None` where that matters.
fn indirect(pattern: &Pattern, first: Event) -> Option<bool> {
    let mut found = None;
    let mut paths: Vec<Vec<Event>> = vec![vec![CAMERA, first]];
    // Patterns that count events beyond three further ones are taken to count no more.
    for _ in 0..3 {
        paths = paths.iter().flat_map(|path| SCATTERINGS.map(|event| [path.as_slice(), &[event]].concat())).collect();
        for path in &paths {
            let accepted = pattern.accepts(&[path.as_slice(), &[LIGHT]].concat());
            if found.is_some_and(|found| found != accepted) {
                return None;
            }
            found = Some(accepted);
        }
    }
    found
}

/// Reads an expression from the left.
struct Reader<'a> {
    text: &'a [char],
    at: usize,
    /// Labels of lights, each once.
    labels: Vec<String>,
}

impl Reader<'_> {
    fn peek(&self) -> Option<char> {
        self.text.get(self.at).copied()
    }

    fn skip(&mut self, wanted: char) -> bool {
        let is_there = self.peek() == Some(wanted);
        self.at += usize::from(is_there);
        is_there
    }

    fn alternatives(&mut self) -> Option<Pattern> {
        let mut parts = vec![self.sequence()?];
        while self.skip('|') {
            parts.push(self.sequence()?);
        }
        Some(Pattern::Either(parts))
    }

    fn sequence(&mut self) -> Option<Pattern> {
        let mut parts = Vec::new();
        while self.peek().is_some_and(|next| next != '|' && next != ')') {
            let part = self.one()?;
            parts.push(self.repeated(part)?);
        }
        Some(Pattern::Sequence(parts))
    }

    fn one(&mut self) -> Option<Pattern> {
        if self.skip('(') {
            let inside = self.alternatives()?;
            return self.skip(')').then_some(inside);
        }
        if !self.skip('[') {
            return Some(Pattern::Event(self.event()?, true));
        }
        let (wanted, mut events) = (!self.skip('^'), Vec::new());
        while !self.skip(']') {
            events.extend(self.event()?);
        }
        Some(Pattern::Event(events, wanted))
    }

    fn repeated(&mut self, part: Pattern) -> Option<Pattern> {
        let [least, most] = match self.peek() {
            Some('*') => [0, usize::MAX],
            Some('+') => [1, usize::MAX],
            Some('?') => [0, 1],
            Some('{') => return self.counted(part),
            _ => return Some(part),
        };
        self.at += 1;
        Some(Pattern::Repeated(Box::new(part), least, most))
    }

    fn counted(&mut self, part: Pattern) -> Option<Pattern> {
        self.skip('{');
        let least = self.number()?;
        let most = if self.skip(',') { if self.peek() == Some('}') { usize::MAX } else { self.number()? } } else { least };
        self.skip('}').then(|| Pattern::Repeated(Box::new(part), least, most))
    }

    fn number(&mut self) -> Option<usize> {
        let digits = self.text[self.at..].iter().take_while(|c| c.is_ascii_digit()).count();
        let text: String = self.text[self.at..self.at + digits].iter().collect();
        self.at += digits;
        text.parse().ok().filter(|number| *number <= 16)
    }

    /// One event: a letter, a dot, or type, mode and label in angle brackets.
    fn event(&mut self) -> Option<Vec<Event>> {
        if !self.skip('<') {
            let letter = self.peek()?;
            self.at += 1;
            return Some(vec![event_of(letter)?]);
        }
        let types = self.letters()?;
        let modes = if self.peek() == Some('>') { vec!['.'] } else { self.letters()? };
        if self.peek() == Some('\'') {
            let label = self.label()?;
            if types != ['L'] {
                return None;
            }
            if !self.labels.contains(&label) {
                self.labels.push(label);
            }
        }
        let events = types.iter().flat_map(|kind| modes.iter().map(|mode| Event(*kind, *mode)));
        let events = events.collect();
        self.skip('>').then_some(events)
    }

    /// A letter, or several in brackets.
    fn letters(&mut self) -> Option<Vec<char>> {
        let start = self.at;
        if !self.skip('[') {
            self.at += 1;
            return self.text.get(start).filter(|c| "CRTVLOBDGS.".contains(**c)).map(|letter| vec![*letter]);
        }
        while self.peek()? != ']' {
            self.at += 1;
        }
        self.at += 1;
        Some(self.text[start + 1..self.at - 1].to_vec())
    }

    fn label(&mut self) -> Option<String> {
        self.skip('\'');
        let length = self.text[self.at..].iter().position(|c| *c == '\'')?;
        let label = self.text[self.at..self.at + length].iter().collect();
        self.at += length + 1;
        Some(label)
    }
}

fn event_of(letter: char) -> Option<Event> {
    match letter {
        'C' | 'R' | 'T' | 'V' | 'L' | 'O' | 'B' | '.' => Some(Event(letter, '.')),
        'D' | 'G' | 'S' => Some(Event('.', letter)),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const DIFFUSE: u8 = 1;
    const GLOSSY: u8 = 2;
    const TRANSMITTED: u8 = 4;

    fn classes_of(expression: &str) -> u8 {
        match light_path(expression) {
            Some(LightPath::Classes(classes)) => classes,
            other => panic!("{expression}: {other:?}"),
        }
    }

    #[test]
    fn expressions_ask_for_classes_of_light() {
        for all in ["C.*", "C.*L", "C.*[LO]", "lpe:C.*", "C[LOB]|C.+[LO]"] {
            assert_eq!(classes_of(all) & SCATTERED, SCATTERED, "{all}");
        }
        assert_eq!(classes_of("C.*"), LightPath::ALL);
        assert_eq!(classes_of("C.+[LOB]"), SCATTERED);
        for (expression, classes) in [
            ("CO", 64),
            ("CB", 128),
            ("C[LO]", 192),
            ("C<RD>L", DIFFUSE),
            ("C<RD>[<L.>O]", DIFFUSE),
            ("C <RD> .+ L", DIFFUSE << 3),
            ("C<RD>.*[LO]", DIFFUSE | DIFFUSE << 3),
            ("C<RD>{1}.{0,}L", DIFFUSE | DIFFUSE << 3),
            ("C<RS>L", GLOSSY),
            ("C<R[SG]>.*L", GLOSSY | GLOSSY << 3),
            ("C<TS>[LO]", TRANSMITTED),
            ("C<TD>L", TRANSMITTED),
            ("CDL", DIFFUSE),
            ("C(<RD>|<RG>)L", DIFFUSE | GLOSSY),
            ("C<[RT]S>L", GLOSSY | TRANSMITTED),
            ("C[^<RD>]L", GLOSSY | TRANSMITTED),
        ] {
            assert_eq!(classes_of(expression), classes, "{expression}");
        }
    }

    #[test]
    fn lights_of_a_group_come_whole() {
        assert_eq!(light_path("C.*<L.'key'>"), Some(LightPath::Group("key".into())));
        assert_eq!(light_path("C.+<L.'key'>"), Some(LightPath::Group("key".into())));
        assert_eq!(light_path("C<RD><L.'key'>"), None);
        assert_eq!(light_path("C.*[<L.'key'><L.'fill'>]"), None);
    }

    #[test]
    fn parts_of_classes_and_what_is_no_expression_are_refused() {
        for other in [
            "C<RD><RD>L",
            "C<RD>",
            "",
            "CDDL",
            "C<RD>D*L",
            "C[",
            "C<RD",
            "C(L",
            "C<L.'key",
            "C.{9999}L",
            "Cx",
            "*",
            "C<RD'skin'>L",
            ")",
            "C{",
        ] {
            assert_eq!(light_path(other), None, "{other}");
        }
    }
}
