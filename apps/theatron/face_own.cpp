// SPDX-License-Identifier: Apache-2.0
// theatron face model, photos, enrol, show and delete
//
// The content of photos and faces goes into the files that their owner asked for, and nowhere else.
#include <sys/stat.h>

#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/output.h"
#include "face/enrol.h"
#include "face/ict_head.h"
#include "face/painted_face.h"
#include "face_command.h"
#include "files/file_bytes.h"
#include "files/json_text.h"
#include "files/png_file.h"
#include "files/private_file.h"
#include "net/sealed_bytes.h"
#include "video/jpeg_encoder_native.h"
#include "video/jpeg_file_native.h"
#include "video/jpeg_native.h"

namespace theatron::app {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t max_photo_bytes = std::size_t(64) << 20;
constexpr std::size_t max_landmarks_bytes = 64 * 1024;
constexpr std::size_t max_ict_bytes = std::size_t(256) << 20;
// Beyond the photo's border by this share of its side, a landmark is of another photo.
constexpr double outside_share = 0.1;
constexpr Size tile{420, 480}, painted_size{960, 1080};
constexpr double sheet_yaw_degrees = 12;
constexpr int photo_quality = 92, best_texture_quality = 90;

// Two rows of three.
constexpr std::array<face::Emotion, face::emotion_count> sheet_order = {
    face::Emotion::neutral, face::Emotion::happiness, face::Emotion::surprise,
    face::Emotion::sadness, face::Emotion::disgust,   face::Emotion::anger};
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
    for (std::size_t i = 0; i < sheet_order.size(); ++i) {
        const ColorImage one = draw(sheet_order[i]);
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

ColorImage read_photo(const std::string& file) {
    const Bytes bytes = files::read_file(file, max_photo_bytes);
    ColorImage picture;
    if (text_of(bytes).substr(0, files::png_beginning.size()) == files::png_beginning) {
        if (const std::string problem = files::decode_png(bytes, picture); !problem.empty())
            throw Error("'" + file + "' " + problem + ".");
        return picture;
    }
    if (const Status status = video::decode_jpeg_file(bytes, picture); status != Status::ok)
        throw Error("'" + file + "' is no photo as JPEG or PNG: it is " +
                    std::string(to_text(status)) + ".");
    return picture;
}

std::array<Vec2, face::landmark_count> read_landmarks(const std::string& file, Size picture) {
    const auto landmarks = face::parse_pts(text_of(files::read_file(file, max_landmarks_bytes)));
    if (!landmarks)
        throw Error("'" + file + "' has no 68 landmarks as a .pts file: it is " +
                    std::string(to_text(landmarks.error())) + ".");
    const double margin = outside_share * std::max(picture.width, picture.height);
    for (const Vec2 point : *landmarks)
        if (point.x < -margin || point.y < -margin || point.x > picture.width + margin ||
            point.y > picture.height + margin)
            throw Error("Landmarks in '" + file +
                        "' are outside of their photo; mark the photo as it is stored, upright.");
    return *landmarks;
}

Bytes texture_bytes(const ColorImage& texture) {
    for (int quality = best_texture_quality;; quality -= 10) {
        video::JpegCompressor compressor(quality, true);
        const ByteView jpeg = compressor.compress(texture.view());
        if (jpeg.size() <= face::max_texture_bytes || quality <= 30)
            return Bytes(jpeg.begin(), jpeg.end());
    }
}

ColorImage texture_picture(const std::string& file, const Bytes& jpeg) {
    ColorImage picture;
    video::JpegDecompressor decompressor;
    if (decompressor.decompress(jpeg, picture) != Status::ok ||
        std::max(picture.size.width, picture.size.height) > face::max_texture_side)
        throw Error("A texture of the face in '" + file + "' is damaged; enrol it again.");
    return picture;
}

// A photo and where its landmarks are; `picture` is what EnrolPhoto looks at.
struct ReadPhoto {
    ColorImage picture;
    face::EnrolPhoto photo;
};

std::vector<ReadPhoto> read_photos(const FaceEnrol& wanted) {
    std::vector<ReadPhoto> photos;
    for (const face::Emotion emotion : sheet_order) {
        const auto& files = wanted.photos[std::size_t(emotion)];
        if (files.picture.empty())
            continue;
        ReadPhoto& one = photos.emplace_back();
        one.picture = read_photo(files.picture);
        one.photo.emotion = emotion;
        one.photo.landmarks_px = read_landmarks(files.landmarks, one.picture.size);
        one.photo.view_degrees = wanted.view_degrees;
    }
    return photos;
}

nlohmann::json enrolment_json(const face::Enrolment& made, const std::vector<ReadPhoto>& photos) {
    nlohmann::json residuals;
    for (std::size_t i = 0; i < photos.size(); ++i)
        residuals[std::string(to_text(photos[i].photo.emotion))] = made.fit.photos[i].residual_px;
    return {{"residual_px", made.fit.residual_px},
            {"residuals_px", residuals},
            {"eyes_apart_mm", made.eyes_apart_mm},
            {"seen_share", made.seen_share}};
}

std::string one_decimal(double value) {
    char text[32];
    std::snprintf(text, sizeof(text), "%.1f", value);
    return text;
}

std::string enrolment_text(const face::Enrolment& made, const std::vector<ReadPhoto>& photos) {
    std::string text;
    for (std::size_t i = 0; i < photos.size(); ++i)
        text += std::string(to_text(photos[i].photo.emotion)) + ": landmarks off by " +
                one_decimal(made.fit.photos[i].residual_px) + " px\n";
    return text + "eyes " + one_decimal(made.eyes_apart_mm) +
           " mm apart; the neutral photo shows " +
           std::to_string(int(100 * made.seen_share + 0.5)) + " % of the skin\n";
}

// A face that is replaced or deleted by a link to it would stay.
void refuse_link(const fs::path& file) {
    std::error_code none;
    if (fs::is_symlink(fs::symlink_status(file, none)))
        throw Error("'" + file.string() + "' is a link to '" +
                    fs::read_symlink(file, none).string() + "'; name the face itself.");
}

std::string pts_text(const std::array<Vec2, face::landmark_count>& landmarks) {
    std::string text = "version: 1\nn_points: 68\n{\n";
    for (const Vec2 point : landmarks) {
        char line[64];
        std::snprintf(line, sizeof(line), "%.3f %.3f\n", point.x, point.y);
        text += line;
    }
    return text + "}\n";
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
    for (const face::Emotion emotion : sheet_order) {
        const face::PaintedPhoto photo =
            face::painted_photo(model, person, emotion, wanted.seed, painted_size,
                                FaceEnrol{}.view_degrees, wanted.noise_px);
        const fs::path file = folder / to_text(emotion);
        files::write_file(fs::path(file) += ".jpg", compressor.compress(photo.picture.view()));
        files::write_file(fs::path(file) += ".pts", as_bytes(pts_text(photo.landmarks_px)));
    }
    output::result(wanted.folder + ": six photos of nobody, with their landmarks\n");
}

void run_face_enrol(const FaceEnrol& wanted) {
    files::require_new(wanted.out, wanted.overwrite);
    refuse_link(wanted.out);
    files::require_own_kind(wanted.out, net::sealed_magic, "a face of 'theatron face enrol'");
    files::require_writable(wanted.out);
    const face::MorphModel model = visit::read_face_model(wanted.model);
    if (model.vertex_count() > face::max_enrolled_vertices ||
        model.triangles.size() > face::max_enrolled_triangles)
        throw Error(
            "The model has too many vertices for a person's own face; take one with at "
            "most 65535, and twice as many triangles.");
    std::vector<ReadPhoto> photos = read_photos(wanted);
    const std::string passphrase = visit::face_passphrase(wanted.passphrase_file, true);
    std::vector<face::EnrolPhoto> seen;
    for (ReadPhoto& one : photos) {
        one.photo.picture = one.picture.view();
        seen.push_back(one.photo);
    }
    std::optional<face::EyeDistance> eyes;
    if (wanted.eyes_apart_mm)
        eyes = face::EyeDistance{*wanted.eyes_apart_mm};
    auto made = face::enrol(model, seen, eyes);
    if (!made)
        throw Error("No face could be fitted to the landmarks; are they those of the photos?");
    for (std::size_t i = 0; i < face::emotion_count; ++i)
        if (made->textures[i])
            made->face.textures[i] = texture_bytes(*made->textures[i]);
    const Bytes sealed = visit::sealed_face(made->face, passphrase);
    files::write_private_file(wanted.out, std::string(text_of(sealed)));
    if (wanted.json)
        return output::result(files::json_text(enrolment_json(*made, photos)) + "\n");
    output::result(enrolment_text(*made, photos) + wanted.out +
                   ": written; look at it with "
                   "'theatron face show'\n");
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
    refuse_link(face);
    visit::require_own_face(face);
    files::remove_private_file(face);
    output::result(face + ": deleted. Copies that you made of it are still there.\n");
}

}  // namespace theatron::app
