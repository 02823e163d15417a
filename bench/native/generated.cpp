// The step code that `groundstate generate cpp` makes of a model, in the frame of the programs written by hand.
//
// Compiled once a model, with what was generated in the same translation unit, as a program written by hand is: SOURCE is
// its source, MODEL its namespace.
#include SOURCE

#include <iostream>
#include <optional>
#include <string>

#include <groundstate/machine/boxing.hpp>
#include <groundstate/machine/text.hpp>

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

    // Generated code knows its literals by number: a value of an enum domain is printed as `?number`.
    template <class Scalar>
    static std::string show(const Scalar& scalar) {
        const gs::Value value = gs::box(scalar);
        return value.is(gs::Kind::enumeration) ? "?" + std::to_string(value.index()) : gs::show(value, gs::Names{});
    }

    void print() const {
        machine->each_location([](const char* name, const auto& arguments, const auto& value) {
            std::string list;
            const auto add = [&](const auto& argument) { list += (list.empty() ? "(" : ",") + show(argument); };
            std::apply([&](const auto&... parts) { (add(parts), ...); }, arguments);
            std::cout << name << list << (list.empty() ? "=" : ")=") << show(value) << '\n';
        });
        std::cout.flush();
    }
};

int main(int argc, char** argv) { return run<Generated>(argc, argv); }
