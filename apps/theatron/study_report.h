// SPDX-License-Identifier: Apache-2.0
// theatron study report: tables of all participants, and what Python makes of them.
#pragma once

#include <string>

namespace theatron::app {

// Writes FOLDER/report: tables, statistics, figures and report.html. Throws Error with one
// sentence.
void write_study_report(const std::string& folder, bool json);

}  // namespace theatron::app
