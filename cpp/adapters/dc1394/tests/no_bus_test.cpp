// The real library on a machine without a bus, or without a camera on it: a clear word, and nothing left behind.
#include <gtest/gtest.h>

#include <groundstate/dc1394/camera.hpp>

namespace groundstate::dc1394 {
namespace {

TEST(NoBus, OpeningSaysThatNothingIsThere) {
    for (int times = 0; times < 3; ++times) {
        // A camera of this identifier cannot be: it is that of no vendor.
        const auto camera = Camera::open({.guid = 1});
        ASSERT_FALSE(camera);
        EXPECT_EQ(camera.failure().error, OpenError::not_found) << camera.failure().text;
        EXPECT_NE(camera.failure().text.find("IEEE 1394 bus"), std::string::npos) << camera.failure().text;
    }
}

TEST(NoBus, EnumeratingWorks) {
    const Enumeration found = enumerate();
    EXPECT_TRUE(found.failure.text.empty() || found.cameras.empty());
    for (const Identity& camera : found.cameras) {
        EXPECT_NE(camera.guid, 1u);
    }
}

}  // namespace
}  // namespace groundstate::dc1394
