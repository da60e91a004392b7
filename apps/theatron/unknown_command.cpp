// SPDX-License-Identifier: Apache-2.0
#include "unknown_command.h"

#include <algorithm>
#include <cctype>
#include <numeric>

namespace theatron::app {
namespace {

// Letters to insert, delete, replace or swap with their neighbour (optimal string alignment).
std::size_t distance(const std::string& a, const std::string& b) {
    std::vector<std::size_t> before, last(b.size() + 1), row(b.size() + 1);
    std::iota(last.begin(), last.end(), 0);
    for (std::size_t i = 1; i <= a.size(); ++i) {
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (a[i - 1] != b[j - 1])});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                row[j] = std::min(row[j], before[j - 2] + 1);
        }
        before = last;
        last = row;
    }
    return last[b.size()];
}

}  // namespace

std::string unknown_command(const std::string& word, const std::vector<std::string>& commands) {
    if (word.starts_with("-") || commands.empty() ||
        std::find(commands.begin(), commands.end(), word) != commands.end())
        return "";
    constexpr std::size_t similar = 2;
    const auto nearest = std::min_element(
        commands.begin(), commands.end(),
        [&](const auto& a, const auto& b) { return distance(word, a) < distance(word, b); });
    std::string sentence = "There is no command '" + word.substr(0, 40) + "'";
    if (distance(word, *nearest) <= similar)
        return sentence + "; did you mean 'theatron " + *nearest + "'?";
    sentence += "; the commands are ";
    for (const std::string& command : commands)
        sentence += (command == commands.front() ? "" : ", ") + command;
    return sentence + ".";
}

std::string file_taken_for_option(const std::vector<std::string>& arguments) {
    for (const std::string& word : arguments) {
        const bool is_short_option = word.size() > 2 && word[0] == '-' && std::isalpha(word[1]);
        if (is_short_option && word.find('.') != std::string::npos)
            return "'" + word + "' is taken for an option; if it is a file, write './" + word +
                   "'.";
    }
    return "";
}

std::string empty_argument(const std::vector<std::string>& arguments) {
    std::string before;
    for (const std::string& word : arguments) {
        const bool ends_empty = word.size() > 3 && word.starts_with("--") && word.ends_with("=") &&
                                word.find('=') == word.size() - 1;
        if (word.empty() || ends_empty) {
            const std::string option = ends_empty                 ? word.substr(0, word.size() - 1)
                                       : before.starts_with("--") ? before
                                                                  : "";
            return (option.empty() ? "An argument" : "The value of " + option) +
                   " is empty; a variable of the shell may have none. Leave it out, or give it a "
                   "value.";
        }
        before = word;
    }
    return "";
}

}  // namespace theatron::app
