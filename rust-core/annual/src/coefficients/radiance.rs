//! Radiance's matrices: a header of lines, an empty line, rows of points with columns of patches.

use super::{Coefficients, luminous};
use gonio_formats::FormatError;

/// The longest header in bytes.
const LONGEST_HEADER: usize = 1 << 20;
/// How bytes make numbers.
type Decode = fn(&[u8]) -> f64;

/// What a header says.
#[derive(Default)]
struct Header {
    rows: Option<usize>,
    columns: Option<usize>,
    components: usize,
    is_big_endian: bool,
    format: String,
    /// Lines before the numbers, and their bytes.
    lines: u64,
    length: usize,
}

/// Reads a matrix.
pub(super) fn read(bytes: &[u8]) -> Result<Coefficients, FormatError> {
    let header = header(bytes)?;
    let rest = &bytes[header.length..];
    let columns = header.columns.ok_or_else(|| FormatError::whole("the header has no NCOLS=; rfluxmtx writes it"))?;
    if columns == 0 || header.rows == Some(0) {
        return Err(FormatError::whole("the header says that the matrix is empty"));
    }
    let values = match (header.format.as_str(), header.is_big_endian) {
        ("ascii", _) => text(rest, &header)?,
        ("float", false) => binary::<4>(rest, &header, |bytes| f64::from(f32::from_le_bytes(bytes.try_into().unwrap_or_default()))),
        ("float", true) => binary::<4>(rest, &header, |bytes| f64::from(f32::from_be_bytes(bytes.try_into().unwrap_or_default()))),
        ("double", false) => binary::<8>(rest, &header, |bytes| f64::from_le_bytes(bytes.try_into().unwrap_or_default())),
        ("double", true) => binary::<8>(rest, &header, |bytes| f64::from_be_bytes(bytes.try_into().unwrap_or_default())),
        (other, _) => {
            let shown: String = other.chars().take(40).collect();
            return Err(FormatError::whole(format!("FORMAT={shown} was found, expected ascii, float or double")));
        }
    };
    let rows = header.rows.unwrap_or(values.len() / columns);
    if Some(values.len()) != rows.checked_mul(columns) {
        let problem = format!("{} numbers of {} components were found, expected {rows} × {columns}", values.len(), header.components);
        return Err(FormatError::whole(problem));
    }
    Coefficients::new(rows, columns, vec![values])
}

fn header(bytes: &[u8]) -> Result<Header, FormatError> {
    if !bytes.starts_with(b"#?RADIANCE") {
        return Err(FormatError::whole("no matrix: expected '#?RADIANCE' of a Radiance matrix or a NumPy array"));
    }
    let mut header = Header { components: 3, format: "ascii".into(), ..Header::default() };
    loop {
        let rest = &bytes[header.length..];
        let end = rest.iter().take(LONGEST_HEADER).position(|byte| *byte == b'\n');
        let end = end.ok_or_else(|| FormatError::whole("the header has no empty line at its end"))?;
        header.length += end + 1;
        header.lines += 1;
        let line = String::from_utf8_lossy(&rest[..end]);
        let line = line.trim();
        if line.is_empty() {
            return Ok(header);
        }
        let Some((name, value)) = line.split_once('=') else { continue };
        let value = value.trim();
        let count =
            || value.parse::<usize>().map_err(|_| FormatError::line(header.lines, format!("{name} is '{value}', expected a whole number")));
        match name {
            "NROWS" => header.rows = Some(count()?),
            "NCOLS" => header.columns = Some(count()?),
            "NCOMP" => header.components = count()?,
            "BigEndian" => header.is_big_endian = value == "1",
            "FORMAT" => header.format = value.into(),
            _ => {}
        }
        if ![1, 3].contains(&header.components) {
            return Err(FormatError::line(header.lines, format!("NCOMP is {}, expected 1 or 3", header.components)));
        }
    }
}

fn binary<const SIZE: usize>(bytes: &[u8], header: &Header, decode: Decode) -> Vec<f32> {
    let of_pixel = |pixel: &[u8]| {
        let mut components = [0.0; 3];
        for (component, bytes) in components.iter_mut().zip(pixel.chunks_exact(SIZE)) {
            *component = decode(bytes);
        }
        luminous(&components[..header.components])
    };
    bytes.chunks_exact(SIZE * header.components).map(of_pixel).collect()
}

fn text(bytes: &[u8], header: &Header) -> Result<Vec<f32>, FormatError> {
    let text = std::str::from_utf8(bytes).map_err(|_| FormatError::whole("FORMAT=ascii, but what follows the header is no text"))?;
    let (mut values, mut waiting) = (Vec::new(), Vec::with_capacity(3));
    for (line, text) in (header.lines + 1..).zip(text.lines()) {
        for word in text.split_whitespace() {
            let value = word.parse::<f64>().ok().filter(|value| value.is_finite() && *value >= 0.0);
            waiting.push(value.ok_or_else(|| {
                let shown: String = word.chars().take(40).collect();
                FormatError::line(line, format!("'{shown}' was found, expected a coefficient, 0 or more"))
            })?);
            if waiting.len() == header.components {
                values.push(luminous(&waiting));
                waiting.clear();
            }
        }
    }
    if waiting.is_empty() { Ok(values) } else { Err(FormatError::whole("the last number has fewer components than the header says")) }
}
