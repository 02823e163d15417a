//! The initial state: what the default `init` says (Börger & Stärk 2003, section 2.4.4, "initial states").
//!
//! Initial values are values in the initial state. An initialiser may read other initialised functions, so each is
//! evaluated when it is first needed; one that needs itself is a fault. A function whose arguments cannot be enumerated
//! gets its initial values when they are read: they are then still those of the initial state.

use model::{DomainId, DomainKind, FunctionId, FunctionKind, Init, InitialFunction, Model};

use crate::element::{is_abstract, named_elements};
use crate::fault::Fault;
use crate::interpreter::{Assignment, Initialisation, Interpreter};
use crate::state::{Location, State};
use crate::value::Value;

impl Interpreter<'_> {
    /// The initial state.
    pub(crate) fn initial_state(&mut self) -> Result<State, Fault> {
        self.initialisation = Some(Initialisation::default());
        let mut state = State::default();
        for (_, declared, element) in named_elements(self.model) {
            let base = self.model.domains.type_domain(declared);
            state.set(Location::member(base, element.clone()), Value::Boolean(true));
            if declared != base {
                state.set(Location::member(declared, element), Value::Boolean(true));
            }
        }
        let Some(init) = default_init(self.model) else { return Ok(state) };
        for (domain, contents) in &init.domains {
            let contents = self.value(contents, &state, &Assignment::default())?;
            for element in contents.elements().ok_or(Fault::NotEnumerable)? {
                state.set(Location::member(*domain, element), Value::Boolean(true));
            }
        }
        for initial in init.functions.iter().filter(|initial| initial_function(self.model, initial.function).is_some())
        {
            if let Some(tuples) = self.arguments(initial, &state)? {
                for arguments in tuples {
                    self.read(Location::function(initial.function, arguments), &state)?;
                }
            }
        }
        let known = self.initialisation.take().expect("set above").known;
        for (location, value) in known {
            state.set(location, value);
        }
        Ok(state)
    }

    /// All argument tuples of a function, if there are finitely many.
    fn arguments(&mut self, initial: &InitialFunction, state: &State) -> Result<Option<Vec<Vec<Value>>>, Fault> {
        let mut tuples = vec![Vec::new()];
        for domain in &self.model.function(initial.function).parameters {
            if !enumerable(self.model, *domain) {
                return Ok(None);
            }
            let elements = self.elements(*domain, state)?;
            tuples = tuples
                .into_iter()
                .flat_map(|tuple| {
                    elements.iter().map(move |element| [tuple.as_slice(), std::slice::from_ref(element)].concat())
                })
                .collect();
        }
        Ok(Some(tuples))
    }

    /// The initial value of a location, while the initial state is made; none if it has none.
    pub(crate) fn initial_value(
        &mut self,
        function: FunctionId,
        location: &Location,
        state: &State,
    ) -> Result<Option<Value>, Fault> {
        let Some(initialisation) = &mut self.initialisation else { return Ok(None) };
        let Some(initial) = initial_function(self.model, function) else { return Ok(None) };
        if let Some(value) = initialisation.known.get(location) {
            return Ok(Some(value.clone()));
        }
        if initialisation.running.contains(location) {
            // Its evaluation would not end.
            return Err(Fault::Limit);
        }
        initialisation.running.push(location.clone());
        let value = self.defined_initially(initial, location, state)?;
        let initialisation = self.initialisation.as_mut().expect("still there");
        initialisation.running.pop();
        initialisation.known.insert(location.clone(), value.clone());
        Ok(Some(value))
    }

    /// What the init section says of a location, whatever its arguments are. That a value is in the codomain is asked
    /// of updates alone.
    fn defined_initially(
        &mut self,
        initial: &InitialFunction,
        location: &Location,
        state: &State,
    ) -> Result<Value, Fault> {
        let zeta = Assignment::default().parameters(&initial.definition.parameters, location.arguments.clone());
        self.call(|this| this.value(&initial.definition.body, state, &zeta))
    }

    /// The initial value of a location that was not given one at the start: there are infinitely many, or its arguments
    /// were not in the parameters' domains then.
    pub(crate) fn late_initial_value(
        &mut self,
        function: FunctionId,
        location: &Location,
    ) -> Result<Option<Value>, Fault> {
        let Some(initial) = initial_function(self.model, function) else { return Ok(None) };
        if self.initialisation.is_some() {
            return Ok(None);
        }
        let state = self.initial.clone();
        self.defined_initially(initial, location, &state).map(Some)
    }
}

/// The init section that counts.
pub(crate) fn default_init(model: &Model) -> Option<&Init> {
    model.default_init.map(|index| &model.inits[index])
}

/// The initial values of a function. Those of a monitored one do not matter in a run: the environment gives its values.
pub(crate) fn initial_function(model: &Model, function: FunctionId) -> Option<&InitialFunction> {
    if model.function(function).kind == FunctionKind::Monitored {
        return None;
    }
    default_init(model)?.functions.iter().find(|initial| initial.function == function)
}

/// Can the elements of the domain be enumerated?
pub(crate) fn enumerable(model: &Model, domain: DomainId) -> bool {
    match model.domains.kind(domain) {
        DomainKind::Basic(basic) => *basic == model::Basic::Boolean,
        DomainKind::Enum { .. } | DomainKind::Abstract { .. } => true,
        DomainKind::Concrete { base, dynamic, definition } => {
            *dynamic || definition.is_some() || is_abstract(model, *base)
        }
        DomainKind::Prod(parts) => parts.iter().all(|part| enumerable(model, *part)),
        DomainKind::Powerset(of) => enumerable(model, *of),
        _ => false,
    }
}
