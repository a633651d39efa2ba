//! One light of each kind with each of what can change its emission.

use crate::tests::harness::{light, turned};
use crate::vector::widen;
use crate::{AngularType, Goniogram, LightKind, LightRecord, LightTable, LightTexture, OpeningPart, ProjectedArea, Shaping, Spot};
use std::sync::Arc;

/// A light and what to call it.
pub(super) struct Case {
    pub(super) name: String,
    pub(super) record: LightRecord,
}

pub(super) const AT: [f32; 3] = [0.2, 0.1, 2.0];
const STRAIGHT: [[f32; 3]; 3] = [[0.8, 0.0, 0.0], [0.0, 0.5, 0.0], [0.0, 0.0, 0.6]];
const SHEARED: [[f32; 3]; 3] = [[0.7, 0.2, 0.1], [0.4, 0.6, -0.1], [0.05, 0.1, 0.9]];

fn uneven(width: usize, height: usize) -> LightTexture {
    let value = |i: usize| {
        let (x, y) = (i % width, i / width);
        let spot = if (2..4).contains(&x) && y == 1 { 20.0 } else { 0.3 };
        [spot + 0.1 * x as f32, spot, 0.2 * y as f32]
    };
    LightTexture { width, height, rgb: (0..width * height).flat_map(value).collect() }
}

/// Images: one for rectangles, one for domes.
pub(super) fn textures() -> Vec<LightTexture> {
    vec![uneven(9, 6), uneven(32, 16)]
}

/// A downlight that is not the same all around, and one of type B.
pub(super) fn goniograms() -> Vec<Arc<Goniogram>> {
    let (planes, polar) = ([0.0, 90.0, 180.0, 270.0, 360.0], [0.0, 15.0, 30.0, 45.0, 60.0, 75.0, 90.0, 110.0]);
    let down: Vec<f32> = [1.0, 0.6, 0.3, 0.6, 1.0]
        .iter()
        .flat_map(|side| {
            polar.map(
                |angle: f32| if angle > 100.0 { 0.0 } else { side * (2.0 - angle / 60.0) * angle.to_radians().sin().mul_add(2.0, 0.3) },
            )
        })
        .collect();
    let across = [-60.0, -20.0, 0.0, 20.0, 60.0];
    let flood: Vec<f32> = (0..25).map(|i| [0.0, 0.4, 1.0, 0.5, 0.0][i / 5] * [0.0, 0.7, 1.0, 0.7, 0.0][i % 5]).collect();
    [(AngularType::C, &planes[..], &polar[..], &down), (AngularType::B, &across[..], &across[..], &flood)]
        .into_iter()
        .map(|(kind, horizontal, vertical, factors)| Arc::new(Goniogram::new(kind, horizontal, vertical, factors).expect("a table")))
        .collect()
}

pub(super) fn table(records: &[LightRecord]) -> LightTable {
    LightTable::build(records, &textures(), &goniograms())
}

const CONE: Shaping = Shaping { cone_angle: 0.7, softness: 0.4, focus: 0.0, focus_tint: [0.0; 3] };
const FOCUS: Shaping = Shaping { cone_angle: f32::INFINITY, softness: 0.0, focus: 8.0, focus_tint: [0.2, 0.1, 0.0] };
const SPOT: Spot = Spot { angle: 1.2, blend: 0.3, stretch: [1.0, 1.0] };

fn beams(base: LightRecord, name: &str, into: &mut Vec<Case>) {
    let mut put = |what: &str, record: LightRecord| into.push(Case { name: format!("{name} {what}"), record });
    put("plain", base);
    put("in a cone", LightRecord { shaping: CONE, ..base });
    put("focused", LightRecord { shaping: FOCUS, ..base });
    put("spot", LightRecord { spot: Some(SPOT), ..base });
    put("measured", LightRecord { goniogram: Some(0), ..base });
}

/// Bodies whose radiance is an intensity over what the whole shows.
fn openings(into: &mut Vec<Case>) {
    let axes = turned([0.5, 0.3, 0.2], [0.2, 0.4, -0.3]);
    let wide = axes.map(widen);
    let faces = ProjectedArea::of_faces(&[(0, [0.0, 0.0, -1.6]), (0, [0.0, 0.0, 1.6]), (1, [0.4, 0.0, 0.0])]);
    let parts = [
        ("face", LightKind::Rectangle, STRAIGHT, faces),
        ("tube", LightKind::Cylinder, axes, ProjectedArea::of_cylinder(wide)),
        ("ellipsoid", LightKind::Sphere, axes, ProjectedArea::of_ellipsoid(wide)),
    ];
    for (name, kind, axes, area) in parts {
        let part = OpeningPart { area, share: 1.0, axes: turned([1.0; 3], [0.1, 0.2, 0.3]) };
        let record = LightRecord { opening: Some(part), ..light(kind, axes, AT) };
        into.push(Case { name: format!("{name} opening"), record });
        into.push(Case { name: format!("{name} opening measured"), record: LightRecord { goniogram: Some(0), ..record } });
        into.push(Case { name: format!("{name} opening measured B"), record: LightRecord { goniogram: Some(1), ..record } });
    }
}

/// Lights with a place.
pub(super) fn finite() -> Vec<Case> {
    let mut all = Vec::new();
    for kind in [LightKind::Rectangle, LightKind::Disk, LightKind::Sphere, LightKind::Cylinder] {
        beams(light(kind, STRAIGHT, AT), &format!("{kind:?}"), &mut all);
        beams(light(kind, SHEARED, AT), &format!("sheared {kind:?}"), &mut all);
    }
    for (what, size) in [("ball", [0.3; 3]), ("round tube", [0.8, 0.1, 0.1])] {
        let kind = if what == "ball" { LightKind::Sphere } else { LightKind::Cylinder };
        beams(light(kind, turned(size, [0.3, -0.2, 0.7]), AT), what, &mut all);
    }
    beams(light(LightKind::Point, turned([1.0; 3], [0.3, -0.2, 0.7]), AT), "Point", &mut all);
    beams(light(LightKind::FacingDisk, turned([0.2; 3], [0.3, -0.2, 0.7]), AT), "FacingDisk", &mut all);
    let flipped = [[0.7, 0.2, 0.1], [-0.4, -0.6, 0.1], [0.05, 0.1, 0.9]];
    beams(light(LightKind::Triangle, flipped, AT), "Triangle", &mut all);
    for axes in [STRAIGHT, SHEARED] {
        for kind in [LightKind::Rectangle, LightKind::Disk, LightKind::Triangle] {
            let both = LightRecord { two_sided: true, ..light(kind, axes, AT) };
            beams(both, &format!("two-sided {kind:?}"), &mut all);
            for spread in [2.4, 0.55, 0.05] {
                let record = LightRecord { spread, ..light(kind, axes, AT) };
                all.push(Case { name: format!("{kind:?} spread {spread}"), record });
            }
        }
        beams(LightRecord { texture: Some(0), ..light(LightKind::Rectangle, axes, AT) }, "textured Rectangle", &mut all);
    }
    let wide = Spot { angle: 2.0, blend: 0.0, stretch: [1.5, 0.7] };
    for kind in [LightKind::Point, LightKind::Rectangle] {
        let record = LightRecord { spot: Some(wide), ..light(kind, STRAIGHT, AT) };
        all.push(Case { name: format!("{kind:?} stretched spot"), record });
    }
    let thin = Spot { angle: 0.02, blend: 0.5, stretch: [1.0; 2] };
    all.push(Case { name: "thin spot".into(), record: LightRecord { spot: Some(thin), ..light(LightKind::Point, STRAIGHT, AT) } });
    openings(&mut all);
    for case in &mut all {
        case.record.radiance = [2.0, 1.0, 0.5];
    }
    all
}

/// Lights without a place.
pub(super) fn infinite() -> Vec<Case> {
    let axes = turned([1.0; 3], [0.4, 0.1, 0.3]);
    let mut all = Vec::new();
    for angle in [0.0, 0.0093, 0.5, 2.5, 4.0] {
        let record = LightRecord { angle, ..light(LightKind::Distant, axes, [0.0; 3]) };
        all.push(Case { name: format!("Distant {angle}"), record });
    }
    for texture in [None, Some(1)] {
        let record = LightRecord { texture, ..light(LightKind::Dome, axes, [0.0; 3]) };
        all.push(Case { name: format!("Dome {texture:?}"), record });
    }
    for case in &mut all {
        case.record.radiance = [2.0, 1.0, 0.5];
    }
    all
}
