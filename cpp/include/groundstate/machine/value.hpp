// Values: the elements of the universes, as generated code holds those that have no C++ type of their own.
//
// The twin of crates/machine/src/value.rs. A value is 16 bytes: small ones stand in it; compound ones are shared and
// never changed, so a copy is two words and a count. The order is the machine's canonical one: by kind, then by
// contents; lexicographic for collections, by bytes for strings.
//
// INVARIANT: a set's elements are sorted and distinct; so are a bag's elements and a map's keys; no count is 0; no Real
// is NaN or negative zero; a string is UTF-8.
#pragma once

#include <algorithm>
#include <atomic>
#include <cassert>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace groundstate::machine {

/// The universe of a value, in the canonical order.
enum class Kind : std::uint8_t {
    undef,
    boolean,
    integer,
    real,
    enumeration,
    element,
    character,
    rule,
    complex,
    string,
    tuple,
    seq,
    set,
    bag,
    map
};

class Value;

using Values = std::vector<Value>;
/// The elements of a bag with how often each occurs.
using Counts = std::vector<std::pair<Value, std::uint64_t>>;
/// The keys of a map with their values.
using Entries = std::vector<std::pair<Value, Value>>;

/// The parts of a Complex.
struct ComplexParts {
    double real;
    double imaginary;
};

namespace detail {

/// How many values share a compound.
class Shared {
  public:
#if defined(GROUNDSTATE_SINGLE_THREADED)
    void join() const noexcept { ++uses_; }
    bool leave() const noexcept { return --uses_ == 0; }

  private:
    mutable std::size_t uses_ = 1;
#else
    void join() const noexcept { uses_.fetch_add(1, std::memory_order_relaxed); }

    /// True for the last one.
    bool leave() const noexcept {
        // SYNC(value-sharing): what others read happens before they leave (release), and that before what the last one
        // frees (acquire). Joining needs no order: a thread that joins has a share already.
        return uses_.fetch_sub(1, std::memory_order_acq_rel) == 1;
    }

  private:
    mutable std::atomic<std::size_t> uses_{1};
#endif
};

template <typename Content>
struct Compound final : Shared {
    explicit Compound(Content from) : content{std::move(from)} {}
    const Content content;
};

/// A hash of a hash and another word.
[[nodiscard]] constexpr std::uint64_t mixed(std::uint64_t hash, std::uint64_t word) noexcept {
    hash = (hash ^ word) * 0x9e37'79b9'7f4a'7c15u;
    return hash ^ (hash >> 32);
}

}  // namespace detail

/// A value. Who: any thread; several threads may use values that share a compound, but not the same value.
class Value {
  public:
    /// undef
    Value() noexcept : payload_{.integer = 0} {}

    Value(const Value& other) noexcept : kind_{other.kind_}, domain_{other.domain_}, payload_{other.payload_} {
        if (is_compound()) payload_.shared->join();
    }

    Value(Value&& other) noexcept
        : kind_{std::exchange(other.kind_, Kind::undef)}, domain_{other.domain_}, payload_{other.payload_} {}

    Value& operator=(const Value& other) noexcept {
        Value copy{other};
        swap(copy);
        return *this;
    }

    Value& operator=(Value&& other) noexcept {
        Value taken{std::move(other)};
        swap(taken);
        return *this;
    }

    ~Value() {
        if (is_compound() && payload_.shared->leave()) free();
    }

    void swap(Value& other) noexcept {
        std::swap(kind_, other.kind_);
        std::swap(domain_, other.domain_);
        std::swap(payload_, other.payload_);
    }

    [[nodiscard]] static Value boolean(bool truth) noexcept { return {Kind::boolean, 0, {.boolean = truth}}; }
    [[nodiscard]] static Value integer(std::int64_t number) noexcept { return {Kind::integer, 0, {.integer = number}}; }

    /// A number that is not NaN. Adding zero turns -0.0 into 0.0.
    [[nodiscard]] static Value real(double number) noexcept {
        assert(number == number);
        return {Kind::real, 0, {.real = number + 0.0}};
    }

    /// A literal of an enum domain, by its place.
    [[nodiscard]] static Value enumeration(std::uint32_t domain, std::uint32_t index) noexcept {
        return {Kind::enumeration, domain, {.index = index}};
    }

    /// An element of an abstract domain (the base, never a concrete one), by its number from 0.
    [[nodiscard]] static Value element(std::uint32_t domain, std::uint32_t index) noexcept {
        return {Kind::element, domain, {.index = index}};
    }

    [[nodiscard]] static Value character(char32_t scalar) noexcept { return {Kind::character, 0, {.character = scalar}}; }
    [[nodiscard]] static Value rule(std::uint32_t procedure) noexcept { return {Kind::rule, 0, {.index = procedure}}; }

    /// Parts that are not NaN.
    [[nodiscard]] static Value complex(double real, double imaginary) {
        assert(real == real && imaginary == imaginary);
        return compound(Kind::complex, ComplexParts{real + 0.0, imaginary + 0.0});
    }

    /// A text in UTF-8.
    [[nodiscard]] static Value string(std::string text) { return compound(Kind::string, std::move(text)); }
    [[nodiscard]] static Value tuple(Values components) { return compound(Kind::tuple, std::move(components)); }
    [[nodiscard]] static Value seq(Values elements) { return compound(Kind::seq, std::move(elements)); }

    /// The set of these elements, which may repeat and come in any order.
    [[nodiscard]] static Value set(Values elements);
    /// The bag of these elements.
    [[nodiscard]] static Value bag(Values elements);
    /// The map of these entries; of equal keys the last counts.
    [[nodiscard]] static Value map(Entries entries);

    // The same for elements that are sorted and distinct already, with no count 0.

    [[nodiscard]] static Value sorted_set(Values elements) { return compound(Kind::set, std::move(elements)); }
    [[nodiscard]] static Value sorted_bag(Counts counts) { return compound(Kind::bag, std::move(counts)); }
    [[nodiscard]] static Value sorted_map(Entries entries) { return compound(Kind::map, std::move(entries)); }

    [[nodiscard]] Kind kind() const noexcept { return kind_; }
    [[nodiscard]] bool is_undef() const noexcept { return kind_ == Kind::undef; }
    [[nodiscard]] bool is(Kind kind) const noexcept { return kind_ == kind; }

    // What is in it; each for its own kind alone.

    [[nodiscard]] bool as_boolean() const noexcept { return of(Kind::boolean).boolean; }
    [[nodiscard]] std::int64_t as_integer() const noexcept { return of(Kind::integer).integer; }
    [[nodiscard]] double as_real() const noexcept { return of(Kind::real).real; }
    [[nodiscard]] char32_t as_character() const noexcept { return of(Kind::character).character; }
    /// The procedure.
    [[nodiscard]] std::uint32_t as_rule() const noexcept { return of(Kind::rule).index; }
    [[nodiscard]] const ComplexParts& as_complex() const noexcept { return content<ComplexParts>(Kind::complex); }
    [[nodiscard]] const std::string& as_string() const noexcept { return content<std::string>(Kind::string); }
    [[nodiscard]] const Counts& as_bag() const noexcept { return content<Counts>(Kind::bag); }
    [[nodiscard]] const Entries& as_map() const noexcept { return content<Entries>(Kind::map); }

    /// The domain of an enum literal or element.
    [[nodiscard]] std::uint32_t domain() const noexcept {
        assert(kind_ == Kind::enumeration || kind_ == Kind::element);
        return domain_;
    }

    /// The place of an enum literal, the number of an element.
    [[nodiscard]] std::uint32_t index() const noexcept {
        assert(kind_ == Kind::enumeration || kind_ == Kind::element);
        return payload_.index;
    }

    /// The components of a tuple, the elements of a sequence or set, in their order.
    [[nodiscard]] const Values& items() const noexcept {
        assert(kind_ == Kind::tuple || kind_ == Kind::seq || kind_ == Kind::set);
        return content<Values>(kind_);
    }

    friend bool operator==(const Value& a, const Value& b) noexcept { return (a <=> b) == 0; }
    friend std::strong_ordering operator<=>(const Value& a, const Value& b) noexcept;

    /// The same for equal values, in every run.
    [[nodiscard]] std::uint64_t hash() const noexcept;

  private:
    union Payload {
        bool boolean;
        std::int64_t integer;
        double real;
        std::uint32_t index;
        char32_t character;
        const detail::Shared* shared;
    };

    Value(Kind kind, std::uint32_t domain, Payload payload) noexcept : kind_{kind}, domain_{domain}, payload_{payload} {}

    template <typename Content>
    static Value compound(Kind kind, Content content) {
        return {kind, 0, {.shared = new detail::Compound<Content>(std::move(content))}};
    }

    [[nodiscard]] bool is_compound() const noexcept { return kind_ >= Kind::complex; }

    [[nodiscard]] const Payload& of([[maybe_unused]] Kind kind) const noexcept {
        assert(kind_ == kind);
        return payload_;
    }

    template <typename Content>
    [[nodiscard]] const Content& content(Kind kind) const noexcept {
        return static_cast<const detail::Compound<Content>*>(of(kind).shared)->content;
    }

    void free() noexcept;

    Kind kind_ = Kind::undef;
    std::uint32_t domain_ = 0;
    Payload payload_;
};

static_assert(sizeof(Value) == 16);

inline Value Value::set(Values elements) {
    std::sort(elements.begin(), elements.end());
    elements.erase(std::unique(elements.begin(), elements.end()), elements.end());
    return sorted_set(std::move(elements));
}

inline Value Value::bag(Values elements) {
    std::sort(elements.begin(), elements.end());
    Counts counts;
    for (Value& element : elements) {
        if (counts.empty() || counts.back().first != element) {
            counts.emplace_back(std::move(element), 1);
        } else {
            ++counts.back().second;
        }
    }
    return sorted_bag(std::move(counts));
}

inline Value Value::map(Entries entries) {
    const auto before = [](const auto& a, const auto& b) { return a.first < b.first; };
    std::stable_sort(entries.begin(), entries.end(), before);
    Entries distinct;
    distinct.reserve(entries.size());
    for (auto& entry : entries) {
        if (!distinct.empty() && distinct.back().first == entry.first) distinct.pop_back();
        distinct.push_back(std::move(entry));
    }
    return sorted_map(std::move(distinct));
}

inline void Value::free() noexcept {
    switch (kind_) {
        case Kind::complex: delete static_cast<const detail::Compound<ComplexParts>*>(payload_.shared); break;
        case Kind::string: delete static_cast<const detail::Compound<std::string>*>(payload_.shared); break;
        case Kind::tuple:
        case Kind::seq:
        case Kind::set: delete static_cast<const detail::Compound<Values>*>(payload_.shared); break;
        case Kind::bag: delete static_cast<const detail::Compound<Counts>*>(payload_.shared); break;
        case Kind::map: delete static_cast<const detail::Compound<Entries>*>(payload_.shared); break;
        default: break;
    }
}

}  // namespace groundstate::machine

#include "value_order.hpp"
