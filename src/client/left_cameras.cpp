// SPDX-License-Identifier: Apache-2.0
#include "client/left_cameras.h"

#include <algorithm>

namespace theatron::client {

void LeftCameras::update(CameraId camera, bool is_there, TimePoint now) {
    if (is_there)
        heard_.erase(camera);
    else
        heard_.emplace(camera, now);
    if (heard_.size() > max)
        heard_.erase(
            std::min_element(heard_.begin(), heard_.end(),
                             [](const auto& a, const auto& b) { return a.second < b.second; }));
}

void LeftCameras::on_picture(CameraId camera, TimePoint now) {
    if (const auto found = heard_.find(camera); found != heard_.end())
        found->second = now;
}

std::vector<CameraId> LeftCameras::forget_silent(TimePoint now) {
    std::vector<CameraId> silent;
    for (const auto& [camera, heard] : heard_)
        if (now - heard >= patience)
            silent.push_back(camera);
    for (const CameraId camera : silent)
        heard_.erase(camera);
    return silent;
}

std::vector<CameraId> LeftCameras::all() const {
    std::vector<CameraId> cameras;
    for (const auto& [camera, heard] : heard_)
        cameras.push_back(camera);
    return cameras;
}

}  // namespace theatron::client
