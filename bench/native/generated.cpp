// The step code that `groundstate generate cpp` makes of a model, in the frame of the programs written by hand.
//
// Compiled once a model, with what was generated in the same translation unit, as a program written by hand is: SOURCE is
// its source, MODEL its namespace. NAMES has a function `names()`, what values are printed by: generated code knows its
// literals and elements by number.
#include SOURCE

#include <iostream>
#include <optional>
#include <string>

#include <groundstate/machine/boxing.hpp>
#include <groundstate/machine/text.hpp>

#include NAMES
#include "driver.hpp"

namespace gs = groundstate::machine;

struct Generated final : MODEL::Environment {
    Random random;
    std::optional<MODEL::Machine> machine;

    Generated() { begin(); }

    void begin() {
        machine.emplace(*this);
        if (machine->start()) std::abort();
    }

    std::size_t choose(std::size_t candidates, gs::Site) override {
        return random.below(static_cast<std::uint32_t>(candidates));
    }

    void step() {
        if (machine->step()) std::abort();
        // A step with nothing to do does not count: the model is at its end and begins again.
        if (!machine->changed()) {
            begin();
            step();
        }
    }

    void print() const {
        machine->each_location([](const char* name, const auto& arguments, const auto& value) {
            std::string list;
            bool listed = true;
            const auto add = [&](const auto& argument) {
                const gs::Value boxed = gs::box(argument);
                listed &= !boxed.is(gs::Kind::undef);
                list += (list.empty() ? "(" : ",") + gs::show(boxed, names());
            };
            std::apply([&](const auto&... parts) { (add(parts), ...); }, arguments);
            // Of locations whose arguments are undef the machine tells nothing.
            if (listed) std::cout << name << list << (list.empty() ? "=" : ")=") << gs::show(gs::box(value), names()) << '\n';
        });
        std::cout.flush();
    }
};

int main(int argc, char** argv) { return run<Generated>(argc, argv); }
