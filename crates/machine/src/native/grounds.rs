//! What the certainty of values rests on ([`program::Certainty`]): the places of locations, and their values before the first step.
//!
//! In: a program and a started core. Out: what is certain of values. INVARIANT: whoever sets a location to undef from outside, or to a
//! collection that holds undef, throws the compiled code away ([`crate::Machine::set`]), and the machine makes none that relies on this
//! again; so it does where a procedure is run from outside that is not the main rule.

use program::{Basic, Certain, Certainty, DomainId, DomainKind, Entered, FunctionId, Locations, Program};

use crate::layout::{DimensionKind, Layout};
use crate::native::facts::{Facts, bounds_of, of_values};
use crate::value::Value;

/// Facts of a program.
pub(super) struct Grounds<'a> {
    pub program: &'a Program,
    pub facts: &'a Facts,
    /// By domain: it has the same elements in all states.
    pub constant: &'a [bool],
}

impl Grounds<'_> {
    /// What is certain of the program's values.
    pub fn certainty(&self) -> Certainty {
        let entered = if self.facts.entered { Entered::Any } else { Entered::MainAlone };
        Certainty::of(self.program, self, entered)
    }
}

impl Locations for Grounds<'_> {
    fn before_steps(&self, function: FunctionId) -> Certain {
        self.facts.before[function.0 as usize]
    }

    fn at_places(&self, function: FunctionId) -> Option<Certain> {
        let values = self.facts.settled[function.0 as usize].as_ref()?;
        Some(of_values(&values.iter().collect::<Vec<_>>(), None))
    }

    fn bounds_of_updates(&self, function: FunctionId) -> Option<(i64, i64)> {
        bounds_of(&self.facts.codomains[function.0 as usize])
    }

    fn has_place(&self, function: FunctionId, position: usize, domain: DomainId, bounds: Option<(i64, i64)>) -> bool {
        let Layout::Dense { dimensions, .. } = &self.facts.layouts[function.0 as usize] else { return false };
        let (dimension, base) = (&dimensions[position], self.program.base_domain(domain));
        match (dimension.kind, &self.program.domain(base).kind) {
            (DimensionKind::Boolean, DomainKind::Basic(Basic::Boolean)) => true,
            (DimensionKind::Enum(of), DomainKind::Enum { .. }) => of == base,
            (DimensionKind::Element(of), DomainKind::Abstract { elements, .. }) => {
                of == base && self.constant[of.0 as usize] && elements.len() <= dimension.size as usize
            }
            (DimensionKind::Integer { low }, DomainKind::Basic(Basic::Integer | Basic::Natural)) => {
                let last = low.saturating_add(i64::from(dimension.size) - 1);
                bounds.is_some_and(|(least, most)| low <= least && most <= last)
            }
            _ => false,
        }
    }

    fn bounds_of_elements(&self, domain: DomainId) -> Option<(i64, i64)> {
        if matches!(self.program.domain(domain).kind, DomainKind::Basic(Basic::Natural)) {
            return Some((0, i64::MAX));
        }
        let numbers = |value: &Value| if let Value::Integer(n) = value { Some(*n) } else { None };
        let contents = self.facts.contents[domain.0 as usize].as_ref()?;
        let numbers: Vec<i64> = contents.iter().map(numbers).collect::<Option<_>>()?;
        numbers.iter().copied().min().zip(numbers.iter().copied().max())
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;
    use crate::{Closed, Limits, Machine};

    /// What is certain of each function that a model declares, in a state that it has started in.
    fn certain(text: &str) -> Vec<String> {
        let file = syntax::SourceFile::new("Test.asm", format!("asm Test import StandardLibrary {text}"));
        let checked = model::check(file, &mut testkit::NoFiles);
        let program = Arc::new(program::lower(&checked.model).expect("complete"));
        let mut machine = Machine::new(Arc::clone(&program), Limits::default());
        machine.start(&mut Closed).expect("it starts");
        let facts = Facts::of(&program, &machine.core);
        let constant = program.constant_domains();
        let certainty = Grounds { program: &program, facts: &facts, constant: &constant }.certainty();
        let functions = (0..).map(FunctionId).zip(&program.functions);
        let shown =
            functions.filter(|(_, function)| !function.library && function.element.is_none()).map(|(id, function)| {
                let Certain { defined, solid, bounds } = certainty.function(id);
                let bounds = bounds.map_or(String::new(), |(low, high)| format!(" {low}..{high}"));
                let words = [(defined, "defined"), (solid, "solid")];
                let words: Vec<&str> = words.iter().filter(|(is, _)| *is).map(|(_, word)| *word).collect();
                format!("{}: {}{bounds}", function.name, words.join(" "))
            });
        shown.collect()
    }

    #[test]
    fn what_rules_write_is_looked_at() {
        let found = certain(
            "signature: abstract domain Task static one: Task static two: Task domain Index subsetof Integer
                enum domain State = {READY | WAITING}
                controlled next: Task -> Task controlled state: Task -> State controlled place: Index
                controlled maybe: Task controlled line: Seq(Task) controlled holes: Seq(Task) controlled count: Integer
                controlled other: Task -> Integer monitored input: Integer controlled taken: Integer
                derived waits: Task -> Boolean derived after: Task -> Task
            definitions: domain Index = {0 : 3}
                function waits($t in Task) = state($t) = WAITING and contains(line, $t)
                function after($t in Task) = next(next($t))
                rule r_Go($t in Task) = par
                    state(after($t)) := READY
                    count := count + other($t)
                    line := append(line, after($t))
                    holes := append(holes, maybe)
                endpar
                main rule r_Main = par
                    forall $t in Task with waits($t) do r_Go[$t]
                    place := (place + 1) mod 4
                    maybe := if isDef(maybe) then undef else one endif
                    taken := input
                endpar
            default init s0: function next($t in Task) = if $t = one then two else one endif
                function state($t in Task) = WAITING function place = 0 function maybe = one
                function line = [one, two] function holes = [one] function count = 0
                function other($t in Task) = 1 function taken = 0",
        );
        let expected = [
            "next: defined solid",
            "state: defined solid",
            "place: defined solid 0..3",
            "maybe: solid",
            "line: defined solid",
            "holes: defined",
            "count: defined solid",
            "other: defined solid",
            "input: ",
            "taken: ",
            "waits: solid",
            "after: defined solid",
        ];
        assert_eq!(found, expected);
    }

    #[test]
    fn self_is_certain_of_agents_alone() {
        let model = |main: &str| {
            certain(&format!(
                "signature: domain Worker subsetof Agent static w: Worker controlled last: Agent controlled n: Integer
                definitions: rule r_Note = last := self
                    rule r_Work = par r_Note[] n := n + 1 endpar
                    main rule r_Main = {main}
                default init s0: function last = w function n = 0 agent Worker: r_Work[]"
            ))
        };
        assert_eq!(model("forall $w in Worker with true do program($w)")[0], "last: defined solid");
        assert_eq!(model("par r_Note[] forall $w in Worker with true do program($w) endpar")[0], "last: ");
    }
}
