//! When the blinds of groups of windows are closed (LM-83-12, 2.2.6): when more than 2 % of the points get direct sun by all groups together, groups close
//! until no more do. Of the ways to do so that which leaves most light is taken.

/// Direct sun that has blinds closed, lx.
const TOO_BRIGHT: f32 = 1000.0;
/// Blinds close when more than this share of the points has it.
const TOO_MANY: f64 = 0.02;
/// Up to so many groups all ways to close them are tried; of more one after the other closes.
const TRIED: usize = 8;

/// A group's light in some steps, at `[point][step]` in lx.
pub(super) struct GroupLight {
    pub(super) open: Vec<f32>,
    /// Of the sun through open windows; none where it is not known.
    pub(super) direct: Option<Vec<f32>>,
    /// Whether there are blinds.
    pub(super) has_blinds: bool,
}

/// By group, in which steps its blinds are closed; `closed` gives what then comes in, asked for when any step wants it.
pub(super) fn operated(groups: &[GroupLight], steps: usize, closed: impl Fn(usize) -> Vec<f32>) -> Vec<Option<Operated>> {
    let operable: Vec<usize> = (0..groups.len()).filter(|group| groups[*group].has_blinds && groups[*group].direct.is_some()).collect();
    let too_sunny = too_sunny(groups, steps);
    let mut found: Vec<Option<Operated>> = groups.iter().map(|_| None).collect();
    if operable.is_empty() || !too_sunny.contains(&true) {
        return found;
    }
    for group in &operable {
        found[*group] = Some(Operated { light: closed(*group), steps: vec![false; steps] });
    }
    for step in (0..steps).filter(|step| too_sunny[*step]) {
        let choice = Choice::new(groups, &found, (&operable, steps, step));
        for (number, group) in operable.iter().enumerate() {
            if let (true, Some(operated)) = (choice.closes(number), &mut found[*group]) {
                operated.steps[step] = true;
            }
        }
    }
    found
}

/// A group whose blinds may be closed.
pub(super) struct Operated {
    /// What closed ones let in.
    pub(super) light: Vec<f32>,
    /// In which steps they are.
    pub(super) steps: Vec<bool>,
}

/// In which steps more than 2 % of the points get direct sun by all groups.
fn too_sunny(groups: &[GroupLight], steps: usize) -> Vec<bool> {
    let direct: Vec<&[f32]> = groups.iter().filter_map(|group| group.direct.as_deref()).collect();
    let points = direct.first().map_or(0, |rows| rows.len() / steps);
    let mut sunny = vec![0_usize; steps];
    for row in 0..points {
        for (step, sunny) in sunny.iter_mut().enumerate() {
            *sunny += usize::from(direct.iter().map(|rows| rows[row * steps + step]).sum::<f32>() >= TOO_BRIGHT);
        }
    }
    sunny.into_iter().map(|count| is_too_many(count, points)).collect()
}

fn is_too_many(count: usize, points: usize) -> bool {
    count as f64 > TOO_MANY * points as f64
}

/// Which groups close in a step, a bit each.
struct Choice {
    closed: usize,
}

impl Choice {
    fn closes(&self, number: usize) -> bool {
        self.closed >> number & 1 != 0
    }

    fn new(groups: &[GroupLight], closed: &[Option<Operated>], (operable, steps, step): (&[usize], usize, usize)) -> Self {
        let column = |rows: &[f32]| -> Vec<f32> { rows.iter().skip(step).step_by(steps).copied().collect() };
        let sun = |group: usize| groups[group].direct.as_deref().map(column).unwrap_or_default();
        // Of groups that cannot close, and of each that can.
        let always = (0..groups.len()).filter(|group| !operable.contains(group)).map(sun).fold(Vec::new(), |all: Vec<f32>, one| {
            if all.is_empty() { one } else { all.iter().zip(one.iter().chain(std::iter::repeat(&0.0))).map(|(a, b)| a + b).collect() }
        });
        let suns: Vec<Vec<f32>> = operable.iter().map(|group| sun(*group)).collect();
        let points = suns.first().map_or(0, Vec::len);
        let is_sunny = |mask: usize, point: usize| {
            let of_open = suns.iter().enumerate().filter(|(number, _)| mask >> number & 1 == 0).map(|(_, sun)| sun[point]);
            always.get(point).copied().unwrap_or(0.0) + of_open.sum::<f32>() >= TOO_BRIGHT
        };
        let sunny = |mask: usize| (0..points).filter(|point| is_sunny(mask, *point)).count();
        // What closing a group takes away.
        let taken: Vec<f64> = operable
            .iter()
            .map(|group| {
                let sum = |rows: &[f32]| rows.iter().skip(step).step_by(steps).map(|value| f64::from(*value)).sum::<f64>();
                sum(&groups[*group].open) - closed[*group].as_ref().map_or(0.0, |closed| sum(&closed.light))
            })
            .collect();
        let all = (1 << operable.len().min(usize::BITS as usize - 1)) - 1;
        let cost =
            |mask: usize| taken.iter().enumerate().filter(|(number, _)| mask >> number & 1 != 0).map(|(_, taken)| taken).sum::<f64>();
        if operable.len() > TRIED {
            return Self { closed: one_by_one(operable.len(), points, sunny, cost) };
        }
        let mut ways: Vec<(f64, usize)> = (0..=all).map(|mask| (cost(mask), mask)).collect();
        ways.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        let enough = ways.into_iter().find(|(_, mask)| !is_too_many(sunny(*mask), points));
        Self { closed: enough.map_or(all, |(_, mask)| mask) }
    }
}

/// Closes that group first which takes the sun from most points, of equals that which costs least.
fn one_by_one(count: usize, points: usize, sunny: impl Fn(usize) -> usize, cost: impl Fn(usize) -> f64) -> usize {
    let mut mask = 0;
    while is_too_many(sunny(mask), points) {
        let next = (0..count).map(|number| mask | 1 << number).filter(|more| *more != mask);
        let best = next.min_by(|a, b| sunny(*a).cmp(&sunny(*b)).then(cost(*a).total_cmp(&cost(*b))));
        let Some(best) = best else { break };
        mask = best;
    }
    mask
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A group of 100 points in one step, with sun on some.
    fn group(sunny: std::ops::Range<usize>, open: f32) -> GroupLight {
        let direct = (0..100).map(|point| if sunny.contains(&point) { 2000.0 } else { 0.0 }).collect();
        GroupLight { open: vec![open; 100], direct: Some(direct), has_blinds: true }
    }

    fn which(groups: &[GroupLight]) -> Vec<bool> {
        let found = operated(groups, 1, |group| vec![0.1 * groups[group].open[0]; 100]);
        found.iter().map(|found| found.as_ref().is_some_and(|found| found.steps[0])).collect()
    }

    #[test]
    fn groups_count_together() {
        // Two points each are four: one has to close, that which takes less light away.
        assert_eq!(which(&[group(0..2, 500.0), group(10..12, 300.0)]), [false, true]);
        assert_eq!(which(&[group(0..2, 500.0)]), [false]);
        assert_eq!(which(&[group(0..3, 500.0)]), [true]);
        // The same two points twice are two.
        assert_eq!(which(&[group(0..2, 500.0), group(0..2, 300.0)]), [false, false]);
        // Both have to.
        assert_eq!(which(&[group(0..3, 500.0), group(10..13, 300.0)]), [true, true]);
        // What cannot close counts.
        let mut bare = group(0..2, 500.0);
        bare.has_blinds = false;
        assert_eq!(which(&[bare, group(10..12, 300.0)]), [false, true]);
    }

    #[test]
    fn many_groups_close_one_after_the_other() {
        let groups: Vec<GroupLight> = (0..12).map(|number| group(2 * number..2 * number + 2, 500.0)).collect();
        let closed = which(&groups);
        assert_eq!(closed.iter().filter(|closed| **closed).count(), 11);
    }
}
