// SPDX-License-Identifier: Apache-2.0
#include "enrol/photo_files.h"

#include <cstdio>

#include "base/error.h"
#include "enrol/photo_texts.h"
#include "face/face_fit.h"
#include "face/landmark_check.h"
#include "files/file_bytes.h"
#include "files/photo_orientation.h"
#include "files/png_file.h"
#include "video/jpeg_file_native.h"

namespace theatron::enrol {
namespace {

constexpr std::size_t max_photo_bytes = std::size_t(64) << 20;
constexpr std::size_t max_landmarks_bytes = 64 * 1024;

std::string_view text_of(const Bytes& bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

}  // namespace

ColorImage read_photo(const std::string& file) {
    const Bytes bytes = files::read_file(file, max_photo_bytes);
    ColorImage picture;
    if (text_of(bytes).substr(0, files::png_beginning.size()) == files::png_beginning) {
        if (const std::string problem = files::decode_png(bytes, picture); !problem.empty())
            throw Error("'" + file + "' " + problem + ".");
        return picture;
    }
    const Status status = video::decode_jpeg_file(bytes, picture);
    if (status == Status::too_large)
        throw Error("'" + file + "' has too many pixels; make it smaller, and try again.");
    if (status != Status::ok)
        throw Error("'" + file + "' is no photo as JPEG or PNG, which is all that is read here.");
    return files::upright(std::move(picture), files::exif_orientation(bytes));
}

face::Landmarks read_landmarks(const std::string& file, Size photo, const face::Landmarks& usual) {
    const auto landmarks = face::parse_pts(text_of(files::read_file(file, max_landmarks_bytes)));
    if (!landmarks)
        throw Error("'" + file + "' has no 68 landmarks as a .pts file: it is " +
                    std::string(to_text(landmarks.error())) + ".");
    const auto fault = face::landmark_fault(*landmarks, usual, photo);
    if (fault == face::LandmarkFault::outside)
        throw Error("Landmarks in '" + file +
                    "' are outside of their photo; mark the photo as it is stored, upright.");
    if (fault)
        throw Error("'" + file + "' is not used: " + reason_of(*fault) + ".");
    return *landmarks;
}

std::string pts_text(const face::Landmarks& landmarks_px) {
    std::string text = "version: 1\nn_points: 68\n{\n";
    for (const Vec2 point : landmarks_px) {
        char line[64];
        std::snprintf(line, sizeof(line), "%.3f %.3f\n", point.x, point.y);
        text += line;
    }
    return text + "}\n";
}

}  // namespace theatron::enrol
