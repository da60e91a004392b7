// SPDX-License-Identifier: Apache-2.0
// The figures of a host as a table for people.
#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "files/json_fields.h"
#include "host/filter_choice.h"
#include "host/host_figures.h"

namespace theatron::host {

using files::is_field_set, files::list_field, files::number_field, files::text_field;

std::string to_table(const nlohmann::json& figures) {
    const auto cameras = list_field(figures, "cameras"),
               participants = list_field(figures, "participants");
    char line[400];
    std::snprintf(line, sizeof(line), "%s: %zu camera(s), %zu participant(s), %.0f s\n",
                  text_field(figures, "name").c_str(), cameras.size(), participants.size(),
                  number_field(figures, "seconds"));
    std::string table = line;
    const auto count = [&](const char* field, const char* what) {
        if (const double value = number_field(figures, field); value > 0) {
            std::snprintf(line, sizeof(line), "%s: %.0f\n", what, value);
            table += line;
        }
    };
    count("faults", "faults inside the host, see its log");
    count("turned_away", "strangers turned away");
    if (const std::string problem = text_field(figures, "page_problem"); !problem.empty())
        table += problem + "\n";
    if (figures.contains("problems") && figures["problems"].is_object())
        for (const char* of : {"audit_log", "room", "links"})
            if (const std::string problem = text_field(figures["problems"], of); !problem.empty())
                table += problem + "\n";
    for (const auto& certificate : list_field(figures, "certificates"))
        if (const std::string problem = text_field(certificate, "problem"); !problem.empty())
            table += problem + "\n";
    for (const auto& problem : list_field(figures, "case_problems"))
        if (problem.is_string())
            table += problem.get<std::string>() + "\n";
    std::snprintf(line, sizeof(line), "%-24s %-7s %6s %8s %8s %8s %8s %8s  %s\n", "camera", "state",
                  "fps", "age ms", "lane ms", "p99 ms", "dropped", "reopens", "filter");
    table += line;
    for (const auto& camera : cameras) {
        double p50 = 0, p99 = 0;
        for (const auto& stage : list_field(camera, "stages"))
            if (text_field(stage, "name") == "lane") {
                p50 = number_field(stage, "p50_ms");
                p99 = number_field(stage, "p99_ms");
            }
        const std::string filter = text_field(camera, "filter");
        std::snprintf(line, sizeof(line),
                      "%-24.24s %-7.7s %6.1f %8.0f %8.2f %8.2f %8.0f %8.0f  %s\n",
                      text_field(camera, "name").c_str(), text_field(camera, "state").c_str(),
                      number_field(camera, "fps"), number_field(camera, "age_ms"), p50, p99,
                      number_field(camera, "dropped_newest"), number_field(camera, "reopens"),
                      shown_filter(filter).c_str());
        table += line;
        if (const std::string problem = text_field(camera, "problem"); !problem.empty())
            table += "    " + problem + "\n";
        if (const std::string adjusted = text_field(camera, "adjusted"); !adjusted.empty())
            table += "    by operators: " + adjusted + "\n";
    }
    if (figures.contains("registration") && figures["registration"].is_object()) {
        const auto& registration = figures["registration"];
        const std::string made = text_field(registration, "made"),
                          method = text_field(registration, "method"),
                          problem = text_field(registration, "problem");
        if (!made.empty() || !method.empty())
            table += "places of cameras: " + (made.empty() ? "" : made + ", ") + method + "\n";
        if (!problem.empty())
            table += problem + "\n";
    }
    if (const std::string color = text_field(figures, "automatic_color"); !color.empty())
        table += "automatic colour is " + color + "\n";
    if (const auto skew = figures.find("skew_ms"); skew != figures.end() && skew->is_object()) {
        std::snprintf(line, sizeof(line),
                      "cameras %.0f ms apart (at most %.0f), %.0f pictures alone\n",
                      number_field(*skew, "p50"), number_field(*skew, "max"),
                      number_field(figures, "unpaired"));
        table += line;
    }
    for (const auto& camera : list_field(figures, "published")) {
        // Hosts of version 0.1.0 do not say whose it is.
        const std::string whose = text_field(camera, "whose");
        std::snprintf(line, sizeof(line), "camera %.0f %.200s of participant %.0f: %.7s",
                      number_field(camera, "id"),
                      (whose.empty() ? text_field(camera, "name") : whose).c_str(),
                      number_field(camera, "publisher"), text_field(camera, "state").c_str());
        const std::string adjusted = text_field(camera, "adjusted");
        table += line + (adjusted.empty() ? adjusted : "; by operators: " + adjusted) + "\n";
    }
    for (const auto& participant : participants) {
        const std::string renderer = text_field(participant, "renderer");
        std::snprintf(line, sizeof(line),
                      "participant %.0f %.100s: ", number_field(participant, "id"),
                      text_field(participant, "name").c_str());
        table += line;
        if (const auto age = participant.find("age_ms");
            age != participant.end() && age->is_number()) {
            std::snprintf(line, sizeof(line), "newest picture %.0f ms old", age->get<double>());
            table += line;
        } else
            table += "shows no pictures";
        if (!renderer.empty())
            table += ", drawn with " + renderer.substr(0, 40);
        if (const std::string role = text_field(participant, "role"); !role.empty())
            table += ", " + role;
        if (is_field_set(participant, "muted"))
            table += ", muted";
        if (const double denied = number_field(participant, "denied_messages"); denied > 0) {
            std::snprintf(line, sizeof(line), ", %.0f messages not allowed", denied);
            table += line;
        }
        if (const double refused = number_field(participant, "refused_requests"); refused > 0) {
            std::snprintf(line, sizeof(line), ", %.0f requests refused", refused);
            table += line;
        }
        table += "\n";
    }
    for (const auto& visitor : list_field(figures, "visitors"))
        table +=
            "waits to be let in: " +
            (visitor.contains("name") ? text_field(visitor, "name") : "somebody") + " (" +
            text_field(visitor, "role") + (is_field_set(visitor, "records") ? ", records" : "") +
            (visitor.contains("person") ? ", person " + text_field(visitor, "person") : "") + ")\n";
    for (const auto& session : list_field(figures, "sessions"))
        table += "\n" + to_table(session);
    for (const auto& session : list_field(figures, "closed_sessions")) {
        const std::string problem = text_field(session, "problem");
        table += "\n" + text_field(session, "name") + ": " +
                 (problem.empty() ? "is being opened" : "not open. " + problem) + "\n";
    }
    return table;
}

}  // namespace theatron::host
