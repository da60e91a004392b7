// SPDX-License-Identifier: Apache-2.0
// Point clouds in a file, between theatron_bench and theatron_bench_pcl. Both are of one build and
// one machine: numbers are in its byte order.
//
// The number of clouds (32 bits), then each: the number of its points (32 bits) and the points.
#pragma once

#include <cstdint>
#include <fstream>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace theatron::bench {

struct ColorPoint {
    float x = 0, y = 0, z = 0;  // metres
    std::uint8_t r = 0, g = 0, b = 0, unused = 0;
    bool operator==(const ColorPoint&) const = default;
};
static_assert(sizeof(ColorPoint) == 16);
using PointCloud = std::vector<ColorPoint>;

inline constexpr std::uint32_t max_clouds = 100'000, max_cloud_points = 1u << 24;

// False if the file cannot be written.
inline bool write_clouds(const std::string& file, const std::vector<PointCloud>& clouds) {
    std::ofstream out(file, std::ios::binary);
    const auto number = [&](std::size_t value) {
        const auto bits = std::uint32_t(value);
        out.write(reinterpret_cast<const char*>(&bits), sizeof bits);
    };
    number(clouds.size());
    for (const PointCloud& cloud : clouds) {
        number(cloud.size());
        out.write(reinterpret_cast<const char*>(cloud.data()),
                  std::streamsize(cloud.size() * sizeof(ColorPoint)));
    }
    return bool(out.flush());
}

// Nothing if the file is not there, is cut off or has more than it says.
inline std::optional<std::vector<PointCloud>> read_clouds(const std::string& file) {
    std::ifstream in(file, std::ios::binary | std::ios::ate);
    const std::streamoff end = in.tellg();
    in.seekg(0);
    const auto number = [&]() -> std::uint32_t {
        std::uint32_t bits = 0;
        return in.read(reinterpret_cast<char*>(&bits), sizeof bits)
                   ? bits
                   : std::numeric_limits<std::uint32_t>::max();
    };
    const std::uint32_t count = number();
    if (count > max_clouds)
        return std::nullopt;
    std::vector<PointCloud> clouds;
    for (std::uint32_t i = 0; i < count; ++i) {
        const std::uint32_t points = number();
        if (points > max_cloud_points ||
            std::streamoff(points * sizeof(ColorPoint)) > end - in.tellg())
            return std::nullopt;
        in.read(reinterpret_cast<char*>(clouds.emplace_back(points).data()),
                std::streamsize(points * sizeof(ColorPoint)));
    }
    if (!in || in.tellg() != end)
        return std::nullopt;
    return clouds;
}

}  // namespace theatron::bench
