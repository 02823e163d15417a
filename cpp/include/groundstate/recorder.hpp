// The log of a run: events from the rings of the tasks, written as MCAP by a thread of its own.
//
// Each task has a topic, and each event is a message: JSON with a schema, so every viewer of MCAP files shows them. If
// the file cannot be written any more (the disk is full), the log ends and the robot goes on: `error` says why. A
// metadata record "end" says how many events each task had, and when the run was stopped; from it a reader knows
// whether the log is whole. For programs that read along, a record "stop" comes before the first event of a task that
// was asked to stop.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "clock.hpp"
#include "event.hpp"
#include "mcap_file.hpp"

namespace groundstate {

/// What a task does if its ring is full: in real time it loses events; in virtual time, which stands still meanwhile,
/// it waits for the writer.
enum class WhenFull { lose, wait };

/// The events of one task.
class TaskLog {
  public:
    explicit TaskLog(WhenFull when_full) noexcept : when_full_{when_full} {}

    /// Records an event; `now` gives its instant. Who: the task. Blocks: no, unless set to wait. Allocates: no. Worst
    /// case: one store of 32 bytes into the ring.
    template <class Now>
    void record(Event event, Now&& now) noexcept {
        // SYNC(stamping): before the clock is read. Relaxed: the writer of the log gives it two milliseconds to arrive.
        stamping_.store(true, std::memory_order_relaxed);
        std::atomic_signal_fence(std::memory_order_seq_cst);
        event.time_ns = now();
        event.order = order_++;
        while (!ring_.push(event)) {
            if (when_full_ == WhenFull::lose) {
                lost_.add();
                break;
            }
            std::this_thread::yield();
        }
        // SYNC(stamping): release: a thread that sees this finds the event in the ring.
        stamping_.store(false, std::memory_order_release);
    }

    /// Who: any thread. Blocks: no.
    std::int64_t lost() const noexcept { return lost_.value(); }

  private:
    friend class Recorder;
    EventRing ring_{};
    std::atomic<bool> stamping_{false};
    std::uint32_t order_ = 0;
    WhenFull when_full_;
    Counter lost_{};
};

/// The log of all tasks. Built before the tasks start, finished after they have ended.
class Recorder {
  public:
    /// Opens the file and starts the writer. `names` are those of the objects that events name by their numbers, `now`
    /// is the time of events. Allocates, starts a thread.
    Recorder(const std::string& path, const std::vector<std::string>& tasks, std::vector<std::string> names,
             const McapFile::Map& about, WhenFull when_full, std::function<std::int64_t()> now)
        : file_{path}, names_{std::move(names)}, tasks_{tasks}, now_{std::move(now)} {
        const std::uint16_t schema = file_.schema("groundstate.Event", "jsonschema", json_schema);
        file_.metadata("groundstate", about);
        for (const std::string& task : tasks) {
            logs_.push_back(std::make_unique<TaskLog>(when_full));
            channels_.push_back(file_.channel(schema, "/" + task, "json"));
        }
        thread_ = std::thread{[this] { run(); }};
    }

    Recorder(const Recorder&) = delete;
    Recorder& operator=(const Recorder&) = delete;
    ~Recorder() { finish({}); }

    /// Who: the builder of the system.
    TaskLog& log(std::size_t task) noexcept { return *logs_[task]; }

    /// Announces that the tasks will be asked to stop. Who: the owner, before asking them. Blocks: no.
    //
    // Pairs with the load in `tell_stop`: an event of a task that was asked is pushed after this store, and popped
    // after that. So the thread that pops it sees the store, and writes the record first.
    void stopping(std::int64_t stopped_ns) noexcept { stopped_ns_.store(stopped_ns, std::memory_order_release); }

    /// Writes what is left, and the end of the file. Who: the owner, when no task records any more.
    void finish(McapFile::Map about) {
        if (!thread_.joinable()) {
            return;
        }
        stop_.store(true, std::memory_order_release);
        thread_.join();
        drain();
        for (std::size_t i = 0; i < logs_.size(); ++i) {
            about.emplace_back("events " + tasks_[i], std::to_string(logs_[i]->order_));
        }
        about.emplace_back("lost", std::to_string(lost()));
        file_.metadata("end", about);
        file_.finish();
        error_.store(file_.error(), std::memory_order_relaxed);
    }

    // Who: any thread. Block: no.
    /// The system's number of the file's error, or 0.
    int error() const noexcept { return error_.load(std::memory_order_relaxed); }
    std::int64_t lost() const noexcept {
        std::int64_t lost = 0;
        for (const auto& log : logs_) {
            lost += log->lost();
        }
        return lost;
    }

  private:
    static constexpr std::string_view json_schema =
        R"({"title":"groundstate.Event","type":"object","properties":{)"
        R"("order":{"type":"integer","description":"number among the task's events; a gap tells of lost ones"},)"
        R"("kind":{"type":"string"},"object":{"type":"string","description":"phase, channel or task"},)"
        R"("number":{"type":"integer","description":"of the datum, message or cycle; the bits of a value"},)"
        R"("known":{"type":"boolean","description":"there is a value"},)"
        R"("part":{"type":"integer","description":"of a tuple, which part the value is, from 0 on; 0 if left out"},)"
        R"("array":{"type":"integer","description":"the array worked on; of a swap the index read"},)"
        R"("next":{"type":"integer","description":"of a swap the index written"},)"
        R"("fresh":{"type":"boolean","description":"the reading brought something new"}}})";

    void run() {
        using std::chrono::milliseconds;
        for (int turn = 1; !stop_.load(std::memory_order_acquire); ++turn) {
            if (!drain()) {
                std::this_thread::sleep_for(milliseconds{2});
            }
            if (turn % 50 == 0) {
                tell_horizon();  // whoever follows the file sees it
                error_.store(file_.error(), std::memory_order_relaxed);
            }
        }
    }

    // Brings the file up to date, and says up to which instant it is. A reader that follows it then knows that a task
    // without events had none, and not that they are still to come. An instant is used two milliseconds later. A task
    // that has read the clock before it has raised its flag by then: a write that waits in a processor is done within
    // microseconds, and the flag of an interrupted task is written. If the flag is down again, the event is in the
    // ring.
    void tell_horizon() {
        const std::int64_t now_ns = now_();
        std::this_thread::sleep_for(std::chrono::milliseconds{2});
        // SYNC(stamping): acquire: the events of before are in the rings, and drained next.
        const bool settled = std::none_of(logs_.begin(), logs_.end(), [](const auto& log) {
            return log->stamping_.load(std::memory_order_acquire);
        });
        drain();
        file_.flush();
        if (settled) {
            file_.horizon(now_ns);
        }
    }

    bool drain() {
        bool any = false;
        for (std::size_t i = 0; i < logs_.size(); ++i) {
            Event event;
            while (logs_[i]->ring_.pop(event)) {
                any = true;
                tell_stop();
                if (file_.error() == 0) {
                    file_.message(channels_[i], event.order, static_cast<std::uint64_t>(event.time_ns), json(event));
                }
            }
        }
        return any;
    }

    void tell_stop() {
        const std::int64_t stopped_ns = stopped_ns_.load(std::memory_order_acquire);
        if (stopped_ns != never_ns && !stop_told_) {
            stop_told_ = true;
            file_.metadata("stop", {{"stopped_ns", std::to_string(stopped_ns)}});
        }
    }

    std::string_view json(const Event& event) {
        const auto number = static_cast<unsigned long long>(event.number);
        const std::string_view kind = word(event.kind);
        int length = std::snprintf(text_.data(), text_.size(), R"({"order":%u,"kind":"%.*s","object":"%s","number":%llu)",
                                   event.order, static_cast<int>(kind.size()), kind.data(),
                                   names_[event.object].c_str(), number);
        const auto more = [&](const char* format, auto value) {
            const auto at = static_cast<std::size_t>(length);
            length += std::snprintf(text_.data() + at, text_.size() - at, format, value);
        };
        switch (event.kind) {
            case Kind::swaps:
                more(R"(,"array":%d)", int{event.array});
                more(R"(,"next":%d)", int{event.next});
                break;
            case Kind::reads:
                more(R"(,"array":%d)", int{event.array});
                more(R"(,"fresh":%s)", event.fresh ? "true" : "false");
                break;
            case Kind::loads: more(R"(,"fresh":%s)", event.fresh ? "true" : "false"); break;
            case Kind::writes: more(R"(,"array":%d)", int{event.array}); break;
            case Kind::gets:
                more(R"(,"known":%s)", event.array != 0 ? "true" : "false");
                more(R"(,"fresh":%s)", event.fresh ? "true" : "false");
                if (event.next != 0) {
                    more(R"(,"part":%d)", int{event.next});
                }
                break;
            case Kind::decides:
                more(R"(,"known":%s)", event.array != 0 ? "true" : "false");
                if (event.next != 0) {
                    more(R"(,"part":%d)", int{event.next});
                }
                break;
            default: break;
        }
        more("%s", "}");
        return {text_.data(), static_cast<std::size_t>(length)};
    }

    McapFile file_;
    std::vector<std::string> names_;
    std::vector<std::string> tasks_;
    std::function<std::int64_t()> now_;
    std::vector<std::unique_ptr<TaskLog>> logs_{};
    std::vector<std::uint16_t> channels_{};
    std::array<char, 512> text_{};
    std::atomic<bool> stop_{false};
    std::atomic<std::int64_t> stopped_ns_{never_ns};
    bool stop_told_ = false;
    std::atomic<int> error_{0};
    std::thread thread_{};
};

}  // namespace groundstate
