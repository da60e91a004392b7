// SPDX-License-Identifier: Apache-2.0
#include "mark_lines.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "base/error.h"
#include "base/log.h"
#include "session/mark.h"
#include "session/shared_screen.h"
#include "viewer/tools/mark_actions.h"

namespace theatron::app {
namespace {

using session::Mark;
using session::MarkedSurface;
using session::MarkKind;

// The surface that an object is; throws Error for other objects.
MarkedSurface surface_of(const client::Participant::Room& room, std::uint32_t number) {
    const auto found = room.objects.find(session::ObjectId(number));
    if (found != room.objects.end() && found->second.kind == session::ObjectKind::organ)
        return MarkedSurface::organ;
    if (found != room.objects.end() && found->second.kind == session::ObjectKind::screen &&
        !session::is_shared_screen(found->second))
        return MarkedSurface::slice;
    throw Error("There is no organ or screen of this number; --json lists them under \"cases\".");
}

// Scripts know no normals: upwards on the cloud, away from the middle of an organ, and towards the
// front in its images.
Vec3 normal_at(MarkedSurface surface, Vec3 place) {
    if (surface == MarkedSurface::slice)
        return {0, 0, 1};
    const double reach = length(place);
    return surface == MarkedSurface::cloud || reach < 1e-6 ? Vec3{0, 1, 0} : place * (1 / reach);
}

Mark read_mark(MarkKind kind, std::istream& words, const client::Participant::Room& room) {
    Mark mark;
    mark.kind = kind;
    if ((words >> std::ws).peek() == 'o') {
        std::string on;
        if (!(words >> on >> mark.object) || on != "on")
            throw Error("'on' is followed by the number of an organ, a part or a screen.");
        mark.surface = surface_of(room, mark.object);
    }
    double value = 0;
    std::vector<double> values;
    while (words >> value) {
        if (!(std::abs(value) <= session::farthest_mark_point_m))
            break;
        values.push_back(value);
    }
    const std::size_t points = values.size() / 3;
    const std::size_t needed = kind == MarkKind::pin ? 1 : 2;
    if (!words.eof() || values.size() % 3 != 0 || points < needed ||
        (kind != MarkKind::stroke && points != needed))
        throw Error(
            "A pin needs one place, an arrow and a distance two, a stroke two or more, "
            "each X Y Z in metres, none beyond 1000: for example 'mark pin 0.2 1.25 0.3'.");
    if (kind != MarkKind::stroke && needed == 2 &&
        std::equal(values.begin(), values.begin() + 3, values.begin() + 3))
        throw Error("An arrow and a distance need two different places.");
    for (std::size_t i = 0; i < points; ++i) {
        const Vec3 place{values[3 * i], values[3 * i + 1], values[3 * i + 2]};
        mark.points.push_back({place, normal_at(mark.surface, place)});
    }
    return mark;
}

bool carry_out_mark(client::Participant& participant, const std::string& what,
                    std::istream& words) {
    std::string all;
    if (what == "undo" && !(words >> all))
        return viewer::undo_mark(participant);
    if (what == "undo")
        throw Error("'mark undo' removes your newest mark and takes no number.");
    if (what == "clear" && (!(words >> all) || all == "all"))
        return viewer::clear_marks(participant, all == "all");
    for (const MarkKind kind :
         {MarkKind::stroke, MarkKind::arrow, MarkKind::pin, MarkKind::distance})
        if (what == session::to_text(kind))
            return viewer::make_mark(participant, read_mark(kind, words, participant.room()));
    throw Error(std::string("The lines on marks are ") + mark_lines_help() + ".");
}

}  // namespace

const char* mark_lines_help() {
    return "'mark pin|arrow|stroke|distance [on NUMBER] X Y Z ...', 'mark undo',\n"
           "'mark clear [all]'";
}

bool obey_mark_line(client::Participant& participant, const std::string& line) {
    std::istringstream words(line);
    std::string mark, what;
    words >> mark >> what;
    if (mark != "mark")
        return false;
    try {
        if (!carry_out_mark(participant, what, words))
            log::say("'" + line.substr(0, 80) + "': There is no such mark.");
    } catch (const Error& e) {
        log::say("'" + line.substr(0, 80) + "': " + e.what());
    }
    return true;
}

}  // namespace theatron::app
