// OpenCV's matrices over the caller's memory, and what a decoder gives brought into them.
#pragma once

#include <opencv2/imgproc.hpp>

#include <groundstate/frame.hpp>

namespace groundstate::opencv {

/// The pixels as they are laid out in memory; OpenCV's own order of colours is that of bgr8.
inline int type_of(PixelFormat format) { return format == PixelFormat::mono8 ? CV_8UC1 : CV_8UC3; }

inline cv::Mat picture_of(const FrameView& view) {
    return {view.shape.height, view.shape.width, type_of(view.shape.format), view.pixels, view.stride_bytes};
}

/// What OpenCV gives can be written into the view as it is.
inline bool in_place(PixelFormat format, int type) { return format != PixelFormat::rgb8 && type == type_of(format); }

/// Writes a picture of the same size into the view. False if its pixels are neither grey nor colour of 8 bits.
inline bool convert(const cv::Mat& from, const FrameView& into) {
    const bool grey = into.shape.format == PixelFormat::mono8;
    const bool swapped = into.shape.format == PixelFormat::rgb8;
    cv::Mat to = picture_of(into);
    switch (from.type()) {
        case CV_8UC1:
            grey ? from.copyTo(to) : cv::cvtColor(from, to, cv::COLOR_GRAY2BGR);
            return true;
        case CV_8UC3:
            grey      ? cv::cvtColor(from, to, cv::COLOR_BGR2GRAY)
            : swapped ? cv::cvtColor(from, to, cv::COLOR_BGR2RGB)
                      : from.copyTo(to);
            return true;
        case CV_8UC4:
            cv::cvtColor(from, to, grey ? cv::COLOR_BGRA2GRAY : swapped ? cv::COLOR_BGRA2RGB : cv::COLOR_BGRA2BGR);
            return true;
        default: return false;
    }
}

inline bool same_size(const cv::Mat& picture, const FrameShape& shape) {
    return picture.cols == shape.width && picture.rows == shape.height;
}

}  // namespace groundstate::opencv
