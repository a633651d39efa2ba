//! Reading light path expressions (OSL Language Specification, "Light path expressions").

/// Longest expression that is read: nesting takes stack.
const MOST_LETTERS: usize = 512;
/// Highest count in braces.
const MOST_TIMES: usize = 16;

/// A part of an expression.
#[derive(Clone, Debug)]
pub(super) enum Pattern {
    /// One event of those listed, or none of them.
    Event(Vec<Event>, bool),
    Sequence(Vec<Pattern>),
    Either(Vec<Pattern>),
    /// So many times, at least and at most.
    Repeated(Box<Pattern>, usize, usize),
}

/// Events that an expression names: where a path is, how it scatters there, what the light is called. Dots stand for anything.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Event {
    pub(super) kind: char,
    pub(super) mode: char,
    /// Labels, and whether the light has one of them or none.
    pub(super) labels: Option<(Vec<String>, bool)>,
}

/// An expression.
#[derive(Clone, Debug)]
pub(super) struct Expression {
    pub(super) pattern: Pattern,
    /// Labels of lights, each once.
    pub(super) labels: Vec<String>,
    /// Letters that stand for something in it.
    letters: String,
}

impl Expression {
    /// Reads an expression; white space means nothing.
    ///
    /// # Errors
    /// What is wrong with it, or not supported.
    pub(super) fn parse(expression: &str) -> Result<Self, String> {
        let text = expression.trim().trim_start_matches("lpe:");
        if let Some((prefix, _)) = text.split_once(';') {
            return Err(format!("the prefix '{prefix};' is not supported"));
        }
        let text: Vec<char> = text.chars().filter(|c| !c.is_whitespace()).collect();
        if text.len() > MOST_LETTERS {
            return Err(format!("it has {} letters, expected {MOST_LETTERS} at most", text.len()));
        }
        let mut reader = Reader { text: &text, at: 0, labels: Vec::new(), letters: String::new() };
        let pattern = reader.alternatives()?;
        if reader.at < text.len() {
            return Err(reader.unexpected("an event"));
        }
        Ok(Self { pattern, labels: reader.labels, letters: reader.letters })
    }

    /// Whether it names something by this letter.
    pub(super) fn names(&self, letter: char) -> bool {
        self.letters.contains(letter)
    }
}

/// Reads an expression from the left.
struct Reader<'a> {
    text: &'a [char],
    at: usize,
    labels: Vec<String>,
    letters: String,
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

    fn expect(&mut self, wanted: char) -> Result<(), String> {
        if self.skip(wanted) { Ok(()) } else { Err(self.unexpected(&format!("'{wanted}'"))) }
    }

    fn unexpected(&self, expected: &str) -> String {
        match self.peek() {
            Some(found) => format!("'{found}' was found at letter {}, expected {expected}", self.at + 1),
            None => format!("it ends where {expected} was expected"),
        }
    }

    fn alternatives(&mut self) -> Result<Pattern, String> {
        let mut parts = vec![self.sequence()?];
        while self.skip('|') {
            parts.push(self.sequence()?);
        }
        Ok(Pattern::Either(parts))
    }

    fn sequence(&mut self) -> Result<Pattern, String> {
        let mut parts = Vec::new();
        while self.peek().is_some_and(|next| next != '|' && next != ')') {
            let part = self.one()?;
            parts.push(self.repeated(part)?);
        }
        Ok(Pattern::Sequence(parts))
    }

    fn one(&mut self) -> Result<Pattern, String> {
        if self.skip('(') {
            let inside = self.alternatives()?;
            self.expect(')')?;
            return Ok(inside);
        }
        if !self.skip('[') {
            return Ok(Pattern::Event(self.event()?, true));
        }
        let (wanted, mut events) = (!self.skip('^'), Vec::new());
        while !self.skip(']') {
            events.extend(self.event()?);
        }
        Ok(Pattern::Event(events, wanted))
    }

    fn repeated(&mut self, part: Pattern) -> Result<Pattern, String> {
        let [least, most] = match self.peek() {
            Some('*') => [0, usize::MAX],
            Some('+') => [1, usize::MAX],
            Some('?') => [0, 1],
            Some('{') => return self.counted(part),
            _ => return Ok(part),
        };
        self.at += 1;
        Ok(Pattern::Repeated(Box::new(part), least, most))
    }

    fn counted(&mut self, part: Pattern) -> Result<Pattern, String> {
        self.expect('{')?;
        let least = self.number()?;
        let most = match self.skip(',') {
            true if self.peek() == Some('}') => usize::MAX,
            true => self.number()?,
            false => least,
        };
        self.expect('}')?;
        Ok(Pattern::Repeated(Box::new(part), least, most))
    }

    fn number(&mut self) -> Result<usize, String> {
        let digits = self.text[self.at..].iter().take_while(|c| c.is_ascii_digit()).count();
        let text: String = self.text[self.at..self.at + digits].iter().collect();
        let number = text.parse().ok().filter(|number| *number <= MOST_TIMES);
        let number = number.ok_or_else(|| format!("'{text}' was found in braces, expected a number up to {MOST_TIMES}"))?;
        self.at += digits;
        Ok(number)
    }

    /// One event: a letter, a dot, or type, mode and label in angle brackets.
    fn event(&mut self) -> Result<Vec<Event>, String> {
        if !self.skip('<') {
            let letter = self.letter()?;
            let (kind, mode) = if "DGS".contains(letter) { ('.', letter) } else { (letter, '.') };
            return Ok(vec![Event { kind, mode, labels: None }]);
        }
        let kinds = self.letters("CRTVLOB.")?;
        let modes = if self.peek() == Some('>') { vec!['.'] } else { self.letters("DGS.")? };
        let labels = if self.peek() == Some('>') { None } else { Some(self.label_set()?) };
        self.expect('>')?;
        if labels.is_some() && kinds.iter().any(|kind| !"LOB".contains(*kind)) {
            return Err("labels of surfaces are not told apart; those of lights are their light groups, as in <L.'key'>".to_owned());
        }
        let event = |kind: char, mode: char| Event { kind, mode, labels: labels.clone() };
        Ok(kinds.iter().flat_map(|kind| modes.iter().map(move |mode| event(*kind, *mode)).collect::<Vec<_>>()).collect())
    }

    fn letter(&mut self) -> Result<char, String> {
        let found = self.peek().filter(|letter| "CRTVLOBDGS.".contains(*letter));
        let letter = found.ok_or_else(|| self.unexpected("an event"))?;
        self.at += 1;
        self.letters.push(letter);
        Ok(letter)
    }

    /// A letter of those allowed, or several in brackets.
    fn letters(&mut self, allowed: &str) -> Result<Vec<char>, String> {
        let several = self.skip('[');
        let mut letters = Vec::new();
        while letters.is_empty() || several && !self.skip(']') {
            if self.peek().is_some_and(|letter| !allowed.contains(letter)) {
                return Err(self.unexpected(&format!("one of {allowed}")));
            }
            letters.push(self.letter()?);
        }
        Ok(letters)
    }

    /// A label in quotes, or several in brackets, or all but those.
    fn label_set(&mut self) -> Result<(Vec<String>, bool), String> {
        let several = self.skip('[');
        let wanted = !(several && self.skip('^'));
        let mut labels = Vec::new();
        while labels.is_empty() || several && !self.skip(']') {
            labels.push(self.label()?);
        }
        Ok((labels, wanted))
    }

    fn label(&mut self) -> Result<String, String> {
        self.expect('\'')?;
        let length = self.text[self.at..].iter().position(|c| *c == '\'').ok_or("a label has no end")?;
        let label: String = self.text[self.at..self.at + length].iter().collect();
        self.at += length + 1;
        if !self.labels.contains(&label) {
            self.labels.push(label.clone());
        }
        Ok(label)
    }
}
