//! What a worker is asked and what it answers.
//!
//! A job is one recorded result; an answer says whether ours is the same and, if not, how it differs and for which
//! reason. Both travel as one line of JSON between the command and its workers ([`super::pool`]).

use serde::{Deserialize, Serialize};

/// One recorded result to compare with.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub enum Job {
    /// A model that the peer accepted or refused.
    Accept {
        /// The model.
        path: String,
        /// The peer accepted it.
        accepted: bool,
        /// Why it refused.
        message: String,
    },
    /// A recorded trace.
    Replay {
        /// Which of the three kinds of trace.
        kind: String,
        /// The trace's file.
        file: String,
        /// The model.
        path: String,
        /// The folder that the run is written to if it comes out as recorded.
        scripts: Option<String>,
    },
    /// A model or scenario to run, whatever its recorded result.
    Explore {
        /// The model or scenario.
        path: String,
        /// There is a recorded result for it.
        recorded: bool,
    },
    /// A scenario's verdict.
    Scenario {
        /// The scenario.
        path: String,
        /// `PASS`, `FAIL`, `ERROR`.
        status: String,
        /// What the peer said.
        message: String,
        /// How many checks it found to hold.
        checks: u64,
    },
}

impl Job {
    /// What the job is about: a path in the checkout.
    pub fn subject(&self) -> &str {
        match self {
            Job::Accept { path, .. }
            | Job::Replay { path, .. }
            | Job::Explore { path, .. }
            | Job::Scenario { path, .. } => path,
        }
    }

    /// The section of the report it belongs to.
    pub fn section(&self) -> &str {
        match self {
            Job::Accept { .. } => "accept",
            Job::Replay { kind, .. } => kind,
            Job::Explore { .. } => "explore",
            Job::Scenario { .. } => "scenario",
        }
    }
}

/// What came of a job.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub enum Answer {
    /// The same.
    Same {
        /// What is worth telling all the same.
        note: Option<String>,
    },
    /// Not the same.
    Different {
        /// The names of the reasons; none where it is not explained.
        reasons: Vec<String>,
        /// How it differs.
        detail: String,
    },
    /// Run without anything to compare with.
    Explored {
        /// How far it came.
        outcome: String,
        /// What there is to say of it.
        detail: String,
    },
    /// Nothing to compare: the peer's result says nothing of the model.
    Void {
        /// Why.
        why: String,
    },
    /// Our code panicked or its process died.
    Panic {
        /// Where.
        detail: String,
    },
    /// It took too long.
    Timeout,
}

impl Answer {
    /// The same, with nothing to tell.
    pub fn same() -> Answer {
        Answer::Same { note: None }
    }

    /// Not the same, for one reason or none that is known.
    pub fn different(reason: Option<&str>, detail: String) -> Answer {
        Answer::Different { reasons: reason.into_iter().map(String::from).collect(), detail }
    }
}
