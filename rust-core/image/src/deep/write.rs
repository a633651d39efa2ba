//! Writing `deepscanline` files, row by row (OpenEXR File Layout, "Deep Data").

use super::compress::compress;
use super::header::{CHANNELS, DeepHeader};
use super::{DeepPicture, DeepSample};
use rayon::prelude::*;
use std::io::{Error, ErrorKind, Result, Seek, SeekFrom, Write};

/// Rows that are compressed together, which bounds what waits in memory.
const TOGETHER: usize = 64;

/// Writes a file: RGBA, Z and ZBack in 32-bit floats, compressed row by row (ZIPS).
///
/// # Errors
/// The picture is larger than files can be, or the output fails.
pub fn write_deep(picture: &DeepPicture, header: &DeepHeader, out: &mut (impl Write + Seek)) -> Result<()> {
    let side = |pixels: usize| i32::try_from(pixels).map_err(|_| Error::new(ErrorKind::InvalidInput, "the picture is too large"));
    let size = [side(picture.size[0])?, side(picture.size[1])?];
    let most = picture.counts.iter().max().copied().unwrap_or(0);
    header.write(size, most as i32, out)?;
    let table = out.stream_position()?;
    let mut places: Vec<u64> = Vec::with_capacity(picture.size[1]);
    out.write_all(&vec![0; 8 * picture.size[1]])?;
    let rows: Vec<_> = picture.rows().collect();
    let mut place = out.stream_position()?;
    for (group, rows) in rows.chunks(TOGETHER).enumerate() {
        let packed: Vec<Vec<u8>> = rows
            .par_iter()
            .enumerate()
            .map(|(row, (counts, samples))| chunk(header.corner[1] + (group * TOGETHER + row) as i32, counts, samples))
            .collect();
        for chunk in packed {
            places.push(place);
            place += chunk.len() as u64;
            out.write_all(&chunk)?;
        }
    }
    out.seek(SeekFrom::Start(table))?;
    places.iter().try_for_each(|place| out.write_all(&place.to_le_bytes()))?;
    out.seek(SeekFrom::Start(place)).map(|_| ())
}

/// A row: its number, the sizes of what follows, how many samples there are up to each pixel, and the samples channel by channel.
fn chunk(row: i32, counts: &[u32], samples: &[DeepSample]) -> Vec<u8> {
    let mut total = 0_u32;
    let mut ends = Vec::with_capacity(4 * counts.len());
    for count in counts {
        total += count;
        ends.extend(total.to_le_bytes());
    }
    let mut values = Vec::with_capacity(4 * CHANNELS.len() * samples.len());
    let of_sample: [fn(&DeepSample) -> f32; CHANNELS.len()] =
        [|s| s.rgba[3], |s| s.rgba[2], |s| s.rgba[1], |s| s.rgba[0], |s| s.depth[0], |s| s.depth[1]];
    for value in of_sample {
        samples.iter().for_each(|sample| values.extend(value(sample).to_le_bytes()));
    }
    let unpacked = values.len() as u64;
    let (ends, values) = (compress(ends), compress(values));
    let mut chunk = Vec::with_capacity(28 + ends.len() + values.len());
    chunk.extend(row.to_le_bytes());
    [ends.len() as u64, values.len() as u64, unpacked].iter().for_each(|size| chunk.extend(size.to_le_bytes()));
    chunk.extend(ends);
    chunk.extend(values);
    chunk
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::io::Cursor;

    #[test]
    fn samples_are_laid_over_one_another() {
        let sample = |light: f32, alpha: f32, depth: f32| DeepSample { rgba: [light, 0.0, 0.0, alpha], depth: [depth; 2] };
        let picture = DeepPicture {
            size: [2, 2],
            counts: vec![2, 0, 1, 3],
            samples: vec![
                sample(0.5, 0.5, 1.0),
                sample(1.0, 1.0, 2.0),
                sample(0.25, 0.25, 1.0),
                sample(0.1, 0.5, 1.0),
                sample(0.2, 0.5, 2.0),
                sample(0.4, 0.5, 3.0),
            ],
        };
        let flat = picture.flattened();
        let light: Vec<f32> = flat.iter().step_by(4).copied().collect();
        assert_eq!(light, [1.0, 0.0, 0.25, 0.1 + 0.1 + 0.1]);
        assert_eq!(flat.iter().skip(3).step_by(4).copied().collect::<Vec<_>>(), [1.0, 0.0, 0.25, 0.875]);
        assert_eq!(picture.rows().map(|(counts, samples)| (counts.len(), samples.len())).collect::<Vec<_>>(), [(2, 2), (2, 4)]);
    }

    #[test]
    fn the_table_says_where_rows_are() {
        let picture =
            DeepPicture { size: [3, 2], counts: vec![0, 1, 0, 0, 0, 0], samples: vec![DeepSample { rgba: [1.0; 4], depth: [2.0; 2] }] };
        let header = DeepHeader {
            display: [3, 2],
            corner: [0, 5],
            pixel_aspect: 1.0,
            white_luminance: 1.0,
            chromaticities: None,
            texts: vec![("gonio:a".into(), "b".into())],
        };
        let mut file = Cursor::new(Vec::new());
        write_deep(&picture, &header, &mut file).expect("memory");
        let bytes = file.into_inner();
        assert_eq!(bytes[..8], [0x76, 0x2f, 0x31, 0x01, 2, 8, 0, 0]);
        // An empty row has nothing but its table.
        let last = 28 + compress(vec![0; 12]).len();
        let first = bytes.len() - last - 28 - compress([0_u32, 1, 1].iter().flat_map(|end| end.to_le_bytes()).collect()).len();
        assert!(bytes[..first].windows(8).any(|word| word == ((bytes.len() - last) as u64).to_le_bytes()));
        assert_eq!(bytes[bytes.len() - last..][..4], 6_i32.to_le_bytes());
    }
}
