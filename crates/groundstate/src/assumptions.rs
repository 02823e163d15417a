//! What is assumed of a machine that is refined: what `MODEL.verify.yaml` beside its model says of inputs and states, and `--assume`.
//!
//! In: a model, what the file says, terms. Out: the model with the assumptions as `INVAR`s, and the values of its inputs. INVARIANT: they
//! mean what they mean for `verify`; properties, `terminal` and `fair` of the file say nothing about a refinement, and are left alone.

use std::collections::{BTreeMap, BTreeSet};

use explore::assumed_bounds;
use inputs::bound;
use inputs::verification::{self, Verification};
use machine::Bounds;
use model::PropertyKind;
use program::FunctionId;
use refine::{CONCRETE, Extent, SIDES};
use syntax::{Diagnostic, SourceFile, Sources};

use crate::{Loaded, Overlay, Said};

/// What the option for terms is called in messages.
pub const OPTION: &str = "--assume";

/// A machine with its assumptions.
#[derive(Debug, Clone)]
pub struct Assumptions {
    /// The model; its program has the assumed terms as `INVAR`s.
    pub model: Loaded,
    /// The values of inputs.
    pub bounds: Bounds,
    /// Inputs that may also be undef.
    pub undefined: BTreeSet<FunctionId>,
    /// By input: what is assumed of it, and the file that says it.
    pub told: BTreeMap<FunctionId, (String, String)>,
}

impl Assumptions {
    /// Puts the values of inputs into what a machine is explored with.
    pub fn put(&self, extent: &mut Extent) {
        extent.bounds.clone_from(&self.bounds);
        extent.undefined.clone_from(&self.undefined);
        extent.assumed.clone_from(&self.told);
    }
}

/// Faults, with the texts that they stand in.
pub type Trouble = (Sources, Vec<Diagnostic>);

/// A model with what the file beside it assumes, if there is one, and these terms. Terms replace those of the file.
///
/// # Errors
/// The faults of the file and of the terms.
pub fn assume(loaded: &Loaded, beside: Option<&SourceFile>, terms: &[String]) -> Result<Assumptions, Box<Trouble>> {
    let mut overlay = loaded.overlay();
    let mut said = Verification::default();
    let name = beside.map_or("", |file| file.name.as_str());
    if let Some(file) = beside {
        let id = overlay.add(file.clone());
        said = verification::read(id, &file.text).map_err(|fault| Box::new((overlay.sources.clone(), vec![*fault])))?;
        let faults = said.faults(&overlay.program);
        if !faults.is_empty() {
            return Err(Box::new((overlay.sources, faults)));
        }
    }
    let added: Vec<(&str, Said<'_>)> = match terms {
        [] => said.assumptions.iter().map(|text| (name, Said::from(text))).collect(),
        terms => terms.iter().map(|text| (OPTION, Said::from(text))).collect(),
    };
    for (name, text) in added {
        if let Err(faults) = overlay.property(PropertyKind::Invar, name, text) {
            return Err(Box::new((overlay.sources, faults)));
        }
    }
    let added = &overlay.program.properties[loaded.program.properties.len()..];
    if let (Some((input, _)), [.., last]) =
        (assumed_bounds(&overlay.program).iter().find(|(_, values)| values.is_empty()), added)
    {
        let name = &overlay.program.function(*input).name;
        let fault =
            Diagnostic::error("vacuous-refinement", last.span, format!("the assumptions leave {name} no value"));
        return Err(Box::new((overlay.sources, vec![fault])));
    }
    // Both fit the program: that was asked above.
    let undefined = bound::undefined(&overlay.program, &said.undefined).unwrap_or_default();
    let (mut bounds, mut told) = (Bounds::new(), BTreeMap::new());
    for text in &said.bounds {
        let read = bound::read(&overlay.program, std::slice::from_ref(text)).unwrap_or_default();
        let (input, values) = text.split_once('=').unwrap_or((text, ""));
        let words = format!("{} in {}", input.trim(), values.trim());
        told.extend(read.keys().map(|function| (*function, (words.clone(), name.to_string()))));
        bounds.extend(read);
    }
    for function in &undefined {
        let words = match told.get(function) {
            Some((words, _)) => format!("{words}, or undef"),
            None => format!("{} may be undef", overlay.program.function(*function).name),
        };
        told.insert(*function, (words, name.to_string()));
    }
    let Overlay { sources, model, program } = overlay;
    let model = Loaded { sources, model, program, diagnostics: loaded.diagnostics.clone() };
    Ok(Assumptions { model, bounds, undefined, told })
}

/// The terms that are about each of two machines. `abstract.f` and `concrete.f` say of which of them a term speaks; one without these
/// words is about each machine that has what it names.
///
/// # Errors
/// What is wrong with a term that is about neither, or that speaks of both.
pub fn terms_of(models: [&Loaded; 2], texts: &[String]) -> Result<[Vec<String>; 2], Box<Trouble>> {
    let mut of: [Vec<String>; 2] = Default::default();
    for text in texts {
        let named: Vec<(usize, String)> =
            SIDES.iter().enumerate().filter_map(|(side, word)| Some((side, without(text, word)?))).collect();
        match &named[..] {
            [] => {
                let fits = |side: usize| assume(models[side], None, std::slice::from_ref(text));
                let fitting: Vec<usize> = (0..SIDES.len()).filter(|side| fits(*side).is_ok()).collect();
                if fitting.is_empty() {
                    let Err(mut trouble) = fits(CONCRETE) else { continue };
                    for fault in &mut trouble.1 {
                        fault.message.push_str(", in the abstract and in the concrete machine");
                    }
                    return Err(trouble);
                }
                fitting.into_iter().for_each(|side| of[side].push(text.clone()));
            }
            [(side, own)] => {
                assume(models[*side], None, std::slice::from_ref(own))?;
                of[*side].push(own.clone());
            }
            _ => {
                let mut sources = Sources::default();
                let file = sources.add(SourceFile::new(OPTION, text.as_str()));
                let span = syntax::Span { file, start: 0, end: text.len() as u32 };
                let message = "an assumption is about one machine, and this one names both".to_string();
                let fault = Diagnostic::error("bad-coupling", span, message);
                let help = "what holds of both states together is said by `couple` in the coupling file";
                return Err(Box::new((sources, vec![fault.with_help(help)])));
            }
        }
    }
    Ok(of)
}

/// A term without `WORD.` before its names, which leaves blanks so that places stay what they are; none if that stands nowhere.
fn without(text: &str, word: &str) -> Option<String> {
    let prefix = format!("{word}.");
    let mut own = String::with_capacity(text.len());
    let mut rest = text;
    let mut is_there = false;
    let mut quoted = false;
    while let Some(next) = rest.chars().next() {
        let inside = own.ends_with(|c: char| c.is_alphanumeric() || c == '_' || c == '$');
        if !inside && !quoted && rest.starts_with(&prefix) {
            is_there = true;
            own.push_str(&" ".repeat(prefix.len()));
            rest = &rest[prefix.len()..];
            continue;
        }
        quoted ^= next == '"';
        own.push(next);
        rest = &rest[next.len_utf8()..];
    }
    is_there.then_some(own)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_before_names_become_blanks() {
        let check = |text: &str, word: &str, expect: Option<&str>| {
            assert_eq!(without(text, word).as_deref(), expect);
        };
        check("abstract.n < 3", "abstract", Some("         n < 3"));
        check("n < 3", "abstract", None);
        check("myabstract.n < 3", "abstract", None);
        check("not(concrete.a) or concrete.b", "concrete", Some("not(         a) or          b"));
        check("s = \"concrete.a\"", "concrete", None);
    }
}
