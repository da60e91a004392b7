// SPDX-License-Identifier: Apache-2.0
#include "published_cameras.h"

#include "capture/video_camera.h"
#include "cli/progress.h"
#include "host/filter_choice.h"

namespace theatron::app {

std::unique_ptr<publish::CameraPublisher> open_published(const std::vector<std::string>& cameras,
                                                         const std::vector<std::string>& filters,
                                                         const std::string& places,
                                                         const publish::Sharing& sharing) {
    auto publisher =
        std::make_unique<publish::CameraPublisher>(cameras, places, cli::show_progress(), sharing);
    auto sources = host::filter_sources(filters, publisher->camera_names(), host::usual_filter);
    for (std::size_t i = 0; i < sources.size(); ++i) {
        const host::LoadedFilter filter = sources[i].load();
        host::tell_missing_gpu(filter.settings);
        host::check_background(filter, publisher->depth_size(i));
        publisher->set_filter(i, filter.settings, filter.background);
    }
    return publisher;
}

void add_share_option(CLI::App& command, std::vector<std::string>& sources) {
    command
        .add_option("--share", sources,
                    "A screen in the room that shows a video: a file that FFmpeg reads, for "
                    "example endoscope.mp4,loop=1,width=1.2,place=0:1.9:-1.8 (metres), a window "
                    "(x11:TITLE; 'theatron cameras' lists them), the whole display (x11:display), "
                    "a video device (v4l2:/dev/video0) or a stream (rtsp://HOST/PATH). Needs the "
                    "host's link for those who may send. Repeat for more")
        ->allow_extra_args(false);
}

std::vector<std::string> with_shared(std::vector<std::string> cameras,
                                     const std::vector<std::string>& sources) {
    for (const std::string& source : sources)
        cameras.push_back(capture::camera_of_shared(source));
    return cameras;
}

}  // namespace theatron::app
