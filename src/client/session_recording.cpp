// SPDX-License-Identifier: Apache-2.0
#include "client/session_recording.h"

#include <algorithm>
#include <cstdio>
#include <map>
#include <optional>
#include <set>

#include "base/error.h"
#include "base/line_limit.h"
#include "base/log.h"
#include "base/steady_clock.h"
#include "client/left_cameras.h"
#include "client/participant.h"
#include "client/person_id.h"
#include "client/recorded_numbers.h"
#include "client/settled_places.h"
#include "files/state_folder.h"
#include "session/request_budget.h"
#include "session/room_track.h"
#include "voice/packet.h"

namespace theatron::client {
namespace {

constexpr Duration join_patience = std::chrono::seconds(15);
constexpr Duration said_after = std::chrono::seconds(1), said_again_after = std::chrono::minutes(1);
constexpr Duration room_interval = std::chrono::milliseconds(10),
                   room_part = std::chrono::milliseconds(100);
// The room is known at once after the first pictures.
constexpr Duration room_patience = std::chrono::seconds(1);
// The host answers once a second. A recorder that is told to end must do so in 2 s.
constexpr Duration silent_after = std::chrono::milliseconds(1500);
// Pictures may come before the session's clock is known, on a connection of long delay.
constexpr std::size_t max_early_bytes = std::size_t(64) << 20;

// The host grants each key frame that a recorder asks for in its turn.
static_assert(
    to_seconds(record::StreamGate::key_period) *
        session::RequestBudget::limits[std::size_t(session::RequestBudget::Kind::key)].per_second >=
    1);

std::string seconds_text(Duration duration) {
    char text[32];
    std::snprintf(text, sizeof(text), "%g s", to_seconds(duration));
    return text;
}

record::Recorder::Options with_room(record::Recorder::Options options) {
    options.has_room = true;
    return options;
}

class SessionRecording final : public record::RecordSource {
public:
    SessionRecording(const net::Link& link, const std::string& name, const std::string& file,
                     const record::RecordCodecs& codecs, const record::Recorder::Options& recorder,
                     std::optional<Duration> patience, const std::filesystem::path& person_folder)
        : created_(steady_now()), patience_(patience), intake_(file, with_room(recorder)) {
        Participant::Options options;
        options.link = link;
        options.name = name;
        options.depth_codec = codecs.depth;
        options.color_codec = codecs.color;
        options.delivery.target_latency_ms = 0;  // a recording may be late, but not thinned
        options.records = true;
        options.person = load_or_make_person_id(person_folder);
        options.remark = [](const std::string& text) { log::say(text); };
        options.media = [this](const wire::MediaHeader& header, ByteView message) {
            on_media(header, std::make_shared<Bytes>(message.begin(), message.end()));
        };
        options.described = [this] { on_described(); };
        options.interrupted = [this](const std::vector<CameraId>& cameras) {
            on_interrupted(cameras);
        };
        options.keeps_room = true;
        options.room_changed = [this] { on_room(false); };
        options.voice = [this](ParticipantId speaker, ByteView packet) {
            on_voice(speaker, packet);
        };
        options.pose = [this](ParticipantId person, const wire::PersonPose& pose) {
            on_pose(person, pose);
        };
        // Its thread may be in on_described() at once, and waits there until it can be used.
        const std::lock_guard lock(mutex_);
        participant_ = std::make_unique<Participant>(options);
    }

    ~SessionRecording() override { stop(); }

    void tick() override {
        const Participant::Status status = participant_->status();
        const bool begun = intake_.recorder() != nullptr;
        wait(status);
        if (std::exchange(pongs_, status.pongs) != status.pongs)
            heard_ = steady_now();
        if (status.phase == Participant::Phase::refused && !begun)
            throw Error(status.problem);
        // A person decides, who may need a while; a recorder that was in waits as long as it must.
        if (status.phase == Participant::Phase::waiting ||
            (status.phase == Participant::Phase::lost && status.joins > 0 && !patience_))
            created_ = steady_now();
        if (!begun && steady_now() - created_ > patience_.value_or(join_patience))
            throw Error(status.problem.empty() ? "The host sent nothing to record."
                                               : status.problem);
        if (status.phase == Participant::Phase::refused)
            end_ = End{status.problem, record::Lack::refused};
        if (status.phase == Participant::Phase::ended)
            end_ = End{"", std::nullopt};  // the participant has said it
        if (status.phase == Participant::Phase::joined) {
            note_states();
            if (settles() || let_go())
                on_described();
        }
        on_room(true);
        if (is_connected())
            intake_.pass_time(now());
    }

    record::Intake& intake() override { return intake_; }
    record::Intake::Now now() const override {
        return {steady_now(), {participant_->now(), utc_now()}};
    }
    std::optional<End> ended() override { return end_; }
    bool is_connected() const override {
        return participant_->status().phase == Participant::Phase::joined;
    }
    bool is_silent() const override {
        const std::lock_guard lock(mutex_);
        return steady_now() - std::max(heard_, media_heard_) > silent_after;
    }
    std::uint64_t not_encoded(CameraId) const override { return 0; }
    std::uint64_t lost_in_source(CameraId) const override { return 0; }
    bool was_gone(CameraId) const override { return false; }

    std::vector<std::string> not_agreed() const override {
        const std::lock_guard lock(mutex_);
        return not_agreed_;
    }

    std::vector<std::string> voices_not_agreed() const override {
        const std::lock_guard lock(mutex_);
        return silent_;
    }

    void stop() override {
        {
            // Its thread may be in on_media(), which uses the participant.
            const std::lock_guard lock(mutex_);
            // The room may still be missing.
            if (clock_known_ && !stopped_)
                record_early();
            stopped_ = true;
        }
        participant_.reset();
    }

private:
    // How long the host has not been there; says so, and ends the recording if it was told how long
    // to wait.
    void wait(const Participant::Status& status) {
        const TimePoint now = steady_now();
        const bool there = status.phase != Participant::Phase::connecting &&
                           status.phase != Participant::Phase::lost;
        if (there || gone_since_ == TimePoint{}) {
            gone_since_ = now;
            next_said_ = now + said_after;
        }
        if (there)
            return;
        const bool begun = intake_.recorder() != nullptr;
        const bool was_in = begun || status.joins > 0;
        if (now > next_said_) {
            const std::string until =
                was_in && !patience_ ? "until it is back; Ctrl-C ends the recording"
                                     : "up to " + seconds_text(patience_.value_or(join_patience));
            const auto minutes =
                std::chrono::duration_cast<std::chrono::minutes>(now - gone_since_).count();
            log::say(minutes == 0 ? "Waiting for the host, " + until + "."
                                  : "Waiting for the host, which has been away for " +
                                        std::to_string(minutes) + " min, " + until + ".");
            next_said_ = gone_since_ + (minutes + 1) * said_again_after;
        }
        if (begun && patience_ && now - gone_since_ > *patience_)
            end_ = End{"The host did not come back within " + seconds_text(*patience_) +
                           ", so the recording ends here.",
                       record::Lack::host_gone};
    }

    bool settles() const {
        const std::lock_guard lock(mutex_);
        return clock_known_ && places_.is_settling();
    }

    // A camera of the session as it is recorded.
    struct Described {
        record::RecordedCamera camera;
        std::map<StreamId, SettingId> settings;
    };

    // True if a camera that has left sends no pictures any more.
    bool let_go() {
        const std::lock_guard lock(mutex_);
        const std::vector<CameraId> silent = left_.forget_silent(steady_now());
        for (const CameraId camera : silent)
            described_.erase(camera);
        return !silent.empty();
    }

    struct Early {
        StreamId stream{};         // in the session
        wire::MediaHeader header;  // as it is recorded
        std::shared_ptr<const Bytes> message;
    };

    // The mutex is held. Says once which cameras the host does not send.
    std::vector<Participant::Camera> recordable_cameras() {
        std::uint64_t generation = 0;
        std::vector<Participant::Camera> cameras = participant_->cameras(generation);
        std::erase_if(cameras, [&](const Participant::Camera& camera) {
            const wire::Camera& d = camera.description;
            if (!d.may_record && left_out_.insert({joins_, d.id}).second) {
                if (std::find(not_agreed_.begin(), not_agreed_.end(), d.name) == not_agreed_.end())
                    not_agreed_.push_back(d.name);
                say_left_out(d);
            }
            return !d.may_record;
        });
        return cameras;
    }

    // A participant whose cameras come and go all the time does not hide all else.
    void say_left_out(const wire::Camera& camera) {
        const auto passed_over =
            left_out_lines_.take(std::to_string(std::uint32_t(camera.publisher)), steady_now());
        if (passed_over)
            log::say("Camera " + camera.name +
                     " is left out: its participant has not agreed to be recorded (--may-record)." +
                     (*passed_over > 0
                          ? " (And " + std::to_string(*passed_over) + " others before.)"
                          : ""));
    }

    // On the participant's thread, before the media that it is about.
    void on_described() {
        const std::lock_guard lock(mutex_);
        if (stopped_)
            return;
        const Participant::Status status = participant_->status();
        if (status.joins != joins_) {
            joins_ = status.joins;
            new_connection_ = true;
            agreed_.clear();  // people have other numbers now
            intake_.interrupt_voices();
            intake_.describe_voices({});
            room_.forget();
            places_.clear();
            described_.clear();
            left_.clear();
            room_version_ = 0;
            early_.clear();
            early_bytes_ = 0;
        }
        note_left();
        std::vector<CameraId> recorded;
        for (const Participant::Camera& camera : recordable_cameras())
            recorded.push_back(camera.description.id);
        for (const CameraId camera : left_.all())
            recorded.push_back(camera);
        numbers_.set_cameras(recorded);
        places_.keep_only([this](CameraId camera) { return numbers_.of(camera).has_value(); });
        std::vector<record::RecordedCamera> cameras;
        std::map<StreamId, SettingId> settings;
        if (describe(cameras, settings)) {
            intake_.describe(std::move(cameras), std::move(settings), new_connection_,
                             steady_now());
            new_connection_ = false;
            // Nothing is missing of those that have left.
            for (const CameraId camera : left_.all())
                intake_.on_end(described_.at(camera).camera.id);
        }
        if (status.clock_known && !clock_known_)
            clock_known_at_ = steady_now();
        clock_known_ = status.clock_known;
        has_room_ = status.has_room;
        if (is_ready())
            record_early();
    }

    // The mutex is held; on the participant's thread. The people in the room say whose voices have
    // tracks from the beginning; an old host may have no room.
    bool is_ready() const {
        return clock_known_ &&
               (!has_room_ || room_version_ > 0 || steady_now() - clock_known_at_ > room_patience);
    }
    void record_early() {
        for (Early& early : std::exchange(early_, {}))
            record(early.stream, early.header, std::move(early.message));
        early_bytes_ = 0;
    }

    // The pictures of these cameras are missing until they are back.
    void on_interrupted(const std::vector<CameraId>& cameras) {
        const std::lock_guard lock(mutex_);
        if (stopped_)
            return;
        for (const CameraId camera : cameras)
            if (const auto found = described_.find(camera); found != described_.end())
                intake_.on_interruption(found->second.camera.id);
    }

    void note_left() {
        std::uint64_t generation = 0;
        std::set<CameraId> there;
        for (const Participant::Camera& camera : participant_->cameras(generation))
            there.insert(camera.description.id);
        for (const auto& [camera, known] : described_)
            left_.update(camera, there.contains(camera), steady_now());
        std::erase_if(described_, [&](const auto& entry) {
            return !there.contains(entry.first) && !left_.contains(entry.first);
        });
    }

    // False as long as the settings are still on their way.
    bool describe(std::vector<record::RecordedCamera>& cameras,
                  std::map<StreamId, SettingId>& settings) {
        const auto sent = participant_->settings();
        std::map<CameraId, Described> described;
        for (const CameraId camera : left_.all()) {
            const Described& left = described_.at(camera);
            cameras.push_back(left.camera);
            settings.insert(left.settings.begin(), left.settings.end());
            described[camera] = left;
        }
        for (const Participant::Camera& camera : recordable_cameras()) {
            const wire::Camera& d = camera.description;
            const auto number = numbers_.of(d.id);
            if (!number)
                continue;
            std::map<StreamId, SettingId> own;
            const auto codec_of = [&](StreamId id, StreamId recorded) -> std::string {
                const auto found = std::find_if(sent.begin(), sent.end(),
                                                [&](const auto& s) { return s.stream == id; });
                if (found == sent.end())
                    return "";
                own[recorded] = found->setting;
                return found->codec;
            };
            const Size depth = camera.calibration.depth.size, color = camera.calibration.color.size;
            record::RecordedCamera r;
            r.id = *number;
            r.name = d.name;
            r.frames_per_second = d.frames_per_second;
            r.calibration = places_.settled(d.id, d.calibration, d.adjustment, steady_now());
            if (d.kind == wire::CameraKind::person) {
                Calibration before_person = camera.calibration;
                before_person.person = std::uint32_t(d.publisher);
                r.calibration = encode_calibration(before_person);
            }
            r.depth = {codec_of(d.depth_stream, depth_stream(*number)), depth.width, depth.height};
            if (d.has_color)
                r.color = record::RecordedStream{codec_of(d.color_stream, color_stream(*number)),
                                                 color.width, color.height};
            if (r.depth.codec.empty() || (r.color && r.color->codec.empty()))
                return false;
            settings.insert(own.begin(), own.end());
            described[d.id] = {r, std::move(own)};
            cameras.push_back(std::move(r));
        }
        described_ = std::move(described);
        return true;
    }

    // The host says on another way than the pictures' which filters run: to within the
    // pictures that are on their way.
    void note_states() {
        std::uint64_t generation = 0;
        const auto cameras = participant_->cameras(generation);
        std::vector<CameraId> ended;
        {
            const std::lock_guard lock(mutex_);
            for (const Participant::Camera& camera : cameras) {
                filters_[camera.description.depth_stream] = camera.state.filter;
                const auto number = numbers_.of(camera.description.id);
                if (number && camera.state.condition == wire::CameraCondition::ended)
                    ended.push_back(*number);
            }
        }
        for (const CameraId camera : ended)
            intake_.on_end(camera);
    }

    // Poses of objects come many times a second, and finding the changes takes all objects.
    void on_room(bool from_tick) {
        const std::lock_guard lock(mutex_);
        const TimePoint local = steady_now();
        if (stopped_ || !clock_known_ || (!from_tick && local - room_noted_ < room_interval))
            return;
        const TimePoint now = participant_->now();
        if (const std::uint64_t version = participant_->room_version(); version != room_version_) {
            const Participant::Room room = participant_->room();
            if (room.objects.empty())
                return;  // not known yet
            room_.note_objects(room.objects, now);
            note_people(room.objects);
            room_version_ = room.version;
            room_noted_ = local;
        }
        record_room(local, now);
    }

    // Those in the room who agree that their voices are recorded, and those who do not.
    void note_people(const session::RoomObjects& objects) {
        std::vector<record::RecordedVoice> agreed;
        for (const auto& [id, object] : objects) {
            if (object.kind != session::ObjectKind::person || session::is_recorded(id))
                continue;
            const auto facts = session::decode_person(object.properties);
            if (!facts || facts->records)
                continue;
            const bool may_speak = session::may(facts->role, session::Right::speak);
            if (facts->muted || !may_speak)
                intake_.interrupt_voice(object.creator);
            if (!may_speak)
                continue;
            // A person who comes agrees a moment later.
            if (facts->voice_recorded) {
                std::erase(silent_, facts->name);
                agreed.push_back({object.creator, facts->name});
            } else if (std::find(silent_.begin(), silent_.end(), facts->name) == silent_.end()) {
                silent_.push_back(facts->name);
            }
        }
        if (agreed == agreed_)
            return;
        agreed_ = agreed;
        intake_.describe_voices(std::move(agreed));
    }

    void on_voice(ParticipantId speaker, ByteView bytes) {
        const auto packet = voice::parse_packet(bytes);
        const std::lock_guard lock(mutex_);
        if (stopped_ || !clock_known_ || !packet)
            return;
        intake_.take_voice(speaker,
                           {packet->number, packet->time, packet->frame_ms, packet->pauses,
                            packet->level_db, packet->opus},
                           participant_->now());
    }

    void on_pose(ParticipantId person, const wire::PersonPose& pose) {
        const std::lock_guard lock(mutex_);
        if (!stopped_)
            room_.note_pose(person, pose, participant_->now());
    }

    // As often as pictures go to the disk.
    void record_room(TimePoint local, TimePoint now) {
        if (local - room_recorded_ < room_part)
            return;
        room_recorded_ = local;
        if (const auto part = room_.take(now);
            part &&
            !intake_.take_room(part->bytes, part->key, part->begin, {local, {now, utc_now()}}))
            room_.want_key();
    }

    // The filters of a frame whose header says that it was filtered.
    std::string filters_of(StreamId stream) {
        const std::string& filters = filters_[stream];
        return filters.empty() ? "unnamed" : filters;
    }

    void on_media(wire::MediaHeader header, std::shared_ptr<Bytes> message) {
        const std::lock_guard lock(mutex_);
        media_heard_ = steady_now();
        const auto number = numbers_.of(camera_of(header.stream));
        if (stopped_ || !number)
            return;
        const StreamId stream = header.stream;
        left_.on_picture(camera_of(stream), steady_now());
        header.stream = is_depth(stream) ? depth_stream(*number) : color_stream(*number);
        wire::write_media_header(header, message->data());
        if (is_ready()) {
            record_early();
            return record(stream, header, std::move(message));
        }
        early_bytes_ += message->size();
        // A message that is left out shows as a gap in the frames' numbers.
        if (early_bytes_ <= max_early_bytes)
            early_.push_back({stream, header, std::move(message)});
    }

    // The mutex is held; on the participant's thread.
    void record(StreamId stream, const wire::MediaHeader& header,
                std::shared_ptr<const Bytes> message) {
        const std::string filters = header.filtered == TimePoint{} ? "" : filters_of(stream);
        if (intake_.take(header, std::move(message), filters, now()))
            participant_->request_key(stream, header.setting);
    }

    TimePoint created_;
    const std::optional<Duration> patience_;
    TimePoint gone_since_;
    TimePoint next_said_;
    int pongs_ = 0;
    TimePoint heard_;  // when the newest answer was seen
    record::Intake intake_;
    std::optional<End> end_;

    mutable std::mutex mutex_;                     // guards all below but the participant
    std::set<std::pair<int, CameraId>> left_out_;  // cameras of each connection
    LineLimit left_out_lines_{4};
    std::vector<std::string> not_agreed_;
    std::vector<record::RecordedVoice> agreed_;
    std::vector<std::string> silent_;  // names of people whose voices may not be recorded
    bool stopped_ = false;
    TimePoint media_heard_;
    int joins_ = 0;
    bool new_connection_ = false;
    bool clock_known_ = false, has_room_ = false;
    TimePoint clock_known_at_;
    std::vector<Early> early_;  // came before the clock and the room were known
    std::size_t early_bytes_ = 0;
    RecordedNumbers numbers_;
    std::map<CameraId, Described> described_;  // by the session's numbers
    LeftCameras left_;                         // of them
    SettledPlaces places_;
    std::map<StreamId, std::string> filters_;  // that run on each camera's depth
    session::RoomTrackWriter room_;
    std::uint64_t room_version_ = 0;
    TimePoint room_noted_, room_recorded_;

    // Last: its thread uses all of the above.
    std::unique_ptr<Participant> participant_;
};

}  // namespace

std::unique_ptr<record::RecordSource> record_session(const net::Link& link, const std::string& name,
                                                     const std::string& file,
                                                     const record::RecordCodecs& codecs,
                                                     const record::Recorder::Options& options,
                                                     std::optional<Duration> patience,
                                                     const std::filesystem::path& person_folder) {
    return std::make_unique<SessionRecording>(link, name, file, codecs, options, patience,
                                              person_folder);
}

}  // namespace theatron::client
