// SPDX-License-Identifier: Apache-2.0
// Writes pictures of the synthetic operating room for inspection:
//
//     synthetic_pictures DIR [seconds] [room|surgeon] [detail] [ex ey ez tx ty tz fov]...
//
// Writes colour and depth of two cameras, a free viewpoint and further ones (eye, target and
// field of view in degrees), as PNG.
#include <chrono>
#include <cstdio>
#include <string>

#include "base/error.h"
#include "files/png_file.h"
#include "synthetic/operating_room.h"

namespace {

using namespace theatron;
using namespace theatron::synthetic;

// Near is warm, far is cold; bands show steps of 25 cm.
ColorImage depth_picture(const Image<float>& depth, bool hexagon) {
    ColorImage out(depth.size);
    for (int y = 0; y < depth.size.height; ++y)
        for (int x = 0; x < depth.size.width; ++x) {
            const float z = depth.view().row(y)[x];
            if (z <= 0 || (hexagon && !inside_hexagon(depth.size, x, y)))
                continue;
            const float t = std::min(std::max((z - 0.6f) / 3.4f, 0.0f), 1.0f);
            const float band = 0.88f + 0.12f * std::cos(z * 25.13f);
            const auto ramp = [&](float middle) {
                const float d = (t - middle) * 2.6f;
                return std::uint8_t(std::max(0.0f, 1 - d * d) * band * 255);
            };
            out.view().row(y)[x] = {ramp(0.05f), ramp(0.4f), ramp(0.85f)};
        }
    return out;
}

double now() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch())
        .count();
}

}  // namespace

int main(int count, char** arguments) {
    if (count < 2) {
        std::fputs(
            "usage: synthetic_pictures DIR [seconds] [room|surgeon] [detail] [ex ey ez tx ty tz "
            "fov]...\n",
            stderr);
        return 2;
    }
    const std::string folder = arguments[1];
    const double seconds = count > 2 ? std::stod(arguments[2]) : 3;
    const Variant variant =
        count > 3 && std::string(arguments[3]) == "surgeon" ? Variant::surgeon : Variant::room;
    SceneOptions options;
    options.detail = count > 4 ? std::stod(arguments[4]) : 1;
    double start = now();
    const auto lap = [&](const char* what) {
        std::printf("%-28s %6.2f s\n", what, now() - start);
        start = now();
    };
    const OperatingRoom room(options);
    lap("scene");
    const auto moment = room.at(Duration(std::int64_t(seconds * 1e6)));
    lap("moment");
    const std::string prefix =
        folder + "/synthetic_" + (variant == Variant::room ? "or" : "surgeon");
    for (int camera = 0; camera < 2; ++camera) {
        const auto view = room.look_from(synthetic_camera(variant, camera, 2, {1280, 720}));
        lap("still picture");
        const GroundTruth truth = view->render(*moment);
        lap("frame");
        const std::string name = prefix + "_camera" + std::to_string(camera);
        files::write_png(name + ".png", truth.color.view());
        files::write_png(name + "_depth.png", depth_picture(truth.depth_m, true).view());
    }
    start = now();
    RenderOptions color_only;
    color_only.depth = false;
    const GroundTruth free =
        room.render(free_viewpoint({2.5, 1.85, 2.2}, {-0.15, 1.05, -0.1}, {1280, 720}, 62),
                    Duration(std::int64_t(seconds * 1e6)), color_only);
    lap("free view");
    files::write_png(prefix + "_free_view.png", free.color.view());
    // Further views, seven numbers each: eye, target and field of view.
    for (int i = 5; i + 6 < count; i += 7) {
        const auto n = [&](int k) { return std::stod(arguments[i + k]); };
        const GroundTruth truth =
            room.render(free_viewpoint({n(0), n(1), n(2)}, {n(3), n(4), n(5)}, {1280, 720}, n(6)),
                        Duration(std::int64_t(seconds * 1e6)), color_only);
        files::write_png(prefix + "_view" + std::to_string((i - 5) / 7) + ".png",
                         truth.color.view());
    }
}
