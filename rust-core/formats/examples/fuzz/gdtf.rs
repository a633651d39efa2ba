//! GDTF archives, and the descriptions inside them.

use crate::Reader;
use crate::gldf::stored;
use gonio_formats::gdtf::Gdtf;
use gonio_formats::photometry::read;

/// The archive, and its text: a mutated archive mostly fails at its checksums.
pub(crate) fn readers() -> Vec<Reader> {
    vec![
        Reader { name: "gdtf", seeds: || vec![gdtf(DESCRIPTION.as_bytes())], read: |bytes| use_fixture(bytes), memory: 64 << 20 },
        Reader { name: "gdtf-description", seeds: || vec![DESCRIPTION.into()], read: |bytes| use_fixture(&gdtf(bytes)), memory: 64 << 20 },
    ]
}

fn use_fixture(bytes: &[u8]) -> bool {
    let Ok(fixture) = Gdtf::read(bytes) else { return false };
    for mode in fixture.modes.iter().take(4) {
        drop(fixture.goniogram(mode));
    }
    read(bytes, "a.gdtf#2").is_ok()
}

fn gdtf(description: &[u8]) -> Vec<u8> {
    stored(&[("description.xml", description)])
}

const DESCRIPTION: &str = r#"<GDTF DataVersion="1.2"><FixtureType Name="n" Manufacturer="m" FixtureTypeID="i"><PhysicalDescriptions><Emitters>
<Emitter Name="w" Color="0.3127,0.329,100"><Measurement Physical="50"/><Measurement Physical="100" LuminousIntensity="5">
<MeasurementPoint WaveLength="450" Energy="0.5"/><MeasurementPoint WaveLength="650" Energy="1"/></Measurement></Emitter></Emitters>
</PhysicalDescriptions><Geometries><Geometry Name="Base"><Axis Name="Yoke" Position="{1,0,0,0}{0,1,0,0}{0,0,1,-0.2}{0,0,0,1}">
<Beam Name="Beam" LuminousFlux="12000" BeamAngle="20" FieldAngle="32" BeamRadius="0.03" BeamType="Spot" PowerConsumption="350"
ColorTemperature="6500" ColorRenderingIndex="75" EmitterSpectrum="w"/></Axis></Geometry>
<Geometry Name="Bar"><GeometryReference Name="a" Geometry="Base"/><GeometryReference Name="b" Geometry="Base"
Position="{1,0,0,1}{0,0,-1,0}{0,1,0,0}{0,0,0,1}"/><Beam Name="Glow" BeamType="Rectangle" BeamAngle="25"/></Geometry></Geometries>
<DMXModes><DMXMode Name="one" Geometry="Base"/><DMXMode Name="all" Geometry="Bar"/></DMXModes></FixtureType></GDTF>"#;
