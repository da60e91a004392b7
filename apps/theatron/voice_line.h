// SPDX-License-Identifier: Apache-2.0
// A person's microphone and loudspeaker in a session. A device that is missing or denied is said
// and left out; the person takes part without it.
#pragma once

#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "client/participant.h"
#include "sound/sound_device.h"
#include "voice/mixer.h"
#include "voice/talker.h"

namespace theatron::app {

class VoiceLine {
public:
    struct Options {
        std::string microphone;  // as in sound::open_microphone(); empty: none
        std::string speaker;     // the same for the loudspeaker
        int frame_ms = 20;
    };

    // Opens the loudspeaker.
    explicit VoiceLine(const Options& options);

    // To be called with all packets of voice (client::Participant::Options::voice).
    void hear(ParticipantId speaker, ByteView packet);

    // Opens the microphone and sends what it hears until this object is destroyed, which must be
    // before the participant is.
    class Talking {
    public:
        Talking(VoiceLine& line, client::Participant& participant);

    private:
        std::unique_ptr<sound::SoundDevice> microphone_;
    };

    // Carries out a line: "microphone on" or "microphone off". False if it is another one.
    bool obey(const std::string& line);

    // Closes the microphone if it is open, and opens it if it is closed. Returns a line about it.
    std::string toggle_microphone();

    // Says once when the host lets nobody hear this person, and when it does again. To be called
    // with the newest standing while joined.
    void note(const wire::Standing& standing);

    // {"microphone":"open"|"closed"|"none","heard","level_db","speaker","speaking":[{"id","level_db"}],
    // "microphone_began_us","speaker_began_us" (of files, this machine's steady clock),
    // "voices":[{"id","delay_ms","seconds","concealed_ms","longest_concealed_ms"}],"unreadable"}
    nlohmann::json json() const;

private:
    const Options options_;
    mutable std::mutex talker_mutex_, mixer_mutex_;
    std::unique_ptr<voice::Talker> talker_;  // while somebody talks
    std::optional<TimePoint> microphone_began_;
    bool is_open_ = true;
    bool is_heard_ = true;  // the role may speak, and nobody has muted this person
    voice::Mixer mixer_;
    std::unique_ptr<sound::SoundDevice> speaker_;  // its thread uses the mixer
};

}  // namespace theatron::app
