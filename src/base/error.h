// SPDX-License-Identifier: Apache-2.0
// The exception for failures during set-up: a camera that cannot be opened, a
// port in use, a wrong flag. Its text is one sentence that names what was wrong
// and what to do, and is shown to the user as it is. Never thrown per frame.
#pragma once

#include <stdexcept>

namespace theatron {

class Error : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

}  // namespace theatron
