// SPDX-License-Identifier: Apache-2.0
// A person's view of the open case: its panel, and the slice through a place under the mouse.
#include "phrases/phrase.h"
#include "viewer/case_actions.h"
#include "viewer/case_panel.h"
#include "viewer/tools/slice.h"
#include "viewer/viewer.h"

namespace theatron::viewer {

void Viewer::show_slice_at(const window::WindowInput& input, Size picture, TimePoint now) {
    if (!eye_.is_placed() || !input.pointer)
        return;
    const render::CameraView view = eye_.view(picture);
    const CaseScene& scene = scene_.meeting().case_scene();
    if (!scene.in_room() || !scene.in_room()->screen)
        note(say(Phrase::point_at_organ), now);
    else if (const auto hit =
                 slice_at(render::ray_through(view, *input.pointer), view, scene_.meeting()))
        set_screen(participant_, hit->screen);
    else
        note(say(Phrase::point_at_slice), now);
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
