// SPDX-License-Identifier: Apache-2.0
#include "filter/chain.h"

#include <algorithm>
#include <cassert>
#include <optional>
#include <utility>

#include "filter/frame_gap.h"
#include "filter/stage_rules.h"
#include "image/scratch.h"

namespace theatron::filter {
namespace {

// Each stage is one filter with its state.
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
struct Steady {
    SteadyRule rule;
    SteadyState state;
};
// The input and output of one filter; swapped after each.
struct Planes {
    explicit Planes(Size size) : current(size), next(size) {}
    DepthPlane current, next;
};
using Stage = std::variant<Limits, FlyingPixels, Speckles, Holes, Kalman, Steady>;

// True if the result of the stage is the depth in its state.
bool stores_result(const Stage& stage) {
    return std::holds_alternative<Kalman>(stage) || std::holds_alternative<Steady>(stage);
}

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
    void add(const SteadyParams& params) {
        stages_.push_back(Steady{rule_of(params, camera_), SteadyState(camera_.size)});
    }

    // Consecutive filters that only compare depths share one stage.
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
        : size(camera.size), stages(StageMaker(camera).make(settings)) {
        if (!stages.empty() && !stores_result(stages.back()))
            result.emplace(size);
    }

    Size size;
    std::vector<Stage> stages;
    FrameGap gap;
    std::optional<DepthPlane> result;  // if the last stage does not store its result

    DepthView apply(DepthView in, Duration since_last_frame) {
        if (stages.empty())
            return in;
        const FrameGap::Meaning now = gap.next(since_last_frame);
        Planes& planes = scratch_of_this_thread<Planes>(size);

        // The first stage may read the frame itself; a final stage with a state stores the result.
        std::size_t begin = 0;
        if (auto* limits = std::get_if<Limits>(&stages.front())) {
            apply_limits(in, *limits, planes.current);
            ++begin;
        } else {
            copy_pixels(in, planes.current.view());
        }
        auto* const kalman = std::get_if<Kalman>(&stages.back());
        const std::size_t end = stages.size() - (stores_result(stages.back()) ? 1 : 0);
        for (std::size_t i = begin; i < end; ++i) {
            // Two consecutive stages that run as one pass over the image.
            const auto* flying = std::get_if<FlyingPixels>(&stages[i]);
            if (flying && kalman && i + 1 == end) {
                apply_kalman_to_supported(planes.current, flying->rule, kalman->rule,
                                          boost_of(*kalman, now), kalman->state);
                return std::as_const(kalman->state.depth).view();
            }
            std::visit([&](auto& stage) { run(stage, planes, now); }, stages[i]);
        }
        if (kalman)
            return advanced(*kalman, planes.current, now).view();
        if (auto* const steady = std::get_if<Steady>(&stages.back()))
            return advanced(*steady, planes.current, now).view();
        copy_pixels(planes.current.view(), result->view());
        return std::as_const(*result).view();
    }

private:
    static void run(Limits& limits, Planes& planes, FrameGap::Meaning) {
        apply_limits(planes.current.view(), limits, planes.current);
    }
    static void run(FlyingPixels& stage, Planes& planes, FrameGap::Meaning) {
        remove_flying_pixels(planes.current, stage.rule, planes.next);
        std::swap(planes.current, planes.next);
    }
    static void run(Speckles& stage, Planes& planes, FrameGap::Meaning) {
        remove_speckles(planes.current, stage.rule,
                        scratch_of_this_thread<SpeckleScratch>(planes.current.size()));
    }
    static void run(Holes& stage, Planes& planes, FrameGap::Meaning) {
        fill_holes(planes.current, stage.rule,
                   scratch_of_this_thread<HoleScratch>(planes.current.size()));
    }
    static void run(Kalman& stage, Planes& planes, FrameGap::Meaning now) {
        copy_pixels(advanced(stage, planes.current, now).view(), planes.current.view());
    }
    static void run(Steady& stage, Planes& planes, FrameGap::Meaning now) {
        copy_pixels(advanced(stage, planes.current, now).view(), planes.current.view());
    }
    static const DepthPlane& advanced(Kalman& stage, const DepthPlane& in, FrameGap::Meaning now) {
        apply_kalman(in, stage.rule, boost_of(stage, now), stage.state);
        return stage.state.depth;
    }
    static const DepthPlane& advanced(Steady& stage, const DepthPlane& in, FrameGap::Meaning now) {
        if (now.forgets)
            stage.state.clear();
        apply_steady(in, stage.rule, now.missed, stage.state);
        return stage.state.depth;
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

DepthView Chain::apply(DepthView in, Duration since_last_frame) {
    assert(in.size == size());
    return state_->apply(in, since_last_frame);
}

}  // namespace theatron::filter
