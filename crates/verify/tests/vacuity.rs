//! Idle parts of properties: by the definition, where both constants may stand in their place, and on formulas about runs.

use std::collections::BTreeSet;
use std::sync::Arc;

use program::{Program, PropertyKind};
use syntax::SourceFile;
use testkit::sample;
use verify::vacuity::Question;
use verify::{Options, Outcome, Report, Subject, verify};

use crate::models::lowered;

/// Three of the four values of `x` are reached, `b` is true in one of them.
fn model(properties: &str) -> (Arc<Program>, String) {
    let text = format!(
        "asm example\nimport StandardLibrary\nimport CTLLibrary\nimport LTLLibrary\nsignature:\n\
         domain Four subsetof Integer\ncontrolled x: Four\ncontrolled b: Boolean\ndefinitions:\n\
         domain Four = {{0 : 3}}\n{properties}\n\
         main rule r_Main = par x := (x + 1) mod 3 b := (x = 0) endpar\n\
         default init s0: function x = 0 function b = false\n"
    );
    (lowered(SourceFile::new("example.asm", text.clone())), text)
}

fn searched(program: &Arc<Program>) -> Report {
    verify(program, &Options::default(), &mut |_| true).expect("there is an initial state")
}

fn holds(report: &Report, index: usize) -> bool {
    let verdict = report.verdicts.iter().find(|verdict| verdict.subject == Subject::Property(index));
    matches!(verdict.expect("it is asked").outcome, Outcome::Holds)
}

/// The idle parts of the properties that hold: the property, the place of the part without parentheses around it, what stands there instead.
fn idle(program: &Arc<Program>, text: &str) -> BTreeSet<(usize, usize, bool)> {
    let report = searched(program);
    let formulas = [PropertyKind::Invariant, PropertyKind::Ctl, PropertyKind::Ltl];
    let properties = (0..program.properties.len()).filter(|index| formulas.contains(&program.properties[*index].kind));
    let held: Vec<usize> = properties.filter(|index| holds(&report, *index)).collect();
    let question = Question::new(program, &held);
    let found = question.idle(&searched(&Arc::new(question.program.clone())));
    assert_eq!(found.open, 0);
    let place = |span: syntax::Span| {
        let part = &text[span.start as usize..span.end as usize];
        span.start as usize + (part.len() - part.trim_start_matches(['(', ' ']).len())
    };
    found.parts.iter().map(|replaced| (replaced.property, place(replaced.part), replaced.by)).collect()
}

#[test]
fn parts_that_are_never_tried() {
    let cases = [
        ("invariant inv_p over x: x = 3 implies b", vec![("b", false)]),
        ("invariant inv_p over x: b implies x < 3", vec![("b", true)]),
        ("invariant inv_p over x: b implies x = 1", vec![]),
        ("invariant inv_p over x: not (x = 3 and b)", vec![("b", true)]),
        ("invariant inv_p over x: not (x != 1 and b)", vec![]),
        ("invariant inv_p over x: (forall $k in Four with $k > 2 implies x != $k or b)", vec![("b", false)]),
        ("CTLSPEC ctlSpec_p: ag(x = 3 implies af(b))", vec![("x = 3", true), ("af", false)]),
        ("CTLSPEC ctlSpec_p: ag(ef(b or x = 3))", vec![("x = 3", false)]),
        ("CTLSPEC ctlSpec_p: ag(x = 0 implies ax(b and x = 1))", vec![]),
        ("LTLSPEC ltlSpec_p: g(x = 2 implies f(b))", vec![("x = 2", true)]),
        ("LTLSPEC ltlSpec_p: g(b implies y(x = 0))", vec![]),
        ("LTLSPEC ltlSpec_p: u(x < 3, b)", vec![("x < 3", false)]),
        // Neither grows nor shrinks with its operands.
        ("invariant inv_p over x: (x = 3) iff (x > 2)", vec![]),
    ];
    for (property, expected) in cases {
        let (program, text) = model(property);
        let found = idle(&program, &text);
        let begin = text.find(property).expect("it is there") + property.find(": ").expect("a colon") + 2;
        let place = |part: &str| begin + text[begin..].find(part).expect("it is there");
        let mut expected: BTreeSet<(usize, usize, bool)> =
            expected.iter().map(|(part, by)| (0, place(part), *by)).collect();
        if property == "LTLSPEC ltlSpec_p: u(x < 3, b)" {
            // `b` is not true at first, so what holds until then matters.
            expected.clear();
        }
        let told: Vec<(&str, bool)> = found.iter().map(|(_, at, by)| (&text[*at..*at + 8], *by)).collect();
        assert_eq!(found, expected, "{property}: {told:?}");
    }
}

/// A formula of connectives.
#[derive(Debug)]
enum Formula {
    Atom(&'static str),
    Not(Box<Formula>),
    Two(&'static str, Box<Formula>, Box<Formula>),
}

impl Formula {
    fn random(random: &mut impl FnMut(u64) -> u64, depth: u64) -> Formula {
        const ATOMS: [&str; 6] = ["x = 0", "x = 1", "x > 1", "x = 3", "b", "x < 3"];
        match random(if depth == 0 { 1 } else { 5 }) {
            0 => Formula::Atom(ATOMS[random(6) as usize]),
            1 => Formula::Not(Box::new(Formula::random(random, depth - 1))),
            which => {
                let connective = ["and", "or", "implies"][which as usize - 2];
                let mut operand = || Box::new(Formula::random(random, depth - 1));
                Formula::Two(connective, operand(), operand())
            }
        }
    }

    /// Writes the formula with the part of this number replaced; lists the parts: the places where they begin, and which contains them.
    fn write(
        &self,
        out: &mut String,
        instead: Option<(usize, bool)>,
        parts: &mut Vec<(usize, Option<usize>)>,
        within: Option<usize>,
    ) {
        match self {
            Formula::Atom(atom) => *out += atom,
            Formula::Not(operand) => {
                *out += "not ";
                operand.part(out, instead, parts, within);
            }
            Formula::Two(connective, left, right) => {
                left.part(out, instead, parts, within);
                *out += &format!(" {connective} ");
                right.part(out, instead, parts, within);
            }
        }
    }

    fn part(
        &self,
        out: &mut String,
        instead: Option<(usize, bool)>,
        parts: &mut Vec<(usize, Option<usize>)>,
        within: Option<usize>,
    ) {
        let number = parts.len();
        *out += "(";
        parts.push((out.len(), within));
        match instead {
            Some((part, by)) if part == number => {
                *out += if by { "true" } else { "false" };
                // The parts within have their numbers all the same.
                self.write(&mut String::new(), None, parts, Some(number));
            }
            _ => self.write(out, instead, parts, Some(number)),
        }
        *out += ")";
    }

    /// How many operators at its head have one operand, which is then all of it.
    fn chain(&self) -> usize {
        match self {
            Formula::Not(operand) => 1 + operand.chain(),
            Formula::Atom(_) | Formula::Two(..) => 0,
        }
    }
}

#[test]
fn a_part_is_idle_if_both_constants_may_stand_in_its_place() {
    let (mut held, mut some) = (0, 0);
    for seed in sample::seeds(40, 1_000) {
        let mut state = seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) | 1;
        let mut random = |below: u64| {
            state ^= state << 13;
            state ^= state >> 7;
            state ^= state << 17;
            (state >> 20) % below
        };
        let formula = Formula::random(&mut random, 3);
        let (mut whole, mut parts) = (String::new(), Vec::new());
        formula.write(&mut whole, None, &mut parts, None);
        let with = |instead| {
            let mut text = String::new();
            formula.write(&mut text, Some(instead), &mut Vec::new(), None);
            text
        };
        let variants: Vec<String> =
            (0..parts.len()).flat_map(|part| [with((part, true)), with((part, false))]).collect();
        let every = |texts: &[String]| -> String {
            texts.iter().enumerate().map(|(number, text)| format!("invariant inv_{number} over x: {text}\n")).collect()
        };
        let report = searched(&model(&every(&variants)).0);
        let (program, text) = model(&format!("invariant inv_whole over x: {whole}\n"));
        if !holds(&searched(&program), 0) {
            continue;
        }
        held += 1;
        let begin = text.find(&whole).expect("it is there");
        let is_idle = |part: usize| holds(&report, 2 * part) && holds(&report, 2 * part + 1);
        // A formula that is one operand under an operator is not replaced as a whole.
        let chain = formula.chain();
        let mut expected = BTreeSet::new();
        for (number, (place, _)) in parts.iter().enumerate().skip(chain) {
            let mut around = parts[number].1;
            let mut covered = false;
            while let Some(outer) = around {
                covered |= outer >= chain && is_idle(outer);
                around = parts[outer].1;
            }
            if is_idle(number) && !covered {
                let inner = whole[*place..].trim_start_matches('(');
                expected.insert(begin + whole.len() - inner.len());
            }
        }
        some += usize::from(!expected.is_empty());
        let found: BTreeSet<usize> = idle(&program, &text).iter().map(|(_, place, _)| *place).collect();
        assert_eq!(found, expected, "seed {seed}: {whole}");
    }
    assert!(held > 5 && some > 2, "{held} formulas hold, {some} of them have idle parts");
}
