// SPDX-License-Identifier: Apache-2.0
// Cameras that are moved too far to be measured, and covered ones, are watched.
#include <gtest/gtest.h>

#include <functional>
#include <random>

#include "registration/rig_watch.h"
#include "registration/room_view_test.h"

namespace theatron::registration {
namespace {

using std::chrono::seconds;

struct Block {
    Vec3 low, high;
};

// Where the ray enters the block, or leaves it if it begins inside; 0: it does not meet it.
double distance_to(const Block& block, Vec3 from, Vec3 way) {
    double enter = -1e9, leave = 1e9;
    const double o[] = {from.x, from.y, from.z}, d[] = {way.x, way.y, way.z};
    const double low[] = {block.low.x, block.low.y, block.low.z},
                 high[] = {block.high.x, block.high.y, block.high.z};
    for (int k = 0; k < 3; ++k) {
        const double a = (low[k] - o[k]) / d[k], b = (high[k] - o[k]) / d[k];
        enter = std::max(enter, std::min(a, b));
        leave = std::min(leave, std::max(a, b));
    }
    if (enter > leave || leave <= 0)
        return 0;
    return enter > 0 ? enter : leave;
}

// A camera above the end of a table in a room with a cupboard and a lamp.
class BlockRoom : public ::testing::Test {
protected:
    BlockRoom() {
        calibration_.depth = {{320, 288}, 252, 252, 159.5, 143.5, {}, {}};
        rays_ = make_ray_table(calibration_.depth);
        watch_ = std::make_unique<RigWatch>(
            std::vector<RigWatch::Camera>{{calibration_.depth, 1, place_}});
    }

    DepthImage image() {
        std::normal_distribution<double> noise_mm(0, 2);
        DepthImage depth(calibration_.depth.size);
        const Pose now = place_ * moved_;
        for (std::size_t i = 0; i < depth.pixels.size(); ++i) {
            const Ray ray = rays_.pixels[i];
            const Vec3 way = rotate(now.rotation, {ray.x, ray.y, 1});
            double z = distance_to({{-2.5, 0, -3}, {2.5, 3, 2.5}}, now.translation, way);
            for (const Block& block : blocks_)
                if (const double there = distance_to(block, now.translation, way);
                    there > 0 && there < z)
                    z = there;
            depth.pixels[i] = is_capped_ ? std::uint16_t(0)
                                         : std::uint16_t(std::max(1.0, z * 1000 + noise_mm(rng_)));
        }
        return depth;
    }

    void stream(
        Duration length, const std::function<void()>& each = [] {}) {
        for (const TimePoint end = now_ + length; now_ < end; now_ += watch_->period()) {
            each();
            watch_->add(0, image().view(), now_);
            alarms_ += motion().is_alarm;
        }
    }

    const RigWatch::Motion& motion() const { return watch_->motion(0); }

    const Pose place_ = look_at({0.9, 2.1, 1.5}, {0, 0.9, -0.2}, {0, 1, 0});
    Pose moved_;
    bool is_capped_ = false;
    std::vector<Block> blocks_{{{-0.3, 0.85, -1}, {0.3, 0.9, 0.9}},    // a table
                               {{-0.2, 0.9, -0.8}, {0.2, 1.15, 0.6}},  // a patient
                               {{-2.4, 0, -2.8}, {-1.6, 1.8, -2.2}},   // a cupboard
                               {{-1.2, 0, -2.2}, {-0.8, 0.9, -1.6}}};  // a stool
    int alarms_ = 0;

private:
    Calibration calibration_;
    Image<Ray> rays_;
    std::unique_ptr<RigWatch> watch_;
    std::mt19937 rng_{5};
    TimePoint now_{seconds(1)};

protected:
    void accept_place() { watch_->accept_place(0); }
};

const Pose moves[] = {{{}, {0.4, 0, 0}},
                      {{}, {0, 0, 0.4}},
                      {{}, {0, 0.06, 0}},
                      {rotation_about({0, 1, 0}, radians_of(20)), {}},
                      {rotation_about({1, 0, 0}, radians_of(-20)), {}}};

TEST_F(BlockRoom, AFarMotionRaisesAnAlarmThatStaysUntilTheCameraIsPutBack) {
    stream(seconds(12));
    for (std::size_t i = 0; i < std::size(moves); ++i) {
        SCOPED_TRACE(i);
        EXPECT_FALSE(motion().is_alarm);
        moved_ = moves[i];
        stream(seconds(10));
        EXPECT_TRUE(motion().is_alarm);
        stream(seconds(40));
        EXPECT_TRUE(motion().is_alarm) << "what the camera sees now has become the reference";
        EXPECT_FALSE(motion().is_covered);
        EXPECT_GE(motion().moved_m, RigWatch::far_m);
        if (motion().is_far) {
            EXPECT_FALSE(motion().room_from_camera);
        }
        moved_ = {};
        stream(seconds(8));
    }
    EXPECT_FALSE(motion().is_alarm);
    EXPECT_FALSE(motion().is_far);
    EXPECT_LT(motion().moved_m, 0.002);
    EXPECT_TRUE(motion().room_from_camera);
}

TEST_F(BlockRoom, ACoveredCameraIsNamedAndWatchedAgainWhenItIsUncovered) {
    for (const bool is_capped : {true, false}) {
        SCOPED_TRACE(is_capped);
        stream(seconds(12));
        EXPECT_FALSE(motion().is_covered);
        const auto cover = [&](bool on) {
            is_capped_ = on && is_capped;
            if (!is_capped && on)
                blocks_.push_back({place_.translation - Vec3{1, 1, 0.6},  // a drape
                                   place_.translation + Vec3{1, 1, -0.3}});
            else if (!is_capped)
                blocks_.pop_back();
        };
        cover(true);
        stream(seconds(40));
        EXPECT_TRUE(motion().is_covered);
        EXPECT_FALSE(motion().is_known);
        cover(false);
        stream(seconds(12));
        EXPECT_EQ(alarms_, 0);
        EXPECT_FALSE(motion().is_covered);
        EXPECT_TRUE(motion().is_known);

        cover(true);
        stream(seconds(15));
        moved_ = moves[3];
        cover(false);
        stream(seconds(10));
        EXPECT_TRUE(motion().is_alarm);
        moved_ = {};
        stream(seconds(8));
        EXPECT_FALSE(motion().is_alarm);
        alarms_ = 0;
    }
}

TEST_F(BlockRoom, ACameraThatIsCoveredFromTheBeginningIsNamedToo) {
    is_capped_ = true;
    stream(seconds(20));
    EXPECT_TRUE(motion().is_covered);
    is_capped_ = false;
    stream(seconds(24));
    EXPECT_FALSE(motion().is_covered);
    EXPECT_TRUE(motion().is_known);
    EXPECT_EQ(alarms_, 0);
}

TEST_F(BlockRoom, APersonBeforeTheCameraForAMinuteIsNoMotion) {
    stream(seconds(12));
    const Vec3 eye = place_.translation, ahead = rotate(place_.rotation, {0, 0, 1});
    blocks_.emplace_back();
    double time = 0;
    stream(seconds(60), [&] {
        // Sways by some centimetres, 0.7 m before the camera.
        time += 0.5;
        const Vec3 middle =
            eye + ahead * 0.7 + Vec3{0.04 * std::sin(time), 0, 0.03 * std::sin(0.7 * time)};
        blocks_.back() = {{middle.x - 0.3, 0, middle.z - 0.2},
                          {middle.x + 0.3, 1.8, middle.z + 0.2}};
    });
    blocks_.pop_back();
    stream(seconds(8));
    EXPECT_EQ(alarms_, 0);
    EXPECT_TRUE(motion().is_known);
}

TEST_F(BlockRoom, ATableThatIsMovedByHalfAMetreIsNoMotion) {
    stream(seconds(12));
    for (int step = 0; step < 10; ++step) {
        for (int i = 0; i < 2; ++i) {
            blocks_[std::size_t(i)].low.x -= 0.05;
            blocks_[std::size_t(i)].high.x -= 0.05;
        }
        stream(seconds(1));
    }
    stream(seconds(30));
    EXPECT_EQ(alarms_, 0);
    EXPECT_TRUE(motion().is_known);
    moved_ = moves[0];
    stream(seconds(10));
    EXPECT_TRUE(motion().is_alarm);
}

TEST_F(BlockRoom, WhoAcceptsTheNewPlaceEndsTheAlarmUntilTheNextMotion) {
    stream(seconds(12));
    moved_ = moves[0];
    stream(seconds(10));
    EXPECT_TRUE(motion().is_far);
    accept_place();
    EXPECT_FALSE(motion().is_alarm);
    alarms_ = 0;
    stream(seconds(20));
    EXPECT_EQ(alarms_, 0);
    EXPECT_TRUE(motion().is_known);
    moved_ = {};
    stream(seconds(10));
    EXPECT_TRUE(motion().is_alarm) << "it left the place that was accepted";
}

}  // namespace
}  // namespace theatron::registration
