//! Generates the driver that replays runs: a program that reads answers and prints states (`machine/replay.hpp`).

use program::FunctionId;

use crate::model::body::Bodies;
use crate::model::plan::Role;
use crate::model::text::{Text, escaped};

/// The driver's source.
pub(crate) fn driver(bodies: &Bodies<'_>, file: &str) -> Text {
    let generator = &bodies.generator;
    let (program, plan) = (generator.program, generator.plan);
    let mut text = Text::default();
    text.line(
        "// Replays runs of the machine: reads the answers to what it asks, prints its states; see machine/replay.hpp.",
    );
    text.line(format!("#include \"{file}.hpp\"\n"));
    text.line("#include <groundstate/machine/replay.hpp>\n");
    text.line(format!("namespace {} {{\nnamespace {{\n", plan.namespace));
    text.open("class ReplayEnvironment final : public Environment {");
    text.line("public:");
    text.line("explicit ReplayEnvironment(gs::Script& script) : script_{script} {}\n");
    for (index, function) in plan.functions.iter().enumerate() {
        let id = FunctionId(index as u32);
        if !matches!(function.role, Role::Input | Role::Shared) || !generator.reach.functions.contains(&id) {
            continue;
        }
        let result = plan.cpp(function.ty, false);
        let mut declared = Vec::new();
        let mut names = Vec::new();
        for (place, domain) in program.function(id).parameters.iter().enumerate() {
            let name = format!("argument_{}", place + 1);
            let defined = generator.assumed.inside[index][place];
            declared.push(format!("{} {name}", generator.parameter(generator.parameter_type(*domain), defined)));
            names.push(format!(", {name}"));
        }
        let asked = format!("script_.input(\"{}\"{})", escaped(&program.function(id).name), names.concat());
        let plain = plan.cpp(function.ty, true);
        let value = if plain == "gs::Value" { asked } else { format!("gs::unbox<{plain}>({asked}, 0)") };
        text.open(format!("{result} {}({}) override {{", function.name, declared.join(", ")));
        text.line(format!("return {value};"));
        text.close("}");
    }
    text.line("std::size_t choose(std::size_t, gs::Site site) override { return script_.choice(site); }");
    text.line(
        "std::int64_t integer(gs::Site site, std::size_t) override { return script_.number(site).as_integer(); }",
    );
    text.line("double real(gs::Site site, std::size_t) override { return script_.number(site).as_real(); }");
    text.line("std::int64_t time(gs::TimeUnit unit) override { return script_.time(unit); }");
    text.line("\nprivate:");
    text.line("gs::Script& script_;");
    text.close("};");
    text.line(format!("\n}}  // namespace\n}}  // namespace {}\n", plan.namespace));
    text.open("int main() {");
    text.line(format!(
        "return groundstate::machine::replay<{0}::Machine, {0}::ReplayEnvironment>(std::cin, std::cout);",
        plan.namespace
    ));
    text.close("}");
    text
}
