// SPDX-License-Identifier: Apache-2.0
// Texts for people as a code and arguments. A receiver makes the sentence, in its own language.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace theatron::wire {

// Numbers are never used for another text. The hundreds name a subject, so that a receiver can say
// at least that much about a number of a newer program. {0} and {1} are the arguments.
enum class TextCode : std::uint16_t {
    none = 0,
    as_written = 1,  // {0}: a sentence of a driver, a file or a codec, in English

    // Why a connection ends.
    host_too_old = 100,     // {0}: the host's highest protocol, {1}: the participant's lowest
    program_too_old = 101,  // {0}: the participant's highest protocol, {1}: the host's lowest
    wrong_token = 102,
    link_expired = 103,
    too_many_recordings = 104,  // {0}: how many there can be
    damaged_message = 105,      // {0}: a Status
    not_joined = 106,
    joined_too_late = 107,
    too_many_requests = 108,
    damaged_picture = 109,  // {0}: a Status
    foreign_picture = 110,
    session_over = 111,
    no_reason = 112,
    removed_by_operator = 113,
    link_revoked = 114,
    not_let_in = 115,
    ended_by_operator = 116,
    session_has_ended = 117,
    observer_records = 118,
    too_many_visitors = 119,
    all_places_taken = 120,    // {0}: how many there can be
    link_full = 121,           // {0}: how many can be in by one link
    person_is_in_often = 122,  // {0}: how often a person can be in
    came_in_again = 123,       // {0}: how often a person can be in
    host_may_return = 124,

    // Cameras. With a name in {0}: the camera cannot be shown, and an offer of it is refused whole.
    camera_silent = 200,
    camera_repeating = 201,
    camera_time_jump = 202,
    camera_gone = 203,
    recording_lost_one = 204,
    recording_lost_pictures = 205,  // {0}: how many
    camera_number_too_high = 206,   // {0}: name, {1}: number
    camera_foreign_streams = 207,   // {0}: name
    camera_bad_rate = 208,          // {0}: name
    camera_bad_calibration = 209,   // {0}: name, {1}: a Status
    one_camera_too_many = 210,      // {0}: name
    camera_number_taken = 211,      // {0}: name
    camera_too_many_pixels = 212,   // {0}: name
    camera_moved = 213,             // {0}: mm, {1}: degrees
    cameras_apart = 214,            // {0}: another camera's name, {1}: mm
    camera_without_depth = 215,     // {0}: name
    no_pictures_come = 216,
    camera_moved_far = 217,  // {0}: mm that it moved at least, {1}: its name
    camera_covered = 218,
    camera_moved_together = 219,  // {0}: mm, {1}: degrees, {2}: another camera's name, {3}: its own
    no_picture_came = 220,

    // Notes to a participant.
    all_encodings_taken = 300,  // {0}: how many there can be, {1}: the codec it asked for
    encoding_is_slow = 301,     // {0}: codec, {1}: ms a picture
    frames_were_late = 302,     // {0}: ms
    ceiling = 303,              // {0}: Mbit/s
    link_has_room = 304,
    link_is_tried = 305,
    trial_failed = 306,
    everything_is_sent = 307,
    half_of_frames = 308,
    quarter_of_frames = 309,
    one_frame_of = 310,   // {0}: how many
    coarser_color = 311,  // {0}: codec
    loss_outside_region = 312,
    codecs_are_set = 313,

    // Cameras of participants.
    link_without_cameras = 400,
    no_camera_offered = 401,
    too_many_own_cameras = 402,  // {0}: how many there can be
    session_full = 403,          // {0}: how many there can be
    no_camera_numbers = 404,
    offered_too_often = 405,
    face_beyond_limits = 406,  // {0}: pixels, {1}: pictures a second
    one_face = 407,
    too_many_faces = 408,  // {0}: how many there can be
    face_forbidden = 409,
    host_without_faces = 410,
    screen_beyond_limits = 411,  // {0}: pixels, {1}: pictures a second
    one_screen = 412,
    screen_forbidden = 413,
    host_without_screens = 414,

    // Requests to change the room.
    object_gone = 500,
    held_by_another = 501,
    not_held = 502,
    role_forbids = 503,
    person_gone = 504,
    room_full = 505,
    beyond_room_limits = 506,
    room_too_often = 507,
    part_of_recording = 508,
    part_of_case = 509,
    of_another = 510,
    mark_stays = 511,
    screen_pinned = 512,
    screen_of_another = 513,

    // Decisions on people.
    operators_decide = 600,
    decided_person_gone = 601,
    person_is_in = 602,
    person_waits = 603,
    not_on_yourself = 604,
    decided_too_often = 605,
    adjusted_camera_gone = 606,
    beyond_adjustment = 607,
    operators_adjust = 608,
    role_plays_not = 609,
    nothing_to_play = 610,
    nothing_kept = 611,
    shows_no_study = 612,
    other_study = 613,
    condition_codec = 614,
    large_step = 615,
    draws_flat = 616,
};

inline constexpr std::size_t max_text_arguments = 4;
inline constexpr std::size_t max_sentence = 500;  // characters of an argument, or of a text

struct Text {
    TextCode code = TextCode::none;
    std::vector<std::string> arguments = {};

    bool empty() const { return code == TextCode::none; }
    bool operator==(const Text&) const = default;

    static void fields(auto& m, auto&& field) {
        field(m.code);
        field(m.arguments, max_text_arguments);
    }
};

// True if this program has a text for the code.
bool is_known(TextCode code);

// True for texts on why a connection ends after which it is of no use to join again. False for the
// others, after which a program that was in tries again, and for those of a newer host.
bool is_for_good(TextCode code);

// A text that is known in English only; none if it is empty.
Text as_written(std::string sentence);

// The English text, from the table in text.cpp: most are sentences with a full stop; parts of a
// step and its reasons are not, since several of them stand in one line. An unknown code gives its
// subject, its number and its arguments. Empty for TextCode::none.
std::string english(const Text& text);
// The same without what operators can do about it, for those who are none.
std::string english_without_advice(const Text& text);

}  // namespace theatron::wire
