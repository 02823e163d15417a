//! Ranging over domains and collections: the counterpart of [`crate::enumerate`].
//!
//! Domains whose elements are consecutive numbers become counting loops; other static ones walk an array that
//! belongs to the compiled code, collections one that belongs to their value.

use cranelift_codegen::ir::condcodes::IntCC;
use cranelift_codegen::ir::{self, InstBuilder, StackSlotData, StackSlotKind, types};
use program::{Binder, DomainId, DomainKind, Term, TermId};

use crate::native::helper;
use crate::native::shape::{Bound, Kind, Scalar};
use crate::native::translate::Translator;

/// What a loop walks.
enum Walk {
    /// Numbers `low..=high` of a kind.
    Numbers(Kind, i64, i64),
    /// `count` values from an address on.
    Values { start: ir::Value, count: ir::Value, kind: Option<Kind> },
}

impl Translator<'_, '_> {
    /// Translates `body` for each binding; it may jump out of the loops.
    pub fn each_binding(&mut self, binders: &[Binder], body: &mut dyn FnMut(&mut Self)) {
        let Some((binder, rest)) = binders.split_first() else { return body(self) };
        let walk = self.walk(binder.range);
        let around = self.count_rounds(&walk);
        let index = self.variable(types::I64);
        let (head, inner, done) = (self.block(), self.block(), self.block());
        let first = match walk {
            Walk::Numbers(_, low, _) => self.word(low),
            Walk::Values { .. } => self.word(0),
        };
        self.set(index, first);
        self.jump(head);
        self.switch(head);
        let now = self.get(index);
        let more = match walk {
            Walk::Numbers(_, _, high) => self.builder.ins().icmp_imm(IntCC::SignedLessThanOrEqual, now, high),
            Walk::Values { count, .. } => self.builder.ins().icmp(IntCC::UnsignedLessThan, now, count),
        };
        self.branch(more, inner, done);
        self.switch(inner);
        let bound = match walk {
            Walk::Numbers(kind, low, high) => {
                let value = if kind == Kind::Boolean { self.builder.ins().ireduce(types::I8, now) } else { now };
                Bound::Scalar(Scalar::defined(kind, value).within(low, high))
            }
            Walk::Values { start, kind, .. } => {
                let place = self.element(start, now, 4);
                match kind {
                    Some(kind) => Bound::Scalar(self.unboxed(place, kind)),
                    None => Bound::Boxed(place),
                }
            }
        };
        self.bind(binder.slot, bound);
        self.statement(|this| this.each_binding(rest, body));
        let now = self.get(index);
        let next = self.builder.ins().iadd_imm(now, 1);
        self.set(index, next);
        self.jump(head);
        self.switch(done);
        self.rounds = around;
    }

    /// Counts the rounds of a loop that begins, all at once. Outer loops that together have a few rounds are not counted: how
    /// often the body they stand in runs is. Gives the rounds before.
    fn count_rounds(&mut self, walk: &Walk) -> i64 {
        /// LIMIT: so many rounds of a body pass uncounted.
        const UNCOUNTED: i64 = 64;
        let around = self.rounds;
        let all = match *walk {
            Walk::Numbers(_, low, high) => {
                let all = high.saturating_sub(low).saturating_add(1).max(0);
                self.rounds = around.saturating_mul(all.max(1));
                self.word(all)
            }
            Walk::Values { count, .. } => {
                self.rounds = i64::MAX;
                count
            }
        };
        if self.rounds > UNCOUNTED {
            // From here inwards every loop is.
            self.rounds = i64::MAX;
            self.spend(all);
        }
        around
    }

    fn walk(&mut self, range: TermId) -> Walk {
        let program = self.program;
        if let Term::Domain(domain) = program.term(range) {
            return match self.numbers_of(range) {
                Some((kind, low, high)) => Walk::Numbers(kind, low, high),
                None => self.walk_domain(*domain),
            };
        }
        let kind = match &program.domain(program.term_domain(range)).kind {
            DomainKind::Powerset(of) | DomainKind::Seq(of) | DomainKind::Bag(of) => self.kind(*of),
            _ => None,
        };
        let operand = self.term(range);
        let collection = self.pinned(operand);
        self.walk_collection(collection, kind)
    }

    fn walk_collection(&mut self, collection: ir::Value, kind: Option<Kind>) -> Walk {
        let slot = self.builder.create_sized_stack_slot(StackSlotData::new(StackSlotKind::ExplicitSlot, 16, 3));
        let out = self.builder.ins().stack_addr(types::I64, slot, 0);
        self.note_kept();
        self.call_or_bail(helper::RANGE, [self.context, collection, out]);
        let (start, count) = (self.load(types::I64, out, 0), self.load(types::I64, out, 8));
        Walk::Values { start, count, kind }
    }

    /// The kind and the bounds of a range that is a domain of consecutive numbers.
    pub fn numbers_of(&self, range: TermId) -> Option<(Kind, i64, i64)> {
        let Term::Domain(domain) = self.program.term(range) else { return None };
        match &self.program.domain(*domain).kind {
            DomainKind::Basic(model::Basic::Boolean) => Some((Kind::Boolean, 0, 1)),
            DomainKind::Enum { literals } => Some((Kind::Enum(*domain), 0, literals.len() as i64 - 1)),
            _ => {
                let (low, high) = self.plan.numbers(self.program, *domain)?;
                Some((self.kind(*domain)?, low, high))
            }
        }
    }

    fn walk_domain(&mut self, domain: DomainId) -> Walk {
        if let Some(elements) = self.plan.facts.contents[domain.0 as usize].clone() {
            let (start, count) = (self.address(elements.as_ptr()), self.word(elements.len() as i64));
            let kind = self.kind(domain);
            self.plan.pin(elements);
            return Walk::Values { start, count, kind };
        }
        let id = self.word(i64::from(domain.0));
        let elements = self.call_for_value(helper::ELEMENTS, [self.context, id]);
        let kind = self.kind(domain);
        self.walk_collection(elements, kind)
    }
}
