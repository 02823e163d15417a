//! Which procedures and definitions call each other only a few levels deep, so that no call of them has to be counted.
//!
//! In: a program. Out: by procedure and by definition, whether the longest chain of calls from it is short. One that leads back to itself
//! has no longest chain.

use program::{FunctionId, ProcedureId, Program, RuleId, Runs, Term, TermId};

/// What is translated as one body.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(super) enum UnitKey {
    Procedure(ProcedureId),
    Definition(FunctionId),
}

/// LIMIT: a chain of so many calls is short.
const SHORT: u32 = 32;

/// See the module.
#[derive(Debug)]
pub(super) struct Nesting {
    procedures: Vec<Height>,
    definitions: Vec<Height>,
}

/// The longest chain of calls from a procedure or a definition.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Height {
    Unknown,
    /// It is being looked for: whoever meets it now is part of a circle.
    Open,
    Calls(u32),
    Endless,
}

impl Nesting {
    /// That of a program.
    pub fn of(program: &Program) -> Nesting {
        let mut nesting = Nesting {
            procedures: vec![Height::Unknown; program.procedures.len()],
            definitions: vec![Height::Unknown; program.functions.len()],
        };
        for index in 0..program.procedures.len() as u32 {
            nesting.height(program, UnitKey::Procedure(ProcedureId(index)), 0);
        }
        for index in 0..program.functions.len() as u32 {
            nesting.height(program, UnitKey::Definition(FunctionId(index)), 0);
        }
        nesting
    }

    /// Whether the longest chain of calls from it is short.
    pub fn is_short(&self, key: UnitKey) -> bool {
        matches!(self.place(key), Height::Calls(calls) if calls <= SHORT)
    }

    fn place(&self, key: UnitKey) -> Height {
        match key {
            UnitKey::Procedure(id) => self.procedures[id.0 as usize],
            UnitKey::Definition(id) => self.definitions[id.0 as usize],
        }
    }

    fn set(&mut self, key: UnitKey, height: Height) {
        match key {
            UnitKey::Procedure(id) => self.procedures[id.0 as usize] = height,
            UnitKey::Definition(id) => self.definitions[id.0 as usize] = height,
        }
    }

    fn height(&mut self, program: &Program, key: UnitKey, depth: u32) -> Height {
        match self.place(key) {
            Height::Unknown => {}
            Height::Open => return Height::Endless,
            known => return known,
        }
        // A chain that is too long is as good as one without end.
        if depth > 2 * SHORT {
            return Height::Endless;
        }
        self.set(key, Height::Open);
        let mut height = Height::Calls(0);
        for called in calls(program, key) {
            height = match (height, self.height(program, called, depth + 1)) {
                (Height::Calls(most), Height::Calls(calls)) => Height::Calls(most.max(calls + 1)),
                _ => Height::Endless,
            };
            if height == Height::Endless {
                break;
            }
        }
        self.set(key, height);
        height
    }
}

/// What a procedure or a definition may call.
fn calls(program: &Program, key: UnitKey) -> Vec<UnitKey> {
    let (mut rules, mut terms): (Vec<RuleId>, Vec<TermId>) = match key {
        UnitKey::Procedure(id) => (vec![program.procedure(id).body], Vec::new()),
        UnitKey::Definition(id) => {
            (Vec::new(), program.function(id).definition.iter().map(|definition| definition.body).collect())
        }
    };
    let mut found = Vec::new();
    let any = |arity: usize| {
        let value = |term: &Term| if let Term::Rule(procedure) = term { Some(*procedure) } else { None };
        let values = program.terms.iter().filter_map(value);
        values.filter(move |id| program.procedure(*id).parameters.len() == arity).map(UnitKey::Procedure)
    };
    while let Some(id) = rules.pop() {
        match program.rule(id).runs() {
            Runs::Nothing => {}
            Runs::Procedure(procedure) => found.push(UnitKey::Procedure(procedure)),
            Runs::Value { arguments } => found.extend(any(arguments.len as usize)),
            Runs::Agent => found.extend(program.agents.iter().map(|entry| UnitKey::Procedure(entry.procedure))),
        }
        program.each_term_of_rule(id, &mut |term| terms.push(term));
        program.each_child_of_rule(id, &mut |rule| rules.push(rule));
    }
    while let Some(id) = terms.pop() {
        if let Term::Define { function, .. } = program.term(id) {
            found.push(UnitKey::Definition(*function));
        }
        program.each_child_of_term(id, &mut |term| terms.push(term));
    }
    found.sort_unstable();
    found.dedup();
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    fn nesting(text: &str) -> (Program, Nesting) {
        let file = syntax::SourceFile::new("Test.asm", text);
        let checked = model::check(file, &mut testkit::NoFiles);
        let program = program::lower(&checked.model).expect("complete");
        let nesting = Nesting::of(&program);
        (program, nesting)
    }

    #[test]
    fn circles_have_no_end() {
        let (program, nesting) = nesting(
            "asm Test import StandardLibrary signature: controlled n: Integer static even: Integer -> Boolean \
             static odd: Integer -> Boolean static flat: Integer -> Integer static above: Integer -> Boolean definitions: \
             function even($n in Integer) = if $n = 0 then true else odd($n - 1) endif \
             function odd($n in Integer) = if $n = 0 then false else even($n - 1) endif \
             function flat($n in Integer) = $n + 1 function above($n in Integer) = even(flat($n)) \
             rule r_leaf = n := flat(n) rule r_calls = r_leaf[] main rule r_Main = r_calls[] default init s0: function n = 1",
        );
        let short = |name: &str| {
            let function = (0..).map(FunctionId).find(|id| program.function(*id).name == name).expect("declared");
            nesting.is_short(UnitKey::Definition(function))
        };
        assert!(!short("even") && !short("odd") && !short("above") && short("flat"));
        let main = program.main.expect("there is one");
        assert!(nesting.is_short(UnitKey::Procedure(main)));
    }
}
