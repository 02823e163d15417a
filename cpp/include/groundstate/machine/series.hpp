// A row of values: of a fixed capacity, in place, or growing on the heap. Generated code uses the first form wherever
// it knows a bound; `--bare` code uses only that form.
#pragma once

#include <array>
#include <cstddef>
#include <utility>
#if !defined(GROUNDSTATE_BARE)
#include <algorithm>
#include <memory>
#endif

#include "fault.hpp"

namespace groundstate::machine {

/// At most `Capacity` values; 0: as many as there is memory.
template <class T, std::size_t Capacity>
class Series {
  public:
    std::size_t size() const noexcept { return size_; }
    T& operator[](std::size_t place) noexcept { return values_[place]; }
    const T& operator[](std::size_t place) const noexcept { return values_[place]; }
    const T* begin() const noexcept { return values_.data(); }
    const T* end() const noexcept { return begin() + size_; }

    void push(T value, Site site) {
        if (size_ == Capacity) [[unlikely]] {
            fail(FaultKind::limit, site, site);
        }
        values_[size_++] = std::move(value);
    }
    /// To at most the capacity; what is new is T{}.
    void resize(std::size_t size) noexcept {
        for (; size_ < size; ++size_) {
            values_[size_] = T{};
        }
        size_ = size;
    }
    void shrink(std::size_t size) noexcept { size_ = size; }

  private:
    std::array<T, Capacity> values_{};
    std::size_t size_ = 0;
};

#if !defined(GROUNDSTATE_BARE)
template <class T>
class Series<T, 0> {
  public:
    Series() = default;
    Series(const Series& other) { *this = other; }
    Series& operator=(const Series& other) {
        if (this != &other) {
            size_ = 0;
            reserve(other.size_);
            size_ = other.size_;
            std::copy(other.values_.get(), other.values_.get() + size_, values_.get());
        }
        return *this;
    }
    Series(Series&&) noexcept = default;
    Series& operator=(Series&&) noexcept = default;
    ~Series() = default;

    std::size_t size() const noexcept { return size_; }
    T& operator[](std::size_t place) noexcept { return values_[place]; }
    const T& operator[](std::size_t place) const noexcept { return values_[place]; }
    const T* begin() const noexcept { return values_.get(); }
    const T* end() const noexcept { return begin() + size_; }

    void push(T value, Site) {
        reserve(size_ + 1);
        values_[size_++] = std::move(value);
    }
    void resize(std::size_t size) {
        reserve(size);
        for (; size_ < size; ++size_) {
            values_[size_] = T{};
        }
        size_ = size;
    }
    void shrink(std::size_t size) noexcept { size_ = size; }

  private:
    void reserve(std::size_t size) {
        if (size > capacity_) [[unlikely]] {
            const std::size_t larger = std::max(size, 2 * capacity_ + 8);
            auto values = std::make_unique<T[]>(larger);
            std::move(values_.get(), values_.get() + size_, values.get());
            values_ = std::move(values);
            capacity_ = larger;
        }
    }

    std::unique_ptr<T[]> values_;
    std::size_t size_ = 0;
    std::size_t capacity_ = 0;
};
#endif

}  // namespace groundstate::machine
