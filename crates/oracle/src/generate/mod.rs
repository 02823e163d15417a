//! Random models, as text: mostly well-typed; some of them clash or fault when they run.
//!
//! In: a seed and a size. Out: a [`Piece`] that prints as an AsmetaL model and can be made smaller. The models use the
//! whole language: domains of all kinds, functions of all kinds, macro rules called by name (with location parameters),
//! turbo rules with results and local functions, rule values, agents, invariants, all rules nested in each other.

mod builder;
mod composed;
mod piece;
mod random;
mod rule;
mod signature;
mod term;

pub use piece::{Path, Piece, Sort};
pub use random::Random;

use builder::{Builder, Layer, Scope, Variable};
use signature::{CARRIERS, ENUMS, Function, Kind, Parameter, RANGES, Rule, Signature, Type};

/// The model of a seed; its terms and rules nest about as deep as `size` says (2 to 5 are good).
pub fn model(seed: u64, size: u32) -> Piece {
    let mut builder = Builder {
        random: Random::new(seed),
        signature: Signature::default(),
        counters: 0,
        locals: 0,
        initialised: Vec::new(),
    };
    builder.declare();
    let definitions = builder.definitions(size);
    let rules = builder.rules(size);
    let main = builder.main(size);
    let invariants = builder.invariants();
    let init = builder.init();
    let item = |text: String| Piece::text(Sort::Item, text);
    let mut signature: Vec<Piece> = Vec::new();
    signature.extend(
        ENUMS.iter().map(|(name, literals)| item(format!("enum domain {name} = {{ {} }}\n", literals.join(" | ")))),
    );
    for range in &RANGES {
        let dynamic = if range.dynamic { "dynamic " } else { "" };
        signature.push(item(format!("{dynamic}domain {} subsetof Integer\n", range.name)));
    }
    for carrier in CARRIERS.iter().filter(|carrier| !carrier.declaration.is_empty()) {
        signature.push(item(format!("{}\n", carrier.declaration)));
    }
    for carrier in &CARRIERS {
        signature.extend(carrier.elements.iter().map(|element| item(format!("static {element}: {}\n", carrier.name))));
    }
    signature.extend(builder.signature.functions.iter().map(|function| item(format!("{}\n", function.declaration()))));
    signature.extend((0..builder.counters).map(|index| item(format!("controlled loop{index}: Integer\n"))));
    let fixed = RANGES.iter().filter(|range| !range.dynamic);
    let domains = fixed.map(|range| item(format!("domain {} = {}\n", range.name, range.definition))).collect();
    let list = |pieces| Piece::list(Sort::Fixed, "", pieces);
    Piece::new(
        Sort::Fixed,
        "asm Model\nimport StandardLibrary\nsignature:\n§definitions:\n§§§§§§",
        vec![list(signature), list(domains), list(definitions), list(rules), list(invariants), main, init],
    )
}

impl Builder {
    /// Declares functions without definition.
    fn declare(&mut self) {
        let mut number = 0;
        let mut declare = |builder: &mut Builder, kind: Kind, parameters: Vec<Type>, codomain: Type| {
            let letter = match kind {
                Kind::Monitored => 'm',
                Kind::Shared => 's',
                Kind::Out => 'o',
                _ => 'c',
            };
            let name = format!("{letter}{number}");
            number += 1;
            builder.signature.functions.push(Function { name, kind, parameters, codomain });
        };
        for codomain in [Type::Integer, Type::Integer, Type::Boolean, Type::Concrete(0)] {
            declare(self, Kind::Controlled, Vec::new(), codomain);
        }
        for _ in 0..8 {
            let count = [0, 0, 1, 1, 2][self.random.below(5)];
            let enumerable = self.random.percent(80);
            let parameters = (0..count).map(|_| self.simple(enumerable)).collect();
            let codomain = self.any_type(2);
            declare(self, Kind::Controlled, parameters, codomain);
        }
        for kind in [Kind::Monitored, Kind::Monitored, Kind::Monitored, Kind::Shared, Kind::Out] {
            let parameters = if self.random.percent(40) { vec![self.simple(true)] } else { Vec::new() };
            let enumerable = self.random.percent(50);
            let codomain = self.simple(enumerable);
            declare(self, kind, parameters, codomain);
        }
        declare(self, Kind::Controlled, Vec::new(), Type::Rule(Vec::new()));
        declare(self, Kind::Controlled, Vec::new(), Type::Rule(vec![Type::Integer]));
    }

    /// Static and derived functions with their definitions.
    fn definitions(&mut self, size: u32) -> Vec<Piece> {
        let mut definitions = Vec::new();
        for index in 0..4 {
            let kind = if index < 2 { Kind::Static } else { Kind::Derived };
            let name = format!("{}{index}", if index < 2 { 'k' } else { 'd' });
            let count = self.random.below(3);
            let parameters: Vec<Type> = (0..count).map(|_| self.simple(false)).collect();
            let codomain = self.any_type(1);
            let mut scope = Scope::new(if kind == Kind::Static { Layer::Static } else { Layer::State });
            let mut formal = Vec::new();
            for parameter in &parameters {
                let variable = self.name(&scope);
                formal.push(format!("{variable} in {}", parameter.name()));
                scope = scope.with(&variable, parameter);
            }
            let formal = if formal.is_empty() { String::new() } else { format!("({})", formal.join(", ")) };
            // A derived function has to read the state.
            let reading = if kind == Kind::Derived { "if isUndef(c0) then § else § endif" } else { "§" };
            let bodies: Vec<Piece> =
                reading.matches('§').map(|_| self.inside(&scope, &codomain, size.min(3))).collect();
            definitions.push(Piece::new(Sort::Item, &format!("function {name}{formal} = {reading}\n"), bodies));
            self.signature.functions.push(Function { name, kind, parameters, codomain });
        }
        definitions
    }

    /// Macro and turbo rules.
    fn rules(&mut self, size: u32) -> Vec<Piece> {
        let mut pieces = Vec::new();
        for index in 0..6 {
            let turbo = index % 2 == 1;
            let count = if index == 0 { 0 } else { self.random.below(3) };
            let mut parameters = Vec::new();
            let mut scope = Scope::new(Layer::State);
            scope.turbo = turbo;
            if turbo && self.random.percent(60) {
                scope.result = Some([Type::Integer, Type::Boolean, Type::Concrete(0)][self.random.below(3)].clone());
            }
            for _ in 0..count {
                let name = self.name(&scope);
                let location = !turbo && self.random.percent(45);
                let controlled: Vec<Type> = self
                    .signature
                    .functions
                    .iter()
                    .filter(|function| function.kind == Kind::Controlled && !matches!(function.codomain, Type::Rule(_)))
                    .map(|function| function.codomain.clone())
                    .collect();
                let domain =
                    if location { controlled[self.random.below(controlled.len())].clone() } else { self.simple(false) };
                scope.variables.push(Variable { name: name.clone(), domain: domain.clone(), location });
                parameters.push(Parameter { name, domain, location });
            }
            if index == 2 {
                // One that a rule value can be.
                parameters = vec![Parameter { name: "$x".to_string(), domain: Type::Integer, location: false }];
                scope.variables = vec![Variable { name: "$x".to_string(), domain: Type::Integer, location: false }];
            }
            scope.agent = index == 4 && parameters.is_empty();
            let rule = Rule { name: format!("r_{index}"), parameters, turbo, result: scope.result.clone() };
            let formal: Vec<String> = rule
                .parameters
                .iter()
                .map(|parameter| format!("{} in {}", parameter.name, parameter.domain.name()))
                .collect();
            let formal = if formal.is_empty() { String::new() } else { format!("({})", formal.join(", ")) };
            let result = rule.result.as_ref().map_or(String::new(), |result| format!(" in {}", result.name()));
            let body = self.rule(&scope, size.min(3));
            let word = if turbo { "turbo rule" } else { "rule" };
            pieces.push(Piece::new(Sort::Item, &format!("{word} {}{formal}{result} = §\n", rule.name), vec![body]));
            self.signature.rules.push(rule);
        }
        // One that calls itself, each call with a local function of its own.
        let (mut scope, integer) = (Scope::new(Layer::State).with("$n", &Type::Integer), Type::Integer);
        scope.result = Some(integer.clone());
        scope.locals.push(Function {
            name: "mine".to_string(),
            kind: Kind::Local,
            parameters: Vec::new(),
            codomain: integer,
        });
        let (first, last) = (self.rule(&scope, 1), self.rule(&scope, 1));
        let template = "turbo rule r_down($n in Integer) in Integer = local mine: Integer [ mine := $n ] \
                        if $n <= 0 then § else seq mine <- r_down($n - 1) § endseq endif\n";
        pieces.push(Piece::new(Sort::Item, template, vec![first, last]));
        let parameters = vec![Parameter { name: "$n".to_string(), domain: Type::Concrete(0), location: false }];
        let result = Some(Type::Integer);
        self.signature.rules.push(Rule { name: "r_down".to_string(), parameters, turbo: true, result });
        // The program of agents.
        let mut scope = Scope::new(Layer::State);
        scope.agent = true;
        let body = self.rule(&scope, 2);
        pieces.push(Piece::new(Sort::Item, "rule r_program = §\n", vec![body]));
        pieces
    }

    fn main(&mut self, size: u32) -> Piece {
        let mut scope = Scope::new(Layer::State);
        scope.main = true;
        let body = self.rule(&scope, size + 1);
        Piece::new(Sort::Fixed, "main rule r_Main = §\n", vec![body])
    }

    fn invariants(&mut self) -> Vec<Piece> {
        let count = self.random.below(3);
        let scope = Scope::new(Layer::State);
        (0..count)
            .map(|_| {
                let formula = self.term(&scope, &Type::Boolean, 3);
                Piece::new(Sort::Item, "invariant over c0: §\n", vec![formula])
            })
            .collect()
    }

    /// The initial state.
    fn init(&mut self) -> Piece {
        let mut items = Vec::new();
        for range in RANGES.iter().filter(|range| range.dynamic) {
            items.push(Piece::text(Sort::Item, format!("domain {} = {}\n", range.name, range.definition)));
        }
        if self.random.percent(50) {
            items.push(Piece::text(Sort::Item, "domain Leaf = { root }\n"));
        }
        let functions = self.signature.functions.clone();
        for function in functions.iter().filter(|function| matches!(function.kind, Kind::Controlled | Kind::Shared)) {
            if !self.random.percent(80) {
                continue;
            }
            if self.random.percent(1) {
                self.initialised = functions
                    .iter()
                    .filter(|function| function.kind == Kind::Controlled)
                    .map(|function| function.name.clone())
                    .collect();
            }
            let finite =
                |domain: &Type| matches!(domain, Type::Boolean | Type::Enum(_) | Type::Concrete(_) | Type::Element(_));
            // The initial value of one of infinitely many locations is due when it is read, or before it is overwritten:
            // it had better be a plain one.
            let eager = function.parameters.iter().all(finite);
            let grows = |domain: &Type| matches!(domain, Type::Element(_));
            if !eager && function.parameters.iter().any(grows) {
                continue;
            }
            let reads = eager && self.random.percent(20);
            let mut scope = Scope::new(match (eager, reads) {
                (false, _) => Layer::Literals,
                (true, false) => Layer::Static,
                (true, true) => Layer::Initial,
            });
            let mut formal = Vec::new();
            for parameter in &function.parameters {
                let variable = self.name(&scope);
                formal.push(format!("{variable} in {}", parameter.name()));
                scope = scope.with(&variable, parameter);
            }
            let formal = if formal.is_empty() { String::new() } else { format!("({})", formal.join(", ")) };
            let value = match eager {
                true => self.inside(&scope, &function.codomain, 2),
                false => self.small(&Scope::new(Layer::Literals), &function.codomain),
            };
            items.push(Piece::new(Sort::Item, &format!("function {}{formal} = §\n", function.name), vec![value]));
            if function.kind == Kind::Controlled {
                self.initialised.push(function.name.clone());
            }
        }
        items.push(Piece::text(Sort::Item, "agent Worker: r_program[]\n"));
        if self.random.percent(60) {
            items.push(Piece::text(Sort::Item, "agent Robot: r_0[]\n"));
        }
        if self.random.percent(30) {
            items.push(Piece::text(Sort::Item, "agent Agent: r_0[]\n"));
        }
        Piece::new(Sort::Item, "default init s0:\n§", vec![Piece::list(Sort::Fixed, "", items)])
    }
}
