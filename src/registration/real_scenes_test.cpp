// SPDX-License-Identifier: Apache-2.0
// No board stands in the recorded sequences: none may be found.
#include <gtest/gtest.h>

#include <map>
#include <utility>

#include "capture/folder_calibration.h"
#include "files/file_bytes.h"
#include "files/png_file.h"
#include "registration/lattice_detector.h"
#include "testing/shared_data.h"

namespace theatron::registration {
namespace {

namespace fs = std::filesystem;

std::string text_of(const fs::path& file) {
    const Bytes bytes = files::read_file(file, 1 << 20);
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

// The lens of a sequence: from the file beside it, or as its source states it. Empty: nobody says.
std::optional<CameraModel> lens_of(const fs::path& sequence, Size size) {
    capture::ParsedCalibration parsed;
    if (fs::exists(sequence / "calibration.json"))
        parsed =
            capture::parse_folder_calibration(text_of(sequence / "calibration.json"), size, {});
    else if (fs::exists(sequence / "camera-intrinsics.txt"))
        parsed =
            capture::parse_intrinsics_matrix(text_of(sequence / "camera-intrinsics.txt"), size, {});
    EXPECT_EQ(parsed.problem, "") << sequence;
    if (parsed.calibration.depth.fx > 0)
        return parsed.calibration.depth;
    // In pixels. The Azure Kinect in half of its resolution has the usual one of its narrow lens.
    static const std::map<std::string, double> focal_lengths{
        {"static-tof-picozense_640x480", 456.6},
        {"turning-person_640x480", 525},
        {"azure-nfov-2x2-pair-person_320x288", 252},
        {"azure-nfov-2x2-pair-room_320x288", 252}};
    const auto known = focal_lengths.find(sequence.filename().string());
    if (known == focal_lengths.end())
        return {};
    return CameraModel{
        size, known->second, known->second, size.width / 2.0 - 0.5, size.height / 2.0 - 0.5, {},
        {}};
}

TEST(LatticeDetectorOnRealData, FindsNoBoardInAnyFrame) {
    THEATRON_REQUIRE_DATA("README.md");
    int frames = 0, guessed = 0;
    for (const auto& sequence : fs::directory_iterator(testing::shared_data())) {
        if (!fs::is_directory(sequence.path() / "depth"))
            continue;
        std::optional<LatticeDetector> detector;
        for (const auto& file : fs::directory_iterator(sequence.path() / "depth")) {
            if (file.path().extension() != ".png")
                continue;
            DepthImage depth = files::read_depth_png(file.path());
            if (!detector) {
                const auto lens = lens_of(sequence.path(), depth.size);
                guessed += !lens;
                if (sequence.path().filename() == "moving-7scenes_640x480") {
                    ASSERT_TRUE(lens);
                    EXPECT_EQ(lens->fx, 585);
                }
                detector.emplace(lens.value_or(pinhole(depth.size, 65)), 1, large_target());
            }
            EXPECT_FALSE(detector->detect(std::as_const(depth).view())) << file.path();
            ++frames;
        }
    }
    EXPECT_GT(frames, 0);
    EXPECT_LE(guessed, 2) << "table-person and room-person do not state their lens";
}

}  // namespace
}  // namespace theatron::registration
