// SPDX-License-Identifier: Apache-2.0
// Studies with people: steps, replies, and conditions.
#include "session/host_session.h"

namespace theatron::session {

using wire::ManageRefusal;

void HostSession::carry_out(ParticipantId id, const wire::ShowStudy& wish, TimePoint) {
    send(id, wire::Managed{wish.number, studies_.show(id, wish)});
}

void HostSession::carry_out(ParticipantId id, const wire::StudyReply& reply, TimePoint) {
    studies_.reply(id, reply);
}

void HostSession::carry_out(ParticipantId id, const wire::SetCondition& wish, TimePoint) {
    send(id, wire::Managed{wish.number, set_condition(id, wish)});
}

wire::ManageRefusal HostSession::set_condition(ParticipantId by,
                                               const wire::SetCondition& condition) {
    const ParticipantId id = condition.participant;
    if (const ManageRefusal refusal = studies_.judge(by, id); refusal != ManageRefusal::none)
        return refusal;
    CheckedCodec depth, color;
    if (!condition.depth_codec.empty())
        depth = checked(config_.check_depth, condition.depth_codec);
    if (!condition.color_codec.empty())
        color = checked(config_.check_color, condition.color_codec);
    if (!depth.problem.empty() || !color.problem.empty())
        return ManageRefusal::no_such_codec;
    renderers_.set(id, {condition.renderer, condition.locked && !condition.renderer.empty()});
    if (!depth.codec.empty() || !color.codec.empty())
        streams_.choose(id, {depth.codec, color.codec}, {});
    studies_.lock(id, condition.locked && (!depth.codec.empty() || !color.codec.empty()));
    direct_.allow(id, condition.latency == Duration(0));
    actions_.push_back(action::Delay{id, condition.latency});
    return ManageRefusal::none;
}

}  // namespace theatron::session
