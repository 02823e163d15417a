// Values as an exact text without names, for tests and records: what is written reads back as the same value.
//
//     u                 undef             s<bytes>:…        String in UTF-8, by its length in bytes
//     b0 b1             Boolean           (a,b)             tuple
//     i<n>              Integer           [a,b]             sequence
//     r<16 hex digits>  Real, its bits    {a,b}             set
//     e<domain>:<place> enum literal      <a*count,b*count> bag
//     o<domain>:<n>     element           |a>b,c>d|         map
//     c<number>         Char              |-|               the map of no entries: a key may be a map itself
//     p<procedure>      rule              z<hex><hex>       Complex
#pragma once

#include <bit>
#include <charconv>
#include <limits>
#include <string>
#include <string_view>
#include <system_error>

#include "fault.hpp"
#include "value.hpp"

namespace groundstate::machine {

namespace detail {

class Encoder {
  public:
    void put(const Value& value) {
        switch (value.kind()) {
            case Kind::undef: text.push_back('u'); break;
            case Kind::boolean: text.append(value.as_boolean() ? "b1" : "b0"); break;
            case Kind::integer: text.append("i").append(std::to_string(value.as_integer())); break;
            case Kind::real: text.push_back('r'), put_bits(value.as_real()); break;
            case Kind::enumeration: put_indexed('e', value); break;
            case Kind::element: put_indexed('o', value); break;
            case Kind::character: text.append("c").append(std::to_string(std::uint32_t{value.as_character()})); break;
            case Kind::rule: text.append("p").append(std::to_string(value.as_rule())); break;
            case Kind::complex:
                text.push_back('z');
                put_bits(value.as_complex().real);
                put_bits(value.as_complex().imaginary);
                break;
            case Kind::string:
                text.append("s").append(std::to_string(value.as_string().size())).append(":").append(value.as_string());
                break;
            case Kind::tuple: put_list('(', ')', value.items(), [this](const Value& item) { put(item); }); break;
            case Kind::seq: put_list('[', ']', value.items(), [this](const Value& item) { put(item); }); break;
            case Kind::set: put_list('{', '}', value.items(), [this](const Value& item) { put(item); }); break;
            case Kind::bag:
                put_list('<', '>', value.as_bag(), [this](const auto& item) {
                    put(item.first);
                    text.append("*").append(std::to_string(item.second));
                });
                break;
            case Kind::map:
                if (value.as_map().empty()) {
                    text.append("|-|");
                    break;
                }
                put_list('|', '|', value.as_map(), [this](const auto& entry) {
                    put(entry.first);
                    text.push_back('>');
                    put(entry.second);
                });
                break;
        }
    }

    std::string text;

  private:
    void put_bits(double number) {
        const auto bits = std::bit_cast<std::uint64_t>(number);
        for (int shift = 60; shift >= 0; shift -= 4) text.push_back("0123456789abcdef"[bits >> shift & 0xf]);
    }

    void put_indexed(char kind, const Value& value) {
        text.push_back(kind);
        text.append(std::to_string(value.domain())).append(":").append(std::to_string(value.index()));
    }

    template <typename Items, typename Put>
    void put_list(char open, char close, const Items& items, const Put& put_item) {
        text.push_back(open);
        bool first = true;
        for (const auto& item : items) {
            if (!first) text.push_back(',');
            first = false;
            put_item(item);
        }
        text.push_back(close);
    }
};

class Decoder {
  public:
    explicit Decoder(std::string_view& text) noexcept : text_{text} {}

    Value take() {
        switch (const char kind = take_char(); kind) {
            case 'u': return {};
            case 'b': return Value::boolean(take_number<unsigned>(1) == 1);
            case 'i': return Value::integer(take_number<std::int64_t>());
            case 'r': return Value::real(take_bits());
            case 'e': return take_indexed(&Value::enumeration);
            case 'o': return take_indexed(&Value::element);
            case 'c': return Value::character(static_cast<char32_t>(take_number<std::uint32_t>(0x10'ffff)));
            case 'p': return Value::rule(take_number<std::uint32_t>());
            case 'z': {
                const double real = take_bits();
                return Value::complex(real, take_bits());
            }
            case 's': {
                const auto size = take_number<std::size_t>();
                take_char(':');
                if (size > text_.size()) refuse();
                const std::string_view bytes = text_.substr(0, size);
                text_.remove_prefix(size);
                return Value::string(std::string{bytes});
            }
            case '(': return Value::tuple(take_values(')'));
            case '[': return Value::seq(take_values(']'));
            case '{': return Value::set(take_values('}'));
            case '<': {
                Counts counts;
                take_list('>', [&] {
                    Value item = take();
                    take_char('*');
                    const auto count = take_number<std::uint64_t>();
                    if (count == 0 || (!counts.empty() && counts.back().first >= item)) refuse();
                    counts.emplace_back(std::move(item), count);
                });
                return Value::sorted_bag(std::move(counts));
            }
            case '|': {
                Entries entries;
                if (text_.starts_with("-|")) {
                    text_.remove_prefix(2);
                    return Value::map({});
                }
                take_list('|', [&] {
                    Value key = take();
                    take_char('>');
                    entries.emplace_back(std::move(key), take());
                });
                return Value::map(std::move(entries));
            }
            default: refuse();
        }
    }

  private:
    [[noreturn]] static void refuse() { fail(FaultKind::environment, 0); }

    char take_char() {
        if (text_.empty()) refuse();
        const char c = text_.front();
        text_.remove_prefix(1);
        return c;
    }

    void take_char(char expected) {
        if (take_char() != expected) refuse();
    }

    template <typename Number>
    Number take_number(Number most = std::numeric_limits<Number>::max()) {
        Number number = 0;
        const auto [end, error] = std::from_chars(text_.data(), text_.data() + text_.size(), number);
        if (error != std::errc{} || number > most) refuse();
        text_.remove_prefix(static_cast<std::size_t>(end - text_.data()));
        return number;
    }

    double take_bits() {
        constexpr std::size_t digits = 16;
        if (text_.size() < digits) refuse();
        std::uint64_t bits = 0;
        const auto [end, error] = std::from_chars(text_.data(), text_.data() + digits, bits, 16);
        const double number = std::bit_cast<double>(bits);
        if (error != std::errc{} || end != text_.data() + digits || number != number) refuse();
        text_.remove_prefix(digits);
        return number;
    }

    Value take_indexed(Value (*make)(std::uint32_t, std::uint32_t)) {
        const auto domain = take_number<std::uint32_t>();
        take_char(':');
        return make(domain, take_number<std::uint32_t>());
    }

    template <typename Take>
    void take_list(char close, const Take& take_item) {
        if (close != '|' && text_.starts_with(close)) {
            text_.remove_prefix(1);
            return;
        }
        for (;;) {
            take_item();
            const char next = take_char();
            if (next == close) return;
            if (next != ',') refuse();
        }
    }

    Values take_values(char close) {
        Values values;
        take_list(close, [&] { values.push_back(take()); });
        return values;
    }

    std::string_view& text_;
};

}  // namespace detail

/// The value as a text that no other value has.
[[nodiscard]] inline std::string encode(const Value& value) {
    detail::Encoder encoder;
    encoder.put(value);
    return std::move(encoder.text);
}

/// Takes a value off the front of a text. A text that is not a value is a fault of the environment, without a place.
[[nodiscard]] inline Value decode(std::string_view& text) { return detail::Decoder{text}.take(); }

}  // namespace groundstate::machine
