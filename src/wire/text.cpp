// SPDX-License-Identifier: Apache-2.0
#include "wire/text.h"

#include <algorithm>
#include <iterator>
#include <string_view>
#include <utility>

namespace theatron::wire {
namespace {

struct Row {
    TextCode code;
    std::string_view text;
    std::string_view advice = {};  // sentences that only operators can follow
};

// In the order of the codes.
constexpr Row rows[] = {
    {TextCode::as_written, "{0}"},

    {TextCode::host_too_old,
     "This host is older than your Theatron (protocol {0}, you need {1}); update the host."},
    {TextCode::program_too_old,
     "Your Theatron is too old for this host (protocol {0}, it needs {1}); update it."},
    {TextCode::wrong_token, "The join token is wrong; ask for the host's current link."},
    {TextCode::link_expired, "This link has expired; ask for a new one."},
    {TextCode::too_many_recordings,
     "This session is recorded {0} times already, which is the most it allows; end another "
     "recording."},
    {TextCode::damaged_message, "A message was {0}."},
    {TextCode::not_joined, "Join first."},
    {TextCode::joined_too_late, "No join came in time."},
    {TextCode::too_many_requests, "There were far more requests than a host answers."},
    {TextCode::damaged_picture, "A picture was {0}."},
    {TextCode::foreign_picture, "A picture belongs to no camera of this participant."},
    {TextCode::session_over, "The host has ended the session."},
    {TextCode::no_reason, "The host gave no reason."},
    {TextCode::removed_by_operator, "An operator has removed you from this session."},
    {TextCode::link_revoked, "The link by which you came is no longer valid; ask for a new one."},
    {TextCode::not_let_in, "An operator has not let you in."},
    {TextCode::ended_by_operator, "An operator has ended the session."},
    {TextCode::session_has_ended, "The session has ended; an operator must begin another one."},
    {TextCode::observer_records, "An observer cannot record; ask for a link of an expert."},
    {TextCode::too_many_visitors, "Too many people wait to be let in; try again later."},
    {TextCode::all_places_taken,
     "All {0} places of this session are taken; the last ones are kept for operators. Try again "
     "when somebody has left."},
    {TextCode::link_full,
     "{0} participants are in by this link, which is as many as one link admits; ask for a link "
     "of your own."},

    {TextCode::camera_silent, "It sends no pictures."},
    {TextCode::camera_repeating, "It sends the same picture again and again."},
    {TextCode::camera_time_jump, "The times of its pictures are impossible."},
    {TextCode::camera_gone, "It does not answer."},
    {TextCode::recording_lost_one, "Its recording is damaged: 1 picture is lost."},
    {TextCode::recording_lost_pictures, "Its recording is damaged: {0} pictures are lost."},
    {TextCode::camera_number_too_high,
     "The camera {0} has the number {1}, beyond all that there are; it cannot be shown."},
    {TextCode::camera_foreign_streams,
     "The camera {0} names streams that are not its own; it cannot be shown."},
    {TextCode::camera_bad_rate, "The camera {0} has an impossible frame rate; it cannot be shown."},
    {TextCode::camera_bad_calibration,
     "The camera {0} has a calibration that is {1}; it cannot be shown."},
    {TextCode::one_camera_too_many,
     "The camera {0} is one more than there can be; it cannot be shown."},
    {TextCode::camera_number_taken,
     "The camera {0} has a number that another one has; it cannot be shown."},
    {TextCode::camera_too_many_pixels,
     "The camera {0} has more pixels than there is room for beside the others; it cannot be "
     "shown."},
    {TextCode::camera_moved, "The camera was moved by {0} mm and {1} degrees.",
     " Put it back, or find its new place with 'theatron register LINK --refine PLACES --output "
     "NEW'. A nudge says that it is right as it is."},
    {TextCode::cameras_apart, "Surfaces that {0} sees, too, are {1} mm apart.",
     " Find the cameras' places again with 'theatron register LINK --output NEW' and the board."},
    {TextCode::camera_without_depth,
     "The camera {0} has no depth, which this version cannot show."},
    {TextCode::no_pictures_come, "Its pictures do not arrive any more."},
    {TextCode::camera_moved_far,
     "The camera was moved by more than {0} mm, or turned, so far that its picture cannot be "
     "matched.",
     " Put it back, find its place with the board and 'theatron register LINK --output NEW', or "
     "say that it is right as it is now: 'nudge {1} none'."},
    {TextCode::camera_covered,
     "It is covered, or sees nothing: the watch over its place cannot compare."},
    {TextCode::camera_moved_together,
     "The camera was moved by {0} mm and {1} degrees together with {2}, or everything that both "
     "see was.",
     " Put both back, or find their places with the board and 'theatron register LINK --output "
     "NEW'. If they stand where they stood, say so of each: 'nudge {3} none'."},

    {TextCode::all_encodings_taken,
     "The host already encodes in {0} ways; instead of {1} you get the nearest of them."},
    {TextCode::encoding_is_slow,
     "Encoding {0} takes {1} ms a picture here, more than its share, so you get fewer pictures "
     "than the cameras take; another codec would be faster."},
    {TextCode::frames_were_late, "frames took {0} ms to arrive"},
    {TextCode::ceiling, "your ceiling is {0} Mbit/s"},
    {TextCode::link_has_room, "there is room for more"},
    {TextCode::link_is_tried, "trying whether more arrives in time"},
    {TextCode::trial_failed, "your link or computer did not take more"},
    {TextCode::everything_is_sent, "everything"},
    {TextCode::half_of_frames, "half of the frames"},
    {TextCode::quarter_of_frames, "a quarter of the frames"},
    {TextCode::one_frame_of, "one frame of {0}"},
    {TextCode::coarser_color, "colour as {0}"},
    {TextCode::loss_outside_region, "bounded loss outside the region"},

    {TextCode::link_without_cameras,
     "Your role here lets you send no cameras; use the host's link for publishers, or ask an "
     "operator for that role."},
    {TextCode::no_camera_offered, "No camera was offered."},
    {TextCode::too_many_own_cameras, "A participant can send {0} cameras at once."},
    {TextCode::session_full, "The session has {0} cameras, which is the most it allows."},
    {TextCode::no_camera_numbers,
     "The session has had so many cameras that there are no numbers left; the host has to be "
     "started anew."},
    {TextCode::offered_too_often, "Cameras were offered too often; wait a little."},
    {TextCode::face_beyond_limits,
     "The picture of a face is a screen of at most {0} pixels, {1} times a second."},
    {TextCode::one_face, "A participant shows one face; withdraw the first one."},
    {TextCode::too_many_faces,
     "The session shows {0} faces, which is the most it allows; you are seen without a picture."},
    {TextCode::face_forbidden, "Observers show no face; ask the operator to make you an expert."},
    {TextCode::host_without_faces,
     "This host is too old to show your face; you are seen without a picture."},

    {TextCode::object_gone, "That object is gone"},
    {TextCode::held_by_another, "Somebody else holds this"},
    {TextCode::not_held, "You no longer hold this"},
    {TextCode::role_forbids, "Your role does not allow this"},
    {TextCode::person_gone, "That person has left"},
    {TextCode::room_full, "The room holds no more objects, or no more of yours: remove some first"},
    {TextCode::beyond_room_limits, "The object would be out of the room's limits"},
    {TextCode::room_too_often, "That was too much at once; try again"},
    {TextCode::part_of_recording, "Only the recording moves this"},
    {TextCode::part_of_case, "This belongs to the case; hide it, or close the case"},
    {TextCode::of_another, "Somebody else made this"},
    {TextCode::mark_stays, "A mark stays as it was made; it can only be removed"},
    {TextCode::screen_pinned, "This screen is pinned; its sharer or an operator unpins it"},
    {TextCode::screen_of_another, "Only the person who shares this and operators may do that"},

    {TextCode::operators_decide, "Only operators decide on others."},
    {TextCode::decided_person_gone, "That person has left."},
    {TextCode::person_is_in, "That person is in the session already."},
    {TextCode::person_waits, "That person must be let in first."},
    {TextCode::not_on_yourself, "Another operator must do this for you."},
    {TextCode::decided_too_often, "Those were too many decisions at once; try again."},
    {TextCode::adjusted_camera_gone, "That camera has left, or cannot be adjusted."},
    {TextCode::beyond_adjustment,
     "A camera can be moved by 0.3 m and turned by 15 degrees; beyond that, register it anew. Only "
     "the host's own cameras have a region, and it lies in their picture."},
    {TextCode::operators_adjust, "Only operators adjust cameras."},
    {TextCode::role_plays_not, "Your role does not allow to play the recording."},
    {TextCode::nothing_to_play, "This host plays no recording."},
    {TextCode::nothing_kept, "The host keeps nothing of the last minute that you may see."},
};

constexpr bool is_in_order() {
    for (std::size_t i = 1; i < std::size(rows); ++i)
        if (rows[i - 1].code >= rows[i].code)
            return false;
    return true;
}
static_assert(is_in_order());

// Null if there is none.
const Row* find(TextCode code) {
    const auto* row =
        std::lower_bound(std::begin(rows), std::end(rows), code,
                         [](const Row& r, TextCode wanted) { return r.code < wanted; });
    return row == std::end(rows) || row->code != code ? nullptr : row;
}

// A number of a newer program.
std::string_view subject_of(TextCode code) {
    switch (std::uint16_t(code) / 100) {
        case 1:
            return "The host ends the connection for a reason";
        case 2:
            return "Something is wrong with a camera";
        case 3:
            return "The host has changed what it sends for a reason";
        case 4:
            return "The host does not take the cameras for a reason";
        case 5:
            return "The host does not allow this change of the room for a reason";
        case 6:
            return "The host does not carry out this decision for a reason";
        default:
            return "The other program says something";
    }
}

std::string unknown(const Text& text) {
    std::string result = std::string(subject_of(text.code)) +
                         " that this version of Theatron does not know (number " +
                         std::to_string(int(text.code));
    for (const std::string& argument : text.arguments)
        result += ", " + argument;
    return result + "); a newer version can show it.";
}

// The sentence with the arguments in their places.
std::string filled_in(std::string_view sentence, const std::vector<std::string>& arguments) {
    std::string result;
    for (std::size_t i = 0; i < sentence.size(); ++i) {
        if (sentence[i] != '{') {
            result += sentence[i];
            continue;
        }
        const auto argument = std::size_t(sentence[i + 1] - '0');
        result += argument < arguments.size() ? arguments[argument] : "?";
        i += 2;
    }
    return result;
}

}  // namespace

bool is_known(TextCode code) {
    return find(code) != nullptr;
}

Text as_written(std::string sentence) {
    if (sentence.empty())
        return {};
    return {TextCode::as_written, {std::move(sentence)}};
}

std::string english(const Text& text) {
    const Row* row = find(text.code);
    return english_without_advice(text) + (row ? filled_in(row->advice, text.arguments) : "");
}

std::string english_without_advice(const Text& text) {
    if (text.empty())
        return {};
    const Row* row = find(text.code);
    return row ? filled_in(row->text, text.arguments) : unknown(text);
}

}  // namespace theatron::wire
