// SPDX-License-Identifier: Apache-2.0
// The folder of a study: study.conf, files of questionnaires beside it, a journal for each
// participant in journals/, the texts that they began with in texts/, and what the report writes in
// report/.
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
    struct Text {
        std::string name, text;
    };
    std::vector<Text> texts;  // the protocol, and the files that it names
    std::uint64_t hash = 0;   // of all texts

    std::filesystem::path journal_of(const std::string& participant) const;
    // The paths of head and hands; see study_paths.h.
    std::filesystem::path paths_of(const std::string& participant) const;
};

// `place`: the folder, or its protocol file. Throws Error with all mistakes, a line each.
Study load_study(const std::filesystem::path& place);

// The journals of a study, in the order of their names. Throws Error if one of them cannot be gone
// on with. Journals of a study with another text are left out and named in `others`.
std::vector<study::Journal> load_journals(const Study& study, std::vector<std::string>& others);

// Throws Error if the journal in this file, which has its first line, is that of another one.
void require_own_journal(const std::filesystem::path& file, const study::Journal& journal,
                         const std::string& participant);

// The participants who began with another text, as far as their journals can be read.
std::vector<std::string> begun_with_another_text(const Study& study);

// Keeps the study's texts in texts/HASH/, where they stay when the protocol is changed. Throws
// Error.
void keep_texts(const Study& study);

// A note of one line on them; empty for none.
std::string another_text_note(const std::vector<std::string>& participants);

// Throws Error if another pseudonym of the same number has a journal, as P1 beside P01: it would
// have the same order of conditions, and is mostly the same person.
void require_other_number(const Study& study, const std::string& participant);

// Makes a folder with the example.
void make_study(const std::filesystem::path& folder);

}  // namespace theatron::app
