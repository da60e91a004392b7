// SPDX-License-Identifier: Apache-2.0
#include "capture/camera.h"

#include <filesystem>
#include <new>

#include "base/error.h"
#include "base/lasting_error.h"
#include "base/options.h"
#include "capture/camera_kind.h"
#include "capture/cropped_camera.h"
#include "capture/face_camera.h"
#include "capture/faulty_camera.h"
#include "capture/folder_camera.h"
#include "capture/k4a_camera.h"
#include "capture/mkv_camera.h"
#include "capture/placed_camera.h"
#include "capture/recording_camera.h"
#include "capture/source_camera.h"
#include "capture/strip_camera.h"
#include "capture/synthetic_camera.h"
#include "capture/uneven_camera.h"
#include "capture/video_camera.h"
#include "capture/watched_camera.h"

namespace theatron::capture {
namespace {

struct Kind {
    const char* name;
    const char* help;
    std::unique_ptr<Camera> (*open)(Options& options, const Progress& progress);
};

// To add a kind of camera, add a line here.
constexpr Kind kinds[] = {
    {"folder", folder_camera_help, open_folder_camera},
    {"mkv", mkv_camera_help, open_mkv_camera},
    {"recording", recording_camera_help, open_recording_camera},
    {"synthetic", synthetic_camera_help, open_synthetic_camera},
    {"k4a", k4a_camera_help, open_k4a_camera},
    {"video", video_camera_help, open_video_camera},
    {"x11", x11_camera_help, open_x11_camera},
    {"v4l2", v4l2_camera_help, open_v4l2_camera},
    {"rtsp", rtsp_camera_help, open_rtsp_camera},
    {"face", face_camera_help, open_face_camera},
    {"strip", strip_camera_help, open_strip_camera},
};

// Opens a camera. Exceptions of the standard library become an Error with a sentence, too.
std::unique_ptr<Camera> open(const Kind& kind, Options& options, const Progress& progress) {
    try {
        const CropOptions crop = take_crop_options(options);
        const std::optional<FaultPlan> faults = take_fault_options(options);
        const std::optional<Unevenness> unevenness = take_uneven_options(options);
        const std::optional<Pose> place = take_place_option(options);
        std::unique_ptr<Camera> camera = kind.open(options, progress);
        if (place)
            camera = make_placed_camera(std::move(camera), *place);
        if (crop.any())
            camera = make_cropped_camera(std::move(camera), crop);
        if (unevenness)
            camera = make_uneven_camera(std::move(camera), *unevenness, steady_clock().sleep);
        if (faults) {
            const Clock clock = steady_clock();
            camera = make_faulty_camera(std::move(camera), *faults, clock.now, clock.sleep);
        }
        return camera;
    } catch (const std::filesystem::filesystem_error& problem) {
        throw Error("Cannot read '" + problem.path1().string() + "': " + problem.code().message() +
                    ".");
    } catch (const std::bad_alloc&) {
        throw Error("There is not enough memory to open the camera '" + options.text() + "'.");
    }
}

// A file or a folder without its kind before it: the sentence tells how it is written.
std::string advice_on_path(const std::string& path) {
    std::error_code unreadable;
    const auto status = std::filesystem::status(path, unreadable);
    if (std::filesystem::is_directory(status))
        return "'" + path + "' is a folder; write folder:" + path + ".";
    if (std::filesystem::is_regular_file(status))
        return "'" + path + "' is a file; write recording:" + path + " for a recording of " +
               "Theatron, mkv:" + path + " for one of an Azure Kinect.";
    return "";
}

// Throws Error if there is none.
const Kind& kind_of(const Options& options, std::string_view specification) {
    for (const Kind& kind : kinds)
        if (options.kind() == kind.name)
            return kind;
    if (const std::string advice = advice_on_path(std::string(specification)); !advice.empty())
        throw LastingError(advice);
    std::string names;
    for (const Kind& kind : kinds)
        names += (names.empty() ? "" : ", ") + std::string(kind.name);
    throw LastingError("There is no camera '" + options.kind() + "'; there are " + names + ".");
}

}  // namespace

void check_camera_kind(std::string_view specification) {
    (void)kind_of(Options::parse(specification), specification);
}

std::unique_ptr<Camera> open_camera(std::string_view specification, const Progress& progress) {
    Options options = Options::parse(specification);
    return open(kind_of(options, specification), options, progress);
}

std::vector<std::string> camera_kinds() {
    std::vector<std::string> lines;
    for (const Kind& kind : kinds)
        lines.push_back(kind.help);
    lines.push_back(crop_help);
    lines.push_back(place_help);
    lines.push_back(faults_help);
    lines.push_back(uneven_help);
    return lines;
}

}  // namespace theatron::capture
