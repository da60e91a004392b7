// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "base/error.h"
#include "base/log.h"
#include "base/steady_clock.h"
#include "capture/camera.h"
#include "files/file_bytes.h"
#include "files/png_file.h"
#include "testing/shared_data.h"
#include "testing/temporary_folder.h"
#include "video/jpeg_encoder_native.h"

namespace theatron::capture {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
namespace fs = std::filesystem;

DepthImage flat_depth(Size size, std::uint16_t value) {
    DepthImage image(size);
    std::fill(image.pixels.begin(), image.pixels.end(), value);
    return image;
}

Bytes jpeg_picture(Size size) {
    const ColorImage image(size);
    video::JpegCompressor compressor(85, true);
    const ByteView bytes = compressor.compress(image.view());
    return Bytes(bytes.begin(), bytes.end());
}

// A folder with `frames` frames; the depth of each is 1000 plus its number.
class FolderCamera : public ::testing::Test {
protected:
    static constexpr Size depth_size{8, 6}, color_size{16, 12};

    void SetUp() override {
        log::set_level(log::Level::error);
        fs::create_directories(path() / "depth");
        fs::create_directories(path() / "color");
    }
    void TearDown() override { log::set_level(log::Level::info); }
    fs::path path() const { return folder_.path() / "scene"; }
    static std::string numbered(int n, const char* ending) {
        return (n < 10 ? "0" : "") + std::to_string(n) + ending;
    }
    void add_depth(int n, Size size = depth_size) {
        files::write_png(path() / "depth" / numbered(n, ".png"),
                         flat_depth(size, std::uint16_t(1000 + n)).view());
    }
    void add_jpeg(int n, Size size = color_size) {
        files::write_file(path() / "color" / numbered(n, ".jpg"), jpeg_picture(size));
    }
    void add_frames(int count) {
        for (int n = 0; n < count; ++n) {
            add_depth(n);
            add_jpeg(n);
        }
    }
    std::unique_ptr<Camera> open(const std::string& options = "") {
        return open_camera("folder:" + path().string() + options);
    }
    std::string problem(const std::string& options = "") {
        try {
            open(options);
        } catch (const Error& error) {
            return error.what();
        }
        return {};
    }

private:
    theatron::testing::TemporaryFolder folder_;
};

TEST_F(FolderCamera, PlaysItsFramesInOrderAndEnds) {
    add_frames(3);
    for (const char* options : {",fps=20", ",fps=20,preload=0"}) {
        const auto camera = open(options);
        EXPECT_EQ(camera->info().name, "scene");
        EXPECT_EQ(camera->info().frames_per_second, 20);
        TimePoint before;
        for (FrameNumber n = 0; n < 3; ++n) {
            const Capture capture = camera->next(10s);
            ASSERT_EQ(capture.kind, Capture::Kind::frame);
            // A stalled machine may skip frames but never mixes their images.
            EXPECT_EQ(capture.frame->depth,
                      flat_depth(depth_size, std::uint16_t(1000 + capture.frame->number)));
            EXPECT_EQ(capture.frame->color.jpeg, jpeg_picture(color_size));
            EXPECT_EQ(capture.frame->color.size, color_size);
            EXPECT_GE(capture.frame->times.delivered, capture.frame->times.captured);
            EXPECT_GT(capture.frame->times.captured, before);
            before = capture.frame->times.captured;
            if (capture.frame->number == 2)
                break;
        }
        EXPECT_EQ(camera->next(10s).kind, Capture::Kind::end);
        EXPECT_EQ(camera->next(10s).kind, Capture::Kind::end);
    }
}

TEST_F(FolderCamera, NothingComesBeforeItsTime) {
    add_frames(2);
    const auto camera = open(",fps=0.1");
    EXPECT_EQ(camera->next(0ms).kind, Capture::Kind::frame);
    EXPECT_EQ(camera->next(1ms).kind, Capture::Kind::nothing);
    EXPECT_EQ(camera->next(0ms).kind, Capture::Kind::nothing);
}

TEST_F(FolderCamera, HeldFramesKeepTheirPixels) {
    add_frames(2);
    const auto camera = open(",fps=200,loop=1");
    const FramePtr first = camera->next(1s).frame;
    const DepthImage copy = first->depth;
    for (int n = 0; n < 5; ++n)
        camera->next(1s);
    EXPECT_EQ(first->depth, copy);
}

TEST_F(FolderCamera, ColorMayBePngOrMissing) {
    for (int n = 0; n < 3; ++n)
        add_depth(n);
    ColorImage image(color_size);
    image.pixels[5] = {1, 2, 3};
    files::write_png(path() / "color" / "01.png", image.view());
    const auto camera = open(",fps=0.5,start=1");
    const FramePtr frame = camera->next(1s).frame;
    EXPECT_EQ(frame->depth.pixels[0], 1001);
    EXPECT_EQ(frame->color.pixels, image);
    EXPECT_FALSE(frame->color.is_jpeg());
    EXPECT_EQ(camera->info().calibration.color.size, color_size);

    const FramePtr without = open(",start=2")->next(1s).frame;
    EXPECT_TRUE(without->color.empty());

    fs::remove_all(path() / "color");
    EXPECT_EQ(open()->info().calibration.color.size, Size{});
}

TEST_F(FolderCamera, NamesOfDigitsCountAsNumbers) {
    for (const int value : {2, 10, 9})
        files::write_png(path() / "depth" / (std::to_string(value) + ".png"),
                         flat_depth(depth_size, std::uint16_t(value)).view());
    for (const auto& [start, value] : {std::pair{0, 2}, {1, 9}, {2, 10}})
        EXPECT_EQ(open(",start=" + std::to_string(start))->next(1s).frame->depth.pixels[0], value);
}

TEST_F(FolderCamera, OneDepthValueCanMeanNoReading) {
    add_frames(1);
    EXPECT_EQ(open(",invalid=1000")->next(1s).frame->depth.pixels[0], 0);
    EXPECT_EQ(open(",invalid=999")->next(1s).frame->depth.pixels[0], 1000);
}

TEST_F(FolderCamera, CalibrationComesFromTheFileBesideThePictures) {
    add_frames(1);
    EXPECT_EQ(open()->info().calibration.depth, pinhole(depth_size, 64));
    std::ofstream(path() / "camera-intrinsics.txt") << "7 0 4 0 7 3 0 0 1";
    EXPECT_EQ(open()->info().calibration.depth.fx, 7);
    std::ofstream(path() / "calibration.json")
        << R"({"depth":{"width":8,"height":6,"fx":9,"fy":9,"cx":4,"cy":3}})";
    EXPECT_EQ(open()->info().calibration.depth.fx, 9);
    std::ofstream(path() / "calibration.json") << "{";
    EXPECT_EQ(problem(), "'" + (path() / "calibration.json").string() + "' is not JSON.");
}

// As the cameras of recordings do: a depth picture with its frame, a colour picture alone.
TEST_F(FolderCamera, DamagedPicturesAreLeftOutAndCounted) {
    add_frames(6);
    Bytes png = files::read_file(path() / "depth/00.png");
    png.resize(png.size() / 2);
    files::write_file(path() / "depth/00.png", png);
    files::write_file(path() / "depth/02.png", as_bytes("not a picture"));
    add_depth(3, {7, 6});
    Bytes jpeg = jpeg_picture(color_size);
    jpeg.resize(100);
    files::write_file(path() / "color/04.jpg", jpeg);
    add_jpeg(5, {16, 11});
    for (const char* options : {",fps=240", ",fps=240,preload=0"}) {
        const auto camera = open(options);
        ASSERT_TRUE(camera->skip_none());
        std::vector<int> depth;
        std::vector<bool> has_color;
        Capture capture;
        while ((capture = camera->next(1s)).kind != Capture::Kind::end) {
            ASSERT_NE(capture.kind, Capture::Kind::failed) << capture.problem;
            if (capture.kind != Capture::Kind::frame)
                continue;
            depth.push_back(capture.frame->depth.pixels[0]);
            has_color.push_back(!capture.frame->color.empty());
        }
        EXPECT_EQ(depth, (std::vector{1001, 1004, 1005})) << options;
        EXPECT_EQ(has_color, (std::vector{true, false, false})) << options;
        EXPECT_EQ(camera->lost_pictures(), 5u) << options;
    }
}

TEST_F(FolderCamera, AFolderThatIsGoneEndsALoopWithASentence) {
    add_frames(2);
    const auto camera = open(",fps=240,loop=1,preload=0");
    ASSERT_EQ(camera->next(1s).kind, Capture::Kind::frame);
    fs::remove_all(path());
    Capture capture;
    while ((capture = camera->next(1s)).kind != Capture::Kind::failed)
        ASSERT_NE(capture.kind, Capture::Kind::end);
    EXPECT_THAT(capture.problem, HasSubstr("None of the depth pictures can be read any more"));
}

TEST_F(FolderCamera, ColourMayLieInAFolderRgbAndBelongByTime) {
    fs::remove_all(path() / "color");
    fs::create_directories(path() / "rgb");
    for (int n = 0; n < 3; ++n) {
        files::write_png(path() / "depth" / ("130503110" + std::to_string(n) + ".160407.png"),
                         flat_depth(depth_size, std::uint16_t(1000 + n)).view());
        files::write_file(path() / "rgb" / ("130503110" + std::to_string(n) + ".175304.jpg"),
                          jpeg_picture(color_size));
    }
    const auto camera = open(",fps=240");
    ASSERT_TRUE(camera->skip_none());
    for (int n = 0; n < 3; ++n) {
        const Capture capture = camera->next(1s);
        ASSERT_EQ(capture.kind, Capture::Kind::frame);
        EXPECT_EQ(capture.frame->depth.pixels[0], 1000 + n);
        EXPECT_EQ(capture.frame->color.size, color_size);
    }
}

TEST_F(FolderCamera, SaysWhatIsWrongWithTheFiles) {
    EXPECT_THAT(problem(), HasSubstr("holds no PNG pictures"));
    add_frames(2);
    EXPECT_EQ(problem(), "");
    EXPECT_THAT(problem(",start=2"), HasSubstr("has 2 frames"));
    EXPECT_THAT(problem(",fps=0"), HasSubstr("fps=0"));
    EXPECT_THAT(problem(",speed=1"), HasSubstr("'speed' is unknown"));

    for (const char* name : {"color/00.jpg", "color/01.jpg"})
        files::write_file(path() / name, as_bytes("not a picture"));
    EXPECT_THAT(problem(), AllOf(HasSubstr("00.jpg"), HasSubstr("not a whole JPEG")));
    add_jpeg(0);
    add_jpeg(1);

    for (const char* name : {"depth/00.png", "depth/01.png"})
        files::write_png(path() / name, ColorImage(depth_size).view());
    EXPECT_THAT(problem(), AllOf(HasSubstr("00.png"), HasSubstr("16 bits grey")));
    for (const char* name : {"depth/00.png", "depth/01.png"})
        files::write_file(path() / name, as_bytes("not a picture"));
    EXPECT_THAT(problem(), AllOf(HasSubstr("00.png"), HasSubstr("is not a PNG picture")));

    fs::remove_all(path() / "depth");
    EXPECT_THAT(problem(), HasSubstr("holds no folder 'depth'"));
    fs::remove_all(path());
    EXPECT_EQ(problem(), "There is no folder '" + path().string() + "'.");
}

TEST(OpenCamera, NamesTheKindsThereAre) {
    try {
        open_camera("webcam:0");
        FAIL();
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), HasSubstr("There is no camera 'webcam'; there are folder"));
    }
    EXPECT_THROW(open_camera(""), Error);
    EXPECT_THROW(open_camera("folder"), Error);
    EXPECT_THAT(camera_kinds(), ::testing::Contains(HasSubstr("folder:DIR")));
}

TEST(OpenCamera, APathWithoutItsKindIsToldHowToWriteIt) {
    const theatron::testing::TemporaryFolder folder;
    const std::string path = folder.path().string(), file = path + "/a.mkv";
    files::write_file(file, as_bytes("x"));
    const auto refusal_of = [](const std::string& specification) -> std::string {
        try {
            open_camera(specification);
        } catch (const Error& error) {
            return error.what();
        }
        return "";
    };
    EXPECT_EQ(refusal_of(path), "'" + path + "' is a folder; write folder:" + path + ".");
    EXPECT_THAT(refusal_of(file), HasSubstr("is a file; write recording:" + file));
    EXPECT_THAT(refusal_of(path + "/none"), HasSubstr("There is no camera"));
}

TEST(FolderCameraOnRealData, EverySequenceOpens) {
    THEATRON_REQUIRE_DATA("README.md");
    int sequences = 0;
    for (const auto& entry : fs::directory_iterator(theatron::testing::shared_data())) {
        if (!fs::is_directory(entry.path() / "depth"))
            continue;
        ++sequences;
        const auto camera = open_camera("folder:" + entry.path().string() + ",preload=0");
        const Capture capture = camera->next(1s);
        ASSERT_EQ(capture.kind, Capture::Kind::frame) << entry.path();
        const Calibration& calibration = camera->info().calibration;
        EXPECT_EQ(capture.frame->depth.size, calibration.depth.size);
        EXPECT_EQ(capture.frame->color.size, calibration.color.size);
    }
    EXPECT_GT(sequences, 0);
}

TEST_F(FolderCamera, TilesRepeatThePicturesInSpace) {
    add_frames(2);
    const auto camera = open_camera("folder:" + path().string() + ",tile=20x9");
    EXPECT_EQ(camera->info().calibration.depth.size, (Size{20, 9}));
    EXPECT_EQ(camera->info().calibration.color.size, (Size{20, 9}));
    const Capture got = camera->next(1s);
    ASSERT_EQ(got.kind, Capture::Kind::frame);
    EXPECT_EQ(got.frame->depth, flat_depth({20, 9}, 1000));
    EXPECT_EQ(got.frame->color.pixels.size, (Size{20, 9}));
    EXPECT_FALSE(got.frame->color.is_jpeg());
    EXPECT_THROW(open_camera("folder:" + path().string() + ",tile=20"), Error);
}

}  // namespace
}  // namespace theatron::capture
