// SPDX-License-Identifier: Apache-2.0
#include "lead/study_messages.h"

#include <algorithm>

namespace theatron::lead {
namespace {

using study::Step;
using wire::StudyKind;

// The host takes each condition that a protocol may have.
static_assert(std::chrono::milliseconds(study::max_added_latency_ms) == wire::max_added_latency);

StudyKind kind_of(Step::Kind kind) {
    switch (kind) {
        case Step::Kind::consent:
            return StudyKind::consent;
        case Step::Kind::read:
        case Step::Kind::condition:
            return StudyKind::read;
        case Step::Kind::watch:
            return StudyKind::watch;
        case Step::Kind::number:
            return StudyKind::number;
        case Step::Kind::yes_no:
            return StudyKind::yes_no;
        case Step::Kind::rating:
            return StudyKind::rating;
        case Step::Kind::choice:
            return StudyKind::choice;
    }
    return StudyKind::read;
}

std::vector<wire::StudyText> texts_of(const std::vector<std::string>& texts) {
    std::vector<wire::StudyText> list;
    for (const std::string& text : texts)
        list.push_back({text});
    return list;
}

// At least a microsecond, since 0 is no limit.
Duration left_of(int seconds, Duration passed) {
    return seconds == 0 ? Duration(0)
                        : std::max(std::chrono::seconds(seconds) - passed, Duration(1));
}

}  // namespace

wire::StudyStep step_message(const study::StudyRun& run, Duration shown_for) {
    const Step& from = run.current();
    wire::StudyStep step;
    step.step = std::uint32_t(run.position() + 1);
    step.steps = std::uint32_t(run.steps().size());
    step.kind = kind_of(from.kind);
    step.texts = texts_of(from.texts);
    step.choices = texts_of(from.choices);
    step.left = from.left;
    step.right = from.right;
    step.lowest = from.lowest;
    step.highest = from.kind == Step::Kind::consent ? 1 : from.highest;
    step.step_size = from.step;
    step.watch = left_of(from.watch_s, shown_for);
    step.limit = left_of(from.limit_s, shown_for);
    return step;
}

wire::StudyStep end_message(const study::StudyRun& run, const std::string& break_off) {
    wire::StudyStep step;
    step.step = std::uint32_t(run.position() + 1);
    step.steps = std::uint32_t(run.steps().size());
    step.kind = StudyKind::over;
    if (run.state() == study::StudyRun::State::broken_off && !break_off.empty())
        step.texts = {{break_off}};
    return step;
}

wire::SetCondition condition_message(const study::Condition& condition) {
    wire::SetCondition message;
    message.renderer = condition.renderer;
    message.depth_codec = condition.depth_codec;
    message.color_codec = condition.color_codec;
    message.latency = std::chrono::milliseconds(condition.latency_ms);
    message.locked = true;
    return message;
}

bool is_as_usual(const study::Condition& condition) {
    return condition.renderer.empty() && condition.depth_codec.empty() &&
           condition.color_codec.empty() && condition.latency_ms == 0;
}

std::string reply_text(const Step& step, const wire::StudyReply& reply) {
    if (reply.action == wire::StudyAction::stop)
        return "stop";
    if (reply.action == wire::StudyAction::skip)
        return "-";
    if (step.kind == Step::Kind::consent || step.kind == Step::Kind::yes_no)
        return reply.value == 1 ? "yes" : reply.value == 0 ? "no" : "neither";
    return step.is_question() ? std::to_string(reply.value) : "done";
}

}  // namespace theatron::lead
