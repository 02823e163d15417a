//! The page is well-formed, self-contained and safe, whatever the names are.

use crate::fixture;

use report::{
    Coverage, Fact, Invariant, Measure, Report, Scenario, SummaryOptions, SvgOptions, Verdict, render_html, render_svg,
    summarise,
};

/// A page without what is raw text in HTML, which must parse as XML.
fn as_xml(page: &str) -> String {
    let mut out = String::new();
    let mut rest = page.strip_prefix("<!DOCTYPE html>").expect("the doctype");
    while let Some(at) = rest.find("<style").into_iter().chain(rest.find("<script")).min() {
        let close = if rest[at..].starts_with("<style") { "</style>" } else { "</script>" };
        let (inside, after) = rest[at..].split_once(close).expect("its end");
        assert!(!inside.contains("<!--"));
        out.push_str(&rest[..at]);
        rest = after;
    }
    out + rest
}

fn hostile(name: &str) -> Report {
    let mut spec = fixture::spec();
    spec.title = name.into();
    spec.note = name.into();
    spec.activities.iter_mut().for_each(|activity| activity.label.push_str(name));
    for task in &mut spec.tasks {
        task.name.push_str(name);
        task.caption = name.into();
    }
    for buffer in &mut spec.buffers {
        buffer.from.push_str(name);
        buffer.to.push_str(name);
        buffer.counters.iter_mut().for_each(|counter| counter.label.push_str(name));
    }
    spec.series.iter_mut().for_each(|series| (series.name, series.caption) = (name.into(), name.into()));
    for chart in &mut spec.charts {
        chart.title = name.into();
        for lights in &mut chart.lights {
            lights.name = name.into();
            lights.parts.iter_mut().for_each(|part| part.label.push_str(name));
        }
    }
    if let Some(flow) = &mut spec.flow {
        flow.noun = (name.into(), name.into());
        flow.hops.iter_mut().for_each(|hop| {
            hop.task.push_str(name);
            hop.event.push_str(name);
        });
    }
    let mut report = fixture::report_of(spec, 300);
    report.model = name.into();
    report.stopped = Some(name.into());
    report.invariants = vec![Invariant { name: name.into(), position: name.into(), violated: Some(name.into()) }];
    let verdict = Verdict::Failed(name.into());
    report.scenarios = vec![Scenario { name: name.into(), file: name.into(), steps: 1, checks: 1, verdict }];
    let measure = Measure { what: name.into(), covered: 1, total: 2, missed: vec![(name.into(), name.into())] };
    report.coverage = Some(Coverage { scope: name.into(), measures: vec![measure] });
    report.facts = vec![Fact { label: name.into(), value: name.into() }];
    report
}

#[test]
fn names_stay_names() {
    let name = "</script><script>alert('x')</script><img src=x onerror=alert(1)> & \"quoted\" \u{1}";
    let report = hostile(name);
    let page = render_html(&report);
    let document = as_xml(&page);
    let document = roxmltree::Document::parse(&document).expect("well-formed");
    assert!(!document.descendants().any(|node| node.has_tag_name("img") || node.attribute("onerror").is_some()));
    assert_eq!(page.matches("<script").count(), 2, "data and script, nothing else");
    assert_eq!(page.matches("</script>").count(), 2);
    let picture = render_svg(&report, &SvgOptions::default());
    let picture = roxmltree::Document::parse(&picture).expect("well-formed");
    assert!(!picture.descendants().any(|node| ["img", "script"].contains(&node.tag_name().name())));
    assert!(summarise(&report, &SummaryOptions::default()).contains("alert"));
}

#[test]
fn a_whole_second_is_well_formed() {
    let report = fixture::report(10_000);
    let page = as_xml(&render_html(&report));
    let document = roxmltree::Document::parse(&page).expect("well-formed");
    let mut ids = Vec::new();
    for node in document.descendants().filter(|node| node.is_element()) {
        if let Some(id) = node.attribute("id") {
            assert!(!ids.contains(&id), "id {id} twice");
            ids.push(id);
        }
        for name in ["href", "src", "xlink:href"] {
            let found = node.attribute(name);
            assert!(found.is_none_or(|target| target.starts_with('#')), "{name}={found:?} leads out of the page");
        }
    }
    for label in document.descendants().filter_map(|node| node.attribute("aria-labelledby")) {
        assert!(label.split(' ').all(|id| ids.contains(&id)), "{label}");
    }
    for target in document.descendants().filter_map(|node| node.attribute("href")) {
        assert!(ids.contains(&target.trim_start_matches('#')), "{target}");
    }
}

#[test]
fn nothing_is_fetched() {
    let page = render_html(&fixture::report(200));
    for word in ["http://", "https://", "@import", "url(", "fetch(", "XMLHttpRequest", "import("] {
        let allowed = if word == "url(" { page.matches("url(#").count() } else { 0 };
        assert_eq!(page.matches(word).count(), allowed, "{word}");
    }
}

#[test]
fn every_drawing_says_what_it_is() {
    let page = as_xml(&render_html(&fixture::report(1_000)));
    let document = roxmltree::Document::parse(&page).expect("well-formed");
    let drawings = document.descendants().filter(|node| node.has_tag_name("svg"));
    for drawing in drawings {
        let titled = drawing.children().any(|child| child.has_tag_name("title"));
        assert!(titled && drawing.attribute("role") == Some("img"), "{:?}", drawing.attribute("id"));
    }
}

#[test]
fn what_went_wrong_comes_first() {
    let mut report = fixture::report(300);
    report.tasks[0].missed = Some(2);
    report.series[0].bound = Some(7);
    report.stopped = Some("the update set clashed in step 301".into());
    let troubles = report.troubles();
    assert_eq!(troubles[0], "the update set clashed in step 301");
    assert!(troubles.iter().any(|text| text == "camera missed 2 deadlines"));
    assert!(troubles.iter().any(|text| text.starts_with("Age of data reached ")));
    let page = render_html(&report);
    let (head, _) = page.split_once("<main>").unwrap();
    assert!(troubles.iter().all(|text| head.contains(text.as_str())));
    assert!(!page.contains("Everything that was checked held"));
}
