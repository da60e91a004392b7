// SPDX-License-Identifier: Apache-2.0
// The folder of a study: study.conf, files of questionnaires beside it, a journal for each
// participant in journals/, and what the report writes in report/.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "study/study_run.h"

namespace theatron::app {

struct Study {
    std::filesystem::path folder;
    study::Protocol protocol;
    study::Questionnaires questionnaires;
    std::uint64_t hash = 0;  // of all its texts

    std::filesystem::path journal_of(const std::string& participant) const;
    // The paths of head and hands; see study_paths.h.
    std::filesystem::path paths_of(const std::string& participant) const;
};

// `place`: the folder, or its protocol file. Throws Error with all mistakes, a line each.
Study load_study(const std::filesystem::path& place);

// The journals of a study, in the order of their names. Throws Error if one of them cannot be gone
// on with. Journals of a study with another text are left out and named in `others`.
std::vector<study::Journal> load_journals(const Study& study, std::vector<std::string>& others);

// Makes a folder with the example.
void make_study(const std::filesystem::path& folder);

}  // namespace theatron::app
