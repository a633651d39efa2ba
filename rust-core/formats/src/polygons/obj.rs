//! Wavefront OBJ: `v`, `vt`, `vn`, `f` and `usemtl`; other statements (groups, smoothing, lines, material libraries) change no triangle.

use super::{Polygons, finite};
use crate::{FormatError, error::Result};
use std::collections::HashMap;

/// What is kept of the lines before.
#[derive(Default)]
struct Reader<'a> {
    mesh: Polygons,
    uvs: Vec<[f32; 2]>,
    normals: Vec<[f32; 3]>,
    corner_uvs: Vec<Option<[f32; 2]>>,
    corner_normals: Vec<Option<[f32; 3]>>,
    material: &'a str,
    numbers: HashMap<&'a str, u16>,
}

pub(super) fn read(bytes: &[u8]) -> Result<Polygons> {
    let text = String::from_utf8_lossy(bytes);
    let joined = text.contains("\\\n") || text.contains("\\\r\n");
    let whole = if joined { text.replace("\\\r\n", " \u{b}").replace("\\\n", " \u{b}") } else { text.into_owned() };
    let (mut reader, mut number) = (Reader::default(), 1);
    for line in whole.lines() {
        reader.line(line, number)?;
        // Lines that were joined count as they stand in the file.
        number += 1 + line.matches('\u{b}').count() as u64;
    }
    if reader.mesh.face_counts.is_empty() {
        return Err(FormatError::whole("no face was found: an OBJ file has lines 'v x y z' and 'f 1 2 3'"));
    }
    let Reader { mut mesh, corner_uvs, corner_normals, .. } = reader;
    if corner_uvs.iter().any(Option::is_some) {
        mesh.uvs = corner_uvs.into_iter().map(Option::unwrap_or_default).collect();
    }
    mesh.set_normals(&corner_normals);
    Ok(mesh)
}

impl<'a> Reader<'a> {
    fn line(&mut self, line: &'a str, number: u64) -> Result<()> {
        let mut words = line.split('#').next().unwrap_or_default().split_whitespace();
        match words.next() {
            Some("v") => self.mesh.points.push(numbers::<3>(words, 3, number)?),
            Some("vt") => self.uvs.push(numbers::<2>(words, 1, number)?),
            Some("vn") => self.normals.push(numbers::<3>(words, 3, number)?),
            Some("usemtl") => self.material = line.split_once("usemtl").map_or("", |(_, name)| name.trim()),
            Some("f") => self.face(words, number)?,
            _ => {}
        }
        Ok(())
    }

    /// `f a/b/c …`: numbers of a point, coordinates and a normal; from one, or negative from the last.
    fn face(&mut self, words: impl Iterator<Item = &'a str>, line: u64) -> Result<()> {
        let mut count = 0;
        for word in words {
            let mut parts = word.split('/');
            let point = index(parts.next().unwrap_or_default(), self.mesh.points.len(), "v", line)?;
            let mut other = |length, kind| match parts.next() {
                None | Some("") => Ok(None),
                Some(text) => index(text, length, kind, line).map(Some),
            };
            let (uv, normal) = (other(self.uvs.len(), "vt")?, other(self.normals.len(), "vn")?);
            self.mesh.corners.push(point as u32);
            self.corner_uvs.push(uv.map(|at| self.uvs[at]));
            self.corner_normals.push(normal.map(|at| self.normals[at]));
            count += 1;
        }
        if count < 3 {
            return Err(FormatError::line(line, format!("a face of {count} corners was found, expected 3 or more")));
        }
        self.mesh.face_counts.push(count);
        let material = self.material(line)?;
        self.mesh.face_materials.push(material);
        Ok(())
    }

    /// The number of the material that faces have now.
    fn material(&mut self, line: u64) -> Result<u16> {
        if let Some(number) = self.numbers.get(self.material) {
            return Ok(*number);
        }
        let number = u16::try_from(self.numbers.len());
        let number = number.map_err(|_| FormatError::line(line, "more than 65536 materials were found"))?;
        self.numbers.insert(self.material, number);
        self.mesh.materials.push(self.material.to_owned());
        Ok(number)
    }
}

/// Up to `N` numbers, `least` of them at least; more are left alone (weights, colours).
fn numbers<'a, const N: usize>(words: impl Iterator<Item = &'a str>, least: usize, line: u64) -> Result<[f32; N]> {
    let (mut found, mut count) = ([0.0; N], 0);
    for (place, word) in found.iter_mut().zip(words) {
        *place = word.parse().map_err(|_| FormatError::line(line, format!("'{word}' was found, expected a number")))?;
        count += 1;
    }
    if count < least {
        return Err(FormatError::line(line, format!("{count} numbers were found, expected {least}")));
    }
    finite(found, line)
}

fn index(text: &str, length: usize, kind: &str, line: u64) -> Result<usize> {
    let wrong = |problem: String| FormatError::line(line, problem);
    let number: i64 = text.parse().map_err(|_| wrong(format!("'{text}' was found, expected the number of a line '{kind}'")))?;
    let place = if number < 0 { length as i64 + number } else { number - 1 };
    let there = usize::try_from(place).ok().filter(|place| *place < length);
    there.ok_or_else(|| wrong(format!("line '{kind}' number {number} was asked for, {length} were found so far")))
}
