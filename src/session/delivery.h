// SPDX-License-Identifier: Apache-2.0
// Chooses the part of the encoded data that one receiver gets: the policy that chooses
// the step of its ladders, and the gate that leaves frames out.
#pragma once

#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/ids.h"
#include "session/ladder.h"
#include "session/layer_gate.h"
#include "session/sending_policy.h"
#include "session/setting_table.h"
#include "session/stream_rates.h"
#include "wire/control.h"

namespace theatron::session {

class Delivery {
public:
    // Sets the properties of codecs for this receiver's ladders. The step stays if it exists.
    void set_codecs(const CodecSteps& codecs, bool region_is_drawn);

    // The ladder for these wishes, made at the first call. Valid until the next call of a function
    // that is not const.
    const Ladder& ladder(const std::string& depth, const std::string& color);
    // The rung of a ladder on which this receiver is now.
    const LadderStep& step_of(const Ladder& ladder) const;
    // Forgets all ladders, then makes the one for the receiver's usual wish.
    void set_wish(const std::string& depth, const std::string& color);
    // The step on the ladder of the receiver's usual wish.
    const LadderStep& step() { return step_of(ladder(wish_.first, wish_.second)); }

    // A receiver that says it again, be it the same, has more time or a better link now.
    void set_goal(const wire::ChooseDelivery& goal) {
        goal_ = goal;
        policy_.forget_failures();
    }

    // The settings of one camera that this receiver gets now, and its wishes for that camera.
    struct Given {
        const ActiveSetting* depth = nullptr;
        const ActiveSetting* color = nullptr;
        std::string depth_wish, color_wish;
    };
    // Takes a measurement of its link; `made_in` is the time from exposure to the
    // encoded frame. True if the step changed.
    bool update(const LinkMeasure& link, std::span<const Given> given, double frames_per_second,
                StreamRates& rates, Duration made_in, TimePoint now);

    wire::Delivery message(Duration delay);

    // See LayerGate. `highest` is the highest layer of the receiver's step for that camera.
    bool lets_through(StreamId stream, int layer, int highest) {
        return gate_.passes(stream, layer, highest);
    }
    void forget(StreamId stream) { gate_.forget(stream); }

    // True if late frames lead to a lower step of the ladder. Without a goal for their
    // age, late frames are only dropped.
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
    LayerGate gate_;
};

// A layer, 0 to 2, for frames that do not refer to each other. It depends on the frame number
// alone, so that all cameras and both streams leave out the same moments.
int layer_by_number(FrameNumber frame);

}  // namespace theatron::session
