// SPDX-License-Identifier: Apache-2.0
// A misspelt command.
#pragma once

#include <string>
#include <vector>

namespace theatron::app {

// The error sentence for a word that is none of `commands`, with the most similar command if one
// is similar. Empty if the word is a command or an option.
std::string unknown_command(const std::string& word, const std::vector<std::string>& commands);

// A sentence on the first of `arguments` that looks like a file's name and is taken for an option,
// since it begins with a hyphen; empty if there is none.
std::string file_taken_for_option(const std::vector<std::string>& arguments);

}  // namespace theatron::app
