// SPDX-License-Identifier: Apache-2.0
#include "filter/device_chain.h"

#include <algorithm>
#include <cstdio>

namespace theatron::filter {
namespace {

// The devices are compared by these frames: enough for the quickest of them to be typical.
constexpr int measured_frames = 5;
constexpr Duration usual_gap = std::chrono::milliseconds(33);

// The shortest time of a frame; the first one is not counted. Nullopt where a frame failed.
template <class Apply>
std::optional<Duration> shortest(Apply apply, const std::function<TimePoint()>& now) {
    Duration best = Duration::max();
    for (int i = 0; i <= measured_frames; ++i) {
        const TimePoint begin = now();
        if (!apply())
            return std::nullopt;
        if (i > 0)
            best = std::min(best, now() - begin);
    }
    return best;
}

}  // namespace

const std::string& missing_gpu() {
    static const std::string why = [] {
        ChainSettings settings;
        settings.steps = {RangeParams{}};
        std::string problem;
        return CudaChain::make(settings, {.size = {64, 48}}, problem) ? std::string() : problem;
    }();
    return why;
}

std::string on_processor(const std::string& why) {
    return why + " The filters run on the processor, with the same result.";
}

DeviceChain::DeviceChain(ChainSettings settings, const ChainCamera& camera,
                         std::function<TimePoint()> now, MakeGpuChain make_gpu_chain)
    : settings_(std::move(settings)),
      camera_(camera),
      now_(std::move(now)),
      make_gpu_chain_(std::move(make_gpu_chain)) {
    std::string problem;
    if (settings_.device != Device::processor && !settings_.off())
        gpu_ = make_gpu_chain_(settings_, camera_, problem);
    must_choose_ = gpu_ && settings_.device == Device::quickest;
    if (!gpu_)
        use_processor(problem);
}

void DeviceChain::use_processor(const std::string& why) {
    gpu_.reset();
    processor_.emplace(settings_, camera_);
    if (!why.empty() && why != missing_gpu())
        remark_ = on_processor(why);
}

// Both chains are made anew afterwards, so that none has seen the frame before.
void DeviceChain::choose(DepthView in) {
    must_choose_ = false;
    Chain processor(settings_, camera_);
    const auto on_gpu = shortest([&] { return gpu_->apply(in, usual_gap).has_value(); }, now_);
    const auto on_processor = shortest(
        [&] {
            (void)processor.apply(in, usual_gap);
            return true;
        },
        now_);
    const std::string name = gpu_->device();
    std::string problem;
    gpu_ =
        on_gpu && *on_gpu < *on_processor ? make_gpu_chain_(settings_, camera_, problem) : nullptr;
    if (!gpu_)
        use_processor(problem);
    char text[160];
    if (on_gpu)
        std::snprintf(text, sizeof text,
                      "The filters run on %.60s: %.2f ms a frame there, %.2f ms on %s.",
                      gpu_ ? name.c_str() : "the processor", to_ms(gpu_ ? *on_gpu : *on_processor),
                      to_ms(gpu_ ? *on_processor : *on_gpu), gpu_ ? "the processor" : "the GPU");
    else
        std::snprintf(text, sizeof text, "%.60s failed; the filters run on the processor.",
                      name.c_str());
    remark_ = text;
}

DepthView DeviceChain::apply(DepthView in, Duration since_last_frame) {
    if (must_choose_)
        choose(in);
    if (gpu_) {
        if (const auto out = gpu_->apply(in, since_last_frame))
            return *out;
        const std::string name = gpu_->device();
        use_processor({});
        remark_ = name + " failed; the filters go on on the processor, and adapt anew.";
    }
    return processor_->apply(in, since_last_frame);
}

}  // namespace theatron::filter
