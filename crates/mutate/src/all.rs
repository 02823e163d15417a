//! All mutants of a file.
//!
//! In: a checked model and one of its files. Out: [`Mutant`]s in the order of the text. Mutated are the rules that the model
//! runs, the definitions of the static and derived functions that these use, and the default initial state of the model's
//! own file.

use syntax::ast::{self, AstNode};
use syntax::{FileId, Sources};

use crate::facts::Facts;
use crate::make::Maker;
use crate::mutant::Mutant;
use crate::places::at;

/// The mutants of a file of a model.
pub fn mutants(model: &model::Model, sources: &Sources, file: FileId) -> Vec<Mutant> {
    let text = &sources.file(file).text;
    let parse = syntax::parse_asmetal(file, text);
    let Some(tree) = ast::SourceFile::cast(parse.syntax()) else { return Vec::new() };
    let facts = Facts::new(model, file);
    let mut found = Vec::new();
    let definitions = tree.definitions();
    for definition in definitions.iter().flat_map(|definitions| definitions.function_defs()) {
        let function = definition.name().and_then(|name| facts.function(at(name.text_range())));
        if let (Some(function), Some(body)) = (function, definition.body())
            && facts.runs.functions.contains(&function)
        {
            let mut maker = Maker::in_definition(&facts, text, function, &mut found);
            maker.definition(&body);
        }
    }
    let main = tree.main_rule().into_iter().flat_map(|main| main.syntax().children().filter_map(ast::RuleDecl::cast));
    let rules = definitions.iter().flat_map(|definitions| definitions.rules());
    for declaration in rules.chain(main.collect::<Vec<_>>()) {
        let rule = declaration.name().and_then(|name| facts.rule_at(at(name.text_range())));
        if let (Some(rule), Some(body)) = (rule, declaration.body())
            && facts.runs.rules.contains(&rule)
        {
            Maker::in_rule(&facts, text, rule, &mut found).rule(body.syntax());
        }
    }
    if file == model.root {
        let default = model.default_init.and_then(|index| model.inits.get(index)).map(|init| init.span);
        for init in tree.inits() {
            let range = init.range();
            let is_default = default.is_some_and(|name| range.contains(name.start.into()) && name.file == file);
            if !is_default {
                continue;
            }
            for definition in init.syntax().children().filter_map(ast::FunctionDef::cast) {
                let function = definition.name().and_then(|name| facts.function(at(name.text_range())));
                if let (Some(function), Some(body)) = (function, definition.body()) {
                    Maker::in_initial(&facts, text, function, &mut found).term(body.syntax());
                }
            }
        }
    }
    found.sort_by(|a: &Mutant, b| {
        (a.place.start, a.place.end, a.operator, &a.edits[0].text).cmp(&(
            b.place.start,
            b.place.end,
            b.operator,
            &b.edits[0].text,
        ))
    });
    found.dedup_by(|a, b| a.edits == b.edits);
    found
}
