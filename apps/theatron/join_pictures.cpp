// SPDX-License-Identifier: Apache-2.0
#include "join_pictures.h"

#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/log.h"
#include "base/small_letters.h"
#include "base/steady_clock.h"
#include "files/file_bytes.h"
#include "files/png_file.h"
#include "viewer/renderer_text.h"
#include "viewer/still_cover.h"

namespace theatron::app {
namespace {

// Mean distance of an adult's eyes.
constexpr double eye_distance_m = 0.063;
// Heads look along -z with y up, eyes along +z with y down; the same the other way round.
constexpr Pose eye_from_head{Quat{0, 1, 0, 0}, {}};

}  // namespace

Size parse_size(const std::string& text) {
    Size size;
    char end = 0;
    if (std::sscanf(text.c_str(), "%dx%d%c", &size.width, &size.height, &end) != 2 ||
        !is_valid(size))
        throw Error("The size '" + text + "' is not WIDTHxHEIGHT, for example 1280x720.");
    return size;
}

void check_picture_file(const std::string& file) {
    if (file.empty())
        return;
    const std::string ending = in_small_letters(std::filesystem::path(file).extension().string());
    for (const char* other : {".jpg", ".jpeg", ".bmp", ".gif", ".tif", ".tiff", ".webp", ".ppm"})
        if (ending == other)
            throw Error("Pictures are written as PNG; name '" + file + "' with the ending .png.");
    files::require_writable(file);
    files::require_own_kind(file, files::png_beginning, "a PNG picture");
}

OffscreenPicture::OffscreenPicture(ViewPicture wanted)
    : wanted_(std::move(wanted)),
      renderer_(wanted_.renderer),
      scene_(wanted_.room, wanted_.people) {
    viewer::check_renderer_choice(renderer_.renderer());
}

void OffscreenPicture::take(client::Participant& participant, RoomLines& room) {
    (void)scene_.take(participant);
    (void)scene_.fade(participant, steady_now());
    if (scene_.can_draw(wanted_.view) && !first_head_) {
        first_head_ = scene_.view(wanted_.view, wanted_.size).room_from_eye * eye_from_head;
        if (!room.head())
            room.stand(*first_head_);
    }
    if (room.head() != first_head_)
        stood_at_ = room.head();
    if (const auto command = participant.take_renderer_command())
        if (const std::string problem = viewer::follow_host(renderer_, *command); !problem.empty())
            log::say(problem);
    participant.tell_renderer(drawn_with());
}

std::string OffscreenPicture::drawn_with() const {
    return viewer::renderer_for(renderer_.renderer(), scene_.cameras());
}

void OffscreenPicture::add_to(nlohmann::json& json) const {
    const auto still = scene_.still();
    json["still_seconds"] = still ? nlohmann::json(to_seconds(*still)) : nlohmann::json();
}

void OffscreenPicture::write() {
    if (!scene_.has_picture())
        throw Error("No picture came from the host, so none was written.");
    if (const std::string cover = viewer::still_text(scene_.still()); !cover.empty())
        log::say(cover + "; it stands on the picture that is written.");
    for (const std::string& text : scene_.unseen_people())
        log::say(text);
    viewer::OffscreenView::Wish wish{wanted_.view, wanted_.size, drawn_with(), {}, {}};
    if (wanted_.stereo)
        wish.eye_distance_m = eye_distance_m;
    if (stood_at_)
        wish.room_from_eye = *stood_at_ * eye_from_head;
    if (!wanted_.color_file.empty())
        files::write_png(wanted_.color_file, scene_.picture(wish).view());
    if (!wanted_.depth_file.empty())
        files::write_png(wanted_.depth_file, scene_.distances(wish).view());
}

}  // namespace theatron::app
