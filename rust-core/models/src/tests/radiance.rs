//! Radiance scenes.

use super::{area, model, told};
use gonio_scene::LightShape;
use std::f64::consts::PI;

const MATERIALS: &str = "void plastic grey 0 0 5 .5 .5 .5 0 0\nvoid light lamp\n0\n0\n3 10 10 10\n";

fn scene(text: &str) -> crate::Model {
    model("a.rad", &format!("{MATERIALS}{text}"))
}

#[test]
fn surfaces_have_their_areas() {
    let found = scene(
        "grey polygon p 0 0 12 0 0 0 2 0 0 2 3 0 0 3 0 # a comment\n# another\ngrey sphere s 0 0 4 0 0 0 2\ngrey cylinder c 0 0 7 0 0 0 0 0 5 1\n\
         grey cone k 0 0 8 0 0 0 0 0 4 3 0\ngrey ring r 0 0 8 0 0 1 0 0 1 1 2\ngrey bubble b 0 0 4 9 9 9 1\ngrey tube t 0 0 7 0 0 0 1 0 0 1\n\
         grey cup u 0 0 8 0 0 0 0 0 1 1 2\n",
    );
    assert!(told(&found).is_empty(), "{:?}", told(&found));
    for (name, expected) in [("p", 6.0), ("s", 16.0 * PI), ("c", 10.0 * PI), ("k", 15.0 * PI), ("r", 3.0 * PI), ("t", 2.0 * PI)] {
        let found = area(&found, name);
        assert!((found / expected - 1.0).abs() < 2e-3, "{name}: {found}, expected {expected}");
    }
}

#[test]
fn lamps_shine_by_their_radiance() {
    let found = scene(
        "lamp sphere s 0 0 4 1 2 3 .5\nlamp source sun 0 0 4 0 0 1 .5\nlamp source sky 0 0 4 0 0 1 180\nlamp polygon p 0 0 9 0 0 0 1 0 0 0 1 0\n",
    );
    let lights = &found.scene.lights;
    assert_eq!(lights.len(), 3);
    // 179 lm/W, as Radiance has it.
    assert!((lights[0].emission.radiance[1] - 1790.0).abs() < 1e-2);
    assert_eq!(lights[0].shape, LightShape::Sphere { radius: 0.5 });
    assert_eq!(lights[1].shape, LightShape::Distant { angle_deg: 0.5 });
    // It shines along −z, downwards.
    assert_eq!(lights[1].transform.columns[2], [0.0, 0.0, 1.0]);
    assert!(matches!(lights[2].shape, LightShape::Dome { .. }));
    assert!((area(&found, "p") - 0.5).abs() < 1e-6);
}

#[test]
fn commands_place_copies() {
    let found = scene("!genbox grey box 1 2 3 | xform -s 2 -t 10 0 0 -a 3 -t 0 5 0\n!genbox grey in 1 1 1 -i | xform -mx\n");
    assert!(told(&found).is_empty(), "{:?}", told(&found));
    assert_eq!(found.scene.meshes.len(), 24);
    let place = |number: usize| found.scene.instances[number].transforms[0].columns[3];
    let corners = |mesh: usize| {
        let at = place(mesh);
        found.scene.meshes[mesh].points.iter().map(|p| [0, 1, 2].map(|i| f64::from(p[i]) + at[i])).collect::<Vec<_>>()
    };
    let all: Vec<[f64; 3]> = (0..18).flat_map(corners).collect();
    let range = |axis: usize| all.iter().map(|p| p[axis]).fold([f64::MAX, f64::MIN], |[a, b], x| [a.min(x), b.max(x)]);
    assert_eq!([range(0), range(1), range(2)], [[10.0, 12.0], [0.0, 14.0], [0.0, 6.0]]);
    // Faces of a box look outwards, of one turned inside out inwards, mirrored or not.
    for (boxes, sign) in [(0..18, 1.0), (18..24, -1.0)] {
        for mesh in boxes {
            let corners = corners(mesh);
            let base = mesh / 6 * 6;
            let every: Vec<[f64; 3]> = (base..base + 6).flat_map(corners_of(&found)).collect();
            let middle: [f64; 3] = std::array::from_fn(|i| every.iter().map(|p| p[i]).sum::<f64>() / every.len() as f64);
            let triangle = found.scene.meshes[mesh].triangles[0].map(|i| corners[i as usize]);
            let normal = crate::vector::newell(&triangle);
            assert!(crate::vector::dot(normal, crate::vector::sub(triangle[0], middle)) * sign > 0.0, "{mesh}");
        }
    }
}

fn corners_of(model: &crate::Model) -> impl Fn(usize) -> Vec<[f64; 3]> + '_ {
    |mesh| {
        let at = model.scene.instances[mesh].transforms[0].columns[3];
        model.scene.meshes[mesh].points.iter().map(|p| [0, 1, 2].map(|i| f64::from(p[i]) + at[i])).collect()
    }
}

#[test]
fn rotations_run_as_radiance_has_them() {
    let found = scene("!genbox grey box 1 1 1 | xform -rz 90 -t 5 0 0\n");
    let xs = found.scene.instances.iter().map(|set| set.transforms[0].columns[3]);
    // About z by 90°, x becomes y and y becomes −x.
    assert!(
        xs.clone().all(|p| p[0] < 5.0 + 1e-9 && p[0] > 4.0 - 1e-9 && p[1] > -1e-9 && p[1] < 1.0 + 1e-9),
        "{:?}",
        xs.collect::<Vec<_>>()
    );
}

#[test]
fn views_in_comments_become_cameras() {
    let found = scene("# rvu -vtv -vp 1 2 3 -vd 0 1 0 -vu 0 0 1 -vh 60 -vv 40\n# what follows is no view\n");
    assert_eq!(found.scene.cameras.len(), 1);
    assert_eq!(found.scene.cameras[0].transform.columns[3], [1.0, 2.0, 3.0]);
}

#[test]
fn what_is_wrong_is_told_with_its_line_and_the_rest_is_read() {
    let good = "grey polygon good 0 0 9 0 0 0 1 0 0 0 1 0\n";
    for (bad, line, expected) in [
        ("!rm -rf /\n", 6, "rm is not run"),
        ("!gensky 6 21 12\n", 6, "--sun"),
        ("!xform -t 1 nothing.rad\n", 6, "expected a number"),
        ("!xform nothing.rad\n", 6, "nothing.rad"),
        ("!genbox grey box `id` 1 1\n", 6, "without a shell"),
        ("nobody polygon p 0 0 9 0 0 0 1 0 0 0 1 0\n", 6, "there is no modifier 'nobody'"),
        ("grey polygon p 0 0 8 0 0 0 1 0 0 0 1\n", 6, "8 numbers"),
        ("grey polygon p 0 0 9 0 0 0 1 0 0 nan 1 0\n", 6, "expected a number"),
        ("grey polygon p 0 0 9 0 0 0 1 0 0 2 0 0\n", 6, "on a line"),
        ("grey pyramid p 0 0 1 1\n", 6, "'pyramid' was found"),
        ("grey polygon p 0 0 99999999999 1 2\n", 7, "expected a number"),
        ("grey instance i 1 a.oct 0 0\n", 6, "octrees"),
        ("void plastic bad 0 0 5 .5 .5 .5 2 0\n", 6, "specularity 2"),
        ("grey sphere s 0 0 4 0 0 0 -1\n", 6, "radius -1"),
    ] {
        let found = scene(&format!("{bad}{good}"));
        let told = told(&found);
        assert_eq!(told.len(), 1, "{bad}: {told:?}");
        assert!(told[0].contains(&format!("a.rad:{line}")) && told[0].contains(expected), "{bad}: {told:?}");
        let is_there = found.scene.meshes.iter().any(|mesh| &*mesh.origin.name == "good");
        assert!(is_there, "{bad}: the rest is read");
    }
}

#[test]
fn a_sky_by_a_pattern_is_no_sky() {
    let found = scene(
        "void brightfunc skyfunc 2 skybr skybright.cal 0 7 1 2 3 4 5 6 7\nskyfunc glow sky_glow 0 0 4 1 1 1 0\nsky_glow source sky 0 0 4 0 0 1 180\n",
    );
    assert!(found.scene.lights.is_empty());
    assert!(told(&found).iter().any(|line| line.contains("its pattern 'skyfunc' is not read")), "{:?}", told(&found));
}

#[test]
fn files_in_files_end() {
    let folder = std::env::temp_dir().join(format!("gonio-models-{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("a folder");
    let path = folder.join("loop.rad");
    std::fs::write(&path, "!xform -t 1 0 0 loop.rad\nvoid plastic grey 0 0 5 .5 .5 .5 0 0\ngrey sphere s 0 0 4 0 0 0 1\n").expect("a file");
    let found = crate::read(&path, &crate::Options::default()).expect("a scene");
    std::fs::remove_dir_all(&folder).expect("it was made");
    assert!(told(&found).iter().any(|line| line.contains("within one another")), "{:?}", told(&found));
}
