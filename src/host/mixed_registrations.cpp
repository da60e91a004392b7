// SPDX-License-Identifier: Apache-2.0
#include "host/mixed_registrations.h"

#include "geometry/calibration.h"

namespace theatron::host {

std::string mixed_registrations(const std::vector<wire::Camera>& cameras) {
    const wire::Camera* first = nullptr;
    std::uint64_t number = 0;
    for (const wire::Camera& camera : cameras) {
        const auto calibration = decode_calibration(camera.calibration);
        if (!calibration || calibration->registration == 0 || camera.kind != wire::CameraKind::room)
            continue;
        if (!first) {
            first = &camera;
            number = calibration->registration;
        } else if (calibration->registration != number) {
            return "The places of the cameras '" + first->name + "' and '" + camera.name +
                   "' come from different registrations, so they may not fit together; register "
                   "all cameras with 'theatron register LINK --output NEW'.";
        }
    }
    return "";
}

}  // namespace theatron::host
