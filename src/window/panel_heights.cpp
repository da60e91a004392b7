// SPDX-License-Identifier: Apache-2.0
#include "window/panel_heights.h"

#include <algorithm>

namespace theatron::window {
namespace {

// The largest height for each such that all of them, cut to it, have this height together.
float largest_share(std::vector<float> heights, float together) {
    std::sort(heights.begin(), heights.end());
    for (std::size_t i = 0; i < heights.size(); ++i) {
        const float share = together / float(heights.size() - i);
        if (heights[i] > share)
            return share;
        together -= heights[i];
    }
    return heights.empty() ? 0 : heights.back();
}

// Each at most `share` high.
std::vector<float> cut(std::vector<float> heights, float share) {
    for (float& height : heights)
        height = std::min(height, share);
    return heights;
}

}  // namespace

std::vector<float> panel_heights(const std::vector<float>& wanted, float least, float together) {
    if (wanted.empty())
        return {};
    const auto highest = std::max_element(wanted.begin(), wanted.end()) - wanted.begin();
    const float share = largest_share(wanted, together);
    std::vector<float> others = wanted;
    others[std::size_t(highest)] = 0;
    const float share_of_others = largest_share(others, together / 2);
    if (share < wanted[std::size_t(highest)] && share_of_others >= least) {
        std::vector<float> heights = cut(others, share_of_others);
        float left = together;
        for (const float height : heights)
            left -= height;
        heights[std::size_t(highest)] = left;
        return heights;
    }
    return share >= std::min(least, wanted[std::size_t(highest)]) ? cut(wanted, share)
                                                                  : std::vector<float>();
}

}  // namespace theatron::window
