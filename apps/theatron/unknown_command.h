// SPDX-License-Identifier: Apache-2.0
// A misspelt command.
#pragma once

#include <string>
#include <vector>

namespace theatron::app {

// The sentence for a word that is none of `commands`, with the most similar one if there is one.
// Empty if the word is a command, or an option.
std::string unknown_command(const std::string& word, const std::vector<std::string>& commands);

}  // namespace theatron::app
