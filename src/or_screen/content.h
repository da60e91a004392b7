// SPDX-License-Identifier: Apache-2.0
// Everything that the OR screen tells, in plain values, and how it is put into words. Pure.
#pragma once

#include <cstddef>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "client/participant_figures.h"
#include "image/view.h"
#include "or_screen/picture_place.h"
#include "session/mark.h"
#include "viewer/slice_texts.h"

namespace theatron::or_screen {

// Another person as known at this moment.
struct PersonNow {
    ParticipantId id{};
    std::string name;
    wire::Role role{};
    bool muted = false, speaks = false, hand_raised = false;
    std::optional<double> pose_age_ms;  // none: no pose has come, as from people without a window
    bool points = false;
    bool points_at_images = false;  // at the slice on the monitor
    bool is_recorded = false;       // part of the recording that the host plays
    std::optional<Sight> pointed;   // the end of the pointer in the shown picture, if it has one
};

// A person's entry at the lower edge.
struct PersonCard {
    ParticipantId id{};
    std::string name, initials, state;
    Rgb color;
    bool speaks = false;
    bool warns = false;  // the state is one to notice
    bool is_recorded = false;
    bool operator==(const PersonCard&) const = default;
};

// The cards of at most `most` people, in the order of their numbers, so that cards stay where they
// are. Where there are more people, those who speak or point have a card before others.
std::vector<PersonCard> cards_of(const std::vector<PersonNow>& people, std::size_t most);

// The end of a person's pointer in the shown picture; never outside.
struct PointerMark {
    ParticipantId id{};
    std::string initials;
    Rgb color;
    PicturePlace place;
    bool operator==(const PointerMark&) const = default;
};

// The head of a person in the picture of the room, in shares of its width and height.
struct HeadMark {
    ParticipantId id{};
    std::string initials;
    Rgb color;
    bool speaks = false;
    Vec2 place;
};

// A mark of the room in the shown picture.
struct PictureMark {
    session::MarkKind kind{};
    std::string label;
    Rgb color;
    std::vector<PicturePlace> points;
};

struct Content {
    // Large over everything while there is no session; else empty.
    std::string message, detail;

    Size picture;  // of the shown camera; empty: none has sent colour
    std::string camera;
    std::string age;  // of the picture; empty: none
    bool age_warns = false;
    std::string warning;  // over the picture: it is not what happens now
    std::string
        playback;  // over the picture: "RECORDING 0:12 / 1:02"; empty: it is of no recording
    std::vector<std::string> written;  // "Anna: Please move the camera", the newest last
    std::string recorded;              // "recorded by Anna, 12 s"; empty: by nobody
    std::vector<PersonCard> people;
    std::size_t people_left_out = 0;
    bool is_alone = false;
    std::vector<PointerMark> pointers;
    std::vector<PictureMark> marks;
    std::vector<HeadMark> heads;
    std::optional<viewer::SliceTexts> slice;  // around the monitor's slice; none: there is no slice
    std::vector<PointerMark> slice_pointers;  // pixels of the slice
};

// The message while there is no session: first in large letters, then an explanation. Both empty
// while joined.
struct ScreenMessage {
    std::string text, detail;
};
ScreenMessage message_of(const client::Participant::Status& status);

// The newest messages, at most this number, that are not older than `written_for`.
inline constexpr Duration written_for = std::chrono::seconds(30);
inline constexpr std::size_t most_written = 3;
std::vector<std::string> written_texts(const client::Participant::Chat& chat, TimePoint now);

// Sets `camera`, `age`, `age_warns` and `warning` for the shown picture, which is so old. The age
// of a picture of a recording (`playback` is set) is not told: it is the time since it was played.
void describe_picture(const client::CameraFigures& camera, double age_ms, Content& content);

}  // namespace theatron::or_screen
