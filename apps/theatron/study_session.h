// SPDX-License-Identifier: Apache-2.0
// theatron study run: one participant's run in a terminal, line by line, or for a script as JSON;
// or in a session, on the participant's own surface (study_link.h).
#pragma once

#include <string>

namespace theatron::app {

struct StudyRunFlags {
    std::string folder, participant, host_input;
    std::string link, person;  // a session, and who takes part there
    bool json = false;
};

// Goes on where an earlier run of this participant ended. Throws Error with one sentence.
void run_study(const StudyRunFlags& flags);

}  // namespace theatron::app
