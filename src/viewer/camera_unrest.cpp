// SPDX-License-Identifier: Apache-2.0
#include "viewer/camera_unrest.h"

#include <algorithm>

#include "phrases/phrase.h"

namespace theatron::viewer {

bool is_of_unrest(const std::string& remark, const std::string& camera) {
    // Behind the sentence may stand how many remarks were left out.
    return remark.starts_with(say(Phrase::camera_stale, camera, "")) ||
           remark.starts_with(say(Phrase::camera_live_again, camera));
}

bool CameraUnrest::tells(const std::string& remark, const std::vector<std::string>& cameras,
                         TimePoint now) {
    const bool is_unrest =
        std::any_of(cameras.begin(), cameras.end(),
                    [&](const std::string& name) { return is_of_unrest(remark, name); });
    if (!is_unrest)
        return true;
    while (!seen_.empty() && now - seen_.front() > remembered)
        seen_.pop_front();
    constexpr std::size_t most = 1000;
    if (seen_.size() < most)
        seen_.push_back(now);
    return seen_.size() == 1;
}

std::size_t CameraUnrest::count(TimePoint now) const {
    const auto recent = std::count_if(seen_.begin(), seen_.end(),
                                      [&](TimePoint at) { return now - at <= remembered; });
    return recent > 0 ? std::size_t(recent) - 1 : 0;
}

}  // namespace theatron::viewer
