// SPDX-License-Identifier: Apache-2.0
#include "session/delivery.h"

#include <algorithm>
#include <cmath>

namespace theatron::session {
namespace {

using wire::TextCode;

// Estimated bytes with loss outside the region, relative to lossless, before it is measured.
constexpr double lossy_size = 0.6;

// Rounded to a tenth, which is not written if it is 0.
std::string megabits_per_second(std::uint32_t kbit_per_second) {
    const std::uint32_t tenths = (kbit_per_second + 50) / 100;
    return std::to_string(tenths / 10) +
           (tenths % 10 == 0 ? "" : "." + std::to_string(tenths % 10));
}

}  // namespace

int layer_by_number(FrameNumber frame) {
    return frame % 4 == 0 ? 0 : frame % 2 == 0 ? 1 : 2;
}

void Delivery::set_codecs(const CodecSteps& codecs, bool region_is_drawn) {
    codecs_ = codecs;
    region_is_drawn_ = region_is_drawn;
    set_wish(wish_.first, wish_.second);
}

void Delivery::set_wish(const std::string& depth, const std::string& color) {
    wish_ = {depth, color};
    layers_are_needed_ = policy_.step() > 0;
    ladders_.clear();
    (void)ladder(depth, color);
    policy_.limit(steps());
}

const Ladder& Delivery::ladder(const std::string& depth, const std::string& color) {
    const auto [found, is_new] = ladders_.try_emplace({depth, color});
    if (is_new) {
        found->second = make_ladder(depth, color, codecs_, region_is_drawn_);
        keep_layers(found->second);
    }
    return found->second;
}

// Temporal layers stay once they are needed: going back would cost a key frame.
void Delivery::keep_layers(Ladder& ladder) const {
    if (layers_are_needed_ && ladder.size() > 1)
        ladder[0].depth_codec = ladder[1].depth_codec;
}

int Delivery::steps() const {
    std::size_t most = 1;
    for (const auto& [wish, ladder] : ladders_)
        most = std::max(most, ladder.size());
    return int(most);
}

const LadderStep& Delivery::step_of(const Ladder& ladder) const {
    return ladder[std::min(std::size_t(policy_.step()), ladder.size() - 1)];
}

// Adds the needs of one camera, from measurements of the settings that the receiver gets now.
void Delivery::add_needs(std::vector<StepNeed>& needs, const Given& given, const Ladder& ladder,
                         double frames_per_second, StreamRates& rates, TimePoint now) const {
    const int all = served_layers - 1;
    const bool by_layer = given.depth->traits.independent || given.depth->traits.layered;
    const double depth = rates.bytes_per_second(given.depth->id, all, now);
    const bool is_lossy =
        ladder.back().lossy_outside_region && ladder.back().depth_codec == given.depth->codec;
    const double exact = is_lossy ? 1 / lossy_size : 1;
    double whole_color = 0;
    bool chain = false;
    if (given.color) {
        const auto colored = std::find_if(ladder.begin(), ladder.end(), [&](const LadderStep& s) {
            return s.color_codec == given.color->codec;
        });
        whole_color = rates.bytes_per_second(given.color->id, all, now) /
                      (colored == ladder.end() ? 1 : colored->color_size);
        chain = given.color->traits.chain;
    }
    for (std::size_t i = 0; i < needs.size(); ++i) {
        const LadderStep& step = ladder[std::min(i, ladder.size() - 1)];
        const double depth_share =
            (by_layer ? rates.bytes_per_second(given.depth->id, step.highest_layer, now)
                      : depth * step.frames) *
            exact * (step.lossy_outside_region ? lossy_size : 1);
        const double color_frames = chain ? 1 : step.frames;
        const double color_share = whole_color * step.color_size * color_frames;
        needs[i].bytes_per_second += depth_share + color_share;
        needs[i].bytes_at_once +=
            (depth_share / step.frames + color_share / color_frames) / frames_per_second;
    }
}

bool Delivery::update(const LinkMeasure& link, std::span<const Given> given,
                      double frames_per_second, StreamRates& rates, Duration made_in,
                      TimePoint now) {
    SendingGoal goal;
    if (goal_.target_latency_ms > 0)
        goal.latency =
            std::max(std::chrono::milliseconds(goal_.target_latency_ms) - made_in, Duration(1));
    goal.max_bytes_per_second = double(goal_.max_kbit_per_s) * 125;
    for (const Given& camera : given)
        (void)ladder(camera.depth_wish, camera.color_wish);
    std::vector<StepNeed> needs;
    needs.resize(std::size_t(steps()));
    for (const Given& camera : given)
        add_needs(needs, camera, ladder(camera.depth_wish, camera.color_wish), frames_per_second,
                  rates, now);
    if (!policy_.update(link, needs, goal, now))
        return false;
    if (policy_.step() > 0 && !std::exchange(layers_are_needed_, true))
        for (auto& [wish, ladder] : ladders_)
            keep_layers(ladder);
    return true;
}

wire::Delivery Delivery::message(Duration delay) {
    wire::Delivery message;
    message.level = std::uint8_t(policy_.step());
    message.levels = std::uint8_t(steps());
    const LadderStep& sent = step();
    message.one_frame_of = std::uint8_t(std::lround(1 / sent.frames));
    if (sent.color_codec != wish_.second)
        message.color_codec = sent.color_codec;
    message.lossy_outside_region = sent.lossy_outside_region;
    switch (policy_.reason()) {
        case SendingReason::none:
            break;
        case SendingReason::late:
            message.reason = {TextCode::frames_were_late, {std::to_string(delay.count() / 1000)}};
            break;
        case SendingReason::ceiling:
            message.reason = {TextCode::ceiling, {megabits_per_second(goal_.max_kbit_per_s)}};
            break;
        case SendingReason::room:
            message.reason = {TextCode::link_has_room};
            break;
        case SendingReason::trial:
            message.reason = {TextCode::link_is_tried};
            break;
        case SendingReason::trial_failed:
            message.reason = {TextCode::trial_failed};
            break;
    }
    return message;
}

}  // namespace theatron::session
