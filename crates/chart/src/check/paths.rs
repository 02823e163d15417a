//! Compares the paths from each control state: finds two that hold together but lead to different places, and states in
//! which none holds.
//!
//! In: a machine whose links resolve, its model, a solver. Out: faults with a state that shows the case, or the reason
//! why the case is undecided. Each question is an AsmetaL condition over the guards of the paths. It is lowered like
//! guards of rules, so it means what the guards mean. A state with a single guard waits for it; that is not reported as
//! a gap.

use std::collections::BTreeSet;
use std::sync::Arc;

use model::Model;
use program::Program;
use solve::{Decision, Solver};
use syntax::ast::{AstNode, TermFile};
use syntax::{Diagnostic, FileId, Severity, Span};

use crate::build::{call, origin_condition};
use crate::chart::{Chart, End, Machine, ShapeId, ShapeKind};
use crate::differ::difference;
use crate::fault;
use crate::flow::{Origin, Target, Transition, is_block, transitions};
use crate::symbolic::Path;

/// LIMIT: how many pairs of paths of one machine are compared.
const MAX_PAIRS: usize = 2_000;

/// The model that a chart's guards refer to.
pub(super) struct Guards {
    model: Model,
    /// The machine's program, with the questions so far; or a clause that says why there is none.
    program: Result<Arc<Program>, String>,
}

impl Guards {
    /// Guards over a model without faults.
    pub fn over(model: &Model) -> Guards {
        Guards { model: model.clone(), program: program::lower(model).map(Arc::new).map_err(|faults| first(&faults)) }
    }

    /// Whether a condition over the model can hold.
    fn ask(&mut self, text: &str, solver: &mut dyn Solver) -> Decision {
        let file = FileId(u32::MAX);
        let parse = syntax::parse_term(file, text);
        let Some(term) = TermFile::cast(parse.syntax()).and_then(|file| file.term()) else {
            return Decision::Unknown("the guards are no term".to_string());
        };
        let fragment = self.model.check_condition(file, &term, "the guard");
        if fragment.diagnostics.iter().any(|found| found.severity == Severity::Error) {
            return Decision::Unknown("the guards are no condition".to_string());
        }
        let program = match &mut self.program {
            Ok(program) => program,
            Err(reason) => return Decision::Unknown(reason.clone()),
        };
        let lowered = program::lower_term(Arc::make_mut(program), &self.model, &fragment.item, &fragment.variables);
        match lowered.map(|condition| solve::question(program, &condition)) {
            Ok(Ok(question)) => question.decide(solver),
            Ok(Err(outside)) => Decision::Unknown(format!("{} cannot be decided", outside.what)),
            Err(faults) => Decision::Unknown(first(&faults)),
        }
    }
}

fn first(faults: &[Diagnostic]) -> String {
    faults.first().map_or_else(String::new, |fault| fault.message.clone())
}

/// The faults of a machine's paths.
pub(super) fn paths(
    chart: &Chart,
    machine: &Machine,
    guards: &mut Guards,
    solver: &mut dyn Solver,
    faults: &mut Vec<Diagnostic>,
) {
    let (drawn, machine) = (machine, machine.flat());
    let all = transitions(chart, machine);
    let mut asker = Asker { chart, drawn, machine, guards, solver };
    let mut origins: Vec<Origin> = all.iter().map(|one| one.origin).collect();
    origins.dedup();
    let mut budget = MAX_PAIRS;
    for origin in origins {
        let from: Vec<&Transition> = all.iter().filter(|one| one.origin == origin).collect();
        asker.overlaps(origin, &from, &mut budget, faults);
        asker.gap(origin, &from, faults);
    }
}

struct Asker<'a> {
    chart: &'a Chart,
    /// The machine with its composite states; `machine` is the flat one.
    drawn: &'a Machine,
    machine: &'a Machine,
    guards: &'a mut Guards,
    solver: &'a mut dyn Solver,
}

impl Asker<'_> {
    fn overlaps(&mut self, origin: Origin, from: &[&Transition], budget: &mut usize, faults: &mut Vec<Diagnostic>) {
        let (place, name) = self.origin(origin);
        let mut told: BTreeSet<(Target, Target)> = BTreeSet::new();
        for (index, first) in from.iter().enumerate() {
            for second in &from[index + 1..] {
                let apart = first.guards.iter().any(|(id, holds)| second.guards.contains(&(*id, !holds)));
                if first.target == second.target || apart || told.contains(&(first.target, second.target)) {
                    continue;
                }
                let targets = (self.target(first.target), self.target(second.target));
                let Some(rest) = budget.checked_sub(1) else {
                    let reason = format!("there are more than {MAX_PAIRS} pairs of paths");
                    faults.push(fault::undecided_paths(place, &name, "exclude each other", &reason));
                    return;
                };
                *budget = rest;
                match self.ask(origin, &format!("{} and {}", self.condition(first), self.condition(second))) {
                    Decision::Impossible => {}
                    Decision::Possible(state) => {
                        told.insert((first.target, second.target));
                        faults.push(fault::overlapping_paths(
                            (first.span, &targets.0),
                            (second.span, &targets.1),
                            &name,
                            &state,
                        ));
                    }
                    Decision::Unknown(reason) => {
                        told.insert((first.target, second.target));
                        let what = format!("to `{}` and to `{}` exclude each other", targets.0, targets.1);
                        faults.push(fault::undecided_paths(place, &name, &what, &reason));
                    }
                }
            }
        }
    }

    fn gap(&mut self, origin: Origin, from: &[&Transition], faults: &mut Vec<Diagnostic>) {
        if self.own_guards(origin) < 2 || from.iter().any(|one| one.guards.is_empty()) {
            return;
        }
        // Paths that use both exits of their guards cover all cases, whatever the guards mean.
        let named = |one: &&Transition| -> Path {
            one.guards.iter().map(|(id, holds)| (call(self.machine, self.machine.shape(*id)), *holds)).collect()
        };
        if difference(&from.iter().map(named).collect::<Vec<_>>(), &[Path::new()]).is_none() {
            return;
        }
        let (place, name) = self.origin(origin);
        let none: Vec<String> = from.iter().map(|one| format!("not ({})", self.condition(one))).collect();
        match self.ask(origin, &none.join(" and ")) {
            Decision::Impossible => {}
            Decision::Possible(state) => faults.push(fault::uncovered_case(place, &name, &state)),
            Decision::Unknown(reason) => {
                faults.push(fault::undecided_paths(place, &name, "cover all cases", &reason));
            }
        }
    }

    /// How many guards stand on the own paths of a state, not on those of the states around it.
    fn own_guards(&self, origin: Origin) -> usize {
        let mut open = vec![match origin {
            Origin::Enter => End::Enter,
            Origin::State(id) | Origin::Left(id) => End::Shape(id),
        }];
        let mut seen: BTreeSet<ShapeId> = BTreeSet::new();
        let mut guards = 0;
        while let Some(end) = open.pop() {
            for arrow in self.drawn.out_of(end) {
                let End::Shape(to) = arrow.to else { continue };
                let kind = &self.drawn.shape(to).kind;
                guards += usize::from(*kind == ShapeKind::Guard && !seen.contains(&to));
                let goes_on = match kind {
                    ShapeKind::Guard | ShapeKind::Action => true,
                    ShapeKind::Instance(_) => !is_block(self.chart, self.drawn, to),
                    ShapeKind::State { .. } | ShapeKind::Composite(_) => false,
                };
                if goes_on && seen.insert(to) {
                    open.push(arrow.to);
                }
            }
        }
        guards
    }

    /// Whether a condition can hold at an origin.
    fn ask(&mut self, origin: Origin, condition: &str) -> Decision {
        let at = origin_condition(self.chart, self.machine, origin).map_or(String::new(), |at| format!("{at} and "));
        let binders: Vec<String> =
            self.machine.parameters.iter().map(|one| format!("{} in {}", one.variable, one.domain)).collect();
        let text = match binders.is_empty() {
            true => format!("{at}{condition}"),
            false => format!("(exist {} with {at}{condition})", binders.join(", ")),
        };
        self.guards.ask(&text, self.solver)
    }

    /// The guards of a path, as a step evaluates them.
    fn condition(&self, path: &Transition) -> String {
        let tests = path.guards.iter().map(|(id, holds)| {
            let text = call(self.machine, self.machine.shape(*id));
            if *holds { format!("({text})") } else { format!("not ({text})") }
        });
        let tests: Vec<String> = tests.collect();
        if tests.is_empty() { "true".to_string() } else { tests.join(" and ") }
    }

    fn origin(&self, origin: Origin) -> (Span, String) {
        match origin {
            Origin::Enter => (self.machine.span, "enter".to_string()),
            Origin::State(id) | Origin::Left(id) => (self.machine.shape(id).span, self.machine.shape(id).name.clone()),
        }
    }

    fn target(&self, target: Target) -> String {
        match target {
            Target::State(id) | Target::Block(id) => self.machine.shape(id).name.clone(),
            Target::Exit => "exit".to_string(),
        }
    }
}
