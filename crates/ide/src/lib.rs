//! What an editor asks of a project: a text and a place in, an answer as plain data out.
//!
//! In: a [`Project`], which is [`groundstate::Workspace`] with what is known of each file, a path and a byte offset. Out: faults,
//! places, names, edits. Nothing here knows a protocol, a disk or a clock; a shell turns positions into offsets by [`Lines`] and
//! answers into messages. Every answer is for texts as they are typed, so none relies on a text without faults.
//!
//! `analysis` looks a file up, `project` keeps what it found; each other file is one question.

mod analysis;
mod calls;
mod complete;
mod coupling;
mod diagram;
mod fix;
mod hint;
mod hover;
mod layout;
mod navigate;
mod outline;
mod position;
mod project;
mod refactor;
mod rename;
mod report;
mod shapes;
mod signature;
mod specification;
mod structure;
mod tokens;

pub use analysis::{Analysis, Place, Role, Symbol};
pub use calls::{Called, callees, callers};
pub use complete::{Completion, Item, ItemKind, completion};
pub use diagram::{Centre, Copied, Drawn, Fresh, FreshKind, Joint, Moment, Operation, Property, drawn};
pub use fix::{Fix, fixes};
pub use hint::{Action, Hint, Lens, hints, lenses};
pub use hover::{Hover, hover};
pub use layout::{layout_in, layout_typed};
pub use navigate::{Reference, definition, highlights, implementations, links, references};
pub use outline::{Entry, EntryKind, outline, search};
pub use position::{Edit, Encoding, Lines, Position, difference, edited};
pub use project::{Project, library_names, library_text};
pub use refactor::{Refactoring, RefactoringKind, refactorings};
pub use rename::{Edits, prepare, rename};
pub use report::{Fault, Report, Weight, reports};
pub use shapes::{Spoken, speaking, spoken};
pub use signature::{Signature, Signatures, signatures};
pub use structure::{FoldKind, folding, formatted, formatted_text, selections};
pub use tokens::{Coloured, Modifier, TokenKind, tokens};
