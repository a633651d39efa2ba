//! Files written here byte by byte from their layouts.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

mod nano;
mod vdb;

/// Bytes that grow.
#[derive(Default)]
struct Bytes(Vec<u8>);

impl Bytes {
    fn add(&mut self, bytes: impl AsRef<[u8]>) -> &mut Self {
        self.0.extend(bytes.as_ref());
        self
    }

    fn u32(&mut self, word: u32) -> &mut Self {
        self.add(word.to_le_bytes())
    }

    fn text(&mut self, text: &str) -> &mut Self {
        self.u32(text.len() as u32).add(text)
    }

    fn reals(&mut self, reals: &[f64]) -> &mut Self {
        self.add(reals.iter().flat_map(|real| real.to_le_bytes()).collect::<Vec<u8>>())
    }

    fn floats(&mut self, floats: impl IntoIterator<Item = f32>) -> &mut Self {
        self.add(floats.into_iter().flat_map(f32::to_le_bytes).collect::<Vec<u8>>())
    }

    fn mask(&mut self, words: usize, first: u64) -> &mut Self {
        self.add(first.to_le_bytes()).add(vec![0; 8 * (words - 1)])
    }
}
