// SPDX-License-Identifier: Apache-2.0
#include "viewer/viewer.h"

#include <algorithm>
#include <utility>

#include "base/error.h"
#include "phrases/phrase.h"
#include "session/permissions.h"
#include "session/whose_camera.h"
#include "viewer/refusal_text.h"
#include "viewer/screen_panel.h"
#include "viewer/tools/mark_actions.h"
#include "wire/manage_text.h"

namespace theatron::viewer {
namespace {

constexpr Duration pose_interval = std::chrono::milliseconds(15);
constexpr Duration pose_repeated_after = std::chrono::milliseconds(500);
// A picture that is presented for longer than this gets older with time.
constexpr double repeated_picture_ms = 500;

}  // namespace

Viewer::Viewer(Options options, client::Participant& participant)
    : options_(std::move(options)),
      participant_(participant),
      scene_(options_.room, options_.people),
      eye_(options_.view),
      tour_(options_.tour_is_due),
      choice_(options_.renderer),
      pace_(pace::automatic_ways(1, options_.scale)),
      rest_(!options_.has_gpu),
      sits_(options_.sits),
      shows_panels_(options_.shows_people),
      line_(options_.shows_facts) {
    scene_.set_ages_shown(line_);
}

client::Settings Viewer::settings(client::Settings before) const {
    before.renderer = options_.renderer;
    before.sits = sits_;
    before.shows_people = shows_panels_;
    before.shows_facts = line_;
    before.tour_seen = tour_.is_seen();
    return before;
}

void Viewer::note(const std::string& text, TimePoint now) {
    notice_.say(text, now);
}

void Viewer::on_input(window::WindowInput input, std::optional<double> grabbed_m, Size picture,
                      TimePoint now) {
    mouse_ = input.pointer_covered ? std::nullopt : input.pointer;
    picture_ = picture;
    tell_refusals(now);
    const bool is_past = scene_.past_moment().has_value();
    if (is_past)
        keep_present(input, now);
    else
        draw_region(input, picture, now);
    use_tool(input, picture, now);
    if (points_ && !is_past && !input.pointer_covered)
        input.points = true;
    point(input, picture);
    if (eye_.is_placed() && (!is_past || handling_.holds()))
        handling_.on_input(input, input.steering.fast || tools_.takes_parts(), grabbed_m,
                           double(picture.width) / picture.height, eye_.view(picture),
                           scene_.meeting(), participant_, now);
    if (const std::string text = handling_.take_note(); !text.empty())
        note(text, now);
    scene_changed_ = scene_changed_ || input.redraw;
    for (const window::KeyPress& key : input.keys) {
        if (key.action == window::Action::slice_here)
            show_slice_at(input, picture, now);
        on_key(key, picture, now);
    }
    aim_teleport(input, picture);
    if (input.steering.moves())
        stop_following();
    if (input.grabbed && grabbed_m)
        eye_.grab(*input.grabbed, *grabbed_m, picture);
    if (eye_.steer(input.steering, picture, now))
        scene_changed_ = true;
}

void Viewer::tell_refusals(TimePoint now) {
    while (const auto refusal = participant_.take_room_refusal())
        if (const std::string text = text_of(refusal->second); !text.empty())
            note(text, now);
}

namespace {

std::optional<StudyKey> study_key(const window::KeyPress& key) {
    using What = StudyKey::What;
    switch (key.action) {
        case window::Action::view_camera:
            return StudyKey{What::digit, key.camera + 1};
        case window::Action::from_above:
            return StudyKey{What::digit, 0};
        case window::Action::smaller_points:
            return StudyKey{What::minus};
        case window::Action::undo_mark:
            return StudyKey{What::erase};
        case window::Action::press_control:
            return StudyKey{What::go_on};
        default:
            return std::nullopt;
    }
}

}  // namespace

void Viewer::on_key(const window::KeyPress& key, Size picture, TimePoint now) {
    // Digits and Return reply to a step of a study while it is shown.
    if (const auto of_study = study_key(key))
        if (const auto press = study_.press_of(*of_study, now))
            return on(*press, now);
    const Sheet before = sheet();
    carry_out(key, picture, now);
    keep_one_panel(before);
}

void Viewer::carry_out(const window::KeyPress& key, Size picture, TimePoint now) {
    switch (key.action) {
        case window::Action::help:
            help_ = !help_;
            break;
        case window::Action::facts:
            // Another panel may have closed that of the facts.
            line_ = options_.one_panel ? sheet() != Sheet::details : !line_;
            scene_.set_ages_shown(line_);
            scene_changed_ = true;
            if (options_.one_panel)
                toggle_sheet(Sheet::details);
            break;
        case window::Action::point:
            points_ = !points_;
            if (points_ && tools_.any()) {  // the mouse does one of both
                tools_.choose(ToolKind::none, scene_.meeting());
                scene_changed_ = true;
            }
            break;
        case window::Action::more:
            toggle_sheet(sheet_ == Sheet::none || sheet_ == Sheet::details ? Sheet::more : sheet_);
            break;
        case window::Action::chat:
            if (!participant_.may_write() && participant_.chat().messages.empty()) {
                note(say(Phrase::may_not_write), now);
                break;
            }
            toggle_sheet(Sheet::chat);
            if (sheet() == Sheet::chat && participant_.may_write())
                chat_.begin();
            break;
        case window::Action::raise_hand:
            on(RaiseHand{!participant_.hand_raised()}, now);
            break;
        case window::Action::next_renderer:
            choose_next_renderer(now);
            break;
        case window::Action::next_depth_codec:
            choose_next_depth_codec(now);
            break;
        case window::Action::next_color_codec:
            choose_next_color_codec(now);
            break;
        case window::Action::people:
            shows_panels_ = !shows_panels_;
            break;
        case window::Action::show_case:
            shows_case_ = !shows_case_;
            break;
        case window::Action::marks:
            points_ = false;
            tools_.choose(tools_.any() ? ToolKind::none : ToolKind::stroke, scene_.meeting());
            scene_changed_ = true;
            break;
        case window::Action::undo_mark:
            if (!give_up_mark() && !undo_mark(participant_))
                note(say(Phrase::no_own_mark), now);
            break;
        case window::Action::leave:
            (void)give_up_mark();
            break;
        case window::Action::slice_here:
            break;  // needs the mouse: show_slice_at()
        case window::Action::sit_or_stand:
            if (!eye_.is_placed())
                break;
            sits_ = !sits_;
            stop_following();
            scene_changed_ = true;
            { eye_.go_to(at_eye_height(eye_.view(picture).room_from_eye)); }
            note(say(sits_ ? Phrase::sitting : Phrase::standing), now);
            break;
        case window::Action::own_view:
        case window::Action::view_camera:
            go_home(key, picture, now);
            break;
        case window::Action::camera_pictures:
            camera_pictures_ =
                camera_pictures_ ? std::nullopt : std::optional<CameraPictures>(std::in_place);
            large_.reset();
            break;
        case window::Action::from_above:
            view_from_above(now);
            break;
        case window::Action::larger_points:
        case window::Action::smaller_points:
            change_point_size(key.action == window::Action::larger_points ? 1.25 : 1 / 1.25, now);
            break;
        case window::Action::freeze:
            freeze(now);
            break;
        case window::Action::pause_recording:
        case window::Action::seek_back:
        case window::Action::seek_forward:
        case window::Action::live:
        case window::Action::adjust_cameras:
        case window::Action::nudge:
            on_camera_key(key, picture, now);
            break;
        case window::Action::call:
            call(!is_calling(now), now);
            break;
        case window::Action::come:
            if (const auto people = callers(); !people.empty())
                answer_call(people.front().id, true, now);
            else
                note(say(Phrase::nobody_calls), now);
            break;
        case window::Action::admit:
            decide_on_visitor(wire::ManageAction::admit, now);
            break;
        case window::Action::turn_away:
            decide_on_visitor(wire::ManageAction::turn_away, now);
            break;
        case window::Action::new_brick:
        case window::Action::give:
        case window::Action::remove:
        case window::Action::full_screen:
        case window::Action::microphone:
        case window::Action::push_to_talk:
        case window::Action::voice_recording:
        case window::Action::own_face:
        case window::Action::save_picture:
        case window::Action::save_points:
        case window::Action::leave_session:
        case window::Action::next_control:
        case window::Action::previous_control:
        case window::Action::press_control:
            break;  // the first three are of objects (handling.h), the others of the window
    }
}

// The arc begins below the eye, so that it is seen from above.
void Viewer::aim_teleport(const window::WindowInput& input, Size picture) {
    constexpr Vec3 hand_from_eye{0.15, 0.3, 0.1};
    if (!eye_.is_placed() || !scene_.free_space())
        return;
    const render::CameraView view = eye_.view(picture);
    const bool was_aiming = arc_.has_value();
    if (input.aims_teleport) {
        const render::PickRay ray = render::ray_through(view, input.pointer.value_or(Vec2{.5, .5}));
        arc_ = room::teleport_arc(*scene_.free_space(), view.room_from_eye * hand_from_eye,
                                  ray.direction);
    } else if (was_aiming) {
        if (arc_->landing) {
            stop_following();
            eye_.go_to(room::standing_at(*arc_->landing, view.room_from_eye,
                                         sits_ ? room::sitting_eyes_m : room::standing_eyes_m));
        }
        arc_.reset();
    }
    if (was_aiming || arc_) {
        scene_.meeting().set_arc(arc_);
        scene_changed_ = true;
    }
}

void Viewer::press(int command, TimePoint now) {
    if (command >= 0 && command < int(commands_.size()))
        carry_out(RoomCommand(commands_[std::size_t(command)]), now);
}

void Viewer::stop_following() {
    followed_.reset();
}

// The numbers of participants grow, so the first one has waited longest.
void Viewer::decide_on_visitor(wire::ManageAction action, TimePoint now) {
    const auto visitors = participant_.visitors();
    if (visitors.empty())
        return note(say(Phrase::nobody_waits), now);
    const wire::Visitor& first = visitors.front();
    participant_.manage(action, first.participant);
    note(say(action == wire::ManageAction::admit ? Phrase::you_let_in : Phrase::you_turned_away,
             first.name),
         now);
}

void Viewer::follow_host(TimePoint now) {
    const auto command = participant_.take_renderer_command();
    if (!command)
        return;
    const session::RendererChoice before = choice_;
    if (const std::string problem = viewer::follow_host(choice_, *command); !problem.empty())
        return note(problem, now);
    if (choice_.renderer() != before.renderer() || choice_.locked() != before.locked())
        note(choice_.locked() || !before.locked() ? say(Phrase::host_has_set, choice_.renderer())
                                                  : say(Phrase::drawing_is_yours),
             now);
    choose_pace();
}

// A new step shows itself, also where its panel was put aside.
void Viewer::follow_study(TimePoint now) {
    if (study_.take(participant_.study(), now) && headset_)
        open_plate(Sheet::study);
    if (plate_ == Sheet::study && !study_.is_on())
        open_plate(Sheet::none);
}

// Restarts the choice of a drawing mode if the list of modes has changed.
void Viewer::choose_pace() {
    auto ways = choice_.renderer() == automatic
                    ? pace::automatic_ways(scene_.calibrations().size(), options_.scale)
                    : pace::ways_of(choice_.renderer(), options_.scale);
    if (ways == pace_.ways())
        return;
    begin_pace(std::move(ways));
}

void Viewer::begin_pace(std::vector<pace::DrawingWay> ways) {
    const std::size_t begin = headset_           ? pace::begin_with_headset(ways, way())
                              : options_.has_gpu ? 0
                                                 : pace::begin_without_gpu(ways);
    pace_ = pace::DrawingPace(std::move(ways), begin, pace_limits_);
    scene_changed_ = true;
}

bool Viewer::step(Size picture, TimePoint now) {
    const auto status = participant_.status();
    if (status.phase == client::Participant::Phase::refused && status.joins == 0)
        throw Error(status.problem);
    follow_host(now);
    follow_study(now);
    follow_receiving(now);
    const bool rests = rests_at(now);
    if (!rests)
        take_pictures(now);
    // A host that came back may have fewer cameras than before.
    if (eye_.follow(cameras(), status.joins == 1, picture, now))
        scene_changed_ = true;
    if (scene_.take_meeting(participant_)) {
        scene_changed_ = true;
        screen_offer_.follow(scene_.meeting().room().objects, scene_.meeting().room().self, now);
    }
    if (const auto place = meeting_place(); place && !eye_.is_placed()) {
        eye_.stand(at_eye_height(*place));
        scene_changed_ = true;
    }
    forget_answered();
    while (const auto answer = participant_.take_managed())
        if (answer->refusal != wire::ManageRefusal::none) {
            note(wire::text_of(answer->refusal), now);
            adjusting_.give_up();
        }
    follow_cameras(now);
    eye_.set_space(scene_.free_space());
    look_through_followed(now);
    moving_ = scene_.meeting().is_moving(participant_.session_time(now));
    send_own_pose(picture, now);
    if (first_picture_at_ == TimePoint{} && eye_.is_placed())
        first_picture_at_ = now;
    note_unseen_people(now);
    participant_.tell_renderer(way().renderer);
    return scene_changed_ && eye_.is_placed() && !rests;
}

Pose Viewer::at_eye_height(Pose room_from_eye) const {
    room_from_eye.translation.y = sits_ ? room::sitting_eyes_m : room::standing_eyes_m;
    return room_from_eye;
}

// In a meeting without cameras.
std::optional<Pose> Viewer::meeting_place() const {
    const ParticipantId self = scene_.meeting().room().self;
    if (!scene_.is_without_cameras() || self == ParticipantId{})
        return std::nullopt;
    return room::meeting_place(self);
}

// Sends the pose of the eye as this person's head, again before an unchanged pose is stale.
void Viewer::send_own_pose(Size picture, TimePoint now) {
    if (!eye_.is_placed())
        return;
    const Pose eye = headset_ ? headset_->head().room_from_eye : eye_.view(picture).room_from_eye;
    // With a headset hands move, too.
    const bool is_same = !headset_ && eye == sent_pose_ && is_calling(now) == sent_call_ &&
                         !pointer_ && !sent_pointing_;
    if (now - pose_sent_ < (is_same ? pose_repeated_after : pose_interval))
        return;
    pose_sent_ = now;
    sent_pose_ = eye;
    sent_call_ = is_calling(now);
    const TimePoint time = participant_.session_time(now);
    wire::PersonPose pose = headset_ ? headset_->pose(time) : pose_of_eye(eye, time);
    pose.calls = sent_call_;
    if (!headset_)
        add_pointing(pose);
    participant_.send_pose(pose);
}

std::string Viewer::camera_text(CameraId camera) const {
    std::uint64_t generation = 0;
    for (const auto& known : participant_.cameras(generation))
        if (known.description.id == camera && !known.description.name.empty())
            return say(Phrase::camera_called, name_of(known));
    // As the keys 1 to 9 count.
    return say(Phrase::camera_number, std::to_string(int(camera) + 1));
}

std::string Viewer::name_of(const client::Participant::Camera& camera) const {
    return session::whose_camera(camera.description, scene_.meeting().room().objects);
}

void Viewer::draw(Size picture, const render::DrawTarget& target, TimePoint now) {
    const render::CameraView view = eye_.view(picture);
    draw_eyes(view, {{view, target}}, now);
}

void Viewer::draw_eyes(const render::CameraView& head, std::vector<render::EyePicture> eyes,
                       TimePoint now) {
    scene_changed_ = false;
    const std::string wanted = way().renderer;
    scene_.set_depth_step(way().depth_step);
    try {
        scene_.draw(head, std::move(eyes), wanted);
        working_renderer_ = wanted;
    } catch (const Error& e) {
        if (working_renderer_.empty() || working_renderer_ == wanted)
            throw;
        note(e.what(), now);
        choice_.follow({working_renderer_, choice_.locked()});
        choose_pace();
    }
}

void Viewer::on_presented(TimePoint begin, Duration processor, TimePoint end) {
    pace_.add(end, end - begin);
    rest_.add(begin, processor);
    drawn_.add(end);
    ++pictures_;
    notice_.begin(end);
    const std::set<CameraId> updated = std::exchange(updated_, {});
    if (updated.empty())
        return;
    // The session's time is known once the host has answered.
    if (participant_.status().round_trip == Duration{})
        return;
    const TimePoint presented = participant_.session_time(end);
    // Screens and faces tell their ages themselves.
    std::optional<double> age_ms;
    bool is_past = false;
    for (const CameraId camera : updated)
        if (const auto frame = scene_.newest().find(camera);
            frame != scene_.newest().end() && scene_.is_drawn(camera)) {
            age_ms = std::max(age_ms.value_or(0), to_ms(presented - frame->second->times.captured));
            is_past = is_past || frame->second->past;
        }
    if (!age_ms)
        return;
    presented_at_ = end;
    age_at_presentation_ms_ = age_ms;
    if (std::exchange(presented_past_, is_past) != is_past)
        ages_ms_.clear();
    ages_ms_.add(*age_ms);
    if (!is_past)
        all_ages_ms_.add(*age_ms);
}

Facts Viewer::facts(TimePoint now) {
    Facts facts;
    facts.received = client::figures_of(participant_);
    for (client::CameraFigures& one : facts.received.cameras)
        one.camera.description.name = name_of(one.camera);
    // Faces are people, not cameras of the room.
    std::erase_if(facts.received.cameras, [](const client::CameraFigures& one) {
        return one.camera.description.kind == wire::CameraKind::face;
    });
    facts.visitors = participant_.visitors();
    facts.has_picture = eye_.is_placed();
    if (age_at_presentation_ms_) {
        const double since_ms = to_ms(now - presented_at_);
        facts.age_ms = since_ms > repeated_picture_ms ? *age_at_presentation_ms_ + since_ms
                                                      : ages_ms_.percentile(0.5);
    }
    if (const auto skew = scene_.same_moment().skew(participant_.now()))
        facts.skew_ms = to_ms(*skew);
    facts.drawn_per_second = drawn_.per_second(now);
    facts.drawing_rests = !headset_ && rest_.step() > 0;
    facts.way = way();
    facts.renderer_chosen_by = choice_.locked()                  ? Facts::ChosenBy::host
                               : choice_.renderer() == automatic ? Facts::ChosenBy::program
                                                                 : Facts::ChosenBy::person;
    facts.notice = notice_.text(now);
    facts.help = help_;
    facts.frozen = frozen_;
    RoomPanel panel;
    facts.past = past(now);
    facts.played = played(now);
    // A question about a case is asked anew when its panel opens again, and over a new connection.
    if ((!shows_case_ && plate_ != Sheet::patient_case) || !facts.past.empty() ||
        facts.received.status.phase != client::Participant::Phase::joined)
        asked_case_.reset();
    study_.add_panel(panel, now);
    if (options_.one_panel) {
        tour_.follow(facts.received.status.phase == client::Participant::Phase::joined &&
                     facts.has_picture && !headset_);
        add_tools(facts, panel, now);
        add_offers(facts, panel, now);
        add_sheet(sheet(), facts, panel, now);
    } else {
        add_open_panels(facts, panel, now);
    }
    facts.rectangle = adjusting_.rectangle();
    facts.bar = playing_.bar(participant_, may(session::Right::play), now, panel);
    if (tools_.any() && !options_.one_panel)
        add_tool_choice(facts, panel);
    add_camera_pictures(facts, panel, now);
    facts.pointed = pointed_text();
    facts.panels = std::move(panel.panels);
    commands_ = std::move(panel.commands);
    facts.line = line_;
    facts.voices = voices_;
    facts.own_face = own_face_;
    facts.trust = options_.one_panel ? sheet() == Sheet::details : shows_panels_;
    return facts;
}

RoomPanelFacts Viewer::people_facts(const Facts& facts, TimePoint now) const {
    const wire::Role role = facts.received.status.standing.role;
    RoomPanelFacts people{scene_.meeting().room(), scene_.meeting().people(), {}, followed_};
    people.is_operator = role == wire::Role::operator_;
    people.may_call = session::may(role, session::Right::point);
    people.is_calling = is_calling(now);
    people.speaking = voices_.speaking;
    people.asked = removal_.asked(now);
    people.may_go = !scene_.has_real_room();
    people.may_look_through = !headset_;
    if (participant_.has_chat())
        people.hand_raised = participant_.hand_raised();
    return people;
}

void Viewer::add_screens(const Facts& facts, RoomPanel& panel) const {
    const client::Participant::Room& room = scene_.meeting().room();
    ScreenPanelFacts screens{&room.objects, room.self, facts.received.status.standing.role, {}};
    for (const room::RoomPerson& person : scene_.meeting().people())
        screens.names[person.id] = person.name;
    add_screen_panel(screens, panel);
}

void Viewer::add_look_back(const Facts& facts, RoomPanel& panel, TimePoint now) const {
    looking_back_.add_panel(facts.past, scene_.meeting().knows_shown_moment(), participant_, now,
                            panel);
}

void Viewer::add_open_panels(const Facts& facts, RoomPanel& panel, TimePoint now) {
    // The way back to the present comes first. Panels that others bring about come below people and
    // places, which stay where they are.
    if (!facts.past.empty())
        add_look_back(facts, panel, now);
    if (shows_panels_) {
        RoomPanelFacts people = people_facts(facts, now);
        people.places = places_of(cameras());
        people.visitors = facts.visitors;
        people.own_face = own_face_;
        panel = joined(std::move(panel), room_panel(people));
        add_screens(facts, panel);
        add_sound_panel(sound_choices_, panel);
        if (facts.past.empty() && participant_.can_look_back())
            add_look_back(facts, panel, now);
    }
    panel = joined(std::move(panel), call_panel(callers()));
    if (screen_offer_.is_open(now) && facts.past.empty())
        panel.panels.push_back({say(Phrase::shared_screen), {screen_offer_.row(panel, now)}});
    // Its buttons would change the present by what is shown of the past.
    if (shows_case_ && facts.past.empty())
        add_case(panel);
    if (adjusting_.is_shown())
        adjusting_.add_panel(panel);
}

}  // namespace theatron::viewer
