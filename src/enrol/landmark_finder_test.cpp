// SPDX-License-Identifier: Apache-2.0
#include "enrol/landmark_finder.h"

#include <gtest/gtest.h>

#include <fstream>

#include "enrol/photo_files.h"
#include "image/image.h"

namespace theatron::enrol {
namespace {

namespace fs = std::filesystem;

class LandmarkFinderTest : public ::testing::Test {
protected:
    LandmarkFinderTest() { fs::create_directories(folder); }
    ~LandmarkFinderTest() override { fs::remove_all(folder); }

    // A stand-in of theatron-landmarks: a shell script.
    LandmarkFinder finder(const std::string& script, Duration patience = std::chrono::seconds(60)) {
        const fs::path program = folder / "finder";
        std::ofstream(program) << "#!/bin/sh\n" << script << "\n";
        fs::permissions(program, fs::perms::owner_all);
        std::ofstream(folder / "model") << "model";
        return {program, folder / "model", patience};
    }
    static ColorImage photo(Size size) { return ColorImage(size); }

    const fs::path folder = fs::path(testing::TempDir()) / "theatron_landmark_finder";
};

TEST_F(LandmarkFinderTest, LandmarksAreThoseOfTheWholePhoto) {
    face::Landmarks landmarks{};
    for (std::size_t i = 0; i < landmarks.size(); ++i)
        landmarks[i] = {double(i), 2.0 * double(i)};
    std::ofstream(folder / "answer") << "faces: 2\n" << pts_text(landmarks);
    const LandmarkFinder found =
        finder("cat > " + (folder / "photo").string() + "; cat " + (folder / "answer").string());
    EXPECT_EQ(found.problem(), "");
    const auto small = found.find(photo({640, 480}).view());
    ASSERT_TRUE(small.landmarks_px) << small.problem;
    EXPECT_EQ((*small.landmarks_px)[67].y, 134);
    EXPECT_EQ(small.faces, 2);
    EXPECT_EQ(fs::file_size(folder / "photo"), 15u + 640 * 480 * 3);
    // A large photo is looked at smaller.
    const auto large = found.find(photo({2560, 1920}).view());
    ASSERT_TRUE(large.landmarks_px) << large.problem;
    EXPECT_EQ((*large.landmarks_px)[67].y, 268);
    EXPECT_EQ(fs::file_size(folder / "photo"), 16u + 1280 * 960 * 3);
}

TEST_F(LandmarkFinderTest, EachFailureIsOneSentence) {
    const auto problem_of = [&](const std::string& script) {
        const FoundLandmarks found = finder(script).find(photo({8, 8}).view());
        EXPECT_FALSE(found.landmarks_px);
        return found.problem;
    };
    EXPECT_EQ(problem_of("exit 3"), "No face was found in the photo.");
    EXPECT_NE(problem_of("exit 4").find("is no model of 68 landmarks"), std::string::npos);
    EXPECT_EQ(problem_of("exit 1"), "theatron-landmarks failed.");
    EXPECT_EQ(problem_of("kill -SEGV $$"), "theatron-landmarks failed.");
    EXPECT_EQ(problem_of("echo no landmarks"), "theatron-landmarks failed.");
    EXPECT_EQ(problem_of("echo faces: 1"), "theatron-landmarks failed.");
    EXPECT_EQ(problem_of("exec yes"), "theatron-landmarks did not end; it was ended.");
}

TEST_F(LandmarkFinderTest, OneThatHangsIsEnded) {
    const FoundLandmarks found =
        finder("exec sleep 1000", std::chrono::milliseconds(50)).find(photo({8, 8}).view());
    EXPECT_EQ(found.problem, "theatron-landmarks did not end; it was ended.");
}

TEST_F(LandmarkFinderTest, WhatIsMissingIsSaid) {
    const LandmarkFinder no_model(finder("exit 0").problem().empty() ? folder / "finder" : "",
                                  folder / "none", std::chrono::seconds(1));
    EXPECT_NE(no_model.problem().find("libdlib-data"), std::string::npos);
    EXPECT_EQ(no_model.find(photo({8, 8}).view()).problem, no_model.problem());
    const LandmarkFinder no_program(folder / "none", folder / "model", std::chrono::seconds(1));
    EXPECT_NE(no_program.problem().find("libdlib-dev"), std::string::npos);
}

}  // namespace
}  // namespace theatron::enrol
