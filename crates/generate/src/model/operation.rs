//! Generates the library's functions in C++ (spec/standard-library.md).
//!
//! On scalars each is an operator or a function of `machine/numbers.hpp`; on dynamic values it is the function of the
//! same name in `machine/library.hpp`.

use program::{Builtin, Cpp, Operands, TermId, TermList};

use crate::names::{identifier, snake};

use crate::model::code::{Code, beside, between, unwrapped, within};
use crate::model::generator::{EMPTY, Generator};
use crate::model::interval::{Interval, Outcome};
use crate::model::reach::Need;
use crate::model::types::{Type, item_type};

/// LIMIT: how many items a list may have; collection_limit of machine/operands.hpp. SYNC(collection)
const MOST_ITEMS: i64 = 10_000_000;

impl Generator<'_> {
    /// A library function applied to terms.
    pub fn operation(&mut self, builtin: Builtin, arguments: TermList, id: TermId) -> Code {
        use Builtin::*;
        let program = self.program;
        let site = self.site(id);
        let terms = program.term_list(arguments).to_vec();
        match builtin {
            Pre => return self.before(terms[0], id),
            Temporal(_) => {
                return Code::defined(format!("gs::failed<bool>(gs::FaultKind::temporal, {site})"), Type::Boolean);
            }
            TimeNanoseconds | TimeMilliseconds | TimeSeconds => {
                self.reach.expect_need(Need::Clock);
                let unit = match builtin {
                    TimeNanoseconds => "nanoseconds",
                    TimeMilliseconds => "milliseconds",
                    _ => "seconds",
                };
                return Code::defined(format!("clock(gs::TimeUnit::{unit})"), Type::Integer);
            }
            Print => {
                let evaluated: Vec<String> =
                    terms.iter().map(|term| format!("(void)({}), ", self.term(*term).text)).collect();
                return Code::defined(format!("({}std::int64_t{{1}})", evaluated.concat()), Type::Integer);
            }
            _ => {}
        }
        if builtin == SeqLength
            && let Some(code) = self.counted(terms[0])
        {
            return code;
        }
        let codes: Vec<Code> = terms.iter().map(|term| self.term(*term)).collect();
        if matches!(builtin, And | Or | Implies)
            && let [left, right] = &codes[..]
        {
            return self.connective(builtin, left.clone(), right.clone(), site);
        }
        let (statements, codes) = self.hoist(codes, !matches!(builtin, Eq | Neq));
        let code = self.applied(builtin, codes, &terms, id);
        within(&statements, code)
    }

    /// An operation applied to operands of which at most one has an effect.
    fn applied(&mut self, builtin: Builtin, codes: Vec<Code>, terms: &[TermId], id: TermId) -> Code {
        let site = self.site(id);
        if let Some(code) = self.on_lists(builtin, &codes, site) {
            return code;
        }
        if let Some(code) = self.on_scalars(builtin, &codes, site) {
            return code;
        }
        let mut values = Vec::new();
        for (code, term) in codes.into_iter().zip(terms) {
            let site = self.site(*term);
            values.push(self.convert(code, Type::Value, false, site));
        }
        self.needs_values(self.program.term_span(id), "a dynamic value");
        let code = self.on_values(builtin, values, id);
        self.typed(code, id)
    }

    fn on_values(&mut self, builtin: Builtin, values: Vec<String>, id: TermId) -> Code {
        use Builtin::*;
        let site = self.site(id);
        let list = values.join(", ");
        let text = match builtin {
            ChooseOne => format!("choose_one({list}, {site})"),
            Program => {
                self.reach.expect_need(Need::AgentProgram);
                format!("agent_program({list})")
            }
            ToString | AgentId | GetAgent => {
                self.reach.expect_need(Need::Names);
                format!("gs::{}({list}, names(), {site})", function_of(builtin))
            }
            Component(index) => format!("gs::component({index}, {list}, {site})"),
            SetSum | SeqSum | BagSum => {
                let zero = match self.term_type(id) {
                    Type::Real => "gs::Value::real(0.0)",
                    Type::Value => "gs::Value::complex(0.0, 0.0)",
                    _ => "gs::Value::integer(0)",
                };
                format!("gs::{}({list}, {zero}, {site})", function_of(builtin))
            }
            Xor | Not => format!("gs::{}_({list}, {site})", function_of(builtin)),
            _ => format!("gs::{}({list}, {site})", function_of(builtin)),
        };
        Code::value(text)
    }

    /// `pre(t)`: the value of a term in the state before the step.
    fn before(&mut self, term: TermId, id: TermId) -> Code {
        let code = self.term(term);
        let site = self.site(id);
        let ty = if code.ty == Type::Undef { Type::Value } else { code.ty };
        let (defined, range) = (code.defined, code.range);
        let text = self.convert(code, ty, defined, site);
        let result = self.plan.cpp(ty, defined);
        let text = format!("before([&]() -> {result} {{ return {text}; }})");
        Code { text, ty, defined, pure: false, range }
    }

    /// An operation on scalars; `None` if it needs dynamic values.
    fn on_scalars(&mut self, builtin: Builtin, codes: &[Code], site: u32) -> Option<Code> {
        use Builtin::*;
        let scalar = |code: &Code| !matches!(code.ty, Type::Value | Type::Undef | Type::List(_));
        match (builtin, codes) {
            (Eq, [left, right]) => {
                let text = self.equality(left.clone(), right.clone(), site);
                return Some(truth(text, left.pure && right.pure));
            }
            (Neq, [left, right]) => {
                let text = format!("!{}", self.equality(left.clone(), right.clone(), site));
                return Some(truth(text, left.pure && right.pure));
            }
            (IsDef | IsUndef, [operand]) => {
                let text = match (operand.ty, operand.defined) {
                    (Type::Undef, _) => (builtin == IsUndef).to_string(),
                    (_, true) => format!("((void)({}), {})", operand.text, builtin == IsDef),
                    _ if builtin == IsDef => format!("gs::is_defined({})", operand.text),
                    _ => format!("!gs::is_defined({})", operand.text),
                };
                return Some(truth(text, operand.pure));
            }
            (Not, [operand]) if boolean(operand) => {
                let operand = self.cast(operand.clone(), Type::Boolean, site);
                let text = match (operand.ty, operand.defined) {
                    (Type::Undef, _) => "gs::Maybe<bool>{}".to_string(),
                    (_, true) => format!("!{}", operand.text),
                    _ => format!("gs::negation({})", operand.text),
                };
                return Some(Code { text, ty: Type::Boolean, ..operand });
            }
            _ => {}
        }
        if !codes.iter().all(scalar) {
            return None;
        }
        let types: Vec<Type> = codes.iter().map(|code| code.ty).collect();
        let numbers = types.iter().all(|ty| matches!(ty, Type::Integer | Type::Real));
        let integers = types.iter().all(|ty| *ty == Type::Integer);
        let pure = codes.iter().all(|code| code.pure && code.defined);
        let mut operands =
            |ty: Type| -> Vec<String> { codes.iter().map(|code| self.convert(code.clone(), ty, true, site)).collect() };
        let order = match builtin {
            Lt => Some("<"),
            Le => Some("<="),
            Gt => Some(">"),
            Ge => Some(">="),
            _ => None,
        };
        if let Some(symbol) = order {
            let ty = match types[..] {
                [Type::Integer, Type::Integer] => Type::Integer,
                [Type::Char, Type::Char] => Type::Char,
                _ if numbers => Type::Real,
                _ => return None,
            };
            let operands = operands(ty);
            let text = match (types[..] == [Type::Integer, Type::Integer], codes) {
                (true, [left, right]) if left.defined && right.defined => beside(left, symbol, right),
                _ => between(&operands[0], symbol, &operands[1]),
            };
            return Some(truth(text, pure));
        }
        let called = |name: &str, operands: Vec<String>, ty: Type| {
            let list: Vec<&str> = operands.iter().map(|operand| unwrapped(operand)).collect();
            Some(Code::defined(format!("gs::{name}({}, {site})", list.join(", ")), ty))
        };
        match builtin {
            Xor | Iff if types.iter().all(|ty| *ty == Type::Boolean) => {
                let operands = operands(Type::Boolean);
                let symbol = if builtin == Xor { "!=" } else { "==" };
                let text = between(&operands[0], symbol, &operands[1]);
                Some(truth(text, pure))
            }
            NatToInt if integers => {
                let operand = codes[0].clone();
                let range = operand.range;
                let text = self.convert(operand, Type::Integer, true, site);
                Some(Code { text, ty: Type::Integer, defined: true, pure, range })
            }
            IntToReal | NatToReal if numbers => {
                let operands = operands(Type::Real);
                Some(Code { pure, ..Code::defined(operands[0].clone(), Type::Real) })
            }
            _ => {
                let (name, result) = match builtin.info().cpp {
                    Cpp::Integer(name) => (name, Type::Integer),
                    Cpp::Real(name) => (name, Type::Real),
                    Cpp::Other => return None,
                };
                match builtin.info().operands {
                    Operands::Integers(_) if integers => {}
                    Operands::Reals(_) if numbers => return called(name, operands(Type::Real), result),
                    _ => return None,
                }
                let operands = operands(Type::Integer);
                let Some((outcome, symbol)) = arithmetic(builtin, codes) else {
                    return called(name, operands, result);
                };
                let code = match symbol {
                    Some(symbol) if outcome.safe => {
                        let known = |index: usize| Code { text: operands[index].clone(), ..codes[index].clone() };
                        Code::defined(beside(&known(0), symbol, &known(1)), result)
                    }
                    _ => called(name, operands, result)?,
                };
                Some(Code { pure: pure && outcome.safe, ..code.within(outcome.interval) })
            }
        }
    }

    /// An operation on lists; `None` if it needs dynamic values.
    fn on_lists(&mut self, builtin: Builtin, codes: &[Code], site: u32) -> Option<Code> {
        use Builtin::*;
        let of = codes.iter().find_map(|code| match code.ty {
            Type::List(of) => Some(of),
            _ => None,
        })?;
        let (list, item) = (Type::List(of), item_type(self.program, of));
        let shape: Vec<Type> = match builtin {
            SeqLength | SeqIsEmpty | First | Last | Tail => vec![list],
            SeqContains | SeqIndexOf | Append => vec![list, item],
            SeqConcat => vec![list, list],
            _ => return None,
        };
        let fits = |(code, ty): (&Code, &Type)| match code.ty {
            // An item may be undef; a list must not be.
            Type::Undef => *ty == item,
            Type::Value => code.text == EMPTY && *ty == list,
            given => given == *ty,
        };
        if codes.len() != shape.len() || !codes.iter().zip(&shape).all(fits) {
            return None;
        }
        let pure = codes.iter().zip(&shape).all(|(code, ty)| code.pure && (code.defined || *ty == item));
        if builtin == Append && !codes[1].defined {
            self.refuted.solid = false;
        }
        let mut texts = Vec::new();
        for (code, ty) in codes.iter().zip(&shape) {
            let defined = if *ty == item { code.defined } else { true };
            texts.push(self.convert(code.clone(), *ty, defined, site));
        }
        let list_of = texts.join(", ");
        let plain = |name: &str, ty: Type| Code { pure, ..Code::defined(format!("gs::{name}({list_of})"), ty) };
        let sized = |name: &str, ty: Type| Code::defined(format!("gs::{name}({list_of}, {site})"), ty);
        Some(match builtin {
            SeqLength => plain("length", Type::Integer).within(Interval { low: 0, high: MOST_ITEMS }),
            SeqIsEmpty => plain("is_empty", Type::Boolean),
            SeqContains => plain("contains", Type::Boolean),
            SeqIndexOf => plain("index_of", Type::Integer).within(Interval { low: -1, high: MOST_ITEMS }),
            First => Code { defined: false, ..sized("first_of", item) },
            Last => Code { defined: false, ..sized("last_of", item) },
            Tail => sized("tail_of", list),
            Append => sized("with_last", list),
            _ => sized("joined", list),
        })
    }

    /// Kleene's `and`, `or`, `implies`; the right operand is evaluated only if it matters.
    fn connective(&mut self, builtin: Builtin, left: Code, right: Code, site: u32) -> Code {
        let pure = left.pure && right.pure;
        if left.defined && right.defined && left.ty == Type::Boolean && right.ty == Type::Boolean {
            let text = match builtin {
                Builtin::And => format!("({} && {})", left.text, right.text),
                Builtin::Or => format!("({} || {})", left.text, right.text),
                _ => format!("(!{} || {})", left.text, right.text),
            };
            return truth(text, pure);
        }
        let name = match builtin {
            Builtin::And => "conjunction",
            Builtin::Or => "disjunction",
            _ => "implication",
        };
        let operand = |code: Code, this: &mut Self| {
            let code = this.cast(code, Type::Boolean, site);
            if code.ty == Type::Undef { "gs::Maybe<bool>{}".to_string() } else { code.text }
        };
        let (left, right) = (operand(left, self), operand(right, self));
        let text = format!("gs::{name}({left}, [&]() -> gs::Maybe<bool> {{ return {right}; }})");
        Code { defined: false, ..truth(text, pure) }
    }
}

/// The name of the library function for dynamic values.
fn function_of(builtin: Builtin) -> String {
    identifier(&snake(&format!("{builtin:?}")))
}

/// A truth value.
fn truth(text: String, pure: bool) -> Code {
    Code { pure, ..Code::defined(text, Type::Boolean) }
}

/// Integer arithmetic: the interval of the result, and the C++ operator if it cannot fault.
fn arithmetic(builtin: Builtin, codes: &[Code]) -> Option<(Outcome, Option<&'static str>)> {
    Some(match (builtin, codes) {
        (Builtin::IntAdd, [a, b]) => (a.range.add(b.range), Some("+")),
        (Builtin::IntSub, [a, b]) => (a.range.subtract(b.range), Some("-")),
        (Builtin::IntMul, [a, b]) => (a.range.multiply(b.range), Some("*")),
        (Builtin::IntMod, [a, b]) => (a.range.remainder(b.range), Some("%")),
        (Builtin::IntQuotient, [a, b]) => (a.range.quotient(b.range), Some("/")),
        (Builtin::IntMin, [a, b]) => (a.range.minimum(b.range), None),
        (Builtin::IntMax, [a, b]) => (a.range.maximum(b.range), None),
        (Builtin::IntNeg, [a]) => (a.range.negate(), None),
        (Builtin::IntAbs, [a]) => (a.range.absolute(), None),
        _ => return None,
    })
}

fn boolean(code: &Code) -> bool {
    matches!(code.ty, Type::Boolean | Type::Undef | Type::Value)
}
