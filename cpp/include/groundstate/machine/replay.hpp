// Drives a generated machine from a text, to compare its states with those of the model.
//
// In, line by line: `in NAME (ARGUMENTS) VALUE`, `choose INDEX`, `number VALUE`, `time UNIT VALUE` give the answers of
// the next step; `step` makes it, the first one the initial state. Out: after each, the locations that have a value,
// sorted, as `NAME (ARGUMENTS) VALUE`, after `? ` if an argument is undef, then a line `.`; or `fault KIND SITE` and
// the end. Values are written as by `encode` (encoding.hpp).
#pragma once

#include <algorithm>
#include <deque>
#include <iostream>
#include <map>
#include <memory>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "boxing.hpp"
#include "encoding.hpp"
#include "inputs.hpp"

namespace groundstate::machine {

/// The answers of one step.
class Script {
  public:
    /// Takes a line in; false if it is no answer.
    bool take(const std::string& line) {
        std::istringstream words{line};
        std::string what;
        words >> what;
        if (what == "in") {
            std::string name;
            words >> name;
            std::string rest;
            std::getline(words >> std::ws, rest);
            std::string_view text{rest};
            const Value arguments = decode(text);
            text.remove_prefix(std::min<std::size_t>(1, text.size()));
            inputs_[name + encode(arguments)] = decode(text);
        } else if (what == "choose") {
            std::size_t index = 0;
            words >> index;
            choices_.push_back(index);
        } else if (what == "number") {
            std::string rest;
            words >> rest;
            std::string_view text{rest};
            numbers_.push_back(decode(text));
        } else if (what == "time") {
            std::size_t unit = 0;
            words >> unit;
            words >> clock_.at(unit);
        } else {
            return false;
        }
        return true;
    }

    void clear() {
        inputs_.clear();
        choices_.clear();
        numbers_.clear();
        clock_ = {};
    }

    template <class... Arguments>
    Value input(const char* name, const Arguments&... arguments) const {
        const auto found = inputs_.find(name + encode(Value::tuple(Values{box(arguments)...})));
        if (found == inputs_.end()) {
            fail(FaultKind::environment, 0, 0);
        }
        return found->second;
    }
    std::size_t choice(Site site) { return next(choices_, site); }
    Value number(Site site) { return next(numbers_, site); }
    std::int64_t time(TimeUnit unit) const { return clock_.at(static_cast<std::size_t>(unit)); }

  private:
    template <class T>
    static T next(std::deque<T>& all, Site site) {
        if (all.empty()) {
            fail(FaultKind::environment, site, site);
        }
        T first = std::move(all.front());
        all.pop_front();
        return first;
    }

    std::map<std::string, Value> inputs_;
    std::deque<std::size_t> choices_;
    std::deque<Value> numbers_;
    std::array<std::int64_t, 3> clock_{};
};

/// Prints the state.
template <class Machine>
void print_state(const Machine& machine, std::ostream& out) {
    std::vector<std::string> lines;
    machine.each_location([&](const char* name, const auto& arguments, const auto& given) {
        const Value value = box(given);
        if (!value.is_undef()) {
            const Values values = std::apply([](const auto&... parts) { return Values{box(parts)...}; }, arguments);
            const bool has_undef = std::any_of(values.begin(), values.end(), [](const Value& part) { return part.is_undef(); });
            lines.push_back((has_undef ? "? " : "") + std::string{name} + ' ' + encode(Value::tuple(values)) + ' ' + encode(value));
        }
    });
    std::sort(lines.begin(), lines.end());
    for (const std::string& line : lines) {
        out << line << '\n';
    }
    out << ".\n";
}

/// Drives a machine by the contents of a stream. `Environment` is made of a `Script`.
template <class Machine, class Environment>
int replay(std::istream& in, std::ostream& out) {
    Script script;
    Environment environment{script};
    auto machine = std::make_unique<Machine>(environment);
    const auto told = [&](Fault fault) {
        if (fault.kind == FaultKind::none) {
            print_state(*machine, out);
            return false;
        }
        out << "fault " << id(fault.kind) << ' ' << fault.site << '\n';
        return true;
    };
    bool started = false;
    std::string line;
    while (std::getline(in, line)) {
        if (script.take(line)) {
            continue;
        }
        if (told(started ? machine->step() : machine->start())) {
            return 0;
        }
        started = true;
        script.clear();
    }
    return 0;
}

}  // namespace groundstate::machine
