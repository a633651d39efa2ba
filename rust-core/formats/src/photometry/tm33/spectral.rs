//! Spectra of emitters.

use super::ROOT;
use crate::error::{FormatError, Result};
use crate::photometry::text::{decode, parse, quote};
use crate::spectrum::{SpectralPoint, SpectralPower};
use crate::xml::{LineNumbers, at, attribute, children, content, descend, document, text_at};
use roxmltree::Node;

/// The spectra of a file's emitters, in their order.
///
/// # Errors
/// What is no XML or has another root, no spectrum at all, or one that is none, with its line.
pub fn spectra(bytes: &[u8]) -> Result<Vec<SpectralPower>> {
    let text = decode(bytes)?;
    let document = document(&text)?;
    let root = document.root_element();
    if !root.tag_name().name().starts_with(ROOT) {
        return Err(at(root, format!("<{}> was found, expected a root whose name begins with {ROOT}", quote(root.tag_name().name()))));
    }
    let lines = LineNumbers::new(&text);
    let listed = children(root, "Emitter").flat_map(|emitter| nodes(emitter).map(move |node| (emitter, node)));
    let found = listed.map(|(emitter, node)| spectrum(emitter, node, &lines)).collect::<Result<Vec<_>>>()?;
    if found.is_empty() { Err(at(root, "no emitter with an <EmitterSpectral> was found".into())) } else { Ok(found) }
}

/// The spectrum that an emitter shines with, the first where there are several; what cannot be used is told and left out.
pub(super) fn of_emitter(emitter: Node<'_, '_>, lines: &LineNumbers, warnings: &mut Vec<FormatError>) -> Option<SpectralPower> {
    if descend(emitter, &["SpectralData", "AngularSpectral"]).is_some() {
        warnings.push(FormatError::whole("spectra by angle are left out"));
    }
    let node = nodes(emitter).next()?;
    let count = nodes(emitter).count();
    if count > 1 {
        warnings.push(FormatError::whole(format!("1 of {count} spectra of the emitter is read")));
    }
    let left_out =
        |error: FormatError| warnings.push(FormatError { problem: format!("its spectrum is left out: {}", error.problem), ..error });
    spectrum(emitter, node, lines).map_err(left_out).ok()
}

fn nodes<'a, 'input>(emitter: Node<'a, 'input>) -> impl Iterator<Item = Node<'a, 'input>> {
    children(emitter, "SpectralData").flat_map(|data| children(data, "EmitterSpectral"))
}

fn spectrum(emitter: Node<'_, '_>, node: Node<'_, '_>, lines: &LineNumbers) -> Result<SpectralPower> {
    // The schema does not say what it counts; powers may be photons then.
    let quantum = descend(node, &["Quantum"]).map(content).filter(|quantum| parse(quantum) != Some(0.0));
    if let Some(quantum) = quantum {
        return Err(lines.at(node, format!("a spectrum with the <Quantum> {}, expected power", quote(quantum))));
    }
    let names = [text_at(node, &["EmitterName"]), text_at(emitter, &["Description"])];
    let name = names.iter().find(|name| !name.is_empty()).map_or("", String::as_str);
    let point = |node: Node<'_, '_>| {
        let (nm, power) = (attribute(node, "w"), content(node));
        match (parse(nm), parse(power)) {
            (Some(nm), Some(power)) => Ok(SpectralPoint { nm, power, line: Some(lines.line(node)) }),
            (None, _) => Err(lines.at(node, format!("the wavelength {} of a <PwrData> is no number of nm", quote(nm)))),
            _ => Err(lines.at(node, format!("the power {} at {nm} nm is no number", quote(power)))),
        }
    };
    let points = children(node, "PwrData").map(point).collect::<Result<Vec<_>>>()?;
    if points.is_empty() {
        return Err(lines.at(node, "a spectrum without <PwrData>".into()));
    }
    SpectralPower::new(name, &points)
}
