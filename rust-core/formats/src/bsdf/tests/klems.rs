//! Matrices over patches, and their XML.

use core::f64::consts::PI;

use super::super::direction::through;
use super::super::{Band, Basis, Channels, Hemispheres, Matrix, Measured, Patches, read, xml};
use super::Random;

/// A material with reflection on our front and transmission from the back, of random values.
pub(super) fn blind() -> Patches {
    let bases = vec![Basis::known("LBNL/Klems Full").unwrap(), Basis::new("rings", &[0.0, 30.0, 60.0, 90.0], &[1, 5, 6]).unwrap()];
    let mut random = Random(17);
    let mut matrix = |hemispheres, band, incident: usize, outgoing: usize| {
        let count = bases[incident].count() * bases[outgoing].count();
        let values = (0..count).map(|_| (0.2 * random.next()).powi(2) as f32 * 8.0).collect();
        Matrix::new(hemispheres, band, incident, outgoing, values)
    };
    let matrices = vec![
        matrix(Hemispheres::ReflectionFront, Band::Visible, 0, 0),
        matrix(Hemispheres::TransmissionBack, Band::Visible, 1, 0),
        matrix(Hemispheres::TransmissionBack, Band::Solar, 1, 0),
    ];
    Patches::new(bases, matrices).unwrap()
}

#[test]
fn bases_cover_the_hemisphere_and_find_their_own_directions() {
    let mut random = Random(19);
    for (name, count) in [("LBNL/Klems Full", 145), ("lbnl/klems half", 73), ("LBNL/Klems Quarter", 41)] {
        let basis = Basis::known(name).unwrap();
        assert_eq!(basis.count(), count);
        let total: f64 = (0..count).map(|patch| basis.projected_solid_angle(patch)).sum();
        assert!((total - PI).abs() < 1e-12, "{total}");
        for patch in 0..count {
            for _ in 0..20 {
                let u = [0.001 + 0.998 * random.next(), 0.001 + 0.998 * random.next()];
                assert_eq!(basis.patch(basis.direction(patch, u)), patch);
            }
        }
    }
    assert!(Basis::known("LBNL/Klems Sixteenth").is_none());
}

#[test]
fn totals_are_the_integrals() {
    let material = Measured::Patches(blind());
    let Measured::Patches(patches) = &material else { unreachable!() };
    let matrix = patches.matrix(Hemispheres::ReflectionFront, Band::Visible).unwrap();
    let totals = patches.totals(matrix);
    let basis = &patches.bases()[matrix.incident];
    let mut random = Random(23);
    for patch in (0..basis.count()).step_by(12) {
        // Patches count by where light goes to.
        let d = basis.direction(patch, [0.5, 0.5]);
        let wi = [-d[0], -d[1], d[2]];
        assert!((material.albedo(wi).reflected[0] - totals[patch]).abs() < 1e-9);
        // π times the mean over directions in proportion to the cosine.
        let mean = (0..20_000).map(|_| {
            let wo = super::super::direction::cosine_direction([random.next(), random.next()]);
            material.eval_luminance(wi, wo) / wi[2]
        });
        let integral = PI * mean.sum::<f64>() / 20_000.0;
        assert!((integral / totals[patch] - 1.0).abs() < 0.05, "{integral} and {}", totals[patch]);
    }
}

#[test]
fn transmission_goes_both_ways_and_reflection_only_one() {
    let material = Measured::Patches(blind());
    let mut random = Random(29);
    for _ in 0..500 {
        let (up, down) = (random.direction(), through(random.direction()));
        let (back, front) = (material.eval_luminance(down, up) / down[2].abs(), material.eval_luminance(up, down) / up[2]);
        assert!(back > 0.0 && (back - front).abs() < 1e-9, "{back} {front}");
        assert!(material.eval_luminance(up, random.direction()) > 0.0);
        assert_eq!(material.eval_luminance(down, through(random.direction())), 0.0);
    }
}

#[test]
fn xml_comes_back() {
    let patches = blind();
    let text = xml::write_patches(&patches, "a < b & c");
    let Ok(Measured::Patches(found)) = read(text.as_bytes(), "a.xml") else { panic!("expected patches") };
    assert_eq!(found, patches);
}

#[test]
fn a_mirror_and_a_window_are_on_the_diagonal() {
    // Straight through and mirrored: patches count by where light goes to, on both sides.
    let basis = Basis::known("LBNL/Klems Quarter").unwrap();
    let n = basis.count();
    let diagonal: Vec<f32> = (0..n * n).map(|i| if i / n == i % n { 1.0 } else { 0.0 }).collect();
    let matrices = [Hemispheres::ReflectionFront, Hemispheres::TransmissionFront];
    let matrices = matrices.map(|pair| Matrix::new(pair, Band::Visible, 0, 0, diagonal.clone())).to_vec();
    let material = Measured::Patches(Patches::new(vec![basis], matrices).unwrap());
    let mut random = Random(31);
    for _ in 0..200 {
        let wi = random.direction();
        let mirrored = [-wi[0], -wi[1], wi[2]];
        assert!(material.eval_luminance(wi, mirrored) > 0.0);
        assert!(material.eval_luminance(wi, through(mirrored)) > 0.0);
        assert!(material.eval_luminance(through(mirrored), wi) > 0.0);
    }
}

#[test]
fn windows_front_is_our_back() {
    let file = |structure: &str, direction: &str, band: &str, data: &str| {
        format!(
            "<WindowElement><Optical><Layer><DataDefinition><IncidentDataStructure>{structure}</IncidentDataStructure>\
             <AngleBasis><AngleBasisName>two</AngleBasisName>\
             <AngleBasisBlock><nPhis>1</nPhis><ThetaBounds><LowerTheta>0</LowerTheta><UpperTheta>45</UpperTheta></ThetaBounds></AngleBasisBlock>\
             <AngleBasisBlock><nPhis>1</nPhis><ThetaBounds><LowerTheta>45</LowerTheta><UpperTheta>90</UpperTheta></ThetaBounds></AngleBasisBlock>\
             </AngleBasis></DataDefinition><WavelengthData><Wavelength>{band}</Wavelength><WavelengthDataBlock>\
             <WavelengthDataDirection>{direction}</WavelengthDataDirection><ColumnAngleBasis>two</ColumnAngleBasis>\
             <RowAngleBasis>two</RowAngleBasis><ScatteringDataType>BTDF</ScatteringDataType><ScatteringData>{data}</ScatteringData>\
             </WavelengthDataBlock></WavelengthData></Layer></Optical></WindowElement>"
        )
    };
    let open = |structure: &str, direction: &str| read(file(structure, direction, "Visible", "1, 2,\n3, 4").as_bytes(), "").unwrap();
    let (steep, flat) = ([0.0, 0.0, 1.0], [0.8, 0.0, 0.6]);
    let front = open("Columns", "Reflection Front");
    assert_eq!(front.eval_luminance(steep, flat), 0.0);
    // A column is one incident patch: light from the normal to grazing angles is the second row's first.
    assert!((front.eval_luminance(through(steep), through(flat)) - 3.0).abs() < 1e-9);
    let back = open("Rows", "Reflection Back");
    assert!((back.eval_luminance(steep, flat) - 2.0).abs() < 1e-9);
    // What the sun sends beside light says nothing of light.
    let solar = read(file("Columns", "Transmission Front", "Solar", "1 2 3 4").as_bytes(), "").unwrap();
    assert_eq!(solar.eval_luminance(through(steep), flat), 0.0);
    assert!(Hemispheres::ALL.iter().all(|pair| !solar.has(*pair)));
    let unseen = solar.unseen();
    assert_eq!(unseen.len(), 2, "{unseen:?}");
    assert!(unseen[1].starts_with("transmission-back: there is Solar alone"), "{unseen:?}");
    assert!(solar.figures().problems.contains(&unseen[0]));
    assert_eq!(solar.channels(), &Channels::Luminance);
}
