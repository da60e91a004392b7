// SPDX-License-Identifier: Apache-2.0
// Words of the command line that no command takes.
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

// A sentence on the first of `arguments` that is empty, or on the first option with an empty value,
// which is what a variable of the shell without a value leaves; empty if there is none. No option
// takes an empty value.
std::string empty_argument(const std::vector<std::string>& arguments);

}  // namespace theatron::app
