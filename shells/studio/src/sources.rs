//! Which texts of the folder a job looks at, and what they are when it begins. Whoever shows its result later can tell whether it is of the
//! texts as they are then.
//!
//! In: a job and its file; the chart that the user had in front, if the job is of its model. Out: paths and hashes; of scenarios, the model
//! that each loads. INVARIANT: a text of the folder that decides the result is among them. A model that a job writes itself is not: it
//! would be another each time.

use std::collections::BTreeSet;
use std::path::Path;

use groundstate::syntax::ast::{AstNode, ScenarioFile};
use groundstate::syntax::{SourceFile, Sources, parse_avalla};
use groundstate::workspace::{Absent, Files, imported};
use groundstate::{Kind, Suite, Workspace};
use serde_json::{Value, json};

use crate::folder::Folder;
use crate::studio::Studio;

/// The folder's texts by the names that browsers use; what lies elsewhere is not there.
pub struct Inside<'f>(pub &'f Folder);

impl Files for Inside<'_> {
    fn read(&mut self, path: &str) -> Result<SourceFile, Absent> {
        if self.0.place(path).is_err() {
            return Err(Absent::Missing);
        }
        match self.0.read(path) {
            Ok(Some(text)) => Ok(SourceFile::new(path, text)),
            Ok(None) => Err(Absent::Missing),
            Err(reason) => Err(Absent::Unreadable(reason)),
        }
    }
}

/// The texts that a job looks at, each with its hash now; null if there is none. From now on tabs are told when one of them is another.
///
/// # Errors
/// One cannot be read; a sentence.
pub fn known(studio: &Studio, paths: &BTreeSet<String>) -> Result<Value, String> {
    let mut store = studio.store();
    let of = |path: &String| {
        let hash = store.read(&studio.folder, path)?.map(|(_, hash)| hash);
        Ok::<Value, String>(json!({ "path": path, "hash": hash }))
    };
    Ok(Value::from(paths.iter().map(of).collect::<Result<Vec<_>, _>>()?))
}

/// The paths of the texts that a job looks at.
pub fn of_job(folder: &Folder, job: &str, path: &str, scenarios: &[String], chart: Option<&str>) -> BTreeSet<String> {
    let mut workspace = Workspace::new(Inside(folder));
    let mut found = BTreeSet::new();
    let mut read = |path: &str, is_compared: bool| {
        // What is wrong with a text does not matter here.
        let (_, reads) = workspace.reading(|workspace| workspace.check(path).is_ok());
        let own = Path::new(path).with_extension("asm").to_string_lossy().into_owned();
        let is_made = |name: &str| Kind::of(Path::new(path)) == Some(Kind::Chart) && !is_compared && name == own;
        found.extend(reads.into_iter().filter(|(name, text)| text.is_some() && !is_made(name)).map(|(name, _)| name));
    };
    read(path, job == "check");
    chart.into_iter().for_each(|chart| read(chart, false));
    if !scenarios.is_empty() {
        let mut suite = Suite::new();
        let (_, reads) = workspace.reading(|workspace| {
            for scenario in scenarios {
                if let Ok(source) = workspace.text(scenario) {
                    suite.check(source, &mut workspace.texts());
                }
            }
        });
        found.extend(reads.into_iter().filter(|(_, text)| text.is_some()).map(|(name, _)| name));
    }
    found.insert(path.to_string());
    found.extend(specifications(job, path, &found));
    found
}

/// What says beside a model or a chart what to verify; it may not be there yet.
fn specifications(job: &str, path: &str, found: &BTreeSet<String>) -> Vec<String> {
    let beside = |path: &str| Path::new(path).with_extension("verify.yaml").to_string_lossy().into_owned();
    match job {
        "verify" | "review" | "mutate" | "graph" => vec![beside(path)],
        // Those of both machines.
        "refine" => found.iter().filter(|name| name.ends_with(".asm")).map(|name| beside(name)).collect(),
        _ => Vec::new(),
    }
}

/// The model that each scenario loads, as browsers name it; null if it is none of the folder.
pub fn loads(folder: &Folder, scenarios: &[String]) -> Value {
    let of = |scenario: &String| {
        let mut files = Inside(folder);
        let source = files.read(scenario).ok()?;
        let file = Sources::default().add(source.clone());
        let path = ScenarioFile::cast(parse_avalla(file, &source.text).syntax())?.model_path()?;
        imported(&mut files, &source, &path).ok().map(|model| model.name)
    };
    scenarios.iter().map(|scenario| json!({ "scenario": scenario, "model": of(scenario) })).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    const CHART: &str =
        "chart Lamp\n\nmachine lamp \"Lamp\"\n\tcontrol light\n\tinitial state off \"Off\"\nendmachine\n";
    const MODEL: &str =
        "asm Lamp\nimport StandardLibrary\nimport data/Kinds\nsignature:\ndefinitions:\n\tmain rule r_m = skip\n";

    #[test]
    fn what_decides_a_result_is_among_its_texts() {
        let place = tempfile::tempdir().expect("a folder");
        let kinds = "module Kinds\nimport ../../outside/Secret\nsignature:\ndefinitions:\n";
        for (name, text) in [
            ("a/Lamp.chart", CHART),
            ("a/Lamp.asm", MODEL),
            ("a/data/Kinds.asm", kinds),
            ("a/Other.asm", "asm Other\nsignature:\ndefinitions:\n\tmain rule r_m = skip\n"),
            ("a/On.avalla", "scenario On\nload Lamp.asm\nstep\n"),
            ("a/Elsewhere.avalla", "scenario Elsewhere\nload ../../Outside.asm\nstep\n"),
        ] {
            let file = place.path().join(name);
            std::fs::create_dir_all(file.parent().expect("it has one")).expect("made");
            std::fs::write(file, text).expect("written");
        }
        let folder = Folder::at(place.path()).expect("it is one");
        let scenarios = ["a/Elsewhere.avalla".to_string(), "a/On.avalla".to_string()];
        let check = |job: &str, path: &str, scenarios: &[String], chart: Option<&str>, expected: &str| {
            let found: Vec<String> = of_job(&folder, job, path, scenarios, chart).into_iter().collect();
            assert_eq!(found.join(" "), expected, "{job} {path}");
        };
        check("verify", "a/Lamp.asm", &[], None, "a/Lamp.asm a/Lamp.verify.yaml a/data/Kinds.asm");
        check(
            "verify",
            "a/Lamp.asm",
            &[],
            Some("a/Lamp.chart"),
            "a/Lamp.asm a/Lamp.chart a/Lamp.verify.yaml a/data/Kinds.asm",
        );
        // The model that is built is no text that it is built from, though what it imports is; one that is compared is.
        check("build", "a/Lamp.chart", &[], None, "a/Lamp.chart a/data/Kinds.asm");
        check("check", "a/Lamp.chart", &[], None, "a/Lamp.asm a/Lamp.chart a/data/Kinds.asm");
        check(
            "test",
            "a/Other.asm",
            &scenarios,
            None,
            "a/Elsewhere.avalla a/Lamp.asm a/On.avalla a/Other.asm a/data/Kinds.asm",
        );
        assert_eq!(
            loads(&folder, &scenarios),
            json!([
                { "scenario": "a/Elsewhere.avalla", "model": null },
                { "scenario": "a/On.avalla", "model": "a/Lamp.asm" },
            ])
        );
    }
}
