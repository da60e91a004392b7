// SPDX-License-Identifier: Apache-2.0
// This machine's processor, in its maker's words.
#pragma once

#include <string>

namespace theatron::bench {

std::string processor_name();

}  // namespace theatron::bench
