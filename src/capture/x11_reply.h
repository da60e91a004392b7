// SPDX-License-Identifier: Apache-2.0
// Answers of the X server, which XCB allocates.
#pragma once

#include <cstdlib>
#include <memory>

namespace theatron::capture {

struct FreeReply {
    void operator()(void* memory) const { std::free(memory); }
};
template <class T>
using Reply = std::unique_ptr<T, FreeReply>;

}  // namespace theatron::capture
