// SPDX-License-Identifier: Apache-2.0
#include "client/recorded_numbers.h"

#include <algorithm>
#include <set>

#include "wire/control.h"

namespace theatron::client {

std::optional<CameraId> RecordedNumbers::of(CameraId camera) const {
    const auto found = numbers_.find(camera);
    return found == numbers_.end() ? std::nullopt : std::optional(found->second);
}

void RecordedNumbers::set_cameras(const std::vector<CameraId>& cameras) {
    std::erase_if(numbers_, [&](const auto& entry) {
        return std::find(cameras.begin(), cameras.end(), entry.first) == cameras.end();
    });
    std::set<CameraId> used;
    for (const auto& [camera, number] : numbers_)
        used.insert(number);
    for (const CameraId camera : cameras) {
        if (numbers_.contains(camera))
            continue;
        for (std::size_t i = 0; i < wire::max_cameras; ++i) {
            const auto number = CameraId((next_ + i) % wire::max_cameras);
            if (!used.insert(number).second)
                continue;
            numbers_[camera] = number;
            next_ = std::size_t(number) + 1;
            break;
        }
    }
}

}  // namespace theatron::client
