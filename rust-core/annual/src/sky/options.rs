//! What a sky's matrix is made of.

/// What numbers stand in a matrix.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Quantity {
    /// cd/m²: 179 times what `gendaymtx -O0` writes.
    #[default]
    Luminance,
    /// W/(m² sr) of the whole solar spectrum: what `gendaymtx -O1` writes.
    SolarRadiance,
}

/// Whose light stands in a matrix.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Light {
    /// Sky, ground, and the sun spread over the nearest patches, 1 to 4 of them; `gendaymtx` takes 4.
    All {
        /// Patches that share the sun.
        sun_patches: usize,
    },
    /// Sky and ground, which the sun lights too: `gendaymtx -s`. The sun is to be taken from [`super::SkyMatrix::conditions`].
    WithoutSun,
    /// The sun alone: `gendaymtx -d`.
    SunAlone {
        /// Patches that share the sun.
        sun_patches: usize,
    },
}

/// How luminance is spread over the sky.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Model {
    /// Perez' all-weather sky with the limits of `gendaymtx`.
    #[default]
    Perez,
    /// A type of the CIE's general skies, 1 to 15, or 16 for the traditional overcast sky, with the weather's illuminances.
    Cie(u8),
}

/// What a matrix is made of.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SkyOptions {
    /// Reinhart's division, 1 to 6.
    pub factor: u32,
    /// What the numbers are.
    pub quantity: Quantity,
    /// Whose light.
    pub light: Light,
    /// How luminance is spread.
    pub model: Model,
    /// Albedo of the ground, 0 to 1.
    pub ground: f64,
    /// Degrees by which sun and sky are turned counter-clockwise, seen from above (`gendaymtx -r`).
    pub rotation_deg: f64,
    /// Dew point of the whole year, °C; `None` is the file's, 11 °C where it has none.
    pub dew_point_c: Option<f64>,
}

impl Default for SkyOptions {
    /// `gendaymtx -m 1`.
    fn default() -> Self {
        Self {
            factor: 1,
            quantity: Quantity::Luminance,
            light: Light::All { sun_patches: 4 },
            model: Model::Perez,
            ground: 0.2,
            rotation_deg: 0.0,
            dew_point_c: None,
        }
    }
}
