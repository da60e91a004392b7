// SPDX-License-Identifier: Apache-2.0
#include "published_cameras.h"

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
        host::check_background(filter, publisher->depth_size(i));
        publisher->set_filter(i, filter.settings, filter.background);
    }
    return publisher;
}

}  // namespace theatron::app
