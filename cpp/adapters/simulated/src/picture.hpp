// A view of pixels as OpenCV has it: the same memory.
#pragma once

#include <opencv2/core.hpp>

#include <groundstate/frame.hpp>

namespace groundstate::simulated {

inline cv::Mat picture_of(const FrameView& view) {
    return {view.shape.height, view.shape.width, view.shape.format == PixelFormat::mono8 ? CV_8UC1 : CV_8UC3,
            view.pixels, view.stride_bytes};
}

}  // namespace groundstate::simulated
