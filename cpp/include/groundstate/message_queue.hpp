// Messages in their order, each of them once: a bounded queue between one sender and one receiver.
//
// The protocol of library/patterns/MessageQueue.asm: the sender alone writes `sent`, the receiver alone `taken`; the
// length is the difference. The sender decides what happens if the queue is full. `try_send` is refused, and that is
// counted; `send` waits for room while its watchdog has time, and is then refused. Nothing is overwritten. If only the
// newest datum matters, use a swinging buffer. For several senders, use one queue for each.
// library/runtime/QueueSteps.asm is this file and signal.hpp step by atomic step.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <type_traits>
#include <utility>

#include "observer.hpp"
#include "signal.hpp"
#include "watchdog.hpp"

namespace groundstate {

/// At most `Capacity` messages between one sender and one receiver.
template <class T, std::size_t Capacity, Clock C, class Observer = Unobserved>
class MessageQueue {
    static_assert(Capacity > 0);

  public:
    explicit MessageQueue(C& clock, Observer observer = {}) noexcept
        : observer_{observer}, clock_{clock}, room_{clock} {}

    MessageQueue(const MessageQueue&) = delete;
    MessageQueue& operator=(const MessageQueue&) = delete;

    /// The signal is raised for every message. Who: the builder of the system, before the tasks start.
    void wakes(Signal<C>& trigger) noexcept { trigger_ = &trigger; }

    /// Appends a message, or refuses it if the queue is full; a refused one stays as it is. Who: the sender. Blocks: no.
    /// Allocates: only if assigning a T does. Worst case: one assignment of a T, and one system call if the receiver waits.
    bool try_send(const T& message) noexcept(std::is_nothrow_copy_assignable_v<T>)
        requires(std::is_copy_assignable_v<T>)
    {
        return try_append(message);
    }
    /// The same for a message that is moved, such as one that cannot be copied.
    bool try_send(T&& message) noexcept(std::is_nothrow_move_assignable_v<T>) { return try_append(std::move(message)); }

    /// Appends a message; waits for room until the watchdog's budget is used up, then refuses it.
    /// Who: the sender. Blocks: at most for the budget. Allocates: only if assigning a T does.
    bool send(const T& message, Watchdog& watchdog) noexcept(std::is_nothrow_copy_assignable_v<T>)
        requires(std::is_copy_assignable_v<T>)
    {
        return append_in_time(message, watchdog);
    }
    /// The same of a message that is moved.
    bool send(T&& message, Watchdog& watchdog) noexcept(std::is_nothrow_move_assignable_v<T>) {
        return append_in_time(std::move(message), watchdog);
    }

    /// The oldest message, or nothing. Who: the receiver. Blocks: no. Allocates: no. Worst case: moves one T, and one
    /// system call if the sender waits for room.
    std::optional<T> receive() noexcept(std::is_nothrow_move_constructible_v<T>) {
        if (empty()) {
            observer_.takes(0);
            return std::nullopt;
        }
        const std::uint64_t taken = taken_.load(std::memory_order_relaxed);
        std::optional<T> message{std::move(slots_[taken % Capacity])};
        observer_.takes(taken + 1);
        // SYNC(taken): release, after the slot was read; pairs with the acquire in full().
        taken_.store(taken + 1, std::memory_order_release);
        room_.raise();
        return message;
    }

    /// Who: the receiver. Blocks: no.
    bool empty() const noexcept {
        // SYNC(sent): acquire, before the slot is read; pairs with the release in append().
        return sent_.load(std::memory_order_acquire) == taken_.load(std::memory_order_relaxed);
    }

    /// Who: the sender. Blocks: no.
    bool full() const noexcept {
        // SYNC(taken): acquire, before the slot is written again; pairs with the release in receive().
        return sent_.load(std::memory_order_relaxed) - taken_.load(std::memory_order_acquire) == Capacity;
    }

    // Who: any thread. Block: no.
    std::int64_t sent() const noexcept { return static_cast<std::int64_t>(sent_.load(std::memory_order_relaxed)); }
    std::int64_t taken() const noexcept { return static_cast<std::int64_t>(taken_.load(std::memory_order_relaxed)); }
    std::int64_t refused() const noexcept { return refused_.value(); }

  private:
    void refuse() noexcept {
        observer_.refuses();
        refused_.add();
    }

    template <class Given>
    bool try_append(Given&& message) {
        observer_.looks();
        if (full()) {
            refuse();
            return false;
        }
        append(std::forward<Given>(message));
        return true;
    }

    template <class Given>
    bool append_in_time(Given&& message, Watchdog& watchdog) {
        observer_.looks();
        if (full() && !await_room(watchdog)) {
            refuse();
            watchdog.skip();
            return false;
        }
        append(std::forward<Given>(message));
        return true;
    }

    template <class Given>
    void append(Given&& message) {
        const std::uint64_t sent = sent_.load(std::memory_order_relaxed);
        slots_[sent % Capacity] = std::forward<Given>(message);
        observer_.sends(sent + 1);
        // SYNC(sent): release, after the slot was written; pairs with the acquire in empty().
        sent_.store(sent + 1, std::memory_order_release);
        if (trigger_ != nullptr) {
            trigger_->raise();
        }
    }

    bool await_room(Watchdog& watchdog) noexcept {
        const std::int64_t start_ns = clock_.now_ns();
        const std::int64_t until_ns = later_ns(start_ns, watchdog.left_ns());
        bool room = false;
        for (std::int64_t now_ns = start_ns; !room && now_ns < until_ns; now_ns = clock_.now_ns()) {
            const std::uint32_t seen = room_.count();
            if (full()) {
                room_.wait_while(seen, until_ns);
            }
            room = !full();
        }
        watchdog.waited(clock_.now_ns() - start_ns);
        return room;
    }

    [[no_unique_address]] Observer observer_;
    C& clock_;
    Signal<C> room_;
    Signal<C>* trigger_ = nullptr;
    std::array<T, Capacity> slots_{};
    alignas(64) std::atomic<std::uint64_t> sent_{0};
    Counter refused_{};
    alignas(64) std::atomic<std::uint64_t> taken_{0};
};

}  // namespace groundstate
