// SPDX-License-Identifier: Apache-2.0
// A person's microphone and loudspeaker in a session. A device that is missing or denied is said
// and left out; the person takes part without it.
#pragma once

#include <atomic>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "client/participant.h"
#include "sound/echo_canceller.h"
#include "sound/feed_thread.h"
#include "sound/kept_device.h"
#include "sound/voice_input.h"
#include "sound/voice_output.h"
#include "viewer/sound_panel.h"
#include "viewer/voices.h"
#include "voice/talk_switch.h"

namespace theatron::visit {

// All functions from one thread.
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

    // Another device from now on; a microphone only while somebody talks.
    void use_microphone(const std::string& name);
    void use_speaker(const std::string& name);
    bool has_microphone() const;

    // The key of push to talk is down, or not; see voice::TalkSwitch::hold().
    void hold(bool is_held, TimePoint now);
    // The same by a line (voice_lines.h): held until it says something else.
    void hold_by_line(bool is_held);
    // Between an open microphone and push to talk. Returns a line about it.
    std::string toggle_push_to_talk();
    bool pushes_to_talk() const { return switch_.pushes(); }

    // Closes the microphone if it is open, and opens it if it is closed. Returns a line about it.
    std::string toggle_microphone();
    void close_microphone();
    // `pushes`: heard only while the key is held.
    void open_microphone(bool pushes);

    // Says once when the host lets nobody hear this person, and when it does again. To be called
    // with the newest standing while joined.
    void note(const wire::Standing& standing);

    // How loud this person is for the others; nullopt: nobody hears them.
    std::optional<int> heard_level_db() const;
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
    // "voices":[{"id","delay_ms","seconds","concealed_ms","longest_concealed_ms"}],"unreadable",
    // "missing_ms" (of the present loudspeaker), "lead_ms" (while there is one), "lost_ms" (of the
    // microphone): docs/room.md}
    nlohmann::json json() const;

private:
    void apply();
    void rendered(std::span<const float> samples);
    std::unique_ptr<sound::SoundDevice> open_speaker(const std::string& name);
    std::unique_ptr<sound::SoundDevice> open_microphone(const std::string& name);
    nlohmann::json microphone_json() const;

    const Options options_;
    voice::TalkSwitch switch_;
    bool line_holds_ = false;
    bool may_speak_ = true;  // the role, as it was said last
    bool is_heard_ = true;   // the role may speak, and nobody has muted this person

    std::unique_ptr<sound::EchoCanceller> canceller_;  // null: off
    std::atomic<bool> cleans_ = false;                 // the present microphone is treated
    sound::VoiceOutput output_;
    std::unique_ptr<sound::FeedThread> output_thread_;  // while there is a speaker_
    std::unique_ptr<sound::KeptDevice> speaker_;

    // The present Talking's.
    std::unique_ptr<sound::VoiceInput> input_;
    std::unique_ptr<sound::FeedThread> input_thread_;
    std::unique_ptr<sound::KeptDevice> microphone_;
};

}  // namespace theatron::visit
