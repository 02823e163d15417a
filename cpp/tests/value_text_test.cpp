// Values of generated code as text: as AsmetaL writes them, and exactly.
#include <gtest/gtest.h>

#include <limits>

#include "groundstate/machine/text.hpp"

namespace groundstate::machine {
namespace {

constexpr std::string_view phases[] = {"IDLE", "BUSY"};
constexpr std::string_view robots[] = {"left", "right"};
constexpr std::string_view rules[] = {"r_Main", "r_step"};
constexpr Names::Domain domains[] = {{"Phase", false, phases}, {"Robot", true, robots}, {"Épée", true, {}}, {"Small", false, {}}};
constexpr Names names{domains, rules};

std::string shown(const Value& value) { return show(value, names); }

TEST(Text, IsAsAsmetaLWritesIt) {
    const Value one = Value::integer(1), two = Value::integer(2);
    EXPECT_EQ(shown({}), "undef");
    EXPECT_EQ(shown(Value::boolean(true)), "true");
    EXPECT_EQ(shown(Value::integer(std::numeric_limits<std::int64_t>::min())), "-9223372036854775808");
    EXPECT_EQ(shown(Value::enumeration(0, 1)), "BUSY");
    EXPECT_EQ(shown(Value::enumeration(3, 1)), "?1");
    EXPECT_EQ(shown(Value::element(1, 0)), "left");
    EXPECT_EQ(shown(Value::element(1, 2)), "robot!1") << "made by extend";
    EXPECT_EQ(shown(Value::element(2, 0)), "épée!1");
    EXPECT_EQ(shown(Value::element(3, 4)), "small!5");
    EXPECT_EQ(shown(Value::character(U'x')), "'x'");
    EXPECT_EQ(shown(Value::character(U'\'')), "'\\''");
    EXPECT_EQ(shown(Value::character(U'\u00e9')), "'é'");
    EXPECT_EQ(shown(Value::rule(1)), "<<r_step>>");
    EXPECT_EQ(shown(Value::complex(-4.0, 0.0)), "-4.0+i0.0");
    EXPECT_EQ(shown(Value::complex(0.5, -2.0)), "0.5-i2.0");
    EXPECT_EQ(shown(Value::string("a\n\"b\"\\'")), "\"a\\n\\\"b\\\"\\\\'\"");
    EXPECT_EQ(shown(Value::tuple({one, two})), "(1,2)");
    EXPECT_EQ(shown(Value::seq({one, one})), "[1,1]");
    EXPECT_EQ(shown(Value::set({two, one, Value{}})), "{undef,1,2}");
    EXPECT_EQ(shown(Value::bag({two, one, two})), "<1,2,2>");
    EXPECT_EQ(shown(Value::map({{one, Value::string("a")}, {two, Value{}}})), "{1->\"a\",2->undef}");
    EXPECT_EQ(shown(Value::map({})), "{->}");
}

TEST(Text, RealsReadBackAsTheSame) {
    const double infinity = std::numeric_limits<double>::infinity();
    const std::pair<double, const char*> examples[] = {
        {0.0, "0.0"},
        {1.0, "1.0"},
        {-1.5, "-1.5"},
        {0.1, "0.1"},
        {100.0, "100.0"},
        {1000000000000.0, "1000000000000.0"},
        {0.0001, "0.0001"},
        {0.00001, "1e-5"},
        {1.25e-7, "1.25e-7"},
        {9999999999999998.0, "9999999999999998.0"},
        {1e16, "1e16"},
        {1.5e300, "1.5e300"},
        {5e-324, "5e-324"},
        {1.7976931348623157e308, "1.7976931348623157e308"},
        {0.1 + 0.2, "0.30000000000000004"},
        {infinity, "Infinity"},
        {-infinity, "-Infinity"},
        // Halfway between two texts of 17 digits: the greater one.
        {101298645434770.125, "101298645434770.13"},
        {-1764264906162320.25, "-1764264906162320.3"},
    };
    for (const auto& [number, text] : examples) {
        EXPECT_EQ(shown(Value::real(number)), text);
        EXPECT_EQ(detail::read_real(text), number) << text;
    }
}

TEST(Text, NumbersAreReadAsTheMachineReadsThem) {
    const double infinity = std::numeric_limits<double>::infinity();
    const std::pair<const char*, std::optional<double>> reals[] = {
        {"1", 1.0},         {"+1.", 1.0},          {"-.5e1", -5.0},         {"1E-2", 0.01},        {"INF", infinity},
        {"-inf", -infinity}, {"1e400", infinity},  {"1e-400", 0.0},         {"0e99999", 0.0},      {"", {}},
        {".", {}},          {"e5", {}},            {"1e", {}},              {"1e+", {}},           {"1 ", {}},
        {"0x1", {}},        {"+-1", {}},           {"1e99999999999999999999", infinity},
    };
    for (const auto& [text, number] : reals) EXPECT_EQ(detail::read_real(text), number) << text;
    const std::pair<const char*, std::optional<std::int64_t>> integers[] = {
        {"7", 7}, {"+7", 7}, {"-7", -7}, {"007", 7}, {"9223372036854775808", {}}, {"", {}}, {"+", {}}, {"+-7", {}}, {"7.0", {}},
    };
    for (const auto& [text, number] : integers) EXPECT_EQ(detail::read_integer(text), number) << text;
}

TEST(Text, HasCapitalsAndSmallLettersOfUnicode) {
    EXPECT_EQ(detail::in_capitals("straße ŉ ﬃ ǆ я 𐐨"), "STRASSE ʼN FFI Ǆ Я 𐐀");
    EXPECT_EQ(detail::in_small_letters("ÀÉ İ Ǆ Я 𐐀"), "àé i̇ ǆ я 𐐨");
    EXPECT_EQ(detail::in_small_letters("ὈΔΥΣΣΕΎΣ ΣΑΣ. Σ"), "ὀδυσσεύς σας. σ");
    EXPECT_EQ(detail::in_capitals("1+ÿ"), "1+Ÿ");
}

TEST(Encoding, ReadsBackAsTheSame) {
    const Value inner = Value::set({Value::integer(-5), Value::seq({})});
    const std::pair<Value, const char*> examples[] = {
        {{}, "u"},
        {Value::boolean(false), "b0"},
        {Value::boolean(true), "b1"},
        {Value::integer(-5), "i-5"},
        {Value::integer(std::numeric_limits<std::int64_t>::min()), "i-9223372036854775808"},
        {Value::real(1.5), "r3ff8000000000000"},
        {Value::real(-std::numeric_limits<double>::infinity()), "rfff0000000000000"},
        {Value::enumeration(3, 2), "e3:2"},
        {Value::element(7, 0), "o7:0"},
        {Value::character(U'\u00e9'), "c233"},
        {Value::rule(12), "p12"},
        {Value::complex(1.0, -1.0), "z3ff0000000000000bff0000000000000"},
        {Value::string("é,\""), "s4:é,\""},
        {Value::string(""), "s0:"},
        {Value::tuple({Value::integer(1), inner}), "(i1,{i-5,[]})"},
        {Value::seq({Value::integer(2), Value::integer(1)}), "[i2,i1]"},
        {Value::set({}), "{}"},
        {Value::bag({Value::integer(2), Value{}, Value::integer(2)}), "<u*1,i2*2>"},
        {Value::bag({}), "<>"},
        {Value::map({{Value::integer(1), inner}, {Value::integer(2), Value{}}}), "|i1>{i-5,[]},i2>u|"},
        {Value::map({}), "|-|"},
        {Value::map({{Value::map({}), Value::map({{Value{}, Value::map({})}})}}), "||-|>|u>|-|||"},
    };
    for (const auto& [value, text] : examples) {
        EXPECT_EQ(encode(value), text);
        std::string_view rest = text;
        EXPECT_EQ(decode(rest), value) << text;
        EXPECT_EQ(rest, "");
    }
}

TEST(Encoding, TakesOneValueOffTheFront) {
    std::string_view text = "{i3,i1,i3}i-2s1:xrest";
    EXPECT_EQ(decode(text), Value::set({Value::integer(1), Value::integer(3)}));
    EXPECT_EQ(decode(text), Value::integer(-2));
    EXPECT_EQ(decode(text), Value::string("x"));
    EXPECT_EQ(text, "rest");
}

TEST(Encoding, RefusesWhatIsNoValue) {
    for (const char* text : {"", "x", "b2", "i", "r3ff", "r7ff8000000000000", "e1", "s3:ab", "[i1", "[i1;i2]", "<i1*0>",
                             "<i2*1,i1*1>", "|i1|", "||", "(u,)", "c1114112"}) {
        std::string_view rest = text;
        EXPECT_EQ(attempt([&] { (void)decode(rest); }).kind, FaultKind::environment) << text;
    }
}

}  // namespace
}  // namespace groundstate::machine
