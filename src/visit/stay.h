// SPDX-License-Identifier: Apache-2.0
// One person's time in a session: the participant, and with it the person's voice, face and
// cameras. The same for a window, the screen of an operating room, and a program without either.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "client/participant.h"
#include "client/settings.h"
#include "publish/own_face.h"
#include "visit/face_line.h"
#include "visit/source_remarks.h"
#include "visit/stay_command.h"
#include "visit/voice_line.h"

namespace theatron::visit {

// Voice, face and cameras, as far as a person brings them along; the others are null. All must
// outlive the stay.
struct Ports {
    VoiceLine* voice = nullptr;
    publish::OwnFace* face = nullptr;
    FaceLine* expression = nullptr;
    publish::CameraPublisher* cameras = nullptr;  // its events must be in the participant's options
};

// The person's settings, which the next stay begins with.
struct KeptSettings {
    client::Settings now;
    std::function<void(const client::Settings&)>
        keep;  // called when they have changed; may be empty

    void change(const client::Settings& settings);
};

// All functions from one thread.
class Stay {
public:
    // Joins, and goes on until it is destroyed.
    Stay(client::Participant::Options join, const Ports& ports, KeptSettings settings = {});

    client::Participant& participant() { return participant_; }
    const client::Participant& participant() const { return participant_; }
    const Ports& ports() const { return ports_; }
    KeptSettings& settings() { return settings_; }

    // Returns a sentence about it for the person; empty: there is nothing to say.
    std::string obey(const StayCommand& command);

    // Many times a second: what goes on without the person. Returns sentences for them, such as
    // that a camera of theirs stands still.
    std::vector<std::string> tick(TimePoint now);

    // The session is over for somebody who was in, for good.
    bool is_over() const;

private:
    static client::Participant::Options with(client::Participant::Options join, const Ports& ports);
    std::string carry_out(const ToggleMicrophone& command);
    std::string carry_out(const SetMicrophone& command);
    std::string carry_out(const TogglePushToTalk& command);
    std::string carry_out(const HoldTalk& command);
    std::string carry_out(const UseMicrophone& command);
    std::string carry_out(const UseSpeaker& command);
    std::string carry_out(const AllowVoiceRecording& command);
    std::string carry_out(const ShowFace& command);
    std::string carry_out(const ShowExpression& command);

    const Ports ports_;
    KeptSettings settings_;
    SourceRemarks sources_;
    client::Participant participant_;
    // They end before the participant does.
    std::optional<publish::Publishing> publishing_;
    std::optional<publish::FaceShowing> showing_;
    std::optional<VoiceLine::Talking> talking_;
    std::optional<FaceLine::Sending> sending_;
};

}  // namespace theatron::visit
