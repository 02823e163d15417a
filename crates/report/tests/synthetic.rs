//! The made-up run, checked figure by figure, drawing by drawing.

use crate::fixture;

use expect_test::{expect, expect_file};
use report::{ReportBuilder, Spec, SummaryOptions, SvgOptions, render_html, render_svg, summarise};

/// Style and script are files of their own; what is compared is what a run makes.
fn without_constants(page: &str) -> String {
    let mut out = String::new();
    let mut rest = page;
    for (open, close) in [("<style>", "</style>"), ("<script>", "</script>")] {
        let (before, after) = rest.split_once(open).expect("the element");
        let (_, after) = after.split_once(close).expect("its end");
        out.push_str(before);
        out.push_str(open);
        out.push_str(close);
        rest = after;
    }
    out + rest
}

#[test]
fn a_short_run_as_a_page() {
    let page = render_html(&fixture::report(150));
    expect_file!["golden/page.html"].assert_eq(&without_constants(&page));
}

#[test]
fn a_short_run_as_a_picture() {
    let options = SvgOptions { ticks: 100, width: 800, ..SvgOptions::default() };
    let picture = render_svg(&fixture::report(150), &options);
    let (before, after) = picture.split_once("<style>").unwrap();
    expect_file!["golden/picture.svg"]
        .assert_eq(&format!("{before}<style>{}", after.split_once("</style>").unwrap().1));
}

#[test]
fn a_second_in_short() {
    let text = summarise(&fixture::report(10_000), &SummaryOptions::default());
    expect_file!["golden/summary.txt"].assert_eq(&text);
}

#[test]
fn the_same_run_gives_the_same_bytes() {
    let (one, other) = (fixture::report(2_000), fixture::report(2_000));
    assert_eq!(render_html(&one), render_html(&other));
    assert_eq!(render_svg(&one, &SvgOptions::default()), render_svg(&other, &SvgOptions::default()));
}

#[test]
fn a_second_stays_small() {
    let size = render_html(&fixture::report(10_000)).len();
    assert!(size < 3_000_000, "{size} bytes");
}

#[test]
fn figures_do_not_depend_on_what_is_shown() {
    let (all, few) = (fixture::report(3_000), shown(3_000, 500));
    assert_eq!((few.shown, few.ticks), (500, 3_000));
    for (all, few) in all.tasks.iter().zip(&few.tasks) {
        assert_eq!((&all.shares, &all.waits, &all.cycles, all.met), (&few.shares, &few.waits, &few.cycles, few.met));
        assert!(few.track.spans().last().unwrap().end <= 500);
    }
    assert_eq!(all.series[0].values, few.series[0].values);
    assert_eq!(all.flow.as_ref().unwrap().whole, few.flow.as_ref().unwrap().whole);
    assert!(render_html(&few).contains("The lanes show the first"));
}

fn shown(ticks: u64, shown: u64) -> report::Report {
    let mut run = fixture::Run::new();
    let mut builder = ReportBuilder::new(fixture::spec()).show_ticks(shown);
    let terms = builder.terms().to_vec();
    let hand_in = |run: &fixture::Run, builder: &mut ReportBuilder| {
        terms.iter().enumerate().for_each(|(index, term)| builder.set(index, &run.value(term)));
    };
    hand_in(&run, &mut builder);
    builder.begin();
    for _ in 0..ticks {
        run.step();
        hand_in(&run, &mut builder);
        builder.step();
    }
    builder.finish("FiveTasks")
}

#[test]
fn nothing_to_show_is_shown_as_well() {
    let report = ReportBuilder::new(Spec::default()).finish("Nothing");
    expect![[r#"
        Nothing
        Nothing: 0 steps


        ? Nothing was checked: the run has no invariants, no deadlines, no bounds and no scenarios.
    "#]]
    .assert_eq(&summarise(&report, &SummaryOptions::default()));
    render_html(&report);
    render_svg(&report, &SvgOptions::default());
}
