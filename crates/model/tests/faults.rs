//! Each fault that checking may report has a page `spec/faults/<id>.md`, and the page's example yields that fault.

use crate::support::{check_file, faults};
use expect_test::expect_file;
use model::IDS;
use syntax::Severity;
use testkit::Page;
use testkit::page::Block;

struct Example {
    id: String,
    /// The name and text of the example.
    example: (String, String),
    /// The page says that the fault is a warning.
    warning: bool,
    /// Files that it imports.
    others: Vec<(String, String)>,
}

fn page(id: &str) -> Example {
    let page = Page::fault(id);
    let mut example = None;
    let mut others = Vec::new();
    for block in page.blocks().into_iter().filter(|block| block.info.starts_with("asmetal")) {
        let Block { info, text: code, .. } = block;
        let named = info.split_whitespace().find_map(|word| word.strip_prefix("file="));
        match info.contains("fault") {
            true => {
                let own = code.split_whitespace().skip_while(|word| !matches!(*word, "asm" | "module")).nth(1);
                let name = named.map(str::to_string).unwrap_or_else(|| format!("{}.asm", own.unwrap_or("example")));
                example = Some((name, code.to_string()));
            }
            false => others.push((named.expect("a file name").to_string(), code.to_string())),
        }
    }
    let warning = page.text.contains("\n*A warning.* ");
    Example {
        id: id.to_string(),
        warning,
        example: example.unwrap_or_else(|| panic!("the page of {id} has no example")),
        others,
    }
}

#[test]
fn each_id_has_a_page_whose_example_yields_it_and_nothing_else() {
    let mut trouble = String::new();
    for id in IDS {
        let Example { id, example: (name, text), warning, others } = page(id);
        let mut others: Vec<(&str, &str)> = others.iter().map(|(name, text)| (name.as_str(), text.as_str())).collect();
        others.push((&name, &text));
        let checked = check_file(&name, &text, &others);
        let found: Vec<&str> = checked.diagnostics.iter().map(|fault| fault.id).collect();
        let severity = if warning { Severity::Warning } else { Severity::Error };
        if found != [id.as_str()] || checked.diagnostics[0].severity != severity {
            trouble += &format!("{id}: {found:?}\n{}\n", faults(&checked));
        }
    }
    assert!(trouble.is_empty(), "{trouble}");
}

#[test]
fn the_wording_of_each_fault() {
    let mut all = String::new();
    for id in IDS {
        let Example { example: (name, text), mut others, .. } = page(id);
        others.push((name.clone(), text.clone()));
        let others: Vec<(&str, &str)> = others.iter().map(|(name, text)| (name.as_str(), text.as_str())).collect();
        all += &format!("{}\n", faults(&check_file(&name, &text, &others)));
    }
    expect_file!["faults.txt"].assert_eq(&all);
}

#[test]
fn every_fault_says_what_to_do() {
    for id in IDS {
        let Example { example: (name, text), others, .. } = page(id);
        let others: Vec<(&str, &str)> = others.iter().map(|(name, text)| (name.as_str(), text.as_str())).collect();
        for fault in check_file(&name, &text, &others).diagnostics {
            assert!(fault.help.is_some(), "{id} has no help");
            let first = fault.message.chars().next().unwrap_or(' ');
            assert!(!first.is_uppercase() && !fault.message.ends_with('.'), "{id}: {}", fault.message);
        }
    }
}
