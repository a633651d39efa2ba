//! Words of a scene file, and the objects that they make.

/// Types of surfaces.
pub(super) const SURFACES: [&str; 11] =
    ["polygon", "sphere", "bubble", "cylinder", "tube", "cone", "cup", "ring", "source", "instance", "mesh"];
/// Types of materials.
pub(super) const MATERIALS: [&str; 29] = [
    "plastic",
    "metal",
    "trans",
    "plastic2",
    "metal2",
    "trans2",
    "glass",
    "dielectric",
    "interface",
    "mirror",
    "light",
    "glow",
    "illum",
    "spotlight",
    "BSDF",
    "aBSDF",
    "antimatter",
    "mist",
    "prism1",
    "prism2",
    "BRTDfunc",
    "plasfunc",
    "metfunc",
    "transfunc",
    "plasdata",
    "metdata",
    "transdata",
    "ashik2",
    "WGMDfunc",
];
/// Types of patterns, textures and mixtures.
pub(super) const PATTERNS: [&str; 18] = [
    "brightfunc",
    "brightdata",
    "brighttext",
    "colorfunc",
    "colordata",
    "colorpict",
    "colortext",
    "specfile",
    "specdata",
    "specfunc",
    "specpict",
    "spectrum",
    "texfunc",
    "texdata",
    "mixfunc",
    "mixdata",
    "mixpict",
    "mixtext",
];

/// A word; a whole line where that is a command or a comment.
#[derive(Clone, Copy, Debug)]
pub(super) struct Token<'a> {
    pub(super) text: &'a str,
    /// From 1.
    pub(super) line: usize,
    /// Whether it is the first of its line.
    pub(super) first: bool,
}

/// A word and its number, or what was expected there.
type Word<'a> = Result<(Token<'a>, usize), (String, usize)>;

/// A primitive.
#[derive(Debug)]
pub(super) struct Object<'a> {
    pub(super) modifier: &'a str,
    pub(super) kind: &'a str,
    pub(super) name: &'a str,
    pub(super) strings: Vec<&'a str>,
    pub(super) numbers: Vec<f64>,
    pub(super) line: usize,
}

/// The words of a text. Commands run on where a line ends in a backslash.
pub(super) fn tokens(text: &str) -> Vec<Token<'_>> {
    let (mut found, mut at, mut line) = (Vec::new(), 0, 1);
    while at < text.len() {
        let rest = &text[at..];
        let mut end = rest.find('\n').unwrap_or(rest.len());
        let start = rest[..end].trim_start();
        let mut lines = 1;
        if start.starts_with('!') {
            while rest[..end].trim_end().ends_with('\\') && end < rest.len() {
                end = rest[end + 1..].find('\n').map_or(rest.len(), |next| end + 1 + next);
                lines += 1;
            }
            found.push(Token { text: rest[..end].trim(), line, first: true });
        } else if start.starts_with('#') {
            found.push(Token { text: start.trim_end(), line, first: true });
        } else {
            let words = rest[..end].split_whitespace().take_while(|word| !word.starts_with('#'));
            found.extend(words.enumerate().map(|(number, text)| Token { text, line, first: number == 0 }));
        }
        at += end + 1;
        line += lines;
    }
    found
}

/// The object that begins at a word, and where the next one does.
///
/// # Errors
/// What was expected, and the word that stands there instead.
pub(super) fn object<'a>(tokens: &[Token<'a>], at: usize) -> Result<(Object<'a>, usize), (String, usize)> {
    let mut next = at;
    let mut word = |expected: &str| {
        // Comments may stand between.
        while tokens.get(next).is_some_and(|token| token.text.starts_with('#')) {
            next += 1;
        }
        let found = tokens.get(next).copied().ok_or_else(|| (format!("the file ends, expected {expected}"), next))?;
        next += 1;
        Ok((found, next - 1))
    };
    let (modifier, _) = word("a modifier")?;
    let (kind, place) = word("a type")?;
    let is_known = |kinds: &[&str]| kinds.contains(&kind.text);
    if !(is_known(&SURFACES) || is_known(&MATERIALS) || is_known(&PATTERNS) || kind.text == "alias") {
        return Err((format!("'{}' was found, expected the type of a surface, a material or a pattern", kind.text), place));
    }
    let (name, _) = word("a name")?;
    let mut object =
        Object { modifier: modifier.text, kind: kind.text, name: name.text, strings: Vec::new(), numbers: Vec::new(), line: modifier.line };
    if kind.text == "alias" {
        object.strings.push(word("the name that the alias stands for")?.0.text);
        return Ok((object, next));
    }
    let count = |expected: &str, word: &mut dyn FnMut(&str) -> Word<'a>| {
        let (found, place) = word(expected)?;
        let wrong = || (format!("{} '{}': '{}' was found, expected {expected}", kind.text, name.text, found.text), place);
        found.text.parse::<usize>().map_err(|_| wrong())
    };
    for _ in 0..count("the number of strings", &mut word)? {
        object.strings.push(word("a string")?.0.text);
    }
    for _ in 0..count("the number of integers", &mut word)? {
        word("an integer")?;
    }
    for _ in 0..count("the number of reals", &mut word)? {
        let (found, place) = word("a number")?;
        let wrong = || (format!("{} '{}': '{}' was found, expected a number", kind.text, name.text, found.text), place);
        object.numbers.push(found.text.parse::<f64>().ok().filter(|x| x.is_finite()).ok_or_else(wrong)?);
    }
    Ok((object, next))
}

/// Where the next line that looks like an object, a command or a comment begins.
pub(super) fn resume(tokens: &[Token<'_>], from: usize) -> usize {
    let is_type = |text: &str| SURFACES.contains(&text) || MATERIALS.contains(&text) || PATTERNS.contains(&text) || text == "alias";
    let starts = |at: usize| {
        let token = &tokens[at];
        token.first && (token.text.starts_with(['!', '#']) || tokens.get(at + 1).is_some_and(|next| is_type(next.text)))
    };
    (from..tokens.len()).find(|&at| starts(at)).unwrap_or(tokens.len())
}
