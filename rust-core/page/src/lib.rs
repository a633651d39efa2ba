//! What pages for readers share, such as verdict sheets, reports and pictures to play with: [`Language`]s and their [`Numbers`], words with places to
//! [`fill`], text as HTML holds it, [`plot`]s, [`colour`]s of values, and [`pdf`] by a browser.

#![forbid(unsafe_code)]

pub mod colour;
mod html;
mod language;
mod number;
mod pdf;
pub mod plot;
mod words;

pub use html::escaped;
pub use language::Language;
pub use number::Numbers;
pub use pdf::{PdfError, check_browser, pdf};
pub use words::{differences, fill, read};
