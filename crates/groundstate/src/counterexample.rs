//! Makes a counterexample executable: as a run of the simulator, and as a scenario.
//!
//! In: the trace of a violated check. Out: a [`Run`] that takes its inputs and choices from the trace and whose records
//! make a trace to replay; an Avalla text that makes the same steps and fails where the trace ends. Both run on the
//! ordinary machine, so they check the search.

use std::fmt::Write;
use std::sync::Arc;

use machine::{FaultClass, Limits, Location, Show, Value};
use program::{Builtin, FunctionId, FunctionKind, Program, Term, TermId};
use simulate::{Decided, Header, Inputs, Options, Run};
use verify::{Subject, Trace};

use crate::avalla::{UNSAID, is_said, pick, set};

/// The run of a counterexample. The header sets the number of steps and how invariants are treated.
pub fn counterexample_run(program: &Arc<Program>, limits: Limits, trace: &Trace, header: &Header) -> Run {
    let decided = |told: &explore::Told| Decided {
        inputs: told.inputs.clone(),
        choices: told.choices.iter().map(|choice| choice.values.clone()).collect(),
    };
    let steps = std::iter::once(&trace.start).chain(&trace.steps).map(decided).collect();
    let options = Options { steps: header.steps, invariants: header.invariants, ..Options::default() };
    Run::new(Arc::clone(program), limits, Inputs::decided(steps), options)
}

/// The scenario of a counterexample; `model` is the path that the scenario loads.
pub fn counterexample_scenario(program: &Program, trace: &Trace, subject: Subject, name: &str, model: &str) -> String {
    let mut text = format!("scenario {name}\nload \"{model}\"\n");
    let mut given: Vec<(Location, Value)> = Vec::new();
    set(&mut text, program, &mut given, &trace.start.inputs);
    if !trace.start.choices.is_empty() {
        begin(&mut text, program, &trace.values);
    }
    let last = trace.steps.len();
    for (index, step) in trace.steps.iter().enumerate() {
        let _ = write!(text, "\n// step {}\n", index + 1);
        set(&mut text, program, &mut given, &step.inputs);
        for choice in &step.choices {
            pick(&mut text, program, choice);
        }
        // The fault that was looked for fails the scenario. Where a run of a formula meets one, it stays in its state and goes on.
        let is_found =
            index + 1 == last && matches!(subject, Subject::Consistent | Subject::InDomain | Subject::Defined);
        match &step.fault {
            Some(_) if is_found => {
                text.push_str("step\n");
                return text;
            }
            Some(fault) if FaultClass::of(fault) == FaultClass::Inconsistent => {
                text.push_str("expect inconsistent update;\n")
            }
            Some(_) => text.push_str("expect error;\n"),
            None => text.push_str("step\n"),
        }
    }
    if let Some(turn) = trace.turn {
        let _ = write!(
            text,
            "\n// and again from step {}, for ever; only a run without end violates the property\n",
            turn + 1
        );
    }
    if trace.ends {
        text.push_str("\n// no step satisfies the assumptions: the run ends here\n");
    }
    if subject == Subject::NoDeadlock {
        rest(&mut text, program, trace);
    }
    text
}

/// Puts the initial state that was chosen among several: a scenario picks in steps alone.
fn begin(text: &mut String, program: &Program, values: &[(Location, Value)]) {
    let is_own = |location: &Location| is_state(program.function(location.function).kind);
    let (said, unsaid): (Vec<_>, Vec<_>) = values
        .iter()
        .filter(|(location, _)| is_own(location))
        .partition(|(location, value)| is_said(program, location, value));
    text.push_str("// the initial state, which is one of several\n");
    for (location, _) in unsaid {
        let _ = writeln!(text, "// {} has a value here, {UNSAID}", location.show(program));
    }
    let update =
        |(location, value): &(Location, Value)| format!("{} := {}", location.show(program), value.show(program));
    let mut updates: Vec<String> = said.into_iter().map(update).collect();
    let chosen =
        (0..).map(FunctionId).zip(chosen_at_the_start(program)).filter_map(|(id, chosen)| chosen.then_some(id));
    let (single, many): (Vec<_>, Vec<_>) = chosen.partition(|id| program.function(*id).parameters.is_empty());
    // Where the scenario itself chooses, there may be a value where none was found.
    let has_value =
        |id: &FunctionId| values.iter().any(|(location, value)| location.function == *id && !value.is_undef());
    updates
        .extend(single.iter().filter(|id| !has_value(id)).map(|id| format!("{} := undef", program.function(*id).name)));
    let cleared: Vec<String> = many.iter().filter_map(|id| cleared(program, *id)).collect();
    let all = match &updates[..] {
        [] => None,
        [only] => Some(only.clone()),
        several => Some(block("par", several)),
    };
    let first: Vec<String> = cleared.into_iter().chain(all).collect();
    match &first[..] {
        [] => {}
        [only] if !only.contains('\n') => _ = writeln!(text, "exec {only};"),
        [only] => _ = writeln!(text, "exec\n\t{};", only.replace('\n', "\n\t")),
        several => _ = writeln!(text, "exec\n\t{};", block("seq", several).replace('\n', "\n\t")),
    }
}

/// Rules in a block, one on each line.
fn block(word: &str, rules: &[String]) -> String {
    let rules: Vec<String> = rules.iter().map(|rule| format!("\n\t{}", rule.replace('\n', "\n\t"))).collect();
    format!("{word}{}\nend{word}", rules.concat())
}

/// A rule that leaves a function with parameters without values; none where its arguments cannot be gone through.
fn cleared(program: &Program, id: FunctionId) -> Option<String> {
    let function = program.function(id);
    if !function.parameters.iter().all(|domain| program.is_listable(*domain)) {
        return None;
    }
    let names: Vec<String> = (1..=function.parameters.len()).map(|number| format!("$a{number}")).collect();
    let binders = names.iter().zip(&function.parameters);
    let binders: Vec<String> =
        binders.map(|(name, domain)| format!("{name} in {}", program.domain(*domain).name)).collect();
    Some(format!("forall {} with true do {}({}) := undef", binders.join(", "), function.name, names.join(", ")))
}

/// By function of the state, whether its initial value may depend on a choice.
fn chosen_at_the_start(program: &Program) -> Vec<bool> {
    let mut chosen = vec![false; program.functions.len()];
    let initial = program.initials.iter().map(|initial| (initial.function, initial.value.body));
    let defined = (0..).map(FunctionId).zip(&program.functions);
    let defined = defined.filter_map(|(id, function)| Some((id, function.definition.as_ref()?.body)));
    let bodies: Vec<(FunctionId, TermId)> = initial.chain(defined).collect();
    loop {
        let before = chosen.clone();
        for (function, body) in &bodies {
            let mut open = vec![*body];
            while let Some(term) = open.pop() {
                chosen[function.0 as usize] |= match program.term(term) {
                    Term::Builtin { builtin: Builtin::ChooseOne, .. } => true,
                    Term::Read { function, .. } | Term::Define { function, .. } => chosen[function.0 as usize],
                    _ => false,
                };
                program.each_child_of_term(term, &mut |child| open.push(child));
            }
        }
        if chosen == before {
            break;
        }
    }
    chosen.iter_mut().zip(&program.functions).for_each(|(chosen, function)| *chosen &= is_state(function.kind));
    chosen
}

fn is_state(kind: FunctionKind) -> bool {
    matches!(kind, FunctionKind::Controlled | FunctionKind::Shared | FunctionKind::Out)
}

/// Ends a deadlock's scenario with a check that fails because the next step changes nothing.
fn rest(text: &mut String, program: &Program, trace: &Trace) {
    let mut state: Vec<(Location, Value)> = trace.values.clone();
    for change in trace.steps.iter().flat_map(|step| &step.changes) {
        match state.iter_mut().find(|(location, _)| *location == change.location) {
            Some((_, value)) => value.clone_from(&change.after),
            None => state.push((change.location.clone(), change.after.clone())),
        }
    }
    let is_input = |location: &Location| program.function(location.function).kind == program::FunctionKind::Monitored;
    let own = state.iter().filter(|(location, _)| !is_input(location));
    let (said, unsaid): (Vec<_>, Vec<_>) = own.partition(|(location, value)| is_said(program, location, value));
    let same: Vec<String> = said
        .into_iter()
        .map(|(location, value)| match value {
            Value::Undef => format!("isUndef({})", location.show(program)),
            value => format!("{} = {}", location.show(program), value.show(program)),
        })
        .collect();
    let same = if same.is_empty() { "true".to_string() } else { same.join("\n\tand ") };
    text.push_str("\n// no step changes this state\n");
    for (location, value) in unsaid {
        let _ = writeln!(text, "// {} stays {}, {UNSAID}", location.show(program), value.show(program));
    }
    let _ = write!(text, "check {same};\nstep\ncheck not ({same});\n");
}
