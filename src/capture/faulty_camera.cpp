// SPDX-License-Identifier: Apache-2.0
#include "capture/faulty_camera.h"

#include <algorithm>

#include "base/error.h"
#include "base/steady_clock.h"

namespace theatron::capture {
namespace {

// An integer hash (splitmix64); neighbouring inputs give unrelated outputs.
std::uint64_t mixed(std::uint64_t x) {
    x += 0x9e3779b97f4a7c15;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9;
    x = (x ^ (x >> 27)) * 0x94d049bb133111eb;
    return x ^ (x >> 31);
}

Duration usual_length(FaultKind kind, std::uint64_t random) {
    const auto between = [&](Duration least, Duration most) {
        return least + Duration(std::int64_t(random % std::uint64_t((most - least).count())));
    };
    switch (kind) {
        case FaultKind::lost_frames:
            return between(30ms, 130ms);
        case FaultKind::hang:
            return between(500ms, 2500ms);
        default:
            return between(300ms, 3s);
    }
}

constexpr const char* unplugged = "The camera is not there; check its cable.";

class FaultyCamera final : public Camera {
public:
    FaultyCamera(std::unique_ptr<Camera> camera, const FaultPlan& plan,
                 std::function<TimePoint()> now, std::function<void(Duration)> sleep)
        : camera_(std::move(camera)),
          info_(camera_->info()),
          plan_(plan),
          now_(std::move(now)),
          sleep_(std::move(sleep)),
          opened_(now_()) {
        info_.live = true;
    }

    const CameraInfo& info() const override { return info_; }
    void follow(std::shared_ptr<Transport> transport) override {
        camera_->follow(std::move(transport));
    }
    std::uint64_t lost_pictures() const override { return camera_->lost_pictures(); }

    Capture next(Duration timeout) override {
        const TimePoint now = now_();
        const std::optional<Fault> fault = plan_.at(now);
        if (gone_ || (fault && fault->kind == FaultKind::unplugged)) {
            gone_ = true;
            return {.kind = Capture::Kind::failed, .frame = {}, .problem = unplugged};
        }
        if (fault && fault->kind == FaultKind::hang)
            sleep_(fault->end - now);
        // A camera that is opened after a jump has a correct clock.
        if (const Fault near = plan_.nearest(now); near.kind == FaultKind::time_jump &&
                                                   near.begin > std::max(opened_, plan_.from) &&
                                                   near.begin <= now)
            jumped_ = near.jump;
        if (fault && fault->kind == FaultKind::repeat && last_) {
            sleep_(std::min(timeout, seconds_to_duration(1 / info_.frames_per_second)));
            return {.kind = Capture::Kind::frame, .frame = repeated(), .problem = {}};
        }
        Capture got = camera_->next(timeout);
        if (got.kind != Capture::Kind::frame)
            return got;
        if (fault && (fault->kind == FaultKind::silence || fault->kind == FaultKind::lost_frames))
            return {};
        last_ = got.frame;
        if (jumped_ != Duration{}) {
            auto frame = std::make_shared<Frame>(*got.frame);
            frame->times.captured += jumped_;
            got.frame = std::move(frame);
        }
        return got;
    }

private:
    // Repeats the last picture; cameras with an even seed give it a new time.
    FramePtr repeated() {
        auto frame = std::make_shared<Frame>(*last_);
        frame->times.delivered = now_();
        if (plan_.seed % 2 == 0)
            frame->times.captured = frame->times.delivered;
        return frame;
    }

    std::unique_ptr<Camera> camera_;
    CameraInfo info_;
    FaultPlan plan_;
    std::function<TimePoint()> now_;
    std::function<void(Duration)> sleep_;
    TimePoint opened_;
    bool gone_ = false;
    Duration jumped_{};
    FramePtr last_;
};

}  // namespace

Fault FaultPlan::nearest(TimePoint now) const {
    const std::int64_t stretch = to_us(now) / every.count();
    const std::uint64_t random = mixed(std::uint64_t(stretch) * 0x10001 + seed);
    Fault fault;
    fault.kind = FaultKind(random % fault_kinds);
    const Duration length = std::min(usual_length(fault.kind, mixed(random)), every / 3);
    // A fault begins in the first third of its stretch, so that the camera can recover.
    const auto latest = std::uint64_t((every / 3).count());
    fault.begin = from_us(stretch * every.count() + std::int64_t(mixed(random + 1) % latest));
    fault.end = fault.begin + length;
    const Duration jump = 2s + Duration(std::int64_t(mixed(random + 2) % 3'600'000'000));
    fault.jump = random >> 63 ? jump : -jump;
    return fault;
}

std::optional<Fault> FaultPlan::at(TimePoint now) const {
    const Fault fault = nearest(now);
    if (now < fault.begin || now >= fault.end || fault.begin < from)
        return std::nullopt;
    return fault;
}

std::unique_ptr<Camera> make_faulty_camera(std::unique_ptr<Camera> camera, const FaultPlan& plan,
                                           std::function<TimePoint()> now,
                                           std::function<void(Duration)> sleep) {
    if (const auto fault = plan.at(now()); fault && fault->kind == FaultKind::unplugged)
        throw Error(unplugged);
    return std::make_unique<FaultyCamera>(std::move(camera), plan, std::move(now),
                                          std::move(sleep));
}

std::optional<FaultPlan> take_fault_options(Options& options) {
    constexpr int none = -1;
    const int seed = options.take_int("faults", none, 0, 1'000'000);
    const double every = options.take_number("faults_every", 10, 1, 3600);
    if (seed == none)
        return std::nullopt;
    // A host requires all its cameras at the start.
    static const TimePoint program_began = steady_now();
    return FaultPlan{std::uint32_t(seed), seconds_to_duration(every), program_began + 2s};
}

}  // namespace theatron::capture
