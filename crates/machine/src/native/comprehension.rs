//! Comprehensions: the values that a term has, collected or counted.
//!
//! In: the binders, the condition and the element of a comprehension. Out: the collection, which the running code makes of the
//! elements that it was given one by one; or their number alone, where that is all that is asked for.

use cranelift_codegen::ir::InstBuilder;
use cranelift_codegen::ir::types;
use program::{Binder, BinderList, CollectionKind, DomainKind, Term, TermId};

use crate::native::helper;
use crate::native::shape::{Kind, Operand, Scalar};
use crate::native::translate::Translator;

/// The number by which compiled code names a kind of collection.
pub(super) fn number_of(kind: CollectionKind) -> i64 {
    match kind {
        CollectionKind::Set => 0,
        CollectionKind::Seq => 1,
        CollectionKind::Bag => 2,
        CollectionKind::Map => 3,
    }
}

/// The kind of collection of such a number.
pub(super) fn kind_of(number: i64) -> CollectionKind {
    let kinds = [CollectionKind::Set, CollectionKind::Seq, CollectionKind::Bag, CollectionKind::Map];
    kinds[number as usize]
}

impl Translator<'_, '_> {
    /// The collection of a comprehension.
    pub fn comprehension(
        &mut self,
        kind: CollectionKind,
        binders: BinderList,
        condition: Option<TermId>,
        body: TermId,
    ) -> Operand {
        if let Some(items) = self.gathered_comprehension(kind, binders, condition, body) {
            return items;
        }
        let program = self.program;
        self.call(helper::COLLECT, [self.context]);
        self.each_fitting(program.binder_list(binders), condition, &mut |this| {
            let element = this.term(body);
            let element = this.boxed(element);
            this.call_or_bail(helper::ADD, [this.context, element]);
        });
        let kind = self.word(number_of(kind));
        Operand::Boxed(self.call_for_value(helper::COLLECTED, [self.context, kind]))
    }

    /// Translates `body` for each binding that a condition holds of.
    fn each_fitting(&mut self, binders: &[Binder], condition: Option<TermId>, body: &mut dyn FnMut(&mut Self)) {
        self.each_binding(binders, &mut |this| {
            let (fits, next) = (this.block(), this.block());
            match condition {
                Some(condition) => this.guard(condition, fits, next),
                None => this.jump(fits),
            }
            this.switch(fits);
            body(this);
            this.jump(next);
            this.switch(next);
        });
    }

    /// The size of a set given by a comprehension, where no two bindings give the same element: counted.
    pub fn count(&mut self, id: TermId) -> Option<Scalar> {
        let program = self.program;
        let Term::Comprehension { kind, binders, condition, body } = program.term(id) else { return None };
        let binders = program.binder_list(*binders);
        let distinct = match program.term(*body) {
            Term::Slot(slot) => binders.len() == 1 && binders[0].slot == *slot,
            Term::Tuple(parts) => {
                let parts = program.term_list(*parts);
                binders.iter().all(|binder| {
                    parts.iter().any(|part| matches!(program.term(*part), Term::Slot(slot) if *slot == binder.slot))
                })
            }
            _ => false,
        };
        let elements = |binder: &Binder| match program.term(binder.range) {
            Term::Domain(_) => true,
            _ => matches!(program.domain(program.term_domain(binder.range)).kind, DomainKind::Powerset(_)),
        };
        let counts = *kind == CollectionKind::Seq || (distinct && binders.iter().all(elements));
        // Evaluating the element must be needless: variables alone.
        let bare = match program.term(*body) {
            Term::Slot(_) => true,
            Term::Tuple(parts) => {
                program.term_list(*parts).iter().all(|part| matches!(program.term(*part), Term::Slot(_)))
            }
            _ => false,
        };
        if !counts || !bare {
            return None;
        }
        let count = self.variable(types::I64);
        let zero = self.word(0);
        self.set(count, zero);
        self.each_fitting(binders, *condition, &mut |this| {
            let before = this.get(count);
            let after = this.builder.ins().iadd_imm(before, 1);
            this.set(count, after);
        });
        let value = self.get(count);
        Some(Scalar::defined(Kind::Integer, value).within(0, i64::from(u32::MAX)))
    }
}
