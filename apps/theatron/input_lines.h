// SPDX-License-Identifier: Apache-2.0
// Whole lines from standard input, without waiting for any.
#pragma once

#include <optional>
#include <string>

namespace theatron::app {

class InputLines {
public:
    // The next line that has been typed, if there is one.
    std::optional<std::string> next();

    // A person has closed the terminal's input. Other input may simply end.
    bool closed_by_person() const { return closed_by_person_; }

private:
    std::string typed_;
    bool ended_ = false;
    bool closed_by_person_ = false;
};

}  // namespace theatron::app
