//! Models: places by hand.

use crate::{MESH, model_file, zip};
use gonio_formats::l3d::{L3d, L3dShape, ShiningFaces};

fn close(found: [f64; 3], expected: [f64; 3]) {
    assert!(found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-12), "found {found:?}, expected {expected:?}");
}

#[test]
fn parts_and_lights_hang_on_one_another() {
    let bytes = model_file();
    let model = L3d::read(&bytes).unwrap();
    assert_eq!((model.name.as_str(), model.parts.len(), model.lights.len()), ("body", 2, 2));
    assert_eq!(model.meshes[0].metres, 1e-3);
    assert_eq!(model.polygons(&model.meshes[0]).unwrap().points[1], [1000.0, 0.0, 0.0]);
    let light = |name: &str| model.lights.iter().find(|light| light.name == name).unwrap();
    // The base stands at z = 1 and is turned by 90° about z, which the object's own turn takes back.
    close(light("leo-0").place.point([0.5, 0.0, 0.0]), [0.5, 0.0, 0.9]);
    assert_eq!(light("leo-0").shape, L3dShape::Rectangle([0.5, 0.25]));
    assert_eq!(light("leo-0").heights, [0.01, 0.0, 0.01, 0.0]);
    // The joint lies 2 m along the base's x, which is the luminaire's y; its turn about the base's y takes x down.
    close(light("leo-1").place.point([0.0; 3]), [0.0, 2.0, 0.0]);
    close(light("leo-1").place.direction([0.0, 0.0, -1.0]), [0.0, -1.0, 0.0]);
    assert_eq!(light("leo-1").shape, L3dShape::Circle(0.1));
    let faces = |group, faces| ShiningFaces { light: "leo-0".into(), group, faces };
    assert_eq!(model.parts[0].shining, [faces(None, [3, 3]), faces(Some(1), [5, 9])]);
    assert_eq!(model.warnings, []);
}

#[test]
fn broken_models_say_what_and_where() {
    let whole = |structure: &str| zip::archive(&[("structure.xml", structure.as_bytes()), ("cube/cube.obj", MESH)]);
    let text = crate::STRUCTURE;
    for (bytes, expected) in [
        (zip::archive(&[("a.obj", MESH)]), "no structure.xml is in the archive, expected one in an L3D file; it holds 'a.obj'"),
        (whole("<Root/>"), "structure.xml: line 1: <Root> was found, expected L3D's <Luminaire>"),
        (whole("<Luminaire/>"), "structure.xml: line 1: no <Structure> was found"),
        (whole(&deep()), "structure.xml: line 1: more than 64 joints hang on one another"),
    ] {
        let problem = L3d::read(&bytes).unwrap_err().to_string();
        assert!(problem.starts_with(expected), "{problem}");
    }
    for (from, to, expected) in [
        ("units=\"mm\"", "units=\"mile\"", "structure.xml: line 3: the unit 'mile' is unknown"),
        ("cube.obj", "other.obj", "structure.xml: line 3: 'cube/other.obj' is not in the archive"),
        ("geometryId=\"cube\"", "geometryId=\"ball\"", "structure.xml: line 4: no geometry 'ball' is defined"),
        ("x=\"2\"", "x=\"far\"", "structure.xml: line 5: <Position> has no three numbers"),
        ("diameter=\"0.1\"", "diameter=\"0\"", "structure.xml: line 7: the light emitting object has a shape without a size"),
    ] {
        let bytes = whole(&text.replacen(from, to, 1));
        let model = L3d::read(&bytes).unwrap();
        assert!(model.warnings.iter().any(|warning| warning.to_string().starts_with(expected)), "{:?}", model.warnings);
    }
}

fn deep() -> String {
    let open = "<Geometry><Joints><Joint><Geometries>".repeat(70);
    let close = "</Geometries></Joint></Joints></Geometry>".repeat(70);
    format!("<Luminaire><Structure>{open}{close}</Structure></Luminaire>")
}
