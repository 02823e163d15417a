// What holds of every source of images, whatever gives them: typed tests that each adapter instantiates with its rig.
//
// A Rig opens one source of the adapter by a script and lets time pass between two grabs:
//
//     using Source;                       a FrameSource
//     Opened<Source> open(const Script&)  a new one, whose camera does what the script says
//     void pass()                         so much happens that the next frame can come
//
// Suites: EverySource for all; SourceThatEnds, SourceThatUnplugs, SourceThatWaits, SourceThatLoses and
// SourceThatIsDamaged for those whose world can do so. No test looks at how long anything took.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

#include <groundstate/frame_source.hpp>

namespace groundstate::conformance {

/// What the camera behind a source is to do.
struct Script {
    std::uint64_t frames = 12;  ///< it takes so many, and then comes the end
    bool unplugged = false;     ///< the end is that the camera is gone; else that the recording is over
    bool loses = false;         ///< some frames never arrive, or too late
    bool damages = false;       ///< some frames are damaged
    bool late = false;          ///< the first frame does not come within `short_budget_ns`
};

inline constexpr std::int64_t short_budget_ns = 1'000'000;
inline constexpr std::int64_t ample_budget_ns = 2'000'000'000;

/// Memory for a picture whose rows lie apart; what is between and around them is watched over.
class Canvas {
  public:
    Canvas(const FrameShape& shape, std::size_t gap_bytes, std::uint8_t fill)
        : shape_{shape},
          stride_{shape.row_bytes() + gap_bytes},
          memory_(2 * guard + stride_ * static_cast<std::size_t>(shape.height), watched) {
        for (int y = 0; y < shape.height; ++y) {
            std::fill_n(view().row(y), shape.row_bytes(), fill);
        }
    }

    FrameView view() { return {memory_.data() + guard, shape_, stride_}; }

    std::vector<std::uint8_t> pixels() {
        std::vector<std::uint8_t> all;
        for (int y = 0; y < shape_.height; ++y) {
            all.insert(all.end(), view().row(y), view().row(y) + shape_.row_bytes());
        }
        return all;
    }

    bool nothing_beside_was_written() {
        bool kept = std::all_of(memory_.begin(), memory_.begin() + guard, [](auto byte) { return byte == watched; });
        for (int y = 0; y < shape_.height; ++y) {
            std::uint8_t* const gap = view().row(y) + shape_.row_bytes();
            kept = kept && std::all_of(gap, view().row(y) + stride_, [](auto byte) { return byte == watched; });
        }
        return kept && std::all_of(memory_.end() - guard, memory_.end(), [](auto byte) { return byte == watched; });
    }

  private:
    static constexpr std::uint8_t watched = 0xa5;
    static constexpr std::ptrdiff_t guard = 64;

    FrameShape shape_;
    std::size_t stride_;
    std::vector<std::uint8_t> memory_;
};

/// A source, opened by a script, and memory for its frames.
template <class Rig>
class Sitting : public testing::Test {
  protected:
    void open(const Script& script) {
        source.emplace(rig.open(script));
        ASSERT_TRUE(*source) << source->failure().text;
        canvas.emplace(shape(), 0, std::uint8_t{0});
    }

    FrameShape shape() const { return (*source)->shape(); }

    Grab grab(std::int64_t budget_ns = ample_budget_ns) {
        Watchdog watchdog{budget_ns};
        return (*source)->grab(canvas->view(), watchdog);
    }

    // What the grabs gave, up to the end; a camera that goes on says nothing else for long before.
    std::vector<Grab> grab_all() {
        std::vector<Grab> all;
        do {
            all.push_back(grab());
            rig.pass();
        } while (!is_final(all.back().outcome) && all.size() < 10'000);
        return all;
    }

    static bool is_final(Outcome outcome) {
        return outcome == Outcome::end_of_stream || outcome == Outcome::disconnected;
    }

    void expect_final(Outcome outcome) {
        const std::vector<Grab> all = grab_all();
        EXPECT_EQ(all.back().outcome, outcome) << text(all.back().outcome);
        const FrameAccount before = (*source)->account();
        canvas.emplace(shape(), 0, std::uint8_t{77});
        for (int again = 0; again < 5; ++again) {
            Watchdog watchdog{ample_budget_ns};
            const Grab more = (*source)->grab(canvas->view(), watchdog);
            EXPECT_EQ(more.outcome, outcome) << text(more.outcome);
            EXPECT_EQ(more.sequence, 0u);
            EXPECT_EQ(watchdog.left_ns(), ample_budget_ns) << "at once";
            rig.pass();
        }
        const auto pixels = canvas->pixels();
        EXPECT_TRUE(std::all_of(pixels.begin(), pixels.end(), [](auto pixel) { return pixel == 77; }));
        EXPECT_EQ((*source)->account().delivered, before.delivered);
        EXPECT_EQ((*source)->account().timeouts, before.timeouts);
    }

    Rig rig{};
    std::optional<Opened<typename Rig::Source>> source{};
    std::optional<Canvas> canvas{};
};

template <class Rig>
class EverySource : public Sitting<Rig> {};
TYPED_TEST_SUITE_P(EverySource);
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(EverySource);

TYPED_TEST_P(EverySource, IsAFrameSource) {
    static_assert(FrameSource<typename TypeParam::Source>);
    static_assert(!std::is_copy_constructible_v<typename TypeParam::Source>);
}

TYPED_TEST_P(EverySource, NumbersAndStampsRise) {
    this->open({});
    std::uint64_t sequence = 0;
    std::int64_t stamp_ns = INT64_MIN;
    int frames = 0;
    for (const Grab& grab : this->grab_all()) {
        if (!grab) {
            continue;
        }
        EXPECT_EQ(grab.sequence, sequence + grab.lost + 1);
        EXPECT_GT(grab.stamp_ns, stamp_ns);
        sequence = grab.sequence;
        stamp_ns = grab.stamp_ns;
        ++frames;
    }
    EXPECT_GT(frames, 5);
    const FrameAccount account = (*this->source)->account();
    EXPECT_EQ(account.delivered, frames);
    EXPECT_EQ(static_cast<std::uint64_t>(account.delivered + account.lost), sequence);
}

TYPED_TEST_P(EverySource, FillsThePictureAndNothingElse) {
    this->open({});
    for (const std::size_t gap : {0u, 3u, 64u}) {
        this->canvas.emplace(this->shape(), gap, std::uint8_t{0});
        ASSERT_TRUE(this->grab());
        EXPECT_TRUE(this->canvas->nothing_beside_was_written());
        this->rig.pass();
    }
}

TYPED_TEST_P(EverySource, TheSamePictureWhateverWasThereAndHoweverItLies) {
    std::vector<std::vector<std::uint8_t>> pictures;
    for (const std::size_t gap : {0u, 32u}) {
        this->open({});
        this->canvas.emplace(this->shape(), gap, static_cast<std::uint8_t>(gap));
        ASSERT_TRUE(this->grab());
        pictures.push_back(this->canvas->pixels());
        this->source.reset();
    }
    EXPECT_EQ(pictures[0], pictures[1]);
    EXPECT_NE(std::count(pictures[0].begin(), pictures[0].end(), pictures[0].front()),
              static_cast<std::ptrdiff_t>(pictures[0].size()))
        << "there is something to be seen";
}

TYPED_TEST_P(EverySource, RefusesMemoryOfAnotherShape) {
    this->open({});
    const FrameShape shape = this->shape();
    FrameShape lower = shape;
    --lower.height;
    FrameShape broader = shape;
    ++broader.width;
    FrameShape other = shape;
    other.format = shape.format == PixelFormat::mono8 ? PixelFormat::bgr8 : PixelFormat::mono8;
    for (const FrameShape& wrong : {lower, broader, other}) {
        this->canvas.emplace(wrong, 0, std::uint8_t{77});
        EXPECT_EQ(this->grab().outcome, Outcome::other_shape);
        const auto pixels = this->canvas->pixels();
        EXPECT_TRUE(std::all_of(pixels.begin(), pixels.end(), [](auto pixel) { return pixel == 77; }));
    }
    EXPECT_EQ((*this->source)->account().other_shape, 3);
    this->canvas.emplace(shape, 0, std::uint8_t{0});
    FrameView narrow = this->canvas->view();
    --narrow.stride_bytes;
    Watchdog watchdog{ample_budget_ns};
    EXPECT_EQ((*this->source)->grab(narrow, watchdog).outcome, Outcome::other_shape) << "rows that overlap";
    EXPECT_TRUE(this->grab()) << "the source is none the worse";
}

TYPED_TEST_P(EverySource, ClosesWhatItOpened) {
    for (int times = 0; times < 3; ++times) {
        this->open({});
        EXPECT_TRUE(this->grab());
        this->source.reset();
    }
}

REGISTER_TYPED_TEST_SUITE_P(EverySource, IsAFrameSource, NumbersAndStampsRise, FillsThePictureAndNothingElse,
                            TheSamePictureWhateverWasThereAndHoweverItLies, RefusesMemoryOfAnotherShape,
                            ClosesWhatItOpened);

template <class Rig>
class SourceThatEnds : public Sitting<Rig> {};
TYPED_TEST_SUITE_P(SourceThatEnds);
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(SourceThatEnds);
TYPED_TEST_P(SourceThatEnds, SaysSoFromThenOn) {
    this->open({.frames = 7});
    this->expect_final(Outcome::end_of_stream);
}
REGISTER_TYPED_TEST_SUITE_P(SourceThatEnds, SaysSoFromThenOn);

template <class Rig>
class SourceThatUnplugs : public Sitting<Rig> {};
TYPED_TEST_SUITE_P(SourceThatUnplugs);
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(SourceThatUnplugs);
TYPED_TEST_P(SourceThatUnplugs, SaysSoFromThenOn) {
    this->open({.frames = 7, .unplugged = true});
    this->expect_final(Outcome::disconnected);
    EXPECT_GT((*this->source)->account().delivered, 0);
}
REGISTER_TYPED_TEST_SUITE_P(SourceThatUnplugs, SaysSoFromThenOn);

template <class Rig>
class SourceThatWaits : public Sitting<Rig> {};
TYPED_TEST_SUITE_P(SourceThatWaits);
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(SourceThatWaits);
TYPED_TEST_P(SourceThatWaits, NoLongerThanTheWatchdogAllows) {
    this->open({.late = true});
    Watchdog watchdog{short_budget_ns};
    EXPECT_EQ((*this->source)->grab(this->canvas->view(), watchdog).outcome, Outcome::timeout);
    EXPECT_EQ(watchdog.skipped(), 1);
    EXPECT_EQ(watchdog.left_ns(), 0) << "it waited as long as it may";
    EXPECT_EQ((*this->source)->grab(this->canvas->view(), watchdog).outcome, Outcome::timeout) << "it only looks";
    EXPECT_EQ((*this->source)->account().timeouts, 2);
    Grab grab{};
    for (int times = 0; times < 1'000 && !grab; ++times) {
        this->rig.pass();
        watchdog.restart();
        grab = (*this->source)->grab(this->canvas->view(), watchdog);
    }
    EXPECT_TRUE(grab) << "late, but it comes";
}
REGISTER_TYPED_TEST_SUITE_P(SourceThatWaits, NoLongerThanTheWatchdogAllows);

template <class Rig>
class SourceThatLoses : public Sitting<Rig> {};
TYPED_TEST_SUITE_P(SourceThatLoses);
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(SourceThatLoses);
TYPED_TEST_P(SourceThatLoses, CountsThem) {
    this->open({.frames = 40, .loses = true});
    std::int64_t lost = 0;
    std::int64_t delivered = 0;
    std::uint64_t sequence = 0;
    for (const Grab& grab : this->grab_all()) {
        if (grab) {
            EXPECT_EQ(grab.sequence, sequence + grab.lost + 1);
            sequence = grab.sequence;
            lost += static_cast<std::int64_t>(grab.lost);
            ++delivered;
        }
    }
    EXPECT_GT(lost, 0);
    EXPECT_GT(delivered, 0);
    EXPECT_LE(sequence, 40u);
    EXPECT_EQ((*this->source)->account().lost, lost);
    EXPECT_EQ((*this->source)->account().delivered, delivered);
}
REGISTER_TYPED_TEST_SUITE_P(SourceThatLoses, CountsThem);

template <class Rig>
class SourceThatIsDamaged : public Sitting<Rig> {};
TYPED_TEST_SUITE_P(SourceThatIsDamaged);
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(SourceThatIsDamaged);
TYPED_TEST_P(SourceThatIsDamaged, SaysSoAndGoesOn) {
    this->open({.frames = 40, .damages = true});
    const std::vector<Grab> all = this->grab_all();
    const auto is_damaged = [](const Grab& grab) { return grab.outcome == Outcome::damaged; };
    const auto damaged = std::find_if(all.begin(), all.end(), is_damaged);
    ASSERT_NE(damaged, all.end());
    EXPECT_EQ(damaged->sequence, 0u);
    const auto good = std::find_if(damaged, all.end(), [](const Grab& grab) { return bool(grab); });
    ASSERT_NE(good, all.end()) << "the next may be good";
    EXPECT_GE(good->lost, 1u) << "the damaged one is among the lost";
    const FrameAccount account = (*this->source)->account();
    EXPECT_GE(account.lost, 1);
    EXPECT_EQ(account.damaged, std::count_if(all.begin(), all.end(), is_damaged));
}
REGISTER_TYPED_TEST_SUITE_P(SourceThatIsDamaged, SaysSoAndGoesOn);

}  // namespace groundstate::conformance
