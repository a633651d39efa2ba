//! Writing BSDF XML.

use core::fmt::Write;

use super::super::hemispheres::Hemispheres;
use super::super::patches::{Band, Basis, Matrix, Patches};
use super::super::tree::{TensorTree, Tree};
use super::{BANDS, DIRECTIONS, SHIRLEY_CHIU};

/// BSDF XML of matrices, with all bases defined in it. What follows from reciprocity is left out.
pub fn write_patches(patches: &Patches, material: &str) -> String {
    let bases: String = patches.bases().iter().map(basis).collect();
    let given = patches.matrices().iter().filter(|m| m.turned == [true, false]);
    let blocks: String = given
        .map(|m| {
            let [column, row] = [m.incident, m.outgoing].map(|i| escaped(&patches.bases()[i].name));
            let angles = format!("<ColumnAngleBasis>{column}</ColumnAngleBasis>\n<RowAngleBasis>{row}</RowAngleBasis>\n");
            block(m.hemispheres, m.band, &angles, &matrix(m, patches.bases()[m.incident].count()))
        })
        .collect();
    document(material, &format!("<IncidentDataStructure>Columns</IncidentDataStructure>\n{bases}"), &blocks)
}

/// BSDF XML of tensor trees.
pub fn write_tree(tree: &TensorTree, material: &str) -> String {
    let rank = tree.components().first().map_or(3, |c| c.tree.rank);
    let blocks = tree.components().iter().map(|c| {
        let mut data = String::new();
        braces(&c.tree, 0, &mut data);
        block(c.hemispheres, c.band, &format!("<AngleBasis>{SHIRLEY_CHIU}</AngleBasis>\n"), &data)
    });
    let structure = format!("<IncidentDataStructure>TensorTree{rank}</IncidentDataStructure>\n");
    document(material, &structure, &blocks.collect::<String>())
}

fn document(material: &str, definition: &str, blocks: &str) -> String {
    format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<WindowElement xmlns=\"http://windows.lbl.gov\">\n\
         <WindowElementType>System</WindowElementType>\n<FileType>BSDF</FileType>\n<Optical>\n<Layer>\n\
         <Material>\n<Name>{}</Name>\n</Material>\n<DataDefinition>\n{definition}</DataDefinition>\n\
         {blocks}</Layer>\n</Optical>\n</WindowElement>\n",
        escaped(material)
    )
}

fn block(hemispheres: Hemispheres, band: Band, angles: &str, data: &str) -> String {
    let direction = DIRECTIONS.iter().find(|(_, pair)| *pair == hemispheres).map_or("", |(name, _)| *name);
    let wavelength = BANDS.iter().find(|(_, known)| *known == band).map_or("", |(name, _)| *name);
    let kind = if hemispheres.is_reflection() { "BRDF" } else { "BTDF" };
    format!(
        "<WavelengthData>\n<LayerNumber>System</LayerNumber>\n<Wavelength unit=\"Integral\">{wavelength}</Wavelength>\n\
         <WavelengthDataBlock>\n<WavelengthDataDirection>{direction}</WavelengthDataDirection>\n{angles}\
         <ScatteringDataType>{kind}</ScatteringDataType>\n<ScatteringData>\n{data}</ScatteringData>\n\
         </WavelengthDataBlock>\n</WavelengthData>\n"
    )
}

fn basis(basis: &Basis) -> String {
    let mut text = format!("<AngleBasis>\n<AngleBasisName>{}</AngleBasisName>\n", escaped(&basis.name));
    for (ring, count) in basis.counts.iter().enumerate() {
        let [low, high] = [ring, ring + 1].map(|r| super::super::axis::degrees(basis.borders[r]));
        // Writing to a string cannot fail.
        let _ = writeln!(
            text,
            "<AngleBasisBlock><nPhis>{count}</nPhis><ThetaBounds><LowerTheta>{low}</LowerTheta><UpperTheta>{high}</UpperTheta>\
             </ThetaBounds></AngleBasisBlock>"
        );
    }
    text + "</AngleBasis>\n"
}

fn matrix(matrix: &Matrix, columns: usize) -> String {
    let line = |row: &[f32]| row.iter().map(|v| format!("{v:e}")).collect::<Vec<_>>().join("\t") + "\n";
    matrix.values.chunks_exact(columns).map(line).collect()
}

/// A node and all below it. The depth of a tree is bounded.
fn braces(tree: &Tree, node: usize, text: &mut String) {
    let first = tree.first[node] as usize;
    text.push('{');
    if tree.log2[node] < 0 {
        text.push('\n');
        (0..1 << tree.rank).for_each(|child| braces(tree, first + child, text));
    } else {
        let count = 1_usize << (tree.log2[node] as u32 * tree.rank);
        tree.values[first..first + count].iter().for_each(|v| {
            let _ = write!(text, " {v:e}");
        });
    }
    text.push_str("}\n");
}

/// Text as it may stand between tags.
fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}
