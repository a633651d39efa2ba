//! Finished rounds on disk: what they are of, then by tracing the rounds that are there and the suns, as floats.

use crate::{
    checkpoint::{
        Stamp,
        described::{Described, write_described},
    },
    error::{Error, Result},
    measure::{Kept, ROUNDS, Round, SkyTask},
    scene::{Digest, Meter, Scene},
};
use gonio_simd::Execution;
use serde::{Deserialize, Serialize};
use std::{
    io::{self, Read},
    path::Path,
};

const FIRST_LINE: &str = "gonio daylight 1\n";

/// What a tracing's rounds are of.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) struct Traced {
    #[serde(flatten)]
    stamp: Stamp,
    /// Points, and a digest of where they lie.
    points: (usize, u64),
    patches: usize,
    /// Groups of prims that light is told apart by.
    openings: Vec<Vec<String>>,
    /// Suns, and a digest of where they and the zenith stand.
    suns: (usize, u64),
    /// What of it is there.
    rounds: Vec<usize>,
    has_suns: bool,
}

impl Traced {
    pub(super) fn new(scene: &Scene, points: &[Meter], sky: &SkyTask<'_>, execution: Execution) -> Self {
        let digest = |numbers: &mut dyn Iterator<Item = f64>| {
            let mut digest = Digest::default();
            numbers.for_each(|number| digest.add(&number.to_le_bytes()));
            digest.value()
        };
        let places = digest(&mut points.iter().flat_map(|point| [point.position, point.normal]).flatten());
        Self {
            stamp: Stamp::new(scene, execution),
            points: (points.len(), places),
            patches: sky.patches,
            openings: sky.openings.to_vec(),
            suns: (sky.suns.len(), digest(&mut sky.suns.iter().chain([&sky.up]).flatten().copied())),
            rounds: Vec::new(),
            has_suns: false,
        }
    }

    /// Refuses rounds in `path`, which are of `other`.
    fn check(&self, other: &Self, path: &Path) -> Result<()> {
        let problem = if other.points.0 != self.points.0 {
            format!("its {} points are others than the {} that were asked for", other.points.0, self.points.0)
        } else if other.points != self.points {
            "its points lie elsewhere".to_owned()
        } else if other.patches != self.patches {
            format!("its sky has {} patches, {} were asked for", other.patches, self.patches)
        } else if other.openings != self.openings {
            format!("it tells light apart by the groups {:?}, {:?} were asked for", other.openings, self.openings)
        } else if other.suns != self.suns {
            "its suns stand elsewhere: it is of weather of another place, or north or the sun's position were others".to_owned()
        } else {
            return self.stamp.check(&other.stamp, path, &[]);
        };
        Err(refused(path, &problem))
    }

    /// With what is there.
    fn with(&self, kept: &Kept) -> Self {
        let rounds = (0..ROUNDS).filter(|round| kept.rounds[*round].is_some()).collect();
        Self { rounds, has_suns: kept.suns.is_some(), ..self.clone() }
    }

    /// Rows: all points for each part that light is told apart in.
    fn rows(&self) -> usize {
        self.points.0 * if self.openings.is_empty() { 1 } else { self.openings.len() + 1 }
    }

    /// Bytes of its bits, as far as they are there.
    fn bytes(&self) -> u64 {
        let of_points = |count: usize| 4 * self.rows() as u64 * count as u64;
        2 * self.rounds.len() as u64 * of_points(self.patches) + if self.has_suns { of_points(self.suns.0) } else { 0 }
    }

    fn read(&self, input: &mut impl Read) -> io::Result<Kept> {
        let mut kept = Kept::default();
        let mut floats = |count: usize| {
            let mut values = vec![0.0_f32; self.rows() * count];
            input.read_exact(bytemuck::cast_slice_mut(&mut values)).map(|()| values)
        };
        for round in &self.rounds {
            let place =
                kept.rounds.get_mut(*round).ok_or_else(|| io::Error::new(io::ErrorKind::InvalidData, format!("a round {round}")))?;
            *place = Some(Round { all: floats(self.patches)?, scattered: floats(self.patches)? });
        }
        if self.has_suns {
            kept.suns = Some(floats(self.suns.0)?);
        }
        Ok(kept)
    }
}

fn refused(path: &Path, problem: &str) -> Error {
    Error::Format { path: path.to_owned(), line: None, problem: format!("this checkpoint cannot be used: {problem}") }
}

/// Writes what there is of some tracings, whole or not at all.
pub(super) fn write(path: &Path, tracings: &[Traced], kept: &[&Kept]) -> Result<()> {
    let described: Vec<Traced> = tracings.iter().zip(kept).map(|(traced, kept)| traced.with(kept)).collect();
    write_described(path, FIRST_LINE, &described, |out| {
        for kept in kept {
            for round in kept.rounds.iter().flatten() {
                out.write_all(bytemuck::cast_slice(&round.all))?;
                out.write_all(bytemuck::cast_slice(&round.scattered))?;
            }
            kept.suns.iter().try_for_each(|suns| out.write_all(bytemuck::cast_slice(suns)))?;
        }
        Ok(())
    })
}

/// Reads what there is of some tracings; one of others is an error that says what differs.
pub(super) fn read(path: &Path, wanted: &[Traced]) -> Result<Vec<Kept>> {
    let (mut file, found) = Described::open::<Vec<Traced>>(path, FIRST_LINE)?;
    if found.len() != wanted.len() {
        return Err(refused(path, &format!("{} states of blinds were traced, {} were asked for", found.len(), wanted.len())));
    }
    wanted.iter().zip(&found).try_for_each(|(wanted, found)| wanted.check(found, path))?;
    if found.iter().map(Traced::bytes).sum::<u64>() > file.length {
        return Err(file.broken("the checkpoint is shorter than its rounds"));
    }
    let kept = found.iter().map(|found| found.read(&mut file.input)).collect::<io::Result<Vec<_>>>();
    let kept = kept.map_err(|error| file.damaged(&error))?;
    file.end().map(|()| kept)
}
