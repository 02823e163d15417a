//! Random terms by the library functions and binding constructs of each type.

use super::builder::{Builder, Layer, Scope, leaf, term};
use super::piece::Piece;
use super::signature::Type;

impl Builder {
    /// A term made of smaller ones by the operations of its type.
    pub fn composed(&mut self, scope: &Scope, wanted: &Type, depth: u32) -> Piece {
        match wanted {
            Type::Boolean => self.formula(scope, depth),
            Type::Integer | Type::Concrete(_) => self.integer(scope, wanted, depth),
            Type::Natural => self.natural(scope, depth),
            Type::Real => self.real(scope, depth),
            Type::Complex => self.complex(scope, depth),
            Type::String => self.string(scope, depth),
            Type::Seq(of) => self.sequence(scope, wanted, of, depth),
            Type::Set(of) => self.set(scope, wanted, of, depth),
            Type::Bag(of) => self.bag(scope, wanted, of, depth),
            Type::Map(from, to) => self.map(scope, wanted, (from, to), depth),
            Type::Prod(parts) => {
                let parts: Vec<Piece> = parts.iter().map(|part| self.term(scope, part, depth - 1)).collect();
                term(wanted, &format!("({})", super::term::holes(parts.len())), parts)
            }
            Type::Char | Type::Enum(_) | Type::Element(_) | Type::Rule(_) => {
                self.application(scope, wanted, depth).unwrap_or_else(|| self.small(scope, wanted))
            }
        }
    }

    /// The template with terms of these types.
    fn filled(&mut self, scope: &Scope, wanted: &Type, template: &str, types: &[&Type], depth: u32) -> Piece {
        let children = types.iter().map(|domain| self.term(scope, domain, depth - 1)).collect();
        term(wanted, template, children)
    }

    /// Two operands of a numeric operation, now and then one of a smaller domain.
    fn operands(&mut self, scope: &Scope, wanted: &Type, template: &str, domain: &Type, depth: u32) -> Piece {
        let smaller = match domain {
            Type::Integer => [Type::Natural, Type::Integer],
            Type::Real => [Type::Natural, Type::Integer],
            other => [other.clone(), other.clone()],
        };
        let mixed = if self.random.percent(12) { &smaller[self.random.below(2)] } else { domain };
        match self.random.percent(50) {
            true => self.filled(scope, wanted, template, &[mixed, domain], depth),
            false => self.filled(scope, wanted, template, &[domain, mixed], depth),
        }
    }

    fn one_of<'t>(&mut self, templates: &[&'t str]) -> &'t str {
        templates[self.random.below(templates.len())]
    }

    fn formula(&mut self, scope: &Scope, depth: u32) -> Piece {
        let boolean = &Type::Boolean;
        match self.random.below(16) {
            0..=2 => {
                let template = self.one_of(&[
                    "(§ and §)",
                    "(§ or §)",
                    "and(§, §)",
                    "(§ implies §)",
                    "(§ xor §)",
                    "(§ iff §)",
                    "(§ and §)",
                    "(§ or §)",
                ]);
                self.filled(scope, boolean, template, &[boolean, boolean], depth)
            }
            3 => self.filled(scope, boolean, "not(§)", &[boolean], depth),
            4 | 5 => {
                let number = [Type::Integer, Type::Integer, Type::Natural, Type::Real][self.random.below(4)].clone();
                let template = self.one_of(&["(§ < §)", "(§ <= §)", "(§ > §)", "(§ >= §)"]);
                self.operands(scope, boolean, template, &number, depth)
            }
            6 | 7 => {
                let domain = self.any_type(1);
                let template = self.one_of(&["(§ = §)", "(§ != §)", "eq(§, §)"]);
                self.filled(scope, boolean, template, &[&domain, &domain], depth)
            }
            8 => {
                let domain = self.any_type(1);
                let template = self.one_of(&["isDef(§)", "isUndef(§)"]);
                self.filled(scope, boolean, template, &[&domain], depth)
            }
            9 | 10 => {
                let domain = self.simple(false);
                let kinds = [domain.clone().set(), domain.clone().seq(), Type::Bag(Box::new(domain.clone()))];
                let collection = &kinds[self.random.below(3)];
                self.filled(scope, boolean, "contains(§, §)", &[collection, &domain], depth)
            }
            11 => {
                let set = self.simple(false).set();
                let template = self.one_of(&["allin(§, §)", "notallin(§, §)", "(§ = §)", "equality(§, §)"]);
                self.filled(scope, boolean, template, &[&set, &set], depth)
            }
            12 if self.random.percent(20) => {
                self.filled(scope, boolean, "contains(§, §)", &[&Type::String, &Type::String], depth)
            }
            12 => {
                let set = self.simple(false);
                let set = [set.clone().set(), set.seq()][self.random.below(2)].clone();
                self.filled(scope, boolean, "isEmpty(§)", &[&set], depth)
            }
            _ => {
                let quantifier = self.one_of(&["forall", "exists", "exists unique"]);
                let (binders, inner) = self.binders(scope, true, depth);
                let condition = self.term(&inner, boolean, depth - 1);
                term(boolean, &format!("({quantifier} § with §)"), vec![binders, condition])
            }
        }
    }

    fn integer(&mut self, scope: &Scope, wanted: &Type, depth: u32) -> Piece {
        let integer = &Type::Integer;
        match self.random.below(14) {
            0..=4 => {
                let template = self.one_of(&["(§ + §)", "(§ - §)", "(§ * §)", "max(§, §)", "min(§, §)", "plus(§, §)"]);
                self.operands(scope, wanted, template, integer, depth)
            }
            5 => {
                let divisor = ["2", "3", "-2", "7"][self.random.below(4)];
                let template = self.one_of(&["idiv(§, ¤)", "mod(§, ¤)", "(§ mod ¤)"]).replace('¤', divisor);
                self.filled(scope, wanted, &template, &[integer], depth)
            }
            6 if self.random.percent(20) => self.filled(scope, wanted, "idiv(§, §)", &[integer, integer], depth),
            6 => self.filled(scope, wanted, "(- §)", &[integer], depth),
            7 if self.random.percent(30) => self.filled(scope, wanted, "(§ ^ 3)", &[integer], depth),
            7 => self.filled(scope, wanted, "abs(§)", &[integer], depth),
            8 => {
                let of = self.simple(false);
                let key = Box::new(self.simple(true));
                let kinds =
                    [of.clone().set(), of.clone().seq(), Type::Bag(Box::new(of.clone())), Type::Map(key, Box::new(of))];
                let collection = &kinds[self.random.below(4)];
                self.filled(scope, wanted, "size(§)", &[collection], depth)
            }
            9 => {
                let seq = self.simple(false).seq();
                self.filled(scope, wanted, "length(§)", &[&seq], depth)
            }
            10 => {
                let item = self.simple(false);
                self.filled(scope, wanted, "indexOf(§, §)", &[&item.clone().seq(), &item], depth)
            }
            11 => {
                let numbers = Type::Integer;
                let kinds = [numbers.clone().set(), numbers.clone().seq(), Type::Bag(Box::new(numbers))];
                let collection = kinds[self.random.below(3)].clone();
                self.filled(scope, wanted, "sum(§)", &[&collection], depth)
            }
            12 => {
                let template = self.one_of(&["floor(§)", "round(§)", "rtoi(§)"]);
                self.filled(scope, wanted, template, &[&Type::Real], depth)
            }
            _ => match self.random.below(6) {
                3 if scope.layer == Layer::State => leaf(wanted, "mod(currTimeSecs, 7)"),
                4 => self.filled(scope, wanted, "toInteger(toString(§))", &[integer], depth),
                5 => {
                    let domain = self.any_type(1);
                    self.filled(scope, wanted, "print(§)", &[&domain], depth)
                }
                0 => self.filled(scope, wanted, "ntoi(§)", &[&Type::Natural], depth),
                1 => self.filled(scope, wanted, "size(§)", &[&Type::String], depth),
                _ => self.filled(scope, wanted, "(§ - §)", &[&Type::Natural, &Type::Natural], depth),
            },
        }
    }

    fn natural(&mut self, scope: &Scope, depth: u32) -> Piece {
        let natural = &Type::Natural;
        match self.random.below(6) {
            0 | 1 => {
                let template = self.one_of(&["(§ + §)", "(§ * §)", "max(§, §)", "min(§, §)"]);
                self.filled(scope, natural, template, &[natural, natural], depth)
            }
            2 => self.filled(scope, natural, "iton(abs(§))", &[&Type::Integer], depth),
            3 => {
                let item = self.simple(false);
                self.filled(scope, natural, "count(§, §)", &[&item.clone().seq(), &item], depth)
            }
            4 => {
                let item = self.simple(false);
                self.filled(scope, natural, "count(§, §)", &[&Type::Bag(Box::new(item.clone())), &item], depth)
            }
            _ if self.random.percent(30) => self.filled(scope, natural, "iton(§)", &[&Type::Integer], depth),
            _ => self.filled(scope, natural, "idiv(§, 2n)", &[natural], depth),
        }
    }

    fn real(&mut self, scope: &Scope, depth: u32) -> Piece {
        let real = &Type::Real;
        match self.random.below(11) {
            10 => {
                let template = self.one_of(&["re(§)", "im(§)"]);
                self.filled(scope, real, template, &[&Type::Complex], depth)
            }
            0..=3 => {
                let template = self.one_of(&["(§ + §)", "(§ - §)", "(§ * §)", "max(§, §)", "min(§, §)", "(§ ^ §)"]);
                self.operands(scope, real, template, real, depth)
            }
            4 => self.filled(scope, real, "(§ / 4.0)", &[real], depth),
            5 if self.random.percent(30) => self.filled(scope, real, "(§ / §)", &[real, real], depth),
            5 => self.filled(scope, real, "(§ / 3)", &[&Type::Integer], depth),
            6 => self.filled(scope, real, "itor(§)", &[&Type::Integer], depth),
            7 => self.filled(scope, real, "abs(§)", &[real], depth),
            8 => self.filled(scope, real, "sqrt(abs(§))", &[real], depth),
            _ => self.filled(scope, real, "sum(§)", &[&Type::Real.set()], depth),
        }
    }

    fn complex(&mut self, scope: &Scope, depth: u32) -> Piece {
        let complex = &Type::Complex;
        match self.random.below(6) {
            0..=2 => {
                let template = self.one_of(&["(§ + §)", "(§ - §)", "(§ * §)"]);
                self.filled(scope, complex, template, &[complex, complex], depth)
            }
            3 => self.filled(scope, complex, "(§ / §)", &[complex, complex], depth),
            4 => self.filled(scope, complex, "norm(§)", &[complex], depth),
            _ => self.filled(scope, complex, "(§ + §)", &[complex, &Type::Real], depth),
        }
    }

    fn string(&mut self, scope: &Scope, depth: u32) -> Piece {
        let string = &Type::String;
        match self.random.below(8) {
            0 | 1 => {
                let domain = self.any_type(1);
                self.filled(scope, string, "toString(§)", &[&domain], depth)
            }
            5 => self.filled(scope, string, "subString(§, 0, 1)", &[string], depth),
            6 => self.filled(scope, string, "toLower(§)", &[string], depth),
            7 => self.filled(scope, string, "first(split(§, \"a\"))", &[string], depth),
            2 => {
                let template = self.one_of(&["(§ + §)", "concat(§, §)"]);
                self.filled(scope, string, template, &[string, string], depth)
            }
            3 => self.filled(scope, string, "toUpper(§)", &[string], depth),
            _ => self.small(scope, string),
        }
    }

    fn sequence(&mut self, scope: &Scope, wanted: &Type, of: &Type, depth: u32) -> Piece {
        let natural = &Type::Natural;
        match self.random.below(13) {
            0 | 1 => self.filled(scope, wanted, "append(§, §)", &[wanted, of], depth),
            2 => self.filled(scope, wanted, "prepend(§, §)", &[of, wanted], depth),
            3 => self.filled(scope, wanted, "union(§, §)", &[wanted, wanted], depth),
            4 => self.filled(scope, wanted, "tail(§)", &[wanted], depth),
            5 => self.filled(scope, wanted, "excluding(§, §)", &[wanted, of], depth),
            6 => self.filled(scope, wanted, "insertAt(§, §, §)", &[wanted, natural, of], depth),
            7 => self.filled(scope, wanted, "replaceAt(§, §, §)", &[wanted, natural, of], depth),
            8 => self.filled(scope, wanted, "subSequence(§, 0n, 1n)", &[wanted], depth),
            9 => self.filled(scope, wanted, "asSequence(§)", &[&of.clone().set()], depth),
            10 if *of == Type::Integer => leaf(wanted, ["[1 : 3]", "[-2 : 4, 3]", "[0 : 0]"][self.random.below(3)]),
            11 => self.filled(scope, wanted, "asSequence(§)", &[&Type::Bag(Box::new(of.clone()))], depth),
            _ => {
                let from = self.simple(false);
                self.comprehension(scope, wanted, (&from.clone().seq(), &from), of, ("[", "]"), depth)
            }
        }
    }

    fn set(&mut self, scope: &Scope, wanted: &Type, of: &Type, depth: u32) -> Piece {
        match self.random.below(12) {
            0..=2 => {
                let template = self.one_of(&[
                    "union(§, §)",
                    "intersection(§, §)",
                    "difference(§, §)",
                    "symmetricDifference(§, §)",
                ]);
                self.filled(scope, wanted, template, &[wanted, wanted], depth)
            }
            3 => {
                let template = self.one_of(&["including(§, §)", "excluding(§, §)"]);
                self.filled(scope, wanted, template, &[wanted, of], depth)
            }
            4 => self.filled(scope, wanted, "asSet(§)", &[&of.clone().seq()], depth),
            5 if matches!(of, Type::Boolean | Type::Enum(_) | Type::Concrete(_) | Type::Element(_))
                && (scope.layer.reads_domains() || !of.is_dynamic()) =>
            {
                leaf(wanted, of.name())
            }
            6 if *of == Type::Integer => leaf(wanted, ["{1 : 3}", "{-2 : 4, 3}", "{0 : 0}"][self.random.below(3)]),
            6 if *of == Type::Real => leaf(wanted, ["{0.1 : 0.5, 0.1}", "{-1.0 : 1.0, 0.25}"][self.random.below(2)]),
            6 if *of == Type::Natural => self.filled(scope, wanted, "range(1n, 4n)", &[], depth),
            7 => self.filled(scope, wanted, "asSet(§)", &[&Type::Bag(Box::new(of.clone()))], depth),
            _ => {
                let (binders, inner) = self.binders(scope, false, depth);
                let body = self.term(&inner, of, depth - 1);
                if self.random.percent(30) {
                    return term(wanted, "{§ : §}", vec![binders, body]);
                }
                let condition = self.term(&inner, &Type::Boolean, depth - 1);
                term(wanted, "{§ | § : §}", vec![binders, condition, body])
            }
        }
    }

    fn bag(&mut self, scope: &Scope, wanted: &Type, of: &Type, depth: u32) -> Piece {
        match self.random.below(7) {
            0 => {
                let template = self.one_of(&["union(§, §)", "intersection(§, §)"]);
                self.filled(scope, wanted, template, &[wanted, wanted], depth)
            }
            1 => {
                let template = self.one_of(&["including(§, §)", "excluding(§, §)"]);
                self.filled(scope, wanted, template, &[wanted, of], depth)
            }
            2 => self.filled(scope, wanted, "asBag(§)", &[&of.clone().seq()], depth),
            3 => self.filled(scope, wanted, "asBag(§)", &[&of.clone().set()], depth),
            4 => {
                let set = of.clone().set();
                match self.random.below(3) {
                    0 => self.filled(scope, wanted, "union(§, §)", &[&set, wanted], depth),
                    1 => self.filled(scope, wanted, "union(§, §)", &[wanted, &set], depth),
                    _ => self.filled(scope, wanted, "intersection(§, §)", &[wanted, &set], depth),
                }
            }
            _ => {
                let from = self.simple(false);
                self.comprehension(scope, wanted, (&Type::Bag(Box::new(from.clone())), &from), of, ("<", ">"), depth)
            }
        }
    }

    fn comprehension(
        &mut self,
        scope: &Scope,
        wanted: &Type,
        (range, from): (&Type, &Type),
        of: &Type,
        (open, close): (&str, &str),
        depth: u32,
    ) -> Piece {
        let name = self.name(scope);
        let range = self.term(scope, range, depth - 1);
        let inner = scope.with(&name, &from.base());
        let body = self.term(&inner, of, depth - 1);
        let condition = self.term(&inner, &Type::Boolean, depth - 1);
        term(wanted, &format!("{open}{name} in § | § : §{close}"), vec![range, condition, body])
    }

    fn map(&mut self, scope: &Scope, wanted: &Type, (from, to): (&Type, &Type), depth: u32) -> Piece {
        match self.random.below(4) {
            0 | 1 => self.filled(scope, wanted, "assign(§, §, §)", &[wanted, from, to], depth),
            2 => self.filled(scope, wanted, "merge(§, §)", &[wanted, wanted], depth),
            _ => {
                let (binder, inner) = self.binder(scope, false, depth);
                let (key, value) = (self.term(&inner, from, depth - 1), self.term(&inner, to, depth - 1));
                term(wanted, "{§ : § -> § |}", vec![binder, key, value])
            }
        }
    }
}
