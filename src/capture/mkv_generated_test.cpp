// SPDX-License-Identifier: Apache-2.0
// Recordings as an Azure Kinect writes them, made for these tests.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <iterator>

#include "base/error.h"
#include "base/log.h"
#include "capture/camera.h"
#include "capture/mkv_file.h"
#include "files/file_bytes.h"
#include "record/matroska_writer.h"
#include "testing/temporary_folder.h"
#include "video/jpeg_encoder_native.h"

namespace theatron::capture {
namespace {

using ::testing::HasSubstr;
namespace fs = std::filesystem;

constexpr Size kinect_depth{8, 6}, kinect_color{16, 12};
constexpr int depth_track = 1, color_track = 2;
constexpr int kinect_period_us = 33'333;

record::Track track(int number, const char* name, Size size, std::string_view fourcc) {
    record::Track track;
    track.number = number;
    track.name = name;
    track.codec_id = "V_MS/VFW/FOURCC";
    ByteWriter out(track.codec_private);
    out.put(std::uint32_t(40));
    out.put(std::int32_t(size.width));
    out.put(std::int32_t(size.height));
    out.put(std::uint32_t(1 | 16 << 16));
    out.put_bytes(as_bytes(fourcc));
    for (int i = 0; i < 5; ++i)
        out.put(std::uint32_t(0));
    track.width = size.width;
    track.height = size.height;
    track.frames_per_second = 30;
    return track;
}

// Depth whose first value is 1000 plus `number`, big-endian.
Bytes depth_picture(int number) {
    Bytes bytes(2 * kinect_depth.area());
    bytes[0] = std::byte((1000 + number) >> 8);
    bytes[1] = std::byte((1000 + number) & 0xff);
    return bytes;
}

Bytes color_picture() {
    const ColorImage image(kinect_color);
    video::JpegCompressor compressor(85, true);
    const ByteView bytes = compressor.compress(image.view());
    return {bytes.begin(), bytes.end()};
}

class Kinect {
public:
    Kinect(const fs::path& path, std::vector<record::Track> tracks)
        : writer_(path, [&] {
              record::MatroskaWriter::Layout layout;
              layout.tracks = std::move(tracks);
              return layout;
          }()) {}
    explicit Kinect(const fs::path& path)
        : Kinect(path, {track(depth_track, "DEPTH", kinect_depth, "b16g"),
                        track(color_track, "COLOR", kinect_color, "MJPG")}) {}

    // Pictures stand in the file in the order of these calls.
    void add(int track_number, Bytes picture, std::int64_t time_us) {
        record::Block block;
        block.track = track_number;
        block.time_us = block.reference_us = time_us;
        block.key = true;
        block.payload = picture;
        ASSERT_EQ(writer_.write({block}), "");
    }
    void add_depth(int number) {
        add(depth_track, depth_picture(number), std::int64_t(number) * kinect_period_us);
    }
    void add_color(int number) {
        add(color_track, color_picture(), std::int64_t(number) * kinect_period_us);
    }
    void finish() { ASSERT_EQ(writer_.finish(), ""); }

private:
    record::MatroskaWriter writer_;
};

struct PlayedFile {
    std::vector<int> depth;
    std::size_t with_color = 0;
    std::uint64_t lost = 0;
};

class GeneratedMkv : public ::testing::Test {
protected:
    void SetUp() override { log::set_level(log::Level::error); }
    void TearDown() override { log::set_level(log::Level::info); }
    fs::path path() const { return folder_.path() / "recording.mkv"; }

    PlayedFile play(const std::string& options = "") {
        PlayedFile played;
        const auto camera = open_camera("mkv:" + path().string() + options);
        EXPECT_TRUE(camera->skip_none());
        for (Capture got; (got = camera->next(1s)).kind != Capture::Kind::end;) {
            if (got.kind == Capture::Kind::failed) {
                ADD_FAILURE() << got.problem;
                break;
            }
            if (got.kind != Capture::Kind::frame)
                continue;
            played.depth.push_back(got.frame->depth.pixels[0] - 1000);
            played.with_color += !got.frame->color.empty();
        }
        played.lost = camera->lost_pictures();
        return played;
    }

private:
    theatron::testing::TemporaryFolder folder_;
};

TEST_F(GeneratedMkv, ColourMayStandFarBeforeItsDepth) {
    Kinect file(path());
    for (int n = 0; n < 40; ++n)
        file.add_color(n);
    for (int n = 0; n < 40; ++n)
        file.add_depth(n);
    file.finish();
    for (const char* options : {",preload=0", ",preload=1"}) {
        const PlayedFile played = play(options);
        EXPECT_EQ(played.depth.size(), 40u) << options;
        EXPECT_EQ(played.with_color, 40u) << options;
        EXPECT_EQ(played.lost, 0u) << options;
    }
}

TEST_F(GeneratedMkv, ColourThatStandsTooFarFromItsDepthIsCounted) {
    Kinect file(path());
    for (int n = 0; n < 40; ++n)
        file.add_depth(n);
    for (int n = 0; n < 40; ++n)
        file.add_color(n);
    file.finish();
    for (const char* options : {",preload=0", ",preload=1"}) {
        const PlayedFile played = play(options);
        EXPECT_EQ(played.depth.size(), 40u) << options;
        EXPECT_EQ(played.with_color + played.lost, 40u) << options;
        EXPECT_GT(played.lost, 0u) << options;
    }
}

TEST_F(GeneratedMkv, PicturesThatGoBackInTimeAndDamagedOnesAreCounted) {
    Kinect file(path());
    file.add_depth(0);
    file.add_depth(3);
    file.add_depth(1);
    file.add(depth_track, Bytes(7), 4 * kinect_period_us);
    file.add_depth(5);
    file.finish();
    for (const char* options : {",preload=0", ",preload=1"}) {
        const PlayedFile played = play(options);
        EXPECT_EQ(played.depth, (std::vector{0, 3, 5})) << options;
        EXPECT_EQ(played.lost, 2u) << options;
    }
}

TEST_F(GeneratedMkv, PicturesOfOneTimeAllPlay) {
    Kinect file(path());
    file.add_depth(0);
    for (int n = 1; n < 4; ++n)
        file.add(depth_track, depth_picture(n), kinect_period_us);
    file.finish();
    EXPECT_EQ(play().depth, (std::vector{0, 1, 2, 3}));
}

TEST_F(GeneratedMkv, AFileThatIsCutOffSaysSoAtItsEnd) {
    {
        Kinect file(path());
        for (int n = 0; n < 5; ++n)
            file.add_depth(n);
        file.finish();
    }
    fs::resize_file(path(), fs::file_size(path()) - 150);
    const auto camera = open_camera("mkv:" + path().string());
    Capture got;
    while ((got = camera->next(1s)).kind != Capture::Kind::end)
        ASSERT_NE(got.kind, Capture::Kind::failed) << got.problem;
    EXPECT_THAT(got.problem, HasSubstr("is cut off"));
}

// Writes zeros over the head of the cluster with the `n`th picture.
void break_cluster(const fs::path& path, int n) {
    Bytes file = files::read_file(path);
    constexpr int cluster[] = {0x1f, 0x43, 0xb6, 0x75};
    auto at = file.begin();
    for (; n >= 0; --n)
        at = std::search(at + 1, file.end(), std::begin(cluster), std::end(cluster),
                         [](std::byte a, int b) { return a == std::byte(b); });
    ASSERT_LT(file.end() - at, std::ptrdiff_t(file.size()));
    std::fill_n(at, 8, std::byte{0});
    files::write_file(path, file);
}

TEST_F(GeneratedMkv, ADamagedPartInItsMiddleIsCounted) {
    Kinect file(path());
    for (int n = 0; n < 9; ++n)
        file.add_depth(n);
    file.finish();
    break_cluster(path(), 4);
    for (const char* options : {",preload=0", ",preload=1"}) {
        const PlayedFile played = play(options);
        EXPECT_LT(played.depth.size(), 9u) << options;
        EXPECT_EQ(played.depth.back(), 8) << options;
        EXPECT_GE(played.lost, 1u) << options;
    }
}

TEST_F(GeneratedMkv, APictureThatNeedsTooMuchMemoryDoesNotCome) {
    constexpr Size large{4096, 1024};
    Kinect file(path(), {track(depth_track, "DEPTH", large, "b16g")});
    file.add(depth_track, Bytes(2 * large.area()), 0);
    file.finish();
    try {
        MkvFile read(path(), {.memory_bytes = 1 << 20});
        // The library takes a lack of memory within a cluster for the end of the file.
        while (const auto picture = read.read())
            EXPECT_TRUE(picture->bytes.empty()) << "8 MiB came through 1 MiB";
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), HasSubstr("recording.mkv' made its reader "));
    }
}

TEST_F(GeneratedMkv, ARecordingOfInfraredAloneIsNamed) {
    Kinect file(path(), {track(1, "IR", kinect_depth, "b16g")});
    file.add(1, depth_picture(0), 0);
    file.finish();
    try {
        open_camera("mkv:" + path().string());
        FAIL();
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), HasSubstr("has infrared only"));
    }
}

}  // namespace
}  // namespace theatron::capture
