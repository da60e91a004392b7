// SPDX-License-Identifier: Apache-2.0
// The exception for a specification that is wrong by itself: an unknown kind, an unknown option, a
// value that none can have. Trying again is useless, unlike after other errors: a device may be
// plugged in, a file may be copied.
#pragma once

#include "base/error.h"

namespace theatron {

class WrongOptions : public Error {
public:
    using Error::Error;
};

}  // namespace theatron
