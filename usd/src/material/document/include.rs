//! Documents that MaterialX documents include: what they hold stands in the place of the line that names them.

use crate::material::mtlx::Stated;
use crate::material::xml::{self, Element};
use std::path::{Path, PathBuf};

/// How deep documents may include one another.
const MAX_DEPTH: usize = 16;
/// Most documents that one takes in.
const MAX_DOCUMENTS: usize = 256;

/// Puts what is included into a document's root.
pub(super) fn expand(document: &mut Element, file: &Path, problems: &mut Vec<String>) {
    let mut reader = Reader { open: vec![file.to_owned()], count: 0, problems };
    reader.expand(document);
}

struct Reader<'p> {
    /// The documents around the line that is read, the outermost first.
    open: Vec<PathBuf>,
    count: usize,
    problems: &'p mut Vec<String>,
}

impl Reader<'_> {
    fn expand(&mut self, document: &mut Element) {
        if !document.children.iter().any(is_include) {
            return;
        }
        for child in std::mem::take(&mut document.children) {
            match child.attribute("href") {
                Some(href) if is_include(&child) => document.children.extend(self.included(href)),
                _ if is_include(&child) => self.problems.push("an <xi:include> without href is left out".to_owned()),
                _ => document.children.push(child),
            }
        }
    }

    /// The elements of a document that is included.
    fn included(&mut self, href: &str) -> Vec<Element> {
        let file = folder(self.open.last().map_or(Path::new(""), PathBuf::as_path)).join(href);
        match self.read(&file) {
            Ok(mut root) => {
                self.open.push(file.clone());
                self.expand(&mut root);
                self.open.pop();
                let text = folder(&file).to_string_lossy().into_owned();
                apart(&root, &text)
            }
            Err(problem) => {
                self.problems.push(format!("the document '{href}' that is included {problem}; what it holds is missing"));
                Vec::new()
            }
        }
    }

    fn read(&mut self, file: &Path) -> Result<Element, String> {
        self.count += 1;
        if self.open.iter().any(|open| open == file) || self.open.len() > MAX_DEPTH || self.count > MAX_DOCUMENTS {
            return Err("includes itself, or too many others".to_owned());
        }
        let text = super::read(file).map_err(|problem| format!("is not usable: {problem}"))?;
        let root = xml::parse(&text).map_err(|error| format!("is not usable: line {}: {}", error.line, error.problem))?;
        if root.name == "materialx" { Ok(root) } else { Err(format!("has the root element <{}>, expected <materialx>", root.name)) }
    }
}

fn is_include(element: &Element) -> bool {
    matches!(element.name.as_str(), "xi:include" | "include")
}

fn folder(file: &Path) -> &Path {
    file.parent().unwrap_or(Path::new(""))
}

/// A document's elements with what held for all of them written to each: the colour space, and the places of files.
fn apart(root: &Element, folder: &str) -> Vec<Element> {
    let space = root.attribute("colorspace");
    let stated = Stated { document: root, graph: None, folder };
    let mut elements = Vec::new();
    for child in &root.children {
        let mut child = child.clone();
        let graph = (child.name == "nodegraph").then(|| child.clone());
        place_files(&mut child, &Stated { graph: graph.as_ref(), ..stated });
        if let (Some(space), None) = (space, child.attribute("colorspace")) {
            child.attributes.push(("colorspace".to_owned(), space.to_owned()));
        }
        elements.push(child);
    }
    elements
}

/// Writes to inputs where their files lie.
fn place_files(element: &mut Element, stated: &Stated<'_>) {
    if element.attribute("type") == Some("filename") {
        for (name, value) in &mut element.attributes {
            if name == "value" && !value.is_empty() {
                *value = stated.file(value);
            }
        }
    }
    element.children.iter_mut().for_each(|child| place_files(child, stated));
}
