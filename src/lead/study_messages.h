// SPDX-License-Identifier: Apache-2.0
// Steps and conditions of a study as messages of a session, and replies back. Pure.
#pragma once

#include <string>

#include "study/study_run.h"
#include "wire/control.h"

namespace theatron::lead {

// The run's current step, which was shown `shown_for` ago. Its conditions are no steps of a
// surface: see condition_message().
wire::StudyStep step_message(const study::StudyRun& run, Duration shown_for);
// The last message of a run that has ended; `break_off` is the protocol's text.
wire::StudyStep end_message(const study::StudyRun& run, const std::string& break_off);

// Locked for the participant.
wire::SetCondition condition_message(const study::Condition& condition);
// True if the host sets nothing of it.
bool is_as_usual(const study::Condition& condition);

// The text that StudyRun::reply() takes.
std::string reply_text(const study::Step& step, const wire::StudyReply& reply);

}  // namespace theatron::lead
