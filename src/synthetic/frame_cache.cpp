// SPDX-License-Identifier: Apache-2.0
#include "synthetic/frame_cache.h"

#include "base/error.h"
#include "synthetic/loop_renderer.h"

namespace theatron::synthetic {

FrameLoop::FrameLoop(const LoopOptions& options, const Progress& progress)
    : calibration_(loop_calibration(options)), path_(loop_path(options)) {
    const std::size_t frames = frames_of(options);
    const std::string key = key_of(options);
    was_cached_ = open(key) && frames == index_.size();
    if (was_cached_)
        return;
    LoopWriter out(path_, key, frames);
    LoopRenderer(
        options, [&](const EncodedFrame& frame) { out.add(frame); }, progress)
        .render();
    out.finish();
    if (!open(key))
        throw Error("The synthetic room's cache '" + path_.string() + "' cannot be read back.");
}

bool FrameLoop::open(const std::string& key) {
    auto index = read_loop_index(path_, key);
    if (!index)
        return false;
    index_ = std::move(*index);
    file_.close();
    file_.open(path_, std::ios::binary);
    return bool(file_);
}

void FrameLoop::read(std::size_t number, Frame& out) {
    if (!read_loop_frame(file_, index_.at(number), calibration_.depth.size, calibration_.color.size,
                         buffer_, out))
        throw Error("The synthetic room's cache '" + path_.string() +
                    "' has been damaged; it will be rendered again at the next start.");
}

}  // namespace theatron::synthetic
