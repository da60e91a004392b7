// SPDX-License-Identifier: Apache-2.0
#include "capture/watched_camera.h"

#include <gtest/gtest.h>

#include <cmath>
#include <condition_variable>
#include <map>
#include <random>
#include <set>
#include <thread>

#include "base/error.h"
#include "capture/faulty_camera.h"
#include "capture/moments.h"

namespace theatron::capture {
namespace {

using wire::CameraCondition;

constexpr Size size{16, 12};

// Time that advances when a thread sleeps. `watch` runs meanwhile, as another thread would.
struct VirtualTime {
    TimePoint now = from_us(100'000'000);
    std::function<void()> watch = [] {};

    void sleep_until(TimePoint end) {
        while (now < end) {
            now = std::min(end, now + 10ms);
            watch();
        }
    }
    Clock clock() {
        return {[this] { return now; }, [this](Duration d) { sleep_until(now + d); }};
    }
};

// A free-running sensor with noise.
class Sensor final : public Camera {
public:
    Sensor(VirtualTime& time, double fps, std::uint32_t seed) : time_(time), rng_(seed) {
        info_.name = "sensor";
        info_.calibration.depth = pinhole(size, 60);
        info_.frames_per_second = 30;
        info_.live = true;
        period_us_ = 1e6 / fps;
        number_ = std::int64_t(std::ceil(double(to_us(time.now)) / period_us_));
    }
    const CameraInfo& info() const override { return info_; }
    Capture next(Duration timeout) override {
        const TimePoint due = from_us(std::llround(double(number_) * period_us_));
        if (due > time_.now + timeout) {
            time_.sleep_until(time_.now + timeout);
            return {};
        }
        time_.sleep_until(due);
        ++number_;
        const auto frame = pool_.take();
        frame->depth.resize(size);
        for (auto& pixel : frame->depth.pixels)
            pixel = std::uint16_t(1000 + rng_() % 8);
        frame->times = {};
        frame->times.captured = due;
        frame->times.delivered = time_.now;
        return {.kind = Capture::Kind::frame, .frame = frame, .problem = {}};
    }

private:
    VirtualTime& time_;
    std::mt19937 rng_;
    CameraInfo info_;
    double period_us_;
    std::int64_t number_;
    FramePool pool_;
};

// One camera of a room in which all faults occur, and its observed behaviour.
struct Patient {
    VirtualTime time;
    FaultPlan plan;
    double fps;
    std::unique_ptr<WatchedCamera> camera;
    std::uint64_t frames = 0, passed_over = 0;
    std::set<const Frame*> memory;
    TimePoint stale_since;  // zero: live
    TimePoint last_live;
    TimePoint stale_seen;  // last time at which it was stale
    Duration longest_unnoticed{}, longest_recovery{};
    int faults_seen = 0, faults_missed = 0;
    TimePoint judged;  // begin of the last fault that was evaluated

    Patient(std::uint32_t seed, double f) : plan{seed, 10s, {}}, fps(f) {
        const auto open = [this, seed] {
            return make_faulty_camera(std::make_unique<Sensor>(time, fps, seed), plan,
                                      time.clock().now, time.clock().sleep);
        };
        // The camera has no fault when the host starts.
        while (plan.at(time.now))
            time.now += 1s;
        camera = std::make_unique<WatchedCamera>(open(), open, time.clock());
        time.watch = [this] { look(); };
    }

    void look() {
        const auto status = camera->status();
        if (status.condition == CameraCondition::stale)
            stale_seen = time.now;
        const Fault fault = plan.nearest(time.now);
        // Short silences are lost frames, not faults.
        const Duration length = fault.end - fault.begin;
        const bool counts =
            fault.kind != FaultKind::lost_frames && fault.begin > from_us(101'000'000);
        if (!counts || time.now < fault.begin)
            return;
        const Duration into = time.now - fault.begin;
        if (stale_seen < fault.begin && into < length)
            longest_unnoticed = std::max(longest_unnoticed, into);
        if (status.condition == CameraCondition::stale && time.now > fault.end)
            longest_recovery = std::max(longest_recovery, time.now - fault.end);
        if (into > plan.every / 2 && judged != fault.begin) {
            judged = fault.begin;
            ++(stale_seen > fault.begin ? faults_seen : faults_missed);
        }
    }
};

TEST(WatchedCamera, AnHourOfFaultsIsSeenAndSurvived) {
    std::vector<std::unique_ptr<Patient>> room;
    for (int i = 0; i < 12; ++i)
        room.push_back(std::make_unique<Patient>(std::uint32_t(i + 1), 29.97 + 0.017 * i));
    Moments moments(30);
    const TimePoint end = from_us(100'000'000) + 1h;
    double worst_offset_us = 0;
    // Frames by capture time, stored until all cameras have advanced past them.
    std::map<TimePoint, std::size_t> given;
    while (true) {
        const auto next = std::min_element(
            room.begin(), room.end(),
            [](const auto& a, const auto& b) { return a->time.now < b->time.now; });
        Patient& patient = **next;
        while (!given.empty() && given.begin()->first <= patient.time.now) {
            const auto [captured, camera] = *given.begin();
            given.erase(given.begin());
            const auto tag = moments.tag(CameraId(camera), captured);
            worst_offset_us = std::max(worst_offset_us, std::abs(double(tag.offset.count())));
            ++(tag.pass_over ? room[camera]->passed_over : room[camera]->frames);
        }
        if (patient.time.now >= end)
            break;
        const auto step = patient.camera->step(patient.camera->turn(), 100ms);
        ASSERT_FALSE(step.over);
        patient.look();
        if (!step.frame)
            continue;
        patient.memory.insert(step.frame.get());
        given[step.frame->times.captured] = std::size_t(next - room.begin());
    }

    EXPECT_LE(worst_offset_us, 1e6 / 30 * 0.6);
    CameraCare::Figures all;
    for (const auto& patient : room) {
        SCOPED_TRACE(patient->plan.seed);
        const auto status = patient->camera->status();
        EXPECT_EQ(patient->faults_missed, 0);
        EXPECT_GT(patient->faults_seen, 200);
        EXPECT_LE(patient->longest_unnoticed, Duration(200ms));
        // The specified time: back-off may just have begun its longest pause.
        EXPECT_LE(patient->longest_recovery, Duration(2200ms));
        EXPECT_EQ(
            status.figures.troubles[int(Trouble::none)] >= std::uint64_t(patient->faults_seen),
            true);
        EXPECT_GT(patient->frames, 3600u * 30 * 7 / 10);
        EXPECT_LT(patient->passed_over, patient->frames / 50);
        EXPECT_GT(status.figures.reopens, 50u);
        // Each opening has its own pool; allocators may return the same memory again.
        EXPECT_LT(patient->memory.size(), 3000u);
        for (int kind = 0; kind < trouble_kinds; ++kind)
            all.troubles[kind] += status.figures.troubles[kind];
    }
    for (const Trouble kind :
         {Trouble::silent, Trouble::repeating, Trouble::time_jump, Trouble::gone})
        EXPECT_GT(all.troubles[int(kind)], 500u) << text_of(kind);
}

// A scripted camera that can also hang like a bad driver.
struct Script {
    std::mutex mutex;
    std::condition_variable changed;
    bool hang = false;
    int opened = 0;
};

class ScriptedCamera final : public Camera {
public:
    explicit ScriptedCamera(Script& script) : script_(script) {
        info_.calibration.depth = pinhole(size, 60);
        info_.live = true;
    }
    const CameraInfo& info() const override { return info_; }
    Capture next(Duration) override {
        std::unique_lock lock(script_.mutex);
        script_.changed.wait(lock, [&] { return !script_.hang; });
        return {};
    }

private:
    Script& script_;
    CameraInfo info_;
};

TEST(WatchedCamera, ADriverThatHangsIsLeftToItself) {
    Script script;
    const auto open = [&] {
        const std::lock_guard lock(script.mutex);
        ++script.opened;
        return std::make_unique<ScriptedCamera>(script);
    };
    WatchedCamera camera(open(), open);
    {
        const std::lock_guard lock(script.mutex);
        script.hang = true;
    }
    const auto first = camera.turn();
    std::thread stuck([&] { EXPECT_TRUE(camera.step(first, 1ms).over); });
    const auto second = camera.abandon();
    EXPECT_EQ(camera.status().trouble, Trouble::gone);
    while (camera.status().figures.reopens == 0)
        EXPECT_FALSE(camera.step(second, 1ms).over);
    EXPECT_EQ(script.opened, 2);
    {
        const std::lock_guard lock(script.mutex);
        script.hang = false;
    }
    script.changed.notify_all();
    stuck.join();
    EXPECT_FALSE(camera.step(second, 1ms).over);
    EXPECT_TRUE(camera.step(first, 1ms).over);
}

TEST(WatchedCamera, AnotherCameraInItsPlaceIsNotTaken) {
    VirtualTime time;
    class Other final : public Camera {
    public:
        Other() { info_.calibration.depth = pinhole({8, 8}, 60); }
        const CameraInfo& info() const override { return info_; }
        Capture next(Duration) override { return {}; }

    private:
        CameraInfo info_;
    };
    WatchedCamera camera(
        std::make_unique<Sensor>(time, 30, 1), [] { return std::make_unique<Other>(); },
        time.clock());
    const auto turn = camera.abandon();
    for (int i = 0; i < 100; ++i)
        EXPECT_FALSE(camera.step(turn, 20ms).over);
    EXPECT_EQ(camera.status().figures.reopens, 0u);
    EXPECT_GT(camera.status().figures.failed_reopens, 1u);
    EXPECT_NE(wire::english(camera.status().problem).find("another camera"), std::string::npos);
}

TEST(WatchedCamera, WhatEndsOrIsNotLiveIsNotOpenedAgain) {
    VirtualTime time;
    for (const auto kind : {Capture::Kind::end, Capture::Kind::failed}) {
        struct Over final : Camera {
            explicit Over(Capture::Kind k) : kind(k) { inf.calibration.depth = pinhole(size, 60); }
            const CameraInfo& info() const override { return inf; }
            Capture next(Duration) override {
                return {.kind = kind, .frame = {}, .problem = "Why."};
            }
            Capture::Kind kind;
            CameraInfo inf;
        };
        WatchedCamera camera(
            std::make_unique<Over>(kind), []() -> std::unique_ptr<Camera> { throw Error("never"); },
            time.clock());
        EXPECT_TRUE(camera.step(camera.turn(), 1ms).over);
        const auto status = camera.status();
        EXPECT_EQ(status.condition,
                  kind == Capture::Kind::end ? CameraCondition::ended : CameraCondition::failed);
        EXPECT_EQ(status.problem, wire::as_written("Why."));
    }
}

// tests/soak/cameras.py computes the same, to know which pictures a camera must deliver.
TEST(FaultPlan, FaultsFollowFromSeedAndTime) {
    const FaultPlan plan{7, 15s, {}};
    const Fault first = plan.nearest(from_us(0)), late = plan.nearest(from_us(1'500'000'000'000));
    EXPECT_EQ(first.kind, FaultKind::time_jump);
    EXPECT_EQ(to_us(first.begin), 4'693'257);
    EXPECT_EQ(to_us(first.end), 7'490'478);
    EXPECT_EQ(late.kind, FaultKind::repeat);
    EXPECT_EQ(to_us(late.begin), 1'500'004'784'225);
    EXPECT_EQ(to_us(late.end), 1'500'006'612'370);
}

}  // namespace
}  // namespace theatron::capture
