// SPDX-License-Identifier: Apache-2.0
// How panels below each other share the height of a window.
#pragma once

#include <vector>

namespace theatron::window {

// The height of each panel that wants these heights, which are not negative, so that together they
// are no higher than `together`. Where they must be cut, the highest, such as that of many people,
// has half of it or more, and the others share the rest. Empty: a panel would have to be lower than
// `least`.
std::vector<float> panel_heights(const std::vector<float>& wanted, float least, float together);

}  // namespace theatron::window
