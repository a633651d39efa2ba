//! Luminous openings: what they are made of, and that from afar they are their goniogram.

use super::{goniogram, illuminance, openings, openings_of_all_forms, placed, table};
use crate::compile::goniograms::CompiledGoniograms;
use crate::light::{FarField, Goniogram as GoniogramTable, LightKind, LightRecord, OpeningPart};
use crate::scene::{LightShape, Opening, OpeningShape, Transform};
use gonio_simd::{One, Vec3};

const DIRECTIONS: u64 = 400;

/// Directions in the luminaire's frame, evenly over the sphere (Fibonacci's lattice).
fn directions() -> impl Iterator<Item = [f64; 3]> {
    (0..DIRECTIONS).map(|k| {
        let z = 1.0 - (2.0 * k as f64 + 1.0) / DIRECTIONS as f64;
        let (sine, cosine) = (2.399_963_229_728_653 * k as f64).sin_cos();
        let r = (1.0 - z * z).sqrt();
        [r * cosine, r * sine, z]
    })
}

fn factor(table: &GoniogramTable, w: [f64; 3]) -> f64 {
    f64::from(table.factor(One, Vec3::splat(One, w.map(|x| x as f32))).to_array()[0])
}

/// Kinds of the emitters, and for flat ones where they look, in the luminaire's frame.
fn made_of(opening: &Opening, last_deg: f32) -> Vec<(LightKind, [i32; 3])> {
    let light = placed(LightShape::Opening(*opening), Some(goniogram(last_deg)));
    let mut goniograms = CompiledGoniograms::default();
    let number = goniograms.number(&light, &mut Vec::new()).expect("a table") as usize;
    let parts = openings::parts(opening, &Transform::IDENTITY, Some(&goniograms.tables[number]));
    let looks = |part: &openings::Part| if part.kind.is_flat() { part.placed.columns[2].map(|x| -x.round() as i32) } else { [0; 3] };
    parts.iter().map(|part| (part.kind, looks(part))).collect()
}

#[test]
fn every_form_is_made_of_its_surfaces() {
    use LightKind::{Cylinder, Disk, Point, Rectangle, Sphere};
    let (down, up) = ([0, 0, -1], [0, 0, 1]);
    let ([east, north], [west, south]) = ([[1, 0, 0], [0, 1, 0]], [[-1, 0, 0], [0, -1, 0]]);
    let sides = [(Rectangle, east), (Rectangle, north), (Rectangle, west), (Rectangle, south)];
    let opening = |shape, size| Opening::new(shape, size);
    let faces = |first: &[(LightKind, [i32; 3])], rest: &[(LightKind, [i32; 3])]| [first, rest].concat();
    let body = |kind| (kind, [0; 3]);
    for (opening, last, expected) in [
        (opening(OpeningShape::Point, [0.0; 3]), 180.0, vec![body(Point)]),
        (opening(OpeningShape::Rectangle, [1.2, 0.3, 0.0]), 80.0, vec![(Rectangle, down)]),
        (opening(OpeningShape::Rectangle, [1.2, 0.3, 0.0]), 90.0, vec![(Rectangle, down)]),
        // Light beyond the plane asks for sides, and for a top where there is some above.
        (opening(OpeningShape::Rectangle, [1.2, 0.3, 0.0]), 100.0, faces(&[(Rectangle, down), (Rectangle, up)], &sides)),
        (opening(OpeningShape::Rectangle, [1.2, 0.3, 0.0]), 180.0, faces(&[(Rectangle, down), (Rectangle, up)], &sides)),
        (opening(OpeningShape::Box, [0.6, 0.4, 0.2]), 80.0, faces(&[(Rectangle, down)], &sides)),
        (opening(OpeningShape::Disk, [0.4, 0.4, 0.0]), 80.0, vec![(Disk, down)]),
        (opening(OpeningShape::Disk, [0.4, 0.4, 0.0]), 180.0, vec![body(Cylinder), (Disk, down), (Disk, up)]),
        (opening(OpeningShape::VerticalCylinder, [0.4, 0.4, 0.2]), 90.0, vec![body(Cylinder), (Disk, down)]),
        (opening(OpeningShape::CylinderAlongX, [1.2, 0.1, 0.1]), 180.0, vec![body(Cylinder), (Disk, west), (Disk, east)]),
        (opening(OpeningShape::CylinderAlongY, [0.1, 1.2, 0.1]), 180.0, vec![body(Cylinder), (Disk, south), (Disk, north)]),
        (opening(OpeningShape::Ellipsoid, [0.1, 1.2, 0.1]), 180.0, vec![body(Sphere)]),
        (opening(OpeningShape::DiskFacingX, [0.0, 0.3, 0.3]), 180.0, vec![body(Cylinder), (Disk, west), (Disk, east)]),
    ] {
        assert_eq!(made_of(&opening, last), expected, "{opening:?} up to {last} degrees");
    }
}

#[test]
fn disks_that_face_sideways_look_along_their_planes() {
    // Light on one side of the luminaire alone.
    let mut half = (*goniogram(180.0)).clone();
    for (h, plane) in half.factors.chunks_exact_mut(13).enumerate() {
        let lit = |v: usize| (5..8).contains(&v) && matches!(h, 0 | 1 | 11 | 12);
        plane.iter_mut().enumerate().for_each(|(v, x)| *x = if lit(v) { 100.0 } else { 0.0 });
    }
    let light = placed(LightShape::Point, Some(std::sync::Arc::new(half)));
    let mut goniograms = CompiledGoniograms::default();
    let number = goniograms.number(&light, &mut Vec::new()).expect("a table") as usize;
    let facing = Opening::new(OpeningShape::DiskFacingX, [0.0, 0.4, 0.2]);
    let parts = openings::parts(&facing, &Transform::IDENTITY, Some(&goniograms.tables[number]));
    assert_eq!(parts.len(), 1);
    assert_eq!((parts[0].kind, parts[0].placed.columns[2]), (LightKind::Disk, [-1.0, 0.0, 0.0]));
    assert_eq!(parts[0].placed.columns[0], [0.0, 0.2, 0.0]);
    assert_eq!(parts[0].placed.columns[1], [0.0, 0.0, 0.1]);
}

#[test]
fn sizes_and_places_of_a_boxs_sides() {
    let opening = Opening { shape: OpeningShape::Box, size: [0.6, 0.4, 0.2], heights: [0.2, 0.1, 0.0, 0.15] };
    let parts = openings::parts(&opening, &Transform::IDENTITY, None);
    let found: Vec<[[f64; 3]; 3]> = parts.iter().map(|p| [p.placed.columns[0], p.placed.columns[1], p.placed.columns[3]]).collect();
    let expected = [
        [[0.3, 0.0, 0.0], [0.0, 0.2, 0.0], [0.0, 0.0, -0.1]],
        [[0.3, 0.0, 0.0], [0.0, 0.2, 0.0], [0.0, 0.0, 0.1]],
        [[0.0, 0.2, 0.0], [0.0, 0.0, 0.1], [0.3, 0.0, 0.0]],
        [[0.3, 0.0, 0.0], [0.0, 0.0, 0.05], [0.0, 0.2, -0.05]],
        [[0.3, 0.0, 0.0], [0.0, 0.0, 0.075], [0.0, -0.2, -0.025]],
    ];
    assert_eq!(found.len(), expected.len());
    for (a, b) in found.iter().flatten().flatten().zip(expected.iter().flatten().flatten()) {
        assert!((a - b).abs() < 1e-12, "{found:?}");
    }
    let share: f32 = parts.iter().filter_map(|part| part.opening).map(|part: OpeningPart| part.share).sum();
    assert!((share - 1.0).abs() < 1e-6, "{share}");
}

#[test]
fn the_far_field_is_the_goniogram() {
    for last in [70.0, 90.0, 180.0] {
        for opening in openings_of_all_forms() {
            let light = placed(LightShape::Opening(opening), Some(goniogram(last)));
            let mut goniograms = CompiledGoniograms::default();
            let number = goniograms.number(&light, &mut Vec::new());
            let own = goniograms.tables[0].clone();
            let record = |part: &openings::Part| LightRecord {
                to_world: part.placed.columns.map(|column| column.map(|x| x as f32)),
                opening: part.opening,
                goniogram: number,
                ..LightRecord::new(part.kind)
            };
            let records: Vec<LightRecord> = openings::parts(&opening, &light.transform, Some(&own)).iter().map(record).collect();
            let far = FarField::new(&records, &goniograms.tables);
            for w in directions() {
                let (found, expected) = (far.towards(w)[0], factor(&own, w));
                // A box whose sides are of several heights is dark along the plane of its lowest edge.
                assert!((found - expected).abs() <= 2e-4 * expected.max(1.0), "{opening:?} to {last}, {w:?}: {found} for {expected}");
            }
        }
    }
}

#[test]
fn fifty_sizes_away_illuminance_is_intensity_over_distance_squared() {
    for opening in openings_of_all_forms() {
        let light = placed(LightShape::Opening(opening), Some(goniogram(180.0)));
        let (transform, own) = (light.transform, goniogram(180.0));
        let mut goniograms = CompiledGoniograms::default();
        goniograms.number(&light, &mut Vec::new());
        let (table, problems) = table(light);
        assert_eq!(problems, Vec::<String>::new());
        let distance = 50.0 * opening.size.iter().copied().fold(0.1, f64::max);
        for w in directions().step_by(16) {
            let world = transform.vector(w);
            let p = [0, 1, 2].map(|k| transform.columns[3][k] + distance * world[k]);
            let expected = factor(&goniograms.tables[0], w) / (distance * distance);
            let [found, error] = illuminance(&table, p, world.map(|x| -x), 24);
            // The opening is not a point, its parts see the goniogram under other angles: up to a hundredth of a radian on 500 cd in 15 degrees.
            let slope = 0.01 * 500.0 / 0.26 / (distance * distance);
            let allowed = 5.0 * error + 0.25 * slope + 2e-3 * expected;
            assert!((found - expected).abs() < allowed, "{opening:?} towards {w:?}: {found} ± {error} for {expected}, {own:?}");
        }
    }
}

#[test]
fn all_of_the_flux_arrives_in_a_black_box() {
    // Illuminance over the faces of a cube of 3 m about the luminaire, times their area.
    const SIDE: f64 = 3.0;
    const CELLS: u64 = 24;
    for opening in openings_of_all_forms() {
        let light = placed(LightShape::Opening(opening), Some(goniogram(180.0)));
        let transform = light.transform;
        let mut goniograms = CompiledGoniograms::default();
        let number = goniograms.number(&light, &mut Vec::new()).expect("a table");
        let expected = goniograms.flux(number);
        let (table, _) = table(light);
        let (mut sum, mut variance) = (0.0, 0.0);
        for face in 0..6 {
            for cell in 0..CELLS * CELLS {
                let at = |k: u64, j: u64| ((k as f64 + super::uniform(face * 10_007 + cell * 2 + j)) / CELLS as f64 - 0.5) * SIDE;
                let (u, v) = (at(cell % CELLS, 0), at(cell / CELLS, 1));
                let axis = (face / 2) as usize;
                let sign = if face % 2 == 0 { 1.0 } else { -1.0 };
                let (mut local, mut normal) = ([0.0; 3], [0.0; 3]);
                local[axis] = sign * SIDE / 2.0;
                (local[(axis + 1) % 3], local[(axis + 2) % 3]) = (u, v);
                normal[axis] = -sign;
                let [value, _] = illuminance(&table, transform.point(local), transform.vector(normal), 4);
                sum += value;
                variance += value * value;
            }
        }
        let n = (6 * CELLS * CELLS) as f64;
        let area = 6.0 * SIDE * SIDE;
        // Stratification makes the error smaller than that of independent points.
        let (found, error) = (sum / n * area, (variance / n - (sum / n).powi(2)).sqrt() / n.sqrt() * area);
        assert!((found - expected).abs() < 3.0 * error, "{opening:?}: {found} ± {error} lm for {expected} lm");
        assert!(error < 0.02 * expected, "{opening:?}: {error}");
    }
}
