//! `product.xml`.

use super::{MODEL, NewProduct, PHOTOMETRY, SPECTRUM};
use crate::photometry::text::{number, one_line};
use crate::svg::escape;

const SCHEMA: &str = "https://gldf.io/xsd/gldf/1.0.0-rc.3/gldf.xsd";

/// The greatest luminous efficacy in lm/W.
const EFFICACY: f64 = 683.0;

/// An element with text.
fn text(name: &str, text: &str) -> String {
    format!("<{name}>{}</{name}>\n", escape(&one_line(text)))
}

/// An element that holds others; nothing where it would be empty.
fn holder(name: &str, content: &str) -> String {
    if content.is_empty() { String::new() } else { format!("<{name}>\n{content}</{name}>\n") }
}

/// A text in English, the language of whom nothing is said.
fn locale(name: &str, text: &str) -> String {
    format!("<{name}><Locale language=\"en\">{}</Locale></{name}>\n", escape(&one_line(text)))
}

fn value(name: &str, value: Option<f64>) -> String {
    value.map(|value| text(name, &number(value))).unwrap_or_default()
}

/// A whole number within limits, as schemas want it.
fn whole(name: &str, found: Option<f64>, [least, most]: [f64; 2]) -> String {
    value(name, found.filter(|found| found.is_finite()).map(|found| found.round().clamp(least, most)))
}

impl NewProduct {
    /// The product under an identifier.
    pub(super) fn product(&self, id: &str) -> String {
        let general =
            [self.files(), self.photometry(), self.spectrum(), self.source(), emitter(self.figures.flux), self.geometry()].concat();
        let body = self.header(id) + &holder("GeneralDefinitions", &general) + &self.definitions(id);
        format!(
            "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n\
             <Root xmlns:xsi=\"http://www.w3.org/2001/XMLSchema-instance\" xsi:noNamespaceSchemaLocation=\"{SCHEMA}\">\n{body}</Root>\n"
        )
    }

    fn header(&self, id: &str) -> String {
        let parts = [
            text("Manufacturer", &self.manufacturer),
            "<FormatVersion major=\"1\" minor=\"0\" pre-release=\"3\"/>\n".to_owned(),
            text("CreatedWithApplication", &self.program),
            text("GldfCreationTimeCode", &self.time),
            text("UniqueGldfId", id),
        ];
        holder("Header", &parts.concat())
    }

    fn files(&self) -> String {
        let file = |id: &str, kind: &str, path: &str| {
            let name = path.rsplit('/').next().unwrap_or(path);
            format!("<File id=\"{id}\" contentType=\"{kind}\" type=\"localFileName\">{name}</File>\n")
        };
        let model = self.model.as_ref().map(|_| file("file-model", "geo/l3d", MODEL));
        let spectrum = (!self.spectrum.is_empty()).then(|| file("file-spectrum", "spectrum/text", SPECTRUM));
        let all = file("file-photometry", "ldc/eulumdat", PHOTOMETRY) + &model.unwrap_or_default() + &spectrum.unwrap_or_default();
        holder("Files", &all)
    }

    fn photometry(&self) -> String {
        let figures = &self.figures;
        let down = figures.downward_fraction.clamp(0.0, 1.0);
        let ratio = figures.light_output_ratio.map(|ratio| ratio.clamp(0.0, 1.0));
        let efficacy = self.power().map(|watts| figures.flux / watts).filter(|efficacy| *efficacy <= EFFICACY);
        let angles = |name: &str, [c0, c90]: [f64; 2]| {
            let both = value("C0-C180", Some(c0)) + &value("C90-C270", Some(c90));
            if c0 > 0.0 && c90 > 0.0 { holder(name, &both) } else { String::new() }
        };
        let parts = [
            value("LightOutputRatio", ratio),
            value("LuminousEfficacy", efficacy),
            value("DownwardFluxFraction", Some(down)),
            value("DownwardLightOutputRatio", ratio.map(|ratio| ratio * down)),
            value("UpwardLightOutputRatio", ratio.map(|ratio| ratio * (1.0 - down))),
            angles("TenthPeakDivergence", figures.field),
            angles("HalfPeakDivergence", figures.beam),
        ];
        let described = holder("DescriptivePhotometry", &parts.concat());
        let file = "<PhotometryFileReference fileId=\"file-photometry\"/>\n";
        holder("Photometries", &format!("<Photometry id=\"photometry\">\n{file}{described}</Photometry>\n"))
    }

    fn spectrum(&self) -> String {
        let listed = "<Spectrum id=\"spectrum\"><SpectrumFileReference fileId=\"file-spectrum\"/></Spectrum>\n";
        if self.spectrum.is_empty() { String::new() } else { holder("Spectrums", listed) }
    }

    /// Power that is known.
    fn power(&self) -> Option<f64> {
        self.watts.filter(|watts| *watts > 0.0 && watts.is_finite())
    }

    fn source(&self) -> String {
        let spectrum = if self.spectrum.is_empty() { "" } else { "<SpectrumReference spectrumId=\"spectrum\"/>\n" };
        let power = value("RatedInputPower", Some(self.power().unwrap_or(0.0)));
        let body = locale("Name", "light source") + &power + spectrum + &self.colour();
        holder("LightSources", &format!("<FixedLightSource id=\"source\">\n{body}</FixedLightSource>\n"))
    }

    fn colour(&self) -> String {
        let colour = &self.colour;
        let chromaticity = colour.chromaticity.map(|[x, y]| value("X", Some(x)) + &value("Y", Some(y))).unwrap_or_default();
        let rendition = colour.rendition.map(|[rf, rg]| whole("Rf", Some(rf), [0.0, 100.0]) + &whole("Rg", Some(rg), [0.0, 140.0]));
        let parts = [
            whole("ColorRenderingIndex", colour.rendering, [0.0, 100.0]),
            whole("CorrelatedColorTemperature", colour.temperature, [0.0, f64::from(i32::MAX)]),
            holder("RatedChromacityCoordinateValues", &chromaticity),
            holder("IES-TM-30-15", &rendition.unwrap_or_default()),
            value("MelanopicFactor", colour.melanopic),
        ];
        holder("ColorInformation", &parts.concat())
    }

    fn geometry(&self) -> String {
        let model =
            "<ModelGeometry id=\"model\">\n<GeometryFileReference fileId=\"file-model\" levelOfDetail=\"High\"/>\n</ModelGeometry>\n";
        if self.model.is_some() { holder("Geometries", model) } else { String::new() }
    }

    fn definitions(&self, id: &str) -> String {
        let number = if self.number.is_empty() { &self.name } else { &self.number };
        let meta = text("UniqueProductId", id) + &locale("ProductNumber", number) + &locale("Name", &self.name);
        let shown = match &self.model {
            None => "<EmitterReference emitterId=\"emitter\"/>\n".to_owned(),
            Some(model) => {
                let object = text("EmitterObjectExternalName", &model.light.name);
                let emitter = format!("<EmitterReference emitterId=\"emitter\">\n{object}</EmitterReference>\n");
                format!("<ModelGeometryReference geometryId=\"model\">\n{emitter}</ModelGeometryReference>\n")
            }
        };
        let body = locale("ProductNumber", number) + &locale("Name", &self.name) + &holder("Geometry", &shown);
        let variants = holder("Variants", &format!("<Variant id=\"variant\">\n{body}</Variant>\n"));
        holder("ProductDefinitions", &(holder("ProductMetaData", &meta) + &variants))
    }
}

/// The light, whose flux is a whole number of lumens.
fn emitter(flux: f64) -> String {
    let parts = [
        "<PhotometryReference photometryId=\"photometry\"/>\n<LightSourceReference fixedLightSourceId=\"source\"/>\n".to_owned(),
        whole("RatedLuminousFlux", Some(flux), [0.0, f64::from(i32::MAX)]),
    ];
    holder("Emitters", &format!("<Emitter id=\"emitter\">\n{}</Emitter>\n", holder("FixedLightEmitter", &parts.concat())))
}
