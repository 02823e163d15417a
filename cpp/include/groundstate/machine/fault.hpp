// Why a step could not be made: faults of the model at run time, in generated code.
//
// A fault is the model's, never ours; spec/faults/ has a page for each kind. `fail` reports one from anywhere;
// `attempt` catches it for a step, and undoes what the step did.
//
// With exceptions a fault is thrown. Without them (-fno-exceptions, code generated with --bare) it jumps back to
// `attempt`. LIMIT: such a jump runs no destructors; it is defined because bare code has only trivially destructible
// objects between `attempt` and `fail`, and so no dynamic values. GROUNDSTATE_SINGLE_THREADED says that one thread
// makes steps.
#pragma once

#include <cstdint>

#if !defined(__cpp_exceptions)
#include <csetjmp>
#include <cstdlib>
#endif

namespace groundstate::machine {

/// What happened; the kinds of the machine, in its order. As wide as a site, so that a fault is given back without gaps:
/// a step that gives none then writes two words and reads the same two.
enum class FaultKind : std::uint32_t {
    none,
    inconsistent_update,
    out_of_domain,
    undefined_guard,
    undefined_operand,
    bad_operand,
    division_by_zero,
    overflow,
    not_a_number,
    not_enumerable,
    no_definition,
    unbound,
    not_a_rule,
    wrong_arguments,
    temporal,
    limit,
    environment,
    no_main
};

/// The kebab-case name of the kind, which names its page in spec/faults/.
[[nodiscard]] inline const char* id(FaultKind kind) noexcept {
    switch (kind) {
        case FaultKind::none: return "none";
        case FaultKind::inconsistent_update: return "inconsistent-update";
        case FaultKind::out_of_domain: return "value-outside-domain";
        case FaultKind::undefined_guard: return "undefined-guard";
        case FaultKind::undefined_operand: return "undefined-operand";
        case FaultKind::bad_operand: return "bad-operand";
        case FaultKind::division_by_zero: return "division-by-zero";
        case FaultKind::overflow: return "integer-overflow";
        case FaultKind::not_a_number: return "not-a-number";
        case FaultKind::not_enumerable: return "domain-not-enumerable";
        case FaultKind::no_definition: return "no-definition";
        case FaultKind::unbound: return "unbound-variable";
        case FaultKind::not_a_rule: return "not-runnable";
        case FaultKind::wrong_arguments: return "wrong-arguments";
        case FaultKind::temporal: return "temporal-operator";
        case FaultKind::limit: return "limit-reached";
        case FaultKind::environment: return "no-input";
        case FaultKind::no_main: return "no-main-rule";
    }
    return "none";
}

/// The number of a place in the model's text; a table of the generated code knows its file, line and column.
using Site = std::uint32_t;

/// A fault and its place. For an inconsistent update, `site` is the first rule and `other` the second; otherwise both
/// are the same.
struct Fault {
    FaultKind kind = FaultKind::none;
    Site site = 0;
    Site other = 0;

    explicit operator bool() const noexcept { return kind != FaultKind::none; }
    friend bool operator==(const Fault&, const Fault&) = default;
};

#if defined(__cpp_exceptions)

/// Ends the step. Blocks: no. Allocates: the exception.
[[noreturn]] inline void fail(FaultKind kind, Site site, Site other) { throw Fault{kind, site, other}; }

/// Does what may fail, and gives its fault, if any. Other exceptions pass.
template <typename Action>
[[nodiscard, gnu::always_inline]] inline Fault attempt(Action&& action) {
    try {
        action();
        return {};
    } catch (const Fault& fault) {
        return fault;
    }
}

#else

namespace detail {

/// Where a fault lands, and which one it was; volatile, as what changes before a jump is lost otherwise.
struct Landing {
    std::jmp_buf place;
    volatile FaultKind kind;
    volatile Site site;
    volatile Site other;
};

/// The innermost `attempt` under way.
#if defined(GROUNDSTATE_SINGLE_THREADED)
inline Landing* landing = nullptr;
#else
inline thread_local Landing* landing = nullptr;
#endif

}  // namespace detail

/// Ends the step; outside of every `attempt` it ends the program. Blocks: no. Allocates: no.
[[noreturn]] inline void fail(FaultKind kind, Site site, Site other) {
    if (detail::landing == nullptr) std::abort();
    detail::landing->kind = kind;
    detail::landing->site = site;
    detail::landing->other = other;
    std::longjmp(detail::landing->place, 1);
}

/// Does what may fail, and gives its fault, if any.
template <typename Action>
[[nodiscard]] Fault attempt(Action&& action) {
    detail::Landing here{};
    detail::Landing* const outer = detail::landing;
    detail::landing = &here;
    if (setjmp(here.place) == 0) action();
    // Compilers assume that nothing can read what a call writes that never returns. Here all callers of this can.
    asm volatile("" : : "r"(&action) : "memory");
    detail::landing = outer;
    return {here.kind, here.site, here.other};
}

#endif

/// The same; undoes its work after a fault, and before an exception that is not a fault passes.
template <typename Action, typename Undo>
[[nodiscard, gnu::always_inline]] inline Fault attempt(Action&& action, Undo&& undo) {
#if defined(__cpp_exceptions)
    try {
        const Fault fault = attempt(action);
        if (fault) undo();
        return fault;
    } catch (...) {
        undo();
        throw;
    }
#else
    const Fault fault = attempt(action);
    if (fault) undo();
    return fault;
#endif
}

/// Ends the step at one place.
[[noreturn]] inline void fail(FaultKind kind, Site site) { fail(kind, site, site); }

/// Does beforehand what may not be needed: code that needs it does it again, and then meets the model's fault.
template <typename Action>
void prepare(Action&& action) {
    const Fault fault = attempt(action);
    if (fault.kind == FaultKind::limit || fault.kind == FaultKind::environment) {
        fail(fault.kind, fault.site, fault.other);
    }
}

}  // namespace groundstate::machine
