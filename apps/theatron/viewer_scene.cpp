// SPDX-License-Identifier: Apache-2.0
#include "viewer_scene.h"

#include "base/error.h"

namespace theatron::app {

render::Picture ViewerScene::render(const ViewChoice& view, Size size,
                                    const std::string& renderer) {
    const render::CameraView camera_view =
        view.resolve(scene_.calibrations(), scene_.newest(), size);
    render::Picture picture = scene_.clouds().render(camera_view, size, renderer);
    if (context_.errors() > 0)
        throw Error("The graphics driver reported an error: " + context_.first_error());
    return picture;
}

}  // namespace theatron::app
