// SPDX-License-Identifier: Apache-2.0
// Damaged recording files. COUNT=1000 in the environment flips 1000 bits instead of 400.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <map>
#include <random>
#include <set>

#include "capture/recording_camera.h"
#include "record/recorder.h"
#include "record/recover.h"
#include "testing/temporary_folder.h"
#include "video/depth_codecs.h"
#include "video/jpeg_encoder_native.h"

namespace theatron::capture {
namespace {

constexpr int cameras = 2, frames_per_second = 10, frames = 8 * frames_per_second;
// The most frames lost by a single damage: key frames come every two seconds.
constexpr int key_distance = 2 * frames_per_second;
constexpr Size small{32, 32}, larger{128, 96};
const record::ClockPair begin{from_us(9'000'000), UtcTime(1'700'000'000s)};

Bytes bytes_of(const std::filesystem::path& path) {
    std::ifstream in(path, std::ios::binary);
    const std::string text((std::istreambuf_iterator<char>(in)), {});
    const ByteView view = as_bytes(text);
    return Bytes(view.begin(), view.end());
}

DepthImage depth_of(Size size, int camera, int n) {
    DepthImage image(size);
    std::minstd_rand random(unsigned(n * 8 + camera + 1));
    for (auto& p : image.pixels)
        p = random() % 16 == 0 ? 0 : std::uint16_t(2000 - n + int(random() % 4));
    return image;
}

ColorData color_of(Size size, int camera, int n) {
    ColorData color;
    color.size = size;
    color.pixels = ColorImage(size);
    for (std::size_t i = 0; i < size.area(); ++i)
        color.pixels.pixels[i] = {std::uint8_t(n * 3 + int(i)), std::uint8_t(i),
                                  std::uint8_t(camera * 50)};
    return color;
}

// Records two cameras for eight seconds; `later` starts a second segment in the middle, with
// `splits_a_picture` between depth and colour of the first camera.
void record_both(const std::filesystem::path& path, const std::string& depth_codec,
                 const std::string& color_codec, Size size,
                 std::optional<record::ClockPair> later = {}, bool splits_a_picture = false) {
    const auto depth = video::parse_depth_setting(depth_codec);
    const auto color = video::parse_color_setting(color_codec);
    ASSERT_EQ(depth.problem + color.problem, "");
    const bool is_jpeg = color_codec.starts_with("jpeg");
    std::vector<record::RecordedCamera> descriptions;
    std::vector<std::unique_ptr<codec::DepthStreamEncoder>> depth_encoders;
    std::vector<std::unique_ptr<video::ColorEncoder>> color_encoders;
    for (int c = 0; c < cameras; ++c) {
        Calibration calibration;
        calibration.depth = calibration.color = pinhole(size, 60);
        record::RecordedCamera camera;
        camera.id = CameraId(c);
        camera.name = "camera";
        camera.frames_per_second = frames_per_second;
        camera.calibration = encode_calibration(calibration);
        camera.depth = {depth.setting.text, size.width, size.height};
        camera.color = record::RecordedStream{color.setting.text, size.width, size.height};
        descriptions.push_back(camera);
        depth_encoders.push_back(
            std::make_unique<codec::DepthStreamEncoder>(video::make_depth_encoder(depth.setting)));
        if (!is_jpeg)
            color_encoders.push_back(video::make_color_encoder(color.setting));
    }
    record::Recorder recorder(path, descriptions, begin);
    record::ClockPair clock = begin;
    int first = 0;
    for (int n = 0; n < frames; ++n) {
        const bool key = n % key_distance == 0;
        const auto begin_later = [&] {
            clock = *later;
            first = n;
            recorder.begin_segment(descriptions, clock);
        };
        if (later && !splits_a_picture && n == frames / 2)
            begin_later();
        for (int c = 0; c < cameras; ++c) {
            wire::MediaHeader header;
            header.frame = FrameNumber(n);
            header.captured = clock.session + (n - first) * (1000ms / frames_per_second) + c * 5ms;
            const auto add = [&](ByteView payload) {
                header.payload_size = std::uint32_t(payload.size());
                auto message = std::make_shared<Bytes>(wire::media_header_size);
                wire::write_media_header(header, message->data());
                message->insert(message->end(), payload.begin(), payload.end());
                ASSERT_EQ(recorder.add(header, message, header.captured),
                          record::Recorder::Added::taken);
            };
            codec::DepthStreamEncoder& encoder = *depth_encoders[std::size_t(c)];
            const DepthImage image = depth_of(size, c, n);
            Bytes encoded(encoder.max_encoded_size(size));
            const auto link = encoder.encode(image.view(), FrameNumber(n), key, encoded);
            header.stream = depth_stream(CameraId(c));
            header.key = link.key;
            header.reference = link.reference_frame;
            header.temporal_layer = std::uint8_t(link.layer);
            add(ByteView(encoded).first(link.bytes));
            if (later && splits_a_picture && n == frames / 2 && c == 0)
                begin_later();

            header.stream = color_stream(CameraId(c));
            header.temporal_layer = 0;
            header.key = true;
            header.reference = FrameNumber(n);
            const ColorData picture = color_of(size, c, n);
            if (is_jpeg) {
                video::JpegCompressor compressor(85, true);
                add(compressor.compress(picture.pixels.view()));
                continue;
            }
            const auto coded = color_encoders[std::size_t(c)]->encode(picture, key);
            ASSERT_TRUE(coded);
            header.key = coded->key;
            header.reference = coded->key ? FrameNumber(n) : FrameNumber(n - 1);
            add(coded->bytes);
        }
    }
    recorder.finish();
    ASSERT_EQ(recorder.figures().problem, "");
}

struct Picture {
    DepthImage depth;
    ColorData color;
};
using Pictures = std::map<std::pair<int, FrameNumber>, Picture>;

struct Played {
    Pictures pictures;  // of all cameras, by number
    bool reported = false;
};

Played play(std::shared_ptr<const record::RecordingFile> recording) {
    Played played;
    played.reported = !std::ranges::all_of(recording->segments(), &record::Segment::is_whole) ||
                      recording->missing_segments() > 0 || recording->refused() > 0;
    for (int c = 0; c < int(recording->cameras().size()); ++c) {
        RecordedFrames camera(recording, std::size_t(c), "test");
        Frame frame;
        while (camera.offset()) {
            const FrameNumber number = camera.upcoming().frame;
            camera.read(frame);
            played.pictures[{c, number}] = {frame.depth, frame.color};
        }
        played.reported |= camera.losses().depth() + camera.losses().color() > 0;
    }
    return played;
}

Result<Played> play(const Bytes& bytes) {
    auto recording =
        record::RecordingFile::read(std::make_unique<record::MemorySource>(ByteView(bytes)));
    if (!recording)
        return recording.error();
    return play(std::shared_ptr<const record::RecordingFile>(std::move(*recording)));
}

// The number of pictures lost by each camera, depth and colour separately. All other pictures
// must be unchanged.
struct Lost {
    std::array<int, cameras> depth{}, color{};
};
Lost compare(const Pictures& expected, const Pictures& found) {
    Lost lost;
    for (const auto& [name, picture] : expected) {
        const auto at = found.find(name);
        const std::size_t camera = std::size_t(name.first);
        if (at == found.end()) {
            ++lost.depth[camera];
            ++lost.color[camera];
            continue;
        }
        EXPECT_TRUE(at->second.depth == picture.depth) << name.first << " " << name.second;
        if (at->second.color.empty()) {
            ++lost.color[camera];
            continue;
        }
        EXPECT_EQ(at->second.color.jpeg, picture.color.jpeg);
        EXPECT_TRUE(at->second.color.pixels == picture.color.pixels);
    }
    return lost;
}

// The positions of pictures and of everything between them in a file.
struct Map {
    std::uint64_t first_cluster = 0, last_cluster_end = 0;
    std::vector<std::tuple<std::uint64_t, std::uint64_t, int>> pictures;  // begin, end, camera

    std::optional<int> camera_at(std::uint64_t at) const {
        for (const auto& [from, to, camera] : pictures)
            if (from <= at && at < to)
                return camera;
        return std::nullopt;
    }
};
Map map_of(const Bytes& bytes) {
    record::MemorySource source{ByteView(bytes)};
    const auto head = record::read_head(source);
    Map map;
    map.first_cluster = head->clusters_at;
    (void)record::read_clusters(source, *head, [&](const record::FoundBlock& block) {
        map.pictures.emplace_back(block.payload_at, block.payload_at + block.payload_size,
                                  (block.track - 1) / 2);
        map.last_cluster_end = block.side_at + 128;
    });
    return map;
}

struct Codecs {
    const char *depth, *color;
};
constexpr Codecs all_codecs[] = {{"raw", "raw"},          {"lz4", "jpeg:quality=85"},
                                 {"rvl", "h264:crf=20"},  {"trvl", "jpeg:quality=85"},
                                 {"zstd:delta=1", "raw"}, {"ans:delta=1", "jpeg:quality=85"},
                                 {"h264", "h264:crf=20"}, {"strata", "jpeg:quality=85"}};

bool is_built_in(const Codecs& codecs) {
    const auto depth = video::parse_depth_setting(codecs.depth);
    const auto color = video::parse_color_setting(codecs.color);
    return depth.problem.empty() && color.problem.empty() &&
           video::missing_color_encoder(color.setting).empty() &&
           video::missing_color_decoder(color.setting).empty();
}

TEST(DamagedRecording, OfEveryCodecAFlippedBitCostsAtMostTwoSecondsAndIsReported) {
    const char* const count = std::getenv("COUNT");
    const int flips = count ? std::atoi(count) : 400;
    const int each = (flips + int(std::size(all_codecs)) - 1) / int(std::size(all_codecs));
    std::minstd_rand random(12);
    for (const Codecs& codecs : all_codecs) {
        SCOPED_TRACE(std::string(codecs.depth) + " " + codecs.color);
        if (!is_built_in(codecs))
            continue;
        const testing::TemporaryFolder folder;
        record_both(folder.path() / "a.mkv", codecs.depth, codecs.color, small);
        const Bytes whole = bytes_of(folder.path() / "a.mkv");
        const auto expected = play(whole);
        ASSERT_TRUE(expected);
        EXPECT_FALSE(expected->reported);
        ASSERT_EQ(expected->pictures.size(), std::size_t(cameras * frames));
        const Map map = map_of(whole);
        for (int i = 0; i < each; ++i) {
            // One flip in four hits the head, and one in four the bytes between pictures.
            std::uint64_t at = random() % whole.size();
            if (i % 4 == 1)
                at = random() % map.first_cluster;
            while (i % 4 == 2 && (map.camera_at(at) || at < map.first_cluster))
                at = random() % whole.size();
            SCOPED_TRACE(at);
            Bytes damaged = whole;
            damaged[at] ^= std::byte(1 << random() % 8);
            const auto found = play(damaged);
            ASSERT_TRUE(found);
            const Lost lost = compare(expected->pictures, found->pictures);
            int most = 0;
            for (int c = 0; c < cameras; ++c) {
                const int worst = std::max(lost.depth[std::size_t(c)], lost.color[std::size_t(c)]);
                most = std::max(most, worst);
                const auto hit = map.camera_at(at);
                if (at < map.first_cluster || at >= map.last_cluster_end || (hit && *hit != c))
                    EXPECT_EQ(worst, 0) << "camera " << c;
                else
                    EXPECT_LE(worst, key_distance) << "camera " << c;
            }
            EXPECT_TRUE(found->reported || most == 0);
            EXPECT_TRUE(found->reported || !map.camera_at(at));
        }
    }
}

TEST(DamagedRecording, ZeroedBlocksCostWhatWasInThemAndTwoSeconds) {
    const testing::TemporaryFolder folder;
    record_both(folder.path() / "a.mkv", "zstd:delta=1", "raw", larger);
    const Bytes whole = bytes_of(folder.path() / "a.mkv");
    const auto expected = play(whole);
    ASSERT_TRUE(expected);
    const Map map = map_of(whole);
    std::minstd_rand random(5);
    for (const std::size_t size : {std::size_t(4) << 10, std::size_t(256) << 10})
        for (int i = 0; i < 8; ++i) {
            const std::size_t block = 4096;
            const std::size_t at = i == 0 ? 0 : random() % (whole.size() / block) * block;
            const std::size_t end = std::min(whole.size(), at + size);
            SCOPED_TRACE(std::to_string(at) + " " + std::to_string(size));
            Bytes damaged = whole;
            std::fill(damaged.begin() + std::ptrdiff_t(at), damaged.begin() + std::ptrdiff_t(end),
                      std::byte{0});
            const auto found = play(damaged);
            ASSERT_TRUE(found);
            EXPECT_TRUE(found->reported);
            // A camera loses at most two streams, and a cluster at either end.
            std::array<int, cameras> hit{};
            for (const auto& [from, to, camera] : map.pictures)
                hit[std::size_t(camera)] += from < end && at < to;
            const Lost lost = compare(expected->pictures, found->pictures);
            for (int c = 0; c < cameras; ++c)
                EXPECT_LE(std::max(lost.depth[std::size_t(c)], lost.color[std::size_t(c)]),
                          hit[std::size_t(c)] / 2 + 2 + key_distance);
        }
}

TEST(DamagedRecording, IsRecoveredIntoOneWithoutDamage) {
    const testing::TemporaryFolder folder;
    record_both(folder.path() / "a.mkv", "trvl", "jpeg:quality=85", small,
                record::ClockPair{begin.session + 30s, begin.utc + 30s});
    const auto original = record::RecordingFile::open(folder.path() / "a.mkv");
    ASSERT_EQ(original->segments().size(), 2u);
    std::minstd_rand random(8);
    for (const char* name : {"a.mkv", "a.002.mkv"}) {
        Bytes bytes = bytes_of(folder.path() / name);
        bytes[3] ^= std::byte{1};
        for (int i = 0; i < 5; ++i)
            bytes[bytes.size() / 2 + random() % (bytes.size() / 4)] ^= std::byte{64};
        std::ofstream(folder.path() / name, std::ios::binary)
            .write(reinterpret_cast<const char*>(bytes.data()), std::streamsize(bytes.size()));
    }
    const std::shared_ptr<const record::RecordingFile> damaged =
        record::RecordingFile::open(folder.path() / "a.mkv");
    EXPECT_FALSE(damaged->complete());
    double done = 0;
    const auto saved = record::recover(*damaged, folder.path() / "b.mkv", [&](double part) {
        EXPECT_GE(part, done);
        done = part;
    });
    EXPECT_EQ(saved.files.size(), 2u);
    EXPECT_GT(saved.cameras[0].depth.damaged + saved.cameras[1].depth.damaged +
                  saved.cameras[0].color.damaged + saved.cameras[1].color.damaged,
              0u);
    const std::shared_ptr<const record::RecordingFile> clean =
        record::RecordingFile::open(folder.path() / "b.mkv");
    EXPECT_FALSE(clean->complete()) << "it notes what could not be saved";
    EXPECT_TRUE(clean->intact());
    EXPECT_EQ(clean->segments()[1].info, damaged->segments()[1].info);
    EXPECT_EQ(clean->duration(), damaged->duration());
    const Played before = play(damaged), after = play(clean);
    EXPECT_FALSE(after.reported);
    const Lost lost = compare(before.pictures, after.pictures);
    EXPECT_EQ(lost.depth, (std::array<int, cameras>{}));
    EXPECT_EQ(before.pictures.size(), after.pictures.size());
}

// A restarted host machine: its clock counts from 0 again.
TEST(RecordingChain, PlaysOnThroughAllSegmentsWithTheirPauses) {
    for (const auto& [pause, played_pause] :
         {std::pair<Duration, Duration>{3s, 3s}, {1h, record::max_pause}}) {
        const testing::TemporaryFolder folder;
        const Duration half = frames / 2 * (1000ms / frames_per_second);
        record_both(folder.path() / "a.mkv", "rvl", "jpeg:quality=85", small,
                    record::ClockPair{from_us(20'000), begin.utc + half + pause});
        const std::shared_ptr<const record::RecordingFile> recording =
            record::RecordingFile::open(folder.path() / "a.mkv");
        EXPECT_TRUE(recording->complete());
        RecordedFrames camera(recording, 1, "a.mkv");
        EXPECT_EQ(camera.frames(), std::size_t(frames));
        Frame frame;
        std::vector<Duration> times;
        while (const auto offset = camera.offset()) {
            times.push_back(*offset);
            camera.read(frame);
            EXPECT_EQ(frame.depth, depth_of(small, 1, int(times.size()) - 1));
            EXPECT_TRUE(frame.color.is_jpeg());
        }
        ASSERT_EQ(times.size(), std::size_t(frames));
        for (std::size_t i = 1; i < times.size(); ++i) {
            const bool between = i == std::size_t(frames / 2);
            // The other camera of the previous segment ends 5 ms later; this one begins 5 ms later.
            const Duration step = between && pause > record::max_pause ? played_pause + 5ms
                                  : between ? played_pause + (1000ms / frames_per_second)
                                            : Duration(1000ms / frames_per_second);
            EXPECT_EQ(times[i] - times[i - 1], step) << i;
        }
    }
}

TEST(RecordingChain, PlaysAPictureWhoseColourIsInTheNextSegment) {
    const testing::TemporaryFolder folder;
    const Duration half = frames / 2 * (1000ms / frames_per_second);
    record_both(folder.path() / "a.mkv", "rvl", "jpeg:quality=85", small,
                record::ClockPair{begin.session + half, begin.utc + half}, true);
    const std::shared_ptr<const record::RecordingFile> recording =
        record::RecordingFile::open(folder.path() / "a.mkv");
    RecordedFrames camera(recording, 0, "a.mkv");
    Frame frame;
    int played = 0;
    for (; camera.offset(); ++played) {
        camera.read(frame);
        EXPECT_EQ(frame.depth, depth_of(small, 0, played));
        EXPECT_TRUE(frame.color.is_jpeg()) << played;
    }
    EXPECT_EQ(played, frames);
}

// The file was written by the version 1 program, from three pictures of a wall. The depth in
// row y, column x of picture n is 1500 + 2y + (7x + 13y + 5n) % 4.
TEST(RecordingOfVersion1, OpensAndPlays) {
    const std::shared_ptr<const record::RecordingFile> recording =
        record::RecordingFile::open("tests/golden/recording_v1.mkv");
    EXPECT_TRUE(recording->complete());
    EXPECT_FALSE(recording->segments()[0].has_info);
    EXPECT_NE(recording->segments()[0].begin_utc, UtcTime{});
    RecordedFrames camera(recording, 0, "recording_v1.mkv");
    Frame frame;
    int frames_seen = 0;
    for (; camera.offset(); ++frames_seen) {
        const int n = int(camera.upcoming().frame) + 1;  // the first frame was not recorded
        camera.read(frame);
        EXPECT_EQ(frame.depth.size, (Size{32, 24}));
        for (int y = 0; y < 24; ++y)
            for (int x = 0; x < 32; ++x)
                ASSERT_EQ(frame.depth.view().row(y)[x],
                          1500 + 2 * y + (7 * x + 13 * y + 5 * n) % 4);
        EXPECT_TRUE(frame.color.is_jpeg());
    }
    EXPECT_EQ(frames_seen, 3);

    const testing::TemporaryFolder folder;
    record::recover(*recording, folder.path() / "new.mkv", {});
    const auto recovered = record::RecordingFile::open(folder.path() / "new.mkv");
    EXPECT_TRUE(recovered->segments()[0].has_info);
    EXPECT_EQ(recovered->duration(), recording->duration());
    EXPECT_EQ(recovered->cameras()[0].depth.frames.size(), 3u);
}

TEST(RecordingChain, OfWhichASegmentIsMissingOpensAndSaysSo) {
    const testing::TemporaryFolder folder;
    record_both(folder.path() / "a.mkv", "rvl", "jpeg:quality=85", small,
                record::ClockPair{begin.session + 30s, begin.utc + 30s});
    std::filesystem::rename(folder.path() / "a.002.mkv", folder.path() / "a.003.mkv");
    EXPECT_TRUE(record::RecordingFile::open(folder.path() / "a.mkv")->complete())
        << "names do not count";
    // Segments of another recording are not opened, either.
    const testing::TemporaryFolder other;
    record_both(other.path() / "b.mkv", "rvl", "jpeg:quality=85", small);
    std::filesystem::copy_file(other.path() / "b.mkv", folder.path() / "a.002.mkv");
    EXPECT_EQ(record::RecordingFile::open(folder.path() / "a.mkv")->segments().size(), 2u);
    // A later segment can be opened alone.
    EXPECT_EQ(record::RecordingFile::open(folder.path() / "a.003.mkv")->segments().size(), 1u);
}

}  // namespace
}  // namespace theatron::capture
