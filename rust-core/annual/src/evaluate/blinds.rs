//! When the blinds of groups of windows are closed: by a schedule, or by direct sun (LM-83-12, 2.2.6). By direct sun: when more than 2 % of the points get direct sun by all groups together, groups close
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
    /// In which steps they are closed, where a schedule says so.
    pub(super) closed: Option<Vec<bool>>,
}

impl GroupLight {
    /// Whether a schedule has its blinds closed in a step.
    fn is_closed(&self, step: usize) -> bool {
        self.has_blinds && self.closed.as_ref().is_some_and(|closed| closed[step])
    }

    /// Whether direct sun closes its blinds.
    fn is_operable(&self) -> bool {
        self.has_blinds && self.closed.is_none() && self.direct.is_some()
    }
}

/// By group, in which steps its blinds are closed; `closed` gives what then comes in, asked for when any step wants it.
pub(super) fn operated(groups: &[GroupLight], steps: usize, closed: impl Fn(usize) -> ClosedLight) -> Vec<Option<Operated>> {
    let operable: Vec<usize> = (0..groups.len()).filter(|group| groups[*group].is_operable()).collect();
    let too_sunny = too_sunny(groups, steps);
    let scheduled = |(number, group): (usize, &GroupLight)| {
        let steps = group.closed.clone().filter(|closed| group.has_blinds && closed.contains(&true))?;
        Some(Operated { light: closed(number), steps })
    };
    let mut found: Vec<Option<Operated>> = groups.iter().enumerate().map(scheduled).collect();
    if operable.is_empty() || !too_sunny.contains(&true) {
        return found;
    }
    for group in &operable {
        found[*group] = Some(Operated { light: closed(*group), steps: vec![false; steps] });
    }
    for step in (0..steps).filter(|step| too_sunny[*step]) {
        for group in Step::new(groups, &found, steps, step).closed(&operable) {
            if let Some(operated) = &mut found[group] {
                operated.steps[step] = true;
            }
        }
    }
    found
}

/// What closed blinds let in, at `[point][step]` in lx.
pub(super) struct ClosedLight {
    /// All light.
    pub(super) all: Vec<f32>,
    /// Of the sun alone; none where it is not known.
    pub(super) sun: Option<Vec<f32>>,
}

/// A group whose blinds may be closed.
pub(super) struct Operated {
    /// What closed ones let in.
    pub(super) light: ClosedLight,
    /// In which steps they are.
    pub(super) steps: Vec<bool>,
}

/// In which steps more than 2 % of the points get direct sun by all groups that no schedule has closed.
fn too_sunny(groups: &[GroupLight], steps: usize) -> Vec<bool> {
    let direct: Vec<(&GroupLight, &[f32])> = groups.iter().filter_map(|group| Some((group, group.direct.as_deref()?))).collect();
    let points = direct.first().map_or(0, |(_, rows)| rows.len() / steps);
    let mut sunny = vec![0_usize; steps];
    for row in 0..points {
        for (step, sunny) in sunny.iter_mut().enumerate() {
            let open = direct.iter().filter(|(group, _)| !group.is_closed(step));
            *sunny += usize::from(open.map(|(_, rows)| rows[row * steps + step]).sum::<f32>() >= TOO_BRIGHT);
        }
    }
    sunny.into_iter().map(|count| is_too_many(count, points)).collect()
}

fn is_too_many(count: usize, points: usize) -> bool {
    count as f64 > TOO_MANY * points as f64
}

/// The groups in a step.
struct Step {
    /// By group, the direct sun at each point; empty where it is not known.
    suns: Vec<Vec<f32>>,
    /// By group, what closing it takes away.
    costs: Vec<f64>,
}

impl Step {
    fn new(groups: &[GroupLight], closed: &[Option<Operated>], steps: usize, step: usize) -> Self {
        let column = |rows: &[f32]| -> Vec<f32> { rows.iter().skip(step).step_by(steps).copied().collect() };
        let sum = |rows: &[f32]| column(rows).into_iter().map(f64::from).sum::<f64>();
        let cost = |(group, closed): (&GroupLight, &Option<Operated>)| {
            closed.as_ref().map_or(0.0, |closed| sum(&group.open) - sum(&closed.light.all))
        };
        Self {
            suns: groups
                .iter()
                .map(|group| group.direct.as_deref().filter(|_| !group.is_closed(step)).map(column).unwrap_or_default())
                .collect(),
            costs: groups.iter().zip(closed).map(cost).collect(),
        }
    }

    /// Which of the groups that can close do.
    fn closed(&self, operable: &[usize]) -> Vec<usize> {
        if operable.len() > TRIED {
            return self.one_by_one(operable);
        }
        let chosen =
            |mask: u32| operable.iter().enumerate().filter(|(number, _)| mask >> number & 1 != 0).map(|(_, group)| *group).collect();
        let mut ways: Vec<Vec<usize>> = (0..1 << operable.len()).map(chosen).collect();
        ways.sort_by(|a, b| self.cost(a).total_cmp(&self.cost(b)));
        ways.into_iter().find(|way| !self.is_too_sunny(way)).unwrap_or_else(|| operable.to_vec())
    }

    /// Closes that group first which takes the sun from most points, of equals that which costs least.
    fn one_by_one(&self, operable: &[usize]) -> Vec<usize> {
        let (mut closed, mut rest) = (Vec::new(), operable.to_vec());
        while self.is_too_sunny(&closed) && !rest.is_empty() {
            let sunny = |group: usize| self.sunny(&[closed.as_slice(), &[group]].concat());
            let best = (0..rest.len()).min_by(|a, b| {
                let [a, b] = [rest[*a], rest[*b]];
                sunny(a).cmp(&sunny(b)).then(self.costs[a].total_cmp(&self.costs[b]))
            });
            closed.extend(best.map(|best| rest.remove(best)));
        }
        closed
    }

    fn cost(&self, closed: &[usize]) -> f64 {
        closed.iter().map(|group| self.costs[*group]).sum()
    }

    /// Points with direct sun while these groups are closed.
    fn sunny(&self, closed: &[usize]) -> usize {
        let open: Vec<&[f32]> = self
            .suns
            .iter()
            .enumerate()
            .filter(|(group, sun)| !closed.contains(group) && !sun.is_empty())
            .map(|(_, sun)| sun.as_slice())
            .collect();
        (0..self.points()).filter(|point| open.iter().map(|sun| sun[*point]).sum::<f32>() >= TOO_BRIGHT).count()
    }

    fn points(&self) -> usize {
        self.suns.iter().map(Vec::len).max().unwrap_or(0)
    }

    fn is_too_sunny(&self, closed: &[usize]) -> bool {
        is_too_many(self.sunny(closed), self.points())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A group of 100 points in one step, with sun on some.
    fn group(sunny: std::ops::Range<usize>, open: f32) -> GroupLight {
        let direct = (0..100).map(|point| if sunny.contains(&point) { 2000.0 } else { 0.0 }).collect();
        GroupLight { open: vec![open; 100], direct: Some(direct), has_blinds: true, closed: None }
    }

    fn which(groups: &[GroupLight]) -> Vec<bool> {
        let found = operated(groups, 1, |group| ClosedLight { all: vec![0.1 * groups[group].open[0]; 100], sun: None });
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
    fn schedules_close_what_they_say() {
        let scheduled = |sunny, closed| GroupLight { closed: Some(vec![closed]), ..group(sunny, 500.0) };
        // Sun or none: it is the schedule's to say.
        assert_eq!(which(&[scheduled(0..0, true)]), [true]);
        assert_eq!(which(&[scheduled(0..50, false)]), [false]);
        // What it has closed brings no sun that others had to close for; what it leaves open does.
        assert_eq!(which(&[scheduled(0..2, true), group(10..12, 300.0)]), [true, false]);
        assert_eq!(which(&[scheduled(0..2, false), group(10..12, 300.0)]), [false, true]);
    }

    #[test]
    fn many_groups_close_one_after_the_other() {
        let groups: Vec<GroupLight> = (0..12).map(|number| group(2 * number..2 * number + 2, 500.0)).collect();
        let closed = which(&groups);
        assert_eq!(closed.iter().filter(|closed| **closed).count(), 11);
        // More groups than a word has bits.
        let one_point_each: Vec<GroupLight> = (0..80).map(|number| group(number..number + 1, 500.0)).collect();
        assert_eq!(which(&one_point_each).iter().filter(|closed| **closed).count(), 78);
    }
}
