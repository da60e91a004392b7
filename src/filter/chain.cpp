// SPDX-License-Identifier: Apache-2.0
#include "filter/chain.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include "filter/stage_rules.h"

namespace theatron::filter {
namespace {

// The gains of the Kalman filter are those of 30 frames a second.
constexpr Duration nominal_period = std::chrono::microseconds(33'333);
constexpr Duration longest_memory = std::chrono::seconds(1);

// One filter with all that it remembers and needs while it runs.
struct FlyingPixels {
    FlyingPixelRule rule;
};
struct Speckles {
    SpeckleRule rule;
    SpeckleScratch scratch;
};
struct Holes {
    HoleRule rule;
    HoleScratch scratch;
};
struct Kalman {
    KalmanRule rule;
    KalmanState state;
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
    void add(const SpeckleParams& params) {
        stages_.push_back(Speckles{rule_of(params, camera_), SpeckleScratch(camera_.size)});
    }
    void add(const HoleParams& params) {
        stages_.push_back(Holes{rule_of(params, camera_), HoleScratch(camera_.size)});
    }
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
        : stages(StageMaker(camera).make(settings)), current(camera.size), next(camera.size) {}

    std::vector<Stage> stages;
    DepthPlane current, next;
    bool first = true;

    void apply(DepthView in, MutableDepthView out, Duration since_last_frame) {
        const bool forgets =
            first || since_last_frame < Duration(0) || since_last_frame > longest_memory;
        const auto missed =
            forgets ? 0 : (since_last_frame + nominal_period / 2) / nominal_period - 1;
        first = false;

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
            std::visit([&](auto& stage) { run(stage, last, out, forgets, int(missed)); },
                       stages[i]);
        }
        if (!ends_with_kalman)
            copy(current.view(), out);
    }

private:
    static void copy(DepthView in, MutableDepthView out) {
        for (int y = 0; y < in.size.height; ++y)
            std::copy_n(in.row(y), in.size.width, out.row(y));
    }

    void run(Limits& limits, bool, MutableDepthView, bool, int) {
        apply_limits(current.view(), limits, current);
    }
    void run(FlyingPixels& stage, bool, MutableDepthView, bool, int) {
        remove_flying_pixels(current, stage.rule, next);
        std::swap(current, next);
    }
    void run(Speckles& stage, bool, MutableDepthView, bool, int) {
        remove_speckles(current, stage.rule, stage.scratch);
    }
    void run(Holes& stage, bool, MutableDepthView, bool, int) {
        fill_holes(current, stage.rule, stage.scratch);
    }
    void run(Kalman& stage, bool last, MutableDepthView out, bool forgets, int missed) {
        if (forgets)
            stage.state.clear();
        const int boost = std::clamp(missed, 0, 255) * stage.rule.least_gain;
        apply_kalman(current, stage.rule, boost, stage.state, last ? out : current.view());
    }
};

Chain::Chain(const ChainSettings& settings, const ChainCamera& camera)
    : state_(std::make_unique<State>(settings, camera)) {}
Chain::~Chain() = default;
Chain::Chain(Chain&&) noexcept = default;
Chain& Chain::operator=(Chain&&) noexcept = default;

Size Chain::size() const {
    return state_->current.size();
}
bool Chain::off() const {
    return state_->stages.empty();
}

void Chain::apply(DepthView in, MutableDepthView out, Duration since_last_frame) {
    assert(in.size == size() && out.size == size());
    state_->apply(in, out, since_last_frame);
}

}  // namespace theatron::filter
