// JSON to a file, as it is made: objects, arrays, columns, numbers with as many digits as they need to be read back the
// same. What is no number is null. INVARIANT: the same calls give the same bytes.
#pragma once

#include <charconv>
#include <cmath>
#include <cstdio>
#include <string_view>

namespace groundstate::closed_loop {

/// Objects and arrays with their commas; that they are closed as they were opened is the caller's.
class Json {
  public:
    /// The file must outlive it.
    explicit Json(std::FILE* file) : file_{file} {}

    Json& key(std::string_view name) {
        separate();
        std::fputc('\n', file_);
        quote(name);
        std::fputc(':', file_);
        first_ = true;
        return *this;
    }
    void open(char bracket) {
        separate();
        std::fputc(bracket, file_);
        first_ = true;
    }
    void close(char bracket) {
        std::fputc(bracket, file_);
        first_ = false;
    }
    void number(double value) {
        if (!std::isfinite(value)) {
            nothing();
            return;
        }
        separate();
        char text[32];
        const auto end = std::to_chars(text, text + sizeof text, value).ptr;
        std::fwrite(text, 1, static_cast<std::size_t>(end - text), file_);
    }
    void nothing() {
        separate();
        std::fputs("null", file_);
    }
    void truth(bool value) {
        separate();
        std::fputs(value ? "true" : "false", file_);
    }
    void text(std::string_view value) {
        separate();
        quote(value);
    }
    template <class Values>
    void numbers(const Values& values) {
        open('[');
        for (const double value : values) {
            number(value);
        }
        close(']');
    }

    /// An array of what a function gives of each entry.
    template <class Entries, class Of>
    void column(std::string_view name, const Entries& entries, const Of& of) {
        key(name).open('[');
        for (const auto& entry : entries) {
            of(*this, entry);
        }
        close(']');
    }

    /// Whether the file has taken everything; errno says why not.
    bool is_written() const noexcept { return std::fflush(file_) == 0 && std::ferror(file_) == 0; }

  private:
    void separate() {
        if (!first_) {
            std::fputc(',', file_);
        }
        first_ = false;
    }
    void quote(std::string_view value) {
        std::fputc('"', file_);
        for (const char letter : value) {
            if (letter == '"' || letter == '\\') {
                std::fputc('\\', file_);
                std::fputc(letter, file_);
            } else if (static_cast<unsigned char>(letter) < 0x20) {
                std::fprintf(file_, "\\u%04x", static_cast<unsigned>(letter));
            } else {
                std::fputc(letter, file_);
            }
        }
        std::fputc('"', file_);
    }

    std::FILE* file_;
    bool first_ = true;
};

inline double seconds(std::int64_t span_ns) { return static_cast<double>(span_ns) * 1e-9; }
inline double milliseconds(std::int64_t span_ns) { return static_cast<double>(span_ns) * 1e-6; }

}  // namespace groundstate::closed_loop
