//! PLY: the elements `vertex` (x, y, z; nx, ny, nz; s, t or u, v) and `face` (vertex_indices; texcoord; material_index). Others are passed by.

use super::{
    Polygons,
    ply_body::Body,
    ply_header::{Element, Header},
};
use crate::{FormatError, error::Result};

/// Names of texture coordinates, as programs write them.
const COORDINATES: [[&str; 2]; 4] = [["s", "t"], ["u", "v"], ["texture_u", "texture_v"], ["u1", "v1"]];

/// What vertices have besides positions.
#[derive(Default)]
struct Vertices {
    normals: Vec<[f32; 3]>,
    uvs: Vec<[f32; 2]>,
}

pub(super) fn read(bytes: &[u8]) -> Result<Polygons> {
    let header = Header::read(bytes)?;
    let text = String::from_utf8_lossy(if header.is_text() { &bytes[header.body..] } else { &[] });
    let mut body = Body::new(&header, bytes, &text);
    let (mut mesh, mut vertices, mut materials) = (Polygons::default(), Vertices::default(), Vec::new());
    for element in &header.elements {
        check_rows(element, &body, bytes.len() - header.body)?;
        match element.name.as_str() {
            "vertex" => read_vertices(element, &mut body, &mut mesh, &mut vertices)?,
            "face" => read_faces(element, &mut body, &mut mesh, &mut materials)?,
            _ => pass_by(element, &mut body)?,
        }
    }
    if mesh.face_counts.is_empty() {
        return Err(FormatError::whole("no face was found: a cloud of points has no surface"));
    }
    if let Some(wrong) = mesh.corners.iter().find(|corner| **corner as usize >= mesh.points.len()) {
        return Err(FormatError::whole(format!("a face names vertex {wrong}, {} were found", mesh.points.len())));
    }
    if !vertices.normals.is_empty() {
        mesh.normals = mesh.corners.iter().map(|corner| vertices.normals[*corner as usize]).collect();
    }
    if mesh.uvs.is_empty() && !vertices.uvs.is_empty() {
        mesh.uvs = mesh.corners.iter().map(|corner| vertices.uvs[*corner as usize]).collect();
    }
    name_materials(&mut mesh, &materials)?;
    Ok(mesh)
}

impl Header {
    fn is_text(&self) -> bool {
        self.encoding == super::ply_header::Encoding::Text
    }
}

/// Refuses rows that the file is too short for, before anything is made for them.
fn check_rows(element: &Element, body: &Body<'_>, length: usize) -> Result<()> {
    let least: usize = element.properties.iter().map(|property| body.smallest(property.count.unwrap_or(property.kind))).sum();
    if element.rows.checked_mul(least.max(1)).is_some_and(|bytes| bytes <= length + 1) {
        return Ok(());
    }
    Err(FormatError::whole(format!("{} rows of '{}' are stated, more than the file's {length} bytes can hold", element.rows, element.name)))
}

fn pass_by(element: &Element, body: &mut Body<'_>) -> Result<()> {
    let mut values = Vec::new();
    for _ in 0..element.rows {
        body.begin_row()?;
        element.properties.iter().try_for_each(|property| body.property(property, &mut values))?;
    }
    Ok(())
}

fn read_vertices(element: &Element, body: &mut Body<'_>, mesh: &mut Polygons, vertices: &mut Vertices) -> Result<()> {
    let place = |name: &str| element.properties.iter().position(|property| property.name == name);
    let all = |names: &[&str]| names.iter().map(|name| place(name)).collect::<Option<Vec<usize>>>();
    let position = all(&["x", "y", "z"]).ok_or_else(|| FormatError::whole("vertices have no x, y and z"))?;
    let (normal, uv) = (all(&["nx", "ny", "nz"]), COORDINATES.iter().find_map(|names| all(names)));
    let (mut row, mut values) = (vec![0.0; element.properties.len()], Vec::new());
    for _ in 0..element.rows {
        body.begin_row()?;
        for (number, property) in row.iter_mut().zip(&element.properties) {
            body.property(property, &mut values)?;
            *number = values.first().copied().unwrap_or_default() as f32;
        }
        if row.iter().any(|x| !x.is_finite()) {
            return Err(body.wrong("a number is not finite"));
        }
        mesh.points.push([row[position[0]], row[position[1]], row[position[2]]]);
        vertices.normals.extend(normal.iter().map(|at| [row[at[0]], row[at[1]], row[at[2]]]));
        vertices.uvs.extend(uv.iter().map(|at| [row[at[0]], row[at[1]]]));
    }
    Ok(())
}

fn read_faces(element: &Element, body: &mut Body<'_>, mesh: &mut Polygons, materials: &mut Vec<i64>) -> Result<()> {
    let mut values = Vec::new();
    for _ in 0..element.rows {
        body.begin_row()?;
        let (mut coordinates, mut count, mut material) = (Vec::new(), 0, 0);
        for property in &element.properties {
            body.property(property, &mut values)?;
            match property.name.as_str() {
                "vertex_indices" | "vertex_index" => {
                    count = values.len();
                    for index in &values {
                        let there = (0.0..f64::from(u32::MAX)).contains(index) && index.fract() == 0.0;
                        mesh.corners.push(if there { *index as u32 } else { return Err(body.wrong(format!("{index} is no vertex"))) });
                    }
                }
                "texcoord" => coordinates = values.as_chunks::<2>().0.iter().map(|uv| uv.map(|x| x as f32)).collect::<Vec<_>>(),
                "material_index" => material = values.first().map_or(0, |number| *number as i64),
                _ => {}
            }
        }
        if count < 3 {
            return Err(body.wrong(format!("a face of {count} corners was found, expected 3 or more")));
        }
        let given = coordinates.len() == count && coordinates.iter().flatten().all(|x| x.is_finite());
        if given && mesh.uvs.len() == mesh.corners.len() - count {
            mesh.uvs.append(&mut coordinates);
        }
        mesh.face_counts.push(count as u32);
        materials.push(material);
    }
    if mesh.uvs.len() != mesh.corners.len() {
        mesh.uvs.clear();
    }
    Ok(())
}

/// Materials have numbers only: in their order, by which they are called where there are several.
fn name_materials(mesh: &mut Polygons, of_faces: &[i64]) -> Result<()> {
    let mut numbers = of_faces.to_vec();
    numbers.sort_unstable();
    numbers.dedup();
    if numbers.len() > usize::from(u16::MAX) {
        return Err(FormatError::whole(format!("{} materials were found, expected at most 65535", numbers.len())));
    }
    let name = |number: &i64| if numbers.len() == 1 { String::new() } else { number.to_string() };
    mesh.materials = numbers.iter().map(name).collect();
    mesh.face_materials = of_faces.iter().map(|number| numbers.partition_point(|other| other < number) as u16).collect();
    Ok(())
}
