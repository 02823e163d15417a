//! A mutation analysis, as its page shows it: plain data, whoever made the mutants.
//!
//! In: what a facade fills in. Out: [`crate::render_mutation`] draws it. INVARIANT: every mutant is of one of the files, and its lines are
//! lines of that file's text.

/// A mutation analysis.
#[derive(Debug, Clone, Default)]
pub struct MutationAnalysis {
    /// What was mutated, in a word or two.
    pub title: String,
    /// The score: killed among those killed or survived, in percent; none without any.
    pub score: Option<f64>,
    /// Of a sample: between which percentages the score of all lies, with a probability of 95 %.
    pub interval: Option<(f64, f64)>,
    /// How many mutants there are, of which these may be a sample.
    pub total: usize,
    /// The models that judged by their properties.
    pub models: Vec<String>,
    /// The scenarios that judged.
    pub scenarios: Vec<String>,
    /// The couplings that judged, if refinements do.
    pub couplings: Option<Vec<String>>,
    /// The mutated texts.
    pub files: Vec<MutatedFile>,
    /// The mutants, the most surprising survivors first.
    pub mutants: Vec<JudgedMutant>,
}

/// A text with mutants.
#[derive(Debug, Clone)]
pub struct MutatedFile {
    /// Its path.
    pub path: String,
    /// Its text.
    pub text: String,
}

/// A mutant and what became of it.
#[derive(Debug, Clone)]
pub struct JudgedMutant {
    /// The index of its file.
    pub file: usize,
    /// The first and the last line of what is mutated, from 1.
    pub lines: (usize, usize),
    /// The column where that begins, from 1.
    pub column: usize,
    /// The id of the operator.
    pub operator: String,
    /// What the operator does.
    pub meaning: String,
    /// What became of it.
    pub fate: Fate,
    /// More about that, as a clause.
    pub remark: String,
    /// The lines that it changes.
    pub before: Vec<String>,
    /// What they become.
    pub after: Vec<String>,
}

/// What became of a mutant.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Fate {
    /// Killed by a property, a scenario or a refinement, of that name.
    Killed(String),
    /// Nobody noticed it.
    Survived,
    /// Nobody can notice it.
    Equivalent,
    /// A limit was reached before that was known.
    Unknown,
    /// The checker refuses it.
    Refused,
    /// The analysis was ended before.
    NotJudged,
}

impl MutationAnalysis {
    /// How many mutants have a fate.
    pub(crate) fn count(&self, is: impl Fn(&Fate) -> bool) -> usize {
        self.mutants.iter().filter(|mutant| is(&mutant.fate)).count()
    }
}
