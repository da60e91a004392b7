// SPDX-License-Identifier: Apache-2.0
#include "flat_view.h"

#include <algorithm>
#include <utility>

#include "base/error.h"
#include "page_state.h"

namespace theatron::web {
namespace {

constexpr Duration notice_time = std::chrono::seconds(6);

}  // namespace

void FlatView::next_camera() {
    auto next = camera_ ? newest_.upper_bound(*camera_) : newest_.begin();
    if (next == newest_.end())
        next = newest_.begin();
    if (next == newest_.end())
        return;
    changed_ = changed_ || camera_ != next->first;
    camera_ = next->first;
}

bool FlatView::take(TimePoint now) {
    if (const auto status = participant_.status();
        status.phase == client::Participant::Phase::refused && status.joins == 0)
        throw Error(status.problem);
    std::uint64_t generation = 0;
    const auto cameras = participant_.cameras(generation);
    std::erase_if(newest_, [&](const auto& known) {
        return std::none_of(cameras.begin(), cameras.end(), [&](const auto& camera) {
            return camera.description.id == known.first;
        });
    });
    for (const receive::CameraFramePtr& frame : participant_.take_frames()) {
        Picture& picture = newest_[frame->camera];
        if (frame->color == picture.color)
            continue;
        if (frame->color && camera_ == frame->camera)
            changed_ = true;
        picture = {frame->color, frame->times.captured};
    }
    std::erase_if(newest_, [](const auto& known) { return !known.second.color; });
    if (!camera_ || !newest_.contains(*camera_)) {
        camera_.reset();
        next_camera();
    }
    if (!camera_ || !std::exchange(changed_, false))
        return false;

    const Picture& picture = newest_[*camera_];
    shown_captured_ = picture.captured;
    const ColorImage& color = *picture.color;
    const int step = (color.size.width + most_flat_width - 1) / most_flat_width;
    size_ = {color.size.width / step, color.size.height / step};
    pixels_.resize(4 * size_.area());
    std::byte* to = pixels_.data();
    for (int y = 0; y < size_.height; ++y) {
        const Rgb* from = color.view().row(y * step);
        for (int x = 0; x < size_.width; ++x, from += step) {
            *to++ = std::byte(from->r);
            *to++ = std::byte(from->g);
            *to++ = std::byte(from->b);
            *to++ = std::byte(255);
        }
    }
    ++pictures_;
    drawn_.add(now);
    return true;
}

std::string FlatView::camera_name() const {
    std::uint64_t generation = 0;
    for (const auto& camera : participant_.cameras(generation))
        if (camera_ == camera.description.id)
            return camera.description.name;
    return "";
}

void FlatView::note(const std::string& text, TimePoint now) {
    notice_ = text;
    notice_until_ = now + notice_time;
}

viewer::Facts FlatView::facts(TimePoint now) {
    viewer::Facts facts;
    facts.received = client::figures_of(participant_);
    facts.has_picture = camera_.has_value();
    if (facts.has_picture && shown_captured_ && facts.received.status.clock_known)
        facts.age_ms = std::max(to_ms(participant_.session_time(now) - *shown_captured_), 0.0);
    facts.drawn_per_second = drawn_.per_second(now);
    facts.most_drawn_per_second = pictures_per_second;
    facts.way.renderer = "flat";
    if (now < notice_until_)
        facts.notice = notice_;
    return facts;
}

nlohmann::json FlatView::state(const viewer::Facts& facts, const std::string& address) const {
    nlohmann::json state = state_of(facts, participant_, address);
    state["pictures"] = pictures_;
    state["flat_camera"] = camera_name();
    return state;
}

}  // namespace theatron::web
