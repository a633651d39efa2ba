//! Ray files told apart by what their bytes are.

use super::zemax;

/// The formats that are read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RayFormat {
    /// IES TM-25-13.
    Tm25,
    /// Zemax OpticStudio's binary source file.
    Zemax,
    /// Zemax OpticStudio's text source file.
    ZemaxText,
    /// LightTools' binary ray data.
    LightTools,
    /// LightTools' text ray data.
    LightToolsText,
}

/// Bytes in which a text file has to say what it is.
const HEAD: usize = 1 << 12;

/// Endings of names and what writes such files.
const UNSUPPORTED: [(&str, &str); 6] = [
    ("dis", "ASAP distribution files do not say what their lengths are in"),
    ("ray", "the layouts of SPEOS, LucidShape, TracePro, OPTICAD and FRED are not public"),
    ("src", "TracePro's sources have no public layout"),
    ("fcr", "FRED's files have no public layout"),
    ("sdf", "this is none of Zemax' layouts"),
    ("dat", "this is none of Zemax' layouts"),
];

impl RayFormat {
    /// The format of a file's bytes.
    pub fn of(bytes: &[u8]) -> Option<Self> {
        let head = &bytes[..bytes.len().min(HEAD)];
        let has = |word: &[u8]| head.windows(word.len()).any(|found| found == word);
        if bytes.starts_with(b"TM25") {
            Some(Self::Tm25)
        } else if bytes.starts_with(b"LTRF") {
            Some(Self::LightTools)
        } else if has(b"lt_rdf_version") || has(b"lt_startofdata") {
            Some(Self::LightToolsText)
        } else if zemax::looks_like(bytes) {
            Some(Self::Zemax)
        } else if zemax::looks_like_text(head) {
            Some(Self::ZemaxText)
        } else {
            None
        }
    }

    /// Its name for people.
    pub fn name(self) -> &'static str {
        match self {
            Self::Tm25 => "IES TM-25",
            Self::Zemax => "Zemax binary source file",
            Self::ZemaxText => "Zemax text source file",
            Self::LightTools => "LightTools binary ray data",
            Self::LightToolsText => "LightTools text ray data",
        }
    }
}

/// Why a file that is none of the formats is refused.
pub(super) fn unknown(name: &str) -> String {
    let ending = name.rsplit('.').next().unwrap_or_default().to_ascii_lowercase();
    let known = UNSUPPORTED.iter().find(|(known, _)| *known == ending);
    let why = known.map(|(_, why)| format!("; {why}: export TM-25")).unwrap_or_default();
    format!("not a ray file that we know: TM-25 .tm25ray, Zemax .dat or .sdf, LightTools .ray{why}")
}
