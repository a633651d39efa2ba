//! GLDF and L3D: archives made here, and real ones where there are any.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

mod bad_input;
mod light;
mod model;
mod samples;
mod write;
mod zip;

use std::f64::consts::PI;

/// An absolute Lambertian downlight of a flux, as LM-63: I = Φ / π · cos γ, in steps of one degree.
fn downlight(flux: f64) -> Vec<u8> {
    ies(flux, 0.0)
}

/// The same, or with its light upwards where `zenith` is 180.
fn ies(flux: f64, zenith: f64) -> Vec<u8> {
    let angles: Vec<f64> = (0..=90).map(|step| if zenith > 0.0 { 90.0 + f64::from(step) } else { f64::from(step) }).collect();
    let candela: Vec<String> = angles.iter().map(|angle| (flux / PI * (angle - zenith).to_radians().cos().max(0.0)).to_string()).collect();
    let angles: Vec<String> = angles.iter().map(f64::to_string).collect();
    let head = "IESNA:LM-63-2002\n[MANUFAC] inside\n[LUMINAIRE] inside\nTILT=NONE\n1 -1 1 91 1 1 2 0.3 0.3 0\n1 1 10";
    format!("{head}\n{}\n0\n{}\n", angles.join(" "), candela.join(" ")).into_bytes()
}

/// A product of these definitions and variants.
fn product(general: &str, variants: &str) -> String {
    format!(
        "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n<Root>\n<Header><Manufacturer>ACME</Manufacturer>\n\
         <FormatVersion major=\"1\" minor=\"0\" pre-release=\"3\"/><UniqueGldfId>id-1</UniqueGldfId></Header>\n\
         <GeneralDefinitions>\n{general}\n</GeneralDefinitions>\n\
         <ProductDefinitions><ProductMetaData><ProductNumber><Locale language=\"en\">P-1</Locale></ProductNumber>\
         <Name><Locale language=\"de\">Leuchte</Locale><Locale language=\"en\">Lamp</Locale></Name></ProductMetaData>\n\
         <Variants>\n{variants}\n</Variants></ProductDefinitions></Root>"
    )
}

/// Two photometries, three sources and four emitters.
const GENERAL: &str = r#"<Files>
<File id="down" contentType="ldc/ies" type="localFileName">down.ies</File>
<File id="up" contentType="ldc/ies" type="localFileName">up.ies</File>
<File id="model" contentType="geo/l3d" type="localFileName">body.l3d</File>
<File id="far" contentType="image/png" type="url">https://example.org/lamp.png</File>
<File id="power" contentType="spectrum/text" type="localFileName">power.txt</File>
</Files>
<Photometries>
<Photometry id="pd"><PhotometryFileReference fileId="down"/></Photometry>
<Photometry id="pu"><PhotometryFileReference fileId="up"/></Photometry>
</Photometries>
<Spectrums><Spectrum id="s1"><SpectrumFileReference fileId="power"/></Spectrum>
<Spectrum id="s2"><Intensity wavelength="450">0.5</Intensity><Intensity wavelength="650">1</Intensity></Spectrum></Spectrums>
<LightSources>
<FixedLightSource id="led"><Name><Locale language="en">LED</Locale></Name><RatedInputPower>10</RatedInputPower>
<SpectrumReference spectrumId="s1"/>
<ColorInformation><ColorRenderingIndex>90</ColorRenderingIndex><CorrelatedColorTemperature>3000</CorrelatedColorTemperature>
</ColorInformation></FixedLightSource>
<ChangeableLightSource id="lamp"><Name><Locale language="en">T5</Locale></Name><RatedInputPower>14</RatedInputPower>
<RatedLuminousFlux>1200</RatedLuminousFlux></ChangeableLightSource>
</LightSources>
<Equipments><Equipment id="two"><LightSourceReference changeableLightSourceId="lamp" lightSourceCount="2"/>
<RatedInputPower>31</RatedInputPower></Equipment></Equipments>
<Emitters>
<Emitter id="ed"><FixedLightEmitter emergencyBehaviour="Combined"><PhotometryReference photometryId="pd"/>
<LightSourceReference fixedLightSourceId="led"/>
<RatedLuminousFlux>1000</RatedLuminousFlux><EmergencyBallastLumenFactor>0.1</EmergencyBallastLumenFactor></FixedLightEmitter></Emitter>
<Emitter id="eu"><FixedLightEmitter><PhotometryReference photometryId="pu"/><LightSourceReference fixedLightSourceId="led"/>
<RatedLuminousFlux>600</RatedLuminousFlux></FixedLightEmitter></Emitter>
<Emitter id="strong"><FixedLightEmitter><PhotometryReference photometryId="pd"/><LightSourceReference fixedLightSourceId="led"/>
<RatedLuminousFlux>1500</RatedLuminousFlux></FixedLightEmitter>
<FixedLightEmitter emergencyBehaviour="EmergencyOnly"><PhotometryReference photometryId="pu"/>
<LightSourceReference fixedLightSourceId="led"/>
<RatedLuminousFlux>50</RatedLuminousFlux></FixedLightEmitter></Emitter>
<Emitter id="tubes"><ChangeableLightEmitter><PhotometryReference photometryId="pd"/><EquipmentReference equipmentId="two"/>
</ChangeableLightEmitter></Emitter>
<Emitter id="eye"><SensorEmitter><SensorReference sensorId="none"/></SensorEmitter></Emitter>
</Emitters>
<Geometries><SimpleGeometry id="box"><Cuboid><Width>300</Width><Length>1200</Length><Height>80</Height></Cuboid>
<RectangularEmitter><Width>280</Width><Length>1180</Length></RectangularEmitter></SimpleGeometry>
<ModelGeometry id="mesh"><GeometryFileReference fileId="model"/></ModelGeometry></Geometries>"#;

const VARIANTS: &str = r#"<Variant id="v1"><ProductNumber><Locale language="en">N-1</Locale></ProductNumber><Name>
<Locale language="en">plain</Locale><Locale language="de">schlicht</Locale></Name>
<GTIN>12345678</GTIN><Mountings><Ceiling><Pendant pendantLength="500"/><SurfaceMounted/></Ceiling><Wall mountingHeight="1800">
<SurfaceMounted/></Wall></Mountings>
<Geometry><EmitterReference emitterId="ed"/></Geometry></Variant>
<Variant id="v2"><Name><Locale language="en">strong</Locale></Name><Geometry>
<SimpleGeometryReference geometryId="box" emitterId="strong"/></Geometry></Variant>
<Variant id="v3"><Name><Locale language="en">both</Locale></Name><Geometry><ModelGeometryReference geometryId="mesh">
<EmitterReference emitterId="ed"><EmitterObjectExternalName>leo-0</EmitterObjectExternalName></EmitterReference>
<EmitterReference emitterId="ed"><EmitterObjectExternalName>leo-1</EmitterObjectExternalName></EmitterReference>
<EmitterReference emitterId="eu"><EmitterObjectExternalName>absent</EmitterObjectExternalName></EmitterReference>
<EmitterReference emitterId="eye"><EmitterObjectExternalName>leo-0</EmitterObjectExternalName></EmitterReference>
</ModelGeometryReference></Geometry></Variant>
<Variant id="v4"><Name><Locale language="en">tubes</Locale></Name><Geometry><EmitterReference emitterId="tubes"/></Geometry></Variant>
<Variant id="v5"><Name><Locale language="en">dark</Locale></Name></Variant>
<Variant id="v6"><Name><Locale language="en">wrong</Locale></Name><Geometry><EmitterReference emitterId="nothing"/></Geometry></Variant>"#;

const STRUCTURE: &str = r#"<?xml version="1.0"?>
<Luminaire><Header><Name>body</Name></Header>
<GeometryDefinitions><GeometryFileDefinition id="cube" filename="cube.obj" units="mm"/></GeometryDefinitions>
<Structure><Geometry partName="base"><Position x="0" y="0" z="1"/><Rotation x="0" y="0" z="90"/><GeometryReference geometryId="cube"/>
<Joints><Joint partName="j"><Position x="2" y="0" z="0"/><Rotation x="0" y="0" z="0"/><DefaultRotation x="0" y="90" z="0"/>
<Geometries><Geometry partName="head"><Position x="0" y="0" z="0"/><Rotation x="0" y="0" z="0"/><GeometryReference geometryId="cube"/>
<LightEmittingObjects><LightEmittingObject partName="leo-1"><Position x="1" y="0" z="0"/><Rotation x="0" y="0" z="0"/>
<Circle diameter="0.1"/></LightEmittingObject></LightEmittingObjects>
</Geometry></Geometries></Joint></Joints>
<LightEmittingObjects><LightEmittingObject partName="leo-0"><Position x="0" y="0" z="-0.1"/><Rotation x="0" y="0" z="-90"/>
<Rectangle sizeX="0.5" sizeY="0.25"/><LuminousHeights c0="0.01" c90="0" c180="0.01" c270="0"/></LightEmittingObject></LightEmittingObjects>
<LightEmittingSurfaces><LightEmittingSurface partName="s"><LightEmittingObjectReference lightEmittingPartName="leo-0"/>
<FaceAssignments><FaceAssignment faceIndex="3"/><FaceRangeAssignment groupIndex="1" faceIndexBegin="5" faceIndexEnd="9"/>
</FaceAssignments></LightEmittingSurface></LightEmittingSurfaces>
</Geometry></Structure></Luminaire>"#;

const MESH: &[u8] = b"v 0 0 0\nv 1000 0 0\nv 1000 1000 0\nf 1 2 3\n";

fn model_file() -> Vec<u8> {
    zip::archive(&[("structure.xml", STRUCTURE.as_bytes()), ("cube/cube.obj", MESH)])
}

/// The whole product.
fn gldf() -> Vec<u8> {
    let (product, model) = (product(GENERAL, VARIANTS), model_file());
    zip::archive(&[
        ("product.xml", product.as_bytes()),
        ("ldc/down.ies", &downlight(1000.0)),
        ("ldc/up.ies", &ies(500.0, 180.0)),
        ("geo/body.l3d", &model),
        ("spectrum/power.txt", b"380 1\n400 1\n420 1\n440 1\n460 2\n480 1\n500 1\n520 1\n540 1\n560 1\n580 1\n600 4\n620 1\n640 1\n660 1\n680 1\n700 1\n720 1\n740 1\n760 1\n780 1\n"),
    ])
}

fn close(found: f64, expected: f64, relative: f64) {
    assert!((found / expected - 1.0).abs() <= relative, "found {found}, expected {expected} within {relative}");
}
