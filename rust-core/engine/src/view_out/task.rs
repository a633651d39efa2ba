//! What is asked of a view.

/// What is asked.
#[derive(Clone, Debug)]
pub struct ViewTask {
    /// Away from the ground.
    pub up: [f64; 3],
    /// Degrees above and below the horizon that are looked at.
    pub field_deg: f64,
    /// Degrees from ray to ray.
    pub step_deg: f64,
    /// Metres behind an opening within which things belong to the building, and are no view.
    pub nearest_m: f64,
    /// Degrees above and below the horizon within which nothing that is met counts as landscape.
    pub horizon_deg: f64,
    /// Elements of the scene that are ground, by their origins or what these lie below; without any it is what is level and below the horizon.
    pub ground: Vec<String>,
    /// Those through which alone a view leads out; without any it is panes to the outside, and open holes.
    pub openings: Vec<String>,
}

impl Default for ViewTask {
    fn default() -> Self {
        Self {
            up: [0.0, 0.0, 1.0],
            field_deg: 60.0,
            step_deg: 0.5,
            nearest_m: 1.0,
            horizon_deg: 0.0,
            ground: Vec::new(),
            openings: Vec::new(),
        }
    }
}
