//! Goniograms of luminaires.
