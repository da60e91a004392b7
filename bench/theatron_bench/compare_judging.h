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

// Fills all that is known of the pictures of `method`. details: finest_details() of the close-up.
void judge(CompareMethod& method, const CompareViews& exact, DrawnViews drawn,
           const std::vector<CauseCamera>& cameras, Image<float> details);

// The same of a video call, whose pictures are its cameras'.
void judge_video(CompareMethod& method, const CompareViews& exact, Image<float> details);

// The same of two ways whose pictures stand beside each other; both are judged.
void judge_pair(CompareMethod& method, const CompareViews& exact, const CompareMethod& one,
                const CompareMethod& other);

}  // namespace theatron::bench
