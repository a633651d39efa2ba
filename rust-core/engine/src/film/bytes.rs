//! A film as bytes, little-endian, tile by tile: a file holds exactly what memory does.

use super::{
    Film, block_at,
    deep::Deep,
    matte::Matte,
    noise::Halves,
    raw::{array, number},
    splats::SplatFilm,
    sums::Sums,
    tile::TileFilm,
    zones::ZONES,
};
use crate::camera::sampler::BATCH;
use std::{
    io::{Error, ErrorKind, Read, Result, Write},
    sync::Mutex,
};

/// Bytes of a tile without sums.
pub(crate) const LEAST_TILE: u64 = 4 + 8 + 4 * ZONES as u64 + 3 * 4;

impl Film {
    /// Writes what has been added so far; every tile is whole, one may have more samples than another.
    pub(crate) fn write(&self, out: &mut impl Write) -> Result<()> {
        // Held to the end, so that no block is in the tiles and not here.
        let splats = self.splats();
        out.write_all(&splats.as_ref().map_or(0.0, |splats| splats.scale()).to_le_bytes())?;
        (0..self.tile_count()).try_for_each(|tile| self.read(tile, |film| film.write(out)))?;
        splats.map_or(Ok(()), |splats| splats.write(out))
    }

    /// Takes what [`Film::write`] has written of a film of the same settings.
    pub(crate) fn fill(&mut self, input: &mut impl Read) -> Result<()> {
        let most = block_at(self.plan.range.end, self.plan.samples).unwrap_or(0);
        let values = self.layout.channels * BATCH;
        let mut scale = [0; 8];
        input.read_exact(&mut scale)?;
        let scale = Some(f64::from_le_bytes(scale)).filter(|scale| *scale > 0.0 && scale.is_finite());
        self.splats = scale.map(|scale| Mutex::new(SplatFilm::scaled(&self.layout, self.window, (self.brought, self.limits), scale)));
        for tile in 0..self.tile_count() {
            let mut film = self.tile(tile);
            film.fill(input, values)?;
            if !(self.plan.first()..=most).contains(&film.next) {
                return Err(damaged("a tile's number of blocks"));
            }
        }
        self.splats().map_or(Ok(()), |mut splats| splats.fill(input))
    }
}

impl TileFilm {
    fn write(&self, out: &mut impl Write) -> Result<()> {
        let Sums { leading, groups, open } = &self.sums;
        out.write_all(&self.next.to_le_bytes())?;
        out.write_all(&self.zones.to_le_bytes())?;
        self.samples.iter().try_for_each(|samples| out.write_all(&samples.to_le_bytes()))?;
        [leading.len(), groups.len(), usize::from(!open.is_empty())].iter().try_for_each(|n| out.write_all(&(*n as u32).to_le_bytes()))?;
        leading.iter().try_for_each(|block| out.write_all(bytemuck::cast_slice(block)))?;
        groups.iter().chain(Some(open)).try_for_each(|group| out.write_all(bytemuck::cast_slice(group)))?;
        self.halves.as_ref().map_or(Ok(()), |halves| halves.write(out))?;
        self.mattes.iter().try_for_each(|matte| matte.write(out))?;
        self.deep.as_ref().map_or(Ok(()), |deep| deep.write(out))
    }

    fn fill(&mut self, input: &mut impl Read, values: usize) -> Result<()> {
        self.next = number(input)?;
        self.zones &= u64::from(number(input)?) | u64::from(number(input)?) << 32;
        for samples in &mut self.samples {
            *samples = number(input)?;
        }
        let [leading, groups, open] = [number(input)?, number(input)?, number(input)?];
        self.sums.leading = (0..leading).map(|_| array(input, values)).collect::<Result<_>>()?;
        self.sums.groups = (0..groups).map(|_| array(input, values)).collect::<Result<_>>()?;
        self.sums.open = if open == 0 { Vec::new() } else { array(input, values)? };
        if let Some(halves) = &mut self.halves {
            *halves = Halves::read(input)?;
        }
        for matte in &mut self.mattes {
            *matte = Matte::read(input)?;
        }
        if let Some(deep) = &mut self.deep {
            *deep = Deep::read(input)?;
        }
        Ok(())
    }
}

fn damaged(what: &str) -> Error {
    Error::new(ErrorKind::InvalidData, format!("{what} is out of range"))
}
