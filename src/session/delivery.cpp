// SPDX-License-Identifier: Apache-2.0
#include "session/delivery.h"

#include <algorithm>

namespace theatron::session {
namespace {

// Loss outside the region is worth about so much; nothing is measured before it is tried.
constexpr double lossy_size = 0.6;

std::string milliseconds(Duration d) {
    return std::to_string(d.count() / 1000) + " ms";
}

// To a tenth, which is not written if it is 0.
std::string megabits_per_second(std::uint32_t kbit_per_second) {
    const std::uint32_t tenths = (kbit_per_second + 50) / 100;
    return std::to_string(tenths / 10) +
           (tenths % 10 == 0 ? "" : "." + std::to_string(tenths % 10)) + " Mbit/s";
}

}  // namespace

int layer_by_number(FrameNumber frame) {
    return frame % 4 == 0 ? 0 : frame % 2 == 0 ? 1 : 2;
}

void Delivery::set_wish(const std::string& depth, const std::string& color,
                        const CodecSteps& codecs, bool region_is_drawn) {
    codecs_ = codecs;
    ladder_ = make_ladder(depth, color, codecs, region_is_drawn);
    policy_.limit(int(ladder_.size()));
}

const LadderStep* Delivery::step_with_color(const std::string& codec) const {
    const auto found = std::find_if(ladder_.begin(), ladder_.end(),
                                    [&](const LadderStep& s) { return s.color_codec == codec; });
    return found == ladder_.end() ? nullptr : &*found;
}

bool Delivery::is_lossy(const std::string& depth_codec) const {
    return ladder_.back().lossy_outside_region && ladder_.back().depth_codec == depth_codec;
}

// From what is measured of the encodings that it is given now.
std::vector<StepNeed> Delivery::needs(const Given& given, StreamRates& rates, TimePoint now) const {
    const int all = served_layers - 1;
    const CodecSteps::Layered layered =
        codecs_.layered ? codecs_.layered(given.depth.codec) : CodecSteps::Layered{};
    const bool by_layer =
        layered.independent || (layered.layered && layered.codec == given.depth.codec);
    const double depth = rates.bytes_per_second(given.depth.id, all, now);
    const double exact = is_lossy(given.depth.codec) ? 1 / lossy_size : 1;
    const LadderStep* now_colored = step_with_color(given.color.codec);
    const double whole_color = rates.bytes_per_second(given.color.id, all, now) /
                               (now_colored ? now_colored->color_size : 1);
    const bool chain = codecs_.color_is_chain && codecs_.color_is_chain(given.color.codec);

    std::vector<StepNeed> result;
    for (const LadderStep& step : ladder_) {
        const double depth_share =
            (by_layer ? rates.bytes_per_second(given.depth.id, step.highest_layer, now)
                      : depth * step.frames) *
            exact * (step.lossy_outside_region ? lossy_size : 1);
        const double color_frames = chain ? 1 : step.frames;
        const double color_share = whole_color * step.color_size * color_frames;
        StepNeed need;
        need.bytes_per_second = depth_share + color_share;
        need.bytes_at_once =
            (depth_share / step.frames + color_share / color_frames) / given.frames_per_second;
        result.push_back(need);
    }
    return result;
}

bool Delivery::update(const LinkMeasure& link, const Given& given, StreamRates& rates,
                      Duration made_in, TimePoint now) {
    SendingGoal goal;
    if (goal_.target_latency_ms > 0)
        goal.latency =
            std::max(std::chrono::milliseconds(goal_.target_latency_ms) - made_in, Duration(1));
    goal.max_bytes_per_second = double(goal_.max_kbit_per_s) * 125;
    const std::vector<StepNeed> need = needs(given, rates, now);
    if (!policy_.update(link, need, goal, now))
        return false;
    // Temporal layers stay once they are needed: going back would cost a key frame.
    if (policy_.step() > 0)
        ladder_[0].depth_codec = ladder_[1].depth_codec;
    return true;
}

wire::Delivery Delivery::message(Duration delay) const {
    wire::Delivery message;
    message.level = std::uint8_t(policy_.step());
    message.levels = std::uint8_t(ladder_.size());
    message.what = step().what;
    switch (policy_.reason()) {
        case SendingReason::none:
            break;
        case SendingReason::late:
            message.reason = "frames took " + milliseconds(delay) + " to arrive";
            break;
        case SendingReason::ceiling:
            message.reason = "your ceiling is " + megabits_per_second(goal_.max_kbit_per_s);
            break;
        case SendingReason::room:
            message.reason = "the link has room for more";
            break;
        case SendingReason::trial:
            message.reason = "trying whether the link carries more";
            break;
        case SendingReason::trial_failed:
            message.reason = "the link did not carry more";
            break;
    }
    return message;
}

bool Delivery::lets_through(StreamId stream, int layer) {
    const int highest = step().highest_layer;
    int& open = open_[stream];
    if (layer == 0 || highest < open)
        open = highest;
    return layer <= open;
}

}  // namespace theatron::session
