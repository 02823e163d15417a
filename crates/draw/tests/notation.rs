//! Other tools' notations: what a label holds cannot be taken for markup.

use chart::read;
use draw::{Notation, drawings, export};
use syntax::{FileId, parse_chart};

#[test]
fn labels_of_mermaid_say_nothing_but_themselves() {
    let text = "chart C machine m control x initial state a \"<script>alert(1)</script> #quot; `x` & y\" {A} \
         state b action f {x := \"<b>;\"} a -> f -> b endmachine";
    let (chart, _) = read(FileId(0), &parse_chart(FileId(0), text));
    let text = export(&drawings(&chart)[0], Notation::Mermaid).expect("it is a machine");
    let label = text.lines().find(|line| line.starts_with("  n0")).expect("a node");
    let label = label.replace("<br/>", "").replace("<small>", "").replace("</small>", "");
    assert!(!label.contains(['<', '>', '&', '`']) && label.matches('"').count() == 2, "{label}");
    assert!(label.contains("#35;quot#59;") && label.contains("#60;script#62;"), "{label}");
}
