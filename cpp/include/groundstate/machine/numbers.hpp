// Arithmetic on plain numbers: 64-bit integers that never wrap, doubles that are never NaN and never -0.0.
//
// The same results and faults as the library functions of spec/standard-library.md; each operation takes the place in
// the model that a fault names. Division of integers truncates toward zero.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>

#include "fault.hpp"

namespace groundstate::machine {

constexpr std::int64_t add(std::int64_t a, std::int64_t b, Site site) {
    std::int64_t result = 0;
    if (__builtin_add_overflow(a, b, &result)) [[unlikely]] {
        fail(FaultKind::overflow, site, site);
    }
    return result;
}

constexpr std::int64_t subtract(std::int64_t a, std::int64_t b, Site site) {
    std::int64_t result = 0;
    if (__builtin_sub_overflow(a, b, &result)) [[unlikely]] {
        fail(FaultKind::overflow, site, site);
    }
    return result;
}

constexpr std::int64_t multiply(std::int64_t a, std::int64_t b, Site site) {
    std::int64_t result = 0;
    if (__builtin_mul_overflow(a, b, &result)) [[unlikely]] {
        fail(FaultKind::overflow, site, site);
    }
    return result;
}

constexpr std::int64_t negate(std::int64_t a, Site site) { return subtract(0, a, site); }
constexpr std::int64_t absolute(std::int64_t a, Site site) { return a < 0 ? negate(a, site) : a; }
constexpr std::int64_t minimum(std::int64_t a, std::int64_t b, Site) { return a < b ? a : b; }
constexpr std::int64_t maximum(std::int64_t a, std::int64_t b, Site) { return a > b ? a : b; }

constexpr std::int64_t quotient(std::int64_t a, std::int64_t b, Site site) {
    if (b == 0) [[unlikely]] {
        fail(FaultKind::division_by_zero, site, site);
    }
    if (b == -1) {
        return negate(a, site);
    }
    return a / b;
}

constexpr std::int64_t remainder(std::int64_t a, std::int64_t b, Site site) {
    if (b == 0) [[unlikely]] {
        fail(FaultKind::division_by_zero, site, site);
    }
    return b == -1 ? 0 : a % b;
}

constexpr std::int64_t power(std::int64_t base, std::int64_t exponent, Site site) {
    if (exponent < 0 || exponent > std::numeric_limits<std::uint32_t>::max()) [[unlikely]] {
        fail(FaultKind::bad_operand, site, site);
    }
    if (base == 0 || base == 1) {
        return exponent == 0 ? 1 : base;
    }
    if (base == -1) {
        return exponent % 2 == 0 ? 1 : -1;
    }
    std::int64_t result = 1;
    for (; exponent > 0; --exponent) {
        result = multiply(result, base, site);
    }
    return result;
}

/// A Natural: an Integer that is not negative.
constexpr std::int64_t natural(std::int64_t a, Site site) {
    if (a < 0) [[unlikely]] {
        fail(FaultKind::bad_operand, site, site);
    }
    return a;
}

constexpr double to_real(std::int64_t a) { return static_cast<double>(a); }

/// A result as a Real.
inline double real(double a, Site site) {
    if (std::isnan(a)) [[unlikely]] {
        fail(FaultKind::not_a_number, site, site);
    }
    return a + 0.0;  // -0.0 becomes 0.0
}

inline double real_add(double a, double b, Site site) { return real(a + b, site); }
inline double real_subtract(double a, double b, Site site) { return real(a - b, site); }
inline double real_multiply(double a, double b, Site site) { return real(a * b, site); }
inline double real_minimum(double a, double b, Site site) { return real(std::fmin(a, b), site); }
inline double real_maximum(double a, double b, Site site) { return real(std::fmax(a, b), site); }
inline double real_power(double a, double b, Site site) { return real(std::pow(a, b), site); }
inline double real_negate(double a, Site site) { return real(-a, site); }
inline double real_absolute(double a, Site site) { return real(std::fabs(a), site); }
inline double square_root(double a, Site site) { return real(std::sqrt(a), site); }

inline double real_divide(double a, double b, Site site) {
    if (b == 0.0) [[unlikely]] {
        fail(FaultKind::division_by_zero, site, site);
    }
    return real(a / b, site);
}

/// `div` of integers: the real quotient.
inline double divide(std::int64_t a, std::int64_t b, Site site) { return real_divide(to_real(a), to_real(b), site); }

/// A whole Real as an Integer.
inline std::int64_t whole(double a, Site site) {
    // 2^63 is exact as a double; every double below it converts.
    if (!(a >= -9223372036854775808.0 && a < 9223372036854775808.0)) [[unlikely]] {
        fail(FaultKind::overflow, site, site);
    }
    return static_cast<std::int64_t>(a);
}

inline std::int64_t floor(double a, Site site) { return whole(std::floor(a), site); }
inline std::int64_t round(double a, Site site) {
    return whole(std::floor(a) + (a - std::floor(a) >= 0.5 ? 1.0 : 0.0), site);
}
inline std::int64_t truncate(double a, Site site) { return whole(std::trunc(a), site); }
inline std::int64_t truncate_natural(double a, Site site) { return natural(truncate(a, site), site); }

}  // namespace groundstate::machine
