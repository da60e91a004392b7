// SPDX-License-Identifier: Apache-2.0
// Two cameras on one arm that is moved, with and without a third one that stays.
#include <gtest/gtest.h>

#include "registration/rig_watch.h"
#include "registration/room_view_test.h"

namespace theatron::registration {
namespace {

using std::chrono::seconds;

class CamerasOnOneArm : public ::testing::Test {
protected:
    CamerasOnOneArm() {
        for (int i = 0; i < 3; ++i)
            cameras_.push_back(std::make_unique<RoomCamera>(i, 3, synthetic::nfov_unbinned()));
        for (const std::size_t count : {std::size_t(2), std::size_t(3)}) {
            std::vector<RigWatch::Camera> about;
            for (std::size_t c = 0; c < count; ++c)
                about.push_back(
                    {cameras_[c]->calibration.depth, 1, cameras_[c]->calibration.room_from_camera});
            watches_.emplace_back(about);
        }
    }

    // The last camera stands alone.
    void move_arm(const Pose& in_room) {
        for (std::size_t c = 0; c < 2; ++c) {
            const Pose place = cameras_[c]->calibration.room_from_camera;
            cameras_[c]->place_at(inverse(place) * in_room * place);
        }
    }

    void stream(Duration length) {
        for (const TimePoint end = now_ + length; now_ < end; now_ += watches_[0].period())
            for (std::size_t c = 0; c < cameras_.size(); ++c) {
                const DepthImage depth = cameras_[c]->image(now_.time_since_epoch());
                for (std::size_t w = c < 2 ? 0 : 1; w < watches_.size(); ++w)
                    watches_[w].add(c, depth.view(), now_);
            }
    }

    // The arm moves, after the references are complete.
    void expect_alarms(const Pose& in_room) {
        stream(seconds(10));
        for (const RigWatch& watch : watches_)
            for (std::size_t c = 0; c < 2; ++c)
                EXPECT_FALSE(watch.motion(c).is_alarm);
        move_arm(in_room);
        stream(seconds(10));
        expect_alarms_of_the_arm();
    }

    void expect_alarms_of_the_arm() const {
        for (std::size_t w = 0; w < watches_.size(); ++w)
            for (std::size_t c = 0; c < 2; ++c) {
                SCOPED_TRACE(::testing::Message() << w + 2 << " cameras, camera " << c);
                const RigWatch::Motion& motion = watches_[w].motion(c);
                EXPECT_TRUE(motion.is_alarm);
                EXPECT_EQ(motion.renewals, 0) << "it is compared with what it sees now";
                EXPECT_EQ(motion.together_with, std::optional<std::size_t>(1 - c));
            }
        EXPECT_FALSE(watches_[1].motion(2).is_alarm);
    }

    std::vector<std::unique_ptr<RoomCamera>> cameras_;
    std::vector<RigWatch> watches_;
    TimePoint now_{seconds(1)};
};

TEST_F(CamerasOnOneArm, ThatIsMovedByFiveMillimetresHaveTheAlarm) {
    expect_alarms({{}, {0, -0.005, 0}});
    stream(seconds(24));
    expect_alarms_of_the_arm();
}

TEST_F(CamerasOnOneArm, ThatIsMovedByThirtyMillimetresHaveTheAlarm) {
    expect_alarms({{}, {0.03, 0, 0}});
}

TEST_F(CamerasOnOneArm, ThatIsTurnedByHalfADegreeHaveTheAlarm) {
    const Pose joint{{}, {0, 2.6, 0}};
    expect_alarms(joint * Pose{rotation_about({0, 1, 0}, radians_of(0.5)), {}} * inverse(joint));
}

}  // namespace
}  // namespace theatron::registration
