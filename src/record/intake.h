// SPDX-License-Identifier: Apache-2.0
// The input of a recording: takes the pictures of live streams in the order of arrival,
// gives those that can be decoded to the recorder, begins its segments, and counts
// missing pictures.
//
// Thread-safe; times are arguments. The recorder has a thread. `now` is always the recording
// machine's own steady clock; the session's clock is only written into the file.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "record/recorder.h"
#include "record/segment_pace.h"
#include "record/stream_gate.h"
#include "record/voice_track.h"

namespace theatron::record {

class Intake {
public:
    // A stream without a picture for this time, or for three of its periods if that is longer, is
    // reported as missing.
    static constexpr Duration silence_limit = std::chrono::milliseconds(1500);
    // Time between two reports of a stream while more of it gets lost.
    static constexpr Duration news_interval = std::chrono::seconds(1);

    // `camera_patience` after a description without cameras the room begins a segment: people speak
    // and point also then, and what comes meanwhile is kept for that segment. With cameras, if none
    // has sent a picture `picture_patience` after it.
    static constexpr Duration camera_patience = std::chrono::seconds(2),
                              picture_patience = std::chrono::seconds(5);

    // Nothing is created before the first picture or part of the room.
    Intake(std::filesystem::path file, const Recorder::Options& options)
        : file_(std::move(file)), options_(options) {}
    ~Intake();
    Intake(const Intake&) = delete;
    Intake& operator=(const Intake&) = delete;

    // The two clocks now, and the wall's.
    struct Now {
        TimePoint local;
        ClockPair clock;
    };

    // Sets the cameras and settings of the following messages. If anything except the numbers of
    // settings is new, a segment begins with the first key frame in one of the new settings. From
    // then on each other stream goes into the segment before until its own next key frame, and what
    // is of the new segment is held back until all have had one, at most change_patience and
    // one held_share of the recorder's buffer: no stream loses a frame because another changes.
    // With `new_connection` the session's clock and all numbers may be new, and nothing is held
    // back. From any thread, in order with take().
    //
    // Segments of one connection begin at SegmentPace: until the next one may, the streams that the
    // present one does not have are left out, which counts as an interruption of each.
    static constexpr Duration change_patience = std::chrono::seconds(2);
    static constexpr std::size_t held_share = 4;
    void describe(std::vector<RecordedCamera> cameras, std::map<StreamId, SettingId> settings,
                  bool new_connection, TimePoint now);

    // Takes a whole media message of any stream. Never waits, never throws. True if the stream's
    // sender should send a key frame. From any thread; messages of one stream in order.
    [[nodiscard]] bool take(const wire::MediaHeader& header, std::shared_ptr<const Bytes> message,
                            const std::string& filters, const Now& now);

    // A part of the room's state, which begins at session time `begin`. A key part needs no part
    // before it; the first one of each segment must be one. False if it was not recorded, because
    // it is none or nothing is recorded or kept yet: then the next part must be a key part. A key
    // part begins a segment of its own after camera_patience. Never waits, never throws. From any
    // thread, in order.
    [[nodiscard]] bool take_room(ByteView part, bool key, TimePoint begin, const Now& now);

    // The people who agree that their voices are recorded, all of them. Each segment has a track
    // for each of those of its beginning, and spare_voices for people who agree later; who agrees
    // no longer, or has left, gives the track back, at best to somebody of the same name, since a
    // person who comes back has another number. Only where more people agree at the same time than
    // there are tracks, a segment begins with the next key frame. None has fewer tracks than the
    // one before, so those who come and go make no segments. From any thread.
    static constexpr std::size_t spare_voices = 8;
    void describe_voices(std::vector<RecordedVoice> voices);
    // The connection is lost that brought the packets of all who agree: what those who spoke before
    // say until they are described again is missing.
    void interrupt_voices();
    // The host withholds the packets of this person, who is muted or may not speak: they do not
    // count as missing.
    void interrupt_voice(ParticipantId person);

    // A packet of such a person, in the order of arrival. Voices go into the file as gapless
    // sequences (voice_track.h), silence up to voice_patience before the newest picture, or up to
    // quiet_patience before now while no picture comes. Nothing is recorded of a person who has not
    // agreed, or before the first segment and what is kept for it. Never waits, never throws. From
    // any thread.
    static constexpr Duration voice_patience = std::chrono::seconds(1),
                              quiet_patience = std::chrono::seconds(10);
    void take_voice(ParticipantId person, const VoicePacket& packet, TimePoint now);
    // Fills the voices with silence while no picture comes. Call it some times a second.
    void pass_time(const Now& now);

    struct Voice {
        RecordedVoice who;
        VoiceSequence::Figures figures;
        std::uint64_t dropped = 0;        // packets, since the disk was too slow
        std::uint64_t interruptions = 0;  // lost connections
    };
    // Everybody whose voice was recorded, also of earlier segments.
    std::vector<Voice> voices() const;

    // The last file is not at its name any more: a new one begins with the next key frame, which
    // take() requests. Until then pictures go into the last one, which may only be renamed.
    void begin_segment();

    // Gives the recorder what is held back for a new segment, as the destructor does.
    void take_held();

    // This camera has ended: it sends no more pictures, and none are missing from now on.
    void on_end(CameraId camera);
    // The way of this camera's pictures broke before the host: as on_end(), but what it would have
    // sent until it is described again is missing.
    void on_interruption(CameraId camera);

    // Sentences for the user on losses since the last call.
    // Call it some times a second.
    std::vector<std::string> news(TimePoint now);

    struct Stream {
        StreamId id{};
        std::string camera;  // its name
        StreamGate::Figures figures;
        // Pauses of more than silence_limit without any picture, and lost connections.
        std::uint64_t interruptions = 0;
        // Arrival of the first and the last picture.
        std::optional<TimePoint> first, last;
        bool complete() const {
            return figures.recorded > 0 && figures.lost + figures.dropped + interruptions == 0;
        }
    };
    // All streams that were ever described. A stream that is silent at `now` is interrupted.
    std::vector<Stream> streams(TimePoint now) const;

    // Session time of the newest picture's capture, of cameras that have not ended. Empty before
    // the first one.
    std::optional<TimePoint> newest_captured() const;

    // Null before the first segment. It is owned by the intake.
    Recorder* recorder() const;
    // One sentence if the recording could not begin or has ended by itself; else empty.
    std::string problem() const;

private:
    struct Entry {
        Stream stream;
        StreamGate gate;
        Duration patience{};
        TimePoint heard;                    // of it, or of its description
        std::optional<TimePoint> captured;  // the last one recorded, in session time
        bool ended = false, silent = false;
        bool is_left_out = false, said_left_out = false;  // until the next segment
        bool has_left = false;   // it was not described once, after it had been
        std::uint64_t said = 0;  // pictures that were reported as missing
    };
    struct Description {
        std::vector<RecordedCamera> cameras;
        std::map<StreamId, SettingId> settings;
        bool new_connection = false;
    };

    // A voice track of the newest segment, and its speaker; not given out yet: nobody.
    struct VoiceLane {
        std::optional<ParticipantId> person;
        std::string note;  // names the speaker
        VoiceSequence sequence;
        FrameNumber blocks = 0;
    };

    // A message of the segment that is about to begin.
    struct Held {
        wire::MediaHeader header;
        std::shared_ptr<const Bytes> message;
        std::string filters;
        Now now;
    };
    // From the first key frame of a segment until it begins.
    struct Change {
        Description next;
        std::vector<Held> held;  // in the order of arrival; never empty after take()
        std::size_t held_bytes = 0;
        std::set<StreamId> changed;  // whose frames are held
        Duration waited{};           // without the time in which the recorder stood still
        TimePoint seen;              // when that was counted, on the machine's own clock
        // Since cameras have left meanwhile, whose held frames are still of `next`.
        std::optional<std::map<StreamId, SettingId>> settings_after;
    };

    // True if each camera is one of these; false for none.
    static bool are_among(const std::vector<RecordedCamera>& cameras,
                          const std::vector<RecordedCamera>& all);
    static bool is_of(const Description& description, const wire::MediaHeader& header);
    Description present() const;
    bool begins_segment(const Entry& entry, const wire::MediaHeader& header, TimePoint now) const;
    bool may_begin_segment(TimePoint now) const;
    bool must_wait(const wire::MediaHeader& header, TimePoint now) const;
    void begin_change(Description next, TimePoint now);
    bool belongs_to_next(const Entry& entry, const wire::MediaHeader& header);
    bool is_awaited(StreamId stream) const;
    bool is_change_over() const;
    void describe_change(Description next);
    void end_change_in_time(const Now& now);
    void end_change(Now now);
    bool put(Entry& entry, const wire::MediaHeader& header, std::shared_ptr<const Bytes> message,
             const std::string& filters, const Now& now);

    std::vector<VoiceTrack> voice_tracks() const;
    bool is_free(const VoiceLane& lane) const;
    bool lacks_voice_lanes() const;
    void keep_figures(const VoiceLane& lane);
    void begin_voices(TimePoint begin);
    VoiceLane* voice_lane_of(ParticipantId person);
    void add_voice(std::size_t lane, const VoiceSequence::Block& block, TimePoint now);
    void fill_voices(TimePoint until, TimePoint now);
    bool begin(Description description, TimePoint captured, const Now& now,
               std::optional<TimePoint> voices_begin = {});
    bool keeps() const;
    bool put_room(ByteView part, bool key, TimePoint begin, TimePoint now);
    void put_voice(ParticipantId person, const VoicePacket& packet, TimePoint now);
    bool room_begins_segment(TimePoint now) const;
    bool is_described_anew() const;
    bool can_begin_with(const Entry& entry) const;
    void note_time(Entry& entry, const wire::MediaHeader& header, TimePoint now);

    const std::filesystem::path file_;
    const Recorder::Options options_;

    mutable std::mutex mutex_;  // guards all below
    std::unique_ptr<Recorder> recorder_;
    std::string problem_;
    std::map<StreamId, Entry> entries_;
    Description current_;                 // of the newest segment
    std::optional<Description> pending_;  // not begun yet
    std::optional<Change> change_;
    TimePoint waits_since_;  // for a picture of pending_, on the machine's own clock
    // Parts of the room and voices since session time kept_from_, for the segment of pending_.
    std::vector<std::function<void()>> kept_;
    TimePoint kept_from_;
    bool wants_segment_ = false;  // since the last file is not at its name
    SegmentPace pace_;
    bool said_last_file_ = false;
    TimePoint looked_, said_;
    TimePoint disk_judged_from_;
    bool disk_is_late_ = false;
    std::uint64_t segments_begun_ = 0, room_segment_ = 0;  // that of the newest part of the room
    FrameNumber room_parts_ = 0;
    std::vector<RecordedVoice> agreed_;
    std::vector<VoiceLane> voices_;          // by track
    std::map<ParticipantId, Voice> spoken_;  // in earlier segments; drops also of this one
    TimePoint filled_until_;                 // of the voices, without the patience
};

}  // namespace theatron::record
