//! Runs machine and oracle side by side and compares all that can be seen.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use machine::{EngineChoice, FaultKind, Limits, Machine};
use model::{DomainKind, Model, PropertyKind};
use oracle::{Bounds, Fault, Location, Oracle, Symbol, Value};
use program::Program;

use crate::convert;
use crate::world::{Machines, World};

/// What to run.
#[derive(Debug, Clone, Copy)]
pub struct Plan {
    /// Of inputs and choices.
    pub seed: u64,
    /// How many steps to try.
    pub steps: u64,
    /// Of both.
    pub bounds: Bounds,
    /// Of the machine.
    pub engine: EngineChoice,
}

/// What was run in agreement.
#[derive(Debug, Default)]
pub struct Outcome {
    /// Steps committed.
    pub steps: u64,
    /// How often an invariant was true, and how often compiled code knew it without the interpreter.
    pub held: u64,
    pub known: u64,
    /// How often each fault was come to.
    pub faults: BTreeMap<&'static str, u64>,
}

/// Where they differ.
#[derive(Debug)]
pub struct Disagreement {
    /// In what: the same for the same defect, mostly.
    pub kind: String,
    /// How.
    pub detail: String,
}

impl Disagreement {
    /// In something.
    pub fn new(kind: &str, detail: String) -> Disagreement {
        // What is long is long for its large collections: the first lines and columns tell.
        let cut = |line: &str| line.chars().take(600).collect::<String>();
        let detail = detail.lines().take(12).map(cut).collect::<Vec<_>>().join("\n");
        Disagreement { kind: kind.to_string(), detail }
    }
}

/// Runs both.
pub fn run(model: &Model, program: Program, plan: Plan) -> Result<Outcome, Disagreement> {
    let program = Arc::new(program);
    let bounds = plan.bounds;
    let limits = Limits {
        iterations: bounds.iterations,
        call_depth: bounds.depth,
        collection: bounds.elements as u64,
        ..Limits::default()
    };
    let mut pair = Pair {
        model,
        machine: Machine::new(Arc::clone(&program), limits),
        oracle: Oracle::new(model, bounds),
        program,
        outcome: Outcome::default(),
    };
    pair.machine.use_engine(plan.engine);
    let invariants = pair.program.properties.iter().filter(|property| property.kind == PropertyKind::Invariant);
    pair.machine.watch_conditions(invariants.map(|property| property.formula.clone()).collect());
    let world = World::new(model, &mut pair.oracle, plan.seed);
    if !pair.together(
        "start",
        world,
        |pair, world| pair.oracle.start(world),
        |pair, world| pair.machine.start(world),
    )? {
        return Ok(pair.outcome);
    }
    for step in 1..=plan.steps {
        let world = World::new(model, &mut pair.oracle, plan.seed.wrapping_mul(1000) + step);
        pair.machine.forget_inputs();
        let oracle_step = |pair: &mut Pair<'_>, world: &mut World| pair.oracle.step(world).map(drop);
        let machine_step = |pair: &mut Pair<'_>, world: &mut Machines<'_>| pair.machine.step(world).map(drop);
        if !pair.together(&format!("step {step}"), world, oracle_step, machine_step)? {
            break;
        }
        pair.outcome.steps += 1;
    }
    Ok(pair.outcome)
}

struct Pair<'m> {
    model: &'m Model,
    program: Arc<Program>,
    machine: Machine,
    oracle: Oracle<'m>,
    outcome: Outcome,
}

impl Pair<'_> {
    /// Has both do something in the same world, and compares what came of it; false if there is nothing more to do.
    fn together(
        &mut self,
        what: &str,
        world: World,
        oracle: impl FnOnce(&mut Self, &mut World) -> Result<(), Fault>,
        machine: impl FnOnce(&mut Self, &mut Machines<'_>) -> Result<(), machine::Fault>,
    ) -> Result<bool, Disagreement> {
        let (mut of_oracle, mut of_machine) = (world.clone(), world);
        let expected = oracle(self, &mut of_oracle);
        let actual = machine(self, &mut Machines(&mut of_machine));
        if matches!(&expected, Err(Fault::Limit)) || matches!(&actual, Err(fault) if fault.kind.id() == "limit-reached")
        {
            // The two count differently what they bound.
            let limit = match &actual {
                Err(machine::Fault { kind: FaultKind::Limit { limit, .. }, .. }) => limit,
                _ => "limit of the oracle",
            };
            *self.outcome.faults.entry(limit).or_default() += 1;
            return Ok(false);
        }
        self.same_outcome(what, &expected, &actual)?;
        let mut parted = false;
        if let Err(Fault::Clash(_)) = &expected {
            // The machine stops at the first clash, the book's update set is complete before it is inconsistent.
            of_oracle.choices.truncate(of_machine.choices.len());
            let asked = of_oracle.asked.len();
            of_oracle.asked.retain(|location, _| of_machine.asked.contains_key(location));
            parted = of_oracle.asked.len() < asked;
        }
        self.same_world(what, &of_oracle, &of_machine)?;
        if let Err(fault) = &expected {
            *self.outcome.faults.entry(fault.id()).or_default() += 1;
            // What was asked of shared locations stays in the state.
            if what == "start" || parted {
                return Ok(false);
            }
        }
        self.same_state(what)?;
        if expected.is_err() {
            return Ok(true);
        }
        self.same_invariants(what, of_oracle, of_machine)?;
        Ok(true)
    }

    fn same_outcome(
        &self,
        what: &str,
        expected: &Result<(), Fault>,
        actual: &Result<(), machine::Fault>,
    ) -> Result<(), Disagreement> {
        let shown_expected = match expected {
            Ok(()) => "no fault".to_string(),
            Err(fault) => format!("{} ({fault:?})", fault.id()),
        };
        let shown_actual = match actual {
            Ok(()) => "no fault".to_string(),
            Err(fault) => format!("{} ({})", fault.kind.id(), fault.show(&self.program)),
        };
        let id = |fault: Option<&'static str>| fault.unwrap_or("none");
        let (left, right) =
            (id(expected.as_ref().err().map(Fault::id)), id(actual.as_ref().err().map(|fault| fault.kind.id())));
        let differ = |kind: &str| {
            Err(Disagreement::new(kind, format!("{what}\noracle: {shown_expected}\nmachine: {shown_actual}")))
        };
        if left != right {
            return differ(&format!("fault: {left} or {right}"));
        }
        match (expected, actual.as_ref().map_err(|fault| &fault.kind)) {
            (Err(Fault::Clash(clashes)), Err(FaultKind::InconsistentUpdate { location, first, second })) => {
                // Where nothing shows the difference, the machine writes `result` itself.
                let is_result = Some(location.function) == self.program.result_function;
                let location = convert::location(&self.program, location);
                let values: BTreeSet<Value> =
                    [first, second].map(|side| convert::value(&self.program, &side.value)).into();
                let same = |clash: &oracle::Clash| {
                    (is_result || clash.location == location)
                        && [clash.first.clone(), clash.second.clone()].into_iter().collect::<BTreeSet<_>>() == values
                };
                if clashes.iter().any(same) { Ok(()) } else { differ("clash") }
            }
            (
                Err(Fault::OutOfDomain { location, value }),
                Err(FaultKind::OutOfDomain { location: other, value: given, .. }),
            ) => {
                let same = *location == convert::location(&self.program, other)
                    && *value == convert::value(&self.program, given);
                if same { Ok(()) } else { differ("value outside domain") }
            }
            _ => Ok(()),
        }
    }

    fn same_world(&self, what: &str, expected: &World, actual: &World) -> Result<(), Disagreement> {
        if expected.choices != actual.choices {
            let detail = format!("{what}\noracle: {:?}\nmachine: {:?}", expected.choices, actual.choices);
            return Err(Disagreement::new("candidates", detail));
        }
        if expected.asked != actual.asked {
            let detail = format!("{what}\noracle: {:?}\nmachine: {:?}", self.shown(expected), self.shown(actual));
            return Err(Disagreement::new("inputs asked for", detail));
        }
        Ok(())
    }

    fn shown(&self, world: &World) -> Vec<String> {
        world.asked.keys().map(|location| self.show(location)).collect()
    }

    fn show(&self, location: &Location) -> String {
        let arguments: Vec<String> = location.arguments.iter().map(|value| oracle::show(self.model, value)).collect();
        match location.symbol {
            Symbol::Function(function) => format!("{}({})", self.model.function(function).name, arguments.join(",")),
            Symbol::Domain(domain) => format!("{}({})", self.model.domains.display(domain), arguments.join(",")),
        }
    }

    fn same_state(&mut self, what: &str) -> Result<(), Disagreement> {
        let program = Arc::clone(&self.program);
        let is_input = |function| program.function(function).kind == model::FunctionKind::Monitored;
        let mut locations: BTreeSet<Location> = BTreeSet::new();
        for (location, _) in self.machine.locations() {
            if !is_input(location.function) {
                locations.insert(convert::location(&program, &location));
            }
        }
        locations.extend(self.oracle.state().locations().map(|(location, _)| location.clone()));
        for location in locations {
            let Some(in_machine) = convert::location_back(&program, &location) else { continue };
            let actual = convert::value(&program, &self.machine.value(&in_machine));
            let mut nothing = World::default();
            let expected = self.oracle.value(&location, &mut nothing).unwrap_or(Value::Undef);
            if actual != expected {
                let (expected, actual) = (oracle::show(self.model, &expected), oracle::show(self.model, &actual));
                let detail = format!("{what}: {}\noracle: {expected}\nmachine: {actual}", self.show(&location));
                return Err(Disagreement::new("state", detail));
            }
        }
        for (domain, entry) in self.model.domains.iter() {
            if matches!(entry.kind, DomainKind::Abstract { .. } | DomainKind::Concrete { .. }) {
                let expected = self.oracle.elements(domain, &mut World::default());
                let actual = self.machine.elements(domain);
                if matches!(&actual, Err(fault) if fault.kind.id() == "limit-reached") {
                    continue;
                }
                let listed =
                    actual.as_ref().ok().map(|all| all.iter().map(|v| convert::value(&program, v)).collect::<Vec<_>>());
                if expected.as_ref().ok() != listed.as_ref() {
                    let name = self.model.domains.display(domain);
                    let detail = format!("{what}: {name}\noracle: {expected:?}\nmachine: {actual:?}");
                    return Err(Disagreement::new("domain", detail));
                }
            }
        }
        Ok(())
    }

    fn same_invariants(&mut self, what: &str, mut of_oracle: World, mut of_machine: World) -> Result<(), Disagreement> {
        let program = Arc::clone(&self.program);
        let expected = self.oracle.invariants(&mut of_oracle);
        let invariants = program.properties.iter().filter(|property| property.kind == PropertyKind::Invariant);
        for (number, (property, (name, expected))) in invariants.zip(expected).enumerate() {
            let surely = self.machine.surely_holds(number);
            if surely && !matches!(expected, Ok(Value::Boolean(true)) | Err(Fault::Limit)) {
                let detail = format!("{what}, {name}: compiled code says that it holds\noracle: {expected:?}");
                return Err(Disagreement::new("compiled invariant", detail));
            }
            self.outcome.held += u64::from(matches!(expected, Ok(Value::Boolean(true))));
            self.outcome.known += u64::from(surely);
            let actual = self.machine.evaluate(&property.formula, &mut Machines(&mut of_machine));
            let limited = matches!(expected, Err(Fault::Limit))
                || matches!(&actual, Err(fault) if fault.kind.id() == "limit-reached");
            if limited {
                return Ok(());
            }
            let expected = expected.map_err(|fault| fault.id());
            let actual = actual.map(|value| convert::value(&program, &value)).map_err(|fault| fault.kind.id());
            if expected != actual {
                let detail = format!("{what}, {name}\noracle: {expected:?}\nmachine: {actual:?}");
                return Err(Disagreement::new("invariant", detail));
            }
        }
        self.same_world(&format!("invariants after {what}"), &of_oracle, &of_machine)
    }
}
