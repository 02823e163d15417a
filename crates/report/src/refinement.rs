//! A refinement check, ready to be shown: the verdict, what fails, and both runs on one axis.
//!
//! In: what the check found, in words, and two specifications with the values of their terms. Out: plain data for a page. INVARIANT: the
//! two machines stand in the order of the check, the abstract one first.

use crate::report::{Fact, Report};
use crate::spec::{LightsSpec, SeriesSpec, Spec, TaskSpec, TermText};

/// The verdict.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Judgement {
    /// Every run of the concrete machine corresponds to one of the abstract machine.
    Refines,
    /// It does not.
    DoesNotRefine,
    /// It is not known.
    #[default]
    NotKnown,
    /// The question says nothing.
    SaysNothing,
}

/// What the abstract machine could have done, and what is wrong with that.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Candidate {
    /// What it could have done.
    pub does: String,
    /// The parts of the coupling that fail then, each as lines.
    pub failing: Vec<Vec<String>>,
}

/// A diagram of both runs, or the rest of them.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Diagram {
    /// `m:n`, or what the row is.
    pub label: String,
    /// What each machine does, as lines.
    pub sides: [Vec<String>; 2],
    /// When it is over on the axis of both runs.
    pub tick: u64,
    /// No diagram: nothing corresponds to it.
    pub is_loose: bool,
}

/// A refinement check.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct RefinementCheck {
    /// The names of the models.
    pub models: [String; 2],
    /// The verdict.
    pub judgement: Judgement,
    /// Why, in a sentence.
    pub why: String,
    /// What was gone through: a name, a number, a remark.
    pub figures: Vec<(String, String, String)>,
    /// What the abstract machine could have done at the end.
    pub candidates: Vec<Candidate>,
    /// What else is said of the end.
    pub remarks: Vec<String>,
    /// Both runs, diagram by diagram, the initial states first.
    pub diagrams: Vec<Diagram>,
    /// Both runs on one axis, as lanes and pictures.
    pub runs: Option<Report>,
    /// All of it, as a terminal shows it.
    pub told: String,
    /// Versions, files. Added by the shell.
    pub facts: Vec<Fact>,
}

impl Spec {
    /// Two specifications as one, on an axis of steps: each name and each term gets the word of its machine before it. What only a run in
    /// its own time has (periods, deadlines, ways of data) is left out.
    ///
    /// ```
    /// let light = |term: &str| report::Spec {
    ///     tasks: vec![report::TaskSpec { name: "light".into(), activity: term.into(), ..Default::default() }],
    ///     ..Default::default()
    /// };
    /// let both = report::Spec::beside([("abstract", light("on")), ("concrete", light("lit"))]);
    /// assert_eq!(both.terms(), ["abstract.on", "concrete.lit"]);
    /// assert_eq!(both.tasks[1].name, "concrete: light");
    /// ```
    pub fn beside(machines: [(&str, Spec); 2]) -> Spec {
        let mut both = Spec::default();
        for (word, spec) in machines {
            for activity in spec.activities {
                if both.activities.iter().all(|known| known.value != activity.value) {
                    both.activities.push(activity);
                }
            }
            let term = |text: &TermText| format!("{word}.{text}");
            let named =
                |name: &str, of: &str| if name == of { term(&of.to_string()) } else { format!("{word}: {name}") };
            both.tasks.extend(spec.tasks.iter().map(|task| TaskSpec {
                name: named(&task.name, &task.activity),
                caption: task.caption.clone(),
                activity: term(&task.activity),
                ..TaskSpec::default()
            }));
            both.series.extend(spec.series.iter().map(|series| SeriesSpec {
                name: named(&series.name, &series.value),
                value: term(&series.value),
                bound: series.bound.as_ref().map(term),
                ..series.clone()
            }));
            for mut chart in spec.charts {
                chart.title = format!("{word}: {}", chart.title);
                for LightsSpec { term: at, when, .. } in &mut chart.lights {
                    *at = term(at);
                    *when = when.as_ref().map(term);
                }
                both.charts.push(chart);
            }
            both.chart_style = spec.chart_style;
        }
        both
    }
}
