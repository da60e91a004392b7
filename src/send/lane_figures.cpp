// SPDX-License-Identifier: Apache-2.0
#include "send/lane_figures.h"

namespace theatron::send {

const char* text_of(Stage stage) {
    switch (stage) {
        case Stage::capture:
            return "capture";
        case Stage::queue:
            return "queue";
        case Stage::filter:
            return "filter";
        case Stage::depth_encode:
            return "depth_encode";
        case Stage::color_encode:
            return "color_encode";
        case Stage::lane:
            return "lane";
    }
    return "unknown";
}

const char* text_of(DropReason reason) {
    switch (reason) {
        case DropReason::newer:
            return "newer";
        case DropReason::moment:
            return "moment";
        case DropReason::repeated:
            return "repeated";
        case DropReason::time_jump:
            return "time_jump";
    }
    return "unknown";
}

LaneMeter::LaneMeter()
    : recent_(stage_count, SampleWindow(kept_samples)), histograms_(stage_count) {}

void LaneMeter::on_frame(TimePoint now, TimePoint captured, TimePoint delivered,
                         Duration sync_offset) {
    on_stage(Stage::capture, delivered - captured);
    const std::lock_guard lock(mutex_);
    ++counts_.frames;
    rate_.add(now);
    newest_captured_ = captured;
    counts_.sync_offset_seconds = to_seconds(sync_offset);
}

void LaneMeter::on_drop(DropReason reason) {
    const std::lock_guard lock(mutex_);
    ++counts_.dropped[std::size_t(reason)];
}

void LaneMeter::on_damaged_color() {
    const std::lock_guard lock(mutex_);
    ++counts_.damaged_colors;
}

void LaneMeter::on_stage(Stage stage, Duration took) {
    const std::lock_guard lock(mutex_);
    recent_[std::size_t(stage)].add(to_ms(took));
    histograms_[std::size_t(stage)].add(to_seconds(took));
}

void LaneMeter::on_bytes(bool depth, std::size_t bytes) {
    const std::lock_guard lock(mutex_);
    counts_.bytes += bytes;
    (depth ? counts_.depth_bytes : counts_.color_bytes) += bytes;
}

void LaneMeter::on_filter(const std::string& spelling) {
    const std::lock_guard lock(mutex_);
    counts_.filter = spelling;
}

void LaneMeter::on_filter_device(const std::string& device) {
    const std::lock_guard lock(mutex_);
    counts_.filter_device = device;
}

std::string LaneMeter::filter() const {
    const std::lock_guard lock(mutex_);
    return counts_.filter;
}

std::string LaneMeter::filter_device() const {
    const std::lock_guard lock(mutex_);
    return counts_.filter_device;
}

std::uint64_t LaneMeter::dropped(DropReason reason) const {
    const std::lock_guard lock(mutex_);
    return counts_.dropped[std::size_t(reason)];
}

LaneFigures LaneMeter::figures(TimePoint now) const {
    const std::lock_guard lock(mutex_);
    LaneFigures f = counts_;
    f.frames_per_second = rate_.per_second(now);
    f.dropped_newest = f.dropped[std::size_t(DropReason::newer)];
    f.age_seconds = newest_captured_ == TimePoint{} ? 0 : to_seconds(now - newest_captured_);
    for (int i = 0; i < stage_count; ++i) {
        const auto stage = std::size_t(i);
        if (histograms_[stage].count() > 0)
            f.stages.push_back({text_of(Stage(i)), recent_[stage].percentile(0.5),
                                recent_[stage].percentile(0.99), histograms_[stage]});
    }
    return f;
}

}  // namespace theatron::send
