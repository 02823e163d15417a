// What tests of the library functions share: values by their exact text, and the fault that an expression ends with.
#pragma once

#include <gtest/gtest.h>

#include <ostream>
#include <string>

#include "groundstate/machine/library.hpp"

namespace groundstate::machine {

/// So that a failed expectation prints values and not their bytes.
inline void PrintTo(const Value& value, std::ostream* out) { *out << encode(value); }
inline void PrintTo(const Fault& fault, std::ostream* out) { *out << id(fault.kind) << " at " << fault.site; }

/// The value of an exact text; all of the text has to be used.
inline Value of(std::string_view text) {
    Value value;
    const Fault fault = attempt([&] { value = decode(text); });
    EXPECT_TRUE(!fault && text.empty()) << "no value: " << text;
    return value;
}

inline Value integer(std::int64_t number) { return Value::integer(number); }
inline Value real(double number) { return Value::real(number); }
inline Value text(const char* utf8) { return Value::string(utf8); }

constexpr Site here = 17;

}  // namespace groundstate::machine

/// That a call ends with a fault of this kind at `here`.
#define EXPECT_FAULT(kind_, ...)                                                                                    \
    EXPECT_EQ(::groundstate::machine::attempt([&] { (void)(__VA_ARGS__); }),                                        \
              (::groundstate::machine::Fault{::groundstate::machine::FaultKind::kind_, ::groundstate::machine::here, \
                                             ::groundstate::machine::here}))
