//! Emitters with their lights, light sources and photometries.

use super::read::{ById, Notes, texts};
use super::{Emergency, Emitter, Light, RatedFlux, Texts};
use crate::error::FormatError;
use crate::photometry::text::quote;
use crate::xml::{attribute, children, descend, tag, value_at};
use roxmltree::Node;

/// What lights refer to.
pub(super) struct Definitions<'a, 'input, 'm> {
    photometries: ById<Node<'a, 'input>>,
    sources: ById<Node<'a, 'input>>,
    equipments: ById<Node<'a, 'input>>,
    files: &'m ById<usize>,
    spectra: &'m ById<usize>,
    notes: &'m Notes,
}

impl<'a, 'input, 'm> Definitions<'a, 'input, 'm> {
    pub(super) fn new(general: Option<Node<'a, 'input>>, files: &'m ById<usize>, spectra: &'m ById<usize>, notes: &'m Notes) -> Self {
        let by_id = |list: &str| -> ById<Node<'a, 'input>> {
            let listed = general.and_then(|general| descend(general, &[list]));
            let elements = listed.into_iter().flat_map(|list| list.children()).filter(Node::is_element);
            elements.map(|node| (attribute(node, "id").to_owned(), node)).collect()
        };
        let (photometries, sources, equipments) = (by_id("Photometries"), by_id("LightSources"), by_id("Equipments"));
        Self { photometries, sources, equipments, files, spectra, notes }
    }

    /// The file of the photometry that a node refers to.
    fn photometry(&self, node: Node<'_, '_>) -> Result<usize, FormatError> {
        let Some(reference) = descend(node, &["PhotometryReference"]) else {
            return Err(self.notes.problem(node, format!("{} names no photometry", tag(node))));
        };
        let id = attribute(reference, "photometryId");
        let Some(photometry) = self.photometries.get(id) else {
            return Err(self.notes.problem(reference, format!("no photometry {} is defined", quote(id))));
        };
        let Some(file) = descend(*photometry, &["PhotometryFileReference"]) else {
            return Err(self.notes.problem(*photometry, format!("the photometry {} names no file", quote(id))));
        };
        let id = attribute(file, "fileId");
        self.files.get(id).copied().ok_or_else(|| self.notes.problem(file, format!("no file {} is defined", quote(id))))
    }

    /// The light source that a node refers to by an attribute.
    fn source(&self, node: Node<'_, '_>, attribute_name: &str) -> Option<Node<'a, 'input>> {
        let reference = descend(node, &["LightSourceReference"])?;
        self.sources.get(attribute(reference, attribute_name)).copied()
    }

    fn spectrum(&self, source: Node<'_, '_>) -> Option<usize> {
        let reference = descend(source, &["SpectrumReference"])?;
        self.spectra.get(attribute(reference, "spectrumId")).copied()
    }
}

/// All emitters of a product.
pub(super) fn emitters(general: Option<Node<'_, '_>>, definitions: &Definitions<'_, '_, '_>) -> (Vec<Emitter>, ById<usize>) {
    let (mut emitters, mut ids) = (Vec::new(), ById::new());
    let listed = general.and_then(|general| descend(general, &["Emitters"]));
    for node in listed.into_iter().flat_map(|list| children(list, "Emitter")) {
        let id = attribute(node, "id").to_owned();
        let mut emitter = Emitter { id: id.clone(), lights: Vec::new(), is_sensor: false };
        for light in node.children().filter(Node::is_element) {
            match light.tag_name().name() {
                "FixedLightEmitter" => emitter.lights.push(fixed(light, definitions)),
                "ChangeableLightEmitter" => emitter.lights.push(changeable(light, definitions)),
                "MultiChannelLightEmitter" => emitter.lights.extend(channels(light, definitions)),
                "SensorEmitter" => emitter.is_sensor = true,
                _ => {}
            }
        }
        ids.insert(id, emitters.len());
        emitters.push(emitter);
    }
    (emitters, ids)
}

/// What every kind of light has: a source's colour and power, and when it shines.
fn common(light: Node<'_, '_>, source: Option<Node<'_, '_>>, definitions: &Definitions<'_, '_, '_>) -> Light {
    let own = texts(light, "Name");
    let of_source = |path: &[&str]| source.and_then(|source| value_at(source, path));
    let mut angles = ["X", "Y", "Z", "G0"].map(|axis| value_at(light, &["Rotation", axis]).unwrap_or(0.0));
    angles.iter_mut().for_each(|angle| *angle = angle.rem_euclid(360.0));
    Light {
        name: if own == Texts::default() { source.map(|source| texts(source, "Name")).unwrap_or_default() } else { own },
        photometry: definitions.photometry(light),
        rated: None,
        watts: of_source(&["RatedInputPower"]).filter(|watts| *watts > 0.0),
        temperature: of_source(&["ColorInformation", "CorrelatedColorTemperature"]),
        rendering: of_source(&["ColorInformation", "ColorRenderingIndex"]),
        spectrum: source.and_then(|source| definitions.spectrum(source)),
        emergency: match attribute(light, "emergencyBehaviour") {
            "Combined" => Emergency::Combined,
            "EmergencyOnly" => Emergency::Only,
            _ => Emergency::None,
        },
        emergency_factor: value_at(light, &["EmergencyBallastLumenFactor"]).filter(|factor| (0.0..=1.0).contains(factor)),
        emergency_flux: value_at(light, &["EmergencyRatedLuminousFlux"]).filter(|flux| *flux >= 0.0),
        rotation: angles,
    }
}

fn flux(node: Node<'_, '_>) -> Option<f64> {
    value_at(node, &["RatedLuminousFlux"]).filter(|flux| *flux > 0.0)
}

/// A light whose source is built in; its flux is that of the whole.
fn fixed(light: Node<'_, '_>, definitions: &Definitions<'_, '_, '_>) -> Light {
    let source = definitions.source(light, "fixedLightSourceId");
    Light { rated: flux(light).map(RatedFlux::Luminaire), ..common(light, source, definitions) }
}

/// A light with lamps: an equipment says which, how many, and their power with their gear.
fn changeable(light: Node<'_, '_>, definitions: &Definitions<'_, '_, '_>) -> Light {
    let reference = descend(light, &["EquipmentReference"]);
    let equipment = reference.and_then(|reference| definitions.equipments.get(attribute(reference, "equipmentId")).copied());
    let source = equipment.and_then(|equipment| definitions.source(equipment, "changeableLightSourceId"));
    let mut found = common(light, source, definitions);
    let Some(equipment) = equipment else { return found };
    let count = descend(equipment, &["LightSourceReference"]).and_then(|node| attribute(node, "lightSourceCount").parse::<u32>().ok());
    let count = f64::from(count.unwrap_or(1).max(1));
    found.rated = source.and_then(flux).map(|flux| RatedFlux::Lamps(flux * count));
    found.watts = value_at(equipment, &["RatedInputPower"]).filter(|watts| *watts > 0.0).or(found.watts.map(|watts| watts * count));
    found.emergency_factor = value_at(equipment, &["EmergencyBallastLumenFactor"]).filter(|factor| (0.0..=1.0).contains(factor));
    found.emergency_flux = value_at(equipment, &["EmergencyRatedLuminousFlux"]).filter(|flux| *flux >= 0.0);
    found
}

/// Lights of a source of several channels, all of them at full flux. The first has the source's power.
fn channels(light: Node<'_, '_>, definitions: &Definitions<'_, '_, '_>) -> Vec<Light> {
    let Some(source) = definitions.source(light, "multiChannelLightSourceId") else { return Vec::new() };
    let whole = common(light, Some(source), definitions);
    let listed = descend(source, &["Channels"]).into_iter().flat_map(|list| children(list, "Channel"));
    let channel = |(index, channel): (usize, Node<'_, '_>)| {
        let number = |name: &str| value_at(channel, &["ColorInformation", name]);
        Light {
            name: texts(channel, "DisplayName"),
            photometry: definitions.photometry(channel),
            rated: flux(channel).map(RatedFlux::Luminaire),
            watts: if index == 0 { whole.watts } else { Some(0.0) },
            temperature: number("CorrelatedColorTemperature"),
            rendering: number("ColorRenderingIndex"),
            spectrum: definitions.spectrum(channel),
            ..whole.clone()
        }
    };
    listed.enumerate().map(channel).collect()
}
