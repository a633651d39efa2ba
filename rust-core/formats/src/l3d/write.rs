//! The writer of L3D 0.11: one mesh a part, all in the luminaire's frame.

use super::{L3dLight, L3dShape, STRUCTURE};
use crate::archive::{LONGEST, packed};
use crate::error::{FormatError, Result};
use crate::photometry::text::{number, one_line};
use crate::polygons::to_obj;
use crate::svg::escape;
use crate::xml::nc_name;

const SCHEMA: &str = "https://gldf.io/xsd/l3d/0.11.0/l3d.xsd";

/// A diameter in metres that stands for a point, which L3D does not know.
const POINT: f64 = 1e-3;

/// A model that is to be written.
#[derive(Clone, Debug, PartialEq)]
pub struct NewModel {
    /// Its name.
    pub name: String,
    /// The program that writes it.
    pub program: String,
    /// When it was made, as XML has dates and times.
    pub time: String,
    /// One part or more.
    pub parts: Vec<NewPart>,
    /// Where light leaves; its name begins with a letter, and it is not turned.
    pub light: L3dLight,
}

/// A part of a model that is to be written.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct NewPart {
    /// Its name.
    pub name: String,
    /// Places in metres in the luminaire's frame.
    pub points: Vec<[f32; 3]>,
    /// Corners counter-clockwise seen from the front.
    pub triangles: Vec<[u32; 3]>,
    /// Of the triangles the last ones shine, that many.
    pub shining: usize,
}

impl NewModel {
    /// The bytes of the file.
    ///
    /// # Errors
    /// A model without a part, or with one whose mesh is longer than readers take.
    pub fn write(&self) -> Result<Vec<u8>> {
        if self.parts.is_empty() {
            return Err(FormatError::whole("the model has no part"));
        }
        let names: Vec<String> = self.parts.iter().enumerate().map(|(index, part)| part_name(index, part)).collect();
        let mut files = vec![(STRUCTURE.to_owned(), self.structure(&names).into_bytes())];
        for (part, name) in self.parts.iter().zip(&names) {
            let mesh = to_obj(name, &part.points, &part.triangles);
            if mesh.len() as u64 > LONGEST {
                return Err(FormatError::whole(format!("the mesh of {} has {} bytes, at most {LONGEST} are read", part.name, mesh.len())));
            }
            files.push((format!("{name}/{name}.obj"), mesh));
        }
        packed(&files.iter().map(|(name, content)| (name.as_str(), content.as_slice())).collect::<Vec<_>>())
    }

    fn structure(&self, names: &[String]) -> String {
        let definition = |name: &String| format!("    <GeometryFileDefinition id=\"{name}\" filename=\"{name}.obj\" units=\"m\"/>\n");
        let definitions: String = names.iter().map(definition).collect();
        let light = self.light();
        let parts = self.parts.iter().zip(names).enumerate();
        let parts: String = parts.map(|(index, (part, name))| self.part(part, name, if index == 0 { &light } else { "" })).collect();
        let [name, program] = [&self.name, &self.program].map(|text| escape(&one_line(text)));
        let time = &self.time;
        format!(
            "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n\
             <Luminaire xmlns:xsi=\"http://www.w3.org/2001/XMLSchema-instance\" xsi:noNamespaceSchemaLocation=\"{SCHEMA}\">\n  <Header>\n    \
             <Name>{name}</Name>\n    <CreatedWithApplication>{program}</CreatedWithApplication>\n    \
             <CreationTimeCode>{time}</CreationTimeCode>\n    <FormatVersion major=\"0\" minor=\"11\"/>\n  </Header>\n  <GeometryDefinitions>\n\
             {definitions}  </GeometryDefinitions>\n  <Structure>\n{parts}  </Structure>\n</Luminaire>\n"
        )
    }

    fn part(&self, part: &NewPart, name: &str, light: &str) -> String {
        format!(
            "    <Geometry partName=\"{name}\" includedInMeasurement=\"true\">\n      {}\n      <GeometryReference geometryId=\"{name}\"/>\n\
             {light}{}    </Geometry>\n",
            placed([0.0; 3]),
            self.shining(part, name)
        )
    }

    /// The light emitting object; the first part has it.
    fn light(&self) -> String {
        let L3dLight { name, place, shape, heights } = &self.light;
        let shape = match *shape {
            L3dShape::Point => format!("<Circle diameter=\"{}\"/>", number(POINT)),
            L3dShape::Circle(diameter) => format!("<Circle diameter=\"{}\"/>", number(diameter)),
            L3dShape::Rectangle([x, y]) => format!("<Rectangle sizeX=\"{}\" sizeY=\"{}\"/>", number(x), number(y)),
        };
        let [c0, c90, c180, c270] = heights.map(number);
        let heights = format!("<LuminousHeights c0=\"{c0}\" c90=\"{c90}\" c180=\"{c180}\" c270=\"{c270}\"/>");
        let place = placed(place.point([0.0; 3]));
        format!(
            "      <LightEmittingObjects>\n        <LightEmittingObject partName=\"{name}\">\n          {place}\n          {shape}\n          \
             {heights}\n        </LightEmittingObject>\n      </LightEmittingObjects>\n"
        )
    }

    /// The faces that shine; a range has two or more.
    fn shining(&self, part: &NewPart, name: &str) -> String {
        let last = part.triangles.len().saturating_sub(1);
        let faces = match part.shining {
            0 => return String::new(),
            1 => format!("<FaceAssignment faceIndex=\"{last}\"/>"),
            count => {
                format!("<FaceRangeAssignment faceIndexBegin=\"{}\" faceIndexEnd=\"{last}\"/>", part.triangles.len().saturating_sub(count))
            }
        };
        format!(
            "      <LightEmittingSurfaces>\n        <LightEmittingSurface partName=\"{name}-shines\">\n          \
             <LightEmittingObjectReference lightEmittingPartName=\"{}\"/>\n          <FaceAssignments>{faces}</FaceAssignments>\n        \
             </LightEmittingSurface>\n      </LightEmittingSurfaces>\n",
            self.light.name
        )
    }
}

/// Of parts with the same name each has its number.
fn part_name(index: usize, part: &NewPart) -> String {
    nc_name(&format!("part{}-{}", index + 1, part.name))
}

fn placed(place: [f64; 3]) -> String {
    let [x, y, z] = place.map(number);
    format!("<Position x=\"{x}\" y=\"{y}\" z=\"{z}\"/><Rotation x=\"0\" y=\"0\" z=\"0\"/>")
}
