// Values as text, as AsmetaL would write them: named elements and literals by their names, elements made by `extend` as
// `domain!k`. The twin of crates/machine/src/print.rs. The exact text without names is encoding.hpp's.
#pragma once

#include <cmath>
#include <string>

#include "encoding.hpp"
#include "letter_case.hpp"
#include "names.hpp"
#include "number_text.hpp"
#include "unicode.hpp"
#include "value.hpp"

namespace groundstate::machine {

namespace detail {

/// Appends values to a text.
class Printer {
  public:
    explicit Printer(const Names& names) noexcept : names_{names} {}

    void put(const Value& value) {
        switch (value.kind()) {
            case Kind::undef: text.append("undef"); break;
            case Kind::boolean: text.append(value.as_boolean() ? "true" : "false"); break;
            case Kind::integer: text.append(std::to_string(value.as_integer())); break;
            case Kind::real: append_real(text, value.as_real()); break;
            case Kind::enumeration: put_literal(value); break;
            case Kind::element: put_element(value); break;
            case Kind::character: {
                std::string character;
                append_scalar(character, value.as_character());
                put_quoted(character, '\'');
                break;
            }
            case Kind::rule: text.append("<<").append(names_.procedures[value.as_rule()]).append(">>"); break;
            case Kind::complex:
                append_real(text, value.as_complex().real);
                text.append(value.as_complex().imaginary < 0 ? "-i" : "+i");
                append_real(text, std::fabs(value.as_complex().imaginary));
                break;
            case Kind::string: put_quoted(value.as_string(), '"'); break;
            case Kind::tuple: put_list("(", value.items(), ")"); break;
            case Kind::seq: put_list("[", value.items(), "]"); break;
            case Kind::set: put_list("{", value.items(), "}"); break;
            case Kind::bag: put_bag(value.as_bag()); break;
            case Kind::map: put_map(value.as_map()); break;
        }
    }

    std::string text;

  private:
    void put_literal(const Value& value) {
        const Names::Domain& domain = names_.domains[value.domain()];
        if (!domain.abstract && value.index() < domain.literals.size()) {
            text.append(domain.literals[value.index()]);
        } else {
            text.append("?").append(std::to_string(value.index()));
        }
    }

    /// The name of an element: its static function's, or `domain!k` with k from 1 for one made by `extend`.
    void put_element(const Value& value) {
        const Names::Domain& domain = names_.domains[value.domain()];
        const std::size_t named = domain.abstract ? domain.literals.size() : 0;
        if (value.index() < named) {
            text.append(domain.literals[value.index()]);
            return;
        }
        std::string_view name = domain.name;
        if (!name.empty()) append_mapped(text, take_scalar(name), to_lower_runs, to_lower_expansions);
        text.append(name).append("!").append(std::to_string(value.index() - named + 1));
    }

    void put_quoted(std::string_view content, char quote) {
        text.push_back(quote);
        for (const char c : content) {
            switch (c) {
                case '\n': text.append("\\n"); break;
                case '\t': text.append("\\t"); break;
                case '\r': text.append("\\r"); break;
                case '\\': text.append("\\\\"); break;
                default:
                    if (c == quote) text.push_back('\\');
                    text.push_back(c);
            }
        }
        text.push_back(quote);
    }

    void put_list(const char* open, const Values& items, const char* close) {
        text.append(open);
        for (std::size_t i = 0; i < items.size(); ++i) {
            if (i > 0) text.push_back(',');
            put(items[i]);
        }
        text.append(close);
    }

    void put_bag(const Counts& counts) {
        text.push_back('<');
        bool first = true;
        for (const auto& [item, count] : counts) {
            for (std::uint64_t i = 0; i < count; ++i) {
                if (!first) text.push_back(',');
                first = false;
                put(item);
            }
        }
        text.push_back('>');
    }

    void put_map(const Entries& entries) {
        text.append(entries.empty() ? "{->" : "{");
        for (std::size_t i = 0; i < entries.size(); ++i) {
            if (i > 0) text.push_back(',');
            put(entries[i].first);
            text.append("->");
            put(entries[i].second);
        }
        text.push_back('}');
    }

    const Names& names_;
};

}  // namespace detail

/// The value as AsmetaL would write it.
[[nodiscard]] inline std::string show(const Value& value, const Names& names) {
    detail::Printer printer{names};
    printer.put(value);
    return std::move(printer.text);
}

}  // namespace groundstate::machine
