// SPDX-License-Identifier: Apache-2.0
#include "visit/face_files.h"

#include "base/error.h"
#include "files/file_bytes.h"

namespace theatron::visit {
namespace {

constexpr std::size_t max_face_recording_bytes = std::size_t(256) << 20;
constexpr std::size_t max_face_network_bytes = 1 << 20;

}  // namespace

face::Source face_source(const std::string& name) {
    if (const auto source = face::source_of(name))
        return *source;
    throw Error("There is no tracker '" + name + "'; name arkit, unified, xr_fb or xr_htc.");
}

face::Recording read_face_recording(const std::string& file) {
    const Bytes bytes = files::read_file(file, max_face_recording_bytes);
    face::RecordingRead read = face::parse_recording(
        std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
    if (!read.problem.empty())
        throw Error("'" + file + "' is no recording of a face: " + read.problem + ".");
    if (read.recording.takes.empty())
        throw Error("'" + file + "' has no row of one of the six emotions.");
    return std::move(read.recording);
}

face::Network read_face_network(const std::string& file) {
    const auto network = face::parse_network(files::read_file(file, max_face_network_bytes));
    if (!network)
        throw Error("'" + file + "' is no network of 'theatron face train': it is " +
                    std::string(to_text(network.error())) + ". Train it again.");
    return *network;
}

}  // namespace theatron::visit
