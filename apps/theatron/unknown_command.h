// SPDX-License-Identifier: Apache-2.0
// A misspelt command.
#pragma once

#include <string>
#include <vector>

namespace theatron::app {

// The error sentence for a word that is none of `commands`, with the most similar command if one
// is similar. Empty if the word is a command or an option.
std::string unknown_command(const std::string& word, const std::vector<std::string>& commands);

}  // namespace theatron::app
