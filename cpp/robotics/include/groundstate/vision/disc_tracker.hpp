// Four discs followed from image to image, always in the same order.
//
// searching   the whole image is searched until four discs are seen that form a convex quadrangle; of all such sets and of
//             the four ways to number one around, the one nearest to where the discs are expected is taken.
// tracking    each disc is measured near where it should be by now.
// predicting  some disc is lost (covered, or out of the image) and stands where the others say: with three seen by the
//             affine map of the last image they were all in, with fewer by the last velocity. After `most_predicted` images
//             in a row the set is given up and searched again.
//
// A disc whose area jumps is taken for covered in part: its centroid is wrong. Nothing here throws.
#pragma once

#include <array>

#include "disc_detector.hpp"

namespace groundstate::vision {

enum class Track { searching, tracking, predicting };

struct TrackerSettings {
    DiscSettings discs{};
    int most_predicted = 10;      ///< images
    double most_jump = 1.25;      ///< of a disc's area from image to image, as a factor
    double most_alike = 2.5;      ///< of the areas of two discs of the set, as a factor
    double most_distance = 1e9;   ///< pixels between a disc that is found and where it is expected
};

/// What an image told. While searching there are no pixels.
struct Tracked {
    Track track = Track::searching;
    servo::Pixels pixels{};
    std::array<bool, servo::points> measured{};  ///< seen in this image, not predicted
    std::array<double, servo::points> areas{};
    int predicted_images = 0;  ///< in a row

    explicit operator bool() const noexcept { return track != Track::searching; }
};

/// Who: one thread.
class DiscTracker {
  public:
    DiscTracker(int width, int height, const TrackerSettings& settings = {})
        : settings_{settings}, detector_{width, height, settings.discs} {}

    /// Where the discs will be when they are searched next: what numbers them. Without it the first is the one nearest to
    /// the top left corner, the others follow clockwise.
    void expect(const servo::Pixels& pixels) noexcept;

    /// The set is lost: it is searched again from the next image on, near where it should be.
    void give_up() noexcept;

    /// Looks at the next image, taken at that time. Allocates: only while searching.
    const Tracked& look(ConstFrameView image, std::int64_t captured_ns);

    const Tracked& present() const noexcept { return present_; }
    long searches() const noexcept { return searches_; }  ///< of whole images

  private:
    void search(ConstFrameView image);
    void follow(ConstFrameView image, std::int64_t captured_ns);
    void predict(Tracked& next, const servo::Pixels& moved) const noexcept;

    TrackerSettings settings_;
    DiscDetector detector_;
    Tracked present_{};
    servo::Pixels expected_{};
    bool expecting_ = false;
    std::int64_t captured_ns_ = 0;
    std::array<servo::Pixel, servo::points> velocity_{};  // pixels/s
    servo::Pixels whole_{};                               // when all were seen last
    long searches_ = 0;
};

}  // namespace groundstate::vision
