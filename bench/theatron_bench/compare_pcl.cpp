// SPDX-License-Identifier: Apache-2.0
#include "compare_pcl.h"

#include <filesystem>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "child_process.h"
#include "temporary_folder.h"

namespace theatron::bench {
namespace {

constexpr const char* pcl_program = "theatron_bench_pcl";

}  // namespace

std::string missing_pcl() {
    if (std::filesystem::exists(neighbour_program(pcl_program)))
        return "";
    return "This build has no PCL, the library of point clouds: unpack Debian's libpcl-dev in a "
           "folder, configure with -DTHEATRON_PCL=FOLDER, and build theatron_bench_pcl; "
           "docs/measuring.md has the commands.";
}

PclFigures pcl_figures(const std::vector<PointCloud>& clouds) {
    const TemporaryFolder folder;
    const std::string in = (folder.path / "in").string(), out = (folder.path / "out").string();
    if (!write_clouds(in, clouds))
        throw Error("Cannot write " + in + ".");
    ChildProcess child({in, out}, "", pcl_program);
    const auto told = nlohmann::json::parse(child.read_line(), nullptr, false);
    if (child.wait().exit_code != 0 || !told.is_object())
        throw Error("theatron_bench_pcl failed; its message is above.");
    PclFigures figures{told["version"], told["resolution_m"], {}, {}};
    for (const auto& cloud : told["frames"])
        figures.clouds.push_back({cloud["bytes"], cloud["encode_ms"], cloud["decode_ms"]});
    auto back = read_clouds(out);
    if (figures.clouds.size() != clouds.size() || !back || back->size() != 1)
        throw Error("theatron_bench_pcl did not give back what it was given.");
    figures.last = std::move(back->front());
    return figures;
}

}  // namespace theatron::bench
