// SPDX-License-Identifier: Apache-2.0
// Questionnaires that every study has: the structure of published ones (items, points, reversed
// items, scales and their weights), whose texts the researcher supplies, and some of our own
// wording.
#pragma once

#include <string_view>

#include "study/questionnaire.h"

namespace theatron::study {

// In the format of questionnaire.h.
std::string_view built_in_text();

Questionnaires built_in_questionnaires();

}  // namespace theatron::study
