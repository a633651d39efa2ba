//! The linear program, solved goal after goal.

use crate::{
    error::DimmingError,
    problem::{Goal, Group, Problem},
    rows::{Row, rows},
};
use microlp::{ComparisonOp, LinearExpr, OptimizationDirection, Variable};

/// What an earlier goal may give way for a later one: less than the solver's tolerance, so that there is room for its rounding and for nothing else.
const SLACK: f64 = 1e-9;
/// What a level may be off the end of its range to count as on it: finer than any dimmer, and coarser than the solver's tolerance.
const SNAP: f64 = 1e-6;

/// A goal: the least sum of variables times factors.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Aim {
    /// What targets are missed by.
    Shortfall,
    /// How far levels are from where they should be.
    Spread,
    /// Power, as a share of the full one.
    Power,
}

/// A program with what the goals before leave it.
#[derive(Debug)]
pub(crate) struct Program<'a> {
    problem: &'a Problem,
    rows: Vec<Row>,
    reached: Vec<(Aim, f64)>,
}

/// Variables of one run.
struct Variables {
    levels: Vec<Variable>,
    shortfalls: Vec<Variable>,
    /// The greatest and, with a minus sign, the least of what levels should not be apart by.
    spread: Vec<(Variable, f64)>,
}

impl<'a> Program<'a> {
    pub(crate) fn new(problem: &'a Problem) -> Result<Self, DimmingError> {
        Ok(Self { problem, rows: rows(problem)?, reached: Vec::new() })
    }

    /// Levels that miss the targets by least, and among these serve the goal best.
    pub(crate) fn levels(mut self) -> Result<Vec<f64>, DimmingError> {
        let mut levels = self.run(Aim::Shortfall)?;
        if self.problem.goal != Goal::LeastPower {
            levels = self.run(Aim::Spread)?;
        }
        if self.problem.groups.iter().any(|group| group.watts > 0.0) {
            levels = self.run(Aim::Power)?;
        }
        Ok(levels)
    }

    /// Runs for one goal, whose value later runs keep.
    fn run(&mut self, aim: Aim) -> Result<Vec<f64>, DimmingError> {
        let mut program = microlp::Problem::new(OptimizationDirection::Minimize);
        let variables = self.variables(&mut program, aim);
        for row in &self.rows {
            let mut sum: LinearExpr = variables.levels.iter().copied().zip(row.factors.iter().copied()).collect();
            sum.add(variables.shortfalls[row.target], 1.0);
            program.add_constraint(sum, ComparisonOp::Ge, -row.constant);
        }
        self.add_spread(&mut program, &variables);
        for (earlier, value) in &self.reached {
            let sum: LinearExpr = match earlier {
                Aim::Shortfall => variables.shortfalls.iter().map(|variable| (*variable, 1.0)).collect(),
                _ => variables.spread.iter().copied().collect(),
            };
            program.add_constraint(sum, ComparisonOp::Le, value * (1.0 + SLACK) + SLACK);
        }
        let told = |error: microlp::Error| DimmingError::Solver(error.to_string());
        let stopped = |_| DimmingError::Solver("it was stopped".to_owned());
        let found = program.solve().map_err(told)?.into_solution().map_err(stopped)?;
        self.reached.push((aim, found.objective()));
        let level = |(variable, group): (&Variable, &Group)| snapped(found.var_value(*variable), group.range);
        Ok(variables.levels.iter().zip(&self.problem.groups).map(level).collect())
    }

    fn variables(&self, program: &mut microlp::Problem, aim: Aim) -> Variables {
        let groups = &self.problem.groups;
        let full = groups.iter().map(|group| group.watts).sum::<f64>();
        let only = |wanted: Aim, factor: f64| if aim == wanted { factor } else { 0.0 };
        let level = |group: &Group| (only(Aim::Power, group.watts / full), (group.range[0], group.range[1]));
        let levels = groups.iter().map(level).map(|(factor, range)| program.add_var(factor, range)).collect();
        let shortfalls = self.problem.targets.iter().map(|_| program.add_var(only(Aim::Shortfall, 1.0), (0.0, f64::INFINITY))).collect();
        let signs: &[f64] = match self.problem.goal {
            Goal::LeastPower => &[],
            Goal::Near(_) => &[1.0],
            Goal::Equal => &[1.0, -1.0],
        };
        let spread = signs.iter().map(|sign| (program.add_var(only(Aim::Spread, *sign), (0.0, 1.0)), *sign)).collect();
        Variables { levels, shortfalls, spread }
    }

    /// What holds the spread's variables to the levels.
    fn add_spread(&self, program: &mut microlp::Problem, variables: &Variables) {
        let free = |k: &usize| self.problem.groups[*k].range[0] < self.problem.groups[*k].range[1];
        for (k, level) in variables.levels.iter().enumerate().filter(|(k, _)| free(k)) {
            match (&self.problem.goal, &variables.spread[..]) {
                (Goal::Near(wished), [(away, _)]) => {
                    let Some(wish) = wished.get(k).copied().flatten() else { continue };
                    program.add_constraint([(*away, 1.0), (*level, 1.0)], ComparisonOp::Ge, wish);
                    program.add_constraint([(*away, 1.0), (*level, -1.0)], ComparisonOp::Ge, -wish);
                }
                (Goal::Equal, [(greatest, _), (least, _)]) => {
                    program.add_constraint([(*greatest, 1.0), (*level, -1.0)], ComparisonOp::Ge, 0.0);
                    program.add_constraint([(*level, 1.0), (*least, -1.0)], ComparisonOp::Ge, 0.0);
                }
                _ => {}
            }
        }
    }
}

/// A level within its range, and on its end where it is as good as there.
fn snapped(level: f64, [least, most]: [f64; 2]) -> f64 {
    match level {
        x if x <= least + SNAP => least,
        x if x >= most - SNAP => most,
        x => x,
    }
}
