// SPDX-License-Identifier: Apache-2.0
#include "viewer/offscreen_view_native.h"

#include "base/error.h"

namespace theatron::viewer {

render::Picture OffscreenView::render(const Wish& wish, bool with_room) {
    const render::CameraView view =
        wish.view.resolve(scene_.calibrations(), scene_.newest(), wish.size);
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
