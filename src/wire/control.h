// SPDX-License-Identifier: Apache-2.0
// Control messages as plain structs, and their bytes (FlatBuffers, control.fbs).
//
// Each direction has a variant of its own, so a message cannot be sent the wrong way. Every struct
// lists its fields once, in the order of its table in control.fbs, texts and lists with the most
// characters or elements that they may have; encoding and decoding follow that list.
//
// Times in messages are session time unless a comment says otherwise.
#pragma once

#include <string>
#include <variant>

#include "base/bytes.h"
#include "base/status.h"
#include "wire/text.h"
#include "wire/to_host.h"
#include "wire/to_participant.h"

namespace theatron::wire {

// In the order of the unions in control.fbs.
using ToHost = std::variant<Join, ChooseCodecs, RequestKey, Ping, Report, ChooseDelivery, Publish,
                            Unpublish, CameraState, RoomRequest, Manage, RequestContent,
                            VoiceConsent, AdjustCamera, Play, LookBack, OfferRelay, AskPatient,
                            ShowStudy, StudyReply, SetCondition, WriteChat, RaiseHand, RelayReport>;
using ToParticipant =
    std::variant<Welcome, Settings, CameraState, Pong, Delivery, SetRenderer, Refused, Goodbye,
                 CamerasAdded, CamerasRemoved, Published, Encode, EncodeKey, RoomSnapshot,
                 RoomChange, RoomDecision, Waiting, Standing, Visitors, Managed, OfferedCases,
                 Content, CameraChanged, Playback, ShareEnded, Patient, RelayGrants, RelayReceivers,
                 AskedPatient, StudyStep, StudyReplied, ChatMessages>;

// A refusal with its English sentence.
Refused refused(Text reason);
// The part of the requested data that is sent, in English: "half of the frames, colour as jpeg".
std::string sent_part(const Delivery& delivery);

Bytes encode(const ToHost& message);
Bytes encode(const ToParticipant& message);

// Safe for untrusted input. Status::unsupported for a message of a newer
// protocol, which may be ignored. The result takes no more memory than max_decoded_size,
// however often the message refers to the same bytes.
inline constexpr std::size_t max_decoded_size = 1 << 20;
Result<ToHost> decode_to_host(ByteView bytes);
Result<ToParticipant> decode_to_participant(ByteView bytes);

}  // namespace theatron::wire
