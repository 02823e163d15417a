//! What can be written at a place of a coupling file (spec/refine.md): statements, and the names of the two machines it is about.
//!
//! In: the text, an offset, both models as far as the file names them. Out: [`Item`]s. What stands before the place decides, so that a
//! text with faults is as good as a sound one. Models that are named on the command line alone are not known here.

use std::collections::BTreeSet;
use std::sync::Arc;

use groundstate::refine::{ABSTRACT, CONCRETE, SIDES, WORDS};
use groundstate::workspace::Files;
use model::FunctionKind;

use super::{Item, ItemKind, functions, paths, snippet};
use crate::analysis::Analysis;
use crate::coupling::{is_word, models, place, side_before};
use crate::project::Project;

/// What can be written at an offset, and what it takes the place of.
pub(super) fn completion<F: Files>(
    project: &mut Project<F>,
    analysis: &Analysis,
    offset: u32,
) -> Option<((u32, u32), Vec<Item>)> {
    let text = analysis.text();
    let place = place(text, offset)?;
    let models = models(project, analysis);
    let mut words = place.statement.split(|c: char| !is_word(c));
    let first = words.next().unwrap_or("");
    if place.quoted {
        let of_model = SIDES.contains(&first);
        return of_model.then(|| (place.range, paths(project, analysis, true)));
    }
    if place.statement.len() == first.len() {
        return Some((place.range, statements()));
    }
    let before = place.statement[..place.statement.len() - (offset - place.range.0) as usize].trim_end();
    let side = side_before(before);
    let mapped = first == "input" && place.statement.contains('=');
    let items = match (first, side) {
        ("free" | "input", Some(ABSTRACT)) if !mapped => of(&models[ABSTRACT], |kind| kind == FunctionKind::Monitored),
        ("free" | "input", None) if !mapped => sides(&[ABSTRACT]),
        ("couple" | "variant", Some(side)) => of(&models[side], is_state),
        ("segment", Some(CONCRETE)) => of(&models[CONCRETE], is_state),
        ("fair", Some(CONCRETE)) => of(&models[CONCRETE], |_| true),
        ("input", Some(CONCRETE)) if mapped => of(&models[CONCRETE], |_| true),
        ("couple" | "variant", None) => [sides(&[ABSTRACT, CONCRETE]), terms(&models)].concat(),
        ("fair" | "segment" | "input", None) => [sides(&[CONCRETE]), terms(&models)].concat(),
        ("same", None) => in_both(&models),
        ("allow", None) => {
            vec!["waiting", "overflow"].into_iter().map(|word| Item::new(word, ItemKind::Keyword, "", 0)).collect()
        }
        _ => Vec::new(),
    };
    Some((place.range, items))
}

fn is_state(kind: FunctionKind) -> bool {
    kind != FunctionKind::Monitored && kind != FunctionKind::Local
}

/// The functions of a model that are of certain kinds.
fn of(model: &Option<Arc<Analysis>>, fits: impl Fn(FunctionKind) -> bool) -> Vec<Item> {
    let Some(analysis) = model else { return Vec::new() };
    let own = functions(analysis).filter(|(id, _)| {
        let function = analysis.model.function(*id);
        !function.library && fits(function.kind)
    });
    own.map(|(_, item)| item).collect()
}

/// The names that both models have.
fn in_both(models: &[Option<Arc<Analysis>>; 2]) -> Vec<Item> {
    let other: BTreeSet<String> = of(&models[CONCRETE], is_state).into_iter().map(|item| item.label).collect();
    let both = of(&models[ABSTRACT], is_state).into_iter().filter(|item| other.contains(&item.label));
    both.map(|item| Item { insert: item.label.clone(), is_snippet: false, ..item }).collect()
}

fn sides(which: &[usize]) -> Vec<Item> {
    let words = ["the abstract machine", "the concrete machine"];
    which.iter().map(|side| Item::new(&format!("{}.", SIDES[*side]), ItemKind::Keyword, words[*side], 0)).collect()
}

/// What else a term can begin with.
fn terms(models: &[Option<Arc<Analysis>>; 2]) -> Vec<Item> {
    let mut items = snippet::terms();
    for analysis in models.iter().flatten() {
        let literals = analysis.model.names.all_literals();
        items.extend(
            literals
                .map(|(name, domain)| Item::new(name, ItemKind::Literal, analysis.model.domains.display(domain), 1)),
        );
    }
    items.extend(["true", "false", "undef"].map(|word| Item::new(word, ItemKind::Keyword, "", 4)));
    items
}

/// The statements.
fn statements() -> Vec<Item> {
    let forms = [
        ("abstract", "the abstract model", "abstract \"${1:Model.asm}\";"),
        ("allow", "what is taken for granted: that waiting ends, or numbers fit", "allow ${0};"),
        ("concrete", "the concrete model", "concrete \"${1:Model.asm}\";"),
        ("couple", "what holds of corresponding states", "couple ${0};"),
        ("diagrams", "numbers of abstract and of concrete steps", "diagrams ${1:0..1}:${2:1};"),
        ("fair", "what is true again and again in the concrete machine's runs", "fair ${0};"),
        ("free", "an input that the abstract machine takes as it likes", "free abstract.${0};"),
        ("input", "the value of an input of the abstract machine", "input abstract.${1} = ${0};"),
        ("same", "functions that are equal in both machines", "same ${0};"),
        ("segment", "where a segment ends", "segment ${0};"),
        ("variant", "what decreases while the abstract machine stands still", "variant ${0};"),
    ];
    debug_assert!(forms.iter().map(|(word, ..)| *word).eq(WORDS));
    forms.into_iter().map(|(word, detail, insert)| Item::snippet(word, detail, insert, 0)).collect()
}
