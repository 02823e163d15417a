//! Generated code compiles without warnings: the header alone, the source and the replaying program, with g++ and, if
//! installed, clang++. So do the runtime's headers that it includes.

use std::path::Path;
use std::process::Command;
use std::sync::Arc;

use generate::model::Options;
use machine::{Closed, Limits, Machine};
use syntax::SourceFile;

use crate::compile::{Compiler, runtime};
use crate::run::Disk;

const BOTH: &[&str] = &[
    "-std=c++20",
    "-fsyntax-only",
    "-Werror",
    "-Wall",
    "-Wextra",
    "-Wpedantic",
    "-Wshadow",
    "-Wconversion",
    "-Wsign-conversion",
    "-Wold-style-cast",
    "-Wcast-qual",
    "-Wcast-align",
    "-Wformat=2",
    "-Wnon-virtual-dtor",
    "-Woverloaded-virtual",
    "-Wextra-semi",
    "-Wredundant-decls",
    "-Wundef",
];

/// A model whose names are those of macros, of C++ and of the class itself.
const NAMES: &str = "asm Names\n\nimport StandardLibrary\n\nsignature:\n\tenum domain State = {EIO | EBUSY | BIG_ENDIAN | NAN | READY}\n\
    \tabstract domain Robot\n\tstatic left: Robot\n\tcontrolled started: State\n\tcontrolled unix: Integer\n\tcontrolled major: Robot -> Integer\n\
    \tmonitored stdin: Boolean\n\tmonitored class: Integer\n\tcontrolled errno: State -> Integer\n\ndefinitions:\n\n\
    \tmain rule r_Main =\n\t\tpar\n\t\t\tif stdin then started := EBUSY else choose $s in State with true do started := $s endif\n\
    \t\t\tunix := unix + class\n\t\t\tmajor(left) := unix\n\t\t\terrno(started) := errno(NAN) + 1\n\t\tendpar\n\n\
    default init s0:\n\tfunction started = EIO\n\tfunction unix = 0\n\tfunction errno($s in State) = 0\n";

fn generated(path: &Path, text: String, bare: bool) -> generate::model::Generated {
    let checked = model::check(SourceFile::new(path.to_string_lossy(), text), &mut Disk);
    let program = Arc::new(program::lower(&checked.model).unwrap_or_else(|faults| panic!("{faults:?}")));
    let mut started = Machine::new(Arc::clone(&program), Limits::default());
    let _ = started.start(&mut Closed);
    let options = Options { bare, ..Options::default() };
    generate::model::generate(&program, &checked.sources, &mut started, &options)
        .unwrap_or_else(|faults| panic!("{faults:?}"))
}

fn compiles(compiler: &Compiler, generated: &generate::model::Generated) {
    let folder = compiler.folder().join(&generated.name);
    std::fs::create_dir_all(&folder).expect("a folder of one's own");
    for file in &generated.files {
        std::fs::write(folder.join(&file.name), &file.text).expect("a folder of one's own");
    }
    std::fs::write(folder.join("alone.cpp"), format!("#include \"{}.hpp\"\n", generated.name))
        .expect("a folder of one's own");
    let strict: [(&str, &[&str]); 2] =
        [("g++", &["-Wuseless-cast", "-Wlogical-op", "-Wduplicated-cond", "-Wduplicated-branches"]), ("clang++", &[])];
    for (name, own) in strict {
        if Command::new(name).arg("--version").output().is_err() {
            println!("there is no {name} here");
            continue;
        }
        for source in generated.files.iter().map(|file| file.name.as_str()).chain(["alone.cpp"]) {
            if !source.ends_with(".cpp") {
                continue;
            }
            let mut command = Command::new(name);
            command.args(BOTH).args(own).arg("-I").arg(runtime()).arg(folder.join(source));
            let output = command.output().expect("it runs");
            let said = String::from_utf8_lossy(&output.stderr);
            assert!(output.status.success() && said.is_empty(), "{name} {source}:\n{said}");
        }
    }
}

#[test]
fn no_compiler_warns() {
    let compiler = Compiler::new("warnings");
    let names = generated(Path::new("Names.asm"), NAMES.to_string(), false);
    let renamed: Vec<String> = names.renamed.iter().map(|(model, cpp)| format!("{model} {cpp}")).collect();
    let expected =
        ["started started_2", "unix unix_1", "major major_1", "errno errno_1", "stdin stdin_1", "class class_1"];
    for name in expected.into_iter().chain(["EIO EIO_1", "EBUSY EBUSY_1", "BIG_ENDIAN BIG_ENDIAN_1", "NAN NAN_1"]) {
        assert!(renamed.iter().any(|renamed| renamed == name), "{name} is not told: {renamed:?}");
    }
    assert!(!renamed.iter().any(|renamed| renamed.starts_with("READY")), "{renamed:?}");
    let header = &names.files[0].text;
    assert!(header.contains("/// started: State. Called `started_2` here"), "{header}");
    assert!(header.contains("`EIO` is `EIO_1`"), "{header}");
    compiles(&compiler, &names);
    let model = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../bench/models/Philosophers.asm");
    let text = std::fs::read_to_string(&model).expect("a readable file");
    compiles(&compiler, &generated(&model, text, true));
    compiler.finish();
}
