// SPDX-License-Identifier: Apache-2.0
#include "session/past.h"

#include <algorithm>

namespace theatron::session {
namespace {

// Each stream makes its key frames at another phase: they are large, and would come all at once.
std::int64_t key_period(StreamId stream, TimePoint at) {
    constexpr Duration phase = std::chrono::milliseconds(370);
    return (at.time_since_epoch() + phase * std::uint16_t(stream)) / Past::key_every;
}

}  // namespace

bool Past::add(const wire::MediaHeader& header, ByteView message, const std::string& codec,
               TimePoint now) {
    on_time(now);
    if (bounds_.reach <= Duration(0) || message.size() > bounds_.bytes)
        return false;
    if (const auto bound = not_before_.find(camera_of(header.stream));
        bound != not_before_.end() && header.captured < bound->second)
        return false;
    bytes_ += message.size();
    while (bytes_ > bounds_.bytes)
        drop_oldest();
    pictures_.push_back(
        {now, header, codec, std::make_shared<const Bytes>(message.begin(), message.end())});
    if (header.key) {
        newest_key_[header.stream] = now;
        return false;
    }
    const auto key = newest_key_.find(header.stream);
    return key == newest_key_.end() ||
           key_period(header.stream, key->second) != key_period(header.stream, now);
}

void Past::on_time(TimePoint now) {
    while (!pictures_.empty() && now - pictures_.front().at > bounds_.reach + margin)
        drop_oldest();
    std::erase_if(not_before_,
                  [&](const auto& entry) { return now - entry.second > bounds_.reach + margin; });
}

void Past::drop_oldest() {
    if (pictures_.front().message)
        bytes_ -= pictures_.front().message->size();
    pictures_.pop_front();
    ++first_;
}

void Past::forget(CameraId camera, TimePoint now) {
    not_before_[camera] = now;
    for (Picture& picture : pictures_)
        if (picture.message && camera_of(picture.header.stream) == camera) {
            bytes_ -= picture.message->size();
            picture.message.reset();
        }
}

void Past::clear() {
    first_ = end();
    pictures_.clear();
    bytes_ = 0;
    newest_key_.clear();
}

const Past::Picture* Past::find(Position position) const {
    return position < begin() || position >= end() ? nullptr
                                                   : &pictures_[std::size_t(position - first_)];
}

std::optional<Past::Position> Past::start(TimePoint at) const {
    const auto later =
        std::upper_bound(pictures_.begin(), pictures_.end(), at,
                         [](TimePoint time, const Picture& picture) { return time < picture.at; });
    const auto position_of = [&](auto picture) {
        return first_ + Position(picture - pictures_.begin());
    };
    const auto is_key = [](const Picture& picture) {
        return picture.message && picture.header.key;
    };
    // The newest key frame of each stream; of these the oldest, so that all streams begin.
    std::map<StreamId, Position> keys;
    for (auto picture = later; picture != pictures_.begin();) {
        --picture;
        if (picture->at < at - 2 * key_every)
            break;
        if (is_key(*picture))
            keys.try_emplace(picture->header.stream, position_of(picture));
    }
    std::optional<Position> oldest;
    for (const auto& [stream, key] : keys)
        oldest = std::min(oldest.value_or(key), key);
    if (oldest)
        return oldest;
    const auto next = std::find_if(later, pictures_.end(), is_key);
    return next == pictures_.end() ? std::nullopt : std::optional(position_of(next));
}

}  // namespace theatron::session
