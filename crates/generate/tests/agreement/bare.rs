//! Code without heap, exceptions and RTTI, compiled with these off, makes the same steps as other generated code.

use std::process::Command;
use std::sync::Arc;

use generate::model::Options;
use machine::{Closed, Limits, Machine};
use syntax::SourceFile;
use testkit::{Page, repository};

use crate::compile::{Compiler, strict};
use crate::run::Disk;

/// A main program for both: choices from xorshift64, the state after many steps.
const MAIN: &str = r#"
#include <cstdio>
#include <type_traits>

namespace {

template <class T> void print(const T& value) {
    if constexpr (requires { value.defined; }) {
        if (value.defined) print(value.value); else std::printf(" undef");
    } else if constexpr (requires { value.size(); }) {
        for (std::size_t place = 0; place < value.size(); ++place) print(value[place]);
    } else if constexpr (requires { value.element; }) {
        std::printf(" !%u", value.element);
    } else {
        std::printf(" %lld", static_cast<long long>(value));
    }
}

struct Chance : model::Environment {
    unsigned long long state = 88172645463325252ULL;
    std::size_t choose(std::size_t candidates, model::gs::Site) override {
        state ^= state << 13, state ^= state >> 7, state ^= state << 17;
        return static_cast<std::size_t>(((state >> 32) * candidates) >> 32);
    }
};

Chance chance;
model::Machine machine{chance};

}  // namespace

int main() {
    if (machine.start()) return 1;
    for (int step = 0; step < 500; ++step) {
        if (const model::gs::Fault fault = machine.step()) {
            std::printf("fault %s\n", model::gs::id(fault.kind));
            break;
        }
    }
    machine.each_location([](const char* name, const auto& arguments, const auto& value) {
        std::printf("%s", name);
        std::apply([](const auto&... parts) { (print(parts), ...); }, arguments);
        std::printf(" =");
        print(value);
        std::printf("\n");
    });
}
"#;

#[test]
fn without_heap_and_exceptions() {
    let compiler = Compiler::new("bare");
    for model in ["bench/models/Philosophers.asm", "bench/models/ProducerConsumer.asm"] {
        let [hosted, bare] = [false, true].map(|bare| printed(&compiler, model, bare));
        assert!(hosted.lines().count() > 5 && !hosted.contains("fault"), "{model}: {hosted}");
        assert_eq!(hosted, bare, "{model}");
    }
    // A fault jumps back to the step and undoes its updates.
    let clash = "asm Clash\nimport StandardLibrary\nsignature:\n  controlled x: Integer\ndefinitions:\n\
                 main rule r_Main = if x < 3 then seq x := x + 1 x := x + 1 endseq else seq x := 9 par x := 1 x := 2 endpar endseq endif\n\
                 default init s0:\n  function x = 0\n";
    std::fs::write(compiler.folder().join("Clash.asm"), clash).expect("a folder of one's own");
    let path = compiler.folder().join("Clash.asm");
    let [hosted, bare] = [false, true].map(|bare| printed(&compiler, &path.to_string_lossy(), bare));
    assert_eq!(hosted, "fault inconsistent-update\nx = 4\n");
    assert_eq!(hosted, bare);
    // So does a list that becomes too long for two words.
    let line = |most: u32| {
        let text = format!(
            "asm Line\nimport StandardLibrary\nsignature:\n  enum domain Task = {{CAMERA | ROBOT | MOTOR}}\n  controlled line: Seq(Task)\n\
             \x20 controlled turn: Task -> Integer\n  static after: Task -> Task\ndefinitions:\n\
             \x20 function after($t in Task) = switch $t case CAMERA: ROBOT case ROBOT: MOTOR otherwise CAMERA endswitch\n\
             main rule r_Main = par if length(line) < {most} then line := append(line, after(last(line))) \
             else line := tail([$t in line | $t != ROBOT or turn($t) < 90 : $t]) endif turn(first(line)) := turn(first(line)) + indexOf(line, MOTOR) + 1 endpar\n\
             default init s0:\n  function line = [CAMERA]\n  function turn($t in Task) = 0\n"
        );
        std::fs::write(compiler.folder().join("Line.asm"), text).expect("a folder of one's own");
        let path = compiler.folder().join("Line.asm");
        [false, true].map(|bare| printed(&compiler, &path.to_string_lossy(), bare))
    };
    let [hosted, bare] = line(12);
    assert!(hosted.contains("line =") && !hosted.contains("fault"), "{hosted}");
    assert_eq!(hosted, bare);
    let [hosted, bare] = line(18);
    assert!(!hosted.contains("fault"), "{hosted}");
    assert!(bare.starts_with("fault limit-reached\n"), "{bare}");
    compiler.finish();
}

#[test]
fn what_takes_a_heap_is_refused() {
    let refused = generated("examples/word_count/WordCount.asm", true).expect_err("strings and maps");
    assert!(refused.iter().all(|fault| fault.contains("takes a heap")), "{refused:?}");
}

fn generated(model: &str, bare: bool) -> Result<generate::model::Generated, Vec<String>> {
    let path = repository::root().join(model);
    let text = std::fs::read_to_string(&path).expect("a readable file");
    let checked = model::check(SourceFile::new(path.to_string_lossy(), text), &mut Disk);
    let program = Arc::new(program::lower(&checked.model).expect("a model without faults"));
    let mut started = Machine::new(Arc::clone(&program), Limits::default());
    let _ = started.start(&mut Closed);
    let options = Options { bare, ..Options::default() };
    generate::model::generate(&program, &checked.sources, &mut started, &options)
        .map_err(|faults| faults.into_iter().map(|fault| fault.message).collect())
}

/// The output of the model's program after its steps.
fn printed(compiler: &Compiler, model: &str, bare: bool) -> String {
    let generated = generated(model, bare).unwrap_or_else(|faults| panic!("{model}: {faults:?}"));
    let folder = compiler.folder().join(format!("{}{bare}", generated.name));
    std::fs::create_dir_all(&folder).expect("a folder of one's own");
    for file in &generated.files {
        std::fs::write(folder.join(&file.name), &file.text).expect("a folder of one's own");
    }
    let unit = format!("#include \"{0}.cpp\"\nnamespace model = {0};\n{MAIN}", generated.name);
    std::fs::write(folder.join("main.cpp"), unit).expect("a folder of one's own");
    let mut command = strict();
    if bare {
        command.args(["-fno-exceptions", "-fno-rtti", "-DGROUNDSTATE_BARE", "-DGROUNDSTATE_SINGLE_THREADED"]);
    }
    let program = folder.join("program");
    let output = command.arg("-O2").arg(folder.join("main.cpp")).arg("-o").arg(&program).output().expect("g++ runs");
    assert!(output.status.success(), "{model}: {}", String::from_utf8_lossy(&output.stderr));
    if bare {
        let names = Command::new("nm").args(["-u", "-C"]).arg(&program).output().expect("nm runs");
        let names = String::from_utf8_lossy(&names.stdout).into_owned();
        let heap = ["malloc", "free@", "operator new", "operator delete", "__cxa_throw"]
            .iter()
            .find(|name| names.contains(*name));
        assert_eq!(heap, None, "{model} asks for it");
    }
    let output = Command::new(&program).output().expect("the program runs");
    assert!(output.status.success(), "{model}: {}", output.status);
    String::from_utf8_lossy(&output.stdout).into_owned()
}

/// The program that docs/generated-code.md shows.
#[test]
fn the_guide() {
    let guide = Page::read("docs/generated-code.md");
    let program = guide.example("cpp");
    let compiler = Compiler::new("guide");
    let generated = generated("examples/coffee_machine/CoffeeMachine.asm", false).expect("all of it");
    for file in &generated.files {
        std::fs::write(compiler.folder().join(&file.name), &file.text).expect("a folder of one's own");
    }
    let unit = format!("{program}\n#include \"coffee_machine.cpp\"\n");
    std::fs::write(compiler.folder().join("main.cpp"), unit).expect("a folder of one's own");
    let path = compiler.folder().join("program");
    let built = strict().arg(compiler.folder().join("main.cpp")).arg("-o").arg(&path).output().expect("g++");
    assert!(built.status.success(), "{}", String::from_utf8_lossy(&built.stderr));
    let output = Command::new(&path).output().expect("the program runs");
    assert_eq!(String::from_utf8_lossy(&output.stdout), "credit 50\n");
    compiler.finish();
}
