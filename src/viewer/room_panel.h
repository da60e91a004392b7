// SPDX-License-Identifier: Apache-2.0
// The panel of people and places: who is here, what they hold, and buttons to go to them; for
// operators also buttons that decide on people.
#pragma once

#include <functional>
#include <map>
#include <variant>
#include <vector>

#include "viewer/meeting.h"
#include "viewer/own_face.h"
#include "viewer/places.h"
#include "viewer/sheet.h"
#include "viewer/tools/tool.h"
#include "viewer/voices.h"
#include "window/overlay_content.h"
#include "window/window_input.h"

namespace theatron::viewer {

// The commands of the panel's buttons.
struct GoToPerson {
    ParticipantId person{};
};
struct LookThrough {
    ParticipantId person{};
};
struct GoToPlace {
    Place place;
};
struct Decide {  // an operator's decision on a person
    wire::ManageAction action{};
    ParticipantId person{};
    wire::Role role{};
    bool operator==(const Decide&) const = default;
};
struct AskToOpen {  // a case of the host: whose it is is shown first
    ContentHash offered;
};
struct OpenOffered {  // that case, which is the right one
    ContentHash offered;
};
struct LeaveClosed {};  // it is not
struct ChangeCase {     // false: there is no such case any more
    std::function<bool(client::Participant&)> change;
};
struct ChooseTool {
    ToolKind tool{};
};
struct ChangeMarks {  // false: there is no such mark
    std::function<bool(client::Participant&)> change;
};
struct Call {  // the user asks the others to come, or no longer does
    bool begins = false;
};
struct AnswerCall {
    ParticipantId person{};  // who asks the user to come
    bool comes = false;
};
enum class PictureKind { color, depth, blended };
struct ShowLarge {  // a plain picture of a camera; again: as small as the others
    CameraId camera{};
    PictureKind kind{};
    bool operator==(const ShowLarge&) const = default;
};
struct AdjustStep {  // of the chosen camera
    enum class What { choose, step, slide, undo, reset, draw, whole } what{};
    CameraId camera{};  // for `choose`
    int part = 0;       // 0 to 2: moved along x, y, z; 3 to 5: turned about them
    double by = 0;      // metres or degrees, for `step`
};
struct ShowFace {  // the user's own; false: no longer
    bool shown = false;
};
struct UseSound {  // from now on
    enum class Kind { microphone, loudspeaker } kind{};
    std::string device;
};
struct PlayStep {  // of the recording that the host plays
    enum class What { toggle, back, forward, slide } what{};
};
// The width of a screen changes by this factor with a click or a key.
inline constexpr double screen_width_step = 1.15;
struct ChangeScreen {
    enum class What { smaller, larger, pin, unpin, end } what{};
    session::ObjectId screen{};
};
struct ShowScreen {  // that is shared
    session::ObjectId screen{};
};
struct CloseScreenOffer {
    session::ObjectId screen{};  // that is not wanted
};
struct LookBackTo {  // for this person alone; 0: the present
    Duration ago{};
};
struct StudyPress {  // in the panel of a study
    enum class What {
        // Up to leave_out: of a reply that is not sent yet.
        choose,  // `value`
        digit,   // of a number: `value`
        minus,   // of a number: the other sign
        erase,   // the last digit
        go_on,   // with what is chosen
        leave_out,
        ask_end,  // the study
        end,
        keep_on,  // it is not ended
        aside,    // the panel
        show,
        close,  // after the end
    } what{};
    int value = 0;
    bool operator==(const StudyPress&) const = default;
};
struct WriteText {};  // to all others: the keyboard writes from now on
struct SendText {     // to all others
    std::string text;
};
struct RaiseHand {  // false: it is taken down
    bool raised = false;
};
struct TourPress {
    enum class What : std::uint8_t { begin, next, skip };
    What what{};
};
struct PressKey {  // as its key does
    window::Action action{};
};
struct ShowSheet {
    Sheet sheet{};
};
using RoomCommand = std::variant<GoToPerson, LookThrough, GoToPlace, Decide, AskToOpen, OpenOffered,
                                 LeaveClosed, ChangeCase, ChooseTool, ChangeMarks, Call, AnswerCall,
                                 ShowLarge, AdjustStep, PlayStep, ChangeScreen, ShowScreen,
                                 CloseScreenOffer, ShowFace, LookBackTo, UseSound, StudyPress,
                                 WriteText, SendText, RaiseHand, TourPress, PressKey, ShowSheet>;

struct RoomPanel {
    std::vector<window::Panel> panels;
    std::vector<RoomCommand> commands;  // by the number in window::PanelButton

    // The number of a further command.
    int add(RoomCommand command) {
        commands.push_back(std::move(command));
        return int(commands.size()) - 1;
    }
    window::PanelButton button(std::string label, RoomCommand command) {
        const bool leads_away = std::holds_alternative<GoToPerson>(command) ||
                                std::holds_alternative<GoToPlace>(command) ||
                                std::holds_alternative<LookThrough>(command) ||
                                std::holds_alternative<ShowScreen>(command);
        return {std::move(label), add(std::move(command)), leads_away};
    }
};

struct RoomPanelFacts {
    client::Participant::Room room;
    std::vector<room::RoomPerson> people;
    std::vector<Place> places;
    std::optional<ParticipantId> followed;  // the person through whose eyes the user sees
    bool is_operator = false;               // the user decides on people
    std::vector<wire::Visitor> visitors;    // who wait for that
    bool may_call = false, is_calling = false;
    std::map<ParticipantId, int> speaking = {};  // as in Voices
    OwnFace own_face = OwnFace::none;
    // The decision of which the button was pressed once; carried out by the second press.
    std::optional<Decide> asked = {};
    // The user can be brought to another place, and look through other eyes.
    bool may_go = true, may_look_through = true;
    // Nullopt: the host knows no raised hands.
    std::optional<bool> hand_raised = {};
};
RoomPanel room_panel(const RoomPanelFacts& facts);

// A row for each place, with the way there.
void add_places_panel(const std::vector<Place>& places, RoomPanel& panel);

// An offer to go to each of these people, who ask the user to come; comes before the others.
RoomPanel call_panel(const std::vector<room::RoomPerson>& callers);
// The panels of both, below each other.
RoomPanel joined(RoomPanel upper, const RoomPanel& lower);

}  // namespace theatron::viewer
