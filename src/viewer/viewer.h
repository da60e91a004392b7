// SPDX-License-Identifier: Apache-2.0
// A person's view of a session: takes over new frames, follows input, draws.
//
// A viewer has no loop, no window, no thread and no clock: the program that shows it (a window, a
// headset, a browser, a file) owns these and passes time in.
#pragma once

#include <memory>
#include <optional>
#include <set>
#include <string>

#include "base/statistics.h"
#include "client/participant.h"
#include "client/settings.h"
#include "pace/drawing_pace.h"
#include "pace/drawing_rest.h"
#include "render/vignette.h"
#include "session/permissions.h"
#include "session/renderer_choice.h"
#include "viewer/adjust_panel.h"
#include "viewer/camera_pictures.h"
#include "viewer/camera_unrest.h"
#include "viewer/eye.h"
#include "viewer/facts.h"
#include "viewer/handling.h"
#include "viewer/headset.h"
#include "viewer/live_scene.h"
#include "viewer/looking_back.h"
#include "viewer/notice.h"
#include "viewer/panels/chat_panel.h"
#include "viewer/playing.h"
#include "viewer/removal_question.h"
#include "viewer/renderer_text.h"
#include "viewer/screen_offer.h"
#include "viewer/sheet.h"
#include "viewer/shown_moment.h"
#include "viewer/sound_panel.h"
#include "viewer/study_panel.h"
#include "viewer/tools/tool.h"
#include "viewer/tour.h"
#include "window/window_input.h"

namespace theatron::viewer {

// Use from one thread, with the same GL context current, also in the destructor.
class Viewer {
public:
    struct Options {
        ViewChoice view;
        RoomChoice room;
        std::vector<SeenPerson> people;
        std::string renderer = automatic;
        bool sits = false, shows_people = false, shows_facts = true;  // as in client::Settings
        // A window with a bar of buttons, which shows one panel at a time; else facts() has all
        // panels that are open, and no bar.
        bool one_panel = false;
        bool tour_is_due = false;  // of a window with a bar
        bool has_gpu = true;       // false: begins with what a processor draws
        double scale = 0;          // of the target's pixels to draw; 0: chosen by drawing time
        std::string depth_codec, color_codec;  // that the participant requested
    };

    // `participant` must outlive the viewer.
    Viewer(Options options, client::Participant& participant);

    // Keys that concern the scene, objects of the room, and steering. `grabbed_m` is the distance
    // of the surface at input.grabbed, along the view's axis, if there is one.
    void on_input(window::WindowInput input, std::optional<double> grabbed_m, Size picture,
                  TimePoint now);
    // A button of the panels that facts() gave last.
    void press(int command, TimePoint now);
    // The keyboard writes a message: its letters come to type() in place of on_input().
    bool takes_text() const { return chat_.is_writing(); }
    void type(const window::FormKeyPress& press, TimePoint now);
    // The keys that pressed buttons stand for, since the last call: the program acts as if they
    // came from the keyboard, and gives those of the viewer back to on_input().
    std::vector<window::KeyPress> take_pressed() { return std::exchange(pressed_, {}); }
    // A slider of these panels is held from press() on, and now has this value.
    void slide(double value);

    // Takes over the session's changes. `picture` is the size of the target in pixels. True if the
    // scene must be drawn again, and drawing does not rest (xr/drawing_rest.h). Throws Error if the
    // host refused this participant, or if the camera of the chosen view does not exist.
    bool step(Size picture, TimePoint now);

    // With RoomChoice::in_steps: a step of the work on the room, some milliseconds. See LiveScene.
    // Does nothing in two calls of three while drawing rests for decoding.
    void prepare(bool gpu_is_idle);

    // Needs facts().has_picture. Draws into a cleared target that has way().scale of `picture` on
    // each side. If the driver cannot run a renderer, the previous one is used again; Error if
    // there is none.
    void draw(Size picture, const render::DrawTarget& target, TimePoint now);
    const pace::DrawingWay& way() const { return pace_.way(); }
    // True once after a step() that made cameras, which takes as long as a picture: a page draws in
    // its next event.
    bool take_made_cameras() { return scene_.take_made_cameras(); }

    // Until leave_headset() the person is in the room with a headset that shows `pictures_per_s`:
    // VR, or with the real room around them. Needs facts().has_picture.
    void enter_headset(bool real_room, double pictures_per_s, TimePoint now);
    // The view goes on where the person stood.
    void leave_headset();
    bool has_headset() const { return headset_.has_value(); }
    // As Headset::on_space_moved().
    void on_headset_space_moved(const std::optional<Pose>& before_from_now);
    // For the menu.
    void set_microphone_open(bool open) { microphone_open_ = open; }
    // The choice of the person in the menu since the last call that the program carries out:
    // microphone or leave.
    std::optional<MenuAction> take_headset_wish() {
        return std::exchange(headset_wish_, std::nullopt);
    }
    // In place of on_input(), before step() and draw_headset() of the same frame.
    void on_headset(const xr::HeadsetFrame& frame, TimePoint now);
    // In place of draw(): into the eyes' parts of a cleared framebuffer.
    void draw_headset(const xr::HeadsetFrame& frame, TimePoint now);

    // The view without texts and panels, at this size; needs facts().has_picture. Waits for
    // the GPU.
    ColorImage picture(Size size);
    // As LiveScene::points().
    std::vector<ColoredPoint> points() const { return scene_.points(); }

    // The moment of both.
    ShownMoment shown_moment(TimePoint now) const;

    // The picture that was drawn since `begin` is on screen at `end`. `processor` is its time of
    // the processor: all of it, or where a graphics card draws that of the commands alone.
    void on_presented(TimePoint begin, Duration processor, TimePoint end);
    // True if no picture is drawn before this time, and no new frame is taken.
    bool rests_at(TimePoint now) const;

    // Facts for the user, at `now`.
    Facts facts(TimePoint now);
    // How the person's own face stands, and the person's choice in the panel since the last call,
    // which the program carries out.
    void set_own_face(OwnFace face) { own_face_ = face; }
    std::optional<bool> take_face_wish() { return std::exchange(face_wish_, std::nullopt); }
    // The devices to choose from, and the choice in the panel since the last call, which the
    // program carries out.
    void set_sound_choices(SoundChoices choices) { sound_choices_ = std::move(choices); }
    std::optional<UseSound> take_sound_wish() { return std::exchange(sound_wish_, std::nullopt); }
    // The person's choices by name, among renderer_choices() and video::depth_codec_names(). While
    // the host has set the renderer, choose_renderer() changes nothing; a text says so.
    const session::RendererChoice& renderer_choice() const { return choice_; }
    void choose_renderer(const std::string& renderer, TimePoint now);
    const std::string& depth_codec() const { return options_.depth_codec; }
    void choose_depth_codec(const std::string& codec, TimePoint now);
    // As Options::scale.
    double scale() const { return options_.scale; }
    void choose_scale(double scale);
    // The codec of colour that was requested last, and another one, which no text says.
    const std::string& color_codec() const { return options_.color_codec; }
    void choose_color_codec(const std::string& codec);
    // The newest voices, for the panels and the names of people.
    void set_voices(Voices voices);
    // Shows a line of text for some seconds.
    void note(const std::string& text, TimePoint now);
    // Drops the mark that the person is drawing. False: none is.
    bool give_up_mark();
    bool is_drawing() const { return tools_.follows_pointer(); }
    // The same for a remark of the participant; cameras that stand still again and again are only
    // counted (camera_unrest.h).
    void remark(const std::string& text, TimePoint now);
    // The next press within this time leaves: the bar says so.
    void ask_leave(TimePoint now, Duration within);
    // The sound's panel is open.
    bool shows_sound() const;
    // `before` with this person's newest choices.
    client::Settings settings(client::Settings before) const;
    // True while a fading camera, a moving person or a frame that waits for that of another camera
    // changes the picture by itself.
    bool is_animated() const { return fading_ || moving_ || scene_.same_moment().waits(); }
    // The person's eye in the room (x right, y down, z forward) as the others know it.
    const Pose& told_eye() const { return sent_pose_; }
    // The first moment that the scene could be drawn; TimePoint{} before.
    TimePoint first_picture_at() const { return first_picture_at_; }

    // Number of presented pictures, and the ages of their frames.
    std::uint64_t pictures() const { return pictures_; }
    const SampleWindow& ages_ms() const { return all_ages_ms_; }

private:
    void tell_refusals(TimePoint now);
    void on_key(const window::KeyPress& key, Size picture, TimePoint now);
    void carry_out(const window::KeyPress& key, Size picture, TimePoint now);
    void go_home(const window::KeyPress& key, Size picture, TimePoint now);
    void view_from_above(TimePoint now);
    void change_point_size(double factor, TimePoint now);
    void freeze(TimePoint now);
    void take_pictures(TimePoint now);
    void follow_receiving(TimePoint now);
    void add_camera_pictures(Facts& facts, RoomPanel& panel, TimePoint now);
    std::string pointed_text();
    void choose_next_renderer(TimePoint now);
    void choose_next_depth_codec(TimePoint now);
    void choose_next_color_codec(TimePoint now);
    void decide_on_visitor(wire::ManageAction action, TimePoint now);
    void follow_host(TimePoint now);
    void follow_study(TimePoint now);
    void choose_pace();
    void begin_pace(std::vector<pace::DrawingWay> ways);
    void send_own_pose(Size picture, TimePoint now);
    void follow_wish(const MenuRow& wish, TimePoint now);
    void open_plate(Sheet sheet);
    void show_plate(TimePoint now);
    void press_plate(int command, TimePoint now);
    Pose own_eye() const;
    void bring(const Pose& room_from_eye);
    void draw_eyes(const render::CameraView& head, std::vector<render::EyePicture> eyes,
                   TimePoint now);
    void aim_teleport(const window::WindowInput& input, Size picture);
    void look_through_followed(TimePoint now);
    void stop_following();
    std::optional<Pose> place_beside(ParticipantId id) const;
    void go_to_person(ParticipantId id, TimePoint now);
    // Commands of the panels' buttons.
    void carry_out(const RoomCommand& command, TimePoint now);
    void on(const StudyPress& press, TimePoint now);
    void on(const WriteText& text, TimePoint now);
    void on(const SendText& message, TimePoint now);
    void on(const RaiseHand& hand, TimePoint now);
    void on(const TourPress& press, TimePoint now);
    void on(const PressKey& key, TimePoint now);
    void on(const ShowSheet& opened, TimePoint now);
    void on(const Decide& decision, TimePoint now);
    void on(const ChangeCase& change, TimePoint now);
    void on(const AdjustStep& step, TimePoint now);
    void on(const ShowFace& face, TimePoint now);
    void on(const UseSound& sound, TimePoint now);
    void on(const PlayStep& step, TimePoint now);
    void on(const ChangeScreen& change, TimePoint now);
    void on(const ShowScreen& shown, TimePoint now);
    void on(const CloseScreenOffer& offer, TimePoint now);
    void on(const LookBackTo& moment, TimePoint now);
    void on(const ChooseTool& chosen, TimePoint now);
    void on(const ChangeMarks& change, TimePoint now);
    void on(const AskToOpen& asked, TimePoint now);
    void on(const LeaveClosed& left, TimePoint now);
    void on(const OpenOffered& opened, TimePoint now);
    void on(const ShowLarge& shown, TimePoint now);
    void on(const Call& call, TimePoint now);
    void on(const AnswerCall& answer, TimePoint now);
    void on(const GoToPerson& person, TimePoint now);
    void on(const GoToPlace& place, TimePoint now);
    void on(const LookThrough& person, TimePoint now);
    void call(bool begins, TimePoint now);
    void answer_call(ParticipantId person, bool comes, TimePoint now);
    void forget_answered();
    std::vector<room::RoomPerson> callers() const;  // whom the user has not answered
    bool is_calling(TimePoint now) const { return now < calls_until_; }
    std::optional<Pose> meeting_place() const;
    void use_tool(window::WindowInput& input, Size picture, TimePoint now);
    void press_with_tool(window::WindowInput& input, const ToolScene& scene);
    void point(const window::WindowInput& input, Size picture);
    void add_pointing(wire::PersonPose& pose);
    void on_camera_key(const window::KeyPress& key, Size picture, TimePoint now);
    void adjust_cameras(const window::KeyPress& key, Size picture, TimePoint now);
    void follow_cameras(TimePoint now);
    // Once, when the cameras have sent pictures: a person of the options who is not where they say.
    void note_unseen_people(TimePoint now);
    void draw_region(window::WindowInput& input, Size picture, TimePoint now);
    bool look_back(const window::KeyPress& key, TimePoint now);
    void keep_present(window::WindowInput& input, TimePoint now);
    void look_back(Duration ago, TimePoint now);
    std::string past(TimePoint now) const;
    std::string played(TimePoint now) const;
    bool may(session::Right right) const;
    Sheet sheet() const;
    void open_sheet(Sheet sheet);
    void toggle_sheet(Sheet sheet);
    void keep_one_panel(Sheet before);
    void add_tools(Facts& facts, RoomPanel& panel, TimePoint now) const;
    void add_offers(Facts& facts, RoomPanel& panel, TimePoint now) const;
    void add_tour(Facts& facts, RoomPanel& panel) const;
    void add_more_panel(RoomPanel& panel) const;
    void add_chat(RoomPanel& panel);
    std::size_t raised_hands_of_others() const;
    // Without places, visitors and the person's own face.
    RoomPanelFacts people_facts(const Facts& facts, TimePoint now) const;
    void add_screens(const Facts& facts, RoomPanel& panel) const;
    void add_look_back(const Facts& facts, RoomPanel& panel, TimePoint now) const;
    void add_open_panels(const Facts& facts, RoomPanel& panel, TimePoint now);
    void add_sheet(Sheet sheet, const Facts& facts, RoomPanel& panel, TimePoint now);
    void add_tool_choice(const Facts& facts, RoomPanel& panel) const;
    void show_slice_at(const window::WindowInput& input, Size picture, TimePoint now);
    void add_case(RoomPanel& panel) const;
    Pose at_eye_height(Pose room_from_eye) const;
    std::string camera_text(CameraId camera) const;
    // With the person whose it is.
    std::string name_of(const client::Participant::Camera& camera) const;
    ViewableCameras cameras() const { return {scene_.calibrations(), scene_.newest()}; }

    Options options_;
    client::Participant& participant_;
    LiveScene scene_;
    Eye eye_;
    std::optional<Headset> headset_;  // while the person wears it
    std::optional<MenuAction> headset_wish_;
    Sheet plate_ = Sheet::none;                // that the person with a headset sees
    std::vector<RoomCommand> plate_commands_;  // of its buttons
    TimePoint plate_made_;
    std::unique_ptr<render::Vignette> vignette_;  // made when first needed
    bool microphone_open_ = false;
    Handling handling_;
    Tools tools_;
    ScreenOffer screen_offer_;
    bool missed_with_tool_ = false;  // the button went down on nothing, and is still down
    AdjustPanel adjusting_;
    Playing playing_;
    LookingBack looking_back_;
    StudyPanel study_;
    ChatPanel chat_;
    Tour tour_;
    bool slides_playback_ = false;                   // the slider that was pressed last
    std::optional<room::Pointer> pointer_;           // while this person points
    std::optional<Vec2> mouse_;                      // over the scene
    Size picture_;                                   // of the last input
    std::optional<CameraPictures> camera_pictures_;  // while they are shown
    std::optional<ShowLarge> large_;                 // one of them
    double point_size_ = 1;
    bool frozen_ = false;  // the clouds
    TimePoint frozen_drawn_;
    TimePoint pose_sent_;
    Pose sent_pose_;

    session::RendererChoice choice_;
    std::string working_renderer_;
    pace::PaceLimits pace_limits_;
    pace::DrawingPace pace_;
    pace::DrawingRest rest_;
    unsigned preparations_ = 0;  // calls of prepare()
    TimePoint receiving_noted_;
    std::uint64_t dropped_ = 0;                     // then
    std::optional<pace::DrawingPace> window_pace_;  // before the headset
    bool fading_ = false, moving_ = false;
    bool scene_changed_ = true;
    std::optional<ParticipantId> followed_;  // the person through whose eyes the user sees
    std::optional<room::TeleportArc> arc_;   // while it is aimed
    std::set<ParticipantId> answered_;       // those who still call
    TimePoint calls_until_;
    bool sent_call_ = false;
    bool sent_pointing_ = false;
    bool sits_ = false;
    RemovalQuestion removal_;
    Voices voices_;
    OwnFace own_face_ = OwnFace::none;
    std::optional<bool> face_wish_;
    SoundChoices sound_choices_;
    std::optional<UseSound> sound_wish_;
    bool shows_panels_ = false, shows_case_ = false;
    std::optional<ContentHash> asked_case_;  // that the person is about to open
    bool patient_is_asked_ = false;          // the host answers whose case it is
    Sheet sheet_ = Sheet::none;              // one of those that are not open by other members
    bool points_ = false;                    // with the mouse, until the person ends it
    TimePoint leave_asked_until_;
    std::vector<window::KeyPress> pressed_;
    CameraUnrest unrest_;
    std::vector<RoomCommand> commands_;  // of the panels' buttons
    bool help_ = false;
    bool line_ = true;
    Notice notice_;

    std::set<CameraId> updated_;  // cameras whose new picture is not presented yet
    RateWindow drawn_;
    SampleWindow ages_ms_{30}, all_ages_ms_{20'000};
    std::uint64_t pictures_ = 0;
    bool has_checked_people_ = false;
    TimePoint presented_at_, first_picture_at_;
    std::optional<double> age_at_presentation_ms_;
    bool presented_past_ = false;  // the last picture was
};

}  // namespace theatron::viewer
