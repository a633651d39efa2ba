//! Measured scattering of materials.
