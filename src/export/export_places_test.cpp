// SPDX-License-Identifier: Apache-2.0
#include "export/export_places.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <unistd.h>

#include <fstream>

#include "base/error.h"
#include "testing/temporary_folder.h"

namespace theatron::exporting {
namespace {

TEST(ExportPlaces, OfLaterCalibrationsLieBesideTheFirst) {
    EXPECT_EQ(place_of("e/png", 0), "e/png");
    EXPECT_EQ(place_of("e/png", 1), "e/png.2");
    EXPECT_EQ(place_of("kinect.mkv", 2), "kinect.3.mkv");
    EXPECT_EQ(place_of("e/png/", 1), "e/png.2");
    EXPECT_EQ(place_of("e/./png//", 1), "e/png.2");
    const auto here = std::filesystem::current_path();
    EXPECT_EQ(place_of(".", 1), here.parent_path() / (here.filename().string() + ".2"));
    EXPECT_EQ(place_of("./", 1), place_of(".", 1));
}

TEST(ExportPlaces, NoFileIsReplacedUnasked) {
    const testing::TemporaryFolder folder;
    const auto path = [&](const char* name) { return folder.path() / name; };
    const auto make = [&](const char* name) { std::ofstream(path(name)) << name; };
    const auto write = [](const std::filesystem::path& draft, std::size_t n) {
        std::ofstream(draft) << n;
    };
    require_free(path("a.mkv"), 2, false, {});
    for (const char* name : {"a.2.mkv", "a.part.mkv", "a.2.part.mkv"}) {
        make(name);
        EXPECT_THROW(require_free(path("a.mkv"), 2, false, {}), Error) << name;
        require_free(path("a.mkv"), 2, true, {});
        EXPECT_THROW(require_free(path("a.mkv"), 2, true, {path(name)}), Error) << "the source";
        std::filesystem::remove(path(name));
    }
    make("a.3.mkv");
    replace_files(path("a.mkv"), 2, write);
    for (const char* name : {"a.mkv", "a.2.mkv", "a.3.mkv"})
        EXPECT_TRUE(std::filesystem::exists(path(name))) << name;
}

TEST(ExportPlaces, NoRecordingInUseIsReplaced) {
    const testing::TemporaryFolder folder;
    const std::string file = folder.path() / "a.mkv";
    const int used = open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
    ASSERT_EQ(flock(used, LOCK_EX | LOCK_NB), 0);
    EXPECT_THROW(require_free(file, 1, true, {}), Error);
    close(used);
    require_free(file, 1, true, {});
}

}  // namespace
}  // namespace theatron::exporting
