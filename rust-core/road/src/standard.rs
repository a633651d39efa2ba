//! Whose conventions are taken.

/// How values between a table's are found.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Standard {
    /// EN 13201-3: linear in tables of the surface.
    #[default]
    En13201,
    /// CIE 140: quadratic in tables of the surface.
    Cie140,
}

impl Standard {
    /// What the norm is called.
    pub fn name(self) -> &'static str {
        match self {
            Self::En13201 => "EN 13201",
            Self::Cie140 => "CIE 140",
        }
    }
}
