// SPDX-License-Identifier: Apache-2.0
#include "bench_sequence.h"

#include <algorithm>

#include "base/error.h"
#include "files/file_bytes.h"
#include "files/png_file.h"
#include "video/color_codec.h"

namespace theatron::bench {
namespace {

std::vector<std::filesystem::path> files_of(const std::filesystem::path& folder, int max_files) {
    std::vector<std::filesystem::path> files;
    std::error_code error;
    for (const auto& entry : std::filesystem::directory_iterator(folder, error))
        if (entry.is_regular_file())
            files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    if (files.size() > std::size_t(max_files))
        files.resize(std::size_t(max_files));
    return files;
}

ColorImage read_color(const std::filesystem::path& path) {
    if (path.extension() == ".png")
        return files::read_color_png(path);
    const auto decoder = video::make_color_decoder(video::ColorCodecId::jpeg);
    const Bytes bytes = files::read_file(path);
    if (decoder->submit(bytes, 0) != Status::ok)
        throw Error("'" + path.string() + "' is no JPEG picture.");
    auto decoded = decoder->poll();
    return std::move(decoded->image);
}

}  // namespace

BenchSequence load_sequence(const std::filesystem::path& folder, bool with_color, int max_frames) {
    BenchSequence sequence;
    sequence.name = std::filesystem::path(folder / "").parent_path().filename().string();
    for (const auto& file : files_of(folder / "depth", max_frames))
        sequence.depth.push_back(files::read_depth_png(file));
    if (sequence.depth.empty())
        throw Error("There are no depth pictures in '" + (folder / "depth").string() +
                    "'; a sequence is a folder with depth/*.png and perhaps color/*.");
    if (with_color)
        for (const auto& file : files_of(folder / "color", max_frames))
            sequence.color.push_back(read_color(file));
    return sequence;
}

}  // namespace theatron::bench
