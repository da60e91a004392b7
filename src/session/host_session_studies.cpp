// SPDX-License-Identifier: Apache-2.0
// Studies with people: steps, replies, and conditions.
#include "session/host_session.h"

namespace theatron::session {

using wire::ManageRefusal;

void HostSession::carry_out(ParticipantId id, const wire::ShowStudy& wish, TimePoint now) {
    const ManageRefusal refusal = studies_.show(id, wish, now);
    if (refusal == ManageRefusal::none && wish.step.kind == wire::StudyKind::over)
        end_condition(wish.participant);
    send(id, wire::Managed{wish.number, refusal});
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
    CheckedCodec depth, color;
    if (!condition.depth_codec.empty())
        depth = checked(config_.check_depth, condition.depth_codec);
    if (!condition.color_codec.empty())
        color = checked(config_.check_color, condition.color_codec);
    if (const ManageRefusal refusal = studies_.judge(by, id); refusal != ManageRefusal::none)
        return refusal;
    if (!depth.problem.empty() || !color.problem.empty())
        return ManageRefusal::no_such_codec;
    if ((!condition.renderer.empty() || !depth.codec.empty()) &&
        admission_.find(id)->has(wire::Feature::draws_flat))
        return ManageRefusal::draws_flat;
    const bool has_codecs = !depth.codec.empty() || !color.codec.empty();
    const bool is_usual =
        !has_codecs && condition.renderer.empty() && condition.latency == Duration(0);
    studies_.claim(by, id, !is_usual);
    if (is_usual) {
        end_condition(id);
        return ManageRefusal::none;
    }
    if (condition.renderer.empty())
        renderers_.end_condition(id);
    else
        renderers_.begin_condition(id, {condition.renderer, condition.locked});
    streams_.fix(id, {depth.codec, color.codec});
    studies_.lock(id, condition.locked && has_codecs);
    // Pictures of a relay would not be late.
    relays_.allow(id, condition.latency == Duration(0));
    actions_.push_back(action::Delay{id, condition.latency});
    return ManageRefusal::none;
}

// The choice of the participant, and of the host for it, holds again.
void HostSession::end_condition(ParticipantId id) {
    renderers_.end_condition(id);
    streams_.fix(id, {});
    studies_.lock(id, false);
    relays_.allow(id, true);
    actions_.push_back(action::Delay{id, Duration(0)});
}

// The leader's program has gone, or may not manage any more.
void HostSession::end_leading(ParticipantId leader) {
    for (const ParticipantId freed : studies_.end_leading(leader))
        end_condition(freed);
}

}  // namespace theatron::session
