//! Figures against published ones and independent code, and files of every kind.

mod bad;
mod bands;
mod colour_spectra;
mod figures;
mod reading;
mod triples;
mod upsampling;
