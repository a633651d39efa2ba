//! The reader of `product.xml`.

use super::emitters::{Definitions, emitters};
use super::geometry::{models, mountings, simple_geometries};
use super::{EmitterUse, FilePlace, Gldf, GldfFile, GldfSpectrum, PRODUCT, SimpleGeometry, Texts, Variant};
use crate::archive::{Archive, inside, some_of};
use crate::error::{FormatError, Result};
use crate::photometry::text::{parse, quote};
use crate::spectrum::SpectralPoint;
use crate::xml::{LineNumbers, at, attribute, children, content, descend, document, tag, text_at, text_of};
use roxmltree::Node;
use std::collections::HashMap;

/// Warnings that are kept.
const MOST_WARNINGS: usize = 50;

/// What elements are found by.
pub(super) type ById<T> = HashMap<String, T>;

impl<'a> Gldf<'a> {
    /// Reads a GLDF file. References to what is not there are told where they are used.
    ///
    /// # Errors
    /// What is no archive, has no `product.xml`, or one that is no GLDF; with the file inside the archive and its line.
    pub fn read(bytes: &'a [u8]) -> Result<Self> {
        let archive = Archive::open(bytes)?;
        if archive.size(PRODUCT).is_none() {
            let names = some_of(archive.names());
            let found = if names.is_empty() { "nothing".to_owned() } else { names };
            return Err(FormatError::whole(format!("no {PRODUCT} is in the archive, expected one in a GLDF file; it holds {found}")));
        }
        let product = archive.read(PRODUCT)?;
        let text = text_of(&product).map_err(|error| inside(PRODUCT, &error))?;
        product_of(archive, &text).map_err(|error| if error.place.is_some() { inside(PRODUCT, &error) } else { error })
    }
}

fn product_of<'a>(archive: Archive<'a>, text: &str) -> Result<Gldf<'a>> {
    let document = document(text)?;
    let root = document.root_element();
    if root.tag_name().name() != "Root" {
        return Err(at(root, format!("{} was found, expected GLDF's <Root>", tag(root))));
    }
    let Some(head) = descend(root, &["Header"]) else { return Err(at(root, "no <Header> was found, expected one in <Root>".into())) };
    let mut notes = Notes { lines: LineNumbers::new(text), warnings: Vec::new() };
    let general = descend(root, &["GeneralDefinitions"]);
    let (files, file_ids) = files(general, &archive, &mut notes);
    let (spectra, spectrum_ids) = spectra(general, &file_ids, &mut notes);
    let definitions = Definitions::new(general, &file_ids, &spectrum_ids, &notes);
    let (emitters, emitter_ids) = emitters(general, &definitions);
    let product = descend(root, &["ProductDefinitions", "ProductMetaData"]);
    let product_text = |name: &str| product.map(|product| texts(product, name)).unwrap_or_default();
    let simple = simple_geometries(general);
    let models = models(general, &file_ids);
    let parts = Parts { emitters: &emitter_ids, simple: &simple, models: &models };
    let listed = descend(root, &["ProductDefinitions", "Variants"]).into_iter().flat_map(|node| children(node, "Variant"));
    let variants: Vec<Variant> = listed.map(|node| variant(node, &parts, &mut notes)).collect();
    let (name, number) = (product_text("Name"), product_text("ProductNumber"));
    Ok(Gldf {
        manufacturer: text_at(head, &["Manufacturer"]),
        id: text_at(head, &["UniqueGldfId"]),
        version: version(head),
        created_with: text_at(head, &["CreatedWithApplication"]),
        name,
        number,
        files,
        spectra,
        emitters,
        variants,
        warnings: notes.warnings,
        archive,
    })
}

/// Of the old schema a text, since then three numbers.
fn version(head: Node<'_, '_>) -> String {
    let Some(node) = descend(head, &["FormatVersion"]) else { return String::new() };
    match [attribute(node, "major"), attribute(node, "minor"), attribute(node, "pre-release")] {
        ["", ..] => content(node).to_owned(),
        [major, minor, ""] => format!("{major}.{minor}"),
        [major, minor, before] => format!("{major}.{minor}-rc.{before}"),
    }
}

/// The texts of an element that holds one for each language.
pub(super) fn texts(node: Node<'_, '_>, name: &str) -> Texts {
    let Some(holder) = descend(node, &[name]) else { return Texts::default() };
    let text = |node| (attribute(node, "language").to_owned(), content(node).to_owned());
    Texts(children(holder, "Locale").map(text).filter(|(_, text)| !text.is_empty()).take(100).collect())
}

/// What is noted while a product is read.
pub(super) struct Notes {
    lines: LineNumbers,
    warnings: Vec<FormatError>,
}

impl Notes {
    /// A problem at a node of the product.
    pub(super) fn problem(&self, node: Node<'_, '_>, problem: String) -> FormatError {
        inside(PRODUCT, &self.lines.at(node, problem))
    }

    /// A warning, while there are few.
    pub(super) fn warn(&mut self, node: Node<'_, '_>, problem: String) {
        if self.warnings.len() < MOST_WARNINGS {
            self.warnings.push(self.problem(node, problem));
        }
    }
}

fn files(general: Option<Node<'_, '_>>, archive: &Archive<'_>, notes: &mut Notes) -> (Vec<GldfFile>, ById<usize>) {
    let (mut files, mut ids) = (Vec::new(), ById::new());
    let listed = general.and_then(|general| descend(general, &["Files"]));
    for node in listed.into_iter().flat_map(|files| children(files, "File")) {
        let content_type = attribute(node, "contentType").to_owned();
        let name = content(node);
        let folder = content_type.split('/').next().unwrap_or_default();
        let (place, size) = if attribute(node, "type") == "url" {
            (FilePlace::Address(name.to_owned()), None)
        } else {
            let path = format!("{folder}/{name}");
            let size = archive.size(&path);
            if size.is_none() {
                notes.warn(node, format!("{} is not in the archive", quote(&path)));
            }
            (FilePlace::Inside(path), size)
        };
        if ids.insert(attribute(node, "id").to_owned(), files.len()).is_some() {
            notes.warn(node, format!("the file {} comes twice", quote(attribute(node, "id"))));
        }
        files.push(GldfFile { id: attribute(node, "id").to_owned(), content_type, place, size });
    }
    (files, ids)
}

fn spectra(general: Option<Node<'_, '_>>, files: &ById<usize>, notes: &mut Notes) -> (Vec<GldfSpectrum>, ById<usize>) {
    let (mut spectra, mut ids) = (Vec::new(), ById::new());
    let listed = general.and_then(|general| descend(general, &["Spectrums"]));
    for node in listed.into_iter().flat_map(|spectra| children(spectra, "Spectrum")) {
        let named = descend(node, &["SpectrumFileReference"]);
        let file = named.and_then(|named| files.get(attribute(named, "fileId")).copied());
        let values: Vec<SpectralPoint> = children(node, "Intensity").filter_map(|node| intensity(node, notes)).collect();
        if file.is_none() && values.is_empty() {
            notes.warn(node, format!("the spectrum {} has neither a file nor values", quote(attribute(node, "id"))));
        }
        ids.insert(attribute(node, "id").to_owned(), spectra.len());
        spectra.push(GldfSpectrum { id: attribute(node, "id").to_owned(), file, values });
    }
    (spectra, ids)
}

/// A wavelength in nm and its power.
fn intensity(node: Node<'_, '_>, notes: &mut Notes) -> Option<SpectralPoint> {
    let (nm, power) = (attribute(node, "wavelength"), content(node));
    if let (Some(nm), Some(power)) = (parse(nm), parse(power)) {
        return Some(SpectralPoint { nm, power, line: Some(notes.lines.line(node)) });
    }
    notes.warn(node, format!("the intensity {} at the wavelength {} is left out, expected numbers", quote(power), quote(nm)));
    None
}

/// What variants refer to.
struct Parts<'m> {
    emitters: &'m ById<usize>,
    simple: &'m ById<SimpleGeometry>,
    models: &'m ById<Vec<usize>>,
}

fn variant(node: Node<'_, '_>, parts: &Parts<'_>, notes: &mut Notes) -> Variant {
    let mut variant = Variant {
        id: attribute(node, "id").to_owned(),
        name: texts(node, "Name"),
        number: texts(node, "ProductNumber"),
        gtin: text_at(node, &["GTIN"]),
        mountings: mountings(node),
        emitters: Vec::new(),
        simple: None,
        models: Vec::new(),
    };
    let Some(geometry) = descend(node, &["Geometry"]) else { return variant };
    // Both kinds stand together one level further down; then they show the same emitters.
    let geometry = descend(geometry, &["GeometryReferences"]).unwrap_or(geometry);
    let simple = descend(geometry, &["SimpleGeometryReference"]);
    let model = descend(geometry, &["ModelGeometryReference"]);
    for reference in [simple, model].into_iter().flatten() {
        let id = attribute(reference, "geometryId");
        let is_known = if Some(reference) == simple { parts.simple.contains_key(id) } else { parts.models.contains_key(id) };
        if !is_known {
            notes.warn(reference, format!("no geometry {} is defined", quote(id)));
        }
    }
    variant.simple = simple.and_then(|node| parts.simple.get(attribute(node, "geometryId")).copied());
    variant.models = model.and_then(|node| parts.models.get(attribute(node, "geometryId")).cloned()).unwrap_or_default();
    variant.emitters = match (model, simple) {
        (Some(model), _) => model_emitters(model, parts, notes),
        (None, Some(simple)) => vec![emitter_use(simple, String::new(), parts, notes)],
        (None, None) => children(geometry, "EmitterReference").map(|node| emitter_use(node, String::new(), parts, notes)).collect(),
    };
    variant
}

/// Emitters at the objects of a model. One that is named for models of several formats counts for the first of these.
fn model_emitters(model: Node<'_, '_>, parts: &Parts<'_>, notes: &Notes) -> Vec<EmitterUse> {
    let mut targets =
        children(model, "EmitterReference").map(|node| attribute(node, "targetModelType")).filter(|target| !target.is_empty());
    let first = targets.next().map(str::to_owned);
    let counts = |node: &Node<'_, '_>| {
        let target = attribute(*node, "targetModelType");
        target.is_empty() || first.as_deref() == Some(target)
    };
    let object = |node| text_at(node, &["EmitterObjectExternalName"]);
    children(model, "EmitterReference").filter(counts).map(|node| emitter_use(node, object(node), parts, notes)).collect()
}

fn emitter_use(node: Node<'_, '_>, object: String, parts: &Parts<'_>, notes: &Notes) -> EmitterUse {
    let id = attribute(node, "emitterId");
    let missing = || notes.problem(node, format!("no emitter {} is defined", quote(id)));
    EmitterUse { emitter: parts.emitters.get(id).copied().ok_or_else(missing), object }
}
