// SPDX-License-Identifier: Apache-2.0
// The options of one session, for 'theatron host' and 'theatron session create', and the words of a
// command line with several sessions.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>
#include <vector>

#include "host/session_options.h"

namespace theatron::app {

struct SessionFlags {
    host::SessionOptions options;  // as far as they need no reading
    std::vector<std::string> regions;
    std::string places, cases, recordings, identifiers_for = "operator", admit = "all";
    double link_hours = 0;
    double look_back_s = to_seconds(session::Past::longest_reach);
};

void add_session_options(CLI::App& command, SessionFlags& flags);

// Throws Error with one sentence about an option.
host::SessionOptions session_options(const SessionFlags& flags);

// Words that give the same flags again, but its name. Names of files are absolute in them, below
// `folder` where they were not: the words are read in other folders.
std::vector<std::string> words_of(const SessionFlags& flags, const std::filesystem::path& folder);

// Reads words of one session: "--session NAME" and its options. Throws Error with one sentence.
SessionFlags parse_session(const std::vector<std::string>& words);

// The words of 'theatron host', parted before each "--session" (or "--name") but the first.
struct PartedWords {
    std::vector<std::string> first;                 // of the host and its first session
    std::vector<std::vector<std::string>> further;  // of one session each
};
// Throws Error if several sessions have an option before the first of these words.
PartedWords part_sessions(const std::vector<std::string>& words);

}  // namespace theatron::app
