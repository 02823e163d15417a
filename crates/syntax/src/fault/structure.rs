//! Faults of the parser: one constructor for each thing that can be wrong with the structure of a text.
//!
//! In: [`Found`], what stands at the place. Out: a diagnostic. The constructors only word the fault;
//! `grammar::recovery` decides when to report it and how to go on.

use super::wording::{expected, found, name_of, renamed, shape_of};
use crate::{Diagnostic, Span, SyntaxKind, SyntaxKind::*};

/// What stands where something else was expected.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Found<'t> {
    pub(crate) span: Span,
    pub(crate) kind: SyntaxKind,
    pub(crate) text: &'t str,
}

impl std::fmt::Display for Found<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&found(self.kind, self.text))
    }
}

/// No term where one must stand; `wanted` says which.
pub(crate) fn expected_term(found: Found<'_>, wanted: &str) -> Diagnostic {
    Diagnostic::error("expected-term", found.span, format!("expected {wanted}, found {found}"))
        .here("a term must stand here")
        .with_help("write a term: a literal, a variable, a function, or a compound of these")
}

/// No rule where one must stand; `wanted` says which.
pub(crate) fn expected_rule(found: Found<'_>, wanted: &str) -> Diagnostic {
    Diagnostic::error("expected-rule", found.span, format!("expected {wanted}, found {found}"))
        .here("a rule must stand here")
        .with_help("write a rule: `skip` does nothing, `f := t` updates, `r_x[]` calls, `par … endpar` holds several")
}

/// No domain where one must stand.
pub(crate) fn expected_domain(found: Found<'_>) -> Diagnostic {
    Diagnostic::error("expected-domain", found.span, format!("expected a domain, found {found}"))
        .here("a domain must stand here")
        .with_help("write a domain's name, or Prod, Seq, Powerset, Bag, Map or Rule with its domains in parentheses")
}

/// A certain token is missing.
pub(crate) fn expected_token(found: Found<'_>, kind: SyntaxKind, context: &str) -> Diagnostic {
    let wanted = expected(kind);
    Diagnostic::error("expected-token", found.span, format!("expected {wanted} {context}, found {found}"))
        .here(format!("{wanted} is missing here"))
        .with_help(format!("write {wanted}"))
}

/// What kind of channel it is, is missing.
pub(crate) fn expected_channel_kind(found: Found<'_>) -> Diagnostic {
    Diagnostic::error("expected-token", found.span, format!("expected the kind of the channel, found {found}"))
        .here("how it hands over its data is missing here")
        .with_help("write `swinging buffer 2`, `queue 8` or `shared value`, with any numbers")
}

/// A name of another class than the place asks for.
pub(crate) fn name_class(found: Found<'_>, kind: SyntaxKind) -> Diagnostic {
    let fault = Diagnostic::error("name-class", found.span, format!("`{}` cannot be {}", found.text, name_of(kind)));
    let fault = match found.kind {
        COMPLEX => fault.here("`i`, also with digits behind it, is the imaginary unit"),
        _ => fault.here(shape_of(kind)),
    };
    match renamed(found.text, kind) {
        Some(name) => fault.with_help(format!("write `{name}`, here and wherever it is used")),
        None => fault.with_help("rename it, here and wherever it is used"),
    }
}

/// No name where one must stand.
pub(crate) fn expected_name(found: Found<'_>, kind: SyntaxKind) -> Diagnostic {
    let fault = Diagnostic::error("expected-name", found.span, format!("expected {}, found {found}", name_of(kind)))
        .here(shape_of(kind));
    match found.kind.text() {
        Some(word) if word.starts_with(|c: char| c.is_ascii_alphabetic()) => {
            fault.with_help(format!("`{}` is a keyword; choose another name", found.text))
        }
        _ => fault.with_help("write the name"),
    }
}

/// A keyword that is declared, or defined, as a name.
pub(crate) fn keyword_as_name(found: Found<'_>, kind: SyntaxKind) -> Diagnostic {
    Diagnostic::error("keyword-as-name", found.span, format!("`{}` cannot be {}", found.text, name_of(kind)))
        .here("this word is a keyword")
        .with_help("choose another name, here and wherever it is used; what follows from this is not told")
}

/// A length of time without its unit.
pub(crate) fn expected_unit(found: Found<'_>) -> Diagnostic {
    Diagnostic::error("expected-token", found.span, format!("expected a unit behind the length of time, found {found}"))
        .here("the unit is missing here")
        .with_help("write `ns`, `us`, `ms` or `s` behind the number, as in `10 ms`")
}

/// The end of a construct is missing; `within` is the opener of a construct in it whose end may be the missing one.
pub(crate) fn missing_end(
    found: Found<'_>,
    end: SyntaxKind,
    opener: Found<'_>,
    within: Option<Found<'_>>,
) -> Diagnostic {
    let wanted = expected(end);
    let word = opener.text;
    let fault = Diagnostic::error("missing-end", found.span, format!("`{word}` has no {wanted}; found {found}"))
        .here(format!("{wanted} is expected here at the latest"))
        .with_label(opener.span, format!("this `{word}` is open"))
        .with_help(format!("write {wanted} where what `{word}` opens is to end"));
    match within {
        Some(within) => fault
            .with_label(within.span, format!("the {wanted} may be missing to this `{word}`: its end is not below it")),
        None => fault,
    }
}

/// `else if` took the one `endif`.
pub(crate) fn else_if(found: Found<'_>, outer: Found<'_>, inner: Found<'_>) -> Diagnostic {
    missing_end(found, ENDIF_KW, outer, None)
        .with_label(inner.span, "this second `if` took the `endif`")
        .with_help("write `elseif` for `else if`, or one more `endif`")
}

/// An end that nothing waits for.
pub(crate) fn stray_end(found: Found<'_>) -> Diagnostic {
    Diagnostic::error("stray-end", found.span, format!("{found} ends nothing"))
        .here("nothing that it could end is open here")
        .with_help("remove it, or write what it is to end")
}

/// Two rules where only one may stand.
pub(crate) fn several_rules(found: Found<'_>, opener: Found<'_>) -> Diagnostic {
    Diagnostic::error("several-rules", found.span, format!("a second rule where `{}` takes one", opener.text))
        .here("this rule follows another without `par` or `seq` around them")
        .with_label(opener.span, format!("`{}` is opened here", opener.text))
        .with_help("write `par … endpar` around the rules (or `seq … endseq`), or end the construct before this rule")
}

/// `x = 3` or `x : = 3` as a rule.
pub(crate) fn equals_for_assign(found: Found<'_>) -> Diagnostic {
    Diagnostic::error("equals-for-assign", found.span, "an update is written with `:=`")
        .here("`=` compares two terms")
        .with_help("write `:=`")
}

/// `:=` within a term.
pub(crate) fn assign_in_term(found: Found<'_>) -> Diagnostic {
    Diagnostic::error("assign-in-term", found.span, "an update cannot stand in a term")
        .here("`:=` updates a location and makes a rule")
        .with_help("write `=` to compare")
}

/// A term where a rule must stand.
pub(crate) fn term_as_rule(found: Found<'_>) -> Diagnostic {
    Diagnostic::error("term-as-rule", found.span, format!("a term with {found} is no rule"))
        .here("expected `:=`, as a rule must stand here")
        .with_help("write `location := term` for an update")
}

/// A branch after `else` or `otherwise`.
pub(crate) fn misplaced_branch(found: Found<'_>, last: &str) -> Diagnostic {
    Diagnostic::error("misplaced-branch", found.span, format!("{found} behind `{last}`"))
        .here(format!("`{last}` is the last branch"))
        .with_help(format!("move this branch before `{last}`, or end the construct before it"))
}

/// `RED := 1`
pub(crate) fn no_location(found: Found<'_>) -> Diagnostic {
    Diagnostic::error("name-class", found.span, format!("{found} cannot be updated"))
        .here("only a function, also with arguments, and a variable are updated")
        .with_help(shape_of(FUNCTION_ID))
}

/// `x += 1`
pub(crate) fn compound_assignment(found: Found<'_>) -> Diagnostic {
    let sign = found.text;
    Diagnostic::error("foreign-operator", found.span, format!("`{sign}=` is no operator of AsmetaL"))
        .here("an update is written with `:=`")
        .with_help(format!("write `x := x {sign} …`"))
}

/// `function f := 1`
pub(crate) fn assign_in_definition(found: Found<'_>) -> Diagnostic {
    Diagnostic::error("assign-in-term", found.span, "a definition is written with `=`")
        .here("`:=` updates a location and makes a rule")
        .with_help("write `=`")
}

/// `domain D = …` in the signature.
pub(crate) fn contents_in_signature(found: Found<'_>) -> Diagnostic {
    Diagnostic::error(
        "expected-token",
        found.span,
        "expected `subsetof` behind the name of a concrete domain, found `=`",
    )
    .here("the signature only declares the domain")
    .with_help("write `domain D subsetof E` here, and `domain D = …` in the definitions")
}

/// `domain D subsetof …` in the definitions.
pub(crate) fn declaration_of_domain(found: Found<'_>) -> Diagnostic {
    Diagnostic::error("expected-token", found.span, format!("expected `=` behind the name of a domain, found {found}"))
        .here("the definitions give the elements of a domain that is declared")
        .with_help("move the declaration to the signature, and write `domain D = …` here")
}

/// A word such as `else` that belongs to no construct around.
pub(crate) fn stray_word(found: Found<'_>) -> Diagnostic {
    Diagnostic::error("stray-end", found.span, format!("{found} belongs to nothing that is open"))
        .here("a rule must stand here")
        .with_help("remove it, or look for an end that comes too early before it")
}

/// `5.`
pub(crate) fn bare_point(found: Found<'_>) -> Diagnostic {
    Diagnostic::error("number-form", found.span, "a real number has digits on both sides of its point")
        .here("no digit behind the point")
        .with_help("write `.0` for the point")
}

/// `r_x` without brackets.
pub(crate) fn missing_brackets(found: Found<'_>) -> Diagnostic {
    let name = found.text;
    Diagnostic::error("missing-brackets", found.span, format!("the call of `{name}` has no brackets"))
        .here("a call needs them even without arguments")
        .with_help(format!("write `{name}[]` to call a macro rule, `{name}()` to call a turbo rule"))
}

/// A rule's name in a term.
pub(crate) fn rule_in_term(found: Found<'_>) -> Diagnostic {
    let name = found.text;
    Diagnostic::error("rule-in-term", found.span, format!("the rule `{name}` cannot stand in a term"))
        .here("a term must stand here")
        .with_help(format!(
            "write `<<{name}>>` for the rule as a value, or `f <- {name}(…)` for the result of a turbo rule"
        ))
}

/// `forall …` in a term without parentheses.
pub(crate) fn quantifier_parentheses(found: Found<'_>) -> Diagnostic {
    let word = found.text;
    Diagnostic::error("quantifier-parentheses", found.span, "a quantified term stands in parentheses")
        .here(format!("`{word}` without `(` before it"))
        .with_help(format!("write `({word} $x in D with condition)`"))
}

/// An operator without its left operand.
pub(crate) fn no_left_operand(found: Found<'_>) -> Diagnostic {
    Diagnostic::error("expected-term", found.span, format!("the operator {found} has no left operand"))
        .here("a term must stand before it")
        .with_help("write the operand, or remove the operator")
}

/// `.5`
pub(crate) fn bare_fraction(found: Found<'_>) -> Diagnostic {
    Diagnostic::error("number-form", found.span, "a real number has digits on both sides of its point")
        .here("no digit before the point")
        .with_help("write `0.` before the digits")
}

/// `f()`
pub(crate) fn empty_parentheses(found: Found<'_>) -> Diagnostic {
    Diagnostic::error("expected-term", found.span, "nothing stands between the parentheses")
        .here("a term must stand here")
        .with_help("a function without arguments is written without parentheses")
}

/// A wrong number of domains after a constructor.
pub(crate) fn domain_arity(found: Found<'_>, count: usize) -> Diagnostic {
    let wanted = match found.kind {
        PROD_KW => "two domains or more",
        MAP_KW => "two domains",
        RULE_DOMAIN_KW => "one domain or more, or no parentheses",
        _ => "one domain",
    };
    Diagnostic::error("domain-arity", found.span, format!("`{}` takes {wanted}", found.text))
        .here(format!("{count} given"))
        .with_help(format!("give `{}` {wanted}", found.text))
}

/// No definition, declaration or section where one must stand.
pub(crate) fn expected_definition(found: Found<'_>, wanted: &str) -> Diagnostic {
    Diagnostic::error("expected-definition", found.span, format!("expected {wanted}, found {found}"))
        .here("this starts none, and the text up to the next one is skipped")
        .with_help(
            "check the end of what stands before, or write the word that starts it: `function`, `rule`, `main` …",
        )
}

/// A declaration among the definitions.
pub(crate) fn declaration_in_definitions(found: Found<'_>) -> Diagnostic {
    Diagnostic::error(
        "expected-definition",
        found.span,
        format!("expected a definition, found the declaration {found}"),
    )
    .here("domains and functions are declared in the signature")
    .with_help("move it to the section `signature:`")
}

/// `;` or `,` between rules or definitions.
pub(crate) fn separator(found: Found<'_>) -> Diagnostic {
    Diagnostic::error("unexpected-text", found.span, format!("{found} separates nothing here"))
        .here("rules and definitions follow one another without a mark between them")
        .with_help("remove it")
}

/// Text after the end.
pub(crate) fn unexpected_text(found: Found<'_>) -> Diagnostic {
    Diagnostic::error("unexpected-text", found.span, format!("expected the end, found {found}"))
        .here("the term ends before this")
        .with_help("remove it, or write the operator that joins it to the term")
}

/// No `asm` or `module` at the start.
pub(crate) fn no_machine_name(found: Found<'_>) -> Diagnostic {
    Diagnostic::error("missing-section", found.span, format!("expected `asm` or `module`, found {found}"))
        .here("a file starts with its name")
        .with_help("write `asm NAME` or `module NAME`, with NAME as the file is called")
}

/// A section is missing.
pub(crate) fn missing_section(found: Found<'_>, section: &str) -> Diagnostic {
    Diagnostic::error("missing-section", found.span, format!("the section `{section}:` is missing; found {found}"))
        .here(format!("`{section}:` is expected before this"))
        .with_help(format!("write `{section}:`, even if nothing is in it"))
}

/// A section stands twice.
pub(crate) fn duplicate_section(found: Found<'_>) -> Diagnostic {
    Diagnostic::error("duplicate-section", found.span, format!("a second {found}"))
        .here("a file has at most one")
        .with_help("join the two")
}

/// A section stands too late.
pub(crate) fn misplaced_section(found: Found<'_>, later: &str) -> Diagnostic {
    Diagnostic::error("misplaced-section", found.span, format!("{found} behind `{later}`"))
        .here("the order is: import, export, signature, definitions, main, init")
        .with_help(format!("move it before `{later}`"))
}

/// No command of a scenario.
pub(crate) fn expected_command(found: Found<'_>) -> Diagnostic {
    Diagnostic::error("expected-command", found.span, format!("expected a command, found {found}"))
        .here("a command must stand here")
        .with_help("the commands are: check, set, step, step until, exec, pick, begin … end, execblock, expect")
}

/// An `expect` of something unknown.
pub(crate) fn unknown_trouble(found: Found<'_>, whole: bool) -> Diagnostic {
    let choices = if whole {
        "`check`, `invariant NAME`, `inconsistent update` or `error`"
    } else {
        "`failure`, `inconsistent update` or `error`"
    };
    Diagnostic::error("expected-command", found.span, format!("expected {choices}, found {found}"))
        .here("this says what trouble is expected")
        .with_help(format!("write {choices}"))
}

/// No item of a chart.
pub(crate) fn expected_shape(found: Found<'_>, wanted: &str) -> Diagnostic {
    Diagnostic::error("expected-shape", found.span, format!("expected {wanted}, found {found}"))
        .here("this starts none, and the text up to the next one is skipped")
        .with_help(match wanted.starts_with("a phase") {
            true => "write each phase on a line, such as `read frames 0.5 ms`; several names have commas between them",
            false if wanted.starts_with("a component") => {
                "start each with its word: `component`, `channel`, `sensor`, `actuator`, `within`; a connection is `SENSOR -> COMPONENT`"
            }
            false => "start each with its word: `state`, `guard`, `action`, `instance`; a path with a name and `->`",
        })
}

/// The limit of nesting.
pub(crate) fn nested_too_deeply(found: Found<'_>) -> Diagnostic {
    use crate::limit::{MAX_CHAIN, MAX_NESTING};
    Diagnostic::error("nested-too-deeply", found.span, "this is nested too deeply")
        .here(format!("at most {MAX_NESTING} constructs in one another, and {MAX_CHAIN} operators in one chain"))
        .with_help("split it: define functions for parts of a term, rules for parts of a rule")
}

/// The limit of nesting for composite states.
pub(crate) fn composites_too_deep(found: Found<'_>) -> Diagnostic {
    use crate::limit::MAX_COMPOSITES;
    Diagnostic::error("nested-too-deeply", found.span, "this composite state is nested too deeply")
        .here(format!("at most {MAX_COMPOSITES} composite states in one another"))
        .with_help("split the machine: give what is inside to a machine of its own")
}

/// `{1..5}`
pub(crate) fn dots_in_range(found: Found<'_>, two: bool) -> Diagnostic {
    let span = Span { end: found.span.end + u32::from(two), ..found.span };
    Diagnostic::error("foreign-operator", span, "a range is written with `:`")
        .here("dots are no operator of AsmetaL")
        .with_help("write `{lo : hi}`, or `{lo : hi, step}`")
}

/// `A * B` as a domain.
pub(crate) fn product_of_domains(found: Found<'_>) -> Diagnostic {
    Diagnostic::error("foreign-operator", found.span, format!("{found} joins no domains"))
        .here("a product of domains has a name in AsmetaL")
        .with_help("write `Prod(A, B)`")
}

/// `<<skip>>`
pub(crate) fn rule_as_value(found: Found<'_>) -> Diagnostic {
    Diagnostic::error("expected-name", found.span, format!("expected the name of a rule in `<<…>>`, found {found}"))
        .here("only a rule that is declared is a value")
        .with_help("declare a rule for it, and write `<<r_name>>`")
}

/// `elif`, `elsif`
pub(crate) fn foreign_word(found: Found<'_>, ours: &str) -> Diagnostic {
    Diagnostic::error("foreign-operator", found.span, format!("{found} is no word of AsmetaL"))
        .here(format!("written `{ours}` in AsmetaL"))
        .with_help(format!("write `{ours}`"))
}

/// Rules in parentheses or braces.
pub(crate) fn bracketed_rule(found: Found<'_>) -> Diagnostic {
    Diagnostic::error("expected-rule", found.span, format!("a rule does not start with {found}"))
        .here("brackets do not hold rules together")
        .with_help("write `par … endpar` or `seq … endseq` around the rules")
}

/// `endforall` and the like.
pub(crate) fn no_such_end(found: Found<'_>) -> Diagnostic {
    stray_end(found)
        .here("`choose`, `forall`, `while` and `extend` have one rule behind `do`, and no word ends them")
        .with_help("remove it; write `par … endpar` around several rules")
}

/// `execblock file.block`
pub(crate) fn dot_in_block_name(found: Found<'_>) -> Diagnostic {
    Diagnostic::error("expected-token", found.span, "a file and its block are joined by `:`")
        .here("`:` is expected here")
        .with_help("write `execblock file:block;`")
}

/// A text beyond the limit.
pub(crate) fn file_too_large(span: Span, length: usize) -> Diagnostic {
    let limit = crate::limit::MAX_TEXT_BYTES;
    Diagnostic::error(
        "file-too-large",
        span,
        format!("the file has {length} bytes, more than the {limit} that are read"),
    )
    .here("nothing of it was read")
    .with_help("split it into modules that import one another")
}

/// The limit of faults.
pub(crate) fn too_many_faults(next: Span) -> Diagnostic {
    let limit = crate::limit::MAX_FAULTS;
    let fault = Diagnostic::warning("too-many-faults", next, "there are more faults from here on");
    fault
        .here(format!("only the first {limit} of a file are reported"))
        .with_help("mend the first ones and check again")
}
