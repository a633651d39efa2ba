//! Writing `.gbsdf`.

use core::fmt::Write;

use super::super::axis::{Mode, degrees};
use super::super::colour::Channels;
use super::super::table::Table;
use super::MAGIC;

/// How values are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Encoding {
    /// As decimal numbers, a line for each run of the last axis: to read, to edit and to compare.
    Text,
    /// As little-endian single precision.
    Binary,
}

/// A file of tables; `title` is for people.
pub fn write(tables: &[Table], title: &str, encoding: Encoding) -> Vec<u8> {
    let title: String = title.chars().map(|c| if c.is_control() { ' ' } else { c }).collect();
    let mut file = format!("{MAGIC}\ntitle {title}\n").into_bytes();
    for table in tables {
        file.extend(header(table).into_bytes());
        match encoding {
            Encoding::Text => file.extend(text(table).into_bytes()),
            Encoding::Binary => {
                file.extend(b"values f32\n");
                table.values().iter().for_each(|v| file.extend(v.to_le_bytes()));
                file.push(b'\n');
            }
        }
        file.extend(b"end\n");
    }
    file
}

/// Everything before the values. Writing to a string cannot fail.
fn header(table: &Table) -> String {
    let layout = table.layout();
    let yes = |flag| if flag { "yes" } else { "no" };
    let mut text = format!("\ntable {} {}\n", layout.hemispheres.name(), layout.coordinates.name());
    let _ = writeln!(text, "reciprocal {}\nbilateral {}", yes(layout.reciprocal), yes(layout.bilateral));
    let _ = match &layout.channels {
        Channels::Luminance => writeln!(text, "channels luminance"),
        Channels::Rgb => writeln!(text, "channels rgb"),
        Channels::Xyz => writeln!(text, "channels xyz"),
        Channels::Bands { wavelengths_nm } => {
            let bands: Vec<String> = wavelengths_nm.iter().map(f64::to_string).collect();
            writeln!(text, "channels bands {}\n{}", bands.len(), bands.join(" "))
        }
    };
    for (name, axis) in layout.coordinates.axis_names().iter().zip(&layout.axes) {
        let mode = match axis.mode() {
            Mode::Linear => "linear".into(),
            Mode::Nearest => "nearest".into(),
            Mode::Periodic { period } => format!("periodic {}", degrees(period)),
        };
        let knots: Vec<String> = axis.knots().iter().map(|&x| degrees(x).to_string()).collect();
        let _ = writeln!(text, "axis {name} {mode} {}\n{}", knots.len(), knots.join(" "));
    }
    text
}

fn text(table: &Table) -> String {
    let layout = table.layout();
    let run = layout.axes.last().map_or(1, |axis| axis.knots().len()) * layout.channels.count();
    let mut text = String::from("values text\n");
    for line in table.values().chunks(run) {
        let numbers: Vec<String> = line.iter().map(|v| format!("{v:?}")).collect();
        text.push_str(&numbers.join(" "));
        text.push('\n');
    }
    text
}
