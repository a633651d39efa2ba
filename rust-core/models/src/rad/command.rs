//! Commands in scenes: `xform`, `genbox` and `cat` are done here; others are told, never run.

use super::materials::found_beside;
use super::xform::{Placed, parse};
use super::{DEEPEST, Reader, Source, origin};
use std::path::Path;
use std::sync::Arc;

/// What a shell would do something about.
const SHELL: [char; 8] = ['$', '`', ';', '&', '<', '>', '*', '('];

/// What a command gives.
struct Output {
    name: String,
    text: Arc<str>,
    /// Where files that it names lie.
    folder: std::path::PathBuf,
}

impl Reader {
    pub(super) fn command(&mut self, source: &Source<'_>, line: usize, command: &str, placed: &Placed) {
        if let Err(problem) = self.run(source, line, command, placed) {
            self.builder.warn(&origin(source, "", line), format!("!{}: {problem}; it is left out", first_word(command)));
        }
    }

    fn run(&mut self, source: &Source<'_>, line: usize, command: &str, placed: &Placed) -> Result<(), String> {
        if placed.depth >= DEEPEST {
            return Err(format!("more than {DEEPEST} files within one another"));
        }
        if command.contains(SHELL) {
            return Err("only xform, genbox and cat are done here, without a shell".into());
        }
        let command = command.replace("\\\n", " ").replace("\\\r\n", " ");
        let mut stages = command.split('|').map(words);
        let first = stages.next().unwrap_or_default();
        let (outputs, mut placements) = self.first(source, line, &first)?;
        for stage in stages {
            let [name, options @ ..] = stage.as_slice() else { return Err("a command is missing between two bars".into()) };
            let (copies, files) = if name == "xform" { parse(options)? } else { return Err(not_run(name)) };
            if !files.is_empty() {
                return Err("xform reads what comes before it, and names a file".into());
            }
            placements = copies.iter().flat_map(|outer| placements.iter().map(|inner| outer.around(inner))).collect();
        }
        for copy in &placements {
            for output in &outputs {
                let source = Source { name: output.name.clone(), folder: &output.folder, text: &output.text };
                self.source(&source, &placed.around(copy));
            }
        }
        Ok(())
    }

    /// What the first command of a line reads, and how that is placed.
    fn first(&mut self, source: &Source<'_>, line: usize, words: &[String]) -> Result<(Vec<Output>, Vec<Placed>), String> {
        let [name, options @ ..] = words else { return Err("a command is missing".into()) };
        let (placements, files) = match name.as_str() {
            "xform" => parse(options)?,
            "cat" => (vec![Placed::default()], options.to_vec()),
            "genbox" => {
                let text = genbox(options)?;
                let output = Output { name: format!("{}:{line} genbox", source.name), text: text.into(), folder: source.folder.into() };
                return Ok((vec![output], vec![Placed::default()]));
            }
            other => return Err(not_run(other)),
        };
        if files.is_empty() {
            return Err("it names no file".into());
        }
        let outputs = files.iter().map(|file| self.file(source.folder, file)).collect::<Result<_, _>>()?;
        Ok((outputs, placements))
    }

    fn file(&mut self, folder: &Path, file: &str) -> Result<Output, String> {
        let path = found_beside(folder, file);
        let text = match self.texts.get(&path) {
            Some(text) => text.clone(),
            None => {
                let text: Arc<str> = crate::read_text(&path).map_err(|error| error.to_string())?.into();
                self.texts.insert(path.clone(), text.clone());
                text
            }
        };
        Ok(Output { name: file.to_owned(), text, folder: path.parent().unwrap_or(Path::new("")).into() })
    }
}

fn first_word(command: &str) -> &str {
    command.split_whitespace().next().unwrap_or("")
}

fn not_run(name: &str) -> String {
    let hint = if matches!(name, "gensky" | "gendaylit") { "; --sun gives sun and sky" } else { "" };
    format!("{name} is not run; write what it gives into a file, and name that{hint}")
}

/// Words as a shell makes them, without anything but quotes.
fn words(text: &str) -> Vec<String> {
    let (mut words, mut word, mut quote, mut is_open) = (Vec::new(), String::new(), None, false);
    for letter in text.chars() {
        match (quote, letter) {
            (Some(end), _) if letter == end => quote = None,
            (Some(_), _) => word.push(letter),
            (None, '"' | '\'') => (quote, is_open) = (Some(letter), true),
            (None, _) if letter.is_whitespace() => {
                if is_open || !word.is_empty() {
                    words.push(std::mem::take(&mut word));
                }
                is_open = false;
            }
            (None, _) => word.push(letter),
        }
    }
    if is_open || !word.is_empty() {
        words.push(word);
    }
    words
}

/// The polygons of a box from the origin to three sizes.
fn genbox(words: &[String]) -> Result<String, String> {
    let [modifier, name, x, y, z, options @ ..] = words else { return Err("expected a modifier, a name and three sizes".into()) };
    let size = |text: &String| {
        let found = text.parse::<f64>().ok().filter(|x| *x > 0.0 && x.is_finite());
        found.ok_or_else(|| format!("'{text}' was found, expected a size above 0"))
    };
    let size = [size(x)?, size(y)?, size(z)?];
    let inwards = options.iter().any(|option| option == "-i");
    if options.iter().any(|option| option != "-i") {
        return Err("rounded and bevelled boxes are not made".into());
    }
    // Corners by bits: x, y, z.
    let faces = [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];
    let polygon = |(number, face): (usize, &[usize; 4])| {
        let mut corners = *face;
        if inwards {
            corners.reverse();
        }
        let numbers: Vec<String> = corners
            .iter()
            .flat_map(|corner| (0..3).map(move |axis| if corner >> axis & 1 == 1 { size[axis] } else { 0.0 }.to_string()))
            .collect();
        format!("{modifier} polygon {name}.{number} 0 0 12 {}\n", numbers.join(" "))
    };
    Ok(faces.iter().enumerate().map(polygon).collect())
}
