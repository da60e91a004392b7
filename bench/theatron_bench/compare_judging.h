// SPDX-License-Identifier: Apache-2.0
// Pictures of a method beside the exact ones.
#pragma once

#include <vector>

#include "compare.h"
#include "compare_causes.h"
#include "compare_scene.h"
#include "render/cloud_set.h"

namespace theatron::bench {

// Equal sizes.
CompareOwnView own_view_of(const ColorImage& exact, const ColorImage& arrived);

// The pictures drawn for the places and the close-up of CompareViews, in their sizes.
struct DrawnViews {
    std::vector<render::Picture> places;
    render::Picture close_up;
};

// Fills pictures, likeness and causes of `method`.
void judge(CompareMethod& method, const CompareViews& exact, DrawnViews drawn,
           const std::vector<CauseCamera>& cameras);

}  // namespace theatron::bench
