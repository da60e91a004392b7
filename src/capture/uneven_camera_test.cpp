// SPDX-License-Identifier: Apache-2.0
#include "capture/uneven_camera.h"

#include <gmock/gmock.h>

#include "base/error.h"

namespace theatron::capture {
namespace {

constexpr Duration period = std::chrono::milliseconds(33);

// A picture each period, in a time that passes only here.
class SteadyCamera final : public Camera {
public:
    explicit SteadyCamera(TimePoint& now) : now_(now) {}
    const CameraInfo& info() const override { return info_; }
    Capture next(Duration) override {
        auto frame = std::make_shared<Frame>();
        frame->number = FrameNumber(number_);
        due_ = due_ + period;
        now_ = std::max(now_, due_);
        frame->times.captured = frame->times.delivered = due_;
        ++number_;
        return {.kind = Capture::Kind::frame, .frame = std::move(frame), .problem = {}};
    }

private:
    TimePoint& now_;
    TimePoint due_{};
    int number_ = 0;
    CameraInfo info_;
};

struct Uneven : ::testing::Test {
    std::unique_ptr<Camera> camera(Unevenness unevenness) {
        return make_uneven_camera(std::make_unique<SteadyCamera>(now), unevenness,
                                  [this](Duration time) { now += time; });
    }
    TimePoint now{};
};

TEST_F(Uneven, EachPictureIsTakenAndDeliveredLater) {
    const auto late = camera({std::chrono::milliseconds(15), 0});
    for (int i = 1; i <= 3; ++i) {
        const Capture got = late->next({});
        ASSERT_EQ(got.kind, Capture::Kind::frame);
        EXPECT_EQ(got.frame->times.captured,
                  TimePoint{} + i * period + std::chrono::milliseconds(15));
        EXPECT_EQ(got.frame->times.delivered, got.frame->times.captured);
        EXPECT_EQ(now, got.frame->times.captured);
    }
}

TEST_F(Uneven, EachSeventhPictureIsMissing) {
    const auto uneven = camera({{}, 7});
    std::vector<int> came;
    for (int i = 0; i < 15; ++i)
        if (const Capture got = uneven->next({}); got.kind == Capture::Kind::frame)
            came.push_back(int(got.frame->number));
    EXPECT_THAT(came, ::testing::ElementsAre(0, 1, 2, 3, 4, 5, 7, 8, 9, 10, 11, 12, 14));
}

TEST(UnevenOptions, ACameraWithoutThemIsLeftAlone) {
    Options none = Options::parse("synthetic");
    EXPECT_EQ(take_uneven_options(none), std::nullopt);
    Options some = Options::parse("synthetic:late_ms=15,skip_every=7");
    const auto read = take_uneven_options(some);
    ASSERT_TRUE(read);
    EXPECT_EQ(read->late, std::chrono::milliseconds(15));
    EXPECT_EQ(read->skip_every, 7);
    Options wrong = Options::parse("synthetic:late_ms=1000");
    (void)take_uneven_options(wrong);
    EXPECT_NE(wrong.problem(), "");
    Options all = Options::parse("synthetic:skip_every=1");
    EXPECT_THROW(take_uneven_options(all), Error);
}

}  // namespace
}  // namespace theatron::capture
