// SPDX-License-Identifier: Apache-2.0
// A run whose steps are shown on the participant's own surface, in a session.
#pragma once

#include "files/journal_file.h"
#include "study_session.h"
#include "study_terminal.h"

namespace theatron::app {

// Leads the run to its end, or until the program is asked to stop. Throws Error with one sentence.
void lead_study(const Study& study, const StudyRunFlags& flags, study::StudyRun& run,
                files::JournalFile& journal, const StudyTerminal& terminal);

}  // namespace theatron::app
