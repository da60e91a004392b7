// SPDX-License-Identifier: Apache-2.0
// theatron face model, photos, show and delete
//
// The content of photos and faces goes into the files that their owner asked for, and nowhere else.
#include <sys/stat.h>

#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/output.h"
#include "enrol/photo_files.h"
#include "enrol/photo_guide.h"
#include "face/enrolled_face.h"
#include "face/ict_head.h"
#include "face/painted_face.h"
#include "face_command.h"
#include "files/file_bytes.h"
#include "files/json_text.h"
#include "files/png_file.h"
#include "files/private_file.h"
#include "video/jpeg_encoder_native.h"
#include "video/jpeg_native.h"

namespace theatron::app {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t max_landmarks_bytes = 64 * 1024;
constexpr std::size_t max_ict_bytes = std::size_t(256) << 20;
constexpr Size tile{420, 480}, painted_size{960, 1080};
constexpr double sheet_yaw_degrees = 12;
constexpr int photo_quality = 92;

// Two rows of three, in the order of enrol::photo_order.
constexpr const char* sheet_words =
    "neutral, happiness, surprise; below: sadness, disgust, anger\n";

std::string_view text_of(const Bytes& bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

std::array<std::uint32_t, face::landmark_count> ict_landmarks(const fs::path& file) {
    const auto json =
        nlohmann::json::parse(text_of(files::read_file(file, max_landmarks_bytes)), nullptr, false);
    std::array<std::uint32_t, face::landmark_count> landmarks{};
    const auto found = json.is_object() ? json.find("landmark68_multipie") : json.end();
    bool is_sound = json.is_object() && found != json.end() && found->is_array() &&
                    found->size() == landmarks.size();
    for (std::size_t i = 0; is_sound && i < landmarks.size(); ++i) {
        is_sound = (*found)[i].is_number_unsigned() &&
                   (*found)[i].get<std::uint64_t>() < face::max_vertices;
        if (is_sound)
            landmarks[i] = (*found)[i].get<std::uint32_t>();
    }
    if (!is_sound)
        throw Error("'" + file.string() +
                    "' has no list landmark68_multipie of 68 numbers of vertices; take the folder "
                    "that docs/face.md describes.");
    return landmarks;
}

// `draw` gives each emotion's picture, all of the size of a tile.
template <class Draw>
void write_sheet(const std::string& file, Draw&& draw) {
    files::require_own_kind(file, files::png_beginning, "a PNG picture");
    ColorImage sheet({3 * tile.width, 2 * tile.height});
    for (std::size_t i = 0; i < enrol::photo_order.size(); ++i) {
        const ColorImage one = draw(enrol::photo_order[i]);
        const auto column = std::ptrdiff_t(i % 3) * tile.width;
        for (int y = 0; y < tile.height; ++y)
            std::copy_n(one.view().row(y), tile.width,
                        sheet.view().row(int(i / 3) * tile.height + y) + column);
    }
    files::write_png(file, sheet.view());
    output::result(file + ": written. From the left: " + sheet_words);
}

face::Emotions only(face::Emotion emotion) {
    face::Emotions weights{};
    weights[std::size_t(emotion)] = 1;
    return weights;
}

ColorImage texture_picture(const std::string& file, const Bytes& jpeg) {
    ColorImage picture;
    video::JpegDecompressor decompressor;
    if (decompressor.decompress(jpeg, picture) != Status::ok ||
        std::max(picture.size.width, picture.size.height) > face::max_texture_side)
        throw Error("A texture of the face in '" + file + "' is damaged; enrol it again.");
    return picture;
}

}  // namespace

void run_face_model_import(const FaceModelImport& wanted) {
    files::require_new(wanted.out, wanted.overwrite);
    files::require_writable(wanted.out);
    const fs::path folder = wanted.folder;
    const Bytes mesh = files::read_file(folder / "generic_neutral_mesh.obj", max_ict_bytes);
    const Bytes expressions = files::read_file(folder / "expressions53_i16.bin", max_ict_bytes);
    const Bytes identities = files::read_file(folder / "identity100_i16.bin", max_ict_bytes);
    const face::IctRead read = face::read_ict_head(
        {text_of(mesh), expressions, identities, ict_landmarks(folder / "landmarks.json")});
    if (!read.problem.empty())
        throw Error("'" + wanted.folder + "' is no folder of ICT-FaceKit Light: " + read.problem +
                    ".");
    files::write_file(wanted.out, face::model_bytes(read.model));
    output::result(wanted.out + ": " + std::to_string(read.model.vertex_count()) + " vertices, " +
                   std::to_string(read.model.identities.size()) +
                   " ways in which persons differ, " +
                   std::to_string(read.model.expressions.size()) + " expressions\n");
}

void run_face_model_show(const FaceModelShow& wanted) {
    const face::MorphModel model = visit::read_face_model(wanted.model);
    const face::FaceCamera camera =
        face::portrait_camera(face::mesh_of(model, {}, face::Channels{}), tile, sheet_yaw_degrees);
    face::FaceLook look;
    look.colors = face::usual_colors();
    look.shade = 0.85;
    look.to_light = normalized(Vec3{-0.4, 0.5, 1});
    write_sheet(wanted.out, [&](face::Emotion emotion) {
        const auto mesh = face::mesh_of(model, {}, face::blend_expressions(only(emotion), {}));
        return face::draw_face(mesh, camera, look, tile);
    });
}

void run_face_photos(const FacePhotos& wanted) {
    const face::MorphModel model = visit::read_face_model(wanted.model);
    const fs::path folder = wanted.folder;
    if (std::error_code problem; !fs::create_directories(folder, problem) && problem)
        throw Error("Cannot make the folder '" + wanted.folder + "': " + problem.message() + ".");
    const face::PaintedPerson person = face::painted_person(model, wanted.seed);
    video::JpegCompressor compressor(photo_quality, false);
    for (const face::Emotion emotion : enrol::photo_order) {
        const face::PaintedPhoto photo =
            face::painted_photo(model, person, emotion, wanted.seed, painted_size,
                                FaceEnrol{}.view_degrees, wanted.noise_px);
        const fs::path file = folder / to_text(emotion);
        files::write_file(fs::path(file) += ".jpg", compressor.compress(photo.picture.view()));
        files::write_file(fs::path(file) += ".pts", as_bytes(enrol::pts_text(photo.landmarks_px)));
    }
    output::result(wanted.folder + ": six photos of nobody, with their landmarks\n");
}

void run_face_show(const FaceShow& wanted) {
    const std::string passphrase = visit::face_passphrase(wanted.passphrase_file, false);
    const face::EnrolledFace own = visit::read_own_face(wanted.face, passphrase);
    const face::FaceCamera camera = face::portrait_camera(own.rest, tile, sheet_yaw_degrees);
    umask(S_IRWXG | S_IRWXO);  // it is a picture of a person
    write_sheet(wanted.out, [&](face::Emotion emotion) {
        const Bytes& jpeg = own.textures[std::size_t(emotion)].empty()
                                ? own.textures[std::size_t(face::Emotion::neutral)]
                                : own.textures[std::size_t(emotion)];
        const ColorImage texture = texture_picture(wanted.face, jpeg);
        face::FaceMesh mesh = own.rest;
        face::blend_face(own, only(emotion), {}, mesh.points);
        face::FaceLook look;
        look.texture = texture.view();
        look.colors = own.colors;
        look.shade = 0.1;
        return face::draw_face(mesh, camera, look, tile);
    });
}

void run_face_delete(const std::string& face) {
    refuse_link_to_face(face);
    visit::require_own_face(face);
    files::remove_private_file(face);
    output::result(face + ": deleted. Copies that you made of it are still there.\n");
}

}  // namespace theatron::app
