// SPDX-License-Identifier: Apache-2.0
// Versions, optional parts and limits of the protocol.
#pragma once

#include <cstddef>
#include <cstdint>

#include "base/time.h"

namespace theatron::wire {

// Versions of the protocol that this build speaks.
inline constexpr std::uint16_t protocol_min = 3;
inline constexpr std::uint16_t protocol_max = 3;

// Limits of decoding, in characters and elements. Decoding makes every text clean
// (base/outside_text.h) and cuts it to its limit; a longer list makes its message malformed.
inline constexpr std::size_t max_name = 64;                // of a participant, a host, a camera
inline constexpr std::size_t max_token = 256;              // the host compares it whole
inline constexpr std::size_t max_codec = 200;              // one codec in its spelling
inline constexpr std::size_t max_renderer = 40;            // one renderer's name
inline constexpr std::size_t max_filter_device = 100;      // a GPU's name
inline constexpr std::size_t max_filter = 1000;            // a chain of filters in its spelling
inline constexpr std::size_t max_cameras = 63;             // at once, as many as a recording holds
inline constexpr std::size_t max_calibration_size = 4096;  // bytes of one camera's
// Most bytes in one message: of a request, of a changed object, of a part of a snapshot.
inline constexpr std::size_t max_room_request_size = 4352;
inline constexpr std::size_t max_room_object_size = 4352;
inline constexpr std::size_t max_room_part_size = 48 * 1024;
inline constexpr std::size_t max_streams = 2 * max_cameras;
// Settings of all cameras of one publisher together.
inline constexpr std::size_t max_encodings = 64;

// Numbers of optional parts of the protocol. A program skips numbers that it does
// not know.
enum class Feature : std::uint16_t {
    publish = 1,        // sends cameras
    sends_only = 2,     // is sent no cameras of others
    room = 3,           // keeps the objects of the room (session/room_replica.h)
    cases = 4,          // is told of the host's cases, and takes their content
    voice_consent = 5,  // says with VoiceConsent if others may record its voice
    adjusting = 6,      // cameras are adjusted: AdjustCamera, CameraChanged
    playback = 7,       // is told where the host's recording is, and may play it
    screens = 8,        // is told with ShareEnded that others have ended its screens
    look_back = 9,      // may look back at the last minute: LookBack
    webcam = 10,        // is told of faces (CameraKind::face), and may send its own
    patient = 11,       // shows who the patient of the open case is, to a person who may know it
    // 12: pictures that went from publisher to receiver; of earlier versions
    asks_patient = 13,  // may ask whose case it is before it is opened: AskPatient, AskedPatient
    shows_screen = 14,  // may offer a screen as JPEG pictures: CameraKind::screen
    study = 15,         // shows steps of a study: StudyStep, StudyReply
    draws_flat = 16,  // shows the colour of one camera as it is: it has neither depth nor renderer
    chat = 17,        // shows what people write, and hands that they raise: WriteChat, ChatMessages
    relay = 18,       // takes sealed pictures from a relay: RelayGrants
    relays = 19,      // is a relay: OfferRelay, RelayReceivers, RelayReport
};
inline constexpr std::size_t max_features = 32;
inline constexpr std::size_t person_id_size = 16;
inline constexpr std::size_t max_visitors = 32;  // people who wait for admission at once
inline constexpr std::size_t max_offered_cases = 64;
inline constexpr std::size_t max_patient_text = 200;    // of a patient's name, of an id
inline constexpr std::size_t max_adjustment_size = 64;  // bytes of one camera's
inline constexpr std::size_t content_hash_size = 32;    // base/content_hash.h
inline constexpr std::size_t max_study_texts = 41;      // paragraphs of one step of a study
inline constexpr std::size_t max_study_text = 1000;   // one of them, a choice, a meaning of a point
inline constexpr std::size_t max_study_choices = 20;  // of one step
inline constexpr std::size_t max_chat_text = 500;     // of one message
inline constexpr std::size_t max_chat_messages = 16;  // in one message of the protocol
inline constexpr Duration max_added_latency = std::chrono::seconds(5);
inline constexpr std::size_t max_content_piece = 16 * 1024;      // bytes of content in one message
inline constexpr std::size_t max_content_request = 1024 * 1024;  // bytes that one request asks for

// Relays (docs/decisions/relays.md): addresses of one relay, the networks that it is for, receivers
// of one relay, relays that one receiver may connect to.
inline constexpr std::size_t max_relay_addresses = 6;
inline constexpr std::size_t max_relay_networks = 16;
inline constexpr std::size_t max_relay_receivers = 128;
inline constexpr std::size_t max_relay_grants = 4;
inline constexpr std::size_t max_relay_settings = max_streams;  // of one receiver
inline constexpr std::size_t relay_secret_size = 32;
inline constexpr std::size_t media_key_size = 32;    // of the session's sealed pictures
inline constexpr std::size_t fingerprint_size = 32;  // SHA-256 of a certificate

// A run of a host; random. Numbers of cameras and participants are of one session.
enum class SessionId : std::uint32_t {};

}  // namespace theatron::wire
