// SPDX-License-Identifier: Apache-2.0
// The name of the driver that draws.
#pragma once

#include <string>
#include <string_view>

namespace theatron::render {

// The name of the current context's driver for itself, for example "llvmpipe (LLVM 15.0.6, 256
// bits)". Browsers that hide it give one of their own.
std::string driver_name();

// True for the name of a driver that draws on the processor.
bool is_software(std::string_view driver_name);

}  // namespace theatron::render
