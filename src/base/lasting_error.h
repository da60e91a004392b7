// SPDX-License-Identifier: Apache-2.0
// The exception for what stays wrong while the program runs: a specification with an unknown
// option, a value that none can have, a library that this machine lacks. Trying again is useless,
// unlike after other errors: a device may be plugged in, a file may be copied.
#pragma once

#include "base/error.h"

namespace theatron {

class LastingError : public Error {
public:
    using Error::Error;
};

}  // namespace theatron
