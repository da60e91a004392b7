// SPDX-License-Identifier: Apache-2.0
// The commands of the panels' buttons, carried out.
#include <type_traits>

#include "phrases/phrase.h"
#include "session/shared_screen.h"
#include "viewer/case_actions.h"
#include "viewer/screen_panel.h"
#include "viewer/viewer.h"
#include "wire/manage_text.h"

namespace theatron::viewer {

namespace {

template <class Command, class... Others>
constexpr bool is_one_of = (std::is_same_v<Command, Others> || ...);

// Commands on panels and words alone are carried out also while there is no picture.
template <class Command>
constexpr bool needs_no_picture = is_one_of<Command, PressKey, ShowSheet, StudyPress, WriteText,
                                            SendText, RaiseHand, TourPress, CloseScreenOffer>;

}  // namespace

void Viewer::carry_out(const RoomCommand& command, TimePoint now) {
    const auto carry = [&]<class Command>(const Command& one) {
        if (eye_.is_placed() || needs_no_picture<Command>)
            on(one, now);
    };
    std::visit(carry, command);
}

void Viewer::on(const StudyPress& press, TimePoint now) {
    if (const auto reply = study_.carry_out(press, now))
        participant_.reply_to_study(*reply);
    if (headset_ && study_.is_aside() && plate_ == Sheet::study)
        open_plate(Sheet::none);
}

void Viewer::on(const WriteText&, TimePoint) {
    chat_.begin();
}

void Viewer::on(const SendText& message, TimePoint now) {
    if (!participant_.write_chat(message.text))
        note(say(Phrase::message_not_sent, message.text), now);
}

void Viewer::type(const window::FormKeyPress& press, TimePoint now) {
    const std::string text = chat_.type(press);
    if (text.empty() || participant_.write_chat(text))
        return;
    chat_.put_back(text);
    note(say(Phrase::message_not_sent, text), now);
}

void Viewer::on(const RaiseHand& hand, TimePoint now) {
    if (!participant_.raise_hand(hand.raised))
        return note(say(Phrase::no_raised_hands), now);
    note(say(hand.raised ? Phrase::your_hand_is_up : Phrase::your_hand_is_down), now);
}

void Viewer::on(const TourPress& press, TimePoint) {
    if (press.what == TourPress::What::next)
        return tour_.next();
    if (press.what == TourPress::What::skip)
        return tour_.skip();
    tour_.begin();
    open_sheet(Sheet::none);
}

void Viewer::on(const PressKey& key, TimePoint) {
    if (headset_)  // its plate has no other keys
        return open_plate(key.action == window::Action::adjust_cameras ? Sheet::adjust
                                                                       : Sheet::none);
    // The panel of the rest has done its work.
    if (sheet_ == Sheet::more && key.action != window::Action::more)
        open_sheet(Sheet::none);
    pressed_.push_back({key.action});
}

void Viewer::on(const ShowSheet& opened, TimePoint) {
    if (headset_)
        open_plate(opened.sheet);
    else
        open_sheet(opened.sheet);
}

void Viewer::on(const Decide& decision, TimePoint now) {
    if (removal_.is_meant(decision, now))
        participant_.manage(decision.action, decision.person, decision.role);
}

void Viewer::on(const ChangeCase& change, TimePoint now) {
    if (!change.change(participant_))
        note(say(Phrase::not_in_room_any_more), now);
}

void Viewer::on(const AdjustStep& step, TimePoint) {
    slides_playback_ = false;
    adjusting_.carry_out(step);
}

void Viewer::on(const ShowFace& face, TimePoint) {
    face_wish_ = face.shown;
}

void Viewer::on(const UseSound& sound, TimePoint) {
    sound_wish_ = sound;
}

void Viewer::on(const PlayStep& step, TimePoint now) {
    slides_playback_ = step.what == PlayStep::What::slide;
    if (!may(session::Right::play))
        return note(wire::text_of(wire::ManageRefusal::playing_role), now);
    if (!playing_.carry_out(step, participant_, now))
        note(wire::text_of(wire::ManageRefusal::nothing_to_play), now);
}

void Viewer::on(const ChangeScreen& change, TimePoint now) {
    if (!change_screen(change, participant_))
        note(say(Phrase::not_in_room_any_more), now);
}

void Viewer::on(const LookBackTo& moment, TimePoint now) {
    look_back(moment.ago, now);
}

void Viewer::on(const ChooseTool& chosen, TimePoint now) {
    points_ = false;
    tools_.choose(chosen.tool, scene_.meeting());
    if (!headset_)
        return;
    open_plate(Sheet::none);
    note(say(viewer::name_of(chosen.tool)), now);
}

void Viewer::on(const ChangeMarks& change, TimePoint now) {
    if (!change.change(participant_))
        note(say(Phrase::no_such_mark), now);
}

void Viewer::on(const AskToOpen& asked, TimePoint) {
    asked_case_ = asked.offered;
    patient_is_asked_ = participant_.ask_patient(asked.offered);
}

void Viewer::on(const LeaveClosed&, TimePoint) {
    asked_case_.reset();
}

void Viewer::on(const OpenOffered& opened, TimePoint) {
    constexpr double before_eye_m = 0.9, below_eye_m = 0.1;
    asked_case_.reset();
    const Pose eye = own_eye();
    open_case(participant_, opened.offered, eye * Vec3{0, below_eye_m, before_eye_m},
              eye.translation);
}

void Viewer::on(const ShowLarge& shown, TimePoint) {
    large_ = large_ == shown ? std::nullopt : std::optional(shown);
}

void Viewer::on(const Call& asked, TimePoint now) {
    call(asked.begins, now);
}

void Viewer::on(const AnswerCall& answer, TimePoint now) {
    answer_call(answer.person, answer.comes, now);
}

void Viewer::on(const GoToPerson& person, TimePoint now) {
    go_to_person(person.person, now);
}

void Viewer::on(const GoToPlace& place, TimePoint now) {
    bring(place.place.room_from_eye);
    note(place.place.name, now);
}

void Viewer::on(const ShowScreen& shown, TimePoint now) {
    screen_offer_.close(shown.screen);
    const auto& objects = scene_.meeting().room().objects;
    const auto screen = session::shared_screen_of(objects, shown.screen);
    if (!screen)
        return note(say(Phrase::not_in_room_any_more), now);
    bring(in_front_of(place_of(objects.at(shown.screen), *screen)));
    note(screen->name, now);
}

void Viewer::on(const CloseScreenOffer& offer, TimePoint) {
    screen_offer_.close(offer.screen);
}

void Viewer::on(const LookThrough& through, TimePoint now) {
    stop_following();
    scene_changed_ = true;
    const room::RoomPerson* person = scene_.meeting().person(through.person);
    if (!person)
        return note(say(Phrase::person_has_left), now);
    followed_ = through.person;
    note(say(Phrase::through_eyes_of, person->name), now);
}

}  // namespace theatron::viewer
