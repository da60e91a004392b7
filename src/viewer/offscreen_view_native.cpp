// SPDX-License-Identifier: Apache-2.0
#include "viewer/offscreen_view_native.h"

#include "base/error.h"
#include "room/moving.h"
#include "viewer/eye.h"

namespace theatron::viewer {

render::CameraView OffscreenView::view(const ViewChoice& view, Size size) const {
    if (meets_without_cameras())
        return render::view_of_camera(usual_lens(),
                                      room::meeting_place(scene_.meeting().room().self), size);
    return view.resolve(scene_.calibrations(), scene_.newest(), size);
}

render::Picture OffscreenView::render(const Wish& wish, bool with_room) {
    render::CameraView view = this->view(wish.view, wish.size);
    view.room_from_eye = wish.room_from_eye.value_or(view.room_from_eye);
    std::vector<render::CameraView> eyes{view};
    if (wish.eye_distance_m) {
        const auto pair = render::stereo_pair(view, *wish.eye_distance_m);
        eyes.assign(pair.begin(), pair.end());
    }
    render::Picture picture = scene_.render(eyes, wish.size, wish.renderer, with_room);
    if (context_.errors() > 0)
        throw Error("The graphics driver reported an error: " + context_.first_error());
    return picture;
}

}  // namespace theatron::viewer
