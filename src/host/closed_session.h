// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace theatron::host {

// A further session of a host that is not open now: it is being opened, or could not be and is
// tried again.
struct ClosedSession {
    std::string name;
    std::string problem;              // a sentence: why it could not be opened; empty: it opens now
    std::vector<std::string> tokens;  // of its links that are valid; secret
};

}  // namespace theatron::host
