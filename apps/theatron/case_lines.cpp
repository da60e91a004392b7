// SPDX-License-Identifier: Apache-2.0
#include "case_lines.h"

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <iterator>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string_view>

#include "base/error.h"
#include "base/hex_text.h"
#include "base/log.h"
#include "medical/slice.h"
#include "medical/window.h"
#include "viewer/case_actions.h"
#include "viewer/tools/slice.h"

namespace theatron::app {
namespace {

// The organ's place where a script does not give one.
constexpr Vec3 usual_place{0, 1.3, 0}, usual_eye{0, 1.6, 1};

std::string rest_of(std::istream& words) {
    std::string text;
    std::getline(words >> std::ws, text);
    while (!text.empty() && (text.back() == ' ' || text.back() == '\r'))
        text.pop_back();
    return text;
}

std::string short_number(double value) {
    char text[32];
    std::snprintf(text, sizeof(text), "%.10g", value);
    return text;
}

double read_number(std::istream& words, double low, double high, const char* what) {
    double value = 0;
    if (!(words >> value) || !(value >= low && value <= high))
        throw Error(std::string(what) + " is a number from " + short_number(low) + " to " +
                    short_number(high) + ".");
    return value;
}

// "open NAME" asks, "open --yes NAME" opens. The question names no patient: lines and their answers
// often go into files.
void open_by_name(client::Participant& participant, std::string name) {
    constexpr std::string_view meant = "--yes ";
    const bool is_meant = name.starts_with(meant);
    if (is_meant)
        name.erase(0, name.find_first_not_of(' ', meant.size()));
    std::string names;
    for (const wire::OfferedCase& offered : participant.cases()) {
        if (offered.name == name && !is_meant)
            throw Error("Open the case '" + name + "' for all in the room? Say 'case open --yes " +
                        name + "'.");
        if (offered.name == name) {
            viewer::open_case(participant, *to_content_hash(offered.hash), usual_place, usual_eye);
            return;
        }
        names += (names.empty() ? "" : ", ") + offered.name;
    }
    throw Error("The host offers no case '" + name + "'; " +
                (names.empty() ? "it offers none." : "it offers " + names + "."));
}

// By number from 0, or by name.
std::size_t find_part(const client::Participant& participant, const std::string& which) {
    std::uint64_t version = 0;
    const auto open = participant.open_case(version);
    std::string names;
    if (open && open->description)
        for (std::size_t i = 0; i < open->description->parts.size(); ++i) {
            const std::string& name = open->description->parts[i].name;
            if (which == name || which == std::to_string(i))
                return i;
            names += (names.empty() ? "" : ", ") + name;
        }
    if (names.empty())
        throw Error("No case is open, or its parts have not come yet.");
    throw Error((which.empty() ? std::string("The line names no part")
                               : "The open case has no part '" + which + "'") +
                "; it has " + names + ".");
}

// One of `count` things of this kind, from 1.
std::size_t chosen_number(const std::string& text, std::size_t count, const std::string& kind) {
    if (count == 0)
        throw Error("The open case has no " + (kind == "series" ? "series of images" : kind + "s") +
                    ".");
    const bool is_number =
        !text.empty() && text.size() < 6 &&
        std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
    const std::size_t number = is_number ? std::size_t(std::stoi(text)) : 0;
    if (number >= 1 && number <= count)
        return number;
    throw Error((text.empty() ? "The line names no " + kind
                              : "The open case has no " + kind + " '" + text + "'") +
                (count == 1 ? "; it has one, which is number 1."
                            : "; it has " + std::to_string(count) + ", from 1."));
}

// "slice axial", "slice 12.5", "window liver", "window 60 400", "series 2", "picture 1".
bool change_screen(client::Participant& participant, const std::string& what, std::istream& words) {
    std::uint64_t version = 0;
    const auto open = participant.open_case(version);
    const auto room = session::case_in_room(participant.room().objects);
    if (!open || !room)
        return false;
    if (!room->screen)
        throw Error("The open case has neither images nor pictures.");
    session::CaseScreen screen = room->screen->facts;
    std::string which;
    words >> which;
    if (what == "picture" || what == "series") {
        const std::size_t count = what == "picture" ? open->pictures.size() : open->volumes.size();
        const std::size_t chosen = chosen_number(which, count, what);
        if (what == "picture")
            screen.picture = std::uint16_t(chosen - 1);
        else
            screen = viewer::of_series(screen, int(chosen) - 1, open->volumes[chosen - 1].get());
    } else if (what == "slice") {
        const auto volume =
            screen.series < open->volumes.size() ? open->volumes[screen.series] : nullptr;
        if (!volume)
            throw Error("The images have not come yet.");
        constexpr const char* names[] = {"axial", "coronal", "sagittal"};
        const auto named = std::find(std::begin(names), std::end(names), which);
        if (named != std::end(names)) {
            screen = viewer::turned(screen, *volume, medical::Orientation(named - names));
            words >> which;
        }
        if (named == std::end(names) || words) {
            if (named == std::end(names) && !which.empty() && std::isalpha(std::uint8_t(which[0])))
                throw Error("There is no plane '" + which +
                            "'; there are axial, coronal and sagittal.");
            std::istringstream number(which);
            screen.position_mm = read_number(number, -100'000, 100'000, "The place in millimetres");
            screen = viewer::scrolled(screen, *volume, 0);  // within the images
            screen.picture.reset();
        }
    } else {
        const auto presets = medical::window_presets();
        const auto preset = std::find_if(presets.begin(), presets.end(),
                                         [&](const auto& p) { return p.name == which; });
        if (preset != presets.end()) {
            screen.center = preset->window.center;
            screen.width = preset->window.width;
        } else if (!which.empty() && std::isalpha(std::uint8_t(which[0]))) {
            std::string all;
            for (const auto& known : presets)
                all += (all.empty() ? "" : ", ") + std::string(known.name);
            throw Error("There is no window '" + which + "'; there are " + all +
                        ", or give centre and width.");
        } else {
            std::istringstream number(which);
            screen.center = read_number(number, -1e9, 1e9, "The centre of a window");
            screen.width = read_number(words, 1e-9, 1e9, "The width of a window");
        }
    }
    return viewer::set_screen(participant, screen);
}

bool carry_out_case(client::Participant& participant, const std::string& what,
                    std::istream& words) {
    if (what == "open")
        return open_by_name(participant, rest_of(words)), true;
    if (what == "close")
        return viewer::close_case(participant);
    if (what == "hide" || what == "show")
        return viewer::show_part(participant, find_part(participant, rest_of(words)),
                                 what == "show");
    if (what == "opacity") {
        const double percent = read_number(words, 0, 100, "The opacity in percent");
        return viewer::set_opacity(participant, find_part(participant, rest_of(words)),
                                   percent / 100);
    }
    if (what == "explode")
        return viewer::explode(participant,
                               read_number(words, 0, 100, "The distance in percent") / 100);
    if (what == "together")
        return viewer::put_together(participant);
    if (what == "scale")
        return viewer::set_scale(participant, read_number(words, 0.01, 100, "The scale"));
    if (what == "cut" || what == "whole")
        return viewer::cut_at_slice(participant, what == "cut");
    if (what == "present") {
        std::string off;
        words >> off;
        if (!off.empty() && off != "off")
            throw Error("The line is 'case present' or 'case present off'.");
        return viewer::present(participant, off.empty());
    }
    if (what == "slice" || what == "window" || what == "series" || what == "picture")
        return change_screen(participant, what, words);
    throw Error("There is no such line on cases; 'theatron join --help' lists them.");
}

nlohmann::json screen_json(const session::CaseInRoom& room) {
    if (!room.screen)
        return nullptr;
    const session::CaseScreen& screen = room.screen->facts;
    return {{"object", std::uint32_t(room.screen->id)},
            {"series", screen.series},
            {"picture", screen.picture ? nlohmann::json(*screen.picture + 1) : nullptr},
            {"presenter", std::uint32_t(screen.presenter)},
            {"orientation", screen.orientation},
            {"position_mm", screen.position_mm},
            {"center", screen.center},
            {"width", screen.width}};
}

}  // namespace

const char* case_lines_help() {
    return "'case open NAME' (asks), 'case open --yes NAME', 'case close', 'case hide PART', 'case "
           "show PART',\n"
           "'case opacity PERCENT PART', 'case explode PERCENT', 'case together', 'case scale "
           "FACTOR',\n"
           "'case slice axial|coronal|sagittal [MM]', 'case slice MM', 'case window PRESET',\n"
           "'case window CENTRE WIDTH', 'case series NUMBER', 'case picture NUMBER',\n"
           "'case present', 'case present off', 'case cut', 'case whole'";
}

bool obey_case_line(client::Participant& participant, const std::string& line) {
    std::istringstream words(line);
    std::string word, what;
    words >> word >> what;
    if (word != "case")
        return false;
    try {
        if (!carry_out_case(participant, what, words))
            log::say("'" + line + "': " +
                     (session::case_in_room(participant.room().objects)
                          ? "The open case has not come yet."
                          : "No case is open."));
    } catch (const Error& error) {
        log::say("'" + line + "': " + error.what());
    }
    return true;
}

nlohmann::json case_json(const client::Participant& participant) {
    nlohmann::json offered = nlohmann::json::array();
    for (const wire::OfferedCase& one : participant.cases())
        offered.push_back(one.name);
    nlohmann::json json{{"offered", offered}, {"open", nullptr}};
    std::uint64_t version = 0;
    const auto open = participant.open_case(version);
    const auto room = session::case_in_room(participant.room().objects);
    if (!open || !room)
        return json;
    nlohmann::json parts = nlohmann::json::array();
    for (const auto& part : room->parts) {
        const std::size_t number = part.facts.part;
        const bool known = open->description && number < open->description->parts.size();
        parts.push_back({{"object", std::uint32_t(part.id)},
                         {"name", known ? open->description->parts[number].name : ""},
                         {"shown", part.facts.shown},
                         {"opacity", part.facts.opacity / 255.0},
                         {"is_here", known && open->meshes[number] != nullptr}});
    }
    json["open"] = {{"hash", hex_text(open->id.bytes)},
                    {"name", !room->name.empty() ? room->name
                             : open->description ? open->description->name
                                                 : ""},
                    {"complete", open->is_complete()},
                    {"got", open->progress.got},
                    {"all", open->progress.all},
                    {"problem", open->problem},
                    {"object", std::uint32_t(room->organ_id)},
                    {"explosion", room->organ.explosion / 255.0},
                    {"cut", room->organ.cut},
                    {"screen", screen_json(*room)},
                    {"pictures", open->pictures.size()},
                    {"parts", parts}};
    return json;
}

}  // namespace theatron::app
