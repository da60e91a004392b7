// SPDX-License-Identifier: Apache-2.0
// What one receiver is sent of what is encoded: its ladder, the policy that
// chooses the step, and the gate that leaves frames out.
#pragma once

#include <map>
#include <optional>
#include <string>
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
    // The receiver asked for these codecs. The step stays where there is one.
    void set_wish(const std::string& depth, const std::string& color, const CodecSteps& codecs,
                  bool region_is_drawn);

    void set_goal(const wire::ChooseDelivery& goal) { goal_ = goal; }

    // What is encoded for this receiver now, and how.
    struct Given {
        const ActiveSetting& depth;
        const ActiveSetting& color;
        double frames_per_second = 30;
    };
    // Measured of its link; `made_in` is how long capturing and encoding take. True
    // if the step changed.
    bool update(const LinkMeasure& link, const Given& given, StreamRates& rates, Duration made_in,
                TimePoint now);

    const LadderStep& step() const { return ladder_[std::size_t(policy_.step())]; }
    wire::Delivery message(Duration delay) const;

    // Whether a frame of this layer goes to the receiver. Call for every frame, in
    // order: a layer opens only with a frame of layer 0, since its frames refer to
    // one another.
    bool lets_through(StreamId stream, int layer);

    // Sends less by the ladder's steps when frames are late; without a goal for their
    // age they are only dropped.
    bool adapts() const { return goal_.target_latency_ms > 0; }

private:
    std::vector<StepNeed> needs(const Given& given, StreamRates& rates, TimePoint now) const;
    const LadderStep* step_with_color(const std::string& codec) const;
    bool is_lossy(const std::string& depth_codec) const;

    CodecSteps codecs_;
    std::vector<LadderStep> ladder_{LadderStep{}};
    SendingPolicy policy_;
    wire::ChooseDelivery goal_;
    std::map<StreamId, int> open_;  // the highest layer that passes
};

// A layer for frames that do not refer to each other, so that all cameras and
// both streams leave out the same moments.
int layer_by_number(FrameNumber frame);

}  // namespace theatron::session
