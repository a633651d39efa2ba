//! Radiance scene files, by its reference manual.

mod command;
mod materials;
mod round;
mod surfaces;
mod tokens;
mod view;
mod xform;

use crate::builder::Builder;
use crate::{Model, Options};
use gonio_scene::{Error, Origin, Result};
use materials::Entry;
use std::collections::{HashMap, HashSet};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use tokens::{Object, Token, object};
use xform::Placed;

/// Files within files.
const DEEPEST: u32 = 32;
/// Objects of a scene with all copies.
const MOST_OBJECTS: usize = 10_000_000;

/// A scene that is being read.
struct Reader {
    builder: Builder,
    /// Materials and patterns by name: the last one before a surface counts.
    entries: HashMap<String, Entry>,
    /// Texts of files that commands name.
    texts: HashMap<PathBuf, Arc<str>>,
    /// What was told once.
    told: HashSet<String>,
    objects: usize,
}

/// A text, and where it is from.
struct Source<'a> {
    /// For messages.
    name: String,
    /// Where files that it names lie.
    folder: &'a Path,
    text: &'a str,
}

/// Reads a scene's text.
///
/// # Errors
/// An option asks for what such files do not have.
pub(crate) fn read(path: &Path, text: &str, options: &Options) -> Result<Model> {
    if let Some((group, _)) = options.states.first() {
        return Err(Error::setting("state", format!("'{group}' was found; Radiance scenes have no dynamic groups")));
    }
    let mut builder = Builder::default();
    builder.model.metres_per_unit = 1.0;
    let mut reader = Reader { builder, entries: HashMap::new(), texts: HashMap::new(), told: HashSet::new(), objects: 0 };
    let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
    let folder = path.parent().unwrap_or(Path::new(""));
    reader.source(&Source { name, folder, text }, &Placed::default());
    Ok(reader.builder.model)
}

impl Reader {
    /// Reads a text whose objects are placed so.
    fn source(&mut self, source: &Source<'_>, placed: &Placed) {
        let tokens = tokens::tokens(source.text);
        let mut at = 0;
        while at < tokens.len() {
            if self.objects >= MOST_OBJECTS {
                return self.once("objects", &origin(source, "", tokens[at].line), "more than ten million objects; the rest is left out");
            }
            match &tokens[at] {
                Token { text, line, .. } if text.starts_with('!') => {
                    self.command(source, *line, &text[1..], placed);
                    at += 1;
                }
                Token { text, line, .. } if text.starts_with('#') => {
                    self.view(source, *line, text);
                    at += 1;
                }
                _ => at = self.next_object(source, &tokens, at, placed),
            }
        }
    }

    /// Reads an object; gives where the next one begins.
    fn next_object(&mut self, source: &Source<'_>, tokens: &[Token<'_>], at: usize, placed: &Placed) -> usize {
        match object(tokens, at) {
            Ok((object, next)) => {
                self.objects += 1;
                self.object(source, &object, placed);
                next
            }
            Err((problem, stopped)) => {
                let next = tokens::resume(tokens, at + 1);
                let what = if next < tokens.len() { "it is left out" } else { "the rest of the file is left out" };
                let line = tokens.get(stopped).or(tokens.last()).map_or(1, |token| token.line);
                self.builder.warn(&origin(source, "", line), format!("{problem}; {what}"));
                next
            }
        }
    }

    fn object(&mut self, source: &Source<'_>, object: &Object<'_>, placed: &Placed) {
        let origin = origin(source, object.name, object.line);
        if object.kind == "alias" {
            return self.alias(&origin, object);
        }
        let result = if tokens::SURFACES.contains(&object.kind) {
            self.builder.count(object.kind);
            self.surface(&origin, object, placed)
        } else {
            self.define(source, &origin, object, placed);
            Ok(())
        };
        if let Err(problem) = result {
            self.builder.warn(&origin, format!("{}: {problem}; it is left out", object.kind));
        }
    }

    /// Warns the first time that something is met.
    fn once(&mut self, key: &str, origin: &Origin, message: &str) {
        if self.told.insert(key.to_owned()) {
            self.builder.warn(origin, message);
        }
    }
}

fn origin(source: &Source<'_>, name: &str, line: usize) -> Origin {
    Origin { name: name.into(), file: format!("{}:{line}", source.name).into() }
}
