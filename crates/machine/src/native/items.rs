//! Collections that are looked through and never made: sets and sequences of scalars as their items, in the memory of the
//! machine that runs the code.
//!
//! In: a term that gives a set or a sequence. Out: where its items stand and how many they are ([`Items`]). They are given back
//! when the rule ends that they were gathered for; a comprehension gives those back that one binding has needed before it adds
//! the next item, so that its own stand one after the other. A collection is made of them only where somebody keeps it.

use cranelift_codegen::ir::condcodes::IntCC;
use cranelift_codegen::ir::{self, InstBuilder, types};
use program::{Binder, BinderList, Builtin, CollectionKind, DomainKind, Quantifier, Term, TermId};

use crate::native::anatomy::Anatomy;
use crate::native::binder::Between;
use crate::native::comprehension::number_of;
use crate::native::context::Offset;
use crate::native::helper;
use crate::native::shape::{Items, Kind, Operand, Scalar};
use crate::native::translate::Translator;

impl Translator<'_, '_> {
    // ---- room for items

    /// Translates a part, after which the items that it has gathered are given back.
    pub fn scoped<T>(&mut self, body: impl FnOnce(&mut Self) -> T) -> T {
        if !self.plan.gathers {
            return body(self);
        }
        let (mark, gatherers) = (self.field(Offset::item), self.gatherers);
        let result = body(self);
        self.give_back(mark, gatherers);
        result
    }

    /// Gives back the items gathered since there were `mark`, if any code since then gathers some.
    pub fn give_back(&mut self, mark: ir::Value, gatherers: usize) {
        if self.gatherers > gatherers {
            self.set_field(Offset::item, mark);
        }
    }

    /// Adds an item.
    fn push_item(&mut self, item: Operand) {
        let (tag, payload) = match item {
            Operand::Scalar(scalar) => self.words(scalar),
            _ => (self.word(0), self.word(0)),
        };
        let (count, capacity) = (self.field(Offset::item), self.field(Offset::item_capacity));
        let full = self.builder.ins().icmp(IntCC::UnsignedGreaterThanOrEqual, count, capacity);
        self.refuse(full);
        let items = self.field(Offset::items);
        let place = self.element(items, count, 4);
        self.store(tag, place, 0);
        self.store(payload, place, 8);
        let count = self.builder.ins().iadd_imm(count, 1);
        self.set_field(Offset::item, count);
        self.gatherers += 1;
    }

    /// Counts the work of looking through so many items.
    fn look_through(&mut self, count: ir::Value) {
        let work = self.builder.ins().ushr_imm(count, 3);
        self.spend(work);
    }

    /// The items gathered from the place on that `mark` tells.
    fn gathered(&mut self, mark: ir::Value, kind: CollectionKind) -> Items {
        self.gatherers += 1;
        let items = self.field(Offset::items);
        let start = self.element(items, mark, 4);
        let now = self.field(Offset::item);
        let count = self.builder.ins().isub(now, mark);
        self.look_through(count);
        if kind != CollectionKind::Set {
            return Items { start, count, kind };
        }
        let count = self.call(helper::ARRANGE, [start, count]);
        let now = self.builder.ins().iadd(mark, count);
        self.set_field(Offset::item, now);
        Items { start, count, kind }
    }

    // ---- terms

    /// The kind of a term's elements, if it is a set or a sequence of scalars.
    pub fn kind_of_items(&self, id: TermId) -> Option<(CollectionKind, Kind)> {
        match &self.program.domain(self.program.term_domain(id)).kind {
            DomainKind::Powerset(of) => Some((CollectionKind::Set, self.kind(*of)?)),
            DomainKind::Seq(of) => Some((CollectionKind::Seq, self.kind(*of)?)),
            _ => None,
        }
    }

    /// Where the items of a collection stand that a value has, or a location.
    pub fn items_of(&mut self, operand: Operand, kind: CollectionKind) -> Items {
        if let Operand::Items(items) = operand {
            return items;
        }
        let collection = self.boxed(operand);
        if let Some((anatomy, tag)) = Anatomy::of_values().and_then(|anatomy| Some((anatomy, anatomy.tag(kind)?))) {
            let found = self.load(types::I64, collection, 0);
            let fits = self.builder.ins().icmp_imm(IntCC::Equal, found, tag);
            self.require(fits);
            let shared = self.load(types::I64, collection, 8);
            let start = self.load(types::I64, shared, anatomy.start);
            let count = self.load(types::I64, shared, anatomy.count);
            return Items { start, count, kind };
        }
        let out = self.scratch(2);
        let number = self.word(number_of(kind));
        self.call_or_bail(helper::ITEMS, [collection, number, out]);
        let (start, count) = (self.load(types::I64, out, 0), self.load(types::I64, out, 8));
        Items { start, count, kind }
    }

    /// A collection of these terms, if all are scalars.
    pub fn literal(&mut self, kind: CollectionKind, elements: &[TermId]) -> Option<Operand> {
        let scalars = elements.iter().all(|element| self.kind_of(*element).is_some());
        if !matches!(kind, CollectionKind::Set | CollectionKind::Seq) || !scalars {
            return None;
        }
        let operands: Vec<Operand> = elements.iter().map(|element| self.term(*element)).collect();
        let mark = self.field(Offset::item);
        for operand in operands {
            self.push_item(operand);
        }
        Some(Operand::Items(self.gathered(mark, kind)))
    }

    /// The items of a comprehension, if they are scalars.
    pub fn gathered_comprehension(
        &mut self,
        kind: CollectionKind,
        binders: BinderList,
        condition: Option<TermId>,
        body: TermId,
    ) -> Option<Operand> {
        let program = self.program;
        if !matches!(kind, CollectionKind::Set | CollectionKind::Seq) || self.kind_of(body).is_none() {
            return None;
        }
        let (first, rest) = program.binder_list(binders).split_first()?;
        // The items of the first range stay below those that are added.
        let walk = self.walk(first.range, false);
        let mark = self.field(Offset::item);
        self.gatherers += 1;
        self.each_element(first, walk, (rest, Between::Added), &mut |this| {
            let (fits, next, done) = (this.block(), this.block(), this.block());
            let (here, gatherers) = (this.field(Offset::item), this.gatherers);
            match condition {
                Some(condition) => this.guard(condition, fits, next),
                None => this.jump(fits),
            }
            let guarded = this.gatherers;
            this.switch(fits);
            let element = this.term(body);
            this.give_back(here, gatherers);
            this.push_item(element);
            this.jump(done);
            this.switch(next);
            if guarded > gatherers {
                this.set_field(Offset::item, here);
            }
            this.jump(done);
            this.switch(done);
        });
        Some(Operand::Items(self.gathered(mark, kind)))
    }

    /// Library functions on sets and sequences of scalars, of which none is made.
    pub fn on_items(&mut self, builtin: Builtin, arguments: &[TermId]) -> Option<Operand> {
        use CollectionKind::{Seq, Set};
        let is = |this: &Self, term: TermId, wanted| this.kind_of_items(term).is_some_and(|(kind, _)| kind == wanted);
        match (builtin, arguments) {
            (Builtin::SeqConcat, [a, b]) if is(self, *a, Seq) && is(self, *b, Seq) => Some(self.joined(&[*a, *b], Seq)),
            (Builtin::SetUnion, [a, b]) if is(self, *a, Set) && is(self, *b, Set) => Some(self.joined(&[*a, *b], Set)),
            (Builtin::AsSet, [a]) if is(self, *a, Seq) => Some(self.joined(&[*a], Set)),
            (Builtin::Append, [a, b]) if is(self, *a, Seq) && self.kind_of(*b).is_some() => {
                let (items, element) = (self.gather(*a), self.term(*b));
                let mark = self.field(Offset::item);
                self.extend(items);
                self.push_item(element);
                Some(Operand::Items(self.gathered(mark, Seq)))
            }
            (Builtin::SeqLength, [a]) if is(self, *a, Seq) => Some(Operand::Scalar(self.size(*a))),
            (Builtin::SetSize, [a]) if is(self, *a, Set) => Some(Operand::Scalar(self.size(*a))),
            (Builtin::SeqIsEmpty, [a]) if is(self, *a, Seq) => Some(self.emptiness(*a, IntCC::Equal)),
            (Builtin::SetIsEmpty, [a]) if is(self, *a, Set) => Some(self.emptiness(*a, IntCC::Equal)),
            (Builtin::SetNotEmpty, [a]) if is(self, *a, Set) => Some(self.emptiness(*a, IntCC::NotEqual)),
            (Builtin::SeqIndexOf, [a, b]) if is(self, *a, Seq) && self.kind_of(*b).is_some() => {
                let (items, element) = (self.gather(*a), self.term(*b));
                let position = self.position(items, element);
                Some(Operand::Scalar(Scalar::defined(Kind::Integer, position).within(-1, i64::from(u32::MAX))))
            }
            (Builtin::SeqContains, [a, b]) if is(self, *a, Seq) && self.kind_of(*b).is_some() => {
                let (items, element) = (self.gather(*a), self.term(*b));
                let position = self.position(items, element);
                let value = self.builder.ins().icmp_imm(IntCC::SignedGreaterThanOrEqual, position, 0);
                Some(Operand::Scalar(Scalar::defined(Kind::Boolean, value)))
            }
            _ => None,
        }
    }

    /// The items of a term that gives a set or a sequence of scalars.
    fn gather(&mut self, id: TermId) -> Items {
        let kind = match &self.program.domain(self.program.term_domain(id)).kind {
            DomainKind::Powerset(_) => CollectionKind::Set,
            _ => CollectionKind::Seq,
        };
        if let Some(items) = self.items_of_location(id, kind) {
            return items;
        }
        let operand = self.term(id);
        self.items_of(operand, kind)
    }

    /// The items of a collection that a location holds, which need not be kept: none where the location always has a place, or it is
    /// not known beforehand whether it has a value.
    pub fn items_of_location(&mut self, id: TermId, kind: CollectionKind) -> Option<Items> {
        let program = self.program;
        let Term::Read { function, arguments } = program.term(id) else { return None };
        if !self.is_read_at_once(*function) {
            return None;
        }
        let arguments = self.terms(*arguments);
        let Some((index, inside)) = self.place_of(*function, &arguments) else {
            let operand = self.read(*function, &arguments, id);
            return Some(self.items_of(operand, kind));
        };
        let (start, count) = (self.variable(types::I64), self.variable(types::I64));
        let (there, elsewhere, done) = (self.block(), self.block(), self.block());
        self.builder.set_cold_block(elsewhere);
        self.branch(inside, there, elsewhere);
        self.switch(there);
        let items = self.items_of(Operand::Stored(index), kind);
        self.set(start, items.start);
        self.set(count, items.count);
        self.jump(done);
        self.switch(elsewhere);
        let operand = self.read_elsewhere(*function, &arguments, None);
        let items = self.items_of(operand, kind);
        self.set(start, items.start);
        self.set(count, items.count);
        self.jump(done);
        self.switch(done);
        Some(Items { start: self.get(start), count: self.get(count), kind })
    }

    /// Adds copies of items.
    fn extend(&mut self, items: Items) {
        self.call_or_bail(helper::EXTEND, [self.context, items.start, items.count]);
        self.gatherers += 1;
    }

    /// The items of these terms together.
    fn joined(&mut self, terms: &[TermId], kind: CollectionKind) -> Operand {
        let mark = self.field(Offset::item);
        let all: Vec<Items> = terms.iter().map(|term| self.gather(*term)).collect();
        if let ([first, second], CollectionKind::Seq) = (&all[..], kind) {
            return Operand::Items(self.concatenated(mark, *first, *second));
        }
        let mark = self.field(Offset::item);
        for items in all {
            self.extend(items);
        }
        Operand::Items(self.gathered(mark, kind))
    }

    /// One sequence behind the other. Often they stand so already: both were gathered, the second right behind the first.
    fn concatenated(&mut self, mark: ir::Value, first: Items, second: Items) -> Items {
        let (start, count) = (self.variable(types::I64), self.variable(types::I64));
        let (together, apart, done) = (self.block(), self.block(), self.block());
        let items = self.field(Offset::items);
        let bottom = self.element(items, mark, 4);
        let behind = self.element(first.start, first.count, 4);
        let begins = self.builder.ins().icmp(IntCC::Equal, first.start, bottom);
        let follows = self.builder.ins().icmp(IntCC::Equal, second.start, behind);
        let adjoin = self.builder.ins().band(begins, follows);
        self.branch(adjoin, together, apart);
        self.switch(together);
        let both = self.builder.ins().iadd(first.count, second.count);
        self.set(start, first.start);
        self.set(count, both);
        self.jump(done);
        self.switch(apart);
        let mark = self.field(Offset::item);
        self.extend(first);
        self.extend(second);
        let made = self.gathered(mark, CollectionKind::Seq);
        self.set(start, made.start);
        self.set(count, made.count);
        self.jump(done);
        self.switch(done);
        Items { start: self.get(start), count: self.get(count), kind: CollectionKind::Seq }
    }

    fn size(&mut self, id: TermId) -> Scalar {
        if let Some(count) = self.count(id) {
            return count;
        }
        let items = self.gather(id);
        Scalar::defined(Kind::Integer, items.count).within(0, i64::from(u32::MAX))
    }

    fn emptiness(&mut self, id: TermId, condition: IntCC) -> Operand {
        let count = self.size(id).value;
        let value = self.builder.ins().icmp_imm(condition, count, 0);
        Operand::Scalar(Scalar::defined(Kind::Boolean, value))
    }

    /// Where an item stands first; -1 where none is equal to it.
    fn position(&mut self, items: Items, element: Operand) -> ir::Value {
        let (tag, payload) = match element {
            Operand::Scalar(scalar) => self.words(scalar),
            _ => (self.word(0), self.word(0)),
        };
        let payload = match self.builder.func.dfg.value_type(payload) {
            types::F64 => self.builder.ins().bitcast(types::I64, ir::MemFlags::new(), payload),
            _ => payload,
        };
        self.look_through(items.count);
        self.call(helper::POSITION, [items.start, items.count, tag, payload])
    }

    /// Makes the collection of items.
    pub fn made(&mut self, items: Items) -> ir::Value {
        let kind = self.word(number_of(items.kind));
        self.call_for_value(helper::MAKE, [self.context, items.start, items.count, kind])
    }

    /// What a quantifier may range over instead of the set of a sequence's items: the sequence, where the order in which the
    /// condition is evaluated shows in nothing.
    pub fn unordered(&self, quantifier: Quantifier, binders: &[Binder], condition: Option<TermId>) -> Option<TermId> {
        let program = self.program;
        let [binder] = binders else { return None };
        let Term::Builtin { builtin: Builtin::AsSet, arguments } = program.term(binder.range) else { return None };
        let inner = program.term_list(*arguments)[0];
        let sequence = matches!(self.kind_of_items(inner), Some((CollectionKind::Seq, _)));
        let silent = condition.is_none_or(|condition| self.plan.is_silent(program, condition));
        (quantifier != Quantifier::ExistsUnique && sequence && silent).then_some(inner)
    }
}
