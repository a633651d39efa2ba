//! The header of a PLY file.

use crate::{FormatError, error::Result};

/// How the body is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Encoding {
    Text,
    LittleEndian,
    BigEndian,
}

/// The type of a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    F32,
    F64,
}

/// A property: its name, the type of its numbers, and that of their count where it is a list.
#[derive(Clone, Debug)]
pub(super) struct Property {
    pub(super) name: String,
    pub(super) kind: Kind,
    pub(super) count: Option<Kind>,
}

/// So many rows of properties.
#[derive(Clone, Debug)]
pub(super) struct Element {
    pub(super) name: String,
    pub(super) rows: usize,
    pub(super) properties: Vec<Property>,
}

/// What the header says, and where the body begins.
#[derive(Clone, Debug)]
pub(super) struct Header {
    pub(super) encoding: Encoding,
    pub(super) elements: Vec<Element>,
    pub(super) body: usize,
    /// Number of the body's first line.
    pub(super) line: u64,
}

impl Kind {
    fn parse(word: &str, line: u64) -> Result<Self> {
        Ok(match word {
            "char" | "int8" => Self::I8,
            "uchar" | "uint8" => Self::U8,
            "short" | "int16" => Self::I16,
            "ushort" | "uint16" => Self::U16,
            "int" | "int32" => Self::I32,
            "uint" | "uint32" => Self::U32,
            "float" | "float32" => Self::F32,
            "double" | "float64" => Self::F64,
            _ => return Err(FormatError::line(line, format!("'{word}' was found, expected a type such as float or int"))),
        })
    }

    /// Bytes of a number.
    pub(super) fn size(self) -> usize {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::I32 | Self::U32 | Self::F32 => 4,
            Self::F64 => 8,
        }
    }
}

impl Header {
    pub(super) fn read(bytes: &[u8]) -> Result<Self> {
        let (mut at, mut line) = (0, 0);
        let (mut encoding, mut elements) = (None, Vec::<Element>::new());
        loop {
            let rest = &bytes[at..];
            let end = rest.iter().position(|byte| *byte == b'\n');
            let Some(end) = end else { return Err(FormatError::line(line + 1, "the header has no line 'end_header'")) };
            (at, line) = (at + end + 1, line + 1);
            let text = String::from_utf8_lossy(&rest[..end]);
            let words: Vec<&str> = text.split_whitespace().collect();
            match words[..] {
                ["end_header"] => break,
                ["format", name, _] => encoding = Some(encoding_of(name, line)?),
                ["element", name, rows] => {
                    let rows =
                        rows.parse().map_err(|_| FormatError::line(line, format!("'{rows}' was found, expected a number of rows")))?;
                    elements.push(Element { name: name.to_owned(), rows, properties: Vec::new() });
                }
                ["property", "list", count, kind, name] => {
                    let (count, kind) = (Kind::parse(count, line)?, Kind::parse(kind, line)?);
                    last(&mut elements, line)?.properties.push(Property { name: name.to_owned(), kind, count: Some(count) });
                }
                ["property", kind, name] => {
                    let kind = Kind::parse(kind, line)?;
                    last(&mut elements, line)?.properties.push(Property { name: name.to_owned(), kind, count: None });
                }
                [] | ["ply" | "comment" | "obj_info", ..] => {}
                _ => return Err(FormatError::line(line, format!("'{text}' was found, expected format, element, property or end_header"))),
            }
        }
        let encoding = encoding.ok_or_else(|| FormatError::whole("the header has no line 'format'"))?;
        Ok(Self { encoding, elements, body: at, line: line + 1 })
    }
}

fn encoding_of(name: &str, line: u64) -> Result<Encoding> {
    match name {
        "ascii" => Ok(Encoding::Text),
        "binary_little_endian" => Ok(Encoding::LittleEndian),
        "binary_big_endian" => Ok(Encoding::BigEndian),
        _ => {
            let expected = "ascii, binary_little_endian or binary_big_endian";
            Err(FormatError::line(line, format!("'{name}' was found, expected {expected}")))
        }
    }
}

fn last(elements: &mut [Element], line: u64) -> Result<&mut Element> {
    elements.last_mut().ok_or_else(|| FormatError::line(line, "a property stands before the first element"))
}
