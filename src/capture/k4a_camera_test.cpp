// SPDX-License-Identifier: Apache-2.0
// Live cameras with a stand-in for libk4a (tests/k4a_standin).
#include "capture/k4a_camera.h"

#include <dlfcn.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include "base/error.h"
#include "base/log.h"
#include "capture/k4a_device.h"
#include "testing/manual_clock.h"
#include "testing/shared_data.h"
#include "video/jpeg_header.h"

namespace theatron::capture {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using Kind = Capture::Kind;

// Frames come in real time, with a shorter period than a camera's to save time.
constexpr const char* quick = ",period_us=4000";

class K4aCamera : public ::testing::Test {
protected:
    void SetUp() override {
        setenv("THEATRON_K4A_LIBRARY", THEATRON_K4A_STANDIN, 1);
        behave("");
        library_ = dlopen(THEATRON_K4A_STANDIN, RTLD_NOW);
        ASSERT_NE(library_, nullptr) << dlerror();
        calls();
        log::set_level(log::Level::error);
    }
    void TearDown() override {
        log::set_level(log::Level::info);
        unsetenv("K4A_STANDIN");
        unsetenv("THEATRON_K4A_LIBRARY");
        EXPECT_EQ(alive(), 0) << "handles were not given back";
    }

    static void behave(const std::string& how) { setenv("K4A_STANDIN", (how + quick).c_str(), 1); }

    int alive() { return reinterpret_cast<int (*)()>(dlsym(library_, "k4a_standin_alive"))(); }
    std::string calls() {
        return reinterpret_cast<const char* (*)()>(dlsym(library_, "k4a_standin_take_calls"))();
    }

    static std::string problem_with(const std::string& specification) {
        try {
            open_camera(specification);
        } catch (const Error& error) {
            return error.what();
        }
        return {};
    }

    // On the test's clock. The stand-in waits in real time.
    static std::unique_ptr<Camera> impatient(const std::string& specification,
                                             const k4a::Patience& patience, Clock clock) {
        Options options = Options::parse(specification);
        return k4a::start_camera(k4a::load_library(), k4a::take_settings(options), patience,
                                 std::move(clock));
    }
    // When the camera has waited in vain, `time` passes, and none otherwise.
    Clock idle_takes(Duration time) {
        return {[this] { return clock_.now(); }, [this, time](Duration) { clock_.pass(time); }};
    }
    // Every look at it takes a millisecond.
    Clock every_look_takes_time() {
        return {[this] {
                    clock_.pass(1ms);
                    return clock_.now();
                },
                [](Duration) {}};
    }

    // The number of frames, at most ten, and the first result after them.
    static std::pair<int, Capture> play(Camera& camera) {
        for (int frames = 0;; ++frames) {
            Capture capture = camera.next(2s);
            if (capture.kind != Kind::frame || frames == 10)
                return {frames, capture};
        }
    }

    // Colour pictures carry their frame's number in a comment.
    static int color_number(const Frame& frame) {
        const Bytes& jpeg = frame.color.jpeg;
        return jpeg.empty() ? -1
                            : std::to_integer<int>(jpeg[6]) << 8 | std::to_integer<int>(jpeg[7]);
    }
    static int depth_number(const Frame& frame) { return frame.depth.pixels[0]; }

    void* library_ = nullptr;
    testing::ManualClock clock_;
};

TEST_F(K4aCamera, DeliversDepthAndUntouchedColor) {
    const auto camera = open_camera("k4a:0");
    EXPECT_EQ(camera->info().name, "k4a-000123450");
    EXPECT_EQ(camera->info().frames_per_second, 30);
    for (int n = 0; n < 5; ++n) {
        const Capture capture = camera->next(1s);
        ASSERT_EQ(capture.kind, Kind::frame) << capture.problem;
        const Frame& frame = *capture.frame;
        EXPECT_EQ(frame.number, FrameNumber(n));
        ASSERT_EQ(frame.depth.size, (Size{640, 576}));
        EXPECT_EQ(depth_number(frame), n);
        EXPECT_EQ(frame.depth.pixels.back(), 1500 + 575);
        EXPECT_EQ(frame.color.size, (Size{1280, 720}));
        EXPECT_EQ(color_number(frame), n);
        EXPECT_EQ(*video::read_jpeg_size(frame.color.jpeg), frame.color.size);
        EXPECT_TRUE(frame.color.pixels.empty());
    }
}

TEST_F(K4aCamera, PaddingBetweenRowsIsLeftOut) {
    behave("padding=64");
    const Capture capture = open_camera("k4a:0")->next(1s);
    ASSERT_EQ(capture.kind, Kind::frame) << capture.problem;
    for (int y = 0; y < 576; ++y)
        ASSERT_EQ(capture.frame->depth.view().row(y)[639], 1500 + y);
}

TEST_F(K4aCamera, CalibrationIsTheDevicesOwnForTheModes) {
    const Calibration c = open_camera("k4a:0,depth=wfov2x2,color=1080")->info().calibration;
    EXPECT_EQ(c.depth.size, (Size{512, 512}));
    EXPECT_DOUBLE_EQ(c.depth.fx, 256);
    EXPECT_EQ(c.color.size, (Size{1920, 1080}));
    behave("calibration=long");
    EXPECT_EQ(open_camera("k4a:0,depth=wfov2x2,color=1080")->info().calibration, c);
}

TEST_F(K4aCamera, ARealDevicesCalibrationIsUnderstood) {
    const auto recorded = "azure-nfov-unbinned-1frame_640x576";
    THEATRON_REQUIRE_DATA(recorded);
    const auto folder = theatron::testing::shared_data() / recorded;
    behave("calibration=" + (folder / "calibration.json").string());
    EXPECT_EQ(open_camera("k4a:0")->info().calibration,
              open_camera("folder:" + folder.string())->info().calibration);
}

TEST_F(K4aCamera, SettingsReachTheDevice) {
    open_camera("k4a:0,color=off");
    EXPECT_EQ(calls(),
              "start format=0 color=0 depth=2 fps=2 synchronized=0 depth_delay=0 sync=0 delay=0 "
              "dark=0;stop;close;");
    open_camera(
        "k4a:0,depth=wfov,color=1080,fps=15,sync=subordinate,delay_us=160,synchronized=1,"
        "exposure_us=8330,white_balance=4500,powerline_hz=50");
    EXPECT_EQ(calls(),
              "control 0 1 8330;control 6 1 4500;control 9 1 1;"
              "start format=0 color=2 depth=4 fps=1 synchronized=1 depth_delay=0 sync=2 delay=160 "
              "dark=0;stop;close;");
    open_camera("k4a:0,depth=nfov2x2,fps=5,sync=master");
    EXPECT_EQ(calls(),
              "control 0 0 0;control 6 0 0;"
              "start format=0 color=1 depth=1 fps=0 synchronized=0 depth_delay=0 sync=1 delay=0 "
              "dark=0;stop;close;");
}

TEST_F(K4aCamera, PairsWhatTheDeviceDeliversApart) {
    for (const char* order : {"apart", "color_first"}) {
        behave(order);
        const auto camera = open_camera("k4a:0");
        for (int n = 0; n < 6; ++n) {
            const Capture capture = camera->next(1s);
            ASSERT_EQ(capture.kind, Kind::frame) << order << ": " << capture.problem;
            EXPECT_EQ(depth_number(*capture.frame), n) << order;
            EXPECT_EQ(color_number(*capture.frame), n) << order;
        }
    }
}

// Without the library's pairing, times this far apart would not be paired.
TEST_F(K4aCamera, WhatTheLibraryPairedStaysPaired) {
    behave("color_later_us=20000");
    for (const auto& [options, expected] : {std::pair{"k4a:0,synchronized=1", 0}, {"k4a:0", -1}}) {
        const Capture capture = open_camera(options)->next(1s);
        ASSERT_EQ(capture.kind, Kind::frame) << capture.problem;
        EXPECT_EQ(depth_number(*capture.frame), 0);
        EXPECT_EQ(color_number(*capture.frame), expected) << options;
    }
}

TEST_F(K4aCamera, ALostColorPictureCostsNoDepth) {
    behave("apart,skip_color=2");
    const auto camera = open_camera("k4a:0");
    for (int n = 0; n < 5; ++n) {
        const Capture capture = camera->next(1s);
        ASSERT_EQ(capture.kind, Kind::frame) << capture.problem;
        EXPECT_EQ(depth_number(*capture.frame), n);
        EXPECT_EQ(color_number(*capture.frame), n == 2 ? -1 : n);
        EXPECT_EQ(capture.frame->color.empty(), n == 2);
    }
}

TEST_F(K4aCamera, DepthGoesOnWithoutColor) {
    for (const char* how :
         {"no_color", "not_jpeg", "color_bytes=3", "color_bytes=-1", "color_format=3"}) {
        behave(how);
        const auto camera = open_camera("k4a:0");
        for (int n = 0; n < 4; ++n) {
            const Capture capture = camera->next(1s);
            ASSERT_EQ(capture.kind, Kind::frame) << how << ": " << capture.problem;
            EXPECT_EQ(depth_number(*capture.frame), n);
            EXPECT_TRUE(capture.frame->color.empty());
        }
    }
}

// The address sanitizer detects reads beyond the picture here.
TEST_F(K4aCamera, DepthThatIsNotOfTheAgreedSizeIsRefused) {
    for (const char* lie : {"depth_width=100000", "depth_width=-5", "depth_stride=0",
                            "depth_stride=1278", "depth_stride=-1280", "depth_stride=2000000000",
                            "depth_bytes=0", "depth_bytes=737278", "depth_format=5", "no_depth"}) {
        behave(lie);
        const auto camera = impatient("k4a:0", {120ms, 120ms}, every_look_takes_time());
        const auto [frames, end] = play(*camera);
        EXPECT_EQ(frames, 0) << lie;
        EXPECT_EQ(end.kind, Kind::failed) << lie;
        EXPECT_THAT(end.problem, HasSubstr(std::string(lie) == "no_depth" ? "no depth picture"
                                                                          : "damaged pictures"));
    }
}

TEST_F(K4aCamera, CapturedIsWhenThePictureCameByWhicheverClock) {
    for (const char* clock :
         {"clock=steady", "clock=wall", "clock=none", "clock=steady,device_clock=none"}) {
        behave(clock);
        const auto camera = open_camera("k4a:0,fps=5");
        TimePoint before;
        for (int n = 0; n < 4; ++n) {
            const Capture capture = camera->next(1s);
            ASSERT_EQ(capture.kind, Kind::frame) << capture.problem;
            const FrameTimes& times = capture.frame->times;
            EXPECT_LE(times.captured, times.delivered) << clock;
            EXPECT_GT(times.captured, times.delivered - 10s) << clock;
            // Consecutive pictures may have equal times, because the wall clock counts
            // milliseconds.
            EXPECT_GE(times.captured, before) << clock;
            before = times.captured;
        }
    }
}

TEST_F(K4aCamera, NothingInTimeIsNoFailure) {
    behave("stall_after=1");
    const auto camera = impatient("k4a:0", {}, idle_takes(1ms));
    ASSERT_EQ(camera->next(1s).kind, Kind::frame);
    EXPECT_EQ(camera->next(Duration(0)).kind, Kind::nothing);
    const TimePoint begin = clock_.now();
    EXPECT_EQ(camera->next(5ms).kind, Kind::nothing);
    EXPECT_GE(clock_.now() - begin, 5ms);
}

TEST_F(K4aCamera, AnUnpluggedCameraFailsWithASentence) {
    behave("unplug_after=3");
    const auto camera = open_camera("k4a:0");
    const auto [frames, end] = play(*camera);
    EXPECT_EQ(frames, 3);
    EXPECT_EQ(end.kind, Kind::failed);
    EXPECT_EQ(end.problem,
              "The camera 'k4a:0' (k4a-000123450) was unplugged or has failed; check its USB cable "
              "and power supply, then start it again.");
    EXPECT_EQ(camera->next(Duration(0)).problem, end.problem);
}

TEST_F(K4aCamera, ASilentCameraFailsWithASentence) {
    behave("stall_after=3");
    const auto camera = impatient("k4a:0", {}, idle_takes(100ms));
    for (int n = 0; n < 3; ++n)
        ASSERT_EQ(camera->next(1s).kind, Kind::frame);
    int calls = 0;
    Capture capture = camera->next(5ms);
    for (; capture.kind == Kind::nothing && calls < 100; ++calls)
        capture = camera->next(5ms);
    EXPECT_EQ(calls, 20);
    EXPECT_EQ(capture.kind, Kind::failed);
    EXPECT_THAT(capture.problem, HasSubstr("has sent no depth picture for 2 seconds"));
}

TEST_F(K4aCamera, TimeInWhichNobodyAskedIsNotSilence) {
    behave("stall_after=3");
    const auto camera = impatient("k4a:0", {5s, 500ms}, idle_takes(1ms));
    for (int n = 0; n < 3; ++n)
        ASSERT_EQ(camera->next(1s).kind, Kind::frame);
    clock_.pass(600ms);
    EXPECT_EQ(camera->next(1ms).kind, Kind::nothing);
}

TEST_F(K4aCamera, SilencesBetweenFramesDoNotAddUp) {
    setenv("K4A_STANDIN", "period_us=1,in_vain=11", 1);
    const auto camera = impatient("k4a:0,color=off,depth=nfov2x2", {5s, 500ms}, idle_takes(20ms));
    const TimePoint begin = clock_.now();
    for (int frames = 0; frames < 80;) {
        const Capture capture = camera->next(1ms);
        ASSERT_NE(capture.kind, Kind::failed) << capture.problem;
        frames += capture.kind == Kind::frame;
    }
    EXPECT_EQ(clock_.now() - begin, 80 * 11 * 20ms);
}

TEST_F(K4aCamera, ASubordinateWaitsForItsMaster) {
    behave("stall_after=0");
    const k4a::Patience patience{120ms, 120ms};
    EXPECT_EQ(impatient("k4a:0,sync=subordinate", patience, idle_takes(300ms))->next(5ms).kind,
              Kind::nothing);
    EXPECT_EQ(impatient("k4a:0,sync=master", patience, idle_takes(300ms))->next(5ms).kind,
              Kind::failed);
}

TEST_F(K4aCamera, TheSerialNumberFindsTheDevice) {
    behave("devices=3");
    EXPECT_EQ(open_camera("k4a:serial=000123452")->info().name, "k4a-000123452");
    EXPECT_THAT(problem_with("k4a:serial=7"),
                AllOf(HasSubstr("3 are plugged in"), HasSubstr("other serial numbers")));
}

TEST_F(K4aCamera, SaysWhatIsInTheWay) {
    behave("devices=0");
    EXPECT_THAT(problem_with("k4a:0"), HasSubstr("no camera of this kind is plugged in"));
    behave("devices=1");
    EXPECT_THAT(problem_with("k4a:1"),
                AllOf(HasSubstr("no camera 'k4a:1': 1 camera is"), HasSubstr("theatron cameras")));
    behave("refuse_open");
    EXPECT_THAT(problem_with("k4a:0"),
                AllOf(HasSubstr("99-k4a.rules"), HasSubstr("/etc/udev/rules.d")));
    behave("refuse_start");
    EXPECT_THAT(problem_with("k4a:0"), AllOf(HasSubstr("USB 3"), HasSubstr("DISPLAY")));
    behave("calibration=none");
    EXPECT_THAT(problem_with("k4a:0"), HasSubstr("does not give its calibration"));
    behave("calibration=garbage");
    EXPECT_EQ(problem_with("k4a:0"), "The calibration in the camera 'k4a:0' is not JSON.");
    behave("refuse_controls");
    EXPECT_EQ(problem_with("k4a:0"), "");
    EXPECT_EQ(problem_with("k4a:0,exposure_us=8000"),
              "The camera 'k4a:0' refuses exposure_us=8000.");
}

TEST_F(K4aCamera, WithoutTheLibraryItSaysWhatToInstall) {
    setenv("THEATRON_K4A_LIBRARY", "/nowhere/libk4a.so", 1);
    EXPECT_THAT(problem_with("k4a:0"), HasSubstr("named by THEATRON_K4A_LIBRARY cannot be loaded"));
    unsetenv("THEATRON_K4A_LIBRARY");
    if (void* installed = dlopen("libk4a.so.1.4", RTLD_LAZY)) {
        dlclose(installed);
        GTEST_SKIP() << "libk4a is installed here";
    }
    EXPECT_THAT(problem_with("k4a:0"),
                AllOf(HasSubstr("libk4a1.4"), HasSubstr("Orbbec"), HasSubstr("synthetic")));
    EXPECT_EQ(problem_with("k4a:0"), k4a::find_devices().problem);
}

TEST_F(K4aCamera, AnotherLibraryIsRefused) {
    setenv("THEATRON_K4A_LIBRARY", "libm.so.6", 1);
    EXPECT_THAT(problem_with("k4a:0"), HasSubstr("lacks the function 'k4a_device_"));
}

TEST_F(K4aCamera, FindsTheDevicesThatAreThere) {
    behave("devices=2");
    const k4a::FoundDevices found = k4a::find_devices();
    EXPECT_EQ(found.problem, "");
    ASSERT_EQ(found.devices.size(), 2u);
    EXPECT_EQ(found.devices[1].index, 1u);
    EXPECT_EQ(found.devices[1].serial, "000123451");
    behave("devices=2,refuse_open");
    EXPECT_THAT(k4a::find_devices().devices.at(0).problem, HasSubstr("udev"));
    behave("devices=0");
    EXPECT_TRUE(k4a::find_devices().devices.empty());
}

}  // namespace
}  // namespace theatron::capture
