// SPDX-License-Identifier: Apache-2.0
#include "filter/chain.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include "filter/frame_gap.h"
#include "filter/stage_rules.h"
#include "image/scratch.h"

namespace theatron::filter {
namespace {

// One filter with all that it remembers.
struct FlyingPixels {
    FlyingPixelRule rule;
};
struct Speckles {
    SpeckleRule rule;
};
struct Holes {
    HoleRule rule;
};
struct Kalman {
    KalmanRule rule;
    KalmanState state;
};
// What one filter hands to the next.
struct Planes {
    explicit Planes(Size size) : current(size), next(size) {}
    DepthPlane current, next;
};
using Stage = std::variant<Limits, FlyingPixels, Speckles, Holes, Kalman>;

class StageMaker {
public:
    explicit StageMaker(const ChainCamera& camera) : camera_(camera) {}

    std::vector<Stage> make(const ChainSettings& settings) {
        for (const Step& step : settings.steps)
            std::visit([this](const auto& params) { add(params); }, step);
        return std::move(stages_);
    }

private:
    void add(const RangeParams& params) { narrow(limits(), params, camera_); }
    void add(const BackgroundParams& params) { narrow(limits(), params, camera_); }
    void add(const FlyingPixelParams& params) {
        stages_.push_back(FlyingPixels{rule_of(params, camera_)});
    }
    void add(const SpeckleParams& params) { stages_.push_back(Speckles{rule_of(params, camera_)}); }
    void add(const HoleParams& params) { stages_.push_back(Holes{rule_of(params, camera_)}); }
    void add(const KalmanParams& params) {
        stages_.push_back(Kalman{rule_of(params, camera_), KalmanState(camera_.size)});
    }

    // Neighbouring steps that only compare share one comparison.
    Limits& limits() {
        if (stages_.empty() || !std::holds_alternative<Limits>(stages_.back()))
            stages_.push_back(Limits(camera_.size));
        return std::get<Limits>(stages_.back());
    }

    const ChainCamera& camera_;
    std::vector<Stage> stages_;
};

}  // namespace

class Chain::State {
public:
    State(const ChainSettings& settings, const ChainCamera& camera)
        : size(camera.size), stages(StageMaker(camera).make(settings)) {}

    Size size;
    std::vector<Stage> stages;
    FrameGap gap;

    void apply(DepthView in, MutableDepthView out, Duration since_last_frame) {
        const FrameGap::Meaning now = gap.next(since_last_frame);
        Planes& planes = scratch_of_this_thread<Planes>(size);
        DepthPlane& current = planes.current;

        // The first stage reads the frame, a Kalman filter at the end writes it.
        std::size_t begin = 0;
        if (!stages.empty() && std::holds_alternative<Limits>(stages.front()))
            apply_limits(in, std::get<Limits>(stages[begin++]), current);
        else
            copy(in, current.view());
        const bool ends_with_kalman =
            !stages.empty() && std::holds_alternative<Kalman>(stages.back());
        for (std::size_t i = begin; i < stages.size(); ++i) {
            const bool last = i + 1 == stages.size();
            // The two in one go where nothing comes in between.
            const auto* flying = std::get_if<FlyingPixels>(&stages[i]);
            if (flying && i + 2 == stages.size() && ends_with_kalman) {
                Kalman& kalman = std::get<Kalman>(stages.back());
                apply_kalman_to_supported(current, flying->rule, kalman.rule, boost_of(kalman, now),
                                          kalman.state, out);
                break;
            }
            std::visit([&](auto& stage) { run(stage, planes, last, out, now); }, stages[i]);
        }
        if (!ends_with_kalman)
            copy(current.view(), out);
    }

private:
    static void copy(DepthView in, MutableDepthView out) {
        for (int y = 0; y < in.size.height; ++y)
            std::copy_n(in.row(y), in.size.width, out.row(y));
    }

    static void run(Limits& limits, Planes& planes, bool, MutableDepthView, FrameGap::Meaning) {
        apply_limits(planes.current.view(), limits, planes.current);
    }
    static void run(FlyingPixels& stage, Planes& planes, bool, MutableDepthView,
                    FrameGap::Meaning) {
        remove_flying_pixels(planes.current, stage.rule, planes.next);
        std::swap(planes.current, planes.next);
    }
    static void run(Speckles& stage, Planes& planes, bool, MutableDepthView, FrameGap::Meaning) {
        remove_speckles(planes.current, stage.rule,
                        scratch_of_this_thread<SpeckleScratch>(planes.current.size()));
    }
    static void run(Holes& stage, Planes& planes, bool, MutableDepthView, FrameGap::Meaning) {
        fill_holes(planes.current, stage.rule,
                   scratch_of_this_thread<HoleScratch>(planes.current.size()));
    }
    static void run(Kalman& stage, Planes& planes, bool last, MutableDepthView out,
                    FrameGap::Meaning now) {
        apply_kalman(planes.current, stage.rule, boost_of(stage, now), stage.state,
                     last ? out : planes.current.view());
    }
    static int boost_of(Kalman& stage, FrameGap::Meaning now) {
        if (now.forgets)
            stage.state.clear();
        return now.missed * stage.rule.least_gain;
    }
};

Chain::Chain(const ChainSettings& settings, const ChainCamera& camera)
    : state_(std::make_unique<State>(settings, camera)) {}
Chain::~Chain() = default;
Chain::Chain(Chain&&) noexcept = default;
Chain& Chain::operator=(Chain&&) noexcept = default;

Size Chain::size() const {
    return state_->size;
}
bool Chain::off() const {
    return state_->stages.empty();
}

void Chain::apply(DepthView in, MutableDepthView out, Duration since_last_frame) {
    assert(in.size == size() && out.size == size());
    state_->apply(in, out, since_last_frame);
}

}  // namespace theatron::filter
