//! GLDF and L3D archives, and the structures inside them.

use crate::Reader;
use gonio_formats::gldf::Gldf;
use gonio_formats::l3d::L3d;
use gonio_formats::photometry::read;

/// The archives, and their texts: a mutated archive mostly fails at its checksums.
pub(crate) fn readers() -> Vec<Reader> {
    vec![
        Reader { name: "gldf", seeds: || vec![gldf(PRODUCT.as_bytes())], read: |bytes| use_product(bytes), memory: 64 << 20 },
        Reader { name: "gldf-product", seeds: || vec![PRODUCT.into()], read: |bytes| use_product(&gldf(bytes)), memory: 64 << 20 },
        Reader { name: "l3d", seeds: || vec![l3d(STRUCTURE.as_bytes())], read: use_model, memory: 64 << 20 },
        Reader { name: "l3d-structure", seeds: || vec![STRUCTURE.into()], read: |bytes| use_model(&l3d(bytes)), memory: 64 << 20 },
    ]
}

fn use_product(bytes: &[u8]) -> bool {
    let Ok(product) = Gldf::read(bytes) else { return false };
    for variant in product.variants.iter().take(4) {
        drop((product.goniogram(variant), product.emergency_flux(variant), product.l3d(variant)));
    }
    read(bytes, "a.gldf#2").is_ok()
}

fn use_model(bytes: &[u8]) -> bool {
    L3d::read(bytes).is_ok_and(|model| model.meshes.iter().take(4).all(|mesh| model.polygons(mesh).is_ok()))
}

const IES: &[u8] = b"IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 3 1 1 2 0.3 0.3 0\n1 1 10\n0 45 90\n0\n100 50 0\n";
const MESH: &[u8] = b"v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n";

const STRUCTURE: &str = r#"<Luminaire><GeometryDefinitions><GeometryFileDefinition id="a" filename="a.obj" units="mm"/></GeometryDefinitions>
<Structure><Geometry partName="b"><Position x="0" y="0" z="1"/><Rotation x="0" y="0" z="90"/><GeometryReference geometryId="a"/>
<Joints><Joint partName="j"><Position x="2" y="0" z="0"/><DefaultRotation x="0" y="90" z="0"/>
<Geometries><Geometry partName="h"><GeometryReference geometryId="a"/>
<LightEmittingObjects><LightEmittingObject partName="l"><Rotation x="0" y="0" z="5"/><Circle diameter="0.1"/></LightEmittingObject>
</LightEmittingObjects>
<LightEmittingSurfaces><LightEmittingSurface><LightEmittingObjectReference lightEmittingPartName="l"/>
<FaceAssignments><FaceRangeAssignment faceIndexBegin="5" faceIndexEnd="9"/></FaceAssignments></LightEmittingSurface></LightEmittingSurfaces>
</Geometry></Geometries></Joint></Joints></Geometry></Structure></Luminaire>"#;

const PRODUCT: &str = r#"<Root><Header><Manufacturer>m</Manufacturer><FormatVersion major="1" minor="0"/></Header><GeneralDefinitions>
<Files><File id="d" contentType="ldc/ies" type="localFileName">a.ies</File><File id="m" contentType="geo/l3d" type="localFileName">a.l3d</File>
</Files>
<Photometries><Photometry id="p"><PhotometryFileReference fileId="d"/></Photometry></Photometries>
<Spectrums><Spectrum id="s"><Intensity wavelength="450">0.5</Intensity></Spectrum></Spectrums>
<LightSources><FixedLightSource id="f"><RatedInputPower>10</RatedInputPower><SpectrumReference spectrumId="s"/></FixedLightSource>
<ChangeableLightSource id="c"><RatedLuminousFlux>1200</RatedLuminousFlux></ChangeableLightSource></LightSources>
<Equipments><Equipment id="q"><LightSourceReference changeableLightSourceId="c" lightSourceCount="2"/></Equipment></Equipments>
<Emitters><Emitter id="e"><FixedLightEmitter emergencyBehaviour="Combined"><Rotation><X>5</X></Rotation><PhotometryReference photometryId="p"/>
<LightSourceReference fixedLightSourceId="f"/><RatedLuminousFlux>1000</RatedLuminousFlux></FixedLightEmitter>
<ChangeableLightEmitter><PhotometryReference photometryId="p"/><EquipmentReference equipmentId="q"/></ChangeableLightEmitter></Emitter></Emitters>
<Geometries><SimpleGeometry id="b"><Cylinder><Diameter>1</Diameter><Height>2</Height></Cylinder></SimpleGeometry>
<ModelGeometry id="g"><GeometryFileReference fileId="m"/></ModelGeometry></Geometries></GeneralDefinitions>
<ProductDefinitions><ProductMetaData><Name><Locale language="en">n</Locale></Name></ProductMetaData><Variants>
<Variant id="1"><Mountings><Ceiling><Pendant pendantLength="5"/></Ceiling></Mountings><Geometry><EmitterReference emitterId="e"/></Geometry>
</Variant>
<Variant id="2"><Geometry><ModelGeometryReference geometryId="g"><EmitterReference emitterId="e">
<EmitterObjectExternalName>l</EmitterObjectExternalName></EmitterReference></ModelGeometryReference></Geometry></Variant>
</Variants></ProductDefinitions></Root>"#;

fn gldf(product: &[u8]) -> Vec<u8> {
    stored(&[("product.xml", product), ("ldc/a.ies", IES), ("geo/a.l3d", &l3d(STRUCTURE.as_bytes()))])
}

fn l3d(structure: &[u8]) -> Vec<u8> {
    stored(&[("structure.xml", structure), ("a/a.obj", MESH)])
}

/// An archive of files as they are (APPNOTE 6.3).
pub(crate) fn stored(files: &[(&str, &[u8])]) -> Vec<u8> {
    let (mut bytes, mut directory) = (Vec::new(), Vec::new());
    for (name, content) in files {
        let mut common = vec![20, 0, 0, 8, 0, 0, 0, 0, 0, 0];
        let size = content.len() as u32;
        [crc32fast::hash(content), size, size].iter().for_each(|word| common.extend(word.to_le_bytes()));
        common.extend((name.len() as u32).to_le_bytes());
        directory.extend(b"PK\x01\x02\x14\0".iter().chain(&common).chain(&[0; 10]));
        directory.extend((bytes.len() as u32).to_le_bytes());
        directory.extend(name.as_bytes());
        bytes.extend(b"PK\x03\x04".iter().chain(&common).chain(name.as_bytes()).chain(*content));
    }
    let (start, length, count) = (bytes.len() as u32, directory.len() as u32, files.len() as u32);
    bytes.extend(directory);
    bytes.extend(b"PK\x05\x06\0\0\0\0");
    [count * 0x1_0001, length, start].iter().for_each(|word| bytes.extend(word.to_le_bytes()));
    bytes.extend([0; 2]);
    bytes
}
