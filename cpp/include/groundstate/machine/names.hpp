// The names of a model by which values are printed: literals, elements, rules. It is a table of the generated code.
#pragma once

#include <span>
#include <string_view>

namespace groundstate::machine {

/// The names of a model's domains and rules, by their numbers.
struct Names {
    struct Domain {
        std::string_view name;
        /// Its values are elements, not enum literals.
        bool abstract = false;
        /// The literals of an enum domain; the elements of an abstract domain that are declared.
        std::span<const std::string_view> literals;
    };

    std::span<const Domain> domains;
    std::span<const std::string_view> procedures;
};

}  // namespace groundstate::machine
