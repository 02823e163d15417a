//! Charts: where each machine was, tick by tick and in sum, and what the page says of it.

use report::{ChartSpec, LightsSpec, PartSpec, ReportBuilder, Spec, render_html};

fn part(value: &str) -> PartSpec {
    PartSpec { value: value.into(), part: value.to_lowercase(), label: value.to_lowercase() }
}

fn spec() -> Spec {
    let lights = |name: &str, when: Option<&str>| LightsSpec {
        name: name.into(),
        term: "state".into(),
        when: when.map(str::to_owned),
        parts: vec![part("IDLE"), part("BUSY")],
    };
    let picture = "<svg class=\"chart\"><g data-shape=\"busy\"/></svg>".into();
    let lights = vec![lights("always", None), lights("sometimes", Some("on"))];
    Spec {
        charts: vec![ChartSpec { title: "Machine".into(), picture, lights, named: true }],
        chart_style: ".chart .lit{fill:red}".into(),
        ..Spec::default()
    }
}

#[test]
fn machines_are_where_their_terms_say() {
    let mut builder = ReportBuilder::new(spec());
    let index = |name: &str| builder.terms().iter().position(|term| term == name).expect("a term");
    let (state, on) = (index("state"), index("on"));
    for (value, holds) in [("IDLE", "true"), ("BUSY", "true"), ("BUSY", "false"), ("undef", "true"), ("BUSY", "undef")]
    {
        builder.set(state, value);
        builder.set(on, holds);
        builder.step();
    }
    let report = builder.finish("Machine");
    let [always, sometimes] = &report.charts[0].lights[..] else { panic!("two machines") };
    assert_eq!((always.shares.as_slice(), sometimes.shares.as_slice()), (&[1, 3][..], &[1, 1][..]));
    let spans: Vec<_> = always.track.spans().iter().map(|span| (span.start, span.end, span.kind)).collect();
    assert_eq!(spans, [(0, 1, 0), (1, 3, 1), (4, 5, 1)]);
    let page = render_html(&report);
    assert!(page.contains("\"d\":\"A1B2_1B1\"") && page.contains("\"d\":\"A1B1\""), "{page}");
    assert!(page.contains(".chart .lit{fill:red}") && page.contains("data-shape=\"busy\""));
}

#[test]
fn a_report_without_charts_has_nothing_of_them() {
    let page = render_html(&ReportBuilder::new(Spec::default()).finish("None"));
    assert!(!page.contains("id=\"charts\"") && !page.contains("chartbox\""));
}
