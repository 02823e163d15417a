// Complex arithmetic. Integers and Reals stand for Complex numbers wherever those are expected.
#pragma once

#include "reals.hpp"

namespace groundstate::machine {

namespace detail {

[[nodiscard]] inline std::optional<ComplexParts> as_parts(const Value& value) noexcept {
    if (value.is(Kind::complex)) return value.as_complex();
    if (const std::optional<double> number = as_number(value)) return ComplexParts{*number, 0.0};
    return {};
}

[[nodiscard]] inline ComplexParts parts_of(const Value& value, Site site) {
    const std::optional<ComplexParts> parts = as_parts(value);
    if (!parts) refuse(site, value);
    return *parts;
}

/// A Complex, or the fault of a result that is none.
[[nodiscard]] inline Value complex_result(double real, double imaginary, Site site) {
    if (std::isnan(real) || std::isnan(imaginary)) fail(FaultKind::not_a_number, site);
    return Value::complex(real, imaginary);
}

template <typename Operation>
[[nodiscard]] Value complexes(const Value& a, const Value& b, Site site, Operation operation) {
    const std::optional<ComplexParts> x = as_parts(a), y = as_parts(b);
    if (!x || !y) refuse(site, a, b);
    const ComplexParts result = operation(*x, *y);
    return complex_result(result.real, result.imaginary, site);
}

}  // namespace detail

[[nodiscard]] inline Value re(const Value& a, Site site) { return Value::real(detail::parts_of(a, site).real); }
[[nodiscard]] inline Value im(const Value& a, Site site) { return Value::real(detail::parts_of(a, site).imaginary); }

/// The absolute value, as a Complex.
[[nodiscard]] inline Value norm(const Value& a, Site site) {
    const ComplexParts parts = detail::parts_of(a, site);
    return Value::complex(std::hypot(parts.real, parts.imaginary), 0.0);
}

[[nodiscard]] inline Value is_zero(const Value& a, Site site) {
    const ComplexParts parts = detail::parts_of(a, site);
    return Value::boolean(parts.real == 0.0 && parts.imaginary == 0.0);
}

[[nodiscard]] inline Value complex_neg(const Value& a, Site site) {
    const ComplexParts parts = detail::parts_of(a, site);
    return Value::complex(-parts.real, -parts.imaginary);
}

[[nodiscard]] inline Value complex_add(const Value& a, const Value& b, Site site) {
    return detail::complexes(a, b, site, [](const ComplexParts& x, const ComplexParts& y) {
        return ComplexParts{x.real + y.real, x.imaginary + y.imaginary};
    });
}

[[nodiscard]] inline Value complex_sub(const Value& a, const Value& b, Site site) {
    return detail::complexes(a, b, site, [](const ComplexParts& x, const ComplexParts& y) {
        return ComplexParts{x.real - y.real, x.imaginary - y.imaginary};
    });
}

[[nodiscard]] inline Value complex_mul(const Value& a, const Value& b, Site site) {
    using detail::product;
    return detail::complexes(a, b, site, [](const ComplexParts& x, const ComplexParts& y) {
        return ComplexParts{product(x.real, y.real) - product(x.imaginary, y.imaginary),
                            product(x.real, y.imaginary) + product(x.imaginary, y.real)};
    });
}

[[nodiscard]] inline Value complex_div(const Value& a, const Value& b, Site site) {
    using detail::product;
    return detail::complexes(a, b, site, [site](const ComplexParts& x, const ComplexParts& y) {
        const double scale = product(y.real, y.real) + product(y.imaginary, y.imaginary);
        if (scale == 0.0) fail(FaultKind::division_by_zero, site);
        return ComplexParts{(product(x.real, y.real) + product(x.imaginary, y.imaginary)) / scale,
                            (product(x.imaginary, y.real) - product(x.real, y.imaginary)) / scale};
    });
}

/// A number where the model expects a Complex; anything else is unchanged.
[[nodiscard]] inline Value coerce_complex(const Value& value) {
    const std::optional<double> number = detail::as_number(value);
    return number ? Value::complex(*number, 0.0) : value;
}

}  // namespace groundstate::machine
