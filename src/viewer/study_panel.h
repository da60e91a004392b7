// SPDX-License-Identifier: Apache-2.0
// The panel of a person who takes part in a study: the step that the study's program shows, and the
// buttons of the reply. The same in the window, the page and the headset.
//
// A reply is chosen first and sent by a second button, because it cannot be taken back. A sent one
// has no buttons any more, until the study's program asks again or the connection has been lost: a
// reply takes as long as the latency that a condition adds. The panel may be put aside, and comes
// back with the next step.
//
// Pure: time is an argument.
#pragma once

#include <optional>
#include <string>
#include <utility>

#include "client/participant.h"
#include "viewer/room_panel.h"

namespace theatron::viewer {

// A key of a keyboard, as far as it may reply.
struct StudyKey {
    enum class What { digit, minus, erase, go_on } what{};
    int digit = 0;
};

// Use from one thread.
class StudyPanel {
public:
    // Buttons of points beside each other; of more points than `most_points` the number is typed.
    static constexpr int points_in_row = 7, most_points = 21;

    // The session's newest step; nullopt: there is none. True: another one than before has come.
    bool take(const std::optional<client::Participant::Study>& study, TimePoint now);
    // There is something to show, perhaps put aside.
    bool is_on() const { return step_.has_value(); }
    bool is_aside() const { return aside_; }
    void put_aside(bool aside) { aside_ = aside; }

    // Returns the reply that is to be sent, if the press makes one.
    std::optional<wire::StudyReply> carry_out(const StudyPress& press, TimePoint now);
    // The press that a key stands for; nullopt: the step takes no such key, which means what it
    // means elsewhere.
    std::optional<StudyPress> press_of(const StudyKey& key, TimePoint now) const;

    // Rows and buttons, if there is a step.
    void add_panel(RoomPanel& panel, TimePoint now) const;

private:
    // The lowest and the highest value of a reply.
    std::pair<int, int> bounds() const;
    bool is_question() const;
    bool is_typed() const;
    // Keys type a number, since a reply may have more than one digit or a sign.
    bool types_digits() const;
    void type_digit(int digit);
    bool is_point(std::int64_t value) const;
    bool takes_replies() const;
    std::string typed_text() const;
    std::uint64_t keyboard_number() const;
    bool may_go_on(TimePoint now) const;
    Duration seen_for(TimePoint now) const { return now - shown_; }
    void add_texts(window::Panel& rows) const;
    void add_answers(window::Panel& rows, RoomPanel& panel) const;
    void add_keys(window::Panel& rows, RoomPanel& panel) const;
    void add_time(window::Panel& rows, TimePoint now) const;
    void add_ways_on(window::Panel& rows, RoomPanel& panel, TimePoint now) const;
    window::PanelButton answer(const std::string& label, int value, RoomPanel& panel) const;

    std::optional<wire::StudyStep> step_;
    std::uint64_t version_ = 0;
    // The last step that could be replied to.
    std::pair<std::uint32_t, wire::StudyKind> last_{};
    TimePoint shown_;
    std::optional<int> chosen_;
    bool negative_ = false;  // the number that is typed, also before its first digit
    bool types_ = false;     // `chosen_` was begun by keys, and the next digit goes behind it
    bool sent_ = false;
    bool aside_ = false;
    bool asks_end_ = false;
};

}  // namespace theatron::viewer
