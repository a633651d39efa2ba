//! Elementary functions on lanes with stated error bounds.
