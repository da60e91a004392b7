// SPDX-License-Identifier: Apache-2.0
// A person's microphone and loudspeaker in a session. A device that is missing or denied is said
// and left out; the person takes part without it.
#pragma once

#include <atomic>
#include <map>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>

#include "client/participant.h"
#include "sound/echo_canceller.h"
#include "sound/kept_device.h"
#include "sound/spatial_voices.h"
#include "viewer/sound_panel.h"
#include "viewer/voices.h"
#include "voice/mixer.h"
#include "voice/speakers.h"
#include "voice/talker.h"

namespace theatron::app {

class VoiceLine {
public:
    struct Options {
        std::string microphone;  // as in sound::open_microphone(); empty: none
        std::string speaker;     // the same for the loudspeaker
        int frame_ms = 20;
        bool push_to_talk = false;  // see hold()
        // Echo, noise and loudness of the microphone are treated (sound/echo_canceller.h).
        // automatic: of devices, not of files.
        enum class Cleaning { automatic, on, off } cleaning = Cleaning::automatic;
        // The voices are heard from where people stand (sound/spatial_voices.h), once place() has
        // said where. automatic: by devices, not in files.
        enum class Spatial { automatic, on, off } spatial = Spatial::automatic;
        // The usual device takes the place of one that cannot be opened at the beginning.
        bool usual_instead = false;
    };

    // Opens the loudspeaker.
    explicit VoiceLine(const Options& options);

    // Lets a participant with these options take its packets of voice here. This object must
    // outlive the participant.
    void hear_by(client::Participant::Options& options);

    // Opens the microphone and sends what it hears until this object is destroyed, which must be
    // before the participant is.
    class Talking {
    public:
        Talking(VoiceLine& line, client::Participant& participant);

        ~Talking();
        Talking(const Talking&) = delete;
        Talking& operator=(const Talking&) = delete;

    private:
        VoiceLine& line_;
    };

    // Carries out a line: "microphone on", "microphone off", "microphone push" (only while the key
    // is held), "talk on" or "talk off" (the key), "use microphone NAME" or "use speaker NAME" for
    // another device. False if it is another one. From the thread that made the Talking.
    bool obey(const std::string& line);

    // Another device from now on. From the thread that made the Talking.
    void use_microphone(const std::string& name);
    void use_speaker(const std::string& name);

    // The key of push to talk is down, or not. The microphone stays open for release_time, so that
    // the end of a word is heard. Call it a few times a second.
    static constexpr Duration release_time = std::chrono::milliseconds(200);
    void hold(bool is_held, TimePoint now);
    // Between an open microphone and push to talk. Returns a line about it.
    std::string toggle_push_to_talk();
    bool pushes_to_talk() const;

    // Closes the microphone if it is open, and opens it if it is closed. Returns a line about it.
    std::string toggle_microphone();

    // Says once when the host lets nobody hear this person, and when it does again. To be called
    // with the newest standing while joined.
    void note(const wire::Standing& standing);

    // The others who speak, known without a loudspeaker, too.
    std::set<ParticipantId> speaking() const;
    // For a window.
    viewer::Voices voices() const;
    // The same with these devices of the machine.
    viewer::SoundChoices sound_choices(const sound::DeviceList& devices) const;

    // The head of this person (y up, -z ahead), and those of the others by the participant. Call it
    // many times a second.
    void place(const Pose& room_from_head, const client::Participant& participant);

    // {"microphone":"open"|"closed"|"push"|"none","talks","heard","level_db","speaker","space"
    // ("hrtf", "panning" or "off"),"speaking":[{"id","level_db"}],
    // "microphone_began_us","speaker_began_us" (of files, this machine's steady clock),
    // "voices":[{"id","delay_ms","seconds","concealed_ms","longest_concealed_ms"}],"unreadable"}
    nlohmann::json json() const;

private:
    void hear(ParticipantId speaker, ByteView packet);

    const Options options_;
    mutable std::mutex talker_mutex_, mixer_mutex_;
    std::unique_ptr<voice::Talker> talker_;  // while somebody talks
    bool has_microphone() const;
    void play(std::span<float> out);
    void play_in_space(std::span<float> out);
    void apply();  // with talker_mutex_ held
    bool is_open_ = true;
    bool is_pushed_ = false;   // push to talk
    bool talks_ = false;       // its key is held, or was until just now
    bool line_holds_ = false;  // by a line
    TimePoint held_at_;
    bool may_speak_ = true;     // the role, as it was said last
    bool is_heard_ = true;      // the role may speak, and nobody has muted this person
    voice::Speakers speakers_;  // under mixer_mutex_
    voice::Mixer mixer_;        // under mixer_mutex_
    // Under mixer_mutex_. Null until a loudspeaker plays in space.
    std::unique_ptr<sound::SpatialVoices> spatial_;
    std::optional<Pose> head_from_room_;          // under mixer_mutex_
    std::map<ParticipantId, Vec3> heads_;         // in the room; under mixer_mutex_
    client::Participant* participant_ = nullptr;  // of the present Talking
    std::unique_ptr<sound::KeptDevice>
        microphone_;  // of the present Talking; its thread uses the talker
    void take(std::span<const float> samples);
    std::unique_ptr<sound::EchoCanceller> canceller_;  // null: off
    std::atomic<bool> cleans_ = false;                 // the present microphone is treated
    std::vector<float> uncleaned_, cleaned_;           // the microphone's thread only
    std::vector<float> played_;                        // the loudspeaker's thread only
    std::atomic<bool> plays_ = false;                  // there is a speaker_
    std::unique_ptr<sound::KeptDevice> speaker_;       // its thread uses the mixer
};

}  // namespace theatron::app
