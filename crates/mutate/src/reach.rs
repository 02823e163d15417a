//! What a model runs: the rules and functions that its main rule, its agents and its initial state use.
//!
//! In: a checked model. Out: sets of ids. What only properties and assumptions use is not in them: it is part of the judge,
//! not of what is judged.

use std::collections::BTreeSet;

use model::{DomainKind, FunctionId, Model, RuleId, RuleKind, RuleNode, Target, Term, TermKind};

/// The rules and functions that are used.
#[derive(Debug, Clone, Default)]
pub(crate) struct Reach {
    pub rules: BTreeSet<RuleId>,
    pub functions: BTreeSet<FunctionId>,
}

/// What is still to be looked at.
enum Open<'m> {
    Rule(&'m RuleNode),
    Term(&'m Term),
}

impl Reach {
    /// What the model runs.
    pub fn of_runs(model: &Model) -> Reach {
        let mut reach = Reach::default();
        let mut open = Vec::new();
        model.main.into_iter().for_each(|main| reach.rule(model, main, &mut open));
        if let Some(init) = model.default_init.and_then(|index| model.inits.get(index)) {
            init.agents.iter().for_each(|agent| reach.rule(model, agent.rule, &mut open));
            open.extend(init.functions.iter().map(|initial| Open::Term(&initial.definition.body)));
            open.extend(init.domains.iter().map(|(_, contents)| Open::Term(contents)));
        }
        for (_, domain) in model.domains.iter() {
            if let DomainKind::Concrete { definition: Some(contents), .. } = &domain.kind {
                open.push(Open::Term(contents));
            }
        }
        reach.close(model, open);
        reach
    }

    /// What a function's definition uses, itself included.
    pub fn of_function(model: &Model, function: FunctionId) -> Reach {
        let mut reach = Reach::default();
        let mut open = Vec::new();
        reach.function(model, function, &mut open);
        reach.close(model, open);
        reach
    }

    /// What a rule uses, itself included.
    pub fn of_rule(model: &Model, rule: RuleId) -> Reach {
        let mut reach = Reach::default();
        let mut open = Vec::new();
        reach.rule(model, rule, &mut open);
        reach.close(model, open);
        reach
    }

    fn close<'m>(&mut self, model: &'m Model, mut open: Vec<Open<'m>>) {
        while let Some(next) = open.pop() {
            match next {
                Open::Rule(rule) => rule.walk(&mut |rule| self.enter(model, rule, &mut open)),
                Open::Term(term) => term.walk(&mut |term| match &term.kind {
                    TermKind::Apply { function, .. } => self.function(model, *function, &mut open),
                    TermKind::Rule(rule) => self.rule(model, *rule, &mut open),
                    _ => {}
                }),
            }
        }
    }

    fn enter<'m>(&mut self, model: &'m Model, rule: &'m RuleNode, open: &mut Vec<Open<'m>>) {
        rule.terms(&mut |term| open.push(Open::Term(term)));
        match &rule.kind {
            RuleKind::MacroCall(call) | RuleKind::TurboCall(call) => self.rule(model, call.rule, open),
            RuleKind::Return { target, call } => {
                self.target(target);
                self.rule(model, call.rule, open);
            }
            RuleKind::Update { target, .. } => self.target(target),
            _ => {}
        }
    }

    fn target(&mut self, target: &Target) {
        if let Target::Location { function, .. } = target {
            self.functions.insert(*function);
        }
    }

    fn rule<'m>(&mut self, model: &'m Model, rule: RuleId, open: &mut Vec<Open<'m>>) {
        if self.rules.insert(rule) {
            open.push(Open::Rule(&model.rule(rule).body));
        }
    }

    fn function<'m>(&mut self, model: &'m Model, function: FunctionId, open: &mut Vec<Open<'m>>) {
        if self.functions.insert(function)
            && let Some(definition) = &model.function(function).definition
        {
            open.push(Open::Term(&definition.body));
        }
    }
}
