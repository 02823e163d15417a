//! A solver for formulas over a few values: it tries all of them. With it inductions over small machines are decided without z3 and cvc5.
//!
//! In: a script of SMT-LIB as [`solve`] writes it. Out: `sat` with values, `unsat`, or `unknown` where a variable has no bounds or there
//! are too many values. It shares nothing with what writes the script.

use std::collections::BTreeMap;

use solve::session::{Session, Silence, Solvers};

/// LIMIT: so many assignments are tried.
const TRIED: u64 = 1 << 17;

/// See the module.
#[derive(Debug, Clone, Copy)]
pub struct Enumerated;

impl Solvers for Enumerated {
    fn name(&self) -> Result<String, String> {
        Ok("all values".to_string())
    }

    fn start(&mut self) -> Result<Box<dyn Session>, Silence> {
        Ok(Box::new(Asked::default()))
    }
}

#[derive(Debug, Default)]
struct Asked {
    variables: Vec<Variable>,
    values: Vec<i128>,
}

#[derive(Debug)]
struct Variable {
    name: String,
    is_truth: bool,
    bounds: Option<(i128, i128)>,
}

impl Session for Asked {
    fn ask(&mut self, commands: &str, _: u32, _: &mut dyn FnMut() -> bool) -> Result<String, Silence> {
        if let Some(names) = commands.strip_prefix("(get-value (") {
            let words = words(names);
            let of = |name: &String| {
                let index = self.variables.iter().position(|variable| variable.name == *name)?;
                let (variable, value) = (&self.variables[index], self.values[index]);
                let value = match (variable.is_truth, value < 0) {
                    (true, _) => (value == 1).to_string(),
                    (false, true) => format!("(- {})", value.abs()),
                    (false, false) => value.to_string(),
                };
                Some(format!("({name} {value})"))
            };
            let all: Vec<String> = words.iter().filter_map(of).collect();
            return Ok(format!("({})\n", all.join("\n ")));
        }
        Ok(format!("{}\n", self.decide(commands)))
    }
}

/// What a term is.
#[derive(Debug, Clone)]
enum Term {
    Number(i128),
    Variable(usize),
    /// One that was defined before.
    Named(usize),
    Applied(String, Vec<Term>),
}

/// The words of a text: parentheses, and what stands between them.
fn words(text: &str) -> Vec<String> {
    let mut words = Vec::new();
    let mut word = String::new();
    let mut quoted = false;
    for letter in text.lines().filter(|line| !line.starts_with(';')).flat_map(|line| line.chars().chain(['\n'])) {
        quoted ^= letter == '|';
        if !quoted && (letter.is_whitespace() || letter == '(' || letter == ')') {
            words.extend((!word.is_empty()).then(|| std::mem::take(&mut word)));
            words.extend((!letter.is_whitespace()).then(|| letter.to_string()));
        } else {
            word.push(letter);
        }
    }
    words.extend((!word.is_empty()).then_some(word));
    words
}

#[derive(Default)]
struct Reader {
    words: Vec<String>,
    at: usize,
    variables: BTreeMap<String, usize>,
    defined: BTreeMap<String, usize>,
}

impl Reader {
    fn word(&mut self) -> String {
        self.at += 1;
        self.words[self.at - 1].clone()
    }

    fn term(&mut self) -> Term {
        let word = self.word();
        if word != "(" {
            return match (&*word, self.variables.get(&word), self.defined.get(&word)) {
                ("true", ..) => Term::Number(1),
                ("false", ..) => Term::Number(0),
                (_, Some(variable), _) => Term::Variable(*variable),
                (_, _, Some(defined)) => Term::Named(*defined),
                _ => Term::Number(word.parse().unwrap_or_else(|_| panic!("{word}"))),
            };
        }
        let head = self.word();
        let mut all = Vec::new();
        while self.words[self.at] != ")" {
            all.push(self.term());
        }
        self.at += 1;
        Term::Applied(head, all)
    }
}

fn value(term: &Term, variables: &[i128], defined: &[i128]) -> i128 {
    let of = |term: &Term| value(term, variables, defined);
    match term {
        Term::Number(number) => *number,
        Term::Variable(index) => variables[*index],
        Term::Named(index) => defined[*index],
        Term::Applied(head, all) => match (&**head, &all[..]) {
            ("and", all) => i128::from(all.iter().all(|one| of(one) == 1)),
            ("or", all) => i128::from(all.iter().any(|one| of(one) == 1)),
            ("not", [a]) => 1 - of(a),
            ("=", [a, b]) => i128::from(of(a) == of(b)),
            ("<", [a, b]) => i128::from(of(a) < of(b)),
            ("<=", [a, b]) => i128::from(of(a) <= of(b)),
            ("ite", [a, b, c]) => of(if of(a) == 1 { b } else { c }),
            ("+", all) => all.iter().map(of).sum(),
            ("-", [a]) => -of(a),
            ("-", [a, b]) => of(a) - of(b),
            ("*", all) => all.iter().map(of).product(),
            ("div", [a, b]) => of(a).checked_div_euclid(of(b)).unwrap_or(0),
            ("mod", [a, b]) => of(a).checked_rem_euclid(of(b)).unwrap_or(0),
            other => panic!("{other:?}"),
        },
    }
}

impl Asked {
    fn decide(&mut self, script: &str) -> &'static str {
        let mut reader = Reader { words: words(script), ..Reader::default() };
        let (mut defined, mut asserted) = (Vec::new(), Vec::new());
        while reader.at < reader.words.len() {
            assert_eq!(reader.word(), "(");
            match &*reader.word() {
                "declare-const" => {
                    let (name, sort) = (reader.word(), reader.word());
                    let bounds = (sort == "Bool").then_some((0, 1));
                    reader.variables.insert(name.clone(), self.variables.len());
                    self.variables.push(Variable { name, is_truth: sort == "Bool", bounds });
                    reader.at += 1;
                }
                "define-fun" => {
                    let name = reader.word();
                    reader.at += 3;
                    defined.push(reader.term());
                    reader.defined.insert(name, defined.len() - 1);
                    reader.at += 1;
                }
                "assert" => {
                    let term = reader.term();
                    reader.at += 1;
                    // The bounds of a variable.
                    if let Term::Applied(head, all) = &term
                        && let ("<=", [low, Term::Variable(index), high]) = (&**head, &all[..])
                    {
                        self.variables[*index].bounds = Some((value(low, &[], &[]), value(high, &[], &[])));
                        continue;
                    }
                    asserted.push(term);
                }
                _ => while reader.word() != ")" {},
            }
        }
        let Some(bounds) = self.variables.iter().map(|variable| variable.bounds).collect::<Option<Vec<_>>>() else {
            return "unknown";
        };
        let sizes = bounds.iter().map(|(low, high)| (high - low + 1) as u64);
        if sizes.fold(1_u64, |all, size| all.saturating_mul(size)) > TRIED {
            return "unknown";
        }
        self.values = bounds.iter().map(|(low, _)| *low).collect();
        loop {
            let mut known = Vec::new();
            for term in &defined {
                known.push(value(term, &self.values, &known));
            }
            if asserted.iter().all(|term| value(term, &self.values, &known) == 1) {
                return "sat";
            }
            let Some(at) = (0..bounds.len()).find(|at| self.values[*at] < bounds[*at].1) else { return "unsat" };
            self.values[at] += 1;
            (0..at).for_each(|before| self.values[before] = bounds[before].0);
        }
    }
}

#[test]
fn it_says_what_there_is() {
    let script = "; a comment (\n(set-logic ALL)\n(declare-const |x.0@0| Int)\n(assert (<= (- 3) |x.0@0| 9))\n\
                  (declare-const |p q.1@0| Bool)\n(define-fun n7@0 () Int (mod |x.0@0| 4))\n";
    let ask = |more: &str| {
        let mut session = Asked::default();
        let mut go_on = || true;
        let said = session.ask(&format!("{script}{more}(check-sat)\n"), 1, &mut go_on).expect("it answers");
        let values = "(get-value (|x.0@0| |p q.1@0|))\n";
        let values =
            if said == "sat\n" { session.ask(values, 1, &mut go_on).expect("it answers") } else { String::new() };
        (said, values)
    };
    let (said, values) = ask("(assert (and |p q.1@0| (= n7@0 1) (< |x.0@0| 0)))\n");
    assert_eq!((&*said, &*values), ("sat\n", "((|x.0@0| (- 3))\n (|p q.1@0| true))\n"));
    assert_eq!(ask("(assert (and (= n7@0 1) (< 5 |x.0@0|) (not (= |x.0@0| 9))))\n").0, "unsat\n");
    assert_eq!(ask("(declare-const |y| Int)(assert (= |y| |y|))\n").0, "unknown\n");
}
