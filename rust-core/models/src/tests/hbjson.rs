//! Honeybee models.

use super::{area, model, told, try_model};
use gonio_scene::{LightShape, Projection};

/// A room of 4 m by 3 m by 3 m whose south wall has a window of 2 m by 1 m; more keys of the model and of the window.
fn room(model: &str, window: &str, more: &str) -> String {
    format!(
        r#"{{"type": "Model", "identifier": "m", "units": "Meters", {model}
        "properties": {{"type": "ModelProperties", "radiance": {{"type": "ModelRadianceProperties" {more}}}}},
        "rooms": [{{"type": "Room", "identifier": "r", "properties": {{}}, "faces": [
          {{"type": "Face", "identifier": "floor", "face_type": "Floor", "boundary_condition": {{"type": "Ground"}}, "properties": {{}},
            "geometry": {{"type": "Face3D", "boundary": [[0,0,0],[0,3,0],[4,3,0],[4,0,0]]}}}},
          {{"type": "Face", "identifier": "south", "face_type": "Wall", "boundary_condition": {{"type": "Outdoors"}}, "properties": {{}},
            "geometry": {{"type": "Face3D", "boundary": [[0,0,0],[4,0,0],[4,0,3],[0,0,3]]}},
            "apertures": [{{"type": "Aperture", "identifier": "window", "boundary_condition": {{"type": "Outdoors"}}, "is_operable": false,
              "properties": {{"radiance": {{ {window} }}}},
              "geometry": {{"type": "Face3D", "boundary": [[1,0,1],[3,0,1],[3,0,2],[1,0,2]]}}}}]}}]}}]}}"#
    )
}

fn number(model: &crate::Model, material: &str, name: &str) -> f32 {
    let material = model.scene.materials.iter().find(|found| &*found.origin.name == material).expect("the material");
    match material.closures[0].input(name) {
        Some(gonio_scene::Input::Constant(value)) => value[0],
        other => panic!("{other:?}"),
    }
}

#[test]
fn a_window_is_cut_out_of_its_wall_and_all_has_honeybees_modifiers() {
    let found = model("a.hbjson", &room("", "", ""));
    assert!(told(&found).is_empty(), "{:?}", told(&found));
    for (name, expected) in [("floor", 12.0), ("south", 10.0), ("window", 2.0)] {
        assert!((area(&found, name) - expected).abs() < 1e-6, "{name}");
    }
    assert_eq!(number(&found, "generic_floor_0.20", "base_color"), 0.2);
    assert_eq!(number(&found, "generic_wall_0.50", "base_color"), 0.5);
    assert!((number(&found, "generic_exterior_window_vis_0.64", "transmission_color") - 0.697576).abs() < 1e-6);
    assert_eq!(number(&found, "generic_exterior_window_vis_0.64", "specular_ior"), 1.52);
    assert_eq!((found.counts["Face"], found.counts["Aperture"]), (2, 1));
}

#[test]
fn units_become_metres() {
    let found = model("a.hbjson", &room("", "", "").replace("Meters", "Feet"));
    assert!((area(&found, "floor") - 12.0 * 0.3048 * 0.3048).abs() < 1e-6);
    let error = try_model("a.hbjson", &room("", "", "").replace("Meters", "Cubits")).expect_err("no unit");
    assert!(error.to_string().contains("units are 'Cubits', expected Meters"), "{error}");
}

#[test]
fn modifiers_are_by_name_and_wrong_ones_are_told_with_their_place() {
    let more = r#", "modifiers": [{"type": "Glass", "identifier": "clear", "r_transmissivity": 0.9, "g_transmissivity": 0.9,
        "b_transmissivity": 0.9, "refraction_index": null}, {"type": "Plastic", "identifier": "odd", "r_reflectance": 7}]"#;
    let found = model("a.hbjson", &room("", r#""modifier": "clear""#, more));
    assert!((number(&found, "clear", "transmission_color") - 0.9).abs() < 1e-6);
    for (asked, problem) in [("odd", "reflectance 7 was found"), ("nobody", "there is no modifier 'nobody'")] {
        let found = model("a.hbjson", &room("", &format!(r#""modifier": "{asked}""#), more));
        let told = told(&found);
        assert_eq!(told.len(), 1, "{told:?}");
        assert!(told[0].starts_with("window (a.hbjson: rooms[0].faces[1].apertures[0])") && told[0].contains(problem), "{told:?}");
        assert!((area(&found, "window") - 2.0).abs() < 1e-6);
    }
}

#[test]
fn states_are_chosen() {
    let window = r#""dynamic_group_identifier": "g", "states": [{"modifier": "black"}, {"modifier": "generic_interior_window_vis_0.88"}]"#;
    let text = room("", window, "");
    let found = model("a.hbjson", &text);
    assert!(told(&found)[0].contains("--state g=N"), "{:?}", told(&found));
    let of_window = |model: &crate::Model| {
        let set = model.scene.instances.iter().find(|set| &*set.origin.name == "window").expect("the window");
        model.scene.materials[set.materials[0].index()].origin.name.to_string()
    };
    assert_eq!(of_window(&found), "black");
    let read = |states: &[(&str, usize)]| {
        let states = states.iter().map(|(name, number)| ((*name).to_owned(), *number)).collect();
        crate::hbjson::read("a.hbjson".as_ref(), &text, &crate::Options { states })
    };
    assert_eq!(of_window(&read(&[("g", 1)]).expect("a model")), "generic_interior_window_vis_0.88");
    assert!(read(&[("g", 2)]).expect_err("no such state").to_string().contains("0 to 1"));
    assert!(read(&[("h", 0)]).expect_err("no such group").to_string().contains("the model has g"));
}

#[test]
fn grids_views_and_luminaires_are_read() {
    let ies = r"IESNA:LM-63-2002\nTILT=NONE\n1 1000 1 3 1 1 2 0 0 0\n1 1 100\n0 45 90\n0\n100 100 0\n";
    let more = format!(
        r#", "sensor_grids": [{{"type": "SensorGrid", "identifier": "g", "sensors": [{{"pos": [1,1,0.8], "dir": [0,0,2]}}, {{"pos": [1,1], "dir": [0,0,1]}}]}}],
        "views": [{{"type": "View", "identifier": "v", "position": [2,2,1.5], "direction": [0,-1,0], "up_vector": [0,0,1], "view_type": "v"}},
          {{"type": "View", "identifier": "up", "position": [2,2,1.5], "direction": [0,0,1], "up_vector": [0,0,1]}}],
        "luminaires": [{{"type": "Luminaire", "identifier": "l", "ies_content": "{ies}", "light_loss_factor": 0.5, "luminaire_zone":
          {{"instances": [{{"point": {{"type": "Point3D", "x": 2, "y": 1, "z": 3}}, "tilt": 90}}]}}}}]"#
    );
    let found = model("a.hbjson", &room("", "", &more));
    let told = told(&found);
    assert_eq!(told.len(), 2, "{told:?}");
    assert!(told[0].contains("sensor_grids[0].sensors[1]") && told[0].contains("three numbers"), "{told:?}");
    assert!(told[1].contains("views[1]") && told[1].contains("up vector"), "{told:?}");
    let scene = &found.scene;
    assert_eq!((scene.meters.len(), scene.cameras.len(), scene.lights.len()), (1, 1, 1));
    assert_eq!((&*scene.meters[0].origin.name, scene.meters[0].normal), ("g/0", [0.0, 0.0, 1.0]));
    assert!(matches!(scene.cameras[0].projection, Projection::Perspective { .. }));
    assert!((scene.cameras[0].aperture[0] - 2.0 * 30.0_f64.to_radians().tan()).abs() < 1e-12);
    let light = &scene.lights[0];
    assert!(matches!(light.shape, LightShape::Opening(_)) && light.dimming == 0.5);
    // Tilted by 90° about y, what shone down shines along −x.
    let down = light.transform.vector([0.0, 0.0, -1.0]);
    assert!((down[0] + 1.0).abs() < 1e-12, "{down:?}");
}

#[test]
fn broken_files_are_errors_with_their_line() {
    let text = room("", "", "");
    for (text, expected) in [
        (&text[..text.len() / 2], "no JSON"),
        ("", "no JSON"),
        (&text.replace("[0,3,0]", "[0,NaN,0]"), "a.hbjson:5: this is no JSON"),
        (r#"{"type": "Room"}"#, "type 'Room' was found, expected a honeybee Model"),
        ("[1, 2]", "expected a honeybee Model"),
    ] {
        let error = try_model("a.hbjson", text).expect_err("a broken file").to_string();
        assert!(error.contains(expected), "{error}");
    }
}

#[test]
fn one_bad_object_leaves_the_rest() {
    let text = room("", "", "");
    for (from, to, expected) in [
        ("[[0,0,0],[0,3,0],[4,3,0],[4,0,0]]", "[[0,0,0],[0,3,0]]", "2 corners"),
        ("[[0,0,0],[0,3,0],[4,3,0],[4,0,0]]", "[[0,0,0],[1,0,0],[2,0,0]]", "on a line"),
        ("[[0,0,0],[0,3,0],[4,3,0],[4,0,0]]", "\"square\"", "0 corners"),
        ("[[0,0,0],[0,3,0],[4,3,0],[4,0,0]]", "[[0,0,0],[0,\"3\",0],[4,3,0]]", "expected three numbers"),
        (r#""face_type": "Floor""#, r#""face_type": "Hatch""#, "face type 'Hatch'"),
    ] {
        let found = model("a.hbjson", &text.replacen(from, to, 1));
        let told = told(&found);
        assert!(told.len() == 1 && told[0].contains("floor (a.hbjson: rooms[0].faces[0])") && told[0].contains(expected), "{told:?}");
        assert_eq!(found.scene.meshes.len(), 2);
    }
}
