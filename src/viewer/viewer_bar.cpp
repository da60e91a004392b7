// SPDX-License-Identifier: Apache-2.0
// The bar of buttons of the window, the panel that one of them opens, and notices with buttons.
#include <algorithm>
#include <utility>

#include "phrases/phrase.h"
#include "session/permissions.h"
#include "viewer/bar_items.h"
#include "viewer/panels/tool_panel.h"
#include "viewer/screen_panel.h"
#include "viewer/viewer.h"
#include "wire/sentence.h"

namespace theatron::viewer {
namespace {

window::Action action_of(window::ToolIcon item) {
    switch (item) {
        case window::ToolIcon::microphone:
            return window::Action::microphone;
        case window::ToolIcon::webcam:
            return window::Action::own_face;
        case window::ToolIcon::point:
            return window::Action::point;
        case window::ToolIcon::draw:
            return window::Action::marks;
        case window::ToolIcon::patient_case:
            return window::Action::show_case;
        case window::ToolIcon::people:
            return window::Action::people;
        case window::ToolIcon::leave:
            return window::Action::leave_session;
        case window::ToolIcon::more:
            break;
    }
    return window::Action::more;
}

}  // namespace

Sheet Viewer::sheet() const {
    return shows_panels_           ? Sheet::people
           : shows_case_           ? Sheet::patient_case
           : tools_.any()          ? Sheet::draw
           : adjusting_.is_shown() ? Sheet::adjust
                                   : sheet_;
}

bool Viewer::shows_sound() const {
    return options_.one_panel ? sheet_ == Sheet::sound : shows_panels_;
}

// Closes all others.
void Viewer::open_sheet(Sheet sheet) {
    shows_panels_ = sheet == Sheet::people;
    shows_case_ = sheet == Sheet::patient_case;
    if (sheet != Sheet::draw && tools_.any()) {
        tools_.choose(ToolKind::none, scene_.meeting());
        scene_changed_ = true;
    }
    if (sheet != Sheet::adjust)
        adjusting_.show(false);
    if (sheet != Sheet::chat)
        chat_.end();
    sheet_ = sheet > Sheet::adjust ? sheet : Sheet::none;
}

// A key has opened or closed a panel: what was open before gives way to it.
void Viewer::keep_one_panel(Sheet before) {
    if (!options_.one_panel)
        return;
    const bool is_open[] = {shows_panels_, shows_case_, tools_.any(), adjusting_.is_shown(),
                            sheet_ != Sheet::none};
    const Sheet sheets[] = {Sheet::people, Sheet::patient_case, Sheet::draw, Sheet::adjust, sheet_};
    for (std::size_t i = 0; i < std::size(sheets); ++i)
        if (is_open[i] && sheets[i] != before)
            return open_sheet(sheets[i]);
}

void Viewer::toggle_sheet(Sheet sheet) {
    open_sheet(this->sheet() == sheet ? Sheet::none : sheet);
}

void Viewer::ask_leave(TimePoint now, Duration within) {
    leave_asked_until_ = now + within;
}

void Viewer::remark(const std::string& text, TimePoint now) {
    std::vector<std::string> names;
    std::uint64_t generation = 0;
    for (const auto& camera : participant_.cameras(generation))
        names.push_back(camera.description.name);
    if (unrest_.tells(text, names, now))
        note(text, now);
}

void Viewer::add_tools(Facts& facts, RoomPanel& panel, TimePoint now) const {
    const auto& status = facts.received.status;
    BarFacts bar;
    bar.joined = status.phase == client::Participant::Phase::joined;
    bar.role = status.standing.role;
    bar.muted = status.standing.muted;
    bar.microphone = voices_.microphone;
    bar.own_face = own_face_;
    bar.points = points_;
    bar.draws = tools_.any();
    bar.shows_case = shows_case_;
    bar.shows_people = shows_panels_;
    bar.shows_more = sheet_ != Sheet::none && sheet_ != Sheet::details;
    bar.is_past = !facts.past.empty();
    bar.visitors = facts.visitors.size();
    bar.hands = raised_hands_of_others();
    bar.unseen = sheet() == Sheet::chat ? 0 : chat_.unseen(participant_.chat());
    bar.asks_leave = now < leave_asked_until_;
    window::ToolBar tools;
    const auto command = [&](window::Action action) { return panel.add(PressKey{action}); };
    tools.dot.command = command(window::Action::facts);
    for (const BarItem& item : bar_items(bar)) {
        tools.tools.push_back({item.id, say(item.label), say(item.hint), item.pressed, item.off,
                               item.alarm, item.badge, command(action_of(item.id))});
    }
    facts.tools = std::move(tools);
    facts.unrest = unrest_.count(now);
}

// Somebody at the door, a call, a shared screen, and the way back to the present.
void Viewer::add_offers(Facts& facts, RoomPanel& panel, TimePoint now) const {
    if (!facts.past.empty()) {
        add_look_back(facts, panel, now);
        facts.offers.push_back(std::move(panel.panels.back().rows.front()));
        facts.offers.back().detail.clear();
        panel.panels.pop_back();
    }
    if (may(session::Right::manage) && !facts.visitors.empty()) {
        using Action = wire::ManageAction;
        const wire::Visitor& first = facts.visitors.front();
        facts.offers.push_back(
            {say(Phrase::visitor_waits, first.name, wire::spoken(first)),
             facts.visitors.size() > 1
                 ? say(Phrase::more_visitors, std::to_string(facts.visitors.size() - 1))
                 : "",
             {panel.button(say(Phrase::let_in), Decide{Action::admit, first.participant, {}}),
              panel.button(say(Phrase::refuse),
                           Decide{Action::turn_away, first.participant, {}})}});
    }
    for (const room::RoomPerson& person : callers())
        facts.offers.push_back(
            {say(Phrase::person_calls_you, person.name),
             "",
             {panel.button(say(Phrase::go_there), AnswerCall{person.id, true}),
              panel.button(say(Phrase::stay_here), AnswerCall{person.id, false})}});
    if (screen_offer_.is_open(now) && facts.past.empty())
        facts.offers.push_back(screen_offer_.row(panel, now));
    add_tour(facts, panel);
}

void Viewer::add_tour(Facts& facts, RoomPanel& panel) const {
    if (tour_.step() == 0)
        return;
    using What = TourPress::What;
    window::PanelRow row{
        say(tour_text(tour_.step(), facts.received.status.standing.role)),
        say(Phrase::tour_count, std::to_string(tour_.step()), std::to_string(Tour::steps)),
        {}};
    if (tour_.step() < Tour::steps)
        row.buttons = {panel.button(say(Phrase::tour_next), TourPress{What::next}),
                       panel.button(say(Phrase::tour_skip), TourPress{What::skip})};
    else
        row.buttons = {panel.button(say(Phrase::tour_done), TourPress{What::next})};
    facts.offers.push_back(std::move(row));
}

void Viewer::add_more_panel(RoomPanel& panel) const {
    window::Panel more{say(Phrase::bar_more), {}};
    const auto row = [&](Phrase text, RoomCommand command) {
        more.rows.push_back(
            {say(text), "", {panel.button(say(Phrase::more_open), std::move(command))}});
    };
    const auto row_of_window = [&](Phrase text, window::Action key) {
        if (!headset_)
            row(text, PressKey{key});
    };
    row_of_window(Phrase::more_help, window::Action::help);
    if (participant_.has_chat()) {
        row(Phrase::messages, headset_ ? RoomCommand(ShowSheet{Sheet::chat})
                                       : RoomCommand(PressKey{window::Action::chat}));
        const bool raised = participant_.hand_raised();
        more.rows.push_back({say(raised ? Phrase::your_hand_is_up : Phrase::your_hand),
                             "",
                             {panel.button(say(raised ? Phrase::lower_hand : Phrase::raise_hand),
                                           RaiseHand{!raised})}});
    }
    row(Phrase::sound, ShowSheet{Sheet::sound});
    row_of_window(Phrase::more_pictures, window::Action::camera_pictures);
    row(Phrase::places, ShowSheet{Sheet::places});
    row(Phrase::screens, ShowSheet{Sheet::screens});
    if (participant_.can_look_back())
        row(Phrase::look_back_alone, ShowSheet{Sheet::look_back});
    row_of_window(Phrase::more_details, window::Action::facts);
    row_of_window(Phrase::more_home, window::Action::own_view);
    row_of_window(Phrase::more_full_screen, window::Action::full_screen);
    row_of_window(Phrase::more_save, window::Action::save_picture);
    if (may(session::Right::adjust))
        row(Phrase::more_adjust, PressKey{window::Action::adjust_cameras});
    if (!headset_)
        row(Phrase::show_tour, TourPress{TourPress::What::begin});
    panel.panels.push_back(std::move(more));
}

void Viewer::add_tool_choice(const Facts& facts, RoomPanel& panel) const {
    add_tool_panel(
        {tools_.chosen(), scene_.meeting().case_scene().in_room().has_value(), headset_.has_value(),
         facts.received.status.standing.role == wire::Role::operator_},
        panel);
}

void Viewer::add_sheet(Sheet sheet, const Facts& facts, RoomPanel& panel, TimePoint now) {
    switch (sheet) {
        case Sheet::none:
        case Sheet::details:  // overlay_of() adds it
            break;
        case Sheet::people: {
            RoomPanelFacts people = people_facts(facts, now);
            if (headset_) {  // it has no offers above the picture
                people.visitors = facts.visitors;
                panel = joined(std::move(panel), call_panel(callers()));
            }
            panel = joined(std::move(panel), room_panel(people));
            break;
        }
        case Sheet::patient_case:
            // Its buttons would change the present by what is shown of the past.
            if (facts.past.empty())
                add_case(panel);
            break;
        case Sheet::draw:
            if (facts.past.empty())
                add_tool_choice(facts, panel);
            break;
        case Sheet::adjust:
            adjusting_.add_panel(panel);
            break;
        case Sheet::more:
            add_more_panel(panel);
            break;
        case Sheet::sound:
            add_sound_panel(sound_choices_, panel);
            break;
        case Sheet::places: {
            const std::vector<Place> places = places_of(cameras());
            add_places_panel(places, panel);
            if (places.empty())
                panel.panels.back().rows.push_back({say(Phrase::more_no_places), "", {}});
            break;
        }
        case Sheet::screens: {
            const std::size_t before = panel.panels.size();
            add_screens(facts, panel);
            if (panel.panels.size() == before)
                panel.panels.push_back(
                    {say(Phrase::screens), {{say(Phrase::more_no_screens), "", {}}}});
            break;
        }
        case Sheet::look_back:
            add_look_back(facts, panel, now);
            break;
        case Sheet::chat:
            add_chat(panel);
            break;
        case Sheet::study:
            study_.add_panel(panel, now);
            break;
    }
}

void Viewer::add_chat(RoomPanel& panel) {
    ChatPanelFacts facts{participant_.chat(), participant_.now(), participant_.may_write(),
                         !headset_};
    chat_.note_seen(facts.chat);
    chat_.add_panel(facts, panel);
}

std::size_t Viewer::raised_hands_of_others() const {
    const auto hands = participant_.raised_hands();
    return std::size_t(std::count_if(hands.begin(), hands.end(), [&](const auto& hand) {
        return hand.person != participant_.room_self();
    }));
}

}  // namespace theatron::viewer
