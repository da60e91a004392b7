// SPDX-License-Identifier: Apache-2.0
#include "host/missing_camera.h"

#include <gtest/gtest.h>

#include <atomic>
#include <future>

#include "base/error.h"

namespace theatron::host {
namespace {

class MissingCameraTest : public ::testing::Test {
protected:
    class NoCamera final : public capture::Camera {
    public:
        const capture::CameraInfo& info() const override { return info_; }
        capture::Capture next(Duration) override { return {}; }

    private:
        capture::CameraInfo info_{"found", {}, 30, true};
    };

    // Is there from this attempt on.
    MissingCamera::Open there_at(int attempt) {
        return [this, attempt]() -> std::unique_ptr<capture::Camera> {
            if (++attempts < attempt)
                throw Error("No camera at attempt " + std::to_string(attempts) + ".");
            return std::make_unique<NoCamera>();
        };
    }
    MissingCamera::Found take() {
        return [this](std::unique_ptr<capture::Camera> camera) {
            found.set_value(camera->info().name);
        };
    }

    static constexpr MissingCamera::Pauses no_pauses{std::chrono::microseconds(1),
                                                     std::chrono::microseconds(1)};
    std::atomic<int> attempts = 0;
    std::promise<std::string> found;
};

TEST_F(MissingCameraTest, IsTriedUntilItIsThere) {
    const MissingCamera missing("At first.", there_at(4), take(), no_pauses);
    EXPECT_EQ(found.get_future().get(), "found");
    EXPECT_EQ(attempts, 4);
    EXPECT_EQ(missing.figures().problem, "No camera at attempt 3.");
    EXPECT_EQ(missing.figures().failed, 3u);
}

TEST_F(MissingCameraTest, SaysWhyBeforeItIsTriedAgain) {
    const MissingCamera missing("At first.", there_at(1), take(),
                                {std::chrono::hours(1), std::chrono::hours(1)});
    EXPECT_EQ(missing.figures().problem, "At first.");
    EXPECT_EQ(missing.figures().failed, 0u);
}

// The destructor returns although the pause is long, and nothing is found behind it.
TEST_F(MissingCameraTest, EndsInAPause) {
    {
        const MissingCamera missing("At first.", there_at(1), take(),
                                    {std::chrono::hours(1), std::chrono::hours(1)});
    }
    EXPECT_EQ(attempts, 0);
}

TEST_F(MissingCameraTest, IsExpectedUnderItsName) {
    EXPECT_EQ(expected_name("folder:/data/left/,fps=15"), "left");
    EXPECT_EQ(expected_name("mkv:/data/left.mkv,loop=1"), "left");
    EXPECT_EQ(expected_name("v4l2:/dev/video0"), "video0");
    EXPECT_EQ(expected_name("v4l2:/dev/video0,name=endoscope"), "endoscope");
    EXPECT_EQ(expected_name("k4a:0,serial=00123"), "k4a-00123");
    EXPECT_EQ(expected_name("k4a:0"), "k4a:0");
    EXPECT_EQ(expected_name("rtsp://anna:secret@tower/live").find("secret"), std::string::npos);
}

TEST_F(MissingCameraTest, TheRecordingThatIsPlayedDoesNotComeLater) {
    EXPECT_FALSE(may_come_later("recording:operation.mkv"));
    EXPECT_FALSE(may_come_later("synthetic:surgeon"));
    EXPECT_TRUE(may_come_later("folder:left"));
    EXPECT_FALSE(is_live_kind("folder:left"));
    for (const char* live : {"k4a:0", "v4l2:/dev/video0", "rtsp://tower/live", "x11:display"})
        EXPECT_TRUE(may_come_later(live) && is_live_kind(live)) << live;
}

}  // namespace
}  // namespace theatron::host
