// The scene of the tests: four discs at the corners of a square, a metre before the camera.
#pragma once

#include <groundstate/simulated/camera.hpp>

namespace groundstate::simulated {

inline Scene four_discs() {
    return Scene{{{.centre = {-0.1, -0.1, 1}},
                  {.centre = {0.1, -0.1, 1}},
                  {.centre = {0.1, 0.1, 1}},
                  {.centre = {-0.1, 0.1, 1}}},
                 Intrinsics{}};
}

}  // namespace groundstate::simulated
