// What lies between the scene and the picture: something that covers a disc, a lens that is not sharp, a sensor that is
// noisy. A picture in, the same picture worse, in place; which frames and how is drawn from the seed and the number.
#pragma once

#include "exposures.hpp"
#include "scene.hpp"

namespace groundstate::simulated {

/// Makes pictures of a scene worse, as its faults say.
class Lens {
  public:
    /// Allocates: yes.
    Lens(const Faults& faults, const FrameShape& shape);

    /// The disc that is covered in that frame; the number of discs if none is.
    std::size_t covered(std::uint64_t frame, std::size_t discs) const noexcept;

    /// Who: one thread a view. Blocks: no. Allocates: if there is blur, within OpenCV.
    /// Worst case: four passes over the picture.
    void spoil(std::uint64_t frame, const Scene& scene, const Pose& camera, FrameView picture) const;

  private:
    void cover(std::uint64_t frame, const Scene& scene, const Pose& camera, FrameView picture) const;
    void blur(const Scene& scene, const Pose& camera, FrameView picture) const;
    void add_noise(std::uint64_t frame, FrameView picture) const;

    // The noise is drawn once, a field that is larger than a picture; each frame takes another part of it.
    static constexpr std::size_t margin = 64;

    Faults faults_;
    std::size_t field_width_;
    std::vector<std::uint8_t> brighter_{};
    std::vector<std::uint8_t> darker_{};
};

}  // namespace groundstate::simulated
