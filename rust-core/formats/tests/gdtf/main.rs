//! GDTF: archives made here, and real ones where there are any.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

mod bad_input;
mod light;
mod samples;
#[path = "../gldf/zip.rs"]
mod zip;

use gonio_formats::gdtf::Gdtf;

/// A moving head, and a bar of three of them.
const DESCRIPTION: &str = r#"<?xml version="1.0" encoding="UTF-8"?>
<GDTF DataVersion="1.2">
<FixtureType Name="Head 20" LongName="Moving Head 20" Manufacturer="ACME" FixtureTypeID="308EA87D-7164-42DE-8106-A6D273F57A51">
<PhysicalDescriptions><Emitters>
<Emitter Name="White" Color="0.3127,0.3290,100">
<Measurement Physical="50"><MeasurementPoint WaveLength="500" Energy="9"/></Measurement>
<Measurement Physical="100" LuminousIntensity="5"><MeasurementPoint WaveLength="780" Energy="1"/><MeasurementPoint WaveLength="380" Energy="0.5"/>
</Measurement></Emitter>
<Emitter Name="UV" DominantWaveLength="400"/>
</Emitters></PhysicalDescriptions>
<Geometries>
<Geometry Name="Base"><Axis Name="Yoke" Position="{1,0,0,0}{0,1,0,0}{0,0,1,-0.225}{0,0,0,1}"><Axis Name="Head">
<Beam Name="Beam" LuminousFlux="12000" ColorTemperature="6500" BeamAngle="20" FieldAngle="40" BeamRadius="0.025" BeamType="Fresnel"
 PowerConsumption="350" ColorRenderingIndex="75" EmitterSpectrum="White"/></Axis></Axis></Geometry>
<Geometry Name="Bar">
<GeometryReference Name="one" Geometry="Base"/>
<GeometryReference Name="two" Geometry="Base" Position="{1.0,0.0,0.0,0.5} {0.0,1.0,0.0,0.0} {0.0,0.0,1.0,0.0} {0.0,0.0,0.0,1.0}"/>
<GeometryReference Name="three" Geometry="Base" Position="{1,0,0,1}{0,0,-1,0}{0,1,0,0}{0,0,0,1}"/></Geometry>
<Geometry Name="Sign"><Beam Name="Tube" BeamType="Glow" LuminousFlux="0"/><Beam Name="Panel" BeamType="Rectangle" RectangleRatio="1.5"/></Geometry>
<Geometry Name="Dark"/>
</Geometries>
<DMXModes><DMXMode Name="Standard" Geometry="Base"/><DMXMode Name="Bar" Geometry="Bar"/><DMXMode Name="Sign" Geometry="Sign"/>
<DMXMode Name="Dark" Geometry="Dark"/></DMXModes>
</FixtureType></GDTF>"#;

fn packed(description: &str) -> Vec<u8> {
    zip::archive(&[("description.xml", description.as_bytes()), ("models/gltf/base.glb", b"glTF")])
}

fn fixture() -> Gdtf {
    Gdtf::read(&packed(DESCRIPTION)).unwrap()
}
