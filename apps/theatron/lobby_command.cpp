// SPDX-License-Identifier: Apache-2.0
// theatron lobby
#include <cstdio>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "commands.h"
#include "files/file_bytes.h"
#include "files/json_text.h"
#include "files/png_file.h"
#include "host/lobby.h"
#include "link_argument.h"
#include "lobby_fields.h"

namespace theatron::app {
namespace {

// The names of a list, each with another field behind it.
std::string names(const nlohmann::json& session, const char* list, const char* field) {
    std::string all;
    if (session.contains(list) && session[list].is_array())
        for (const auto& entry : session[list]) {
            const std::string adjusted = text_field(entry, "adjusted");
            all += (all.empty() ? "" : ", ") + text_field(entry, "name") + " (" +
                   text_field(entry, field) +
                   (adjusted.empty() ? "" : "; by operators: " + adjusted) + ")";
        }
    return all;
}

void print(const nlohmann::json& lobby) {
    std::printf("Your link is of the role %s.\n", text_field(lobby, "role").c_str());
    if (!lobby.contains("sessions") || !lobby["sessions"].is_array())
        return;
    for (const auto& session : lobby["sessions"]) {
        if (is_field_set(session, "closed")) {
            const std::string problem = text_field(session, "problem");
            std::printf("%s: %s\n", text_field(session, "name").c_str(),
                        problem.empty() ? "is being opened" : ("not open. " + problem).c_str());
            continue;
        }
        const double people =
            session.contains("people_count") && session["people_count"].is_number()
                ? session["people_count"].get<double>()
                : 0;
        std::printf("%s: %.0f participant(s)%s%s\n", text_field(session, "name").c_str(), people,
                    is_field_set(session, "asks") ? ", an operator lets people in" : "",
                    is_field_set(session, "ended") ? ", ended" : "");
        if (is_field_set(session, "held_back"))
            std::printf("  %s\n", held_back);
        if (const std::string in = names(session, "people", "role"); !in.empty())
            std::printf("  people: %s\n", in.c_str());
        if (const std::string seen = names(session, "cameras", "state"); !seen.empty())
            std::printf("  cameras: %s\n", seen.c_str());
    }
}

// The address of the picture of this session; empty: of the link's own. Throws Error.
std::string picture_address(const nlohmann::json& lobby, const std::string& session) {
    std::string names;
    if (lobby.contains("sessions") && lobby["sessions"].is_array())
        for (const auto& shown : lobby["sessions"]) {
            if (session.empty() || text_field(shown, "name") == session)
                return text_field(shown, "thumbnail");
            names += (names.empty() ? "'" : ", '") + text_field(shown, "name") + "'";
        }
    throw Error("This link shows no session '" + session + "'; it shows " + names + ".");
}

// Only a picture is written, whatever a host gives.
void write_picture(const net::Link& link, const std::string& address, const std::string& file) {
    const auto png = host::thumbnail_of_host(link, net::https_patience, address);
    ColorImage picture;
    if (!png || !files::decode_png(as_bytes(*png), picture).empty())
        throw Error("The host gives no picture for this link.");
    files::write_png(file, picture.view());
}

}  // namespace

void add_lobby_command(CLI::App& app) {
    struct Flags {
        std::string link, picture, session;
        bool json = false;
    };
    const auto flags = std::make_shared<Flags>();
    CLI::App* command = app.add_subcommand("lobby", "The sessions of a host, before joining one");
    command->footer(
        "A link shows its own session. An operator's link of the host's first session shows all.\n"
        "\nExample: theatron lobby LINK --picture session.png");
    command->add_option("link", flags->link, "The link that the host printed, or @FILE with it")
        ->required();
    command->add_option("--picture", flags->picture,
                        "Write a small picture of its first camera into this PNG file");
    command->add_option("--session", flags->session,
                        "The session of that picture; without it the link's own");
    command->add_flag("--json", flags->json, "Print everything as one JSON line");
    command->callback([flags] {
        const net::Link link = parse_link_argument(flags->link);
        const nlohmann::json lobby = host::lobby_of_host(link);
        if (flags->json)
            std::printf("%s\n", files::json_text(lobby).c_str());
        else
            print(lobby);
        if (!flags->picture.empty())
            write_picture(link, picture_address(lobby, flags->session), flags->picture);
    });
}

}  // namespace theatron::app
