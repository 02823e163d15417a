//! Checks a whole model: texts in, checked model out.
//!
//! In: the root file and a [`Loader`]. Out: [`Checked`]. Files are checked in the order of imports, so whatever a
//! file needs from another is known. Within a file, everything is declared before bodies are checked.

pub(crate) mod body;

mod apply;
mod call;
mod collection;
mod definition;
mod init;
mod literal;
pub(crate) mod local_state;
mod property;
mod rule;
mod term;
mod update;

use std::collections::BTreeSet;
use std::sync::Arc;

use syntax::ast::{self, AstNode};
use syntax::{FileId, SourceFile, Sources, Span, Stop};

use crate::declaration::FunctionKind;
use crate::domain::{DomainKind, Domains};
use crate::fault::{self, Faults};
use crate::id::{RuleId, VariableId};
use crate::imports::{self, Import, Unit};
use crate::library;
use crate::model::{Checked, Loader, Model};
use crate::names::{Names, Selection};
use crate::site::{Site, kind_word};
use crate::suggest::nearest;
use crate::{declare, endless, macros, unstarted};
use body::{Body, Bound};
use definition::Defined;
use local_state::{UpdatedParameters, Writes};

/// Checks a model: reads its imports, resolves every name, finds the domain of every term.
///
/// Never fails and never panics: what could not be understood is in `diagnostics`, and everything else is checked
/// all the same, so one run shows all faults.
///
/// ```
/// use model::{Loader, check};
/// use syntax::SourceFile;
///
/// struct NoFiles;
/// impl Loader for NoFiles {
///     fn load(&mut self, _: &SourceFile, _: &str) -> Result<SourceFile, String> {
///         Err("there is no such file".to_string())
///     }
/// }
///
/// let text = "asm count
///     import StandardLibrary
///     signature:
///         controlled n: Integer
///     definitions:
///         main rule r_Main = n := n + 1";
/// let checked = check(SourceFile::new("count.asm", text), &mut NoFiles);
/// assert!(checked.diagnostics.is_empty());
/// assert!(checked.model.dump().contains("n := plus(n, 1)"));
/// ```
pub fn check(root: SourceFile, loader: &mut dyn Loader) -> Checked {
    let mut sources = Sources::default();
    let mut faults = Faults::default();
    let units = imports::read(root, loader, &mut sources, &mut faults);
    let stop = loader.stop();
    let mut checker = Checker {
        stop: &stop,
        sources: &sources,
        units: &units,
        model: Model::empty(FileId(0)),
        faults,
        exported: Vec::new(),
        defined: Defined::default(),
        updated: UpdatedParameters::new(),
    };
    for index in 0..units.len() {
        if stop.is_asked() {
            break;
        }
        checker.unit(index);
    }
    let Checker { model, mut faults, .. } = checker;
    if stop.is_asked() {
        return Checked { diagnostics: faults.into_sorted(), model, sources };
    }
    macros::check(&model, &mut faults);
    if !faults.has_errors() {
        endless::check(&model, &mut faults);
        unstarted::check(&model, &mut faults);
        report_undefined(&model, &mut faults);
        report_without_contents(&model, &mut faults);
    }
    Checked { diagnostics: faults.into_sorted(), model, sources }
}

fn name_of(unit: &Unit) -> String {
    let name = unit.tree.machine_name().and_then(|name| name.name());
    name.map(|token| token.text().to_string()).unwrap_or_default()
}

struct Checker<'a> {
    /// Looked at before each file and each declaration.
    stop: &'a Stop,
    sources: &'a Sources,
    units: &'a [Unit],
    model: Model,
    faults: Faults,
    /// What each checked unit exports; none without an export clause.
    exported: Vec<Option<Arc<Names>>>,
    defined: Defined,
    /// Parameters of macro rules that are locations.
    updated: UpdatedParameters,
}

impl Checker<'_> {
    fn site<'s>(&'s mut self, names: &'s Names, file: FileId) -> Site<'s> {
        Site { model: &mut self.model, names, faults: &mut self.faults, file }
    }

    fn unit(&mut self, index: usize) {
        let unit = &self.units[index];
        self.report_file_name(unit);
        let imported = self.imported(unit);
        let (names, rules) = declare::declare(unit, imported, &mut self.model, &mut self.faults);
        let names = Arc::new(names);
        let exported = self.exported_by(unit, &names);
        self.exported.push(exported);
        self.definitions(unit, &names, &rules);
        let (inits, default_init) = init::inits(&mut self.site(&names, unit.file), &unit.tree);
        self.model.modules.insert(unit.file, name_of(unit));
        if index + 1 == self.units.len() {
            self.root(unit, inits, default_init, names, &rules);
        }
    }

    fn root(
        &mut self,
        unit: &Unit,
        inits: Vec<crate::model::Init>,
        default_init: Option<usize>,
        names: Arc<Names>,
        rules: &[(ast::RuleDecl, RuleId)],
    ) {
        let model = &mut self.model;
        model.root = unit.file;
        model.asynchronous = unit.tree.is_asynchronous();
        model.name = name_of(unit);
        model.inits = inits;
        model.default_init = default_init;
        model.names = Arc::unwrap_or_clone(names);
        let main = unit.tree.main_rule().and_then(|main| main.rule());
        model.main = main.and_then(|main| rules.iter().find(|(decl, _)| *decl == main)).map(|(_, id)| *id);
        if let Some(id) = model.main {
            let main = model.rule(id);
            if !main.parameters.is_empty() {
                self.faults.push(fault::rule::main_with_parameters(main.span, &main.name));
            }
        }
    }

    fn report_file_name(&mut self, unit: &Unit) {
        let source = self.sources.file(unit.file);
        let Some(machine) = unit.tree.machine_name() else { return };
        let Some(token) = machine.name() else { return };
        let stem = library::stem(&source.name);
        if token.text() != stem && !source.name.starts_with('<') {
            let span = Span::new(unit.file, token.text_range());
            let word = if machine.is_module() { "module" } else { "asm" };
            self.faults.push(fault::import::file_name(span, token.text(), stem, word));
        }
    }

    /// The names that a unit's imports bring.
    fn imported(&mut self, unit: &Unit) -> Names {
        let mut names = Names { incomplete: unit.broken, ..Names::default() };
        for import in &unit.imports {
            let Some(target) = import.target else {
                names.incomplete = true;
                continue;
            };
            let selection = self.selection(unit, import, target);
            match &self.exported[target] {
                Some(exported) => names.import(&exported.select(&selection), &self.model.functions),
                None => self.report_without_export(unit, import),
            }
        }
        names
    }

    fn report_without_export(&mut self, unit: &Unit, import: &Import) {
        if let (Some(token), Some(path)) = (import.clause.path_token(), import.clause.path()) {
            let span = Span::new(unit.file, token.text_range());
            self.faults.push(fault::import::without_export(span, &path));
        }
    }

    fn selection(&mut self, unit: &Unit, import: &Import, target: usize) -> Selection {
        let Some(written) = import.clause.selection() else { return Selection::All };
        let path = import.clause.path().unwrap_or_default();
        let mut selected = BTreeSet::new();
        for token in written.names().filter_map(|name| name.token()) {
            let name = token.text();
            if let Some(exported) = &self.exported[target]
                && !exported.has(name)
                && !exported.incomplete
            {
                let all = exported.functions.keys().chain(exported.domains.keys()).chain(exported.rules.keys());
                let suggestion = nearest(name, all.map(|name| &**name));
                let span = Span::new(unit.file, token.text_range());
                self.faults.push(fault::import::not_exported(span, name, &path, suggestion));
            }
            selected.insert(name.to_string());
            if let Some(exported) = &self.exported[target] {
                self.model.uses.add_all(Span::new(unit.file, token.text_range()), name, exported);
            }
        }
        Selection::Only(selected)
    }

    fn exported_by(&mut self, unit: &Unit, names: &Arc<Names>) -> Option<Arc<Names>> {
        let export = unit.tree.export()?;
        if export.is_all() {
            return Some(Arc::clone(names));
        }
        let mut selected = BTreeSet::new();
        for token in export.names().filter_map(|name| name.token()) {
            let name = token.text();
            if !names.has(name) && !names.incomplete {
                let all = names.functions.keys().chain(names.domains.keys()).chain(names.rules.keys());
                let help = crate::suggest::did_you_mean(name, all.map(|name| &**name), || {
                    "declare it, or remove it from the list".to_string()
                });
                let span = Span::new(unit.file, token.text_range());
                self.faults.push(fault::import::unknown_name(span, name, help));
            }
            selected.insert(name.to_string());
            self.model.uses.add_all(Span::new(unit.file, token.text_range()), name, names);
        }
        Some(Arc::new(names.select(&Selection::Only(selected)).into_owned()))
    }

    fn definitions(&mut self, unit: &Unit, names: &Names, rules: &[(ast::RuleDecl, RuleId)]) {
        let definitions = unit.tree.definitions();
        let stop = self.stop;
        for def in definitions.iter().flat_map(|definitions| definitions.domain_defs()) {
            let mut defined = std::mem::take(&mut self.defined);
            definition::domain(self.site(names, unit.file), &def, &mut defined);
            self.defined = defined;
        }
        for def in
            definitions.iter().flat_map(|definitions| definitions.function_defs()).take_while(|_| !stop.is_asked())
        {
            let mut defined = std::mem::take(&mut self.defined);
            definition::function(self.site(names, unit.file), &def, &mut defined);
            self.defined = defined;
        }
        let writes: Vec<Writes> =
            rules.iter().map(|(decl, _)| decl.body().map(|body| Writes::of(&body)).unwrap_or_default()).collect();
        let written = rules.iter().map(|(decl, _)| decl).zip(&writes);
        local_state::add_updated_parameters(written, &mut self.updated);
        for ((decl, id), writes) in rules.iter().zip(&writes) {
            if stop.is_asked() {
                return;
            }
            self.rule(unit, names, decl, *id, writes);
        }
        let sources = self.sources;
        for written in definitions.iter().flat_map(|definitions| definitions.properties()) {
            property::property(self.site(names, unit.file), &written, sources);
        }
    }

    fn rule(&mut self, unit: &Unit, names: &Names, decl: &ast::RuleDecl, id: RuleId, writes: &Writes) {
        let rule = self.model.rule(id);
        let (parameters, result, place) = (rule.variables.clone(), rule.result, Span::new(unit.file, decl.range()));
        let bound = if rule.turbo { Bound::Parameter } else { Bound::MacroParameter };
        let updated = writes.updated(&self.updated);
        let mut body = Body::new(self.site(names, unit.file), &parameters, bound);
        body.result = result;
        body.updated = updated;
        let by_value: Vec<VariableId> = match bound {
            Bound::Parameter => (0..parameters.len() as u32).map(VariableId).collect(),
            _ => Vec::new(),
        };
        let checked = body.with_local_state(&by_value, decl.body(), place);
        let variables = body.variables;
        let rule = &mut self.model.rules[id.0 as usize];
        rule.body = checked;
        rule.variables = variables;
    }
}

/// Warns of static and derived functions without a meaning.
fn report_undefined(model: &Model, faults: &mut Faults) {
    for function in &model.functions {
        let defined = function.library || function.definition.is_some();
        if defined || !matches!(function.kind, FunctionKind::Static | FunctionKind::Derived) {
            continue;
        }
        let domains = &model.domains;
        let element = function.parameters.is_empty()
            && function.kind == FunctionKind::Static
            && matches!(
                domains.kind(domains.type_domain(function.codomain)),
                DomainKind::Abstract { .. } | DomainKind::Error
            );
        if !element && function.codomain != Domains::ERROR {
            faults.push(fault::function::undefined(function.span, &function.name, kind_word(function.kind)));
        }
    }
}

/// Warns of static subsets without contents. The elements of a subset of an abstract domain may be declared elsewhere.
fn report_without_contents(model: &Model, faults: &mut Faults) {
    for (_, domain) in model.domains.iter() {
        let DomainKind::Concrete { base, dynamic: false, definition: None } = &domain.kind else { continue };
        let declared = matches!(model.domains.kind(*base), DomainKind::Abstract { .. } | DomainKind::Error);
        if let (false, Some(name), Some(span)) = (declared, &domain.name, domain.span) {
            faults.push(fault::domain::without_contents(span, name, &model.domains.display(*base)));
        }
    }
}
