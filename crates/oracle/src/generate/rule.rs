//! Random rules.

use super::builder::{Builder, Scope, Variable, leaf};
use super::piece::{Piece, Sort};
use super::signature::{CARRIERS, Function, Kind, Parameter, Rule, Type};
use super::term::holes;

fn rule(template: &str, children: Vec<Piece>) -> Piece {
    Piece::new(Sort::Rule, template, children)
}

impl Builder {
    /// A rule; it nests no deeper than `depth`.
    pub fn rule(&mut self, scope: &Scope, depth: u32) -> Piece {
        if depth == 0 {
            return if self.random.percent(6) { Piece::text(Sort::Rule, "skip") } else { self.update(scope, 2) };
        }
        let terms = depth.min(2);
        match self.random.below(34) {
            0..=3 => self.update(scope, 3),
            4..=7 => self.several(scope, "par", depth),
            8..=11 => self.several(scope, "seq", depth),
            12 | 13 => self.conditional_rule(scope, depth),
            14 => self.switch_rule(scope, depth),
            15 | 16 => self.let_rule(scope, depth),
            17..=19 => self.choose(scope, depth),
            20..=22 => {
                let (binders, inner) = self.binders(scope, true, terms);
                let body = self.rule(&inner, depth - 1);
                if self.random.percent(40) {
                    return rule("forall § do §", vec![binders, body]);
                }
                let condition = self.term(&inner, &Type::Boolean, terms);
                rule("forall § with § do §", vec![binders, condition, body])
            }
            23 | 24 => self.extend(scope, depth),
            25 | 26 => self.repeated(scope, depth),
            27 | 28 => self.call(scope, false).unwrap_or_else(|| self.update(scope, 3)),
            29 | 30 => self.call(scope, true).unwrap_or_else(|| self.update(scope, 3)),
            31 if scope.main => self.agents(scope),
            32 if scope.turbo => self.local(scope, depth),
            33 if scope.main || self.random.percent(5) => {
                self.run_value(scope).unwrap_or_else(|| self.update(scope, 3))
            }
            _ => self.several(scope, "seq", depth),
        }
    }

    fn update(&mut self, scope: &Scope, depth: u32) -> Piece {
        let parameters: Vec<Variable> = scope.variables.iter().filter(|variable| variable.location).cloned().collect();
        if let Some(result) = scope.result.clone()
            && self.random.percent(25)
        {
            let value = self.inside(scope, &result, depth);
            return rule("result := §", vec![value]);
        }
        if !parameters.is_empty() && self.random.percent(35) {
            let parameter = &parameters[self.random.below(parameters.len())];
            let value = self.value(scope, &parameter.domain, depth);
            return rule(&format!("{} := §", parameter.name), vec![value]);
        }
        let (location, codomain) = self.location(scope, None, depth).expect("there are controlled functions");
        let value = self.value(scope, &codomain, depth);
        rule("§ := §", vec![location, value])
    }

    /// A value to be written: seldom undef.
    fn value(&mut self, scope: &Scope, codomain: &Type, depth: u32) -> Piece {
        if self.random.percent(5) {
            return leaf(codomain, "undef");
        }
        self.inside(scope, codomain, depth)
    }

    /// A location the machine may write, of a codomain if one is wanted.
    fn location(&mut self, scope: &Scope, codomain: Option<&Type>, depth: u32) -> Option<(Piece, Type)> {
        let writable =
            |function: &&Function| matches!(function.kind, Kind::Controlled | Kind::Shared | Kind::Out | Kind::Local);
        let wanted = |function: &&Function| {
            codomain.is_none_or(|codomain| function.codomain == *codomain && function.kind != Kind::Out)
        };
        let all = self.signature.functions.iter().chain(&scope.locals);
        let functions: Vec<Function> = all.filter(writable).filter(wanted).cloned().collect();
        let locals: Vec<Function> = functions.iter().filter(|function| function.kind == Kind::Local).cloned().collect();
        let from = if !locals.is_empty() && self.random.percent(40) { locals } else { functions };
        let function = self.random.pick(&from)?.clone();
        let sort = Sort::Fixed;
        if function.parameters.is_empty() {
            return Some((Piece::text(sort, function.name), function.codomain));
        }
        let arguments = self.arguments(scope, &function.parameters, depth.saturating_sub(1));
        Some((
            Piece::new(sort, &format!("{}({})", function.name, holes(arguments.len())), arguments),
            function.codomain,
        ))
    }

    fn several(&mut self, scope: &Scope, word: &str, depth: u32) -> Piece {
        let count = 2 + self.random.below(2);
        let rules = (0..count).map(|_| self.rule(scope, depth - 1)).collect();
        rule(&format!("{word} {} end{word}", vec!["§"; count].join("\n")), rules)
    }

    fn conditional_rule(&mut self, scope: &Scope, depth: u32) -> Piece {
        let guard = self.term(scope, &Type::Boolean, 3);
        let then = self.rule(scope, depth - 1);
        match self.random.below(5) {
            0 | 1 => rule("if § then § endif", vec![guard, then]),
            2 | 3 => rule("if § then § else § endif", vec![guard, then, self.rule(scope, depth - 1)]),
            _ => {
                let second = self.term(scope, &Type::Boolean, 2);
                let (b, c) = (self.rule(scope, depth - 1), self.rule(scope, 0));
                rule("if § then § elseif § then § else § endif", vec![guard, then, second, b, c])
            }
        }
    }

    fn switch_rule(&mut self, scope: &Scope, depth: u32) -> Piece {
        let on = self.simple(false);
        let subject = self.term(scope, &on, 2);
        let (first, second) = (self.literal(scope, &on), self.small(scope, &on));
        let (a, b, c) = (self.rule(scope, depth - 1), self.rule(scope, 0), self.rule(scope, depth - 1));
        rule("switch § case §: § case §: § otherwise § endswitch", vec![subject, first, a, second, b, c])
    }

    fn let_rule(&mut self, scope: &Scope, depth: u32) -> Piece {
        let bound = self.any_type(1);
        let name = self.name(scope);
        let value = self.term(scope, &bound, 2);
        let inner = scope.with(&name, &bound.base());
        let body = self.rule(&inner, depth - 1);
        rule(&format!("let ({name} = §) in § endlet"), vec![value, body])
    }

    fn choose(&mut self, scope: &Scope, depth: u32) -> Piece {
        let (binders, inner) = self.binders(scope, true, 2);
        let condition = self.term(&inner, &Type::Boolean, 2);
        let body = self.rule(&inner, depth - 1);
        match self.random.below(4) {
            0 => rule("choose § do §", vec![binders, body]),
            1 => rule("choose § with § do §", vec![binders, condition, body]),
            _ => {
                let none = self.rule(scope, 0);
                rule("choose § with § do § ifnone §", vec![binders, condition, body, none])
            }
        }
    }

    fn extend(&mut self, scope: &Scope, depth: u32) -> Piece {
        let domain = self.carrier(true);
        let name = self.name(scope);
        let inner = scope.with(&name, &Type::Element(domain));
        if self.random.percent(20) {
            let second = self.name(&inner);
            let body = self.rule(&inner.with(&second, &Type::Element(domain)), depth - 1);
            return rule(&format!("extend {} with {name}, {second} do §", CARRIERS[domain].name), vec![body]);
        }
        let body = self.rule(&inner, depth - 1);
        rule(&format!("extend {} with {name} do §", CARRIERS[domain].name), vec![body])
    }

    /// A loop over a counter of its own, or occasionally one without.
    fn repeated(&mut self, scope: &Scope, depth: u32) -> Piece {
        let body = self.rule(scope, depth - 1);
        if self.random.percent(10) {
            let condition = self.term(scope, &Type::Boolean, 2);
            return match self.random.below(2) {
                0 => rule("while § do §", vec![condition, body]),
                _ => rule("iterate if § then § endif enditerate", vec![condition, body]),
            };
        }
        let counter = format!("loop{}", self.counters);
        self.counters += 1;
        let rounds = 1 + self.random.below(4);
        let count = format!("{counter} := {counter} + 1");
        let template = match self.random.below(4) {
            0 => format!("seq {counter} := 0 while {counter} < {rounds} do par {count} § endpar endseq"),
            1 => format!("seq {counter} := 0 while {counter} < {rounds} do seq § {count} endseq endseq"),
            2 => format!("seq {counter} := 0 whilerec {counter} < {rounds} do seq {count} § endseq endseq"),
            _ => format!(
                "seq {counter} := 0 iterate if {counter} < {rounds} then par § {count} endpar endif enditerate endseq"
            ),
        };
        rule(&template, vec![body])
    }

    fn call(&mut self, scope: &Scope, turbo: bool) -> Option<Piece> {
        let rules: Vec<Rule> = self.signature.rules.iter().filter(|rule| rule.turbo == turbo).cloned().collect();
        let called = self.random.pick(&rules)?.clone();
        let mut arguments = Vec::new();
        for parameter in &called.parameters {
            arguments.push(self.passed(scope, parameter)?);
        }
        if !turbo {
            return Some(rule(&format!("{}[{}]", called.name, holes(arguments.len())), arguments));
        }
        let call = format!("{}({})", called.name, holes(arguments.len()));
        match &called.result {
            Some(result) if self.random.percent(70) => {
                let (location, _) = self.location(scope, Some(result), 2)?;
                Some(rule(&format!("§ <- {call}"), [vec![location], arguments].concat()))
            }
            _ => Some(rule(&call, arguments)),
        }
    }

    fn passed(&mut self, scope: &Scope, parameter: &Parameter) -> Option<Piece> {
        if !parameter.location {
            return Some(self.inside(scope, &parameter.domain, 2));
        }
        let fitting = |variable: &&Variable| variable.location && variable.domain == parameter.domain;
        let names: Vec<String> = scope.variables.iter().filter(fitting).map(|variable| variable.name.clone()).collect();
        if !names.is_empty() && self.random.percent(40) {
            return self.random.pick(&names).map(|name| Piece::text(Sort::Fixed, name.clone()));
        }
        Some(self.location(scope, Some(&parameter.domain), 2)?.0)
    }

    /// Runs the programs of agents.
    fn agents(&mut self, scope: &Scope) -> Piece {
        let name = self.name(scope);
        match self.random.below(5) {
            0 => Piece::text(Sort::Rule, format!("forall {name} in Worker do program({name})")),
            1 => Piece::text(Sort::Rule, format!("choose {name} in Agent do program({name})")),
            2 => Piece::text(Sort::Rule, ["program(anna)", "program(carl)"][self.random.below(2)]),
            3 => {
                let after = self.rule(&scope.with(&name, &Type::Element(4)), 0);
                rule(&format!("extend Robot with {name} do par program({name}) § endpar"), vec![after])
            }
            _ => {
                let after = self.rule(scope, 0);
                rule("seq program(bert) § endseq", vec![after])
            }
        }
    }

    fn run_value(&mut self, scope: &Scope) -> Option<Piece> {
        let rules = |function: &&Function| matches!(function.codomain, Type::Rule(_)) && function.parameters.is_empty();
        let functions: Vec<Function> = self.signature.functions.iter().filter(rules).cloned().collect();
        let function = self.random.pick(&functions)?.clone();
        let Type::Rule(parameters) = &function.codomain else { return None };
        if parameters.is_empty() {
            return Some(Piece::text(Sort::Rule, function.name));
        }
        let arguments = self.arguments(scope, parameters, 2);
        Some(rule(&format!("{}[{}]", function.name, holes(arguments.len())), arguments))
    }

    /// A rule with local functions.
    fn local(&mut self, scope: &Scope, depth: u32) -> Piece {
        let parameters = if self.random.percent(40) { vec![self.simple(true)] } else { Vec::new() };
        let name = format!("local{}", self.locals);
        self.locals += 1;
        let function = Function { name, kind: Kind::Local, parameters, codomain: self.any_type(1) };
        let mut inner = scope.clone();
        inner.locals.push(function.clone());
        let initial = self.rule(&inner, 0);
        let body = self.rule(&inner, depth - 1);
        rule(&format!("{} [ § ] §", function.declaration()), vec![initial, body])
    }
}
