// SPDX-License-Identifier: Apache-2.0
#include "view_source.h"

#include <string_view>

#include "base/error.h"
#include "base/outside_text.h"
#include "base/small_letters.h"
#include "cases/manifest.h"
#include "record/recording_file.h"

namespace theatron::app {
namespace {

namespace fs = std::filesystem;

std::string shown(const fs::path& path) {
    return "'" + clean_text(path.string(), 300) + "'";
}

// The beginning of a file of the family that MKV belongs to.
bool is_matroska(const fs::path& file) {
    return in_small_letters(file.extension().string()) == ".mkv";
}

std::vector<std::string> cameras_of(const fs::path& file) {
    const std::string path = file.string();
    std::unique_ptr<record::RecordingFile> recording;
    try {
        recording = record::RecordingFile::open(file);
    } catch (const Error&) {
        // An Azure Kinect's own file is one, too, and any other is a video.
        return {(is_matroska(file) ? "mkv:" : "video:") + path + ",loop=1"};
    }
    std::vector<std::string> cameras = {"recording:" + path + ",loop=1"};
    for (std::size_t i = 1; i < recording->cameras().size(); ++i)
        cameras.push_back("recording:" + path + ",camera=" + std::to_string(i) + ",loop=1");
    return cameras;
}

}  // namespace

ViewSource view_source(const std::string& text) {
    std::error_code problem;
    const fs::path path = text;
    const fs::file_status status = fs::status(path, problem);
    if (!fs::exists(status)) {
        if (text.find(':') == std::string::npos)
            throw Error("There is no file or folder " + shown(path) +
                        ", and a camera is KIND:WHERE, as 'theatron host --help' lists them.");
        return {{text}, {}, text.substr(0, text.find(','))};
    }
    if (text.find(',') != std::string::npos)
        throw Error("The name " + shown(path) +
                    " has a comma, behind which options of a camera begin; rename it.");
    fs::path named = fs::absolute(path, problem).lexically_normal();
    if (!named.has_filename())
        named = named.parent_path();
    ViewSource source{{}, {}, named.filename().string()};
    if (!fs::is_directory(status)) {
        source.cameras = cameras_of(path);
    } else if (fs::exists(path / cases::manifest_name, problem)) {
        source.case_folder = named;
    } else if (fs::is_directory(path / "depth", problem)) {
        source.cameras = {"folder:" + text + ",loop=1"};
    } else {
        throw Error("The folder " + shown(path) +
                    " is neither a case nor pictures of a camera, which have a folder 'depth'; "
                    "'theatron case import' makes a case of images and models.");
    }
    return source;
}

}  // namespace theatron::app
