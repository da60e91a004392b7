// SPDX-License-Identifier: Apache-2.0
// A person's view of the open case: its panel, and the slice through a place under the mouse.
#include "phrases/phrase.h"
#include "viewer/case_actions.h"
#include "viewer/case_panel.h"
#include "viewer/screen_handling.h"
#include "viewer/viewer.h"

namespace theatron::viewer {
namespace {

// A case is opened at this distance in front of the eye.
constexpr double new_case_distance_m = 0.9;

}  // namespace

void Viewer::show_slice_at(const xr::WindowInput& input, Size picture, TimePoint now) {
    if (!eye_.is_placed() || !input.pointer)
        return;
    Meeting& meeting = scene_.meeting();
    const render::CameraView view = eye_.view(picture);
    const auto hit = meeting.pick(render::ray_through(view, *input.pointer), view);
    const auto& open = meeting.case_scene().in_room();
    const auto place =
        hit ? meeting.case_scene().patient_point(hit->object, hit->picked.place) : std::nullopt;
    if (!open || !open->screen)
        return note(say(Phrase::point_at_organ), now);
    const session::CaseScreen& screen = open->screen->facts;
    if (place)
        return void(set_screen(participant_, through(screen, *place)));
    const bool is_screen = hit && hit->object == open->screen->id;
    const auto on_slice =
        is_screen ? meeting.case_scene().monitor().patient_point(*open, hit->picked.place)
                  : std::nullopt;
    if (!on_slice)
        return note(say(Phrase::point_at_slice), now);
    session::CaseScreen next = screen;
    next.orientation = std::uint8_t((screen.orientation + 1) % session::CaseScreen::orientations);
    set_screen(participant_, through(next, *on_slice));
}

void Viewer::ask_to_open(const ContentHash& offered) {
    asked_case_ = offered;
    patient_is_asked_ = participant_.ask_patient(offered);
}

void Viewer::open_before_eye(const ContentHash& offered) {
    asked_case_.reset();
    constexpr Size any{16, 9};
    const Pose eye = eye_.view(any).room_from_eye;
    open_case(participant_, offered, eye * Vec3{0, 0.1, new_case_distance_m}, eye.translation);
}

void Viewer::add_case(RoomPanel& panel) const {
    const CaseScene& scene = scene_.meeting().case_scene();
    CasePanelFacts of_case{participant_.cases(),
                           scene.in_room() ? &*scene.in_room() : nullptr,
                           scene.content(),
                           scene.monitor().volume(),
                           "",
                           false,
                           {},
                           std::nullopt};
    if (asked_case_) {
        wire::Patient answer = participant_.asked_patient();
        const bool is_answer = to_content_hash(answer.of_case) == *asked_case_;
        of_case.asked = AskedCase{*asked_case_, is_answer || !patient_is_asked_,
                                  is_answer ? std::move(answer) : wire::Patient{}};
    }
    const wire::Patient patient = participant_.patient();
    if (of_case.room && !session::is_recorded(of_case.room->organ_id) &&
        to_content_hash(patient.of_case) == of_case.room->organ.of_case)
        of_case.patient = patient;
    if (of_case.room && of_case.room->screen && !session::is_recorded(of_case.room->screen->id)) {
        const ParticipantId presenter = of_case.room->screen->facts.presenter;
        of_case.presents =
            presenter != ParticipantId{} && presenter == scene_.meeting().room().self;
        if (presenter != ParticipantId{})
            of_case.presenter = scene_.meeting().name_of(presenter);
    }
    add_case_panel(of_case, panel);
}

}  // namespace theatron::viewer
