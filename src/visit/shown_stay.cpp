// SPDX-License-Identifier: Apache-2.0
#include "visit/shown_stay.h"

namespace theatron::visit {
namespace {

constexpr Duration voices_every = 100ms;

viewer::OwnFace shown(const publish::OwnFace* face) {
    using State = publish::OwnFace::State;
    if (!face)
        return viewer::OwnFace::none;
    switch (face->state()) {
        case State::off:
            return viewer::OwnFace::off;
        case State::seen:
            return viewer::OwnFace::seen;
        case State::opening:
        case State::offered:
            break;
    }
    return viewer::OwnFace::opening;
}

}  // namespace

void ShownStay::tick(bool talks, TimePoint now) {
    if (const auto wish = viewer_.take_face_wish())
        viewer_.note(stay_.obey(ShowFace{*wish}), now);
    for (const std::string& sentence : stay_.tick(now))
        viewer_.note(sentence, now);
    // The host does not take the face: its remark has said so, and the button is off again.
    publish::OwnFace* const face = stay_.ports().face;
    if (face && face->state() == publish::OwnFace::State::offered &&
        !stay_.participant().status().face_problem.empty())
        face->show(false);
    viewer_.set_own_face(shown(face));
    if (VoiceLine* const voice = stay_.ports().voice) {
        voice->hold(talks, now);
        follow_voice(now);
    }
}

void ShownStay::follow_voice(TimePoint now) {
    if (now < next_voices_)
        return;
    next_voices_ = now + voices_every;
    viewer::Voices voices = stay_.ports().voice->voices();
    if (stay_.participant().asks_voice_consent())
        voices.may_record = stay_.participant().voice_may_record();
    viewer_.set_voices(std::move(voices));
    // The panel shows which device is in use.
    if (const auto wish = viewer_.take_sound_wish())
        (void)stay_.obey(stay_command(*wish));
    if (viewer_.shows_sound())
        viewer_.set_sound_choices(stay_.ports().voice->sound_choices(devices_.devices_at(now)));
}

void ShownStay::place_voices() {
    // The eye's pose has y down.
    constexpr Pose half_turn{Quat{0, 1, 0, 0}, {}};
    if (stay_.ports().voice && viewer_.first_picture_at() != TimePoint{})
        stay_.ports().voice->place(viewer_.told_eye() * half_turn, stay_.participant());
}

}  // namespace theatron::visit
