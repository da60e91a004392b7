// SPDX-License-Identifier: Apache-2.0
#include "capture/folder_files.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace theatron::capture {
namespace {

namespace fs = std::filesystem;
using Names = std::vector<std::string>;

std::vector<fs::path> paths(const char* folder, const Names& names) {
    std::vector<fs::path> paths;
    for (const std::string& name : names)
        paths.push_back(fs::path(folder) / name);
    return paths;
}

// The colour of each depth.
Names colors_of(const Names& depth, const Names& color) {
    Names colors;
    for (const FramePaths& frame : pair_frames(paths("depth", depth), paths("color", color)).frames)
        colors.push_back(frame.color.filename().string());
    return colors;
}

TEST(FolderFiles, NumbersCountByTheirValueAndNoTwoNamesAreEqual) {
    const Names sorted{"",    "0",   "1a", "2",  "02",  "002", "9", "10",
                       "10a", "10b", "a",  "a2", "a02", "a10", "b"};
    for (std::size_t i = 0; i < sorted.size(); ++i)
        for (std::size_t k = 0; k < sorted.size(); ++k)
            EXPECT_EQ(precedes_naturally(sorted[i], sorted[k]), i < k && sorted[i] != sorted[k])
                << sorted[i] << ", " << sorted[k];
}

TEST(FolderFiles, ColourBelongsToTheDepthOfTheSameName) {
    EXPECT_EQ(colors_of({"2.png", "02.png", "3.png"}, {"02.jpg", "2.jpg"}),
              (Names{"2.jpg", "02.jpg", ""}));
    const PairedFrames paired =
        pair_frames(paths("d", {"0.png", "2.png"}), paths("c", {"0.jpg", "0.png", "1.jpg"}));
    EXPECT_EQ(paired.without_color, 1u);
    EXPECT_EQ(paired.unused_colors, 2u);
}

TEST(FolderFiles, OrOfTheSameNumber) {
    EXPECT_EQ(colors_of({"frame-000001.depth.png", "frame-000010.depth.png"},
                        {"frame-000001.color.jpg", "frame-000010.color.jpg"}),
              (Names{"frame-000001.color.jpg", "frame-000010.color.jpg"}));
    EXPECT_EQ(colors_of({"1.png", "2.png"}, {"00001.jpg"}), (Names{"00001.jpg", ""}));
    EXPECT_EQ(colors_of({"a.png", "b.png"}, {"c.jpg"}), (Names{"", ""}));
}

TEST(FolderFiles, OrOfTheNearestTime) {
    EXPECT_EQ(colors_of({"1305031102.160407.png", "1305031102.193740.png", "1305031102.260406.png"},
                        {"1305031102.175304.png", "1305031102.208637.png", "1305031103.3.png"}),
              (Names{"1305031102.175304.png", "1305031102.208637.png", ""}));
    EXPECT_EQ(colors_of({"1403636579763555584.png"}, {"1403636579773555584.png"}),
              (Names{"1403636579773555584.png"}));
    // A number and a time, as of Redwood's scans: the numbers of the two cameras have nothing to do
    // with each other.
    EXPECT_EQ(colors_of({"0000001-000000000000.png", "0000002-000000033369.png"},
                        {"0000001-000000027000.jpg", "0000002-000000061000.jpg"}),
              (Names{"", "0000001-000000027000.jpg"}));
}

TEST(FolderFiles, TimesInNamesHaveTheUnitThatTheirLengthTells) {
    EXPECT_EQ(time_in_name("12.5"), 12500ms);
    EXPECT_EQ(time_in_name("1305031102123"), 1305031102123ms);
    EXPECT_EQ(time_in_name("1305031102123456"), Duration(1305031102123456));
    EXPECT_EQ(time_in_name("0000007-000000033369"), Duration(33369));
    for (const char* none : {"", "12", "00012", "a12.5", "12.5a", "12.", ".5", "123456789012.5",
                             "7-33369", "-000000033369", "a7-000000033369"})
        EXPECT_EQ(time_in_name(none), std::nullopt) << none;
}

}  // namespace
}  // namespace theatron::capture
