//! Encodes locations: the variables of the state, reads and updates of them; inputs.
//!
//! A function over finite domains has one place for each location. LIMIT: a function may have only so many places. An
//! argument outside of its domain names a location without a place: an update of it is not encoded.

use std::sync::Arc;

use machine::{Location, Value};
use model::Basic;
use program::{DomainId, DomainKind, FunctionId, FunctionKind, TermId, TermList};
use syntax::Span;

use super::number::INTEGERS;
use super::{Encoder, FaultClass, Input, InputKind, Result};
use crate::shared::{Bounds, Kind, Node, Terms};
use crate::symbol::{Open, Shape, Symbol, constant};

const PLACES: usize = 10_000;
/// LIMIT: how many values an unordered input may have.
const VALUES: usize = 256;

/// The places of a function, keyed by their arguments.
pub(super) type Rows = Vec<(Vec<Value>, usize)>;

/// A location of the state.
#[derive(Debug, Clone)]
pub struct Place {
    /// The location.
    pub location: Location,
    /// The shape of its values.
    pub shape: Shape,
    /// Its value, as a variable.
    pub value: Node,
    /// Whether it is defined, as a variable; a constant if it always is.
    pub defined: Node,
    /// Whether it is part of the state between steps.
    pub kept: bool,
    /// What its domain says about its value.
    pub typed: Node,
}

impl Encoder {
    /// A new input.
    pub(super) fn input(&mut self, name: &str, kind: Kind, bounds: Bounds, input: InputKind) -> Node {
        let variable = self.terms.variable(name, kind, bounds);
        self.inputs.push(Input { variable, kind: input });
        variable
    }

    /// The value of a location.
    pub(super) fn read(&mut self, function: FunctionId, arguments: TermList, id: TermId) -> Result {
        let span = self.program.term_span(id);
        let arguments = self.evaluate_all(arguments)?;
        let declared = self.program.function(function);
        if let Some(element) = declared.element {
            return Ok(Symbol::Known(Value::Element(self.program.base_domain(declared.codomain), element)));
        }
        if self.free.is_some() {
            return self.read_free(function, &arguments, span);
        }
        if Some(function) == self.program.self_function {
            return Ok(self.agent.clone());
        }
        match declared.kind {
            FunctionKind::Static | FunctionKind::Derived => Ok(Symbol::UNDEF),
            FunctionKind::Monitored => self.read_input(function, &arguments, span),
            _ => {
                let (places, elsewhere) = self.places_at(function, &arguments, span)?;
                if self.has_initial(function) {
                    self.beyond(elsewhere, "an argument outside of its domain", span);
                }
                let mut value = None;
                for (here, place) in places {
                    let values = if self.before { &self.original } else { &self.values };
                    let at = values[place].clone();
                    value = Some(match value {
                        None if elsewhere == Terms::FALSE || self.has_initial(function) => at,
                        former => self.merge(here, &at, &former.unwrap_or(Symbol::UNDEF))?,
                    });
                }
                Ok(value.unwrap_or(Symbol::UNDEF))
            }
        }
    }

    fn has_initial(&self, function: FunctionId) -> bool {
        self.program.initials.iter().any(|initial| initial.function == function)
    }

    fn read_input(&mut self, function: FunctionId, arguments: &[Symbol], span: Span) -> Result {
        if let Some(known) = arguments.iter().map(|argument| argument.known().cloned()).collect::<Option<Vec<_>>>() {
            return self.input_at(function, known, span);
        }
        let (mut value, mut within) = (None, Vec::new());
        for row in self.rows(function, span)? {
            let here = self.matches(arguments, &row)?;
            if here != Terms::FALSE {
                let at = self.input_at(function, row, span)?;
                within.push(here);
                value = Some(match value {
                    None => at,
                    Some(former) => self.merge(here, &at, &former)?,
                });
            }
        }
        let within = self.terms.or(within);
        let elsewhere = self.terms.not(within);
        self.beyond(elsewhere, "an argument outside of its domain", span);
        Ok(value.unwrap_or(Symbol::UNDEF))
    }

    /// The value of a monitored location in this step.
    fn input_at(&mut self, function: FunctionId, arguments: Vec<Value>, span: Span) -> Result {
        let key = (function, arguments);
        if let Some((known, fails)) = self.given_inputs.get(&key).cloned() {
            self.fault(FaultClass::Undefined, fails);
            return Ok(known);
        }
        let declared = self.program.function(function).clone();
        let values = match self.bounds.get(&function) {
            Some(values) => Some(values.clone()),
            None => self.elements_of(declared.codomain),
        };
        if values.as_ref().is_some_and(Vec::is_empty) {
            let domain = &self.program.domain(declared.codomain).name;
            return self.outside(format!("an input of the domain {domain}, of which no value is known"), span);
        }
        let name = self.show(function, &key.1);
        let symbol = match values {
            Some(values) => self.input_among(&name, &key, values, span)?,
            None => {
                let (shape, bounds) = match self.program.domain(self.program.base_domain(declared.codomain)).kind {
                    DomainKind::Basic(Basic::Integer) => (Shape::Integer, INTEGERS),
                    DomainKind::Basic(Basic::Natural) => (Shape::Integer, (Some(0), INTEGERS.1)),
                    DomainKind::Basic(Basic::Real) => (Shape::Real, (None, None)),
                    DomainKind::Basic(Basic::String) => (Shape::Coded, (Some(0), Some(1 << 32))),
                    _ => {
                        let domain = &self.program.domain(declared.codomain).name;
                        return self.outside(format!("an input of the domain {domain}"), span);
                    }
                };
                let kind = InputKind::Location(function, key.1.clone(), shape);
                let value = self.input(&name, shape.kind(), bounds, kind);
                Symbol::Open(Open { shape, value, defined: Terms::TRUE })
            }
        };
        self.given_inputs.insert(key, (symbol.clone(), Terms::FALSE));
        Ok(symbol)
    }

    /// An input with one of these values.
    fn input_among(&mut self, name: &str, key: &(FunctionId, Vec<Value>), values: Vec<Value>, span: Span) -> Result {
        if let [value] = &values[..] {
            let value = Symbol::Known(value.clone());
            // With only one value the input is still read.
            let shape = Shape::Coded;
            let Symbol::Known(known) = &value else { return Ok(value) };
            let code = self.codes.code(known);
            let kind = InputKind::Location(key.0, key.1.clone(), shape);
            self.input(name, Kind::Integer, (Some(code), Some(code)), kind);
            return Ok(value);
        }
        let mut shape = Shape::of(&values[0]);
        if values.iter().any(|value| Shape::of(value) != shape) {
            shape = Shape::Coded;
        }
        let mut nodes = Vec::with_capacity(values.len());
        for value in &values {
            nodes.push(match shape {
                Shape::Coded => {
                    let code = self.codes.code(value);
                    self.terms.integer(code)
                }
                _ => constant(&mut self.terms, &mut self.codes, value),
            });
        }
        let numbers: Option<Vec<i128>> = nodes.iter().map(|node| self.terms.whole(*node)).collect();
        let bounds = numbers.as_ref().map(|numbers| (numbers.iter().min().copied(), numbers.iter().max().copied()));
        let kind = InputKind::Location(key.0, key.1.clone(), shape);
        let value = self.input(name, shape.kind(), bounds.unwrap_or_default(), kind);
        let known = self.one_of(value, &nodes);
        self.given.push(known);
        let compound = values.iter().all(|value| matches!(value, Value::Set(_) | Value::Tuple(_)));
        if shape != Shape::Coded || !compound {
            return Ok(Symbol::Open(Open { shape, value, defined: Terms::TRUE }));
        }
        if values.len() > VALUES {
            return self.outside(format!("an input with more than {VALUES} values"), span);
        }
        let mut symbol = Symbol::Known(values[0].clone());
        for (node, known) in nodes.iter().zip(&values).skip(1) {
            let here = self.terms.equal(value, *node);
            symbol = self.merge(here, &Symbol::Known(known.clone()), &symbol)?;
        }
        Ok(symbol)
    }

    /// The condition that a term equals one of some constants.
    pub(super) fn one_of(&mut self, value: Node, nodes: &[Node]) -> Node {
        let numbers: Option<Vec<i128>> = nodes.iter().map(|node| self.terms.whole(*node)).collect();
        if let Some(mut numbers) = numbers {
            numbers.sort_unstable();
            numbers.dedup();
            let ends = (numbers.first().copied(), numbers.last().copied());
            if let (Some(low), Some(high)) = ends
                && high - low + 1 == numbers.len() as i128
            {
                return self.terms.within(value, ends);
            }
        }
        let any: Vec<Node> = nodes.iter().map(|node| self.terms.equal(value, *node)).collect();
        self.terms.or(any)
    }

    fn show(&self, function: FunctionId, arguments: &[Value]) -> String {
        Location { function, arguments: arguments.to_vec() }.show(&self.program).to_string()
    }

    /// The argument tuples of a function, in canonical order.
    fn rows(&mut self, function: FunctionId, span: Span) -> Result<Vec<Vec<Value>>> {
        let program = Arc::clone(&self.program);
        let mut rows = vec![Vec::new()];
        for parameter in &program.function(function).parameters {
            let Some(elements) = self.elements_of(*parameter) else {
                let name = &program.domain(*parameter).name;
                return self.outside(format!("a function over all of {name}"), span);
            };
            if rows.len() * elements.len() > PLACES {
                return self.outside(format!("a function of more than {PLACES} locations"), span);
            }
            let longer = |row: Vec<Value>| {
                elements.iter().map(move |element| {
                    let mut row = row.clone();
                    row.push(element.clone());
                    row
                })
            };
            rows = rows.into_iter().flat_map(longer).collect();
        }
        Ok(rows)
    }

    /// The condition that the arguments are those of a row.
    fn matches(&mut self, arguments: &[Symbol], row: &[Value]) -> Result<Node> {
        let mut all = Terms::TRUE;
        for (argument, value) in arguments.iter().zip(row) {
            let same = self.equal(argument, &Symbol::Known(value.clone()))?;
            all = self.terms.and([all, same]);
            if all == Terms::FALSE {
                break;
            }
        }
        Ok(all)
    }

    /// The places that the arguments may denote, each with the condition that it is the one; and the condition that it
    /// is none of them.
    pub(super) fn places_at(
        &mut self,
        function: FunctionId,
        arguments: &[Symbol],
        span: Span,
    ) -> Result<(Vec<(Node, usize)>, Node)> {
        let all = self.places_of(function, span)?;
        if let Some(known) = arguments.iter().map(|argument| argument.known().cloned()).collect::<Option<Vec<_>>>() {
            return Ok(match all.binary_search_by(|(row, _)| row.cmp(&known)) {
                Ok(index) => (vec![(Terms::TRUE, all[index].1)], Terms::FALSE),
                Err(_) => (Vec::new(), Terms::TRUE),
            });
        }
        let mut places = Vec::new();
        for (row, place) in all.iter() {
            let here = self.matches(arguments, row)?;
            if here != Terms::FALSE {
                places.push((here, *place));
            }
        }
        // Bounds often show that it is one of them, which saves the solver the proof.
        let elsewhere = if self.all_within(function, arguments) {
            Terms::FALSE
        } else {
            let any = self.terms.or(places.iter().map(|(here, _)| *here));
            self.terms.not(any)
        };
        Ok((places, elsewhere))
    }

    /// Whether bounds show that each argument is in its domain.
    fn all_within(&mut self, function: FunctionId, arguments: &[Symbol]) -> bool {
        let program = Arc::clone(&self.program);
        let parameters = &program.function(function).parameters;
        arguments.iter().zip(parameters).all(|(argument, parameter)| match argument {
            Symbol::Known(value) => self.machine.contains(*parameter, value) && !value.is_undef(),
            Symbol::Open(open) if open.defined == Terms::TRUE => match open.shape {
                Shape::Boolean => true,
                _ => self.listed_within(*parameter, *open),
            },
            _ => false,
        })
    }

    fn listed_within(&mut self, domain: DomainId, open: Open) -> bool {
        let (Some(low), Some(high)) = self.terms.bounds(open.value) else { return false };
        let Some(elements) = self.elements_of(domain).filter(|elements| elements.len() as i128 > high - low) else {
            return false;
        };
        let mut numbers = std::collections::BTreeSet::new();
        for value in &elements {
            let node = constant(&mut self.terms, &mut self.codes, value);
            numbers.extend(self.terms.whole(node).filter(|_| Shape::of(value) == open.shape));
        }
        (low..=high).all(|number| numbers.contains(&number))
    }

    /// The places of a function, keyed by their arguments.
    fn places_of(&mut self, function: FunctionId, span: Span) -> Result<Arc<Rows>> {
        if let Some(known) = self.listed.get(&function) {
            return Ok(Arc::clone(known));
        }
        let program = Arc::clone(&self.program);
        let declared = program.function(function);
        let is_result = Some(function) == program.result_function;
        let kept = !is_result && declared.kind != FunctionKind::Local;
        if declared.kind == FunctionKind::Shared && !self.has_initial(function) {
            return self.outside("a shared function without an initial value", declared.span);
        }
        let shape = if kept { self.shape_of(declared.codomain, declared.span)? } else { Shape::Boolean };
        let mut rows: Vec<(Vec<Value>, usize)> = Vec::new();
        for row in self.rows(function, span)? {
            let place = self.places.len();
            let name = self.show(function, &row);
            let (mut value, mut defined, mut typed) = (Terms::FALSE, Terms::FALSE, Terms::TRUE);
            if kept {
                let (bounds, listed) = self.values_of(declared.codomain, shape);
                value = self.terms.variable(name.clone(), shape.kind(), bounds);
                typed = if listed.is_empty() { Terms::TRUE } else { self.one_of(value, &listed) };
                defined = Terms::TRUE;
                if self.partial.contains(&function) {
                    defined = self.terms.variable(format!("isDef {name}"), Kind::Boolean, (None, None));
                }
            }
            let location = Location { function, arguments: row.clone() };
            self.places.push(Place { location, shape, value, defined, kept, typed });
            let symbol = self.symbol(Open { shape, value, defined });
            self.original.push(symbol.clone());
            self.values.push(symbol);
            rows.push((row, place));
        }
        rows.sort();
        let rows = Arc::new(rows);
        self.listed.insert(function, Arc::clone(&rows));
        Ok(rows)
    }

    /// Creates the places of a function, if there are none yet.
    ///
    /// # Errors
    /// Its locations or values cannot be encoded.
    pub fn know(&mut self, function: FunctionId) -> Result<()> {
        let span = self.program.function(function).span;
        self.places_of(function, span).map(drop)
    }

    pub(super) fn shape_of(&self, domain: DomainId, span: Span) -> Result<Shape> {
        let base = self.program.base_domain(domain);
        Ok(match self.program.domain(base).kind {
            DomainKind::Basic(Basic::Boolean) => Shape::Boolean,
            DomainKind::Basic(Basic::Integer | Basic::Natural) => Shape::Integer,
            DomainKind::Basic(Basic::Real) => Shape::Real,
            DomainKind::Basic(Basic::String | Basic::Char) => Shape::Coded,
            DomainKind::Enum { .. } => Shape::Enum(base),
            DomainKind::Abstract { .. } => Shape::Element(base),
            _ => {
                let name = &self.program.domain(domain).name;
                return self.outside(format!("a function with values in {name}"), span);
            }
        })
    }

    /// A symbol as the value of a place, and whether it is defined. INVARIANT: where it is not, the value is one of the place's domain,
    /// too: a solver takes it for granted that each state has such values, and would else not see the state.
    ///
    /// # Errors
    /// It is of another kind than the place's values.
    pub fn lowered(&mut self, symbol: &Symbol, place: &Place) -> Result<(Node, Node)> {
        match symbol {
            Symbol::Known(Value::Undef) => Ok((place.value, Terms::FALSE)),
            Symbol::Known(value) if Shape::of(value) == place.shape => {
                Ok((constant(&mut self.terms, &mut self.codes, value), Terms::TRUE))
            }
            Symbol::Open(Open { shape, value, defined }) if *shape == place.shape => {
                Ok((self.terms.choose(*defined, *value, place.value), *defined))
            }
            _ => {
                let span = self.program.function(place.location.function).span;
                self.outside("a value of another kind than that of its function", span)
            }
        }
    }

    /// The same of a value that a place has in an initial state; of undef any value of the place's domain.
    ///
    /// # Errors
    /// See [`Encoder::lowered`].
    pub fn begun(&mut self, value: Value, place: &Place) -> Result<(Node, Node)> {
        let least = match (&value, place.shape.kind()) {
            (Value::Undef, Kind::Boolean) => Terms::FALSE,
            (Value::Undef, Kind::Real) => self.terms.real(0.0),
            (Value::Undef, Kind::Integer) => {
                let low = self.terms.bounds(place.value).0.unwrap_or(0);
                self.terms.integer(low)
            }
            _ => return self.lowered(&Symbol::Known(value), place),
        };
        Ok((least, Terms::FALSE))
    }

    /// The bounds of a domain's values; also the values themselves if bounds do not determine them.
    fn values_of(&mut self, domain: DomainId, shape: Shape) -> (Bounds, Vec<Node>) {
        let natural = matches!(self.program.domain(domain).kind, DomainKind::Basic(Basic::Natural));
        let listed = match shape {
            Shape::Boolean | Shape::Coded | Shape::Real => None,
            _ => self.elements_of(domain),
        };
        let mut nodes = Vec::new();
        for value in listed.iter().flatten() {
            nodes.push(constant(&mut self.terms, &mut self.codes, value));
        }
        let numbers: Vec<i128> = nodes.iter().filter_map(|node| self.terms.whole(*node)).collect();
        match (shape, numbers.iter().min(), numbers.iter().max()) {
            (_, Some(low), Some(high)) => {
                let gapless = high - low + 1 == numbers.len() as i128;
                ((Some(*low), Some(*high)), if gapless { Vec::new() } else { nodes })
            }
            (Shape::Integer, ..) if natural => ((Some(0), INTEGERS.1), Vec::new()),
            (Shape::Integer, ..) => (INTEGERS, Vec::new()),
            (Shape::Boolean | Shape::Real, ..) => ((None, None), Vec::new()),
            _ => ((Some(0), Some(1 << 32)), Vec::new()),
        }
    }

    /// An update of a location, under the condition `path`.
    pub(super) fn update(
        &mut self,
        function: FunctionId,
        arguments: &[Symbol],
        value: &Symbol,
        span: Span,
    ) -> Result<()> {
        let codomain = self.program.function(function).codomain;
        let outside = self.not_member(codomain, value)?;
        self.fault(FaultClass::OutOfDomain, outside);
        let (places, elsewhere) = self.places_at(function, arguments, span)?;
        self.beyond(elsewhere, "an update of a location whose argument is outside of its domain", span);
        for (here, place) in places {
            let guard = self.terms.and([self.path, here]);
            self.push(place, guard, value)?;
        }
        Ok(())
    }

    /// Adds an update to the current unit.
    pub(super) fn push(&mut self, place: usize, guard: Node, value: &Symbol) -> Result<()> {
        if guard == Terms::FALSE {
            return Ok(());
        }
        let former = self.units.last().and_then(|unit| unit.get(&place)).cloned();
        let entry = match former {
            None => (guard, value.clone()),
            Some((before, other)) => {
                let same = self.equal(value, &other)?;
                let differs = self.terms.not(same);
                let clash = self.terms.and([guard, before, differs]);
                self.fault(FaultClass::Inconsistent, clash);
                (self.terms.or([before, guard]), self.merge(guard, value, &other)?)
            }
        };
        if let Some(unit) = self.units.last_mut() {
            unit.insert(place, entry);
        }
        Ok(())
    }

    /// The condition that a value is outside of the codomain.
    fn not_member(&mut self, domain: DomainId, value: &Symbol) -> Result<Node> {
        let program = Arc::clone(&self.program);
        match (&program.domain(domain).kind, value) {
            (_, Symbol::Known(Value::Undef)) => Ok(Terms::FALSE),
            (DomainKind::Basic(Basic::Natural) | DomainKind::Concrete { .. }, Symbol::Known(value)) => {
                Ok(self.terms.boolean(!self.machine.contains(domain, value)))
            }
            (DomainKind::Basic(Basic::Natural), Symbol::Open(open)) if open.shape == Shape::Integer => {
                let zero = self.terms.integer(0);
                let negative = self.terms.less(open.value, zero);
                Ok(self.terms.and([negative, open.defined]))
            }
            (DomainKind::Concrete { .. }, Symbol::Open(open)) => {
                let mut nodes = Vec::new();
                for value in self.elements_of(domain).unwrap_or_default() {
                    if Shape::of(&value) == open.shape {
                        nodes.push(constant(&mut self.terms, &mut self.codes, &value));
                    }
                }
                let within =
                    if self.listed_within(domain, *open) { Terms::TRUE } else { self.one_of(open.value, &nodes) };
                let not = self.terms.not(within);
                Ok(self.terms.and([not, open.defined]))
            }
            (DomainKind::Concrete { .. }, _) => {
                let span = Span { file: syntax::FileId(0), start: 0, end: 0 };
                self.outside("an update in a domain of tuples or collections", span)
            }
            _ => Ok(Terms::FALSE),
        }
    }
}
