// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fcntl.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <random>

#include "base/error.h"
#include "base/log.h"
#include "capture/camera.h"
#include "capture/cut_off.h"
#include "capture/mkv_file.h"
#include "capture/mkv_reader.h"
#include "files/file_bytes.h"
#include "files/png_file.h"
#include "testing/shared_data.h"
#include "testing/temporary_folder.h"

namespace theatron::capture {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
namespace fs = std::filesystem;

constexpr const char* sample = "azure-nfov-unbinned-1frame_640x576/recording.mkv";

std::string problem_with(const fs::path& path, const std::string& options = "") {
    try {
        open_camera("mkv:" + path.string() + options);
    } catch (const Error& error) {
        return error.what();
    }
    return {};
}

TEST(MkvCamera, GivesWhatLiesInTheFile) {
    THEATRON_REQUIRE_DATA(sample);
    const fs::path path = theatron::testing::shared_data() / sample;
    for (const char* options : {",loop=1", ",loop=1,preload=0"}) {
        const auto camera = open_camera("mkv:" + path.string() + options);
        EXPECT_EQ(camera->info().name, "recording");
        EXPECT_EQ(camera->info().frames_per_second, 5);
        for (FrameNumber n = 0; n < 2; ++n) {
            const Capture capture = camera->next(10s);
            ASSERT_EQ(capture.kind, Capture::Kind::frame) << capture.problem;
            const Frame& frame = *capture.frame;
            EXPECT_EQ(frame.depth,
                      files::read_depth_png(path.parent_path() / "depth" / "00000.png"));
            EXPECT_EQ(frame.color.jpeg,
                      files::read_file(path.parent_path() / "color" / "00000.jpg"));
            EXPECT_EQ(frame.color.size, (Size{1280, 720}));
        }
    }
}

TEST(MkvCamera, CalibrationIsThatOfTheFolderBesideIt) {
    THEATRON_REQUIRE_DATA(sample);
    const fs::path path = theatron::testing::shared_data() / sample;
    const Calibration mkv = open_camera("mkv:" + path.string())->info().calibration;
    const Calibration folder =
        open_camera("folder:" + path.parent_path().string())->info().calibration;
    EXPECT_EQ(mkv, folder);
    // Computed from the modes: 0.49278 * 1024; 0.51297 * 1024 - 192 - 0.5; and so on.
    EXPECT_NEAR(mkv.depth.fx, 504.608, 0.01);
    EXPECT_NEAR(mkv.depth.cx, 332.78, 0.01);
    EXPECT_NEAR(mkv.depth.cy, 348.83, 0.01);
    EXPECT_NEAR(mkv.color.fx, 611.80, 0.01);
    EXPECT_NEAR(mkv.color.cy, 365.85, 0.01);
}

TEST(MkvCamera, EveryTruncationEndsInASentenceOrInWholeFrames) {
    THEATRON_REQUIRE_DATA(sample);
    log::set_level(log::Level::error);
    const Bytes whole = files::read_file(theatron::testing::shared_data() / sample);
    const theatron::testing::TemporaryFolder folder;
    const fs::path path = folder.path() / "cut.mkv";
    int played = 0, turn = 0;
    for (std::size_t n = 0; n < whole.size(); n += n < 16'000 ? 797 : 50'021) {
        files::write_file(path, ByteView(whole).first(n));
        const char* options = ++turn % 2 ? ",preload=1" : ",preload=0";
        try {
            const auto camera = open_camera("mkv:" + path.string() + options);
            const Capture first = camera->next(1s);
            ASSERT_EQ(first.kind, Capture::Kind::frame) << n << " bytes";
            EXPECT_EQ(first.frame->depth.size, (Size{640, 576}));
            EXPECT_EQ(camera->next(1s).kind, Capture::Kind::end);
            ++played;
        } catch (const Error& error) {
            EXPECT_THAT(error.what(), HasSubstr("cut.mkv")) << n;
            EXPECT_THAT(error.what(), Not(HasSubstr("made its reader"))) << n;
        }
    }
    EXPECT_GT(played, 0);
    log::set_level(log::Level::info);
}

// Runs the library in this process, so that sanitizers see it: recordings truncated at every
// byte of the head and at steps after it, and 200 damaged ones.
TEST(MkvReader, ReadsAnyBytesToTheirEnd) {
    THEATRON_REQUIRE_DATA(sample);
    const Bytes whole = files::read_file(theatron::testing::shared_data() / sample);
    const theatron::testing::TemporaryFolder folder;
    const fs::path path = folder.path() / "any.mkv";
    const auto pictures_of = [&](ByteView bytes) {
        files::write_file(path, bytes);
        const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC);
        std::size_t pictures = 0, answers = 0;
        {
            MkvReader reader(file);
            if (reader.kind() == MkvReader::Kind::description)
                while (const auto picture = reader.read()) {
                    pictures += !picture->bytes.empty();
                    // A file has fewer pictures and damaged parts than bytes.
                    if (++answers > bytes.size()) {
                        ADD_FAILURE() << "does not end";
                        break;
                    }
                }
        }
        close(file);
        return pictures;
    };
    EXPECT_EQ(pictures_of(whole), 2u);
    const std::size_t head = 16'000;
    for (std::size_t n = 0; n < whole.size(); n += n < head ? 61 : 100'003)
        EXPECT_LE(pictures_of(ByteView(whole).first(n)), 2u) << n;

    std::mt19937 rng(7);
    const Bytes beginning(whole.begin(), whole.begin() + head);
    for (int i = 0; i < 200; ++i) {
        Bytes damaged = beginning;
        for (unsigned count = 1 + rng() % 8; count > 0; --count)
            damaged[rng() % damaged.size()] = std::byte(rng() % 256);
        EXPECT_LE(pictures_of(damaged), damaged.size()) << i;
    }
}

TEST(MkvCamera, DamagedBytesNeverCrash) {
    THEATRON_REQUIRE_DATA(sample);
    log::set_level(log::Level::error);
    const Bytes whole = files::read_file(theatron::testing::shared_data() / sample);
    const theatron::testing::TemporaryFolder folder;
    const fs::path path = folder.path() / "damaged.mkv";
    // Damages the header and the calibration, which come first.
    for (std::size_t at = 0; at < 9000; at += 241) {
        Bytes damaged = whole;
        damaged[at] ^= std::byte{0xff};
        files::write_file(path, damaged);
        try {
            open_camera("mkv:" + path.string())->next(1s);
        } catch (const Error& error) {
            EXPECT_THAT(error.what(), Not(HasSubstr("made its reader"))) << at;
        }
    }
    log::set_level(log::Level::info);
}

// The reader process of this camera: the youngest child of this process.
pid_t reader_of_newest_camera() {
    pid_t found = 0;
    for (const auto& task : fs::directory_iterator("/proc/self/task")) {
        std::ifstream in(task.path() / "children");
        for (pid_t child = 0; in >> child;)
            found = std::max(found, child);
    }
    return found;
}

TEST(MkvCamera, AReaderThatEndsCostsThisCameraAloneAndItOpensAgain) {
    THEATRON_REQUIRE_DATA(sample);
    const std::string camera =
        "mkv:" + (theatron::testing::shared_data() / sample).string() + ",loop=1,preload=0";
    const auto other = open_camera(camera), lost = open_camera(camera);
    const pid_t reader = reader_of_newest_camera();
    ASSERT_EQ(lost->next(10s).kind, Capture::Kind::frame);
    ASSERT_GT(reader, 0);
    kill(reader, SIGSEGV);
    Capture capture;
    do {
        capture = lost->next(10s);
    } while (capture.kind == Capture::Kind::frame);
    EXPECT_EQ(capture.kind, Capture::Kind::failed);
    EXPECT_THAT(capture.problem, HasSubstr("recording.mkv' made its reader "));
    EXPECT_EQ(other->next(10s).kind, Capture::Kind::frame);
    EXPECT_EQ(open_camera(camera)->next(10s).kind, Capture::Kind::frame);
}

TEST(MkvFile, APictureLargerThanTheSharedMemoryArrivesEmpty) {
    THEATRON_REQUIRE_DATA(sample);
    const fs::path path = theatron::testing::shared_data() / sample;
    MkvFile file(path, {.area_bytes = 512 << 10});
    int whole = 0, empty = 0;
    while (const auto packet = file.read())
        ++(packet->bytes.empty() ? empty : whole);
    EXPECT_EQ(whole, 1);
    EXPECT_EQ(empty, 1);
}

TEST(CutOff, MatroskaStatesItsSize) {
    Bytes file;
    // An empty EBML header, then a segment of 300 bytes, whose size takes two bytes.
    for (const int v : {0x1a, 0x45, 0xdf, 0xa3, 0x80, 0x18, 0x53, 0x80, 0x67, 0x41, 0x2c})
        file.push_back(std::byte(v));
    EXPECT_FALSE(is_cut_off(file, 311));
    EXPECT_FALSE(is_cut_off(file, 400));
    EXPECT_TRUE(is_cut_off(file, 310));
    EXPECT_TRUE(is_cut_off(file, 3));
    for (std::size_t n = 0; n < file.size(); ++n)
        EXPECT_FALSE(is_cut_off(ByteView(file).first(n), 310)) << n;
    file[9] = std::byte{0xff};  // unknown size
    EXPECT_FALSE(is_cut_off(file, 310));
    file[4] = std::byte{0};
    EXPECT_FALSE(is_cut_off(file, 310));
}

TEST(CutOff, AviStatesItsSize) {
    const auto avi = [](std::uint32_t size) {
        Bytes file;
        ByteWriter out(file);
        out.put_bytes(as_bytes("RIFF"));
        out.put(size);
        out.put_bytes(as_bytes("AVI "));
        return file;
    };
    EXPECT_TRUE(is_cut_off(avi(100), 107));
    EXPECT_FALSE(is_cut_off(avi(100), 108));
    for (const std::uint32_t unknown : {0u, 0xffffffffu})
        EXPECT_FALSE(is_cut_off(avi(unknown), 12));
    EXPECT_FALSE(is_cut_off(ByteView(avi(100)).first(7), 7));
}

TEST(CutOff, WindowsMediaStatesItsSize) {
    const auto asf = [](std::uint32_t flags) {
        Bytes file(30 + 24 + 104);
        const auto put = [&](std::size_t at, std::initializer_list<int> bytes) {
            for (const int byte : bytes)
                file[at++] = std::byte(byte);
        };
        put(0, {0x30, 0x26, 0xb2, 0x75, 0x8e, 0x66, 0xcf, 0x11, 0xa6, 0xd9});
        put(30, {24, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 24});  // another object
        put(54, {0xa1, 0xdc, 0xab, 0x8c, 0x47, 0xa9, 0xcf, 0x11, 0x8e, 0xe4});
        put(70, {104});
        put(94, {0xe8, 3});  // 1000 bytes
        put(142, {int(flags)});
        return file;
    };
    EXPECT_TRUE(is_cut_off(asf(0), 999));
    EXPECT_FALSE(is_cut_off(asf(0), 1000));
    EXPECT_FALSE(is_cut_off(asf(1), 999)) << "of a stream that was going on";
    for (std::size_t n = 0; n < 146; ++n)
        EXPECT_FALSE(is_cut_off(ByteView(asf(0)).first(n), n)) << n;
}

TEST(MkvCamera, SaysWhatIsWrongWithTheFile) {
    const theatron::testing::TemporaryFolder folder;
    const fs::path path = folder.path() / "x.mkv";
    EXPECT_EQ(problem_with(path), "There is no file '" + path.string() + "'.");
    EXPECT_EQ(problem_with(folder.path()), "'" + folder.path().string() + "' is not a file.");
    files::write_file(path, as_bytes("not a recording"));
    EXPECT_EQ(problem_with(path), "'" + path.string() +
                                      "' is not a Matroska recording, or is damaged at its "
                                      "beginning.");
    files::write_file(path, {});
    EXPECT_THAT(problem_with(path), HasSubstr("not a Matroska recording"));
    EXPECT_THAT(problem_with(path, ",fps=3"), HasSubstr("'fps' is unknown"));
    EXPECT_THAT(problem_with(""), HasSubstr("needs a file"));
}

}  // namespace
}  // namespace theatron::capture
