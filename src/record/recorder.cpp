// SPDX-License-Identifier: Apache-2.0
#include "record/recorder.h"

#include <pthread.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>

#include "base/error.h"
#include "base/time_between.h"
#include "record/recording_layout.h"
#include "record/segment_chain.h"
#include "record/segment_files.h"

namespace theatron::record {
namespace {

namespace fs = std::filesystem;

constexpr auto write_period = std::chrono::milliseconds(100);
constexpr auto sync_period = std::chrono::seconds(1);
// Writing begins before its time when this many bytes wait, and no more are written at once.
constexpr std::size_t many_bytes = std::size_t(16) << 20;
// Estimated memory of a waiting message beside its bytes.
constexpr std::size_t message_overhead = 256;

std::size_t cost_of(const std::shared_ptr<const Bytes>& message) {
    return message_overhead + (message ? message->size() : 0);
}

constexpr const char* part_of = "is a part of the recording to be replaced";

// The files of the later segments of the recording in `path`, which is to be replaced with them;
// none if there is no recording. Throws Error if they must not be.
std::vector<fs::path> later_segments_of(const fs::path& path) {
    std::error_code ignored;
    const auto first = fs::is_regular_file(path, ignored) ? read_segment_info(path) : std::nullopt;
    std::vector<fs::path> files;
    if (!first)
        return files;
    const std::string name = "'" + path.string() + "'";
    if (fs::is_symlink(path, ignored))
        throw Error(name + " is a link to a recording; name the file itself, or another one.");
    if (first->number > 1)
        throw Error(name + " is segment " + std::to_string(first->number) +
                    " of a recording, which would end there; name its first file or another one.");
    for (const fs::path& file : files_of_later_segments(path)) {
        if (access(file.c_str(), R_OK) != 0)
            throw Error("'" + file.string() + "' may not be read, so it is not known whether it " +
                        part_of + "; name another file.");
        const auto info = read_segment_info(file);
        if (!info || info->recording != first->recording || info->number <= first->number)
            continue;
        if (is_in_use(file))
            throw Error("'" + file.string() + "', which " + part_of +
                        ", is being recorded or played; name another file, or end that first.");
        files.push_back(file);
    }
    const fs::path folder = path.has_parent_path() ? path.parent_path() : ".";
    if (!files.empty() && access(folder.c_str(), W_OK | X_OK) != 0)
        throw Error("'" + files[0].string() + "', which " + part_of +
                    ", may not be removed; name another file.");
    return files;
}

std::vector<StreamId> streams_of(const SegmentWriter::Content& content) {
    std::vector<StreamId> streams;
    for (const VoiceTrack& voice : content.voices)
        streams.push_back(stream_of_track(voice.number));
    for (const RecordedCamera& camera : content.cameras) {
        streams.push_back(depth_stream(camera.id));
        if (camera.color)
            streams.push_back(color_stream(camera.id));
    }
    return streams;
}

// The system kills a process whose file reaches the size limit, unless the writing thread blocks
// the signal: then the call fails with EFBIG.
void block_file_size_signal() {
    sigset_t set;
    sigemptyset(&set);
    sigaddset(&set, SIGXFSZ);
    pthread_sigmask(SIG_BLOCK, &set, nullptr);
}

}  // namespace

Recorder::Recorder(const std::filesystem::path& path, const std::vector<RecordedCamera>& cameras,
                   const ClockPair& clock, const Options& options,
                   const std::vector<VoiceTrack>& voices)
    : path_(path), buffer_bytes_(options.buffer_bytes), has_room_(options.has_room) {
    if (const std::string problem = name_problem(path_); !problem.empty())
        throw Error(problem);
    info_.recording = make_uid();
    info_.clock = clock;
    const auto replaced = options.replace ? later_segments_of(path_) : std::vector<fs::path>{};
    const SegmentWriter::Content content{cameras, voices, has_room_};
    writer_ = std::make_unique<SegmentWriter>(path_, content, info_, options.replace);
    content_ = content;
    // Later segments of the replaced recording must not remain beside the new one.
    for (const fs::path& later : replaced) {
        std::error_code problem;
        if (!fs::remove(later, problem) && problem)
            throw Error("Cannot remove '" + later.string() + "', which " + part_of + ": " +
                        problem.message() + ".");
    }
    streams_ = streams_of(content);
    last_now_ = clock.session;
    figures_.bytes = writer_->bytes();
    files_.push_back(path_);
    thread_ = std::thread([this] { run(); });
}

Recorder::~Recorder() {
    finish();
}

// The session's clock may restart; this time only grows. The mutex must be locked.
Duration Recorder::own_time(TimePoint now) {
    const Duration step = time_between(last_now_, now);
    // Messages that were held back for a segment come late (Intake::describe()).
    constexpr Duration latest = std::chrono::seconds(10);
    if (step > Duration(0) || step < -latest)
        last_now_ = now;
    // No more than an hour at once: a host may send any time.
    return own_now_ += std::clamp(step, Duration(0), Duration(std::chrono::hours(1)));
}

void Recorder::begin_segment(const std::vector<RecordedCamera>& cameras, const ClockPair& clock,
                             const std::vector<VoiceTrack>& voices) {
    auto shared = std::make_shared<const SegmentWriter::Content>(
        SegmentWriter::Content{cameras, voices, has_room_});
    const std::lock_guard lock(mutex_);
    streams_ = streams_of(*shared);
    last_now_ = std::max(last_now_, clock.session);
    // A segment without any message is none.
    if (!waiting_.empty() && waiting_.back().segment)
        waiting_.pop_back();
    waiting_.push_back({{}, own_now_, std::move(shared), clock});
}

Recorder::Added Recorder::add(const wire::MediaHeader& header, std::shared_ptr<const Bytes> message,
                              TimePoint now, const std::string& filters) {
    bool many = false;
    {
        const std::lock_guard lock(mutex_);
        if (finishing_ || !figures_.problem.empty())
            return Added::ended;
        const bool is_room = header.stream == room_stream;
        const bool is_picture = !is_room && !is_voice(header.stream);
        if (is_room ? !has_room_
                    : std::find(streams_.begin(), streams_.end(), header.stream) == streams_.end())
            return Added::not_recorded;
        const Duration came = own_time(now);
        const std::size_t cost = cost_of(message);
        if (waiting_bytes_ + cost > buffer_bytes_) {
            if (is_picture) {
                ++figures_.dropped;
                ++figures_.dropped_of[header.stream];
            }
            return Added::dropped;
        }
        waiting_bytes_ += cost;
        unseen_bytes_ += cost;
        many = unseen_bytes_ > many_bytes;
        waiting_.push_back({{header, std::move(message), filters, now}, came, nullptr, {}});
    }
    if (many)
        changed_.notify_one();
    return Added::taken;
}

Recorder::Figures Recorder::figures() const {
    const std::lock_guard lock(mutex_);
    Figures figures = figures_;
    figures.waiting_bytes = waiting_bytes_;
    if (oldest_)
        figures.late = own_now_ - *oldest_;
    else if (!waiting_.empty())
        figures.late = own_now_ - waiting_.front().came;
    return figures;
}

std::vector<std::filesystem::path> Recorder::files() const {
    const std::lock_guard lock(mutex_);
    return files_;
}

void Recorder::finish() {
    {
        const std::lock_guard lock(mutex_);
        finishing_ = true;
    }
    changed_.notify_one();
    if (thread_.joinable())
        thread_.join();
}

void Recorder::note_lacks(const Lacks& lacks) {
    if (!lacks.empty())
        writer_->note_lacks(letters_of(lacks));
}

void Recorder::run() {
    block_file_size_signal();
    std::deque<Waiting> batch;
    std::string problem;
    auto synced = std::chrono::steady_clock::now();
    for (bool more = true; more && problem.empty();) {
        more = take(batch);
        try {
            problem = write(batch);
            const auto now = std::chrono::steady_clock::now();
            if (problem.empty() && now - synced >= sync_period) {
                problem = writer_->sync();
                synced = std::chrono::steady_clock::now();
            }
        } catch (const std::exception& unexpected) {
            problem = "The recording ends here, " + writer_->fate() + ": " + unexpected.what();
        }
        batch.clear();
    }
    const std::string at_end = writer_->finish();
    const std::lock_guard lock(mutex_);
    figures_.bytes = bytes_before_ + writer_->bytes();
    figures_.cut_bytes = cut_before_ + writer_->cut_bytes();
    figures_.problem = problem.empty() ? at_end : problem;
    waiting_.clear();
    waiting_bytes_ = unseen_bytes_ = 0;
    oldest_.reset();
}

// Waits until it is time to write, and moves the blocks of one write to `batch`. False if nothing
// will follow.
bool Recorder::take(std::deque<Waiting>& batch) {
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, write_period, [&] { return finishing_ || unseen_bytes_ > many_bytes; });
    for (std::size_t bytes = 0; !waiting_.empty() && bytes < many_bytes;) {
        const std::size_t cost = cost_of(waiting_.front().message.message);
        bytes += cost;
        unseen_bytes_ -= waiting_.front().segment ? 0 : cost;
        batch.push_back(std::move(waiting_.front()));
        waiting_.pop_front();
    }
    oldest_ = batch.empty() ? std::nullopt : std::optional(batch.front().came);
    return !finishing_ || !waiting_.empty();
}

std::string Recorder::write(std::deque<Waiting>& batch) {
    std::vector<RecordedMessage> messages;
    for (Waiting& waiting : batch) {
        if (!waiting.segment) {
            messages.push_back(std::move(waiting.message));
            continue;
        }
        if (std::string problem = write_messages(messages); !problem.empty())
            return problem;
        next_ = std::move(waiting);
    }
    return write_messages(messages);
}

std::string Recorder::write_messages(std::vector<RecordedMessage>& messages) {
    if (messages.empty())
        return "";
    if (next_)
        if (std::string problem = begin_next(); !problem.empty())
            return problem;
    leave_out(messages);
    std::string problem = writer_->write(messages);
    std::size_t bytes = 0, room_bytes = 0, voice_bytes = 0, pictures = 0;
    for (const RecordedMessage& one : messages) {
        bytes += cost_of(one.message);
        if (one.header.stream == room_stream)
            room_bytes += one.message->size();
        else if (is_voice(one.header.stream))
            voice_bytes += one.message->size();
        else
            ++pictures;
    }
    const std::lock_guard lock(mutex_);
    waiting_bytes_ -= bytes;
    oldest_.reset();
    figures_.bytes = bytes_before_ + writer_->bytes();
    figures_.cut_bytes = cut_before_ + writer_->cut_bytes();
    if (problem.empty()) {
        figures_.frames += pictures;
        figures_.room_bytes += room_bytes;
        figures_.voice_bytes += voice_bytes;
        for (const RecordedMessage& one : messages)
            ++figures_.frames_of[one.header.stream];
        figures_.duration = duration_before_ + writer_->duration();
        figures_.segments = info_.number;
    }
    messages.clear();
    return problem;
}

// Existing names are skipped: they may belong to another recording.
std::optional<std::filesystem::path> Recorder::next_path() {
    std::error_code ignored;
    while (file_number_ < max_segments) {
        std::filesystem::path file = segment_path(path_, ++file_number_);
        if (!std::filesystem::exists(file, ignored))
            return file;
    }
    return std::nullopt;
}

// The present file goes on in place of a segment with this content.
void Recorder::go_on_without(const SegmentWriter::Content& content) {
    without_track_ = streams_of(content);
    std::erase_if(without_track_, [&](StreamId stream) {
        if (is_voice(stream))
            return std::ranges::any_of(content_.voices, [&](const VoiceTrack& voice) {
                return stream_of_track(voice.number) == stream;
            });
        return std::ranges::any_of(content.cameras, [&](const RecordedCamera& camera) {
            return camera.id == camera_of(stream) &&
                   std::ranges::find(content_.cameras, camera) != content_.cameras.end();
        });
    });
    const std::lock_guard lock(mutex_);
    figures_.is_in_last_file = true;
}

void Recorder::leave_out(std::vector<RecordedMessage>& messages) {
    if (without_track_.empty())
        return;
    const std::lock_guard lock(mutex_);
    std::erase_if(messages, [&](const RecordedMessage& one) {
        const StreamId stream = one.header.stream;
        if (std::ranges::find(without_track_, stream) == without_track_.end())
            return false;
        waiting_bytes_ -= cost_of(one.message);
        if (!is_voice(stream)) {
            ++figures_.dropped;
            ++figures_.dropped_of[stream];
        }
        return true;
    });
}

// Closes the current segment and makes the file of `next_`.
std::string Recorder::begin_next() {
    const Waiting next = std::move(*next_);
    next_.reset();
    const auto path = next_path();
    if (!path) {
        go_on_without(*next.segment);
        return "";
    }
    const std::filesystem::path& file = *path;
    std::error_code ignored;
    if (std::string problem = writer_->finish(); !problem.empty())
        return problem;
    info_.clock = next.clock;
    ++info_.number;
    // If it was deleted. Above it none is made: a disk that is gone leaves its place without one.
    std::filesystem::create_directory(file.parent_path(), ignored);
    try {
        auto writer = std::make_unique<SegmentWriter>(file, *next.segment, info_);
        duration_before_ += writer_->duration();
        bytes_before_ += writer_->bytes();
        cut_before_ += writer_->cut_bytes();
        writer_->name_next(info_.number);
        writer_ = std::move(writer);
        content_ = *next.segment;
        const std::lock_guard lock(mutex_);
        files_.push_back(file);
    } catch (const Error& problem) {
        return std::string(problem.what()) + " The recording ends here; " + writer_->fate() + ".";
    }
    return "";
}

}  // namespace theatron::record
