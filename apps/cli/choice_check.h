// SPDX-License-Identifier: Apache-2.0
// Options that take one of a few words.
#pragma once

#include <CLI/CLI.hpp>
#include <algorithm>
#include <string>
#include <vector>

namespace theatron::cli {

// For CLI::Option::check(). Help, manual and completion list the words as those of CLI::IsMember,
// whose sentence would be "x not in {a,b}".
inline CLI::Validator one_of(const std::vector<std::string>& words) {
    CLI::Validator check = CLI::IsMember(words);
    check.operation([words](const std::string& text) {
        if (std::find(words.begin(), words.end(), text) != words.end())
            return std::string();
        const bool two = words.size() == 2;
        std::string sentence = "'" + text + (two ? "' is neither " : "' is none of ");
        for (std::size_t i = 0; i < words.size(); ++i)
            sentence += (i == 0                 ? ""
                         : two                  ? " nor "
                         : i + 1 < words.size() ? ", "
                                                : " and ") +
                        words[i];
        return sentence;
    });
    return check;
}

}  // namespace theatron::cli
