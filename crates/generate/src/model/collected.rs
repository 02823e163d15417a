//! Generates collections and quantifiers as loops of C++.
//!
//! In: binders, a condition, a body. Out: [`Code`], a lambda that is called on the spot. A sequence over a small domain
//! is a list (`machine/lists.hpp`), everything else a dynamic value.

use program::{BinderList, CollectionKind, DomainId, Quantifier, Term, TermId, TermList};

use crate::model::code::{CALLED, Code};
use crate::model::generator::Generator;
use crate::model::interval::Interval;
use crate::model::term::collection;
use crate::model::text::Text;
use crate::model::types::{Type, item_type};

impl Generator<'_> {
    /// `[binders | condition : body]`, or another kind of collection.
    pub fn comprehension(
        &mut self,
        kind: CollectionKind,
        (binders, condition, body): (BinderList, Option<TermId>, TermId),
        id: TermId,
    ) -> Code {
        let list = match self.term_type(id) {
            Type::List(of) if kind == CollectionKind::Seq => Some(of),
            _ => None,
        };
        if list.is_none() {
            self.needs_values(self.program.term_span(id), "a collection");
        }
        let items = self.fresh("items");
        let mut text = Text::default();
        text.open(format!("{CALLED} {{"));
        let class = list.map_or("gs::Values".to_string(), |of| self.plan.cpp(Type::List(of), true));
        text.line(format!("{class} {items};"));
        let site = self.site(body);
        self.ranging(binders, &mut text, &mut |this, text| {
            let guard = condition.map(|condition| this.guard(condition));
            if let Some(guard) = &guard {
                text.open(format!("if ({guard}) {{"));
            }
            match list {
                Some(of) => {
                    let item = this.item(body, of);
                    text.line(format!("{items}.push_back({}, {site});", item.text));
                }
                None => {
                    let body = this.value(body);
                    text.line(format!("gs::append_to({items}, {body}, {site});"));
                }
            }
            if guard.is_some() {
                text.close("}");
            }
        });
        if let Some(of) = list {
            text.line(format!("return {items};"));
            text.close("}()");
            return Code::defined(text.plain().trim_end(), Type::List(of));
        }
        text.line(format!("return {};", collection(kind, &format!("std::move({items})"))));
        text.close("}()");
        Code::value(text.plain().trim_end())
    }

    /// The number of items of a comprehension of literals or elements, counted without building it.
    pub fn counted(&mut self, id: TermId) -> Option<Code> {
        let Term::Comprehension { kind: CollectionKind::Seq, binders, condition, body } = self.program.term(id) else {
            return None;
        };
        let Type::List(of) = self.term_type(id) else { return None };
        let count = self.fresh("count");
        let mut text = Text::default();
        text.open(format!("{CALLED} {{"));
        text.line(format!("std::int64_t {count} = 0;"));
        self.ranging(*binders, &mut text, &mut |this, text| {
            let guard = condition.map(|condition| this.guard(condition));
            if let Some(guard) = &guard {
                text.open(format!("if ({guard}) {{"));
            }
            let item = this.item(*body, of);
            if !item.pure {
                text.line(format!("(void)({});", item.text));
            }
            text.line(format!("++{count};"));
            if guard.is_some() {
                text.close("}");
            }
        });
        text.line(format!("return {count};"));
        text.close("}()");
        Some(Code::defined(text.plain().trim_end(), Type::Integer).within(Interval::NATURAL))
    }

    /// A quantifier. If its condition has no effect, it may be evaluated in any order and more than once.
    pub fn quantified(&mut self, quantifier: Quantifier, binders: BinderList, condition: Option<TermId>) -> Code {
        if quantifier != Quantifier::ExistsUnique {
            let (code, pure) = self.quantified_over(quantifier, binders, condition, true);
            if pure {
                return code;
            }
        }
        self.quantified_over(quantifier, binders, condition, false).0
    }

    fn quantified_over(
        &mut self,
        quantifier: Quantifier,
        binders: BinderList,
        condition: Option<TermId>,
        unordered: bool,
    ) -> (Code, bool) {
        let mut pure = true;
        let mut text = Text::default();
        text.open(format!("{CALLED} {{"));
        let count = self.fresh("count");
        if quantifier == Quantifier::ExistsUnique {
            text.line(format!("int {count} = 0;"));
        }
        let outer = std::mem::replace(&mut self.unordered, unordered);
        self.ranging(binders, &mut text, &mut |this, text| {
            let around = std::mem::replace(&mut this.unordered, false);
            let guard =
                condition.map_or(Code::defined("true", Type::Boolean).pure(), |condition| this.guard_code(condition));
            this.unordered = around;
            pure &= guard.pure;
            let guard = guard.text;
            match quantifier {
                Quantifier::Forall => {
                    text.open(format!("if (!({guard})) {{"));
                    text.line("return false;");
                }
                Quantifier::Exists => {
                    text.open(format!("if ({guard}) {{"));
                    text.line("return true;");
                }
                Quantifier::ExistsUnique => {
                    text.open(format!("if (({guard}) && ++{count} > 1) {{"));
                    text.line("return false;");
                }
            }
            text.close("}");
        });
        self.unordered = outer;
        text.line(match quantifier {
            Quantifier::Forall => "return true;".to_string(),
            Quantifier::Exists => "return false;".to_string(),
            Quantifier::ExistsUnique => format!("return {count} == 1;"),
        });
        text.close("}()");
        (Code::defined(text.plain().trim_end(), Type::Boolean), pure)
    }

    /// A term as an item of a list.
    fn item(&mut self, id: TermId, of: DomainId) -> Code {
        let code = self.term(id);
        let site = self.site(id);
        let code = self.cast(code, item_type(self.program, of), site);
        if !code.defined {
            self.refuted.solid = false;
        }
        match code.ty {
            Type::Undef => Code { text: "gs::undef".to_string(), ..code },
            _ => code,
        }
    }

    /// A list of these items.
    pub fn list(&mut self, elements: TermList, id: TermId) -> Code {
        let ty = self.term_type(id);
        let Type::List(of) = ty else { return self.failing("bad_operand", id) };
        let terms = self.program.term_list(elements).to_vec();
        let items: Vec<Code> = terms.into_iter().map(|term| self.item(term, of)).collect();
        let pure = items.iter().all(|item| item.pure);
        // Braces evaluate the items in the order of the text.
        let list: Vec<&str> = items.iter().map(|item| item.text.as_str()).collect();
        let text = format!("{}::of({{{}}})", self.plan.cpp(ty, true), list.join(", "));
        Code { pure, ..Code::defined(text, ty) }
    }
}
