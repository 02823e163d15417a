//! Ranging over domains and collections: the counterpart of [`crate::enumerate`].
//!
//! Domains whose elements are consecutive numbers become counting loops; other static ones walk an array that
//! belongs to the compiled code, collections one that belongs to their value.

use cranelift_codegen::ir::condcodes::IntCC;
use cranelift_codegen::ir::{self, InstBuilder, types};
use program::{Binder, CollectionKind, DomainId, DomainKind, Term, TermId};

use crate::native::context::Offset;
use crate::native::helper;
use crate::native::shape::{Bound, Items, Kind, Operand, Scalar};
use crate::native::translate::Translator;

/// What a loop walks.
#[derive(Clone, Copy)]
pub(super) enum Walk {
    /// Numbers `low..=high` of a kind.
    Numbers(Kind, i64, i64),
    /// `count` integers from `low` on, which lie within bounds where these are known.
    Span { low: ir::Value, count: ir::Value, range: Option<(i64, i64)> },
    /// `count` values from an address on, none of them undef if they are `solid`.
    Values { start: ir::Value, count: ir::Value, kind: Option<Kind>, solid: bool },
}

/// What becomes of the items ([`crate::native::items`]) that a round of a loop has gathered.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Between {
    /// They are given back.
    GivenBack,
    /// They are given back, and rules run that may overwrite a location whose value is walked.
    Overwritten,
    /// They are those of a comprehension: nothing else may stand between them.
    Added,
}

impl Translator<'_, '_> {
    /// Translates `body` for each binding; it may jump out of the loops.
    pub fn each_binding(&mut self, binders: &[Binder], body: &mut dyn FnMut(&mut Self)) {
        self.each_of(binders, Between::GivenBack, body);
    }

    /// The same for a `forall` rule.
    pub fn each_run(&mut self, binders: &[Binder], body: &mut dyn FnMut(&mut Self)) {
        self.each_of(binders, Between::Overwritten, body);
    }

    fn each_of(&mut self, binders: &[Binder], between: Between, body: &mut dyn FnMut(&mut Self)) {
        let Some((binder, rest)) = binders.split_first() else { return body(self) };
        let walk = match between {
            Between::GivenBack => self.walk(binder.range, false),
            Between::Overwritten => self.walk(binder.range, true),
            Between::Added => self.walk_made(binder.range),
        };
        self.each_element(binder, walk, (rest, between), body);
    }

    /// Translates `body` for each binding, the first binder's range given.
    pub fn each_element(
        &mut self,
        binder: &Binder,
        walk: Walk,
        (rest, between): (&[Binder], Between),
        body: &mut dyn FnMut(&mut Self),
    ) {
        let around = self.count_rounds(&walk);
        let index = self.variable(types::I64);
        let (head, inner, done) = (self.block(), self.block(), self.block());
        let first = match walk {
            Walk::Numbers(_, low, _) => self.word(low),
            Walk::Span { .. } | Walk::Values { .. } => self.word(0),
        };
        self.set(index, first);
        self.jump(head);
        self.switch(head);
        let now = self.get(index);
        let more = match walk {
            Walk::Numbers(_, _, high) => self.builder.ins().icmp_imm(IntCC::SignedLessThanOrEqual, now, high),
            Walk::Span { count, .. } | Walk::Values { count, .. } => {
                self.builder.ins().icmp(IntCC::UnsignedLessThan, now, count)
            }
        };
        self.branch(more, inner, done);
        self.switch(inner);
        let bound = match walk {
            Walk::Numbers(kind, low, high) => {
                let value = if kind == Kind::Boolean { self.builder.ins().ireduce(types::I8, now) } else { now };
                Bound::Scalar(Scalar::defined(kind, value).within(low, high))
            }
            Walk::Span { low, range, .. } => {
                let value = self.builder.ins().iadd(low, now);
                Bound::Scalar(Scalar { range, ..Scalar::defined(Kind::Integer, value) })
            }
            Walk::Values { start, kind, solid, .. } => {
                let place = self.element(start, now, 4);
                match (kind, solid) {
                    (Some(kind), true) => Bound::Scalar(self.unboxed_defined(place, kind)),
                    (Some(kind), false) => Bound::Scalar(self.unboxed(place, kind)),
                    (None, _) => Bound::Boxed(place),
                }
            }
        };
        self.bind(binder.slot, bound);
        self.statement(|this| match between {
            Between::GivenBack | Between::Overwritten => this.scoped(|this| this.each_of(rest, between, body)),
            Between::Added => this.each_of(rest, between, body),
        });
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
            Walk::Span { count, .. } | Walk::Values { count, .. } => {
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

    /// What a range's loop walks. A collection that a location may lose in the meantime is kept.
    pub fn walk(&mut self, range: TermId, overwritten: bool) -> Walk {
        let program = self.program;
        if let Term::Domain(domain) = program.term(range) {
            return match self.numbers_of(range) {
                Some((kind, low, high)) => Walk::Numbers(kind, low, high),
                None => self.walk_domain(*domain),
            };
        }
        if let Some(walk) = self.walk_span(range) {
            return walk;
        }
        let (collection, kind) = match &program.domain(program.term_domain(range)).kind {
            DomainKind::Powerset(of) => (Some(CollectionKind::Set), self.kind(*of)),
            DomainKind::Seq(of) => (Some(CollectionKind::Seq), self.kind(*of)),
            DomainKind::Bag(of) => (None, self.kind(*of)),
            _ => (None, None),
        };
        let solid = kind.is_some() && self.certain(range).solid;
        if let (Some(of), false) = (collection, overwritten)
            && let Some(Items { start, count, .. }) = self.items_of_location(range, of)
        {
            return Walk::Values { start, count, kind, solid };
        }
        match self.term(range) {
            Operand::Items(Items { start, count, .. }) => Walk::Values { start, count, kind, solid },
            operand => {
                let pointer = if overwritten { self.pinned(operand) } else { self.boxed(operand) };
                match collection {
                    Some(of) => {
                        let Items { start, count, .. } = self.items_of(Operand::Boxed(pointer), of);
                        Walk::Values { start, count, kind, solid }
                    }
                    None => self.walk_collection(pointer, kind),
                }
            }
        }
    }

    /// The same, after which no items stand above those that were gathered before.
    fn walk_made(&mut self, range: TermId) -> Walk {
        let (mark, gatherers) = (self.field(Offset::item), self.gatherers);
        match self.walk(range, false) {
            Walk::Values { start, count, kind, solid } if self.gatherers > gatherers => {
                // What a round of an outer loop walks is its own.
                let items = Items { start, count, kind: CollectionKind::Seq };
                let collection = self.made(items);
                self.set_field(Offset::item, mark);
                let Items { start, count, .. } = self.items_of(Operand::Boxed(collection), CollectionKind::Seq);
                Walk::Values { start, count, kind, solid }
            }
            walk => {
                self.give_back(mark, gatherers);
                walk
            }
        }
    }

    /// `{low : high}` of integers, which is not made.
    fn walk_span(&mut self, range: TermId) -> Option<Walk> {
        let Term::Range { kind, low, high, step: None } = self.program.term(range) else { return None };
        let integers = [low, high].iter().all(|bound| self.kind_of(**bound) == Some(Kind::Integer));
        if !integers || !matches!(kind, CollectionKind::Set | CollectionKind::Seq) {
            return None;
        }
        let [low, high] = [*low, *high].map(|bound| {
            let operand = self.term(bound);
            let scalar = self.scalar(operand, Kind::Integer);
            self.defined(scalar)
        });
        let range = low.range.zip(high.range).map(|((least, _), (_, most))| (least, most.max(least)));
        let (width, over) = self.builder.ins().ssub_overflow(high.value, low.value);
        self.refuse(over);
        let count = self.builder.ins().iadd_imm(width, 1);
        let none = self.word(0);
        let empty = self.builder.ins().icmp_imm(IntCC::SignedLessThan, width, 0);
        let count = self.builder.ins().select(empty, none, count);
        // The interpreter makes the collection, or says that it is too large.
        let most = self.field(Offset::most);
        let large = self.builder.ins().icmp(IntCC::UnsignedGreaterThan, count, most);
        self.refuse(large);
        Some(Walk::Span { low: low.value, count, range })
    }

    fn walk_collection(&mut self, collection: ir::Value, kind: Option<Kind>) -> Walk {
        let out = self.scratch(2);
        self.note_kept();
        self.call_or_bail(helper::RANGE, [self.context, collection, out]);
        let (start, count) = (self.load(types::I64, out, 0), self.load(types::I64, out, 8));
        Walk::Values { start, count, kind, solid: false }
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
            // The elements of a domain are values.
            return Walk::Values { start, count, kind, solid: true };
        }
        let id = self.word(i64::from(domain.0));
        let elements = self.call_for_value(helper::ELEMENTS, [self.context, id]);
        let kind = self.kind(domain);
        self.walk_collection(elements, kind)
    }
}
