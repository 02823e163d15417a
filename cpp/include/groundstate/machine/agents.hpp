// Library functions on agents: their names.
#pragma once

#include "operands.hpp"
#include "text.hpp"

namespace groundstate::machine {

/// `id`: the name of the agent.
[[nodiscard]] inline Value agent_id(const Value& agent, const Names& names, Site site) {
    if (agent.is_undef()) detail::refuse(site, agent);
    return detail::checked(Value::string(show(agent, names)), site);
}

/// `getAgent`: the element of `Agent` that is declared under that name; undef if there is none.
[[nodiscard]] inline Value get_agent(const Value& name, const Names& names, Site) noexcept {
    if (!name.is(Kind::string)) return {};
    for (std::uint32_t domain = 0; domain < names.domains.size(); ++domain) {
        const Names::Domain& entry = names.domains[domain];
        if (!entry.abstract || entry.name != "Agent") continue;
        for (std::uint32_t index = 0; index < entry.literals.size(); ++index) {
            if (entry.literals[index] == name.as_string()) return Value::element(domain, index);
        }
    }
    return {};
}

}  // namespace groundstate::machine
