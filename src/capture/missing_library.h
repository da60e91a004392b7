// SPDX-License-Identifier: Apache-2.0
// The exception for a library of a camera's maker that this machine lacks or cannot load. Trying
// again is useless while the program runs, unlike for a camera that may be plugged in.
#pragma once

#include "base/error.h"

namespace theatron::capture {

class MissingLibrary : public Error {
public:
    using Error::Error;
};

}  // namespace theatron::capture
