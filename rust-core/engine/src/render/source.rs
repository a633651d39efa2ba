//! What a render starts from.

use crate::{
    antialias::Rule,
    compile::View,
    transport::{PlaceTable, SensorTable, Start, Transport},
};

/// A camera's view, sensors, or places on surfaces.
#[derive(Debug)]
pub(crate) enum Source {
    /// A picture.
    View(View),
    /// Measurements.
    Sensors {
        /// Where.
        sensors: Box<SensorTable>,
        /// How.
        transport: Transport,
    },
    /// Textures.
    Places {
        /// Where.
        places: PlaceTable,
        /// How.
        transport: Transport,
    },
}

impl Source {
    /// Where paths start.
    pub(crate) fn start(&self) -> Start<'_> {
        match self {
            Self::View(view) => Start::Camera(&view.camera, &view.placement),
            Self::Sensors { sensors, .. } => Start::Sensors(sensors),
            Self::Places { places, .. } => Start::Places(places),
        }
    }

    /// What counts as a discontinuity, where samples follow them.
    pub(crate) fn rule(&self) -> Option<Rule> {
        match self {
            Self::View(view) => view.rule,
            Self::Sensors { .. } | Self::Places { .. } => None,
        }
    }

    /// The light transport.
    pub(crate) fn transport(&self) -> &Transport {
        match self {
            Self::View(view) => &view.transport,
            Self::Sensors { transport, .. } | Self::Places { transport, .. } => transport,
        }
    }
}
