// SPDX-License-Identifier: Apache-2.0
// The replies of participants, as tidy tables (comma-separated values, a row a value) for the
// report, for R and for anything else. Pure.
#pragma once

#include <string>
#include <vector>

#include "study/study_run.h"

namespace theatron::study {

struct Tables {
    std::string participants;  // pseudonym, state, order of conditions, steps, minutes
    std::string replies;       // a row a reply to an item of a questionnaire
    std::string scores;        // a row a scale
    std::string tasks;         // a row a question of a task: right, and how long it took
    std::string items;         // a row an item: its text and what its points mean
};

// All journals are of this protocol and can be gone on with; their participants differ.
Tables tables_of(const Protocol& protocol, const Questionnaires& known,
                 const std::vector<Journal>& journals);

}  // namespace theatron::study
