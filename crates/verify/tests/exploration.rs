//! On random models, an explorer agrees with the machine about every state, with and without remembered steps.
//!
//! They are compared with a second, naive exploration: it copies states, and its alternatives are what a machine asks
//! an ordinary environment for. `GROUNDSTATE_CASES` sets how many models (a few seconds' worth if absent),
//! `GROUNDSTATE_SEED` the first seed.

use std::collections::{BTreeMap, BTreeSet, VecDeque};
use std::sync::Arc;

use explore::{Explorer, Interner, Settings, Trouble, Widening};
use machine::{Bounds, EngineChoice, Show};
use machine::{
    Choice, Draw, Environment, Fault, FaultKind, Limits, Location, LocationRef, Machine, Snapshot, TimeUnit, Value,
};
use program::{DomainId, DomainKind, FunctionId, FunctionKind, Program};
use syntax::{Severity, SourceFile};
use testkit::{NoFiles, sample};

/// The most states of one model that are compared.
const STATES: usize = 60;
/// The most alternatives of one state that are compared.
const PATHS: usize = 3_000;

/// Enumerates the answers to what a machine asks.
#[derive(Default)]
struct Odometer {
    picks: Vec<(usize, usize)>,
    at: usize,
    endless: bool,
    inputs: BTreeMap<FunctionId, Vec<Value>>,
}

impl Odometer {
    fn ask(&mut self, of: usize) -> usize {
        if self.at == self.picks.len() {
            self.picks.push((0, of));
        }
        self.at += 1;
        self.picks[self.at - 1].0
    }

    fn next(&mut self) -> bool {
        self.at = 0;
        while let Some((taken, of)) = self.picks.pop() {
            if taken + 1 < of {
                self.picks.push((taken + 1, of));
                return true;
            }
        }
        false
    }

    fn end<T>(&mut self) -> Result<T, String> {
        self.endless = true;
        Err(String::new())
    }
}

impl Environment for Odometer {
    fn monitored(&mut self, _: &Program, location: LocationRef<'_>, _: DomainId) -> Result<Value, String> {
        match self.inputs.get(&location.function).cloned() {
            Some(values) if !values.is_empty() => Ok(values[self.ask(values.len())].clone()),
            _ => self.end(),
        }
    }

    fn choose(&mut self, _: &Program, choice: &Choice<'_>) -> Result<usize, String> {
        Ok(self.ask(choice.candidates()))
    }

    fn number(&mut self, _: &Program, _: &Draw) -> Result<Value, String> {
        self.end()
    }

    fn time(&mut self, _: TimeUnit) -> Result<i64, String> {
        self.end()
    }
}

pub(crate) type Key = (Vec<(Location, Value)>, Vec<Vec<Value>>);

/// Whether a domain may get elements that do not exist at the start.
fn grows(program: &Program, domain: DomainId) -> bool {
    match &program.domain(domain).kind {
        DomainKind::Basic(basic) => *basic != model::Basic::Boolean,
        DomainKind::Enum { .. } => false,
        DomainKind::Abstract { dynamic, .. } => *dynamic,
        DomainKind::Concrete { dynamic, base, .. } => {
            *dynamic || matches!(program.domain(*base).kind, DomainKind::Abstract { dynamic: true, .. })
        }
        DomainKind::Prod(parts) => parts.iter().any(|part| grows(program, *part)),
        _ => true,
    }
}

/// A state by its values, without locations whose initial value may not have been needed yet.
pub(crate) fn key(program: &Program, values: Vec<(Location, Value)>, machine: Option<&mut Machine>) -> Key {
    let initialised: BTreeSet<FunctionId> = program.initials.iter().map(|initial| initial.function).collect();
    let keep = |location: &Location| {
        let function = program.function(location.function);
        let finite = function.parameters.iter().all(|domain| !grows(program, *domain));
        matches!(function.kind, FunctionKind::Controlled | FunctionKind::Out | FunctionKind::Shared)
            && Some(location.function) != program.self_function
            && (finite || !initialised.contains(&location.function))
    };
    let values = values.into_iter().filter(|(location, _)| keep(location)).collect();
    let grown = machine.map(|machine| {
        let domains = program.domains.iter().enumerate().filter(|(_, domain)| match &domain.kind {
            DomainKind::Abstract { dynamic, .. } | DomainKind::Concrete { dynamic, .. } => *dynamic,
            _ => false,
        });
        domains.map(|(index, _)| machine.elements(DomainId(index as u32)).unwrap_or_default()).collect()
    });
    (values, grown.unwrap_or_default())
}

/// The possible inputs in the machine's state.
pub(crate) fn inputs(program: &Program, machine: &mut Machine, bounds: &Bounds) -> BTreeMap<FunctionId, Vec<Value>> {
    let mut inputs = bounds.clone();
    for (index, function) in program.functions.iter().enumerate() {
        let id = FunctionId(index as u32);
        if matches!(function.kind, FunctionKind::Monitored | FunctionKind::Shared) && !inputs.contains_key(&id) {
            inputs.insert(id, machine.elements(function.codomain).unwrap_or_default());
        }
    }
    inputs
}

/// Two numbers for each input that is a number.
pub(crate) fn bounds(program: &Program) -> Bounds {
    let is_number = |domain: DomainId| {
        matches!(program.domain(domain).kind, DomainKind::Basic(model::Basic::Integer | model::Basic::Natural))
    };
    let all = program.functions.iter().enumerate();
    all.filter(|(_, f)| matches!(f.kind, FunctionKind::Monitored | FunctionKind::Shared) && is_number(f.codomain))
        .map(|(index, _)| (FunctionId(index as u32), vec![Value::Integer(0), Value::Integer(1)]))
        .collect()
}

/// One that remembers, one that does not, and one whose steps are machine code where that is `wanted`.
fn explorers(
    program: &Arc<Program>,
    bounds: &Bounds,
    widening: &Widening,
    wanted: bool,
) -> Result<([Explorer; 2], Option<Explorer>), Trouble> {
    let interner = Arc::new(Interner::default());
    let settings = Settings { limits: limits(), bounds: Arc::new(bounds.clone()), ..Settings::default() };
    let slow = Settings { forgetful: true, ..settings.clone() };
    let compiled = Settings { engine: EngineChoice::Compiled, ..slow.clone() };
    let quick = Explorer::new(program, settings, widening, &interner)?;
    let compiled = wanted.then(|| Explorer::like(program, compiled, widening, &interner, Some(&quick.starts())));
    Ok(([quick, Explorer::new(program, slow, widening, &interner)?], compiled.transpose()?))
}

pub(crate) fn limits() -> Limits {
    Limits { iterations: 200, call_depth: 100, collection: 100, updates: 2_000, locations: 2_000, ..Limits::default() }
}

#[derive(Debug, Default)]
pub(crate) struct Total {
    models: usize,
    states: usize,
    moves: usize,
    /// States whose steps were made by machine code.
    compiled: u64,
    /// Of so many.
    tried: u64,
    /// States whose steps were made so under conditions, and the alternatives that these left out or failed of.
    judged: u64,
    excluded: u32,
    failed: u32,
}

impl Total {
    /// Whether there was something to compare, and code made about half of it.
    pub(crate) fn was_thorough(&self) -> bool {
        self.moves > 1_000 && self.states > 1_000 && 3 * self.compiled > self.tried
    }
}

/// The successors of the machine's state other than itself; `None` if they cannot all be computed.
fn straight(
    program: &Program,
    machine: &mut Machine,
    bounds: &Bounds,
) -> Option<Result<BTreeMap<Key, Snapshot>, Box<Fault>>> {
    let here = machine.snapshot();
    let own = {
        let values = machine.locations();
        key(program, values, Some(machine))
    };
    let mut odometer = Odometer { inputs: inputs(program, machine, bounds), ..Odometer::default() };
    let mut successors = BTreeMap::new();
    for _ in 0..PATHS {
        machine.restore(&here);
        match machine.step(&mut odometer) {
            _ if odometer.endless => return None,
            Err(Fault { kind: FaultKind::Limit { .. } | FaultKind::NotEnumerable { .. }, .. }) => return None,
            Err(fault) => return Some(Err(Box::new(fault))),
            Ok(_) => {
                machine.forget_inputs();
                let there = {
                    let values = machine.locations();
                    key(program, values, Some(machine))
                };
                if there != own {
                    successors.insert(there, machine.snapshot());
                }
            }
        }
        if !odometer.next() {
            return Some(Ok(successors));
        }
    }
    None
}

/// Checks that two states are equal, and shows the difference if not.
pub(crate) fn same(program: &Program, ours: &[(Location, Value)], theirs: &[(Location, Value)]) {
    let show = |of: &[(Location, Value)], other: &[(Location, Value)]| -> Vec<String> {
        let own = of.iter().filter(|pair| !other.contains(pair));
        own.map(|(location, value)| format!("{} = {}", location.show(program), value.show(program))).collect()
    };
    assert_eq!(show(ours, theirs), show(theirs, ours), "locations of the explorer and of the machine");
}

/// Compares the first states of a model.
pub(crate) fn compare(
    program: &Arc<Program>,
    widening: &mut Widening,
    compiles: bool,
    total: &mut Total,
) -> Result<(), Trouble> {
    let bounds = bounds(program);
    let ([mut quick, mut slow], mut compiled) = explorers(program, &bounds, widening, compiles)?;
    let mut machine = Machine::new(Arc::clone(program), limits());
    if quick.initial().len() > 1 {
        return Ok(());
    }
    let mut odometer = Odometer { inputs: inputs(program, &mut machine, &bounds), ..Odometer::default() };
    if machine.start(&mut odometer).is_err() {
        return Ok(());
    }
    machine.forget_inputs();
    let first = Box::<[u64]>::from(quick.initial().first().expect("an initial state"));
    let mut seen = BTreeSet::from([first.clone()]);
    let mut queue = VecDeque::from([(first, machine.snapshot())]);
    while let Some((state, snapshot)) = queue.pop_front() {
        machine.restore(&snapshot);
        let values = machine.locations();
        same(program, &key(program, quick.values(&state), None).0, &key(program, values, None).0);
        let (mut out, mut again) = (Vec::new(), Vec::new());
        let narrow = Trouble::TooNarrow;
        let expansion = quick.expand(&state, &mut out).map_err(narrow)?;
        assert_eq!(slow.expand(&state, &mut again).map_err(narrow)?, expansion, "remembered or made");
        assert_eq!(out, again, "remembered or made");
        if let Some(compiled) = &mut compiled {
            again.clear();
            let before = compiled.compiled_states();
            assert_eq!(compiled.expand(&state, &mut again).map_err(narrow)?, expansion, "compiled or made");
            assert_eq!(out, again, "compiled or made");
            total.compiled += compiled.compiled_states() - before;
            total.tried += 1;
        }
        // Once more, now that all steps are remembered.
        again.clear();
        assert_eq!(quick.expand(&state, &mut again).map_err(narrow)?, expansion, "made and remembered");
        assert_eq!(out, again, "made and remembered");
        total.states += 1;
        if expansion.moved > 200 {
            return Ok(());
        }
        let Some(straight) = straight(program, &mut machine, &bounds) else { continue };
        if expansion.unbounded > 0 {
            continue;
        }
        let faulty = expansion.faults != [0; 3];
        assert_eq!(straight.is_err(), faulty, "{straight:?}");
        let Ok(straight) = straight else { continue };
        let mut keys = BTreeMap::new();
        for next in out.chunks_exact(quick.words()) {
            keys.insert(key(program, quick.values(next), None).0, Box::<[u64]>::from(next));
        }
        let own = key(program, quick.values(&state), None).0;
        let expected: BTreeSet<_> = straight.keys().map(|(values, _)| values).filter(|key| **key != own).collect();
        let found: BTreeSet<_> = keys.keys().filter(|key| **key != own).collect();
        assert_eq!(found, expected, "successors");
        total.moves += expected.len();
        for ((values, _), snapshot) in straight {
            let Some(next) = keys.get(&values).cloned() else { continue };
            if seen.len() < STATES && seen.insert(next.clone()) {
                queue.push_back((next, snapshot));
            }
        }
    }
    Ok(())
}

/// Compares compiled steps with those of the machine under conditions on the step, of which every second one is an assumption.
fn compare_conditions(program: &Arc<Program>, widening: &Widening, total: &mut Total) -> Result<(), Trouble> {
    let formulas = program.properties.iter().map(|property| property.formula.clone());
    let step_conditions = formulas.enumerate().map(|(index, formula)| (formula, index % 2 == 1)).collect();
    let bounds = Arc::new(bounds(program));
    let made = Settings { limits: limits(), bounds, step_conditions, forgetful: true, ..Settings::default() };
    let compiled = Settings { engine: EngineChoice::Compiled, ..made.clone() };
    let interner = Arc::new(Interner::default());
    let mut made = Explorer::new(program, made, widening, &interner)?;
    let mut compiled = Explorer::like(program, compiled, widening, &interner, Some(&made.starts()))?;
    let mut queue: VecDeque<Box<[u64]>> = made.initial().iter().take(1).map(|(state, _)| state.into()).collect();
    let mut seen: BTreeSet<Box<[u64]>> = queue.iter().cloned().collect();
    while let Some(state) = queue.pop_front() {
        let (mut out, mut again) = (Vec::new(), Vec::new());
        let expansion = made.expand(&state, &mut out).map_err(Trouble::TooNarrow)?;
        assert_eq!(compiled.expand(&state, &mut again).map_err(Trouble::TooNarrow)?, expansion, "with conditions");
        assert_eq!(out, again, "with conditions");
        total.excluded += expansion.excluded;
        total.failed += expansion.failed;
        for next in out.chunks_exact(made.words()).take(20) {
            if seen.len() < STATES / 3 && seen.insert(next.into()) {
                queue.push_back(next.into());
            }
        }
    }
    total.judged += compiled.compiled_states();
    Ok(())
}

#[test]
fn explorers_do_what_the_machine_does() {
    let seeds = sample::seeds(160, 2_000);
    let (cases, full) = (seeds.end - seeds.start, sample::is_full());
    let mut total = Total::default();
    for seed in seeds {
        let text = oracle::generate::model(seed, 1).to_string();
        let checked = model::check(SourceFile::new("Model.asm", text.clone()), &mut NoFiles);
        if checked.diagnostics.iter().any(|found| found.severity == Severity::Error) {
            continue;
        }
        let attempt = std::panic::AssertUnwindSafe(|| {
            let Ok(program) = program::lower(&checked.model) else { return };
            let program = Arc::new(program);
            let mut widening = Widening::default();
            // Compiling takes longer than all the rest.
            let compiles = full || seed % 4 == 0;
            while let Err(Trouble::TooNarrow(more)) = compare(&program, &mut widening, compiles, &mut total) {
                widening.merge(&more);
            }
            while compiles && let Err(Trouble::TooNarrow(more)) = compare_conditions(&program, &widening, &mut total) {
                widening.merge(&more);
            }
            total.models += 1;
        });
        if let Err(panic) = std::panic::catch_unwind(attempt) {
            let reason = panic.downcast_ref::<String>().map_or("", String::as_str);
            panic!("seed {seed}: {reason}\n{text}");
        }
    }
    assert!(total.models > cases as usize / 3 && total.moves > total.models, "{total:?}");
    assert!(total.compiled > total.tried / 3, "{total:?}");
    assert!(total.judged > 0 && total.excluded > 0 && total.failed > 0, "{total:?}");
}

/// Code leaves out updates that leave a location as it is; clashes with them, and loops that end without updates, have to
/// come out all the same.
#[test]
fn updates_that_change_nothing_are_updates() {
    let mains = [
        "par x := x seq y := 1 - y x := if m then 0 else 1 endif endseq endpar",
        "par seq x := x n := n endseq if m then x := 1 endif y := 1 - y endpar",
        "par seq x := x y := y endseq if m then r_Set[1] else r_Set[0] endif endpar",
        "seq par x := 0 if m then x := 1 endif endpar y := 1 - y endseq",
        "seq par x := 0 seq if m then x := 1 endif y := y endseq endpar y := 1 - y endseq",
        "seq par seq x := x n := n endseq if m then x := 1 endif endpar y := 1 - y endseq",
        "seq x := 0 seq if m then x := 1 endif x := 0 endseq y := 1 - y endseq",
        "seq n := 0 y := 0 while n < 3 do par n := n + 1 y := y + 1 x := x endpar endseq",
        "seq n := 0 iterate if n < 2 then seq x := x n := n + 1 endseq endif enditerate y := 1 - y endseq",
        "seq r_Set[0] forall $i in {0 : 2} with m do r_Set[0] y := 1 - y endseq",
        // Sequences that are parts of others, and such that are not.
        "seq seq x := 1 - x seq y := x n := y endseq endseq let ($v = x) in seq x := y y := ($v + n) mod 3 endseq endlet endseq",
        "seq if m then seq x := 1 y := x endseq else seq y := 1 - y x := y endseq endif n := x endseq",
        "seq choose $k in {0 : 2} with $k != x do seq x := $k y := x endseq par seq x := y y := 0 endseq n := x endpar endseq",
        "seq seq x := 0 par x := 1 if m then x := 0 endif endpar endseq y := 1 - y endseq",
        "seq n := 0 while n < 2 do seq x := 1 - x n := n + 1 endseq y := x endseq",
        "seq n := 0 iterate seq if n < 2 then n := n + 1 endif skip endseq enditerate y := 1 - y endseq",
        "seq forall $i in {0 : 1} with m do seq x := 1 n := x endseq seq y := 1 - y x := y endseq endseq",
    ];
    let mut total = Total::default();
    for main in mains {
        let text = format!(
            "asm Model import StandardLibrary signature: controlled x: Integer controlled y: Integer\n\
             controlled n: Integer monitored m: Boolean\ndefinitions: rule r_Set($v in Integer) = x := $v\n\
             main rule r_Main = {main}\ndefault init s0: function x = 0 function y = 0 function n = 0"
        );
        let checked = model::check(SourceFile::new("Model.asm", text), &mut NoFiles);
        assert!(checked.diagnostics.is_empty(), "{main}: {:?}", checked.diagnostics);
        let program = Arc::new(program::lower(&checked.model).expect("it can be lowered"));
        let mut widening = Widening::default();
        while let Err(Trouble::TooNarrow(more)) = compare(&program, &mut widening, true, &mut total) {
            widening.merge(&more);
        }
    }
    // The others are at fault in some alternative.
    assert!(2 * total.compiled > total.tried, "{total:?}");
}

/// Compares initial states with those of the machine, and steps from all of them by code with those of the machine.
fn compare_from_all(program: &Arc<Program>, widening: &Widening, total: &mut Total) -> Result<(), Trouble> {
    let bounds = bounds(program);
    let ([_, mut made], compiled) = explorers(program, &bounds, widening, true)?;
    let mut compiled = compiled.expect("it was wanted");
    let mut machine = Machine::new(Arc::clone(program), limits());
    let mut odometer = Odometer { inputs: inputs(program, &mut machine, &bounds), ..Odometer::default() };
    let initial: Vec<Box<[u64]>> = made.initial().iter().map(|(state, _)| state.into()).collect();
    assert!(initial.len() > 1, "the initial states differ");
    for state in &initial {
        machine.start(&mut odometer).expect("it starts");
        machine.forget_inputs();
        same(program, &key(program, made.values(state), None).0, &key(program, machine.locations(), None).0);
        odometer.next();
    }
    let mut seen: BTreeSet<Box<[u64]>> = initial.iter().cloned().collect();
    let mut queue = VecDeque::from(initial);
    while let Some(state) = queue.pop_front() {
        let (mut out, mut again) = (Vec::new(), Vec::new());
        let before = compiled.compiled_states();
        let expansion = made.expand(&state, &mut out).map_err(Trouble::TooNarrow)?;
        assert_eq!(compiled.expand(&state, &mut again).map_err(Trouble::TooNarrow)?, expansion, "compiled or made");
        assert_eq!(out, again, "compiled or made");
        (total.tried, total.compiled) = (total.tried + 1, total.compiled + compiled.compiled_states() - before);
        for next in out.chunks_exact(made.words()) {
            if seen.len() < STATES && seen.insert(next.into()) {
                queue.push_back(next.into());
            }
        }
    }
    Ok(())
}

/// Functions that no rule updates are constants of the code and no part of states: unless initial states differ in them, an
/// initial value comes up late, or an argument is undef or lies outside.
#[test]
fn what_no_rule_updates_is_constant() {
    let mains = [
        ("x := rate(c)", "rate($c in Colour) = if $c = RED then 1 else if $c = GREEN then 2 else undef endif endif"),
        ("x := rate(c)", "rate($c in Colour) = if early then 1 else 2 endif"),
        ("x := rate(c)", "rate($c in Colour) = if early and $c = RED then undef else 2 endif"),
        ("x := if early then rate(d) else 3 endif", "rate($c in Colour) = if isUndef($c) then 4 else 5 endif"),
        ("if isDef(rate(d)) then x := rate(RED) endif", "rate($c in Colour) = if $c = RED then 1 else undef endif"),
        ("x := at(x + 1)", "at($i in Small) = if $i < 3 then $i else if early then 0 else -1000 endif endif"),
        ("x := at(x)", "at($i in Small) = ($i + 1) mod 3"),
        ("x := length(list(c)) + length(list(d))", "list($c in Colour) = if $c = RED then [1, 2] else [] endif"),
        ("let ($l = list(c)) in if length($l) > 1 then x := first($l) endif endlet", "list($c in Colour) = [4, 5]"),
        ("what(c)[]", "what($c in Colour) = if $c = RED then <<r_One>> else <<r_Two>> endif"),
        ("what(c)[]", "what($c in Colour) = if $c = RED then <<r_One>> else undef endif"),
        ("what(RED)[]", "what($c in Colour) = if early then <<r_One>> else <<r_Two>> endif"),
        ("x := rate(next(next(c)))", "next($c in Colour) = if $c = RED then GREEN else RED endif"),
    ];
    let mut total = Total::default();
    for (main, initial) in mains {
        let text = format!(
            "asm Model import StandardLibrary signature: enum domain Colour = {{RED | GREEN | BLUE}}\n\
             domain Small subsetof Integer\n\
             controlled rate: Colour -> Integer controlled at: Small -> Integer controlled list: Colour -> Seq(Integer)\n\
             controlled what: Colour -> Rule controlled next: Colour -> Colour controlled c: Colour controlled d: Colour\n\
             controlled x: Integer controlled early: Boolean monitored m: Boolean monitored begins: Boolean\n\
             definitions: domain Small = {{0 : 2}} rule r_One = x := 1 rule r_Two = x := 2\n\
             main rule r_Main = par {main} c := if m then RED else if c = RED then BLUE else GREEN endif endif endpar\n\
             default init s0: function c = RED function x = 0 function early = begins function {initial}"
        );
        let checked = model::check(SourceFile::new("Model.asm", text), &mut NoFiles);
        if checked.diagnostics.iter().any(|found| found.severity == Severity::Error) {
            panic!("{main}: {:?}", checked.diagnostics);
        }
        let program = Arc::new(program::lower(&checked.model).expect("it can be lowered"));
        let mut widening = Widening::default();
        while let Err(Trouble::TooNarrow(more)) = compare_from_all(&program, &widening, &mut total) {
            widening.merge(&more);
        }
    }
    assert!(2 * total.compiled > total.tried, "{total:?}");
}
