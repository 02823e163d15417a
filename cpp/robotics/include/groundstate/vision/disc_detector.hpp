// Where discs are seen: in the whole image, and near a place.
//
// Grey levels become weights, 0 for the background and 1 for the disc; a disc's centre is the centroid of the weights, to a
// hundredth of a pixel, and its area their sum. The whole image is searched by threshold and connected components (some
// milliseconds); near a place a region of a few discs' radii is weighed (microseconds).
//
// OpenCV's core and imgproc do the work and stay behind this interface. Buffers are of the size of the images from the
// beginning: `near` allocates nothing of its own.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include <groundstate/frame.hpp>

#include "../servo/image_points.hpp"

namespace groundstate::vision {

/// What is looked for.
struct DiscSettings {
    bool dark = true;           ///< darker than what is around it
    double least_area = 60;     ///< pixels
    double most_area = 20'000;  ///< pixels
    double most_aspect = 2.5;   ///< of the ellipse's axes
    int level = -1;             ///< grey level between disc and background; -1: Otsu's, taken at each search
};

struct Disc {
    servo::Pixel centre{};
    double area = 0;    ///< pixels
    double aspect = 1;  ///< of the axes of the ellipse with the same moments, at least 1
};

/// Who: one thread. It knows no order of discs and nothing of earlier images but the grey levels.
class DiscDetector {
  public:
    /// For images of at most this size. From then on OpenCV computes in the thread that calls it, in the whole program.
    /// Allocates: yes.
    DiscDetector(int width, int height, const DiscSettings& settings);
    ~DiscDetector();
    DiscDetector(const DiscDetector&) = delete;
    DiscDetector& operator=(const DiscDetector&) = delete;

    /// All discs of the image, at most `most_found`, the largest first; also takes the grey levels. The reference holds
    /// until the next search. Allocates: within OpenCV. Worst case: some milliseconds.
    const std::vector<Disc>& search(ConstFrameView image);
    static constexpr std::size_t most_found = 16;

    /// The disc nearest to a place, if it lies whole within `reach` pixels around it; what does not touch it may be there,
    /// too. Nothing before the first search. Allocates: no. Worst case: in proportion to the square of the reach.
    std::optional<Disc> near(ConstFrameView image, servo::Pixel place, double reach);

  private:
    struct Buffers;
    DiscSettings settings_;
    std::unique_ptr<Buffers> buffers_;
};

}  // namespace groundstate::vision
