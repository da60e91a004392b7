// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

namespace theatron::wire {

// In place of a codec: the participant gets nothing of this stream, and nothing is encoded for it.
inline constexpr std::string_view no_codec = "none";

}  // namespace theatron::wire
