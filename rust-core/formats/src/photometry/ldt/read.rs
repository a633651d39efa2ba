//! The reader.

use super::fields::Fields;
use crate::error::{FormatError, Result};
use crate::photometry::arrange::check_vertical;
use crate::photometry::axis::{Axis, Table};
use crate::photometry::check::Least;
use crate::photometry::plausible::within_body;
use crate::photometry::text::{LARGEST, decode, number, quote};
use crate::photometry::{Goniogram, HeaderLine, LampSet, Opening, PhotometricType, Stated, Symmetry};

/// Metres in a millimetre.
const MILLIMETRE: f64 = 1e-3;

/// The most lamp sets: the format's own limit is 20.
const MOST_SETS: usize = 1000;

/// What the first seven lines say of the table.
struct Layout {
    symmetry: Symmetry,
    planes: usize,
    plane_step: f64,
    angles: usize,
    angle_step: f64,
}

/// Reads an EULUMDAT file for its first lamp set; [`Goniogram::with_lamp_set`] gives the others, which are alternatives.
///
/// Candela are cd/klm times the conversion factor times the set's flux in klm; the flux is the whole set's, whatever its number of lamps.
/// A negative number of lamps is absolute photometry. Planes from C270 through C0 to C90 (symmetry 3) are kept as their mirror images
/// from C90 to C270.
///
/// # Errors
/// Anything without one sensible reading, with the line.
pub fn read(bytes: &[u8]) -> Result<Goniogram> {
    let text = decode(bytes)?;
    let mut fields = Fields::new(&text);
    let mut header = texts(&mut fields, &[("MANUFAC", "the company")])?;
    let layout = layout(&mut fields)?;
    let rest = [
        ("TEST", "the measurement report's number"),
        ("LUMINAIRE", "the luminaire's name"),
        ("LUMCAT", "the luminaire's number"),
        ("FILE", "the file's name"),
        ("DATE", "the date and user"),
    ];
    header.extend(texts(&mut fields, &rest)?);
    let [length, width, height] = millimetres(&mut fields, ["length", "width", "height"].map(|of| format!("the luminaire's {of}")))?;
    let area = millimetres(&mut fields, ["length", "width"].map(|of| format!("the luminous area's {of}")))?;
    let area_line = fields.line();
    let heights = millimetres(&mut fields, ["C0", "C90", "C180", "C270"].map(|at| format!("the luminous area's height at {at}")))?;
    let (opening, problem) = within_body(Opening::from_eulumdat(area, heights), [length, width, height]);
    fields.warnings.extend(problem.map(|problem| FormatError::line(area_line, problem)));
    let mut stated = Stated {
        downward_fraction: Some(fields.number("the downward flux fraction")? / 100.0),
        light_output_ratio: Some(fields.number("the light output ratio")? / 100.0).filter(|ratio| *ratio > 0.0),
        ..Stated::default()
    };
    let conversion = conversion_factor(&mut fields)?;
    stated.measurement_tilt = fields.number("the tilt of the measurement")?;
    let lamp_sets = lamp_sets(&mut fields)?;
    stated.direct_ratios = Some(direct_ratios(&mut fields)?);
    let per_klm = conversion * lamp_sets.first().and_then(|set| set.flux).unwrap_or(1000.0) / 1000.0;
    let (symmetry, table) = table(&mut fields, &layout, per_klm)?;
    let mut goniogram = Goniogram {
        photometric_type: PhotometricType::C,
        symmetry,
        horizontal: table.horizontal.angles,
        vertical: table.vertical.angles,
        intensities: table.intensities,
        opening,
        body: [length, width, height],
        lamp_sets,
        lamp_set: 0,
        tilt: None,
        stated,
        header,
        spectrum: None,
        warnings: fields.warnings,
    };
    goniogram.check();
    Ok(goniogram)
}

fn texts(fields: &mut Fields<'_>, wanted: &[(&str, &str)]) -> Result<Vec<HeaderLine>> {
    let text = |(keyword, what): &(&str, &str)| {
        let text = fields.text(what)?.to_owned();
        Ok(HeaderLine { keyword: (*keyword).to_owned(), text })
    };
    wanted.iter().map(text).collect()
}

fn layout(fields: &mut Fields<'_>) -> Result<Layout> {
    fields.whole("the type indicator", [0, 3])?;
    let symmetry = match fields.whole("the symmetry indicator", [0, 4])? {
        0 => Symmetry::None,
        1 => Symmetry::Rotational,
        2 => Symmetry::AboutC0,
        3 => Symmetry::AboutC90,
        _ => Symmetry::Quadrants,
    };
    let most = fields.room();
    let planes = fields.whole("the number of C planes", [1, most])?;
    let plane_step = fields.number("the distance of C planes")?;
    let angles = fields.whole("the number of angles in a plane", [2, most.max(2)])?;
    let angle_step = fields.number("the distance of angles in a plane")?;
    Ok(Layout { symmetry, planes, plane_step, angles, angle_step })
}

/// Lengths in millimetres, given in metres.
fn millimetres<const N: usize>(fields: &mut Fields<'_>, names: [String; N]) -> Result<[f64; N]> {
    let mut metres = [0.0; N];
    for (metre, name) in metres.iter_mut().zip(names) {
        let value = fields.number(&name)?;
        if value < 0.0 {
            fields.warn(format!("{name} is {} mm: its magnitude is taken", number(value)));
        }
        *metre = value.abs() * MILLIMETRE;
    }
    Ok(metres)
}

fn conversion_factor(fields: &mut Fields<'_>) -> Result<f64> {
    let factor = fields.number("the conversion factor")?;
    if factor > 0.0 {
        return Ok(factor);
    }
    fields.warn(format!("the conversion factor is {}: 1 is taken", number(factor)));
    Ok(1.0)
}

fn lamp_sets(fields: &mut Fields<'_>) -> Result<Vec<LampSet>> {
    let count = fields.whole("the number of lamp sets", [1, MOST_SETS])?;
    (0..count).map(|_| lamp_set(fields)).collect()
}

fn lamp_set(fields: &mut Fields<'_>) -> Result<LampSet> {
    let count = fields.number("the number of lamps")?;
    let name = fields.text("the lamps' type")?.to_owned();
    let flux = fields.number("the lamps' flux")?;
    if flux <= 0.0 {
        fields.warn(format!("the lamps' flux is {} lm: intensities are taken as cd instead of cd/klm", number(flux)));
    }
    let colour = fields.text("the lamps' colour")?.to_owned();
    let colour_rendering = fields.text("the lamps' colour rendering")?.to_owned();
    let watts = fields.number("the lamps' power")?.max(0.0);
    let flux = (flux > 0.0).then_some(flux);
    Ok(LampSet { count: count.abs() as u32, name, flux, absolute: count < 0.0, watts, colour, colour_rendering })
}

fn direct_ratios(fields: &mut Fields<'_>) -> Result<[f64; 10]> {
    let mut ratios = [0.0; 10];
    for ratio in &mut ratios {
        *ratio = fields.number("a direct ratio")?;
    }
    Ok(ratios)
}

/// Angles and intensities, in cd.
fn table(fields: &mut Fields<'_>, layout: &Layout, per_klm: f64) -> Result<(Symmetry, Table)> {
    if layout.planes.saturating_add(layout.angles) > fields.room() {
        let problem = format!(
            "{} C planes of {} angles, but the rest of the file has room for {} numbers",
            layout.planes,
            layout.angles,
            fields.room()
        );
        return Err(fields.error(problem));
    }
    let planes = stepped(fields, "C plane", layout.planes, layout.plane_step)?;
    let vertical = stepped(fields, "γ angle", layout.angles, layout.angle_step)?;
    let (symmetry, horizontal) = stored(fields, planes, layout.symmetry)?;
    let count = horizontal.angles.len().checked_mul(vertical.angles.len()).filter(|count| *count <= fields.room());
    let Some(count) = count else {
        let problem = format!(
            "{} planes of {} intensities were announced, but the rest of the file has room for {}",
            horizontal.angles.len(),
            vertical.angles.len(),
            fields.room()
        );
        return Err(fields.error(problem));
    };
    let intensities = intensities(fields, count, per_klm)?;
    let mut table = Table { horizontal, vertical, intensities };
    let mut warnings = std::mem::take(&mut fields.warnings);
    table.order(&mut warnings)?;
    check_vertical(&mut table, PhotometricType::C, &mut warnings)?;
    if symmetry == Symmetry::AboutC90 {
        table.map_planes(|c| 540.0 - c);
    }
    fields.warnings = warnings;
    Ok((symmetry, table))
}

fn intensities(fields: &mut Fields<'_>, count: usize, per_klm: f64) -> Result<Vec<f64>> {
    let (mut intensities, mut least) = (Vec::with_capacity(count), Least::default());
    for _ in 0..count {
        let value = fields.item("an intensity")? * per_klm;
        if value.abs() > LARGEST {
            return Err(fields.error(format!("an intensity is {value:e} cd, expected {LARGEST:e} at most")));
        }
        least.see(value, fields.line());
        intensities.push(value);
    }
    if let Some(token) = fields.token() {
        fields.warn(format!("{} was found after the last intensity: not read", quote(token)));
    }
    least.repair(&mut intensities, &mut fields.warnings)?;
    Ok(intensities)
}

/// A list of angles; one that does not increase is replaced by the stated steps.
fn stepped(fields: &mut Fields<'_>, name: &'static str, count: usize, step: f64) -> Result<Axis> {
    let mut axis = fields.axis(name, count)?;
    let last = step * (count - 1) as f64;
    if count > 1 && step > 0.0 && last <= 360.0 && !axis.angles.is_sorted_by(|a, b| a < b) {
        fields.warn(format!("{name}s do not increase: steps of {} degrees are taken", number(step)));
        axis.angles = (0..count).map(|index| index as f64 * step).collect();
    }
    Ok(axis)
}

/// The planes that a file with this symmetry stores, in the file's order, with angles that increase.
fn stored(fields: &mut Fields<'_>, mut planes: Axis, symmetry: Symmetry) -> Result<(Symmetry, Axis)> {
    planes.snap(&[0.0, 90.0, 180.0, 270.0, 360.0]);
    let keep = |range: [f64; 2], turn: f64| -> Vec<(f64, u64)> {
        let inside = planes.angles.iter().zip(&planes.lines).filter(|(c, _)| (range[0]..=range[1]).contains(*c));
        inside.map(|(c, line)| (c + turn, *line)).collect()
    };
    let (kept, [first, last]) = match symmetry {
        Symmetry::None if planes.angles.len() == 1 => {
            fields.warn("1 C plane without symmetry: it stands for all");
            return Ok((Symmetry::Rotational, Axis { angles: vec![0.0], ..planes }));
        }
        Symmetry::Rotational => return Ok((symmetry, Axis { angles: vec![0.0], ..planes })),
        Symmetry::None => {
            planes.within([0.0, 360.0])?;
            return Ok((symmetry, planes));
        }
        Symmetry::AboutC0 => (keep([0.0, 180.0], 0.0), [0.0, 180.0]),
        Symmetry::Quadrants => (keep([0.0, 90.0], 0.0), [0.0, 90.0]),
        Symmetry::AboutC90 => {
            let before = keep([270.0, 360.0 - 1e-9], 0.0);
            (before.into_iter().chain(keep([0.0, 90.0], 360.0)).collect(), [270.0, 450.0])
        }
    };
    let (angles, lines): (Vec<f64>, Vec<u64>) = kept.into_iter().unzip();
    let axis = Axis { name: planes.name, angles, lines };
    if axis.angles.len() > 1 && axis.first() == first && axis.last() == last {
        return Ok((symmetry, axis));
    }
    Err(fields.error(format!("the C planes do not have both C{first} and C{}, which this symmetry is about", last % 360.0)))
}
