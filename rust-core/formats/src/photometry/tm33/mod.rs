//! TM-33 (ANSI/IES TM-33, UNI 11733): luminaire optical data as XML.
//!
//! What is known here is the XML schema that was published with it (version 1.0, root `IESTM33…`, and 1.1, root `IESTM33-22`): names, types and
//! order of elements. The standard's text is not free of charge, and what only that says is left out:
//!
//! - Written are the head, the outer dimensions, the emitter with its power, rated lumens and colour temperature, whether it was simulated, and
//!   its luminous intensities and flux. One plane stands for rotational symmetry (`Symm_Full`); any other goniogram gets all its planes from
//!   0 to 360 degrees (`Symm_None`), because the schema does not say which planes the other symmetries keep.
//! - The schema names no unit of length: millimetres are written, as published examples have them; read are metres where no number is
//!   above 20.
//! - `EmissionAreas` are read for their sizes (a `C0Area` has a length, so that the length runs along C90–C270), but not written, because
//!   the schema does not say what offsets are from.
//! - An emitter's spectrum (`EmitterSpectral`) is in nm and power, relative as written. One with a `Quantum` is left out, because the schema does not say
//!   what that counts, and so are spectra by angle.
//! - Radiant and photon intensities are read where there are no luminous ones and a spectrum covers their wavelengths; they are in W/sr and in
//!   µmol/(s sr), as published examples have them.
//! - Illuminances, irradiances, colour by angle, channels, tilt angles and what is regulatory are neither written nor read.
//! - Of several emitters the first with luminous intensities is read, and `Quantity` multiplies nothing.

mod radiant;
mod read;
mod spectral;
mod write;

pub use read::read;
pub use spectral::spectra;
pub use write::write;

/// What the root's name begins with.
const ROOT: &str = "IESTM33";

/// Bytes in which the root has to begin.
const LONGEST_PREAMBLE: usize = 1 << 12;

/// Whether the bytes are XML with such a root.
pub fn looks_like(bytes: &[u8]) -> bool {
    let start = bytes.strip_prefix(&[0xef, 0xbb, 0xbf]).unwrap_or(bytes).trim_ascii_start();
    let head = &start[..start.len().min(LONGEST_PREAMBLE)];
    start.first() == Some(&b'<') && head.windows(ROOT.len()).any(|word| word == ROOT.as_bytes())
}
