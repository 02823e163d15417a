//! Any text is parsed without a panic, and its tree holds it: token soup, and programs with random wounds.

use proptest::prelude::*;
use syntax::assert_invariants;

const PIECES: &[&str] = &[
    "asm a\n",
    "module",
    "asyncr",
    "import ../X\n",
    "export *",
    "signature:",
    "definitions:",
    "default init s0:",
    "init",
    "agent",
    "invariant over",
    "CTLSPEC",
    "LTLSPEC ltlSpec_a:",
    "JUSTICE",
    "INVAR",
    "COMPASSION (",
    "function f",
    "static f:",
    "dynamic",
    "derived",
    "controlled x:",
    "monitored",
    "shared",
    "out",
    "local",
    "domain D",
    "anydomain",
    "basic",
    "abstract",
    "enum domain",
    "subsetof",
    "Prod(",
    "Seq(",
    "Powerset",
    "Bag",
    "Map(",
    "Rule",
    "true",
    "undef",
    "if",
    "then",
    "else",
    "elseif",
    "endif",
    "switch",
    "case",
    "otherwise",
    "endswitch",
    "let (",
    "endlet",
    "in",
    "notin",
    "exists",
    "unique",
    "with",
    "forall",
    "skip",
    "rule r_x =",
    "macro",
    "turbo",
    "main",
    "par",
    "endpar",
    "choose",
    "do",
    "ifnone",
    "extend",
    "seq",
    "endseq",
    "iterate",
    "enditerate",
    "while",
    "whilerec",
    "scenario s",
    "load x.asm",
    "check",
    "strict",
    "set",
    "step",
    "until",
    "within",
    "exec",
    "pick",
    "begin b",
    "end",
    "execblock",
    "expect",
    "failure",
    "by",
    "inconsistent update",
    "error",
    "$x",
    "$",
    "RED",
    "Red",
    "r_x",
    "inv_x",
    "f",
    "mod",
    "and",
    "or",
    "not",
    "implies",
    "i",
    "i2.5",
    "12",
    "3n",
    "4.5",
    "2.5i3",
    "1e5",
    "'a'",
    "'",
    "\"s\"",
    "\"",
    "\\",
    "(",
    ")",
    "[",
    "]",
    "{",
    "}",
    ",",
    ":",
    ";",
    ".",
    "..",
    "|",
    ":=",
    "->",
    "<-",
    "=",
    "!=",
    "<",
    "<=",
    ">",
    ">=",
    "<<",
    ">>",
    "+",
    "-",
    "*",
    "/",
    "^",
    "==",
    "&&",
    "!",
    "%",
    "≠",
    "é",
    "größe",
    "@",
    "#x",
    "//c\n",
    "/*c*/",
    "/*",
    "\n",
    "\t",
    " ",
    "\r\n",
    "\u{FEFF}",
    "\u{0}",
    "endforall",
    "elif",
    "<>",
];

const MODEL: &str = "asm Example
import ../StandardLibrary (Integer, eq)
export *
signature:
  enum domain Colour = {RED | GREEN, BLUE}
  domain Small subsetof Integer
  dynamic controlled colour: Prod(Small, Integer) -> Powerset(Colour)
  monitored go: Boolean
definitions:
  domain Small = {-3 : 5, 2}
  function f($a in Integer) = if $a > 3 then {1, 2} elseif go then [$x in {1:3} | $x > 1 : $x] else <1, -2> endif
  turbo rule r_t($a in Integer) in Integer = local g: Integer [ g := 1 ] result := g
  rule r_a($x in Small) = par
    forall $y in Small with not $y = 3 and (exists $z in Small with $z<-1) do colour($y, 1) := {RED}
    choose $c in Colour do skip ifnone r_b[]
    switch $x case 1: x <- r_t(1) otherwise seq skip program(self) endseq endswitch
    let ($v = {1 -> 2}) in iterate f($v)[1] enditerate endlet
    extend Agents with $n do while $x implies 2.5i3 do $r[<<r_a(Small)>>]
  endpar
  invariant inv_a over colour(Small), Small, r_a: true
  CTLSPEC ctlSpec_a: ag(go)
  main rule r_Main = r_a[1]
default init s0:
  function colour($x in Small, $y in Integer) = {->}
  agent Agents: r_a[1]
";

const SCENARIO: &str = "scenario s
load Example.asm
expect failure by invariant inv_a;
invariant a: f(1) > 2;
set go := true;
step 3
begin b
  check go and f = {1};
  step until x = 3 within 5;
end
pick $c in r_a(Small) := RED;
exec par x := 1 y := 2 endpar;
execblock other:b;
strict check true;
expect inconsistent update;
";

#[test]
fn the_originals_are_sound() {
    for text in [MODEL, SCENARIO] {
        assert_invariants(text.as_bytes());
    }
    let model = syntax::parse_asmetal(syntax::FileId(0), MODEL);
    assert_eq!(model.diagnostics, []);
    let scenario = syntax::parse_avalla(syntax::FileId(0), SCENARIO);
    assert_eq!(scenario.diagnostics, []);
}

/// A wound: at a place, so many bytes are replaced by pieces.
fn wounded(text: &str, wounds: &[(prop::sample::Index, usize, Vec<usize>)]) -> Vec<u8> {
    let mut bytes = text.as_bytes().to_vec();
    for (place, length, pieces) in wounds {
        let start = place.index(bytes.len() + 1);
        let end = (start + length).min(bytes.len());
        let new: String = pieces.iter().map(|piece| PIECES[*piece]).collect();
        bytes.splice(start..end, new.into_bytes());
    }
    bytes
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 300, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn token_soup(pieces in prop::collection::vec((0..PIECES.len(), any::<bool>()), 0..120)) {
        let text: String =
            pieces.iter().flat_map(|(piece, space)| [PIECES[*piece], if *space { " " } else { "" }]).collect();
        assert_invariants(text.as_bytes());
    }

    #[test]
    fn bytes(bytes in prop::collection::vec(any::<u8>(), 0..300)) {
        assert_invariants(&bytes);
    }

    #[test]
    fn wounded_programs(
        scenario in any::<bool>(),
        wounds in prop::collection::vec(
            (any::<prop::sample::Index>(), 0..30usize, prop::collection::vec(0..PIECES.len(), 0..3)), 1..6),
    ) {
        assert_invariants(&wounded(if scenario { SCENARIO } else { MODEL }, &wounds));
    }
}
