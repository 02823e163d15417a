//! Random terms of a type.

use super::builder::{Builder, Layer, Scope, leaf, term};
use super::piece::{Piece, Sort};
use super::signature::{CARRIERS, ENUMS, Function, RANGES, Type};

impl Builder {
    /// A term of a type; it nests no deeper than `depth`.
    pub fn term(&mut self, scope: &Scope, wanted: &Type, depth: u32) -> Piece {
        if depth == 0 {
            return self.small(scope, wanted);
        }
        match self.random.below(20) {
            0..=3 => self.small(scope, wanted),
            4 | 5 => self.application(scope, wanted, depth).unwrap_or_else(|| self.small(scope, wanted)),
            6 => self.conditional(scope, wanted, depth),
            7 => self.switch(scope, wanted, depth),
            8 => self.binding(scope, wanted, depth),
            9 => self.selection(scope, wanted, depth),
            _ => self.composed(scope, wanted, depth),
        }
    }

    /// A variable, a function without arguments, or a literal.
    pub fn small(&mut self, scope: &Scope, wanted: &Type) -> Piece {
        let fitting = |name: &str, domain: &Type| domain.fits(wanted).then(|| name.to_string());
        let mut names: Vec<String> =
            scope.variables.iter().filter_map(|variable| fitting(&variable.name, &variable.domain)).collect();
        if !names.is_empty() && self.random.percent(60) {
            return leaf(wanted, names.swap_remove(self.random.below(names.len())));
        }
        let constants: Vec<Function> =
            self.functions(scope, wanted).into_iter().filter(|function| function.parameters.is_empty()).collect();
        if !constants.is_empty() && self.random.percent(55) {
            return leaf(wanted, constants[self.random.below(constants.len())].name.clone());
        }
        self.literal(scope, wanted)
    }

    /// A literal or a collection of literals.
    pub fn literal(&mut self, scope: &Scope, wanted: &Type) -> Piece {
        let text = match wanted {
            Type::Boolean => ["true", "false"][self.random.below(2)].to_string(),
            Type::Integer => match self.random.below(60) {
                0 => "9223372036854775807".to_string(),
                1 => "-9223372036854775807".to_string(),
                _ => (self.random.below(14) as i64 - 4).to_string(),
            },
            Type::Natural => format!("{}n", self.random.below(6)),
            Type::Real => ["0.0", "1.0", "0.5", "-2.5", "3.25", "0.1", "1000000.0"][self.random.below(7)].to_string(),
            Type::Complex => ["0.0+i1.0", "1.5-i2.0", "2.0+i0.0"][self.random.below(3)].to_string(),
            Type::Char => ["'a'", "'b'", "'z'"][self.random.below(3)].to_string(),
            Type::String => ["\"\"", "\"a\"", "\"ab\"", "\"x y\"", "\"b\""][self.random.below(5)].to_string(),
            Type::Enum(index) => {
                let literals = ENUMS[*index].1;
                literals[self.random.below(literals.len())].to_string()
            }
            Type::Concrete(index) => {
                let contents = RANGES[*index].contents;
                contents[self.random.below(contents.len())].to_string()
            }
            Type::Element(index) if scope.agent && CARRIERS[*index].agents && self.random.percent(50) => {
                "self".to_string()
            }
            Type::Element(index) => {
                let named = |element: &&&str| element.len() > 1;
                let elements: Vec<&&str> = CARRIERS
                    .iter()
                    .enumerate()
                    .filter(|(other, carrier)| other == index || carrier.base == Some(*index))
                    .flat_map(|(_, carrier)| carrier.elements)
                    .filter(named)
                    .collect();
                match self.random.pick(&elements) {
                    Some(element) if !scope.layer.reads_domains() || !self.random.percent(10) => element.to_string(),
                    None if !scope.layer.reads_domains() => "undef".to_string(),
                    _ => format!("chooseone({})", CARRIERS[*index].name),
                }
            }
            Type::Prod(parts) => {
                let parts = parts.iter().map(|part| self.small(scope, part)).collect::<Vec<_>>();
                return Piece::new(Sort::Term(wanted.clone()), &format!("({})", holes(parts.len())), parts);
            }
            Type::Seq(of) => return self.elements(scope, wanted, of, ("[", "]")),
            Type::Set(of) => return self.elements(scope, wanted, of, ("{", "}")),
            Type::Bag(of) => return self.elements(scope, wanted, of, ("<", ">")),
            Type::Map(from, to) => {
                let (key, value) = (self.literal(scope, from), self.small(scope, to));
                return term(wanted, "{§->§}", vec![key, value]);
            }
            Type::Rule(parameters) => {
                let fits = |rule: &&super::signature::Rule| {
                    let values = rule.parameters.iter().all(|parameter| !parameter.location);
                    values && rule.parameters.iter().map(|parameter| &parameter.domain).eq(parameters)
                };
                let named = |rule: &super::signature::Rule| match parameters.is_empty() {
                    true => format!("<<{}>>", rule.name),
                    false => format!(
                        "<<{}({})>>",
                        rule.name,
                        parameters.iter().map(Type::name).collect::<Vec<_>>().join(",")
                    ),
                };
                let rules: Vec<String> = self.signature.rules.iter().filter(fits).map(named).collect();
                self.random.pick(&rules).cloned().unwrap_or_else(|| "undef".to_string())
            }
        };
        leaf(wanted, text)
    }

    fn elements(&mut self, scope: &Scope, wanted: &Type, of: &Type, (open, close): (&str, &str)) -> Piece {
        let count = 1 + self.random.below(3);
        let mut parts: Vec<Piece> = (0..count).map(|_| self.small(scope, of)).collect();
        if open == "{" {
            // The checker refuses equal elements of a set that are written alike.
            let mut seen = Vec::new();
            parts.retain(|part| {
                let text = part.to_string();
                !seen.contains(&text) && {
                    seen.push(text);
                    true
                }
            });
        }
        term(wanted, &format!("{open}{}{close}", holes(parts.len())), parts)
    }

    /// A function applied to arguments.
    pub fn application(&mut self, scope: &Scope, wanted: &Type, depth: u32) -> Option<Piece> {
        let functions: Vec<Function> =
            self.functions(scope, wanted).into_iter().filter(|function| !function.parameters.is_empty()).collect();
        let function = self.random.pick(&functions)?.clone();
        let arguments = self.arguments(scope, &function.parameters, depth - 1);
        Some(term(wanted, &format!("{}({})", function.name, holes(arguments.len())), arguments))
    }

    /// Terms for parameters.
    pub fn arguments(&mut self, scope: &Scope, parameters: &[Type], depth: u32) -> Vec<Piece> {
        parameters.iter().map(|parameter| self.argument(scope, parameter, depth)).collect()
    }

    /// A term of a type that, where the type is a subset of its base, is mostly in it.
    pub fn inside(&mut self, scope: &Scope, wanted: &Type, depth: u32) -> Piece {
        match wanted {
            Type::Concrete(index) if !self.random.percent(8) => {
                let exact: Vec<String> = scope
                    .variables
                    .iter()
                    .filter(|variable| variable.domain == *wanted)
                    .map(|variable| variable.name.clone())
                    .collect();
                if !exact.is_empty() && self.random.percent(50) {
                    return leaf(wanted, exact[self.random.below(exact.len())].clone());
                }
                if depth == 0 || self.random.percent(40) {
                    return self.literal(scope, wanted);
                }
                let number = self.term(scope, &Type::Integer, depth - 1);
                let contents = RANGES[*index].contents;
                if RANGES[*index].dynamic {
                    let list = contents.iter().map(i64::to_string).collect::<Vec<_>>().join(",");
                    return term(wanted, &format!("(if contains({{{list}}}, §) then 2 else 5 endif)"), vec![number]);
                }
                term(wanted, &format!("({} + mod(abs(§), {}))", contents[0], contents.len()), vec![number])
            }
            _ => self.term(scope, wanted, depth),
        }
    }

    /// An argument: a function that is declared for a subset of an abstract domain takes no others of that.
    fn argument(&mut self, scope: &Scope, wanted: &Type, depth: u32) -> Piece {
        let Type::Element(index) = wanted else { return self.inside(scope, wanted, depth) };
        if CARRIERS[*index].base.is_none() {
            return self.inside(scope, wanted, depth);
        }
        let exact = scope.variables.iter().filter(|variable| variable.domain == *wanted);
        let mut names: Vec<String> = exact.map(|variable| variable.name.clone()).collect();
        names.extend(CARRIERS[*index].elements.iter().map(|element| element.to_string()));
        if names.is_empty() && !scope.layer.reads_domains() {
            names.push("undef".to_string());
        }
        if names.is_empty() || (scope.layer.reads_domains() && self.random.percent(10)) {
            names.push(format!("chooseone({})", CARRIERS[*index].name));
        }
        Piece::text(Sort::Fixed, names.swap_remove(self.random.below(names.len())))
    }

    fn conditional(&mut self, scope: &Scope, wanted: &Type, depth: u32) -> Piece {
        let guard = self.term(scope, &Type::Boolean, depth - 1);
        let (a, b) = (self.term(scope, wanted, depth - 1), self.term(scope, wanted, depth - 1));
        match self.random.below(8) {
            0 => term(wanted, "if § then § endif", vec![guard, a]),
            1 => {
                let second = self.term(scope, &Type::Boolean, depth - 1);
                let c = self.small(scope, wanted);
                term(wanted, "if § then § elseif § then § else § endif", vec![guard, a, second, b, c])
            }
            _ => term(wanted, "if § then § else § endif", vec![guard, a, b]),
        }
    }

    fn switch(&mut self, scope: &Scope, wanted: &Type, depth: u32) -> Piece {
        let on = self.simple(false);
        let subject = self.term(scope, &on, depth - 1);
        let (first, second) = (self.literal(scope, &on), self.small(scope, &on));
        let (a, b, c) =
            (self.term(scope, wanted, depth - 1), self.small(scope, wanted), self.term(scope, wanted, depth - 1));
        match self.random.percent(80) {
            true => term(
                wanted,
                "switch § case §: § case §: § otherwise § endswitch",
                vec![subject, first, a, second, b, c],
            ),
            false => term(wanted, "switch § case §: § case §: § endswitch", vec![subject, first, a, second, b]),
        }
    }

    fn binding(&mut self, scope: &Scope, wanted: &Type, depth: u32) -> Piece {
        let bound = self.any_type(1);
        let name = self.name(scope);
        let value = self.term(scope, &bound, depth - 1);
        let inner = scope.with(&name, &bound.base());
        if self.random.percent(25) {
            let second = self.name(&inner);
            let more = self.term(&inner, &bound, depth - 1);
            let body = self.term(&inner.with(&second, &bound.base()), wanted, depth - 1);
            return term(wanted, &format!("let ({name} = §, {second} = §) in § endlet"), vec![value, more, body]);
        }
        let body = self.term(&inner, wanted, depth - 1);
        term(wanted, &format!("let ({name} = §) in § endlet"), vec![value, body])
    }

    /// A component of a product or an element of a collection.
    fn selection(&mut self, scope: &Scope, wanted: &Type, depth: u32) -> Piece {
        if matches!(wanted, Type::Rule(_)) || !scope.layer.reads_domains() {
            return self.small(scope, wanted);
        }
        let other = self.simple(false);
        match self.random.below(9) {
            7 => {
                let three = Type::Prod(vec![other.clone(), other, wanted.clone()]);
                let triple = self.term(scope, &three, depth - 1);
                term(wanted, "third(§)", vec![triple])
            }
            8 if scope.result.as_ref() == Some(wanted) => leaf(wanted, "result"),
            0 => {
                let pair = self.term(scope, &Type::Prod(vec![wanted.clone(), other]), depth - 1);
                term(wanted, "first(§)", vec![pair])
            }
            1 => {
                let pair = self.term(scope, &Type::Prod(vec![other, wanted.clone()]), depth - 1);
                term(wanted, "second(§)", vec![pair])
            }
            2 => {
                let seq = self.term(scope, &wanted.clone().seq(), depth - 1);
                let name = ["first", "last"][self.random.below(2)];
                term(wanted, &format!("{name}(§)"), vec![seq])
            }
            3 => {
                let seq = self.term(scope, &wanted.clone().seq(), depth - 1);
                let index = self.literal(scope, &Type::Natural);
                term(wanted, "at(§, §)", vec![seq, index])
            }
            4 => {
                let key = self.simple(true);
                let map = self.term(scope, &Type::Map(Box::new(key.clone()), Box::new(wanted.clone())), depth - 1);
                let key = self.small(scope, &key);
                term(wanted, "at(§, §)", vec![map, key])
            }
            5 => {
                let set = self.term(scope, &wanted.clone().set(), depth - 1);
                term(wanted, "chooseone(§)", vec![set])
            }
            _ if scope.layer == Layer::State => {
                let inner = self.term(scope, wanted, depth - 1);
                term(wanted, "pre(§)", vec![inner])
            }
            _ => self.small(scope, wanted),
        }
    }

    /// `$x in range`, and the scope with the variable: a domain or a set, or another collection.
    pub fn binder(&mut self, scope: &Scope, others: bool, depth: u32) -> (Piece, Scope) {
        let name = self.name(scope);
        let (range, domain) = match self.random.below(12) {
            0..=6 => {
                let domain = match self.simple(true) {
                    // What depends on a dynamic domain is not static.
                    domain if domain.is_dynamic() && !scope.layer.reads_domains() => Type::Enum(0),
                    domain => domain,
                };
                (leaf(&domain.clone().set(), domain.name()), domain)
            }
            7 => {
                let parts = 2 + usize::from(self.random.percent(20));
                let pair = Type::Prod((0..parts).map(|_| self.small_type()).collect());
                (leaf(&pair.clone().set(), pair.name()), pair)
            }
            8 => {
                let subsets = self.small_type().set();
                (leaf(&subsets.clone().set(), subsets.name()), subsets)
            }
            _ => {
                let domain = self.simple(false);
                let range = match self.random.below(if others { 4 } else { 1 }) {
                    1 => domain.clone().seq(),
                    2 => Type::Bag(Box::new(domain.clone())),
                    _ => domain.clone().set(),
                };
                (self.term(scope, &range, depth.saturating_sub(1)), domain.base())
            }
        };
        let inner = scope.with(&name, &domain);
        (Piece::new(Sort::Fixed, &format!("{name} in §"), vec![range]), inner)
    }

    /// A type with few elements.
    fn small_type(&mut self) -> Type {
        match self.random.below(10) {
            0..=3 => Type::Boolean,
            4 => Type::Concrete(0),
            _ => Type::Enum(self.random.below(ENUMS.len())),
        }
    }

    /// One or two binders, and the scope within.
    pub fn binders(&mut self, scope: &Scope, others: bool, depth: u32) -> (Piece, Scope) {
        let (first, inner) = self.binder(scope, others, depth);
        if !self.random.percent(25) {
            return (first, inner);
        }
        let (second, inner) = self.binder(&inner, others, depth);
        (Piece::new(Sort::Fixed, "§, §", vec![first, second]), inner)
    }
}

/// So many places for children.
pub(super) fn holes(count: usize) -> String {
    vec!["§"; count].join(", ")
}
