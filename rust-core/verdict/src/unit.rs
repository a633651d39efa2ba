//! Units of figures, and how limits are written in them.

/// What a figure is in.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Unit {
    /// Its sign; empty of a number without one.
    pub(crate) sign: String,
    /// Whether it is a share of a whole, from 0 to 1, which per cent may be asked of.
    pub(crate) share: bool,
    /// Whether it is light, which grows with the lamps and falls as these age.
    pub(crate) light: bool,
}

impl Unit {
    pub(crate) fn plain() -> Self {
        Self { sign: String::new(), share: false, light: false }
    }

    pub(crate) fn share() -> Self {
        Self { share: true, ..Self::plain() }
    }

    /// Of something that is not light.
    pub(crate) fn of(sign: &str) -> Self {
        Self { sign: sign.to_owned(), ..Self::plain() }
    }

    pub(crate) fn light(sign: &str) -> Self {
        Self { light: true, ..Self::of(sign) }
    }

    /// The factor from the figure's own unit to one that somebody wrote; `None` where they do not go together.
    pub(crate) fn factor_to(&self, written: &str) -> Option<f64> {
        let same = usual(written) == usual(&self.sign);
        match written.trim() {
            _ if same => Some(1.0),
            "%" if self.share => Some(100.0),
            _ => None,
        }
    }

    /// The units that a message offers.
    pub(crate) fn told(&self) -> String {
        match (self.share, self.sign.as_str()) {
            (true, _) => "\"%\", or none for a share from 0 to 1".to_owned(),
            (false, "") => "none".to_owned(),
            (false, sign) => format!("\"{sign}\""),
        }
    }
}

/// A sign of a unit in its usual spelling.
pub(crate) fn usual(written: &str) -> &str {
    match written.trim() {
        "lux" => "lx",
        "cd/m2" | "cd/m^2" => "cd/m²",
        "percent" => "%",
        other => other,
    }
}
