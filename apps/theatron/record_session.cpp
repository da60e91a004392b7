// SPDX-License-Identifier: Apache-2.0
#include <cstdio>
#include <map>

#include "base/error.h"
#include "base/steady_clock.h"
#include "participant.h"
#include "record/stream_gate.h"
#include "record_source.h"

namespace theatron::app {
namespace {

constexpr Duration join_patience = std::chrono::seconds(15);

class SessionRecording final : public RecordSource {
public:
    SessionRecording(const net::Link& link, std::string file, const RecordCodecs& codecs)
        : file_(std::move(file)), created_(steady_now()) {
        Participant::Options options;
        options.link = link;
        options.name = "recorder";
        options.depth_codec = codecs.depth;
        options.color_codec = codecs.color;
        options.delivery.target_latency_ms = 0;  // a recording may be late, but not thinned
        options.remark = [](const std::string& text) {
            std::fprintf(stderr, "%s\n", text.c_str());
        };
        options.media = [this](const wire::MediaHeader& header, ByteView message) {
            on_media(header, message);
        };
        participant_ = std::make_unique<Participant>(options);
    }

    void tick() override {
        const Participant::Status status = participant_->status();
        if (status.phase == Participant::Phase::refused)
            throw Error(status.problem);
        if (!recorder_ && steady_now() - created_ > join_patience)
            throw Error(status.problem.empty() ? "The host sent nothing to record."
                                               : status.problem);
        if (status.phase == Participant::Phase::joined) {
            note_filters();
            take_over(status);
        }
    }

    record::Recorder* recorder() override {
        const std::lock_guard lock(mutex_);
        return recorder_.get();
    }

    bool ended(std::string& remark) override {
        remark = end_;
        return !end_.empty();
    }

    std::uint64_t lost() const override { return lost_; }

    void stop() override {
        {
            // Its thread may be in on_media(), which uses the participant.
            const std::lock_guard lock(mutex_);
            stopped_ = true;
        }
        participant_.reset();
    }

private:
    struct Stream {
        SettingId setting{};
        std::string codec;
        record::StreamGate gate;
        std::optional<FrameNumber> newest;
    };

    // The cameras and codecs of a host that was joined, once they are all known.
    void take_over(const Participant::Status& status) {
        std::uint64_t generation = 0;
        const auto cameras = participant_->cameras(generation);
        const auto settings = participant_->settings();
        if ((generation == generation_ && settings == settings_) || cameras.empty() ||
            settings.empty())
            return;

        std::vector<record::RecordedCamera> descriptions;
        std::map<StreamId, Stream> streams;
        for (const Participant::Camera& camera : cameras) {
            const wire::Camera& d = camera.description;
            const auto codec_of = [&](StreamId id) -> std::string {
                for (const wire::StreamSetting& s : settings)
                    if (s.stream == id) {
                        streams.emplace(
                            id,
                            Stream{
                                s.setting, s.codec, record::StreamGate(participant_->now()), {}});
                        return s.codec;
                    }
                return "";
            };
            const Size depth = camera.calibration.depth.size, color = camera.calibration.color.size;
            record::RecordedCamera r;
            r.id = camera_of(d.depth_stream);
            r.name = d.name;
            r.frames_per_second = d.frames_per_second;
            r.calibration = d.calibration;
            r.depth = {codec_of(d.depth_stream), depth.width, depth.height};
            if (d.has_color)
                r.color =
                    record::RecordedStream{codec_of(d.color_stream), color.width, color.height};
            if (r.depth.codec.empty() || (r.color && r.color->codec.empty()))
                return;  // the settings are still on their way
            descriptions.push_back(std::move(r));
        }
        generation_ = generation;
        settings_ = settings;

        const std::lock_guard lock(mutex_);
        if (!recorder_) {
            recorder_ = std::make_unique<record::Recorder>(
                file_, descriptions, record::ClockPair{participant_->now(), utc_now()});
            descriptions_ = std::move(descriptions);
        } else if (!(descriptions_ == descriptions)) {
            end_ =
                "The cameras of the host, or how it sends them, have changed, so the recording "
                "ends here.";
        }
        // Setting numbers and references are the connection's: both begin anew.
        if (joins_ != status.joins) {
            streams_ = std::move(streams);
            joins_ = status.joins;
            return;
        }
        for (auto& [id, stream] : streams_)
            if (const auto found = streams.find(id); found != streams.end())
                stream.setting = found->second.setting;
    }

    // The host says on another way than the pictures' which filters run: to within the
    // pictures that are on their way.
    void note_filters() {
        std::uint64_t generation = 0;
        const auto cameras = participant_->cameras(generation);
        const std::lock_guard lock(mutex_);
        for (const Participant::Camera& camera : cameras)
            filters_[camera.description.depth_stream] = camera.state.filter;
    }

    // Of a frame that went through some.
    std::string filters_of(StreamId stream) {
        const std::string& filters = filters_[stream];
        return filters.empty() ? "unnamed" : filters;
    }

    void on_media(const wire::MediaHeader& header, ByteView message) {
        const std::lock_guard lock(mutex_);
        const auto found = streams_.find(header.stream);
        if (stopped_ || !recorder_ || found == streams_.end() ||
            header.setting != found->second.setting)
            return;
        Stream& stream = found->second;
        const auto answer = stream.gate.on_frame(header, participant_->now());
        if (answer.ask_for_key)
            participant_->request_key(header.stream, header.setting);
        if (!answer.record)
            return;
        // Frames that the host or the way left out.
        if (stream.newest && std::int32_t(header.frame - *stream.newest) > 1)
            lost_ += header.frame - *stream.newest - 1;
        stream.newest = header.frame;
        (void)recorder_->add(header, std::make_shared<Bytes>(message.begin(), message.end()),
                             participant_->now(),
                             header.filtered == TimePoint{} ? "" : filters_of(header.stream));
    }

    const std::string file_;
    const TimePoint created_;
    std::uint64_t generation_ = 0;
    std::vector<wire::StreamSetting> settings_;
    std::vector<record::RecordedCamera> descriptions_;
    std::string end_;
    int joins_ = 0;

    std::mutex mutex_;  // guards the next four
    bool stopped_ = false;
    std::unique_ptr<record::Recorder> recorder_;
    std::map<StreamId, Stream> streams_;
    std::map<StreamId, std::string> filters_;  // that run on each camera's depth
    std::atomic<std::uint64_t> lost_{0};

    // Last: its thread uses all of the above.
    std::unique_ptr<Participant> participant_;
};

}  // namespace

std::unique_ptr<RecordSource> record_session(const net::Link& link, const std::string& file,
                                             const RecordCodecs& codecs) {
    return std::make_unique<SessionRecording>(link, file, codecs);
}

}  // namespace theatron::app
