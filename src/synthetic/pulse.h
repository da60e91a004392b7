// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

namespace theatron::synthetic {

// Called often, for each row or each thousand triangles, by the thread that makes a room or its
// pictures. The work ends with what it throws. An empty one is not called.
using Pulse = std::function<void()>;

}  // namespace theatron::synthetic
