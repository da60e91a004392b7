// SPDX-License-Identifier: Apache-2.0
#include "record/intake.h"

#include <algorithm>

#include "base/error.h"
#include "base/time_between.h"
#include "record/recording_layout.h"

namespace theatron::record {
namespace {

// After this time without a call of news() the recorder itself was delayed, not the streams.
constexpr Duration late_look = std::chrono::milliseconds(500);
// A disk that takes nothing for this time is reported.
constexpr Duration late_disk = std::chrono::milliseconds(1500);
// A picture this old begins no segment: its camera is stale.
constexpr Duration oldest_beginning = std::chrono::seconds(60);

std::string name_of(const Intake::Stream& stream) {
    return "camera " + stream.camera + (is_depth(stream.id) ? ", depth" : ", colour");
}

std::string count(std::uint64_t pictures) {
    return std::to_string(pictures) + (pictures == 1 ? " picture" : " pictures");
}

std::string rounded_megabytes(std::size_t bytes) {
    return std::to_string((bytes + 500'000) / 1'000'000) + " MB";
}

}  // namespace

Intake::~Intake() {
    take_held();
}

bool Intake::are_among(const std::vector<RecordedCamera>& cameras,
                       const std::vector<RecordedCamera>& all) {
    return !cameras.empty() && std::ranges::all_of(cameras, [&](const RecordedCamera& camera) {
        return std::ranges::find(all, camera) != all.end();
    });
}

bool Intake::is_of(const Description& description, const wire::MediaHeader& header) {
    const auto setting = description.settings.find(header.stream);
    return setting != description.settings.end() && setting->second == header.setting;
}

void Intake::describe(std::vector<RecordedCamera> cameras, std::map<StreamId, SettingId> settings,
                      bool new_connection, TimePoint now) {
    const std::lock_guard lock(mutex_);
    if (change_ && new_connection)
        end_change(change_->held.back().now);
    std::vector<std::pair<StreamId, const RecordedCamera*>> streams;
    for (const RecordedCamera& camera : cameras) {
        streams.emplace_back(depth_stream(camera.id), &camera);
        if (camera.color)
            streams.emplace_back(color_stream(camera.id), &camera);
    }
    for (auto& [id, entry] : entries_) {
        const bool was_here = !entry.ended;
        entry.ended = std::none_of(streams.begin(), streams.end(),
                                   [&, id = id](const auto& s) { return s.first == id; });
        // Its pictures between the end of the connection and its own are missing.
        if (new_connection && was_here && entry.ended && entry.gate.figures().recorded > 0)
            ++entry.stream.interruptions;
        entry.has_left |= entry.ended;
    }
    for (std::size_t i = 0; i < streams.size(); ++i) {
        const auto& [id, camera] = streams[i];
        const auto phase =
            StreamGate::key_period * std::int64_t(i + 1) / std::int64_t(streams.size());
        auto [at, is_new] = entries_.try_emplace(id);
        Entry& entry = at->second;
        if (is_new)
            entry.gate = StreamGate(phase);
        // Another camera has the number of one that has left, or that one has come back.
        if (entry.has_left) {
            entry.gate.restart();
            entry.captured.reset();
            entry.heard = now;
        }
        entry.has_left = false;
        entry.stream.id = id;
        entry.stream.camera = camera->name;
        entry.patience =
            std::max(silence_limit, camera->frames_per_second > 0
                                        ? seconds_to_duration(3 / camera->frames_per_second)
                                        : Duration(0));
        if (is_new)
            entry.heard = now;
        else if (new_connection && entry.gate.figures().recorded > 0)
            ++entry.stream.interruptions;
        if (new_connection) {
            entry.gate.close();
            entry.captured.reset();
        }
    }
    if (change_)
        describe_change({cameras, settings, false});
    if (change_)
        return;
    // Setting numbers of an earlier connection are no longer valid.
    if (new_connection)
        current_.settings.clear();
    const bool was_pending = pending_ && pending_->new_connection;
    const bool was_without = pending_ && pending_->cameras.empty();
    if (new_connection)
        kept_.clear();
    if (new_connection || (cameras.empty() && !was_without && kept_.empty()))
        waits_since_ = now;
    pending_ = {std::move(cameras), std::move(settings), new_connection || was_pending};
    if (!pending_->new_connection && are_among(pending_->cameras, current_.cameras)) {
        // The segment goes on, with the tracks of cameras that have left.
        current_.settings = std::move(pending_->settings);
        pending_.reset();
    }
    if (is_described_anew())
        for (auto& [id, entry] : entries_)
            entry.gate.want_key();
}

// Streams of the segment, in the same settings, of cameras that now stand elsewhere.
bool Intake::is_described_anew() const {
    return pending_ && !pending_->new_connection && recorder_ && !pending_->cameras.empty() &&
           std::ranges::includes(current_.settings, pending_->settings);
}

bool Intake::take(const wire::MediaHeader& header, std::shared_ptr<const Bytes> message,
                  const std::string& filters, const Now& now) {
    const std::lock_guard lock(mutex_);
    const auto found = entries_.find(header.stream);
    if (!problem_.empty() || found == entries_.end())
        return false;
    Entry& entry = found->second;
    if (must_wait(header, now.local)) {
        if (!std::exchange(entry.is_left_out, true))
            ++entry.stream.interruptions;
        entry.heard = now.local;
        return false;
    }
    if (!change_ && begins_segment(entry, header, now.local)) {
        const bool is_first = !recorder_ || (pending_ && pending_->new_connection);
        Description next = pending_ ? *std::exchange(pending_, std::nullopt) : present();
        if (!is_first)
            begin_change(std::move(next), now.local);
        else if (!begin(std::move(next), header.captured, now))
            return false;
    }
    bool ask_for_key = false;
    if (change_ && belongs_to_next(entry, header)) {
        note_time(entry, header, now.local);
        change_->held_bytes += message->size();
        change_->held.push_back({header, std::move(message), filters, now});
    } else {
        ask_for_key = put(entry, header, std::move(message), filters, now);
    }
    end_change_in_time(now);
    return ask_for_key;
}

// The newest segment's, without cameras that have left.
Intake::Description Intake::present() const {
    Description description = current_;
    std::erase_if(description.cameras, [&](const RecordedCamera& camera) {
        return !current_.settings.contains(depth_stream(camera.id)) &&
               !current_.settings.contains(color_stream(camera.id));
    });
    return description;
}

// True if this frame is the first of a new segment.
bool Intake::begins_segment(const Entry& entry, const wire::MediaHeader& header,
                            TimePoint now) const {
    if (is_of(current_, header))
        return (wants_segment_ || is_described_anew() || lacks_voice_lanes()) && header.key &&
               can_begin_with(entry) && (!pending_ || is_of(*pending_, header)) &&
               may_begin_segment(now);
    // Frames of an older setting were in flight when it changed; they are not recorded.
    return header.key && pending_ && is_of(*pending_, header);
}

// A new connection has another clock, and what goes into a file that is not at its name may be
// lost: these do not wait.
bool Intake::may_begin_segment(TimePoint now) const {
    return !recorder_ || wants_segment_ || (pending_ && pending_->new_connection) ||
           pace_.may_begin(now);
}

// True if the frame belongs to a segment that must not begin yet: its camera may be another one
// than that of the present segment with the same number.
bool Intake::must_wait(const wire::MediaHeader& header, TimePoint now) const {
    return !change_ && pending_ && !is_of(current_, header) && is_of(*pending_, header) &&
           !may_begin_segment(now);
}

// Takes a message of the segment that has begun.
bool Intake::put(Entry& entry, const wire::MediaHeader& header,
                 std::shared_ptr<const Bytes> message, const std::string& filters, const Now& now) {
    if (!is_of(current_, header)) {
        // Its key frame was lost on the way.
        const std::optional<Description>& next = change_ ? change_->next : pending_;
        if (!next || !is_of(*next, header))
            return false;
        entry.gate.close();
    }
    const StreamGate::Answer answer = entry.gate.on_frame(header, now.local);
    note_time(entry, header, now.local);
    fill_voices(std::min(header.captured, now.clock.session), now.clock.session);
    if (!answer.record)
        return answer.ask_for_key;
    switch (recorder_->add(header, std::move(message), now.clock.session, filters)) {
        case Recorder::Added::taken:
            if (!entry.stream.first)
                entry.stream.first = now.local;
            entry.stream.last = now.local;
            return answer.ask_for_key;
        case Recorder::Added::dropped:
            return entry.gate.on_dropped(now.local);
        case Recorder::Added::ended:
        case Recorder::Added::not_recorded:
            (void)entry.gate.on_dropped(now.local);
            return false;
    }
    return false;
}

// Streams whose frames all are keys can begin anywhere, so they wait for the others.
bool Intake::can_begin_with(const Entry& entry) const {
    return entry.gate.has_references() ||
           std::none_of(entries_.begin(), entries_.end(), [](const auto& other) {
               return !other.second.ended && !other.second.silent &&
                      other.second.gate.has_references();
           });
}

// True if a key part of the room begins the described segment, since no picture does. While a
// segment is open, that is so only where the cameras have gone: others are about to send.
bool Intake::room_begins_segment(TimePoint now) const {
    if (!pending_)
        return false;
    if (pending_->cameras.empty())
        return now - waits_since_ >= camera_patience && may_begin_segment(now);
    return now - waits_since_ >= picture_patience && (!recorder_ || pending_->new_connection);
}

// True if the room and the voices are kept for the described segment. It waits for the pictures of
// cameras, but if there are none at first, people believe that the recording has begun.
bool Intake::keeps() const {
    return pending_ && (!recorder_ || pending_->new_connection) &&
           (pending_->cameras.empty() || !kept_.empty());
}

// A segment of this description begins with what was captured then: a frame or a part of the room.
// Kept parts and voices come before it.
bool Intake::begin(Description description, TimePoint captured, const Now& now,
                   std::optional<TimePoint> voices_begin) {
    // Block times count from this clock: as late as possible, but not after the frame.
    ClockPair clock = now.clock;
    if (!kept_.empty())
        captured = std::min(captured, kept_from_);
    const Duration age = time_between(captured, clock.session);
    if (age > Duration(0) && age < oldest_beginning)
        clock = {captured, clock.utc - age};
    try {
        if (!recorder_) {
            recorder_ = std::make_unique<Recorder>(file_, description.cameras, clock, options_,
                                                   voice_tracks());
        } else {
            recorder_->begin_segment(description.cameras, clock, voice_tracks());
            if (!description.new_connection && !wants_segment_)
                pace_.begin(now.local);
        }
    } catch (const std::exception& e) {
        problem_ = e.what();
        return false;
    }
    // Each segment must be readable alone, so all streams begin with a key frame.
    for (auto& [id, entry] : entries_) {
        entry.gate.close();
        entry.is_left_out = entry.said_left_out = false;
    }
    current_ = std::move(description);
    // Times of pictures may have any value.
    begin_voices(
        std::max(clock.session, std::min(voices_begin.value_or(clock.session), now.clock.session)));
    ++segments_begun_;
    wants_segment_ = false;
    for (const auto& put : std::exchange(kept_, {}))
        put();
    return true;
}

void Intake::begin_segment() {
    const std::lock_guard lock(mutex_);
    if (!recorder_ || !problem_.empty())
        return;
    wants_segment_ = true;
    for (auto& [id, entry] : entries_) {
        entry.gate.want_key();
        ++entry.stream.interruptions;
    }
}

bool Intake::take_room(ByteView part, bool key, TimePoint begins, const Now& now) {
    const std::lock_guard lock(mutex_);
    if (!problem_.empty() || part.size() > wire::max_payload_size)
        return false;
    if (room_begins_segment(now.local)) {
        // The next part is a key part, if this one is none.
        if ((!key && kept_.empty()) || !begin(*std::exchange(pending_, std::nullopt), begins, now))
            return false;
    } else if (keeps()) {
        if (kept_.empty()) {
            if (!key)
                return false;
            kept_from_ = begins;
        }
        kept_.push_back([this, bytes = Bytes(part.begin(), part.end()), key, begins,
                         at = now.clock.session] { put_room(bytes, key, begins, at); });
        return true;
    }
    // Until the segment of a new connection begins, times are of another clock.
    const bool is_between = pending_ && pending_->new_connection;
    return recorder_ && !is_between && put_room(part, key, begins, now.clock.session);
}

bool Intake::put_room(ByteView part, bool key, TimePoint begins, TimePoint now) {
    if (room_segment_ != segments_begun_ && !key)
        return false;
    wire::MediaHeader header;
    header.codec = room_codec;
    header.key = key;
    header.stream = room_stream;
    header.frame = room_parts_;
    header.reference = room_parts_ - (key ? 0 : 1);
    header.payload_size = std::uint32_t(part.size());
    header.moment = header.captured = begins;
    auto message = std::make_shared<Bytes>(wire::media_header_size);
    wire::write_media_header(header, message->data());
    message->insert(message->end(), part.begin(), part.end());
    ++room_parts_;
    const bool is_taken = recorder_->add(header, std::move(message), now) == Recorder::Added::taken;
    room_segment_ = is_taken ? segments_begun_ : 0;
    return is_taken;
}

// Late pictures are not missing: their times of exposure are compared.
void Intake::note_time(Entry& entry, const wire::MediaHeader& header, TimePoint now) {
    if (entry.captured && time_between(*entry.captured, header.captured) > entry.patience)
        ++entry.stream.interruptions;
    entry.captured = header.captured;
    entry.heard = now;
}

void Intake::on_end(CameraId camera) {
    const std::lock_guard lock(mutex_);
    for (const StreamId id : {depth_stream(camera), color_stream(camera)})
        if (const auto found = entries_.find(id); found != entries_.end())
            found->second.ended = true;
}

void Intake::on_interruption(CameraId camera) {
    const std::lock_guard lock(mutex_);
    for (const StreamId id : {depth_stream(camera), color_stream(camera)}) {
        const auto found = entries_.find(id);
        if (found == entries_.end() || std::exchange(found->second.ended, true))
            continue;
        if (found->second.gate.figures().recorded > 0)
            ++found->second.stream.interruptions;
    }
}

std::vector<std::string> Intake::news(TimePoint now) {
    const std::lock_guard lock(mutex_);
    // Also while no connection gives the session's time.
    if (change_)
        end_change_in_time({now, change_->held.back().now.clock});
    std::vector<std::string> sentences;
    const bool held_up = looked_ != TimePoint{} && now - looked_ > late_look;
    looked_ = now;
    const bool say = now - said_ >= news_interval;
    for (auto& [id, entry] : entries_) {
        if (held_up)
            entry.heard = now;
        if (entry.is_left_out && !std::exchange(entry.said_left_out, true))
            sentences.push_back("Pictures of " + name_of(entry.stream) +
                                " are left out for up to " +
                                std::to_string(SegmentPace::longest_wait / 1s) +
                                " s: cameras come and go so often that the recording would get "
                                "too many files.");
        const bool silent = !entry.ended && now - entry.heard > entry.patience;
        if (silent && !entry.silent)
            sentences.push_back(
                "No picture of " + name_of(entry.stream) + ", for " +
                std::to_string((now - entry.heard).count() / 100'000 / 10.0).substr(0, 3) + " s.");
        else if (entry.silent && !silent && !entry.ended)
            sentences.push_back("Pictures of " + name_of(entry.stream) + ", come again.");
        entry.silent = silent;

        const StreamGate::Figures& figures = entry.gate.figures();
        if (const std::uint64_t missing = figures.lost + figures.dropped;
            say && missing > entry.said) {
            sentences.push_back("Missing: " + count(missing - entry.said) + " of " +
                                name_of(entry.stream) +
                                (figures.dropped > 0 ? ", since the disk was too slow." : "."));
            entry.said = missing;
            said_ = now;
        }
    }
    // Pictures that waited for the recorder meanwhile came all at once.
    if (held_up)
        disk_judged_from_ = now + late_disk;
    if (recorder_ && recorder_->figures().is_in_last_file && !std::exchange(said_last_file_, true))
        sentences.push_back(
            "The recording has as many files as it can have and goes on in the "
            "last one, without cameras that are not in it; begin another one.");
    if (recorder_ && now >= disk_judged_from_) {
        const Recorder::Figures figures = recorder_->figures();
        const bool late = figures.late > late_disk;
        if (late && !disk_is_late_)
            sentences.push_back(
                "The disk does not keep up: " + rounded_megabytes(figures.waiting_bytes) +
                " wait to be written, and what exceeds " +
                rounded_megabytes(options_.buffer_bytes) + " will be lost.");
        else if (!late && disk_is_late_ && figures.problem.empty())
            sentences.push_back("The disk keeps up again.");
        disk_is_late_ = late;
    }
    return sentences;
}

std::vector<Intake::Stream> Intake::streams(TimePoint now) const {
    const std::lock_guard lock(mutex_);
    std::vector<Stream> result;
    for (const auto& [id, entry] : entries_) {
        Stream stream = entry.stream;
        stream.figures = entry.gate.figures();
        if (!entry.ended && stream.figures.recorded > 0 && now - entry.heard > entry.patience)
            ++stream.interruptions;
        result.push_back(std::move(stream));
    }
    return result;
}

std::optional<TimePoint> Intake::newest_captured() const {
    const std::lock_guard lock(mutex_);
    std::optional<TimePoint> newest;
    for (const auto& [id, entry] : entries_)
        if (!entry.ended && entry.captured)
            newest = std::max(newest.value_or(*entry.captured), *entry.captured);
    return newest;
}

Recorder* Intake::recorder() const {
    const std::lock_guard lock(mutex_);
    return recorder_.get();
}

std::string Intake::problem() const {
    const std::lock_guard lock(mutex_);
    return problem_.empty() && recorder_ ? recorder_->figures().problem : problem_;
}

}  // namespace theatron::record
