// SPDX-License-Identifier: Apache-2.0
// The cameras that are missing when the host begins: it begins without them, and takes each when it
// is there.
#include <utility>

#include "base/error.h"
#include "base/lasting_error.h"
#include "base/log.h"
#include "capture/placed_camera.h"
#include "host/host_impl.h"

namespace theatron::host {

// Null: it is missing, and noted in `missing`. Throws Error if it cannot come later.
std::unique_ptr<capture::Camera> Host::Impl::open_or_miss(std::size_t number,
                                                          const std::string& specification,
                                                          const capture::Progress& progress) {
    try {
        return capture::open_camera_at(specification, places, progress);
    } catch (const LastingError&) {
        throw;
    } catch (const Error& error) {
        if (!may_come_later(specification))
            throw;
        Missing camera{specification, expected_name(specification), {}, error.what(), nullptr};
        missing.emplace(number, std::move(camera));
        return nullptr;
    }
}

// Where nothing is there and only files are wanted, their names are wrong.
void Host::Impl::require_any(const std::vector<std::unique_ptr<capture::Camera>>& cameras) const {
    bool is_any = cameras.empty();
    for (const auto& camera : cameras)
        is_any = is_any || camera;
    for (const auto& [number, camera] : missing)
        is_any = is_any || is_live_kind(camera.specification);
    if (!is_any)
        throw Error(missing.begin()->second.problem);
}

void Host::Impl::start_searches() {
    const std::lock_guard lock(missing_mutex);
    for (auto& [number, camera] : missing) {
        log::warning("host", "camera is missing, and is tried again",
                     {{"camera", int(number)}, {"problem", camera.problem}});
        camera.search = std::make_unique<MissingCamera>(
            camera.problem,
            [specification = camera.specification, places = places] {
                return capture::open_camera_at(specification, places);
            },
            [this, number = number](std::unique_ptr<capture::Camera> found) {
                const auto shared =
                    std::make_shared<std::unique_ptr<capture::Camera>>(std::move(found));
                server->post([this, number, shared] { take_found(number, std::move(*shared)); });
            });
    }
}

void Host::Impl::drop_missing() {
    std::map<std::size_t, Missing> dropped;
    {
        const std::lock_guard lock(missing_mutex);
        dropped.swap(missing);
    }
    // All at once, or each would have the patience of the others.
    for (auto& [number, camera] : dropped)
        if (camera.search)
            camera.search->stop();
}

void Host::Impl::take_found(std::size_t number, std::unique_ptr<capture::Camera> camera) {
    std::unique_ptr<MissingCamera> search;  // destroyed outside the lock
    {
        const std::lock_guard lock(missing_mutex);
        const auto found = missing.find(number);
        if (found == missing.end())
            return;  // the host ends
        search = std::move(found->second.search);
        try {
            add_found(number, found->second, std::move(camera));
            missing.erase(found);
            log::info("host", "camera is there", {{"camera", int(number)}});
        } catch (const Error& error) {
            log::error("host", "camera is there, but cannot be taken",
                       {{"camera", int(number)}, {"problem", error.what()}});
            found->second.problem = error.what();
        }
    }
    carry_out();
}

// Throws Error if it cannot be taken: what is refused at the beginning is refused later, too.
void Host::Impl::add_found(std::size_t number, const Missing& expected,
                           std::unique_ptr<capture::Camera> camera) {
    const capture::CameraInfo info = camera->info();
    for (const send::CameraLane* lane : lanes.all())
        if (places.find(info.name) && lane->info().name == info.name)
            throw Error("Two cameras are called '" + info.name +
                        "', so the file of places cannot say where each is; give one its place by "
                        "hand, with place=.");
    if (session->streams().cameras().size() >= wire::max_cameras)
        throw Error("The session has " + std::to_string(wire::max_cameras) +
                    " cameras already, and can have no more.");
    check_background(expected.filter, info.calibration.depth.size);
    wire::Camera description = describe(info, false);
    description.id = CameraId(number);
    session->add_camera(std::move(description));
    start_lane(number, expected.specification, std::move(camera), expected.filter);
    crop(*session->streams().cameras().find(CameraId(number)));
}

std::string Host::Impl::camera_name(std::size_t number) const {
    // First, as a camera that is found is missing until it has its lane.
    std::string name;
    {
        const std::lock_guard lock(missing_mutex);
        if (const auto found = missing.find(number); found != missing.end())
            name = found->second.name;
    }
    const send::CameraLane* lane = lanes.find(number);
    return lane ? lane->info().name : name;
}

send::LaneFigures Host::Impl::figures_of_missing(std::size_t number) const {
    send::LaneFigures figures;
    figures.camera.condition = wire::CameraCondition::stale;
    figures.camera.trouble = capture::Trouble::gone;
    const std::lock_guard lock(missing_mutex);
    const auto found = missing.find(number);
    if (found == missing.end()) {
        // It was found just now.
        const send::CameraLane* lane = lanes.find(number);
        return lane ? lane->figures() : figures;
    }
    const Missing& camera = found->second;
    figures.name = camera.name;
    const auto search =
        camera.search ? camera.search->figures() : MissingCamera::Figures{camera.problem};
    figures.camera.problem = wire::as_written(search.problem);
    figures.camera.figures.failed_reopens = search.failed;
    return figures;
}

}  // namespace theatron::host
