// SPDX-License-Identifier: Apache-2.0
#include "record/recorder.h"

#include <algorithm>

#include "record/recording_layout.h"

namespace theatron::record {
namespace {

constexpr Duration write_period = std::chrono::milliseconds(100);
// A disk may be busy with something else for a second or two.
constexpr std::size_t max_waiting_bytes = std::size_t(256) << 20;
// Writing begins before its time when this much has come.
constexpr std::size_t many_bytes = std::size_t(16) << 20;

MatroskaWriter::Layout layout_of(const std::vector<RecordedCamera>& cameras) {
    MatroskaWriter::Layout layout;
    layout.side_name = side_name;
    layout.note_name = note_name;
    const auto add = [&](const RecordedCamera& camera, StreamId id, const RecordedStream& stream,
                         const char* codec_id) {
        Track track;
        track.number = track_number(id);
        track.name = camera.name;
        track.codec_id = codec_id;
        if (codec_id != std::string(jpeg_codec_id)) {
            const ByteView text = as_bytes(stream.codec);
            track.codec_private.assign(text.begin(), text.end());
        }
        track.width = stream.width;
        track.height = stream.height;
        track.frames_per_second = camera.frames_per_second;
        track.shown = !is_depth(id);
        layout.tracks.push_back(std::move(track));
    };
    // What players can play comes first.
    for (const RecordedCamera& camera : cameras)
        if (camera.color) {
            const bool jpeg = camera.color->codec.starts_with("jpeg");
            add(camera, color_stream(camera.id), *camera.color,
                jpeg ? jpeg_codec_id : color_codec_id);
        }
    for (const RecordedCamera& camera : cameras) {
        add(camera, depth_stream(camera.id), camera.depth, depth_codec_id);
        layout.attachments.push_back(
            {calibration_name(camera.id), calibration_mime_type, camera.calibration});
    }
    return layout;
}

}  // namespace

Recorder::Recorder(const std::filesystem::path& path, const std::vector<RecordedCamera>& cameras)
    : writer_(path, layout_of(cameras)) {
    for (const RecordedCamera& camera : cameras) {
        streams_.push_back(depth_stream(camera.id));
        if (camera.color)
            streams_.push_back(color_stream(camera.id));
    }
    figures_.bytes = writer_.bytes();
    thread_ = std::thread([this] { run(); });
}

Recorder::~Recorder() {
    finish();
}

bool Recorder::add(const wire::MediaHeader& header, std::shared_ptr<const Bytes> message,
                   const std::string& filters) {
    if (std::find(streams_.begin(), streams_.end(), header.stream) == streams_.end())
        return false;
    bool many = false;
    {
        const std::lock_guard lock(mutex_);
        if (finishing_ || !figures_.problem.empty())
            return false;
        if (waiting_bytes_ + message->size() > max_waiting_bytes) {
            ++figures_.dropped;
            return false;
        }
        waiting_bytes_ += message->size();
        many = waiting_bytes_ > many_bytes;
        waiting_.push_back({header, std::move(message), filters});
    }
    if (many)
        changed_.notify_one();
    return true;
}

Recorder::Figures Recorder::figures() const {
    const std::lock_guard lock(mutex_);
    return figures_;
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

void Recorder::run() {
    std::vector<Waiting> batch;
    bool finishing = false, ended = false;
    while (!finishing && !ended) {
        {
            std::unique_lock lock(mutex_);
            changed_.wait_for(lock, write_period,
                              [&] { return finishing_ || waiting_bytes_ > many_bytes; });
            std::swap(batch, waiting_);
            // What is being written still takes memory, but no longer waits.
            waiting_bytes_ = 0;
            finishing = finishing_;
        }
        std::string problem;
        try {
            problem = write(batch);
        } catch (const std::exception& unexpected) {
            problem = std::string("The recording ends here, what came before is kept: ") +
                      unexpected.what() + ".";
        }
        ended = !problem.empty();
        const std::lock_guard lock(mutex_);
        figures_.bytes = writer_.bytes();
        if (ended)
            figures_.problem = std::move(problem);
        else
            figures_.frames += batch.size();
        batch.clear();
    }
    std::string problem = writer_.finish();
    const std::lock_guard lock(mutex_);
    figures_.bytes = writer_.bytes();
    if (figures_.problem.empty())
        figures_.problem = std::move(problem);
    waiting_.clear();
}

std::string Recorder::write(std::vector<Waiting>& batch) {
    if (batch.empty())
        return "";
    if (!begin_) {
        const auto first =
            std::min_element(batch.begin(), batch.end(), [](const Waiting& a, const Waiting& b) {
                return a.header.captured < b.header.captured;
            });
        begin_ = first->header.captured;
    }
    std::vector<Block> blocks;
    TimePoint last = *begin_;
    for (const Waiting& waiting : batch) {
        const wire::MediaHeader& header = waiting.header;
        last = std::max(last, header.captured);
        Block block;
        block.track = track_number(header.stream);
        // The exact time is in the header, also of a frame from before the first ones.
        block.time_us = std::max<std::int64_t>(0, (header.captured - *begin_).count());
        block.key = header.key;
        block.reference_us = block.time_us;
        if (const auto found = recent_us_.find({header.stream, header.reference});
            !header.key && found != recent_us_.end())
            block.reference_us = found->second;
        recent_us_[{header.stream, header.frame}] = block.time_us;
        block.payload = wire::media_payload(*waiting.message);
        block.side = ByteView(*waiting.message).first(wire::media_header_size);
        // Said where it changes.
        std::string& filters = filters_[header.stream];
        if (is_depth(header.stream) && filters != waiting.filters) {
            filters = waiting.filters;
            block.note = filters.empty() ? no_filters : filters;
        }
        blocks.push_back(block);
    }
    // References reach back a few frames only.
    constexpr std::size_t many_recent = 4096;
    if (recent_us_.size() > many_recent)
        std::erase_if(recent_us_, [&](const auto& entry) {
            return entry.second < (last - *begin_).count() - 5'000'000;
        });
    const std::string problem = writer_.write(std::move(blocks));
    if (problem.empty()) {
        const std::lock_guard lock(mutex_);
        figures_.duration = last - *begin_;
    }
    return problem;
}

}  // namespace theatron::record
