//! What a render starts from.

use crate::{
    antialias::Rule,
    compile::View,
    transport::{SensorTable, Start, Transport},
};

/// A camera's view, or sensors.
#[derive(Debug)]
pub(crate) enum Source {
    /// A picture.
    View(View),
    /// Measurements.
    Sensors {
        /// Where.
        sensors: SensorTable,
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
        }
    }

    /// What counts as a discontinuity, where samples follow them.
    pub(crate) fn rule(&self) -> Option<Rule> {
        match self {
            Self::View(view) => view.rule,
            Self::Sensors { .. } => None,
        }
    }

    /// The light transport.
    pub(crate) fn transport(&self) -> &Transport {
        match self {
            Self::View(view) => &view.transport,
            Self::Sensors { transport, .. } => transport,
        }
    }
}
