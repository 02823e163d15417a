//! The names visible in a file: its own and those that its imports bring.
//!
//! In: declarations and the names exported by imported files. Out: name → domain, enum literal, functions (all
//! overloads), rules (all overloads). INVARIANT: overloads are in the order of declaration, imported ones first; of
//! two functions with the same name and parameters, the first one counts.

use std::borrow::Cow;
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use crate::declaration::Function;
use crate::id::DomainId;
use crate::id::{FunctionId, RuleId};

/// What the names of a file mean. Imported names are those of the file that declares them, not copies of their texts.
#[derive(Debug, Clone, Default)]
pub struct Names {
    pub(crate) domains: BTreeMap<Arc<str>, DomainId>,
    pub(crate) literals: BTreeMap<Arc<str>, (DomainId, u32)>,
    pub(crate) functions: BTreeMap<Arc<str>, Arc<Vec<FunctionId>>>,
    pub(crate) rules: BTreeMap<Arc<str>, Arc<Vec<RuleId>>>,
    /// A reported fault may have hidden names (an import that failed, a broken signature), so a name that is not
    /// here is no fault of its own.
    pub(crate) incomplete: bool,
    /// Whether it is a text beside the model that sees them, such as a scenario or a property; it declares nothing.
    pub(crate) beside: bool,
}

/// Which names an import brings: all, or those listed.
pub(crate) enum Selection {
    /// All that are exported.
    All,
    /// Only these.
    Only(BTreeSet<String>),
}

impl Selection {
    fn has(&self, name: &str) -> bool {
        match self {
            Selection::All => true,
            Selection::Only(names) => names.contains(name),
        }
    }
}

impl Names {
    /// The domain of that name.
    pub fn domain(&self, name: &str) -> Option<DomainId> {
        self.domains.get(name).copied()
    }

    /// The enum literal of that name: its domain and its place in it.
    pub fn literal(&self, name: &str) -> Option<(DomainId, u32)> {
        self.literals.get(name).copied()
    }

    /// All functions of that name.
    pub fn functions(&self, name: &str) -> &[FunctionId] {
        self.functions.get(name).map_or(&[], |ids| ids.as_slice())
    }

    /// All rules of that name.
    pub fn rules(&self, name: &str) -> &[RuleId] {
        self.rules.get(name).map_or(&[], |ids| ids.as_slice())
    }

    /// All domains by name.
    pub fn all_domains(&self) -> impl Iterator<Item = (&str, DomainId)> {
        self.domains.iter().map(|(name, id)| (&**name, *id))
    }

    /// All enum literals by name.
    pub fn all_literals(&self) -> impl Iterator<Item = (&str, DomainId)> {
        self.literals.iter().map(|(name, (id, _))| (&**name, *id))
    }

    /// All functions by name, the overloads of one after the other.
    pub fn all_functions(&self) -> impl Iterator<Item = (&str, FunctionId)> {
        self.functions.iter().flat_map(|(name, ids)| ids.iter().map(move |id| (&**name, *id)))
    }

    /// All rules by name, the overloads of one after the other.
    pub fn all_rules(&self) -> impl Iterator<Item = (&str, RuleId)> {
        self.rules.iter().flat_map(|(name, ids)| ids.iter().map(move |id| (&**name, *id)))
    }

    /// Whether a function of that name is this one.
    pub fn sees(&self, name: &str, function: FunctionId) -> bool {
        self.functions.get(name).is_some_and(|ids| ids.contains(&function))
    }

    /// A reported fault may have hidden names, so a name that is not here may be there all the same.
    pub fn is_incomplete(&self) -> bool {
        self.incomplete
    }

    /// Something has that name.
    pub(crate) fn has(&self, name: &str) -> bool {
        self.domains.contains_key(name) || self.functions.contains_key(name) || self.rules.contains_key(name)
    }

    /// Only the selected names, and the literals of the enum domains among them.
    pub(crate) fn select(&self, selection: &Selection) -> Cow<'_, Names> {
        let Selection::Only(_) = selection else { return Cow::Borrowed(self) };
        let domains = keep(&self.domains, selection);
        let of_kept = |literal: &(DomainId, u32)| domains.values().any(|domain| *domain == literal.0);
        let literals = self.literals.iter().filter(|(_, literal)| of_kept(literal));
        Cow::Owned(Names {
            literals: literals.map(|(name, literal)| (Arc::clone(name), *literal)).collect(),
            domains,
            functions: keep(&self.functions, selection),
            rules: keep(&self.rules, selection),
            incomplete: self.incomplete,
            beside: false,
        })
    }

    fn is_empty(&self) -> bool {
        let Names { domains, literals, functions, rules, incomplete: _, beside: _ } = self;
        domains.is_empty() && literals.is_empty() && functions.is_empty() && rules.is_empty()
    }

    /// Adds what an import brings. `table` is the model's functions.
    pub(crate) fn import(&mut self, other: &Names, table: &[Function]) {
        self.incomplete |= other.incomplete;
        if self.is_empty() {
            *self = Names { incomplete: self.incomplete, ..other.clone() };
            return;
        }
        for (name, domain) in &other.domains {
            self.domains.entry(Arc::clone(name)).or_insert(*domain);
        }
        for (name, literal) in &other.literals {
            self.literals.entry(Arc::clone(name)).or_insert(*literal);
        }
        for (name, functions) in &other.functions {
            let Some(known) = self.functions.get_mut(name) else {
                self.functions.insert(Arc::clone(name), Arc::clone(functions));
                continue;
            };
            for id in functions.iter() {
                let parameters = &table[id.0 as usize].parameters;
                if !known.iter().any(|other| table[other.0 as usize].parameters == *parameters) {
                    Arc::make_mut(known).push(*id);
                }
            }
        }
        for (name, rules) in &other.rules {
            let Some(known) = self.rules.get_mut(name) else {
                self.rules.insert(Arc::clone(name), Arc::clone(rules));
                continue;
            };
            let more: Vec<RuleId> = rules.iter().filter(|id| !known.contains(id)).copied().collect();
            if !more.is_empty() {
                Arc::make_mut(known).extend(more);
            }
        }
    }
}

fn keep<V: Clone>(table: &BTreeMap<Arc<str>, V>, selection: &Selection) -> BTreeMap<Arc<str>, V> {
    table
        .iter()
        .filter(|(name, _)| selection.has(name))
        .map(|(name, value)| (Arc::clone(name), value.clone()))
        .collect()
}
