//! What files say of themselves and their grids, by name.

use crate::Result;
use crate::stream::Stream;

/// One entry's value.
#[derive(Clone, Debug, PartialEq)]
pub enum Metadata {
    /// A text.
    Text(String),
    /// Yes or no.
    Flag(bool),
    /// A whole number.
    Integer(i64),
    /// A number.
    Real(f64),
    /// Two to four whole numbers.
    Integers(Vec<i32>),
    /// Two to four numbers, or the sixteen of a matrix.
    Reals(Vec<f64>),
    /// A type that is not read: its name and size in bytes.
    Other(String, u32),
}

/// Names and values in the file's order.
pub type MetadataMap = Vec<(String, Metadata)>;

pub(crate) fn read(stream: &mut Stream) -> Result<MetadataMap> {
    let count = stream.u32()?;
    // Each has two texts and a size.
    stream.expect(u64::from(count) * 12, "the metadata")?;
    let mut map = MetadataMap::new();
    for _ in 0..count {
        let name = stream.text()?;
        let kind = stream.text()?;
        let size = stream.u32()?;
        let value = value(stream, &kind, size)?;
        // The table for delayed loading is of no use to anyone else.
        if !kind.starts_with("__") {
            map.push((name, value));
        }
    }
    Ok(map)
}

fn value(stream: &mut Stream, kind: &str, size: u32) -> Result<Metadata> {
    let parts = match kind.as_bytes() {
        [b'v', b'e', b'c', digit @ b'2'..=b'4', _] => u32::from(digit - b'0'),
        _ if kind.starts_with("mat4") => 16,
        _ => 1,
    };
    let reals = |stream: &mut Stream, wide: bool| -> Result<Vec<f64>> {
        (0..parts).map(|_| if wide { stream.f64() } else { Ok(f32::from_le_bytes(stream.array()?).into()) }).collect()
    };
    Ok(match (kind, size / parts, size % parts) {
        ("string", ..) => {
            let mut bytes = Vec::new();
            stream.fill(&mut bytes, size.into(), "a text of the metadata")?;
            Metadata::Text(String::from_utf8_lossy(&bytes).into_owned())
        }
        ("bool", 1, 0) => Metadata::Flag(stream.u8()? != 0),
        ("int32", 4, 0) => Metadata::Integer(stream.i32()?.into()),
        ("int64", 8, 0) => Metadata::Integer(stream.i64()?),
        ("float", 4, 0) => Metadata::Real(f32::from_le_bytes(stream.array()?).into()),
        ("double", 8, 0) => Metadata::Real(stream.f64()?),
        ("vec2i" | "vec3i" | "vec4i", 4, 0) => Metadata::Integers((0..parts).map(|_| stream.i32()).collect::<Result<_>>()?),
        ("vec2s" | "vec3s" | "vec4s" | "mat4s", 4, 0) => Metadata::Reals(reals(stream, false)?),
        ("vec2d" | "vec3d" | "vec4d" | "mat4d", 8, 0) => Metadata::Reals(reals(stream, true)?),
        _ => {
            stream.skip(size.into())?;
            Metadata::Other(kind.into(), size)
        }
    })
}

/// The text of an entry.
pub(crate) fn text<'a>(map: &'a MetadataMap, name: &str) -> Option<&'a str> {
    map.iter().find_map(|(key, value)| match value {
        Metadata::Text(text) if key == name => Some(text.as_str()),
        _ => None,
    })
}

/// An entry's type and bytes.
pub(crate) fn encode(value: &Metadata) -> (&'static str, Vec<u8>) {
    let kinds = |count: usize, names: [&'static str; 3]| names[count.clamp(2, 4) - 2];
    match value {
        Metadata::Text(text) => ("string", text.as_bytes().to_vec()),
        Metadata::Flag(flag) => ("bool", vec![u8::from(*flag)]),
        Metadata::Integer(integer) => ("int64", integer.to_le_bytes().to_vec()),
        Metadata::Real(real) => ("double", real.to_le_bytes().to_vec()),
        Metadata::Integers(all) => (kinds(all.len(), ["vec2i", "vec3i", "vec4i"]), all.iter().flat_map(|x| x.to_le_bytes()).collect()),
        Metadata::Reals(all) if all.len() == 16 => ("mat4d", all.iter().flat_map(|x| x.to_le_bytes()).collect()),
        Metadata::Reals(all) => (kinds(all.len(), ["vec2d", "vec3d", "vec4d"]), all.iter().flat_map(|x| x.to_le_bytes()).collect()),
        Metadata::Other(..) => ("", Vec::new()),
    }
}
