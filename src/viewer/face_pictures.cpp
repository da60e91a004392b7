// SPDX-License-Identifier: Apache-2.0
#include "viewer/face_pictures.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "phrases/phrase.h"
#include "viewer/age_text.h"

namespace theatron::viewer {

double face_opacity(double age_ms) {
    return std::clamp((gone_face_ms - age_ms) / (gone_face_ms - fresh_face_ms), 0.0, 1.0);
}

void FacePictures::set_camera(ParticipantId person, CameraId camera,
                              const Calibration& calibration) {
    Face& face = faces_[camera];
    if (face.person == person && face.size == calibration.color.size)
        return;
    face = {};
    face.person = person;
    face.size = calibration.color.size;
}

void FacePictures::take(const receive::CameraFrame& frame, TimePoint now) {
    const auto found = faces_.find(frame.camera);
    if (found == faces_.end() || !frame.color)
        return;
    Face& face = found->second;
    // The same picture may come with a newer frame: it is as old as before.
    if (frame.color == face.color || frame.color->size != face.size)
        return;
    face.color = frame.color;
    face.captured = frame.times.captured;
    face.taken = now;
    face.is_new = true;
}

// Age counts from capture or arrival, whichever is earlier: a publisher's clock may be ahead.
bool FacePictures::note(TimePoint now) {
    bool changed = false;
    for (auto& [camera, face] : faces_) {
        if (!face.color)
            continue;
        const double age_ms = std::max(to_ms(now - face.captured), to_ms(now - face.taken));
        const double before = std::exchange(face.opacity, face_opacity(age_ms));
        std::string age = face.opacity > 0 && face.opacity < 1
                              ? say(Phrase::face_stands_still, age_text(age_ms))
                              : std::string();
        changed = changed || before != face.opacity || age != face.age;
        face.age = std::move(age);
    }
    return changed;
}

std::map<ParticipantId, room::FacePicture> FacePictures::pictures() {
    std::map<ParticipantId, room::FacePicture> pictures;
    for (auto& [camera, face] : faces_) {
        if (face.opacity <= 0)
            continue;
        if (!face.texture)
            face.texture.emplace(face.size);
        if (std::exchange(face.is_new, false))
            face.texture->set(face.color->view());
        pictures[face.person] = {&*face.texture, face.opacity, face.age};
    }
    return pictures;
}

}  // namespace theatron::viewer
