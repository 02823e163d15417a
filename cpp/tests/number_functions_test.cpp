// Library functions on truth values and numbers: what spec/standard-library.md says and crates/machine computes.
#include <limits>

#include "examples.hpp"

namespace groundstate::machine {
namespace {

constexpr std::int64_t least = std::numeric_limits<std::int64_t>::min();
constexpr std::int64_t most = std::numeric_limits<std::int64_t>::max();
const double infinity = std::numeric_limits<double>::infinity();
const Value undef, yes = Value::boolean(true), no = Value::boolean(false);

TEST(LibraryLogic, ConnectivesAreKleenes) {
    const Value truths[] = {no, undef, yes};
    const auto rank = [&](const Value& truth) { return truth == no ? 0 : truth == yes ? 2 : 1; };
    for (const Value& a : truths) {
        EXPECT_EQ(not_(a, here), truths[2 - rank(a)]);
        for (const Value& b : truths) {
            EXPECT_EQ(and_(a, b, here), truths[std::min(rank(a), rank(b))]);
            EXPECT_EQ(or_(a, b, here), truths[std::max(rank(a), rank(b))]);
            EXPECT_EQ(implies(a, b, here), truths[std::max(2 - rank(a), rank(b))]);
        }
    }
}

TEST(LibraryLogic, TheOthersAreNot) {
    EXPECT_EQ(xor_(yes, no, here), yes);
    EXPECT_EQ(xor_(yes, yes, here), no);
    EXPECT_EQ(iff(no, no, here), yes);
    EXPECT_EQ(iff(no, yes, here), no);
    EXPECT_FAULT(undefined_operand, xor_(undef, yes, here));
    EXPECT_FAULT(undefined_operand, iff(yes, undef, here));
    EXPECT_FAULT(bad_operand, iff(yes, integer(1), here));
}

TEST(LibraryLogic, EqualityIsTotal) {
    EXPECT_EQ(eq(undef, undef, here), yes);
    EXPECT_EQ(eq(undef, no, here), no);
    EXPECT_EQ(neq(integer(1), integer(2), here), yes);
    EXPECT_EQ(eq(integer(1), real(1.0), here), no);
    EXPECT_EQ(is_def(undef, here), no);
    EXPECT_EQ(is_undef(undef, here), yes);
    EXPECT_EQ(is_def(of("[]"), here), yes);
}

TEST(LibraryIntegers, Arithmetic) {
    EXPECT_EQ(int_add(integer(7), integer(-2), here), integer(5));
    EXPECT_EQ(int_sub(integer(7), integer(9), here), integer(-2));
    EXPECT_EQ(int_mul(integer(-7), integer(6), here), integer(-42));
    EXPECT_EQ(int_neg(integer(7), here), integer(-7));
    EXPECT_EQ(int_abs(integer(-7), here), integer(7));
    EXPECT_EQ(int_min(integer(3), integer(4), here), integer(3));
    EXPECT_EQ(int_max(integer(3), integer(4), here), integer(4));
    EXPECT_EQ(int_power(integer(2), integer(10), here), integer(1024));
    EXPECT_EQ(int_power(integer(0), integer(0), here), integer(1));
    EXPECT_EQ(int_power(integer(-2), integer(63), here), integer(least));
    EXPECT_EQ(int_power(integer(-1), integer(4'294'967'295), here), integer(-1));
    EXPECT_EQ(int_div(integer(7), integer(2), here), real(3.5));
    EXPECT_EQ(int_div(integer(0), integer(-2), here), real(0.0));
}

TEST(LibraryIntegers, DivisionTruncates) {
    for (const std::int64_t a : {7, -7}) {
        for (const std::int64_t b : {2, -2}) {
            EXPECT_EQ(int_quotient(integer(a), integer(b), here), integer(a * b > 0 ? 3 : -3));
            EXPECT_EQ(int_mod(integer(a), integer(b), here), integer(a > 0 ? 1 : -1));
        }
    }
    EXPECT_EQ(int_mod(integer(least), integer(-1), here), integer(0));
    EXPECT_FAULT(overflow, int_quotient(integer(least), integer(-1), here));
    EXPECT_FAULT(division_by_zero, int_quotient(integer(1), integer(0), here));
    EXPECT_FAULT(division_by_zero, int_mod(integer(1), integer(0), here));
    EXPECT_FAULT(division_by_zero, int_div(integer(1), integer(0), here));
}

TEST(LibraryIntegers, NothingWraps) {
    EXPECT_FAULT(overflow, int_add(integer(most), integer(1), here));
    EXPECT_FAULT(overflow, int_sub(integer(least), integer(1), here));
    EXPECT_FAULT(overflow, int_mul(integer(most), integer(2), here));
    EXPECT_FAULT(overflow, int_neg(integer(least), here));
    EXPECT_FAULT(overflow, int_abs(integer(least), here));
    EXPECT_FAULT(overflow, int_power(integer(2), integer(63), here));
    EXPECT_FAULT(overflow, int_power(integer(10), integer(4'294'967'295), here));
    EXPECT_FAULT(bad_operand, int_power(integer(2), integer(-1), here));
    EXPECT_FAULT(bad_operand, int_power(integer(1), integer(4'294'967'296), here));
}

TEST(LibraryIntegers, OfUndefAreFaults) {
    EXPECT_FAULT(undefined_operand, int_add(undef, integer(1), here));
    EXPECT_FAULT(undefined_operand, int_add(real(1.0), undef, here));
    EXPECT_FAULT(undefined_operand, int_mod(undef, integer(0), here));
    EXPECT_FAULT(bad_operand, int_mod(real(1.0), integer(0), here));
    EXPECT_FAULT(undefined_operand, int_neg(undef, here));
    EXPECT_FAULT(bad_operand, int_neg(text("1"), here));
}

TEST(LibraryReals, Arithmetic) {
    EXPECT_EQ(real_add(integer(1), real(2.5), here), real(3.5));
    EXPECT_EQ(real_sub(real(1.0), real(2.5), here), real(-1.5));
    EXPECT_EQ(real_mul(real(1e6), real(1e6), here), real(1e12));
    EXPECT_EQ(real_mul(real(-1.0), real(0.0), here), real(0.0)) << "zero is one";
    EXPECT_EQ(real_div(real(1.0), real(4.0), here), real(0.25));
    EXPECT_EQ(real_power(real(2.0), integer(10), here), real(1024.0));
    EXPECT_EQ(real_neg(real(0.0), here), real(0.0));
    EXPECT_EQ(real_abs(real(-2.5), here), real(2.5));
    EXPECT_EQ(real_min(real(-2.5), integer(1), here), real(-2.5));
    EXPECT_EQ(real_max(real(-2.5), integer(1), here), real(1.0));
    EXPECT_EQ(sqrt(real(2.25), here), real(1.5));
    EXPECT_EQ(real_mul(real(1e300), real(1e300), here), real(infinity));
    EXPECT_FAULT(not_a_number, sqrt(real(-1.0), here));
    EXPECT_FAULT(not_a_number, real_sub(real(infinity), real(infinity), here));
    EXPECT_FAULT(not_a_number, real_power(real(-1.0), real(0.5), here));
    EXPECT_FAULT(division_by_zero, real_div(real(1.0), real(0.0), here));
    EXPECT_FAULT(division_by_zero, real_div(text("x"), integer(0), here));
    EXPECT_FAULT(undefined_operand, real_div(undef, real(0.0), here));
    EXPECT_FAULT(undefined_operand, real_div(real(1.0), undef, here));
    EXPECT_FAULT(bad_operand, real_add(real(1.0), text("x"), here));
}

TEST(LibraryReals, AreMadeWhole) {
    EXPECT_EQ(floor(real(-1.5), here), integer(-2));
    EXPECT_EQ(floor(real(3e9), here), integer(3'000'000'000));
    EXPECT_EQ(round(real(2.5), here), integer(3));
    EXPECT_EQ(round(real(-2.5), here), integer(-2));
    EXPECT_EQ(round(real(0.49999999999999994), here), integer(0));
    EXPECT_EQ(real_to_int(real(-2.9), here), integer(-2));
    EXPECT_EQ(real_to_int(real(-9223372036854775808.0), here), integer(least));
    EXPECT_EQ(real_to_nat(real(2.9), here), integer(2));
    EXPECT_EQ(real_to_nat(real(-0.5), here), integer(0));
    EXPECT_FAULT(overflow, floor(real(9223372036854775808.0), here));
    EXPECT_FAULT(overflow, round(real(infinity), here));
    EXPECT_FAULT(overflow, real_to_int(real(-1e19), here));
    EXPECT_FAULT(bad_operand, real_to_nat(real(-1.0), here));
    EXPECT_FAULT(undefined_operand, floor(undef, here));
}

TEST(LibraryReals, OrderIsOfOneKindOrOfReals) {
    EXPECT_EQ(lt(integer(most - 1), integer(most), here), yes) << "exact, although both are the same double";
    EXPECT_EQ(le(real(1.5), real(1.5), here), yes);
    EXPECT_EQ(gt(Value::character(U'b'), Value::character(U'a'), here), yes);
    EXPECT_EQ(ge(integer(1), real(1.5), here), no);
    EXPECT_EQ(lt(integer(1), real(1.5), here), yes);
    EXPECT_EQ(le(real(1.0), integer(1), here), yes);
    EXPECT_FAULT(undefined_operand, lt(undef, integer(3), here));
    EXPECT_FAULT(bad_operand, gt(integer(1), Value::character(U'a'), here));
    EXPECT_FAULT(bad_operand, ge(text("a"), text("b"), here));
}

TEST(LibraryReals, ConversionsKeepTheNumber) {
    EXPECT_EQ(int_to_real(integer(3), here), real(3.0));
    EXPECT_EQ(nat_to_real(integer(3), here), real(3.0));
    EXPECT_EQ(int_to_nat(integer(3), here), integer(3));
    EXPECT_EQ(nat_to_int(integer(3), here), integer(3));
    EXPECT_FAULT(bad_operand, int_to_nat(integer(-3), here));
    EXPECT_FAULT(undefined_operand, int_to_nat(undef, here));
    EXPECT_FAULT(undefined_operand, nat_to_int(undef, here));
    EXPECT_FAULT(undefined_operand, int_to_real(undef, here));
    EXPECT_EQ(coerce_real(integer(2)), real(2.0));
    EXPECT_EQ(coerce_real(undef), undef);
    EXPECT_EQ(coerce_complex(integer(2)), Value::complex(2.0, 0.0));
    EXPECT_EQ(coerce_complex(real(2.5)), Value::complex(2.5, 0.0));
    EXPECT_EQ(coerce_complex(undef), undef);
}

TEST(LibraryComplex, Arithmetic) {
    const Value a = Value::complex(1.0, 2.0), b = Value::complex(3.0, -4.0);
    EXPECT_EQ(complex_add(a, b, here), Value::complex(4.0, -2.0));
    EXPECT_EQ(complex_sub(a, integer(1), here), Value::complex(0.0, 2.0));
    EXPECT_EQ(complex_mul(Value::complex(0.0, 2.0), Value::complex(0.0, 2.0), here), Value::complex(-4.0, 0.0));
    EXPECT_EQ(complex_div(a, b, here), Value::complex(-0.2, 0.4));
    EXPECT_EQ(complex_neg(b, here), Value::complex(-3.0, 4.0));
    EXPECT_EQ(re(b, here), real(3.0));
    EXPECT_EQ(im(b, here), real(-4.0));
    EXPECT_EQ(im(real(1.0), here), real(0.0));
    EXPECT_EQ(norm(b, here), Value::complex(5.0, 0.0));
    EXPECT_EQ(is_zero(b, here), no);
    EXPECT_EQ(is_zero(Value::complex(0.0, 0.0), here), yes);
    EXPECT_FAULT(division_by_zero, complex_div(a, Value::complex(0.0, 0.0), here));
    EXPECT_FAULT(not_a_number, complex_mul(Value::complex(infinity, 0.0), Value::complex(0.0, 1.0), here));
    EXPECT_FAULT(undefined_operand, complex_add(a, undef, here));
    EXPECT_FAULT(bad_operand, re(text("x"), here));
}

}  // namespace
}  // namespace groundstate::machine
