// SPDX-License-Identifier: Apache-2.0
// theatron face enrol and landmarks
//
// Photos and landmarks are in memory alone, unless their owner asked for a file.
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/log.h"
#include "base/output.h"
#include "capture/face_camera.h"
#include "cli/stop_signal.h"
#include "enrol/photo_files.h"
#include "enrol/photo_texts.h"
#include "enrol/photo_window_native.h"
#include "face/enrol.h"
#include "face_command.h"
#include "files/file_bytes.h"
#include "files/json_text.h"
#include "files/private_file.h"
#include "join_pictures.h"
#include "net/sealed_bytes.h"
#include "phrases/phrase.h"
#include "video/jpeg_encoder_native.h"

namespace theatron::app {
namespace {

namespace fs = std::filesystem;

constexpr int best_texture_quality = 90, least_texture_quality = 30;
constexpr const char* by_hand = " Mark them yourself with --mark, or give a .pts file.";

Bytes texture_bytes(const ColorImage& texture) {
    for (int quality = best_texture_quality;; quality -= 10) {
        video::JpegCompressor compressor(quality, true);
        const ByteView jpeg = compressor.compress(texture.view());
        if (jpeg.size() <= face::max_texture_bytes || quality <= least_texture_quality)
            return Bytes(jpeg.begin(), jpeg.end());
    }
}

std::vector<enrol::Photo> read_photos(const FaceEnrol& wanted,
                                      const enrol::PhotoGuide::Usual& usual) {
    std::vector<enrol::Photo> photos;
    for (const face::Emotion emotion : enrol::photo_order) {
        const auto& files = wanted.photos[std::size_t(emotion)];
        if (files.picture.empty())
            continue;
        enrol::Photo& photo = photos.emplace_back();
        photo.emotion = emotion;
        photo.picture = enrol::read_photo(files.picture);
        if (!files.landmarks.empty())
            photo.landmarks_px = enrol::read_landmarks(files.landmarks, photo.picture.size,
                                                       usual[std::size_t(emotion)]);
    }
    return photos;
}

// Said once where a model of landmarks is used.
void say_whose_model() {
    log::say(
        "The landmarks are found by dlib's model, which learned from photos whose licence excludes "
        "commercial use.");
}

// For photos that came without landmarks. `file` names a photo in sentences.
template <class NameOf>
void find_landmarks(std::vector<enrol::Photo>& photos, const enrol::PhotoGuide::Usual& usual,
                    const enrol::LandmarkFinder& finder, const NameOf& name_of) {
    bool is_said = false;
    for (enrol::Photo& photo : photos) {
        if (photo.landmarks_px)
            continue;
        if (!std::exchange(is_said, true) && finder.problem().empty())
            say_whose_model();
        const enrol::FoundLandmarks found = finder.find(photo.picture.view());
        if (!found.landmarks_px)
            throw Error("'" + name_of(photo.emotion) + "': " + found.problem + by_hand);
        if (const auto fault = face::landmark_fault(
                *found.landmarks_px, usual[std::size_t(photo.emotion)], photo.picture.size))
            throw Error("'" + name_of(photo.emotion) + "': what was found is no face. " +
                        enrol::reason_of(*fault) + "." + by_hand);
        if (found.faces > 1)
            log::say("'" + name_of(photo.emotion) + "' shows " + std::to_string(found.faces) +
                     " faces; the largest one is taken.");
        photo.landmarks_px = found.landmarks_px;
    }
}

// Throws Error where the person ends the window.
std::vector<enrol::Photo> ask_photos(const FaceWindow& wanted, enrol::PhotoGuide guide,
                                     std::unique_ptr<capture::Camera> camera,
                                     const enrol::LandmarkFinder& finder) {
    cli::catch_stop_signals();
    if (finder.problem().empty())
        say_whose_model();
    else
        log::say(finder.problem() + " You mark eight places of each photo instead.");
    set_language(parse_language(wanted.language).value_or(Language::english));
    window::DesktopWindow window(say(Phrase::enrol_title) + " - Theatron", parse_size(wanted.size),
                                 "Give each photo its landmarks in a .pts file instead.");
    auto photos = enrol::ask_photos(window, std::move(guide), std::move(camera), finder,
                                    [] { return cli::stop_requested(); });
    if (!photos)
        throw Error("The window was closed before the photos were done; nothing was written.");
    return std::move(*photos);
}

enrol::PhotoGuide::Usual usual_landmarks(const face::MorphModel& model) {
    enrol::PhotoGuide::Usual usual;
    for (std::size_t i = 0; i < face::emotion_count; ++i)
        usual[i] = face::usual_landmarks(model, face::Emotion(i));
    return usual;
}

std::vector<enrol::Photo> photos_of(const FaceEnrol& wanted, const face::MorphModel& model) {
    const enrol::LandmarkFinder finder(wanted.window.landmark_model);
    const enrol::PhotoGuide::Usual usual = usual_landmarks(model);
    if (!wanted.camera.empty()) {
        auto camera = capture::open_camera(capture::webcam_specification(wanted.camera));
        return ask_photos(wanted.window, enrol::PhotoGuide::from_camera(usual), std::move(camera),
                          finder);
    }
    std::vector<enrol::Photo> photos = read_photos(wanted, usual);
    if (wanted.window.mark)
        return ask_photos(wanted.window, enrol::PhotoGuide::of_photos(std::move(photos), usual),
                          nullptr, finder);
    find_landmarks(photos, usual, finder, [&](face::Emotion emotion) {
        return wanted.photos[std::size_t(emotion)].picture;
    });
    return photos;
}

nlohmann::json enrolment_json(const face::Enrolment& made,
                              const std::vector<enrol::Photo>& photos) {
    nlohmann::json residuals;
    for (std::size_t i = 0; i < photos.size(); ++i)
        residuals[std::string(to_text(photos[i].emotion))] = made.fit.photos[i].residual_px;
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

std::string enrolment_text(const face::Enrolment& made, const std::vector<enrol::Photo>& photos) {
    std::string text;
    for (std::size_t i = 0; i < photos.size(); ++i)
        text += std::string(to_text(photos[i].emotion)) + ": landmarks off by " +
                one_decimal(made.fit.photos[i].residual_px) + " px\n";
    return text + "eyes " + one_decimal(made.eyes_apart_mm) +
           " mm apart; the neutral photo shows " +
           std::to_string(int(100 * made.seen_share + 0.5)) + " % of the skin\n";
}

}  // namespace

void refuse_link_to_face(const std::string& file) {
    std::error_code none;
    if (fs::is_symlink(fs::symlink_status(file, none)))
        throw Error("'" + file + "' is a link to '" + fs::read_symlink(file, none).string() +
                    "'; name the face itself.");
}

void run_face_enrol(const FaceEnrol& wanted) {
    files::require_new(wanted.out, wanted.overwrite);
    refuse_link_to_face(wanted.out);
    files::require_own_kind(wanted.out, net::sealed_magic, "a face of 'theatron face enrol'");
    files::require_plain(wanted.out);
    files::require_writable(wanted.out);
    const face::MorphModel model = visit::read_face_model(wanted.model);
    if (model.vertex_count() > face::max_enrolled_vertices ||
        model.triangles.size() > face::max_enrolled_triangles)
        throw Error(
            "The model has too many vertices for a person's own face; take one with at "
            "most 65535, and twice as many triangles.");
    // Before the photos: a person who has gone through a window is not refused afterwards.
    const std::string passphrase = visit::face_passphrase(wanted.passphrase_file, true);
    const std::vector<enrol::Photo> photos = photos_of(wanted, model);
    std::vector<face::EnrolPhoto> seen;
    for (const enrol::Photo& photo : photos)
        seen.push_back(
            {photo.emotion, photo.picture.view(), *photo.landmarks_px, wanted.view_degrees});
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
    files::write_private_file(
        wanted.out, std::string(reinterpret_cast<const char*>(sealed.data()), sealed.size()));
    if (wanted.json)
        return output::result(files::json_text(enrolment_json(*made, photos)) + "\n");
    output::result(enrolment_text(*made, photos) + wanted.out +
                   ": written; look at it with "
                   "'theatron face show'\n");
}

void run_face_landmarks(const FaceLandmarks& wanted) {
    files::require_new(wanted.out, wanted.overwrite);
    files::require_other_file(wanted.out, wanted.photo);
    files::require_own_kind(wanted.out, "version:", "a .pts file of landmarks");
    files::require_plain(wanted.out);
    files::require_writable(wanted.out);
    std::vector<enrol::Photo> photos(1);
    photos[0].emotion = *face::emotion_of(wanted.emotion);
    photos[0].picture = enrol::read_photo(wanted.photo);
    const enrol::LandmarkFinder finder(wanted.window.landmark_model);
    const enrol::PhotoGuide::Usual usual = usual_landmarks(face::generated_head());
    if (wanted.window.mark)
        photos = ask_photos(wanted.window, enrol::PhotoGuide::of_photos(std::move(photos), usual),
                            nullptr, finder);
    else
        find_landmarks(photos, usual, finder, [&](face::Emotion) { return wanted.photo; });
    files::write_private_file(wanted.out, enrol::pts_text(*photos[0].landmarks_px));
    output::result(wanted.out + ": 68 landmarks\n");
}

}  // namespace theatron::app
