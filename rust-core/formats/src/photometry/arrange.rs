//! From the range of a file's angles to a symmetry, with every range brought to the one that [`Symmetry`] documents.

use super::axis::Table;
use super::text::number;
use super::{PhotometricType, Symmetry};
use crate::error::{FormatError, Result};

/// Brings ordered angles to the ranges that [`super::Goniogram`] keeps, and says what symmetry they have.
///
/// # Errors
/// Ranges that no symmetry explains, with the line of the last angle.
pub(crate) fn arrange(table: &mut Table, photometric_type: PhotometricType, warnings: &mut Vec<FormatError>) -> Result<Symmetry> {
    check_vertical(table, photometric_type, warnings)?;
    match photometric_type {
        PhotometricType::C => planes(table, warnings),
        PhotometricType::B => crossed(table, [-90.0, 90.0]),
        PhotometricType::A => crossed(table, [-180.0, 180.0]),
    }
}

/// The vertical angles' range, and what of the sphere it leaves dark.
pub(crate) fn check_vertical(table: &mut Table, photometric_type: PhotometricType, warnings: &mut Vec<FormatError>) -> Result<()> {
    let axis = &mut table.vertical;
    let range = match photometric_type {
        PhotometricType::C => [0.0, 180.0],
        PhotometricType::B => [-180.0, 180.0],
        PhotometricType::A => [-90.0, 90.0],
    };
    axis.snap(&[-180.0, -90.0, 0.0, 90.0, 180.0]);
    axis.within(range)?;
    if axis.angles.len() < 2 {
        return Err(FormatError::line(axis.line(0), "1 vertical angle was found, expected at least 2"));
    }
    let dark = |angle: f64| angle.rem_euclid(90.0) != 0.0;
    if photometric_type == PhotometricType::C && (dark(axis.first()) || dark(axis.last())) {
        let (first, last) = (number(axis.first()), number(axis.last()));
        let problem = format!("vertical angles run from {first} to {last}, expected from 0 or 90 to 90 or 180: no light elsewhere");
        warnings.push(FormatError::line(axis.line(0), problem));
    }
    Ok(())
}

/// Types A and B: a list that starts at 0 is mirrored to the other sign.
fn crossed(table: &mut Table, range: [f64; 2]) -> Result<Symmetry> {
    table.horizontal.snap(&[-180.0, -90.0, 0.0, 90.0, 180.0]);
    table.horizontal.within(range)?;
    if table.horizontal.angles.len() < 2 {
        let problem = "1 horizontal angle was found, expected at least 2 with photometric types A and B";
        return Err(FormatError::line(table.horizontal.line(0), problem));
    }
    Ok(match (table.horizontal.first() == 0.0, table.vertical.first() == 0.0) {
        (true, true) => Symmetry::Quadrants,
        (true, false) => Symmetry::AboutC0,
        (false, true) => Symmetry::AboutC90,
        (false, false) => Symmetry::None,
    })
}

/// Type C.
fn planes(table: &mut Table, warnings: &mut Vec<FormatError>) -> Result<Symmetry> {
    let axis = &mut table.horizontal;
    axis.snap(&[-360.0, -270.0, -180.0, -90.0, 0.0, 90.0, 180.0, 270.0, 360.0, 450.0]);
    axis.within([-360.0, 720.0])?;
    let (first, last, line) = (axis.first(), axis.last(), axis.line(0));
    let found = format!("horizontal angles run from {} to {}", number(first), number(last));
    let mut note = |reading: &str| warnings.push(FormatError::line(line, format!("{found}: {reading}")));
    if axis.angles.len() == 1 {
        if first != 0.0 {
            note("one plane stands for all");
        }
        axis.angles[0] = 0.0;
        return Ok(Symmetry::Rotational);
    }
    match (last - first, first.rem_euclid(360.0)) {
        (360.0, 0.0) if first == 0.0 => {
            if table.has_seam() {
                note("the planes at both ends differ, which are one");
            }
            Ok(Symmetry::None)
        }
        (360.0, _) => {
            note("brought to 0 to 360");
            table.drop_last_plane();
            table.map_planes(|c| c.rem_euclid(360.0));
            Ok(Symmetry::None)
        }
        (180.0, start) if start % 90.0 == 0.0 => Ok(halves(table, start, note)),
        (90.0, start) if start % 90.0 == 0.0 => Ok(quarters(table, start, note)),
        (span, _) if closes(&table.horizontal.angles, span) => {
            note("the first plane closes the circle");
            table.map_planes(|c| c.rem_euclid(360.0));
            Ok(Symmetry::None)
        }
        _ => {
            let problem = format!("{found}, expected 0 alone, 0 to 90, 0 to 180, 90 to 270 or 0 to 360");
            Err(FormatError::line(table.horizontal.line(table.horizontal.angles.len() - 1), problem))
        }
    }
}

fn halves(table: &mut Table, start: f64, mut note: impl FnMut(&str)) -> Symmetry {
    let first = table.horizontal.first();
    if start == 90.0 {
        table.map_planes(|c| c - first + 90.0);
        return Symmetry::AboutC90;
    }
    if start == 270.0 {
        note("mirrored at the plane through C90 and C270");
        table.map_planes(|c| 270.0 - (c - first));
        return Symmetry::AboutC90;
    }
    if start == 180.0 {
        note("mirrored at the plane through C0 and C180");
        table.map_planes(|c| 180.0 - (c - first));
    } else {
        table.map_planes(|c| c - first);
    }
    Symmetry::AboutC0
}

fn quarters(table: &mut Table, start: f64, mut note: impl FnMut(&str)) -> Symmetry {
    let first = table.horizontal.first();
    if start != 0.0 {
        note("mirrored into all quadrants");
    }
    let falling = start == 90.0 || start == 270.0;
    table.map_planes(|c| if falling { 90.0 - (c - first) } else { c - first });
    Symmetry::Quadrants
}

/// Whether the first plane may close the circle: the gap is no wider than the steps are.
fn closes(angles: &[f64], span: f64) -> bool {
    let widest = angles.windows(2).map(|pair| pair[1] - pair[0]).fold(0.0, f64::max);
    angles.len() > 2 && span < 360.0 && 360.0 - span <= 1.5 * widest
}
