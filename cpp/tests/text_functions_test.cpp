// Library functions on strings, characters and agents' names.
#include "examples.hpp"

namespace groundstate::machine {
namespace {

const Value undef, yes = Value::boolean(true), no = Value::boolean(false);

constexpr std::string_view phases[] = {"IDLE", "BUSY"};
constexpr std::string_view robots[] = {"left", "right"};
constexpr std::string_view parts[] = {"bolt"};
constexpr Names::Domain domains[] = {{"Phase", false, phases}, {"Agent", true, robots}, {"Part", true, parts}};
constexpr Names names{domains, {}};

TEST(LibraryStrings, ToStringIsWhatIsPrinted) {
    EXPECT_EQ(to_string(of("[i1,i2]"), names, here), text("[1,2]"));
    EXPECT_EQ(to_string(of("[s1:a]"), names, here), text("[\"a\"]"));
    EXPECT_EQ(to_string(text("a\n"), names, here), text("a\n"));
    EXPECT_EQ(to_string(Value::character(U'\u00e9'), names, here), text("é"));
    EXPECT_EQ(to_string(undef, names, here), text("undef"));
    EXPECT_EQ(to_string(Value::enumeration(0, 1), names, here), text("BUSY"));
}

TEST(LibraryStrings, CountCharacters) {
    EXPECT_EQ(string_size(text("aé𐐀"), here), integer(3));
    EXPECT_EQ(sub_string(text("hello"), integer(1), integer(3), here), text("el"));
    EXPECT_EQ(sub_string(text("aé𐐀b"), integer(1), integer(3), here), text("é𐐀"));
    EXPECT_EQ(sub_string(text("ab"), integer(2), integer(2), here), text(""));
    EXPECT_FAULT(bad_operand, sub_string(text("ab"), integer(1), integer(3), here));
    EXPECT_FAULT(bad_operand, sub_string(text("ab"), integer(-1), integer(1), here));
    EXPECT_FAULT(bad_operand, sub_string(text("ab"), integer(2), integer(1), here));
    EXPECT_FAULT(undefined_operand, sub_string(text("ab"), undef, integer(1), here));
    EXPECT_FAULT(undefined_operand, string_size(undef, here));
}

TEST(LibraryStrings, AreComposedAndSearched) {
    EXPECT_EQ(string_concat(to_upper(text("ab"), here), text("c"), here), text("ABc"));
    EXPECT_EQ(to_lower(text("ÀB"), here), text("àb"));
    EXPECT_EQ(string_contains(text("hello"), text("ell"), here), yes);
    EXPECT_EQ(string_contains(text("hello"), text(""), here), yes);
    EXPECT_EQ(string_contains(text("ell"), text("hello"), here), no);
    EXPECT_EQ(split(text("a,b,c"), text(","), here), of("[s1:a,s1:b,s1:c]"));
    EXPECT_EQ(split(text(",a,,"), text(","), here), of("[s0:,s1:a,s0:,s0:]"));
    EXPECT_EQ(split(text(""), text(","), here), of("[s0:]"));
    EXPECT_EQ(split(text("aé"), text(""), here), of("[s1:a,s2:é]"));
    EXPECT_EQ(split(text(""), text(""), here), of("[]"));
    EXPECT_FAULT(undefined_operand, string_concat(text("a"), undef, here));
    EXPECT_FAULT(bad_operand, string_contains(text("a"), integer(1), here));
    EXPECT_FAULT(undefined_operand, to_upper(undef, here));
}

TEST(LibraryStrings, AreReadAsNumbers) {
    EXPECT_EQ(to_integer(text(" -12\t"), here), integer(-12));
    EXPECT_EQ(to_integer(text("12n"), here), integer(12));
    EXPECT_EQ(to_natural(text("\u00a012nn"), here), integer(12));
    EXPECT_FAULT(bad_operand, to_natural(text("-12"), here));
    EXPECT_FAULT(bad_operand, to_integer(text("1.0"), here));
    EXPECT_FAULT(bad_operand, to_integer(text("12 n"), here));
    EXPECT_FAULT(bad_operand, to_integer(text("9223372036854775808"), here));
    EXPECT_FAULT(undefined_operand, to_integer(undef, here));
    EXPECT_EQ(to_real(text(" 1e2 "), here), real(100.0));
    EXPECT_EQ(to_real(text("-0"), here), real(0.0));
    EXPECT_FAULT(bad_operand, to_real(text("inf"), here));
    EXPECT_FAULT(bad_operand, to_real(text("1e999"), here));
    EXPECT_FAULT(bad_operand, to_real(text("one"), here));
    EXPECT_EQ(to_char(text("éa"), here), Value::character(U'\u00e9'));
    EXPECT_FAULT(bad_operand, to_char(text(""), here));
}

TEST(LibraryStrings, AreReadAsComplexNumbers) {
    EXPECT_EQ(to_complex(text("1.5"), here), Value::complex(1.5, 0.0));
    EXPECT_EQ(to_complex(text("i2"), here), Value::complex(0.0, 2.0));
    EXPECT_EQ(to_complex(text(" 1 + i 2 "), here), Value::complex(1.0, 2.0));
    EXPECT_EQ(to_complex(text("-1-i"), here), Value::complex(-1.0, -1.0));
    EXPECT_EQ(to_complex(text(""), here), Value::complex(0.0, 0.0));
    EXPECT_EQ(to_complex(text("+i-2"), here), Value::complex(0.0, -2.0));
    EXPECT_FAULT(bad_operand, to_complex(text("1+2"), here));
    EXPECT_FAULT(bad_operand, to_complex(text("1ii"), here));
    EXPECT_FAULT(bad_operand, to_complex(text("nan"), here));
    EXPECT_FAULT(undefined_operand, to_complex(undef, here));
}

TEST(LibraryAgents, HaveNames) {
    EXPECT_EQ(agent_id(Value::element(1, 1), names, here), text("right"));
    EXPECT_EQ(agent_id(Value::element(1, 2), names, here), text("agent!1"));
    EXPECT_FAULT(undefined_operand, agent_id(undef, names, here));
    EXPECT_EQ(get_agent(text("right"), names, here), Value::element(1, 1));
    EXPECT_EQ(get_agent(text("BUSY"), names, here), undef) << "a literal is no agent";
    EXPECT_EQ(get_agent(text("bolt"), names, here), undef) << "not every element is an agent";
    EXPECT_EQ(get_agent(undef, names, here), undef);
}

}  // namespace
}  // namespace groundstate::machine
