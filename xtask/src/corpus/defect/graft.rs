//! A copy of a program in which terms and rules are replaced.
//!
//! In: a program. Out: the copy with what was grafted on it. New terms and rules stand at the ends of the arenas, so a
//! child may stand behind its parent: the copy is for the machine alone, not for `program::verify`.

use model::Literal;
use program::{Builtin, Function, FunctionId, Program, Rule, RuleId, RuleList, Term, TermId, TermList};

/// The copy, and whether anything was replaced in it.
#[derive(Debug)]
pub struct Graft {
    /// The copy.
    pub program: Program,
    replaced: bool,
}

impl Graft {
    /// On a program.
    pub fn of(program: &Program) -> Self {
        Graft { program: program.clone(), replaced: false }
    }

    /// The copy, if anything was replaced.
    pub fn done(self) -> Vec<Program> {
        if self.replaced { vec![self.program] } else { Vec::new() }
    }

    /// A new term, with the domain and place of another.
    pub fn term(&mut self, term: Term, like: TermId) -> TermId {
        let program = &mut self.program;
        program.terms.push(term);
        program.term_domains.push(program.term_domains[like.0 as usize]);
        program.term_spans.push(program.term_spans[like.0 as usize]);
        TermId(program.terms.len() as u32 - 1)
    }

    /// A list of terms.
    pub fn terms(&mut self, terms: &[TermId]) -> TermList {
        let start = self.program.term_lists.len() as u32;
        self.program.term_lists.extend_from_slice(terms);
        TermList { start, len: terms.len() as u32 }
    }

    /// A library function applied.
    pub fn builtin(&mut self, builtin: Builtin, operands: &[TermId], like: TermId) -> TermId {
        let arguments = self.terms(operands);
        self.term(Term::Builtin { builtin, arguments }, like)
    }

    /// A constant.
    pub fn constant(&mut self, literal: Literal, like: TermId) -> TermId {
        self.program.constants.push(literal);
        self.term(Term::Constant(self.program.constants.len() as u32 - 1), like)
    }

    /// Another term in the place of one; gives where the one stands now.
    pub fn replace(&mut self, place: TermId, by: impl FnOnce(&mut Self, TermId) -> Term) {
        let former = self.term(self.program.term(place).clone(), place);
        let term = by(self, former);
        self.program.terms[place.0 as usize] = term;
        self.replaced = true;
    }

    /// Another rule in the place of one.
    pub fn replace_rule(&mut self, place: RuleId, rule: Rule) {
        self.program.rules[place.0 as usize] = rule;
        self.replaced = true;
    }

    /// A new rule, with the place of another.
    pub fn rule(&mut self, rule: Rule, like: RuleId) -> RuleId {
        let program = &mut self.program;
        program.rules.push(rule);
        program.rule_spans.push(program.rule_spans[like.0 as usize]);
        RuleId(program.rules.len() as u32 - 1)
    }

    /// A list of rules.
    pub fn rules(&mut self, rules: &[RuleId]) -> RuleList {
        let start = self.program.rule_lists.len() as u32;
        self.program.rule_lists.extend_from_slice(rules);
        RuleList { start, len: rules.len() as u32 }
    }

    /// A new function.
    pub fn function(&mut self, function: Function) -> FunctionId {
        self.program.functions.push(function);
        FunctionId(self.program.functions.len() as u32 - 1)
    }

    /// Changes what is no term or rule.
    pub fn change(&mut self, change: impl FnOnce(&mut Program)) {
        change(&mut self.program);
        self.replaced = true;
    }
}

/// The terms that apply a library function, with its operands.
pub fn applications(program: &Program) -> Vec<(TermId, Builtin, TermList)> {
    let all = program.terms.iter().enumerate();
    all.filter_map(|(index, term)| match term {
        Term::Builtin { builtin, arguments } => Some((TermId(index as u32), *builtin, *arguments)),
        _ => None,
    })
    .collect()
}

/// The rules of a program by number.
pub fn rules(program: &Program) -> Vec<(RuleId, Rule)> {
    program.rules.iter().enumerate().map(|(index, rule)| (RuleId(index as u32), rule.clone())).collect()
}
