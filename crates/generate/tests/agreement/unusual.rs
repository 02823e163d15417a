//! Features that few models have: names that C++ has already, recursive rules, agents without a domain, shared
//! functions that a rule writes before they have a value.

use syntax::SourceFile;

use crate::run::Disk;
use crate::{Case, judge, prepare};

fn case(name: &str, signature: &str, definitions: &str, main: &str, initial: &str) -> Case {
    let text = format!(
        "asm {name}\n\nimport StandardLibrary\n\nsignature:\n{signature}\n\
         definitions:\n{definitions}\n\tmain rule r_Main =\n\t\t{main}\n\ndefault init s0:\n{initial}\n"
    );
    let prepared = prepare(SourceFile::new(format!("{name}.asm"), text.clone()), &mut Disk, 8, 3);
    let prepared = prepared.unwrap_or_else(|why| panic!("{name}: {why}")).expect("something to run");
    Case { name: name.to_string(), text, prepared }
}

#[test]
fn unusual_models() {
    let tree = "\tdomain Node subsetof Integer\n\tcontrolled value: Node -> Boolean\n\tderived all: Node -> Boolean\n";
    let counted = "\tcontrolled n: Integer\n\tcontrolled m: Integer\n";
    let nested = (0..12).fold("n := n + 1".to_string(), |inside, _| format!("seq {inside} n := n + m endseq"));
    let cases = vec![
        case("abs", counted, "", "n := abs(n - 7)", "\tfunction n = 3"),
        case(
            "Valued",
            tree,
            "\tdomain Node = {0 : 3}\n\tfunction all($v in Node) = value($v) and ($v = 0 or all(($v + 3) mod 4))",
            "par value(2) := all(1) value(3) := not(all(3)) endpar",
            "\tfunction value($v in Node) = true",
        ),
        case(
            "Compared",
            "\tcontrolled n: Integer\n\tcontrolled m: Integer\n\tstatic same: Integer -> Boolean\n",
            "\tfunction same($a in Integer) = $a = $a and $a <= $a",
            "if same(n) and not(n < n) and (n = m) = (n = m) and m != m then m := 1 else n := n + 1 endif",
            "\tfunction n = 3",
        ),
        case(
            "Nobody",
            "\tdomain Worker subsetof Agent\n\tdomain Place subsetof Integer\n\tstatic at: Place -> Worker\n\tcontrolled n: Integer\n",
            "\tdomain Place = {1 : 4}\n\n\trule r_work = n := n + 1\n",
            "choose $p in Place with true do program(at($p))",
            "\tfunction n = 0\n\n\tagent Worker: r_work[]",
        ),
        case(
            "Shared",
            "\tshared lamp: Boolean\n\tshared level: Integer\n\tcontrolled seen: Integer\n\tcontrolled before: Boolean\n",
            "",
            "par lamp := false if lamp then seen := level endif level := seen before := lamp endpar",
            "\tfunction seen = 4",
        ),
        case(
            "SharedInSequence",
            "\tshared lamp: Boolean\n\tcontrolled first: Boolean\n\tcontrolled second: Boolean\n",
            "",
            "seq lamp := undef first := lamp lamp := true second := lamp endseq",
            "\tfunction first = true",
        ),
        case(
            "Recursion",
            counted,
            "\tturbo rule r_fibonacci($x in Integer) in Integer =\n\t\tif $x < 2 then result := $x else let ($a = 0, $b = 0) in seq\n\
             \t\t\t$a <- r_fibonacci($x - 1)\n\t\t\t$b <- r_fibonacci($x - 2)\n\t\t\tresult := $a + $b\n\t\tendseq endlet endif\n",
            "par n <- r_fibonacci(m) m := m + 3 endpar",
            "\tfunction m = 2",
        ),
        case(
            "Coerced",
            "\tmonitored given: Integer\n\tcontrolled sum: Real\n",
            "",
            "sum := sum + given * 0.5",
            "\tfunction sum = 0.0",
        ),
        case("Nested", counted, "", &format!("par {nested} m := m + 1 endpar"), "\tfunction n = 0\n\tfunction m = 1"),
    ];
    judge("unusual", cases);
}
