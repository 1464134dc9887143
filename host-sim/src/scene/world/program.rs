//! Compounds as programs: which objects are shown, of which leaves each is made, and how.
//!
//! Names are resolved without recursion, so that a file of any depth is answered.

use std::collections::HashMap;

use attractor::trace::world::Op;

use super::object::{Form, Thing};
use super::placement::Step;
use crate::fail::Fail;
use crate::source::Source;

/// The most leaves of a world.
pub(crate) const LEAVES: usize = 64;

/// A shape of the world: which table has it, the steps that put it there, and the table that names its
/// material.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Part {
    pub(crate) thing: usize,
    pub(crate) steps: Vec<Step>,
    pub(crate) made_of: Option<usize>,
}

/// An object that is shown.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Compound {
    pub(crate) thing: usize,
    pub(crate) ops: Vec<Op>,
}

/// All that is shown.
#[derive(Debug, Default)]
pub(crate) struct Programs {
    pub(crate) parts: Vec<Part>,
    pub(crate) objects: Vec<Compound>,
}

/// Which tables each table is made of.
struct Graph<'a> {
    things: &'a [Thing],
    source: &'a Source,
    operands: Vec<Vec<usize>>,
}

impl<'a> Graph<'a> {
    fn new(source: &'a Source, things: &'a [Thing]) -> Result<Self, Fail> {
        let mut numbers = HashMap::new();
        for (number, thing) in things.iter().enumerate() {
            let Some(name) = &thing.name else { continue };
            if numbers.insert(name.get_ref().as_str(), number).is_some() {
                return Err(source.fail(name.span(), "object.name", "another object has this name"));
            }
        }
        let mut operands = Vec::new();
        for (number, thing) in things.iter().enumerate() {
            let prefix = thing.prefix(number);
            thing.check_keys(source, &prefix)?;
            let mut all = Vec::new();
            if let Some(of) = &thing.of {
                if of.get_ref().len() < 2 {
                    return Err(source.fail(
                        of.span(),
                        &format!("{prefix}of"),
                        "a compound is made of two objects at least",
                    ));
                }
                for (i, name) in of.get_ref().iter().enumerate() {
                    let key = format!("{prefix}of[{i}]");
                    match numbers.get(name.get_ref().as_str()) {
                        Some(operand) => all.push(*operand),
                        None => {
                            return Err(source.fail(name.span(), &key, "there is no object of this name"));
                        }
                    }
                }
            }
            operands.push(all);
        }
        Ok(Self { things, source, operands })
    }

    /// The tables so that each comes after all that it is made of.
    fn sorted(&self) -> Result<Vec<usize>, Fail> {
        let mut users = vec![Vec::new(); self.operands.len()];
        let mut missing: Vec<usize> = self.operands.iter().map(Vec::len).collect();
        for (number, operands) in self.operands.iter().enumerate() {
            operands.iter().for_each(|operand| users[*operand].push(number));
        }
        let mut sorted: Vec<usize> = (0..missing.len()).filter(|number| missing[*number] == 0).collect();
        let mut at = 0;
        while let Some(number) = sorted.get(at).copied() {
            at += 1;
            for user in &users[number] {
                missing[*user] -= 1;
                if missing[*user] == 0 {
                    sorted.push(*user);
                }
            }
        }
        match missing.iter().position(|missing| *missing > 0) {
            None => Ok(sorted),
            Some(stuck) => Err(self.cycle(stuck, &missing)),
        }
    }

    /// Of the tables that miss something, those from `start` on that come round to themselves.
    fn cycle(&self, start: usize, missing: &[usize]) -> Fail {
        let next =
            |number: usize| self.operands[number].iter().copied().find(|operand| missing[*operand] > 0);
        let (mut way, mut at) = (Vec::new(), start);
        while !way.contains(&at) {
            way.push(at);
            at = next(at).unwrap_or(start);
        }
        let round: Vec<&str> = way
            .iter()
            .skip_while(|number| **number != at)
            .chain([&at])
            .filter_map(|number| self.things[*number].name.as_ref())
            .map(|name| name.get_ref().as_str())
            .collect();
        let of = self.things[at].of.as_ref().map_or(0..0, toml::Spanned::span);
        let key = format!("{}of", self.things[at].prefix(at));
        self.source.fail(of, &key, format!("an object cannot be a part of itself: {}", round.join(" of ")))
    }
}

/// Follows the names of a file.
pub(super) fn programs(source: &Source, things: &[Thing]) -> Result<Programs, Fail> {
    let graph = Graph::new(source, things)?;
    let sorted = graph.sorted()?;
    // leaves that a table is made of
    let mut leaves = vec![1_u64; things.len()];
    let mut shown = vec![true; things.len()];
    for number in sorted {
        let operands = &graph.operands[number];
        if !operands.is_empty() {
            leaves[number] =
                operands.iter().fold(0, |sum: u64, operand| sum.saturating_add(leaves[*operand]));
        }
        operands.iter().for_each(|operand| shown[*operand] = false);
    }
    let shown = || (0..things.len()).filter(|number| shown[*number]);
    let needed = shown().fold(0, |sum: u64, number| sum.saturating_add(leaves[number]));
    if needed > LEAVES as u64 {
        let reason = format!(
            "{needed} shapes, those of compounds counted as often as they are used; there is room for {LEAVES}"
        );
        return Err(source.fail_all("object", reason));
    }
    let mut programs = Programs::default();
    let placements = things
        .iter()
        .enumerate()
        .map(|(number, thing)| thing.placement().compile(source, &thing.prefix(number)))
        .collect::<Result<Vec<_>, Fail>>()?;
    for number in shown() {
        let mut ops = Vec::new();
        emit(&graph, &placements, number, &mut programs.parts, &mut ops);
        programs.objects.push(Compound { thing: number, ops });
    }
    Ok(programs)
}

/// What is still to be done of a compound.
enum Task {
    /// A table inside compounds: their steps, the innermost first, and the nearest table with a material.
    Thing {
        number: usize,
        around: Vec<Step>,
        made_of: Option<usize>,
    },
    Op(Op),
}

fn emit(
    graph: &Graph<'_>,
    placements: &[Vec<Step>],
    number: usize,
    parts: &mut Vec<Part>,
    ops: &mut Vec<Op>,
) {
    let mut tasks = vec![Task::Thing { number, around: Vec::new(), made_of: None }];
    while let Some(task) = tasks.pop() {
        match task {
            Task::Op(op) => ops.push(op),
            Task::Thing { number, around, made_of } => {
                let thing = &graph.things[number];
                let steps: Vec<Step> = placements[number].iter().chain(&around).copied().collect();
                let made_of = if thing.material.is_some() { Some(number) } else { made_of };
                let op = match thing.shape.get_ref() {
                    Form::Union => Op::Union,
                    Form::Intersection => Op::Intersection,
                    Form::Difference => Op::Difference,
                    _ => {
                        ops.push(Op::Leaf(parts.len() as u8));
                        parts.push(Part { thing: number, steps, made_of });
                        continue;
                    }
                };
                // the first operand is on top of the pile, an operation behind each of the others
                for (i, operand) in graph.operands[number].iter().enumerate().rev() {
                    if i > 0 {
                        tasks.push(Task::Op(op));
                    }
                    tasks.push(Task::Thing { number: *operand, around: steps.clone(), made_of });
                }
            }
        }
    }
}
