// SPDX-License-Identifier: Apache-2.0
// The report of a registration: one HTML file with drawings, without references to anything
// outside.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "registration/rig_solver.h"

namespace theatron::registration {

struct RegistrationReport {
    struct Camera {
        std::string name;
        Pose room_from_camera;
        std::optional<Pose> earlier;  // its place before
        bool is_reference = false;    // places are relative to it
        struct Sigma {
            double mm = 0, deg = 0;
        };
        std::optional<Sigma> sigma;  // of the place; empty: not estimated, or the reference
        DepthBias bias, bias_sigma;  // zero deviations: not looked for now, but kept from before
        int views = 0, ninths = 0;
    };
    // A place where two cameras see one surface, in the room.
    struct Surface {
        Vec3 at;
        double apart_mm = 0;
    };
    struct Pair {
        std::size_t a = 0, b = 0;
        int places = 0;       // of the board, that both saw
        double board_mm = 0;  // between the board's corners there, root mean square
        std::vector<Surface> before, after;
    };

    std::string made, method;
    std::string before;  // what "before" means, for people
    std::vector<std::string> remarks;
    std::vector<Camera> cameras;
    std::vector<Pair> pairs;
    std::vector<Vec3> places;  // of the board's middle, in the room
};

// Names and texts may hold anything.
std::string to_html(const RegistrationReport& report);

}  // namespace theatron::registration
