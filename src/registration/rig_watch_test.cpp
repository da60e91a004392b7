// SPDX-License-Identifier: Apache-2.0
#include "registration/rig_watch.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <ctime>
#include <utility>

#include "registration/room_view_test.h"

namespace theatron::registration {
namespace {

// Time of a processor that this thread has used.
double cpu_ms() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return double(now.tv_sec) * 1e3 + double(now.tv_nsec) / 1e6;
}

// Cameras around a surgeon and an assistant at work.
class Watching : public ::testing::Test {
protected:
    Watching() {
        for (int i = 0; i < 2; ++i)
            cameras_.push_back(std::make_unique<RoomCamera>(i, 2, synthetic::nfov_unbinned()));
        watch_ = std::make_unique<RigWatch>(about());
    }

    std::vector<RigWatch::Camera> about() const {
        std::vector<RigWatch::Camera> about;
        for (const auto& camera : cameras_)
            about.push_back({camera->calibration.depth, 1, camera->calibration.room_from_camera});
        return about;
    }

    void stream(Duration length) {
        for (const TimePoint end = now_ + length; now_ < end; now_ += watch_->period())
            for (std::size_t c = 0; c < cameras_.size(); ++c) {
                ASSERT_TRUE(watch_->is_due(c, now_));
                const DepthImage depth = cameras_[c]->image(now_.time_since_epoch());
                const double begin = cpu_ms();
                watch_->add(c, depth.view(), now_);
                cpu_ms_ += cpu_ms() - begin;
                ++images_;
                worst_m_ = std::max(worst_m_, watch_->motion(c).moved_m);
                worst_deg_ = std::max(worst_deg_, watch_->motion(c).turned_deg);
                alarms_ += has_alarm(c);
            }
    }

    bool has_alarm(std::size_t camera) const {
        return watch_->motion(camera).is_alarm || watch_->wrong_pair(camera);
    }

    std::unique_ptr<synthetic::OperatingRoom> room_;  // outlives the cameras that entered it
    std::vector<std::unique_ptr<RoomCamera>> cameras_;
    std::unique_ptr<RigWatch> watch_;
    TimePoint now_{std::chrono::seconds(1)};
    double worst_m_ = 0, worst_deg_ = 0, cpu_ms_ = 0;
    int images_ = 0;
    int alarms_ = 0;
};

// MINUTES=60 is what `make test-all` runs: in each minute the same room with other people, whose
// hands and heads take other ways, at another speed, before the same watch.
TEST_F(Watching, NoAlarmWhileASurgeonMovesBeforeFixedCameras) {
    const char* minutes = std::getenv("MINUTES");
    if (!minutes)
        stream(std::chrono::seconds(20));
    for (int minute = 0; minutes && minute < std::atoi(minutes); ++minute) {
        const Duration loop = std::chrono::seconds(15 + 11 * minute % 46);  // 15 to 60 s
        auto room = std::make_unique<synthetic::OperatingRoom>(synthetic::SceneOptions{
            .seed = 3 + std::uint32_t(minute), .loop = loop, .detail = 0.3});
        for (const auto& camera : cameras_)
            camera->enter(*room);
        room_ = std::move(room);
        const double before_m = std::exchange(worst_m_, 0);
        const int alarms = alarms_;
        stream(std::chrono::minutes(1));
        std::printf("minute %2d, loop of %2d s: %.2f mm%s\n", minute + 1,
                    int(loop / std::chrono::seconds(1)), worst_m_ * 1000,
                    alarms_ > alarms ? ", ALARM" : "");
        std::fflush(stdout);
        worst_m_ = std::max(worst_m_, before_m);
    }
    EXPECT_EQ(alarms_, 0);
    EXPECT_TRUE(watch_->motion(0).is_known);
    EXPECT_TRUE(watch_->motion(1).is_known);
    ASSERT_EQ(watch_->pairs().size(), 1u);
    EXPECT_GT(watch_->pairs()[0].points, 100u);
    EXPECT_LT(watch_->pairs()[0].apart_m, 0.008);
    std::printf(
        "largest motion seen: %.2f mm, %.2f degrees; surfaces apart: %.1f mm; %.2f ms of a core an "
        "image\n",
        worst_m_ * 1000, worst_deg_, watch_->pairs()[0].apart_m * 1000, cpu_ms_ / images_);
}

TEST_F(Watching, ACameraMovedByFiveMillimetresOrThreeTenthsOfADegreeRaisesTheAlarm) {
    struct Case {
        const char* name;
        Pose moved;
        double least_mm, most_mm;
    };
    const double turn = radians_of(0.3);
    const Case cases[] = {{"along", {{}, {0, 0, 0.005}}, 4, 6},
                          {"across", {{}, {0.005, 0, 0}}, 4, 6},
                          {"up", {{}, {0, 0.005, 0}}, 4, 6},
                          {"yaw", {rotation_about({0, 1, 0}, turn), {}}, 7, 16},
                          {"pitch", {rotation_about({1, 0, 0}, turn), {}}, 7, 16},
                          {"roll", {rotation_about({0, 0, 1}, turn), {}}, 2, 8}};
    for (const Case& c : cases) {
        SCOPED_TRACE(c.name);
        cameras_[1]->place_at({});
        watch_ = std::make_unique<RigWatch>(about());
        stream(std::chrono::seconds(12));
        EXPECT_FALSE(has_alarm(1));
        cameras_[1]->place_at(c.moved);
        const TimePoint moved_at = now_;
        while (!has_alarm(1) && now_ - moved_at < std::chrono::seconds(15))
            stream(watch_->period());
        EXPECT_LE(now_ - moved_at, std::chrono::seconds(10));
        stream(std::chrono::seconds(2));
        EXPECT_FALSE(has_alarm(0));
        EXPECT_TRUE(has_alarm(1));
        const RigWatch::Motion& motion = watch_->motion(1);
        EXPECT_GT(motion.moved_m * 1000, c.least_mm);
        EXPECT_LT(motion.moved_m * 1000, c.most_mm);
        // The new place is found, too.
        const Pose truth = cameras_[1]->calibration.room_from_camera * c.moved;
        const Vec3 at{0, 0, 2};
        ASSERT_TRUE(motion.room_from_camera);
        EXPECT_LT(length(*motion.room_from_camera * at - truth * at), 0.002);
    }
    // It is put back.
    cameras_[1]->place_at({});
    stream(std::chrono::seconds(6));
    EXPECT_FALSE(has_alarm(1));
}

// With more cameras each is compared less often. Only two of them give pictures here.
TEST_F(Watching, OneOfEightCamerasRaisesTheAlarmInTime) {
    std::vector<RigWatch::Camera> cameras = about();
    cameras.resize(8, cameras[1]);
    watch_ = std::make_unique<RigWatch>(cameras);
    stream(20 * watch_->period());
    EXPECT_FALSE(has_alarm(1));
    EXPECT_TRUE(watch_->motion(1).is_known);
    cameras_[1]->place_at({{}, {0, 0, 0.005}});
    const TimePoint moved_at = now_;
    while (!has_alarm(1) && now_ - moved_at < std::chrono::seconds(15))
        stream(watch_->period());
    EXPECT_LE(now_ - moved_at, std::chrono::seconds(10));
}

// The pictures are those of a camera that was registered 4 cm away from where it is.
TEST_F(Watching, ANudgeThatCorrectsAPlaceEndsTheAlarmOfTheOverlapAndRaisesNone) {
    std::vector<RigWatch::Camera> cameras = about();
    const Pose truth = *cameras[1].room_from_camera;
    cameras[1].room_from_camera->translation.y += 0.04;
    watch_ = std::make_unique<RigWatch>(cameras);
    stream(std::chrono::seconds(12));
    EXPECT_TRUE(watch_->wrong_pair(1));
    watch_->correct_place(1, truth);
    EXPECT_FALSE(watch_->wrong_pair(1)) << "it is compared anew";
    stream(std::chrono::seconds(8));
    EXPECT_FALSE(has_alarm(0));
    EXPECT_FALSE(has_alarm(1));
    EXPECT_EQ(watch_->pairs().size(), 1u);
    EXPECT_LT(length(watch_->motion(1).room_from_camera->translation - truth.translation), 0.004);
}

// A place was found together with the offset of its camera's depth; only both together fit.
TEST_F(Watching, TheSavedOffsetOfACamerasDepthBelongsToItsPlace) {
    constexpr std::uint16_t offset_mm = 25;
    for (const bool is_known : {false, true}) {
        std::vector<RigWatch::Camera> cameras = about();
        cameras[0].depth_offset_m = is_known ? offset_mm / 1000.0 : 0;
        RigWatch watch(cameras);
        for (const TimePoint end = now_ + std::chrono::seconds(10); now_ < end;
             now_ += watch.period())
            for (std::size_t c = 0; c < cameras_.size(); ++c) {
                DepthImage depth = cameras_[c]->image(now_.time_since_epoch());
                if (c == 0)
                    for (std::uint16_t& pixel : depth.pixels)
                        pixel = std::uint16_t(pixel == 0 ? 0 : pixel + offset_mm);
                watch.add(c, depth.view(), now_);
            }
        EXPECT_EQ(watch.wrong_pair(0) == nullptr, is_known);
    }
}

// A bed with raised sides above a floor, through the sensor. `half` is half its length and width.
DepthImage bed(const Pose& room_from_camera, const SurfaceCamera& camera, Vec2 half,
               double raised_m, synthetic::DepthSensor& sensor, std::uint32_t frame) {
    BoardScene scene(camera.model.size, 0);
    std::fill(scene.depth_m.pixels.begin(), scene.depth_m.pixels.end(), 0.0f);
    for (std::size_t i = 0; i < camera.rays.pixels.size(); ++i) {
        const Ray ray = camera.rays.pixels[i];
        if (ray.x == no_ray)
            continue;
        const Vec3 d = rotate(room_from_camera.rotation, {ray.x, ray.y, 1});
        const Vec3 o = room_from_camera.translation;
        double z = d.y < 0 ? -o.y / d.y : 8;
        // Two slopes that meet in the middle, like a roof.
        for (const double slope : {-0.3, 0.3}) {
            const double t = (0.9 + raised_m - o.y + slope * o.x) / (d.y - slope * d.x);
            const Vec3 p = o + d * t;
            if (t > 0 && t < z && p.x * slope <= 0 && std::abs(p.x) < half.x &&
                std::abs(p.z) < half.y)
                z = t;
        }
        scene.depth_m.pixels[i] = float(z);
    }
    return scene.seen_by(sensor, frame);
}

// Two cameras close above the bed, which is most of their pictures, and one that sees the room.
class RaisedTable : public ::testing::Test {
protected:
    void add_camera(Vec3 from, Vec3 to) {
        const Calibration c = synthetic::synthetic_camera(synthetic::Variant::room, 0, 2, {});
        const Pose place = look_at(from, to, {0, 1, 0});
        cameras_.emplace_back(c.depth, 1);
        sensors_.emplace_back(synthetic::nfov_unbinned(), c.depth.size, 40 + sensors_.size());
        about_.push_back({c.depth, 1, place});
    }
    void add_two_above() {
        for (const double side : {-0.7, 0.7})
            add_camera({side, 2.2, 0.5}, {0.3 * side, 0.9, 0});
    }

    // The table is raised after 11 of 18 seconds.
    RigWatch raise(Vec2 half) {
        RigWatch watch(about_);
        TimePoint now{std::chrono::seconds(1)};
        std::uint32_t frame = 0;
        for (int image = 0; image < 36; ++image, now += watch.period())
            for (std::size_t c = 0; c < about_.size(); ++c) {
                const DepthImage depth = bed(*about_[c].room_from_camera, cameras_[c], half,
                                             image < 22 ? 0 : 0.015, sensors_[c], ++frame);
                watch.add(c, depth.view(), now);
            }
        return watch;
    }

    static constexpr Vec2 with_floor_around{0.9, 0.65}, nothing_else{1.1, 0.8};  // half sizes

    std::vector<RigWatch::Camera> about_;
    std::vector<SurfaceCamera> cameras_;
    std::vector<synthetic::DepthSensor> sensors_;
};

TEST_F(RaisedTable, IsNoCameraThatWasMoved) {
    add_two_above();
    const RigWatch watch = raise(with_floor_around);
    for (std::size_t c = 0; c < 2; ++c)
        EXPECT_FALSE(watch.motion(c).is_alarm);
    ASSERT_FALSE(watch.pairs().empty());
    EXPECT_GT(watch.pairs()[0].points, 300u);
}

TEST_F(RaisedTable, ThatFillsAPictureIsKnownByACameraThatStandsStill) {
    add_two_above();
    add_camera({0, 2, 2}, {0, 0.6, 0.9});
    const RigWatch watch = raise(nothing_else);
    for (std::size_t c = 0; c < 3; ++c)
        EXPECT_FALSE(watch.motion(c).is_alarm);
}

// Cameras on one arm that sinks would see the same (docs/decisions/place-watch.md).
TEST_F(RaisedTable, ThatIsAllThatTheCamerasSeeIsAnAlarm) {
    add_two_above();
    const RigWatch watch = raise(nothing_else);
    for (std::size_t c = 0; c < 2; ++c) {
        EXPECT_TRUE(watch.motion(c).is_alarm);
        EXPECT_EQ(watch.motion(c).together_with, std::optional<std::size_t>(1 - c));
    }
}

}  // namespace
}  // namespace theatron::registration
