// SPDX-License-Identifier: Apache-2.0
#include "synthetic/loop_options.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "synthetic/loop_file.h"

namespace theatron::synthetic {
namespace {

namespace fs = std::filesystem;

std::string file_name(const std::string& key) {
    Checksum sum;
    sum.add(as_bytes(key));
    static constexpr char digits[] = "0123456789abcdef";
    std::string name = "synthetic-";
    for (int shift = 60; shift >= 0; shift -= 4)
        name += digits[(sum.value() >> shift) & 15];
    return name + ".loop";
}

}  // namespace

fs::path default_cache_folder() {
    if (const char* cache = std::getenv("XDG_CACHE_HOME"); cache && *cache)
        return fs::path(cache) / "theatron";
    if (const char* home = std::getenv("HOME"); home && *home)
        return fs::path(home) / ".cache" / "theatron";
    return fs::temp_directory_path() / "theatron-cache";
}

std::size_t frames_of(const LoopOptions& o) {
    const double frames = double(o.scene.loop.count()) * 1e-6 * o.frames_per_second;
    return std::size_t(std::max<std::int64_t>(1, std::llround(frames)));
}

Calibration loop_calibration(const LoopOptions& options) {
    Calibration c =
        synthetic_camera(options.variant, options.camera, options.cameras, options.color);
    if (options.depth_divisor > 1)
        c.depth = scaled(c.depth, {c.depth.size.width / options.depth_divisor,
                                   c.depth.size.height / options.depth_divisor});
    return c;
}

std::string key_of(const LoopOptions& o) {
    std::string key = "scene=" + std::to_string(scene_version);
    const auto add = [&](const char* name, auto value) {
        key += std::string(" ") + name + "=" + std::to_string(value);
    };
    add("variant", int(o.variant));
    add("seed", o.scene.seed);
    add("loop_us", o.scene.loop.count());
    add("detail_permille", std::lround(o.scene.detail * 1000));
    add("camera", o.camera);
    add("cameras", o.cameras);
    add("color_width", o.color.width);
    add("color_height", o.color.height);
    add("depth_divisor", o.depth_divisor);
    add("frames", frames_of(o));
    add("noise", int(o.noise));
    if (!o.scene.people)
        key += " people=0";
    return key;
}

fs::path loop_path(const LoopOptions& options) {
    return (options.folder.empty() ? default_cache_folder() : options.folder) /
           file_name(key_of(options));
}

}  // namespace theatron::synthetic
