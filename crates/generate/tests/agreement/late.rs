//! Late initial values: of elements made by a step, read in a state that is no longer the initial one.

use syntax::SourceFile;

use crate::run::Disk;
use crate::{Case, judge, prepare};

fn case(name: &str, main: &str, initial: &str) -> Case {
    let text = format!(
        "asm Late\n\nimport StandardLibrary\n\nsignature:\n\tdynamic abstract domain Item\n\tcontrolled base: Integer\n\
         \tcontrolled weight: Item -> Integer\n\tcontrolled price: Item -> Integer\n\tcontrolled last: Item\n\
         \tcontrolled sum: Integer\n\tstatic first: Item\n\n\
         definitions:\n\tmain rule r_Main =\n\t\t{main}\n\n\
         default init s0:\n\tfunction base = 5\n\tfunction sum = 0\n\tfunction weight($i in Item) = base * 2\n\
         \tfunction price($i in Item) = {initial}\n"
    );
    match prepare(SourceFile::new("Late.asm", text.clone()), &mut Disk, 8, 1) {
        Ok(Some(prepared)) => {
            assert!(
                !prepared.expected.contains("fault") && prepared.expected.contains("price (o"),
                "{name}: {}",
                prepared.expected
            );
            Case { name: name.to_string(), text, prepared }
        }
        Ok(None) => panic!("{name}: nothing to run"),
        Err(why) => panic!("{name}: {why}"),
    }
}

#[test]
fn late_initial_values() {
    let grows = "par base := base + 10 if isDef(last) then sum := sum + price(last) endif \
                 extend Item with $i do last := $i endpar";
    let in_sequence = "seq base := base + 10 extend Item with $i do last := $i sum := sum + price(last) endseq";
    let written = "par base := base + 10 if isDef(last) then par price(last) := 1 + price(last) \
                   sum := sum + price(last) endpar endif if base mod 20 = 5 then extend Item with $i do last := $i endif endpar";
    judge(
        "late",
        vec![
            case("of one location", grows, "base"),
            case("through another late one", grows, "weight($i) + base"),
            case("through a growing domain", grows, "size({$j in Item: $j}) + base"),
            case("in a part of a sequence", in_sequence, "weight($i) + base"),
            case("updated before it is read", written, "weight($i) + base"),
        ],
    );
}

/// This holds also if a value depends on inputs.
#[test]
fn initial_values_come_after_those_that_they_read() {
    let text = "asm Order\n\nimport StandardLibrary\n\nsignature:\n\tmonitored asked: Boolean\n\tcontrolled start: Integer\n\
                \tcontrolled first: Integer\n\ndefinitions:\n\tmain rule r_Main =\n\t\tstart := start + first\n\n\
                default init s0:\n\tfunction start = if asked then first else first * 3 endif\n\tfunction first = 5\n";
    let prepared = prepare(SourceFile::new("Order.asm", text), &mut Disk, 4, 1);
    let prepared = prepared.unwrap_or_else(|why| panic!("{why}")).expect("something to run");
    assert!(!prepared.expected.contains("fault"), "{}", prepared.expected);
    judge("order", vec![Case { name: "order".to_string(), text: text.to_string(), prepared }]);
}
