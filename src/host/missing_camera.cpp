// SPDX-License-Identifier: Apache-2.0
#include "host/missing_camera.h"

#include <algorithm>
#include <condition_variable>
#include <exception>
#include <filesystem>
#include <mutex>
#include <utility>

#include "base/options.h"
#include "base/outside_text.h"
#include "base/steady_clock.h"
#include "base/thread_name.h"
#include "wire/control.h"

namespace theatron::host {
namespace {

// For a driver that is opening the camera when the host ends.
constexpr Duration last_patience = 500ms;

}  // namespace

bool is_live_kind(const std::string& specification) {
    const std::string kind = Options::parse(specification).kind();
    return kind == "k4a" || kind == "v4l2" || kind == "rtsp" || kind == "x11";
}

bool may_come_later(const std::string& specification) {
    const std::string kind = Options::parse(specification).kind();
    return is_live_kind(specification) || kind == "folder" || kind == "mkv" || kind == "video";
}

std::string expected_name(const std::string& specification) {
    Options options = Options::parse(specification);
    std::string name = options.take("name");
    std::filesystem::path path = std::filesystem::path(options.value()).lexically_normal();
    if (!path.has_filename())
        path = path.parent_path();
    if (options.kind() == "folder" || options.kind() == "v4l2")
        name = name.empty() ? path.filename().string() : name;
    else if (options.kind() == "mkv" || options.kind() == "video")
        name = path.stem().string();
    else if (const std::string serial = options.take("serial");
             options.kind() == "k4a" && !serial.empty())
        name = "k4a-" + serial;
    return clean_text(name.empty() ? options.text() : name, wire::max_name);
}

struct MissingCamera::Shared {
    std::mutex mutex;  // guards all below; held while `found` is called
    std::condition_variable changed;
    Found found;
    Figures figures;
    bool stopping = false;
    bool done = false;
};

MissingCamera::MissingCamera(std::string problem, Open open, Found found, Pauses pauses)
    : shared_(std::make_shared<Shared>()) {
    shared_->found = std::move(found);
    shared_->figures.problem = std::move(problem);
    thread_ = std::thread([shared = shared_, open = std::move(open), pauses] {
        name_this_thread("missing");
        run(*shared, open, pauses);
        const std::lock_guard lock(shared->mutex);
        shared->done = true;
        shared->changed.notify_all();
    });
}

void MissingCamera::stop() {
    const std::lock_guard lock(shared_->mutex);
    if (!std::exchange(shared_->stopping, true))
        wait_until_ = steady_now() + last_patience;
    shared_->changed.notify_all();
}

MissingCamera::~MissingCamera() {
    stop();
    bool done = false;
    {
        std::unique_lock lock(shared_->mutex);
        done = shared_->changed.wait_for(lock, wait_until_ - steady_now(),
                                         [this] { return shared_->done; });
    }
    if (done)
        thread_.join();
    else
        thread_.detach();
}

void MissingCamera::run(Shared& shared, const Open& open, Pauses pauses) {
    Duration pause = pauses.first;
    while (true) {
        {
            std::unique_lock lock(shared.mutex);
            if (shared.changed.wait_for(lock, pause, [&] { return shared.stopping; }))
                return;
        }
        std::unique_ptr<capture::Camera> camera;
        std::string problem;
        try {
            camera = open();
        } catch (const std::exception& e) {
            problem = e.what();
        }
        const std::lock_guard lock(shared.mutex);
        if (shared.stopping)
            return;
        if (camera)
            return shared.found(std::move(camera));
        shared.figures.problem = std::move(problem);
        ++shared.figures.failed;
        pause = std::min(2 * pause, pauses.longest);
    }
}

MissingCamera::Figures MissingCamera::figures() const {
    const std::lock_guard lock(shared_->mutex);
    return shared_->figures;
}

}  // namespace theatron::host
