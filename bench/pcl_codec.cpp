// SPDX-License-Identifier: Apache-2.0
// theatron_bench_pcl IN OUT: PCL's octree codec on the point clouds of IN, for `theatron bench
// compare`. The cloud that came back last is written to OUT; one line of JSON tells bytes and
// processor time of each cloud. A program of its own, so that nothing else loads PCL and VTK.
#include <pcl/compression/octree_pointcloud_compression.h>
#include <pcl/pcl_config.h>
#include <pcl/point_types.h>

#include <cstdio>
#include <ctime>
#include <exception>
#include <sstream>
#include <string>
#include <vector>

#include "point_file.h"

namespace theatron::bench {
namespace {

using Point = pcl::PointXYZRGB;
using Codec = pcl::io::OctreePointCloudCompression<Point>;

// Points of 5 mm in an octree of 1 cm: PCL's own setting for sending at a medium resolution.
constexpr auto profile = pcl::io::MED_RES_ONLINE_COMPRESSION_WITH_COLOR;

double cpu_ms() {
    timespec time{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return double(time.tv_sec) * 1e3 + double(time.tv_nsec) * 1e-6;
}

pcl::PointCloud<Point>::Ptr of(const PointCloud& cloud) {
    pcl::PointCloud<Point>::Ptr result(new pcl::PointCloud<Point>);
    result->reserve(cloud.size());
    for (const ColorPoint& p : cloud) {
        Point point;
        point.x = p.x;
        point.y = p.y;
        point.z = p.z;
        point.r = p.r;
        point.g = p.g;
        point.b = p.b;
        result->push_back(point);
    }
    return result;
}

PointCloud of(const pcl::PointCloud<Point>& cloud) {
    PointCloud result;
    result.reserve(cloud.size());
    for (const Point& p : cloud)
        result.push_back({p.x, p.y, p.z, p.r, p.g, p.b, 0});
    return result;
}

int run(const std::string& in, const std::string& out) {
    const auto clouds = read_clouds(in);
    if (!clouds) {
        std::fprintf(stderr, "theatron_bench_pcl: %s has no point clouds.\n", in.c_str());
        return 1;
    }
    Codec encoder(profile, false), decoder(profile, false);
    PointCloud last;
    std::string rows;
    for (const PointCloud& cloud : *clouds) {
        const pcl::PointCloud<Point>::Ptr given = of(cloud);
        std::stringstream bytes;
        const double begin = cpu_ms();
        encoder.encodePointCloud(given, bytes);
        const double encoded = cpu_ms();
        const std::size_t size = bytes.str().size();
        pcl::PointCloud<Point>::Ptr back(new pcl::PointCloud<Point>);
        const double received = cpu_ms();
        decoder.decodePointCloud(bytes, back);
        const double decoded = cpu_ms();
        last = of(*back);
        char row[160];
        std::snprintf(row, sizeof row,
                      "%s{\"bytes\":%zu,\"encode_ms\":%.3f,\"decode_ms\":%.3f,\"points\":%zu,"
                      "\"points_back\":%zu}",
                      rows.empty() ? "" : ",", size, encoded - begin, decoded - received,
                      cloud.size(), last.size());
        rows += row;
    }
    if (!write_clouds(out, {last})) {
        std::fprintf(stderr, "theatron_bench_pcl: cannot write %s.\n", out.c_str());
        return 1;
    }
    std::printf("{\"version\":\"%s\",\"resolution_m\":%g,\"frames\":[%s]}\n", PCL_VERSION_PRETTY,
                pcl::io::compressionProfiles_[profile].pointResolution, rows.c_str());
    return 0;
}

}  // namespace
}  // namespace theatron::bench

int main(int argc, char** argv) {
    if (argc != 3) {
        std::fprintf(stderr, "usage: theatron_bench_pcl IN OUT (see theatron bench compare)\n");
        return 1;
    }
    try {
        return theatron::bench::run(argv[1], argv[2]);
    } catch (const std::exception& e) {
        std::fprintf(stderr, "theatron_bench_pcl: %s\n", e.what());
        return 1;
    }
}
