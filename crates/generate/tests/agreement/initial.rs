//! Initial values that ask the environment for inputs, choices or the clock.

use syntax::SourceFile;

use crate::run::Disk;
use crate::{Case, judge, prepare};

fn case(name: &str, declarations: &str, main: &str, initial: &str) -> Case {
    let text = format!(
        "asm Initial\n\nimport StandardLibrary\n\nsignature:\n{declarations}\n\
         definitions:\n\tmain rule r_Main =\n\t\t{main}\n\ndefault init s0:\n{initial}\n"
    );
    let prepared = prepare(SourceFile::new("Initial.asm", text.clone()), &mut Disk, 6, 3);
    let prepared = prepared.unwrap_or_else(|why| panic!("{name}: {why}")).expect("something to run");
    assert!(!prepared.expected.contains("fault"), "{name}: {}", prepared.expected);
    Case { name: name.to_string(), text, prepared }
}

#[test]
fn initial_values_from_outside() {
    let chosen =
        "\tenum domain Shape = {ROUND | FLAT | LONG}\n\tcontrolled shape: Shape\n\tcontrolled size: Shape -> Integer\n";
    let judged = [
        case(
            "one choice",
            chosen,
            "shape := chooseone({$s in Shape | $s != shape : $s})",
            "\tfunction shape = chooseone({FLAT, LONG})",
        ),
        case(
            "a choice for each location",
            chosen,
            "forall $s in Shape do size($s) := size($s) + 1",
            "\tfunction size($s in Shape) = chooseone({10, 20, 30})\n\tfunction shape = chooseone({ROUND, LONG})",
        ),
        case(
            "late, of inputs",
            "\tmonitored first: Integer\n\tmonitored other: Natural -> Integer\n\tcontrolled start: Integer\n\tcontrolled n: Natural\n\
             \tcontrolled early: Natural -> Integer\n\tcontrolled late: Natural -> Integer\n\tcontrolled sum: Integer\n",
            "par n := n + 1n sum := early(n) + late(n) + first late(n + 3n) := late(n + 3n) + first endpar",
            "\tfunction start = first\n\tfunction n = 0n\n\tfunction early($x in Natural) = first + ntoi($x)\n\
             \tfunction late($x in Natural) = other($x) + early($x)",
        ),
    ];
    judge("initial", Vec::from(judged));
}
