//! The same machine without composite states (spec/charts.md, "Composite states"), and without answers (`answer.rs`).
//!
//! In: a machine without errors, and its chart, in which it is known which machines take steps. Out: a machine whose control
//! states are the innermost ones. Its first shapes are those of the given machine; guards and actions that stand on the paths of
//! several states follow as copies, of the same name and at the same place.
//!
//! From each innermost state the paths of the states around it come first, from the outside in, and its own paths are taken
//! where none of these is open. What is done when composite states are left and entered stands on each path that does so. An
//! instance that a path around it may leave becomes a control state: of its two cases, that the pattern is at work and that it
//! has been left, the guard `isUndef(control)` tells.

use std::collections::BTreeMap;

use syntax::Span;

use crate::answer::without_answers;
use crate::build::{call, control_location, inner_control, instance_call, memory_location, of_instance, state_value};
use crate::chart::{Arrow, Chart, Composite, End, Machine, Shape, ShapeId, ShapeKind};
use crate::flow::{is_beside, is_block};
use crate::link::Link;

/// LIMIT: the most shapes of a flat machine.
const MAX_SHAPES: usize = 20_000;

/// LIMIT: the most shapes on a path, and the most patterns in a pattern.
const MAX_DEPTH: usize = 400;

/// The flat machine would have too many shapes, or paths too long.
pub(crate) struct TooLarge;

/// The machine without composite states and without answers; `None` if it has none of them.
pub(crate) fn flattened(chart: &Chart, machine: &Machine) -> Result<Option<Machine>, TooLarge> {
    let plain = without_answers(chart, machine);
    if !machine.shapes.iter().any(|shape| shape.composite().is_some()) {
        return Ok(plain);
    }
    let machine = plain.as_ref().unwrap_or(machine);
    let mut flat = Machine { arrows: Vec::new(), sequences: Vec::new(), flattened: None, ..machine.clone() };
    flat.shapes.iter_mut().for_each(|shape| shape.inside = None);
    let is_used = vec![false; flat.shapes.len()];
    let (copies, depth) = (BTreeMap::new(), 0);
    let mut flattener = Flattener { chart, machine, flat, is_used, copies, depth, is_too_large: false };
    flattener.run();
    if flattener.is_too_large { Err(TooLarge) } else { Ok(Some(flattener.flat)) }
}

struct Flattener<'c> {
    chart: &'c Chart,
    machine: &'c Machine,
    flat: Machine,
    /// Whether a shape of the machine stands on a path already.
    is_used: Vec<bool>,
    /// The shapes that stand for one of the machine on the paths of the present state.
    copies: BTreeMap<ShapeId, Vec<ShapeId>>,
    /// The shapes before the present one on its path.
    depth: usize,
    is_too_large: bool,
}

/// Paths that start at one place.
#[derive(Clone, Copy)]
struct From {
    /// The innermost state; none for the entering arrow.
    leaf: Option<ShapeId>,
    /// The composite state whose paths these are; none for those of the innermost state.
    around: Option<ShapeId>,
    /// Where a step goes on in which a guard has no exit for its value.
    otherwise: Option<End>,
    /// What a path does does not count, only whether it is open: it ends with nothing.
    only_tests: bool,
}

/// What stands for the shapes of a path, each once.
type Copies = BTreeMap<ShapeId, Option<End>>;

impl Flattener<'_> {
    fn run(&mut self) {
        let enter = From { leaf: None, around: None, otherwise: None, only_tests: false };
        for arrow in self.machine.out_of(End::Enter) {
            let to = self.copy(enter, arrow.to, arrow.span);
            self.start(End::Enter, to, arrow.span);
        }
        let beside = self.machine.sequences.iter().filter(|all| all.iter().all(|id| is_beside(self.machine, *id)));
        self.flat.sequences.extend(beside.cloned());
        self.sequences();
        let leaves: Vec<ShapeId> = self.machine.numbered().map(|(id, _)| id).filter(|id| self.is_leaf(*id)).collect();
        for leaf in leaves {
            if self.is_too_large {
                return;
            }
            self.copies.clear();
            let mut around = self.machine.around(leaf);
            around.retain(|outer| self.machine.out_of(End::Shape(*outer)).next().is_some());
            let span = self.machine.shape(leaf).span;
            for end in self.begin(leaf, &around) {
                self.start(End::Shape(leaf), Some(end), span);
            }
            if self.is_interruptible(leaf) {
                let shape = &mut self.flat.shapes[leaf.0];
                (shape.kind, shape.link) = (ShapeKind::State { initial: false }, None);
            }
            self.sequences();
        }
    }

    fn is_leaf(&self, id: ShapeId) -> bool {
        matches!(self.machine.shape(id).kind, ShapeKind::State { .. }) || is_block(self.chart, self.machine, id)
    }

    /// Whether a path around an instance may leave it while its pattern is at work, or another one whose pattern has the same
    /// control variable.
    fn is_interruptible(&self, id: ShapeId) -> bool {
        let leaves = |outer: &ShapeId| self.machine.out_of(End::Shape(*outer)).next().is_some();
        let control = |id: ShapeId| inner_control(self.chart, self.machine.shape(id));
        let is_left = |other: ShapeId| self.machine.around(other).iter().any(leaves) && control(other) == control(id);
        let mut all = self.machine.numbered().map(|(other, _)| other);
        is_block(self.chart, self.machine, id)
            && all.any(|other| is_block(self.chart, self.machine, other) && is_left(other))
    }

    /// Where the paths of an innermost state begin; `around` are the states around it that have paths, from the inside out.
    fn begin(&mut self, leaf: ShapeId, around: &[ShapeId]) -> Vec<End> {
        let Some((outer, inner)) = around.split_last() else { return self.own(leaf) };
        let rest = self.begin(leaf, inner);
        let arrows: Vec<Arrow> = self.machine.out_of(End::Shape(*outer)).copied().collect();
        let from = From { leaf: Some(leaf), around: Some(*outer), otherwise: None, only_tests: false };
        let mut ends = Vec::new();
        // One path takes the first of what comes otherwise along; for all else its tests are asked again.
        let mut rest = rest.into_iter();
        let along = if arrows.len() == 1 { rest.next() } else { None };
        for arrow in &arrows {
            ends.extend(self.copy(From { otherwise: along, ..from }, arrow.to, arrow.span));
        }
        for end in rest {
            let otherwise = arrows.iter().rev().try_fold(end, |otherwise, arrow| {
                let from = From { otherwise: Some(otherwise), only_tests: true, ..from };
                self.copy(from, arrow.to, arrow.span)
            });
            ends.extend(otherwise);
        }
        ends
    }

    /// Where the own paths of an innermost state begin.
    fn own(&mut self, leaf: ShapeId) -> Vec<End> {
        let arrows: Vec<Arrow> = self.machine.out_of(End::Shape(leaf)).copied().collect();
        let from = From { leaf: Some(leaf), around: None, otherwise: None, only_tests: false };
        if !self.is_interruptible(leaf) {
            return arrows.iter().filter_map(|arrow| self.copy(from, arrow.to, arrow.span)).collect();
        }
        let shape = self.machine.shape(leaf).clone();
        let inner = inner_control(self.chart, &shape).unwrap_or_default();
        let goes_on = self.action(&shape, "goes on", instance_call(self.chart, &shape));
        self.arrow(End::Shape(goes_on), None, End::Shape(leaf), shape.span);
        let mut ends = Vec::new();
        let mut after = arrows.iter().map(Some).collect::<Vec<_>>();
        if after.is_empty() {
            after.push(None);
        }
        for (index, arrow) in after.into_iter().enumerate() {
            let guard = self.made(&shape, ShapeKind::Guard, "has been left", format!("isUndef({inner})"));
            if let Some(arrow) = arrow
                && let Some(end) = self.copy(from, arrow.to, arrow.span)
            {
                self.arrow(End::Shape(guard), Some(true), end, arrow.span);
            }
            if index == 0 {
                self.arrow(End::Shape(guard), Some(false), End::Shape(goes_on), shape.span);
            }
            ends.push(End::Shape(guard));
        }
        ends
    }

    /// The paths from an end of the machine; `None` if none of them does anything.
    fn copy(&mut self, from: From, end: End, span: Span) -> Option<End> {
        self.copied(from, end, span, &mut Copies::new())
    }

    fn copied(&mut self, from: From, end: End, span: Span, known: &mut Copies) -> Option<End> {
        let inner = match end {
            End::Shape(id) if !self.is_leaf(id) && self.machine.shape(id).composite().is_none() => Some(id),
            _ => None,
        };
        let Some(id) = inner else {
            return if from.only_tests { None } else { Some(self.arrive(from, end, span)) };
        };
        if let Some(known) = known.get(&id) {
            return *known;
        }
        if self.depth > MAX_DEPTH {
            self.is_too_large = true;
            return None;
        }
        known.insert(id, None);
        self.depth += 1;
        let made = if self.machine.shape(id).kind == ShapeKind::Guard {
            let exits = [false, true].map(|branch| match self.machine.branch(id, branch).copied() {
                Some(arrow) => self.copied(from, arrow.to, arrow.span, known).map(|end| (end, arrow.span)),
                None => from.otherwise.map(|end| (end, span)),
            });
            exits.iter().any(Option::is_some).then(|| {
                let guard = self.fresh(id);
                for (branch, exit) in [false, true].into_iter().zip(exits) {
                    if let Some((end, span)) = exit {
                        self.arrow(End::Shape(guard), Some(branch), end, span);
                    }
                }
                End::Shape(guard)
            })
        } else {
            let arrow = self.machine.out_of(end).next().copied();
            let on = arrow.and_then(|arrow| Some((self.copied(from, arrow.to, arrow.span, known)?, arrow.span)));
            match on {
                Some((on, _)) if from.only_tests => Some(on),
                Some((on, span)) => {
                    let action = self.fresh(id);
                    self.arrow(End::Shape(action), None, on, span);
                    Some(End::Shape(action))
                }
                None => None,
            }
        };
        self.depth -= 1;
        known.insert(id, made);
        made
    }

    /// The end of a path: what it leaves, and what it enters.
    fn arrive(&mut self, from: From, target: End, span: Span) -> End {
        let around = from.leaf.map(|leaf| self.machine.around(leaf)).unwrap_or_default();
        // A path leaves the states that do not hold its target, and the one that it starts from or leads to.
        let target_around = match target {
            End::Shape(id) => self.machine.around(id),
            End::Enter | End::Exit => Vec::new(),
        };
        let stays = |outer: &ShapeId| target_around.contains(outer);
        let kept = around.iter().rev().take_while(|outer| stays(outer) && Some(**outer) != from.around).count();
        let left = around[..around.len() - kept].to_vec();
        let kept = around[around.len() - kept..].to_vec();
        let block = from.leaf.filter(|leaf| from.around.is_some() && is_block(self.chart, self.machine, *leaf));
        let aborted = block.map(|leaf| self.aborted(leaf)).unwrap_or_default();
        let mut done = Vec::new();
        for outer in left {
            let shape = self.machine.shape(outer).clone();
            let Some(Composite { history, exit, .. }) = shape.composite() else { continue };
            for action in exit {
                done.push(self.fresh(*action));
            }
            if let Some(leaf) = from.leaf.filter(|_| history.is_some()) {
                let memory = memory_location(self.machine, &shape);
                let value = state_value(self.chart, self.machine, leaf);
                done.push(self.action(&shape, "remembers", format!("{memory} := {value}")));
            }
        }
        let end = match target {
            End::Shape(id) => self.entered(from.leaf, id, &kept, &aborted, span),
            other => {
                done.extend(aborted.iter().map(|(rule, of)| self.action(of, "is aborted", rule.clone())));
                other
            }
        };
        self.chained(&done, end, span)
    }

    /// The way into a state from the innermost one `leaf`; `kept` are the states around it that the machine is in already,
    /// `aborted` what is done because patterns are left from outside.
    fn entered(
        &mut self,
        leaf: Option<ShapeId>,
        id: ShapeId,
        kept: &[ShapeId],
        aborted: &[(String, Shape)],
        span: Span,
    ) -> End {
        let shape = self.machine.shape(id).clone();
        let Some(composite) = shape.composite() else {
            let mut done = Vec::new();
            for outer in self.machine.around(id).into_iter().rev().filter(|outer| !kept.contains(outer)) {
                let Some(outer) = self.machine.shape(outer).composite().cloned() else { continue };
                for action in &outer.entry {
                    done.push(self.fresh(*action));
                }
            }
            let call = self.is_interruptible(id).then(|| instance_call(self.chart, &shape));
            match call {
                // The same pattern may be left and entered in one step.
                Some(call) if !aborted.is_empty() => {
                    let rules: Vec<&str> =
                        aborted.iter().map(|(rule, _)| rule.as_str()).chain([call.as_str()]).collect();
                    let rule = format!("seq {} endseq", rules.join(" "));
                    done.push(self.action(&shape, "is entered", rule));
                }
                call => {
                    done.extend(aborted.iter().map(|(rule, of)| self.action(of, "is aborted", rule.clone())));
                    done.extend(call.map(|call| self.action(&shape, "is entered", call)));
                }
            }
            return self.chained(&done, End::Shape(id), span);
        };
        let first = self.machine.numbered().find(|(_, inner)| inner.inside == Some(id) && inner.is_initial());
        let Some((first, _)) = first else { return End::Shape(id) };
        if composite.history.is_none() {
            return self.entered(leaf, first, kept, aborted, span);
        }
        // What is left and entered in one step is entered where it is left.
        let here = leaf.into_iter().flat_map(|leaf| std::iter::once(leaf).chain(self.machine.around(leaf)));
        if let Some(inner) = here.into_iter().find(|one| self.machine.shape(*one).inside == Some(id)) {
            return self.entered(leaf, inner, kept, aborted, span);
        }
        let mut end = self.entered(leaf, first, kept, aborted, span);
        let memory = memory_location(self.machine, &shape);
        let states = self.machine.numbered().filter(|(inner, one)| one.inside == Some(id) && *inner != first);
        for (inner, _) in states.collect::<Vec<_>>() {
            let leaves: Vec<ShapeId> = self.machine.numbered().map(|(leaf, _)| leaf).collect();
            let within = |leaf: &ShapeId| *leaf == inner || self.machine.around(*leaf).contains(&inner);
            let values = leaves.into_iter().filter(|leaf| self.is_leaf(*leaf) && within(leaf));
            let tests = values.map(|leaf| format!("{memory} = {}", state_value(self.chart, self.machine, leaf)));
            let tests: Vec<String> = tests.collect();
            if tests.is_empty() {
                continue;
            }
            let guard = self.made(&shape, ShapeKind::Guard, "was left there", tests.join(" or "));
            let there = self.entered(leaf, inner, kept, aborted, span);
            self.arrow(End::Shape(guard), Some(true), there, span);
            self.arrow(End::Shape(guard), Some(false), end, span);
            end = End::Shape(guard);
        }
        end
    }

    /// What is done when the pattern of an instance is left from outside: the same for the patterns in it.
    fn aborted(&mut self, leaf: ShapeId) -> Vec<(String, Shape)> {
        let shape = self.machine.shape(leaf).clone();
        let mut rules = Vec::new();
        let mut open = vec![shape.clone()];
        while let Some(instance) = open.pop() {
            // Only a pattern that contains itself has so many within it.
            if rules.len() > MAX_DEPTH {
                self.is_too_large = true;
                break;
            }
            let Some(pattern) = self.chart.pattern_of(&instance) else { continue };
            let Some(control) = inner_control(self.chart, &instance) else { continue };
            for action in &pattern.aborts {
                let rule = of_instance(pattern, &instance, &call(pattern, pattern.shape(*action)));
                rules.push(format!("if isDef({control}) then {rule} endif"));
            }
            if control_location(pattern).is_some() {
                rules.push(format!("{control} := undef"));
            }
            let steps = |shape: &&Shape| self.chart.pattern_of(shape).is_some_and(Machine::takes_steps);
            for inner in pattern.shapes.iter().filter(steps) {
                let mut inner = inner.clone();
                if let ShapeKind::Instance(of) = &mut inner.kind {
                    of.arguments = of.arguments.iter().map(|text| of_instance(pattern, &instance, text)).collect();
                }
                open.push(inner);
            }
        }
        rules.into_iter().map(|rule| (rule, shape.clone())).collect()
    }

    /// Actions in a row, and an end behind them.
    fn chained(&mut self, done: &[ShapeId], end: End, span: Span) -> End {
        done.iter().rev().fold(end, |end, action| {
            self.arrow(End::Shape(*action), None, end, span);
            End::Shape(*action)
        })
    }

    /// A shape that stands for one of the machine: itself if it stands on no path yet.
    fn fresh(&mut self, id: ShapeId) -> ShapeId {
        let copy = if std::mem::replace(&mut self.is_used[id.0], true) {
            self.push(Shape { inside: None, ..self.machine.shape(id).clone() })
        } else {
            id
        };
        self.copies.entry(id).or_default().push(copy);
        copy
    }

    fn action(&mut self, of: &Shape, text: &str, rule: String) -> ShapeId {
        self.made(of, ShapeKind::Action, text, rule)
    }

    /// A shape that no text declares.
    fn made(&mut self, of: &Shape, kind: ShapeKind, text: &str, link: String) -> ShapeId {
        let name = format!("{}_{}", of.name, self.flat.shapes.len());
        let link = Link { name: of.name.clone(), text: link, is_application: false, span: of.span };
        self.push(Shape {
            name,
            text: format!("{} {text}", of.text),
            kind,
            link: Some(link),
            refinement: None,
            inside: None,
            span: of.span,
        })
    }

    fn push(&mut self, shape: Shape) -> ShapeId {
        // What is too large is thrown away as a whole.
        self.is_too_large |= self.flat.shapes.len() >= MAX_SHAPES;
        self.flat.shapes.push(shape);
        ShapeId(self.flat.shapes.len() - 1)
    }

    /// The first arrow of a path, unless it is there.
    fn start(&mut self, from: End, to: Option<End>, span: Span) {
        if let Some(to) = to {
            self.arrow(from, None, to, span);
        }
    }

    fn arrow(&mut self, from: End, branch: Option<bool>, to: End, span: Span) {
        self.flat.arrows.push(Arrow { from, branch, to, answer: None, span });
    }

    /// What is in sequence stays so on the paths of the present state.
    fn sequences(&mut self) {
        for sequence in &self.machine.sequences {
            let copies: Vec<ShapeId> =
                sequence.iter().flat_map(|id| self.copies.get(id).cloned().unwrap_or_default()).collect();
            if copies.len() > 1 {
                self.flat.sequences.push(copies);
            }
        }
    }
}
