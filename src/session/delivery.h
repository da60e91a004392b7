// SPDX-License-Identifier: Apache-2.0
// What one receiver is sent of what is encoded: the policy that chooses the step
// of its ladders, and the gate that leaves frames out.
#pragma once

#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/ids.h"
#include "session/ladder.h"
#include "session/sending_policy.h"
#include "session/setting_table.h"
#include "session/stream_rates.h"
#include "wire/control.h"

namespace theatron::session {

class Delivery {
public:
    // How to send less to this receiver. The step stays where there is one.
    void set_codecs(const CodecSteps& codecs, bool region_is_drawn);

    // The ladder for these wishes, made when it is asked for the first time. Valid until the next
    // call of a function that is not const.
    const Ladder& ladder(const std::string& depth, const std::string& color);
    // The rung of a ladder on which this receiver is now.
    const LadderStep& step_of(const Ladder& ladder) const;
    // Forgets all ladders, then makes the one for the receiver's usual wish.
    void set_wish(const std::string& depth, const std::string& color);
    // Of the receiver's usual wish.
    const LadderStep& step() { return step_of(ladder(wish_.first, wish_.second)); }

    void set_goal(const wire::ChooseDelivery& goal) { goal_ = goal; }

    // What is encoded of one camera for this receiver now, and its wishes for that camera.
    struct Given {
        const ActiveSetting* depth = nullptr;
        const ActiveSetting* color = nullptr;
        std::string depth_wish, color_wish;
    };
    // Measured of its link; `made_in` is how long capturing and encoding take. True
    // if the step changed.
    bool update(const LinkMeasure& link, std::span<const Given> given, double frames_per_second,
                StreamRates& rates, Duration made_in, TimePoint now);

    wire::Delivery message(Duration delay);

    // Whether a frame of this layer goes to the receiver. Call for every frame, in
    // order: a layer opens only with a frame of layer 0, since its frames refer to
    // one another. `highest` is of the step on which the receiver is for that camera.
    bool lets_through(StreamId stream, int layer, int highest);
    void forget(StreamId stream) { open_.erase(stream); }

    // Sends less by the ladder's steps when frames are late; without a goal for their
    // age they are only dropped.
    bool adapts() const { return goal_.target_latency_ms > 0; }

private:
    void add_needs(std::vector<StepNeed>& needs, const Given& given, const Ladder& ladder,
                   double frames_per_second, StreamRates& rates, TimePoint now) const;
    void keep_layers(Ladder& ladder) const;
    int steps() const;

    CodecSteps codecs_;
    bool region_is_drawn_ = false;
    std::pair<std::string, std::string> wish_;
    std::map<std::pair<std::string, std::string>, Ladder> ladders_;  // by wish
    bool layers_are_needed_ = false;
    SendingPolicy policy_;
    wire::ChooseDelivery goal_;
    std::map<StreamId, int> open_;  // the highest layer that passes
};

// A layer for frames that do not refer to each other, so that all cameras and
// both streams leave out the same moments.
int layer_by_number(FrameNumber frame);

}  // namespace theatron::session
