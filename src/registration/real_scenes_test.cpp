// SPDX-License-Identifier: Apache-2.0
// No board stands in the recorded sequences: none may be found.
#include <gtest/gtest.h>

#include <utility>

#include "files/png_file.h"
#include "registration/lattice_detector.h"
#include "testing/shared_data.h"

namespace theatron::registration {
namespace {

namespace fs = std::filesystem;

TEST(LatticeDetectorOnRealData, FindsNoBoardInAnyFrame) {
    THEATRON_REQUIRE_DATA("README.md");
    int frames = 0;
    for (const auto& sequence : fs::directory_iterator(testing::shared_data())) {
        if (!fs::is_directory(sequence.path() / "depth"))
            continue;
        std::optional<LatticeDetector> detector;
        for (const auto& file : fs::directory_iterator(sequence.path() / "depth")) {
            if (file.path().extension() != ".png")
                continue;
            DepthImage depth = files::read_depth_png(file.path());
            if (!detector)
                detector.emplace(pinhole(depth.size, 65), 1, large_target());
            EXPECT_FALSE(detector->detect(std::as_const(depth).view())) << file.path();
            ++frames;
        }
    }
    EXPECT_GT(frames, 0);
}

}  // namespace
}  // namespace theatron::registration
