// SPDX-License-Identifier: Apache-2.0
// The name under which figures show a participant's camera (session/whose_camera.h).
#pragma once

#include <string>

#include "host/host_figures.h"
#include "session/whose_camera.h"

namespace theatron::host {

inline std::string whose_camera(const HostFigures& figures, const HostFigures::Published& camera) {
    std::string name;
    for (const auto& participant : figures.participants)
        if (participant.id == camera.publisher)
            name = participant.name;
    return session::whose_camera(camera.name, camera.publisher, name);
}

}  // namespace theatron::host
