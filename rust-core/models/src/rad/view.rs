//! Views in comments, as `rvu` writes them.

use super::{Reader, Source, origin};
use crate::view::View;

/// How such comments begin.
const STARTS: [&str; 4] = ["rvu ", "rview ", "VIEW=", "view="];

impl Reader {
    /// A camera of a comment that is a view; others are comments.
    pub(super) fn view(&mut self, source: &Source<'_>, line: usize, comment: &str) {
        let text = comment.trim_start_matches('#').trim();
        let Some(options) = STARTS.iter().find_map(|start| text.strip_prefix(start)).filter(|text| text.contains("-v")) else { return };
        self.builder.count("view");
        let cameras = self.builder.model.scene.cameras.len();
        let origin = origin(source, &format!("view{cameras}"), line);
        match parsed(options).and_then(|view| view.camera(origin.clone())) {
            Ok((camera, told)) => {
                self.builder.model.scene.cameras.push(camera);
                if let Some(told) = told {
                    self.builder.warn(&origin, told);
                }
            }
            Err(problem) => self.builder.warn(&origin, format!("{problem}; the view is left out")),
        }
    }
}

fn parsed(text: &str) -> Result<View, String> {
    let mut view = View::default();
    let mut words = text.split_whitespace();
    while let Some(option) = words.next() {
        let mut number = || {
            let text = words.next().unwrap_or("");
            text.parse::<f64>().map_err(|_| format!("view {option}: '{text}' was found, expected a number"))
        };
        let mut triple = || -> Result<[f64; 3], String> { Ok([number()?, number()?, number()?]) };
        match option {
            "-vp" => view.position = triple()?,
            "-vd" => view.direction = triple()?,
            "-vu" => view.up = triple()?,
            "-vh" => view.size[0] = number()?,
            "-vv" => view.size[1] = number()?,
            "-vs" => view.shift[0] = number()?,
            "-vl" => view.shift[1] = number()?,
            "-vo" => view.clip[0] = number()?,
            "-va" => view.clip[1] = number()?,
            kind if kind.starts_with("-vt") => view.kind = kind.chars().nth(3).unwrap_or('v'),
            // Options of the program, not of the view.
            _ => {}
        }
    }
    Ok(view)
}
