// SPDX-License-Identifier: Apache-2.0
#include "compare_output.h"

#include <nlohmann/json.hpp>

#include "compare_page_parts.h"
#include "compare_verdict.h"
#include "svg_drawing.h"
#include "table1_inputs.h"
#include "table1_output.h"

namespace theatron::bench {
namespace {

std::string column(const std::string& text, std::size_t width) {
    return std::string(text.size() < width ? width - text.size() : 0, ' ') + text;
}

std::string pad_right(const std::string& text, std::size_t width) {
    return text + std::string(text.size() < width ? width - text.size() : 0, ' ');
}

std::string counted(int number, const char* one, const char* many) {
    return std::to_string(number) + " " + (number == 1 ? one : many);
}

std::string drawn_by(const std::string& renderer) {
    if (renderer.empty())
        return "no GL.";
    return renderer.find("llvmpipe") == std::string::npos
               ? "pictures drawn by " + renderer + "."
               : "pictures drawn by the processor, without a graphics card (" + renderer + ").";
}

// The wound and what drawing costs.
std::string wound_table(const Compared& c) {
    std::string text =
        "\n" + pad_right("", 32) +
        column("of the " + whole_text(c.near_wound_m * 100) + " cm around the wound", 52) +
        column("all cameras' picture, ms", 30) + "\n" + pad_right("", 32) +
        column("rightly %", 10) + column("wrongly %", 10) + column("not shown %", 12) +
        column("1 mm %", 8) + column("mm/pixel", 12) + column("sender", 10) +
        column("receiver", 10) + column("drawing", 10) + "\n";
    for (const CompareMethod& m : c.methods) {
        if (!m.is_measured())
            continue;
        text += pad_right(m.name, 32);
        const CompareShares shares = m.wound ? m.wound->near : CompareShares();
        const auto figure = [&](double value, std::size_t width) {
            return column(m.wound ? formatted("%.1f", value) : "none", width);
        };
        text += figure(shares.rightly_percent, 10) + figure(shares.wrongly_percent, 10) +
                figure(shares.hidden_percent, 12) + figure(shares.finely_percent, 8) +
                column(shares.detail_mm > 0 ? formatted("%.1f", shares.detail_mm) : "none", 12) +
                column(formatted("%.1f", m.sender_of_all_ms), 10) +
                column(formatted("%.1f", m.receiver_of_all_ms), 10) +
                column(m.drawn_on.empty() ? "none" : formatted("%.1f", m.drawing_ms), 10) + "\n";
    }
    return text;
}

nlohmann::json size_json(Size size) {
    return {{"width", size.width}, {"height", size.height}};
}

nlohmann::json text_or_null(const std::string& text) {
    return text.empty() ? nlohmann::json(nullptr) : nlohmann::json(text);
}

nlohmann::json likeness_json(const CompareLikeness& likeness) {
    return {{"psnr_db", likeness.psnr_db},
            {"ssim", likeness.ssim},
            {"holes_percent", likeness.holes_percent},
            {"undrawn_percent", likeness.undrawn_percent},
            {"undrawn_unseen_percent", likeness.undrawn_unseen_percent},
            {"see_through_percent", likeness.see_through_percent}};
}

nlohmann::json causes_json(const CompareCauses& causes) {
    return {{"no_camera_percent", causes.no_camera},
            {"sensor_percent", causes.sensor},
            {"filters_percent", causes.filters},
            {"drawing_percent", causes.drawing}};
}

nlohmann::json shares_json(const CompareShares& shares) {
    return {{"rightly_percent", shares.rightly_percent},
            {"wrongly_percent", shares.wrongly_percent},
            {"hidden_percent", shares.hidden_percent},
            {"finely_percent", shares.finely_percent},
            {"detail_mm",
             shares.detail_mm > 0 ? nlohmann::json(shares.detail_mm) : nlohmann::json(nullptr)}};
}

nlohmann::json wound_json(const CompareWound& wound) {
    return {{"near", shares_json(wound.near)},
            {"whole", shares_json(wound.whole)},
            {"lost", wound.lost ? causes_json(*wound.lost) : nlohmann::json(nullptr)}};
}

nlohmann::json close_up_json(const CompareCloseUp& close_up) {
    nlohmann::json result = likeness_json(*close_up.likeness);
    if (close_up.see_through)
        result["see_through_causes"] = causes_json(*close_up.see_through);
    if (close_up.instruments)
        result["instruments_missing"] = causes_json(*close_up.instruments);
    return result;
}

nlohmann::json method_json(const CompareMethod& method) {
    nlohmann::json result = {{"id", method.id},
                             {"name", method.name},
                             {"plain", method.plain},
                             {"ran", method.ran},
                             {"reason", text_or_null(method.reason)},
                             {"expert_reason", text_or_null(method.expert_reason)}};
    for (const char* key : {"cameras", "mbit_of_all", "mbit_per_camera", "sender_ms", "receiver_ms",
                            "sender_of_all_ms", "receiver_of_all_ms", "drawing_ms", "drawn_on",
                            "links", "own_view", "expert", "close_up", "wound"})
        result[key] = nullptr;
    if (method.is_measured()) {
        result["cameras"] = method.cameras;
        result["mbit_of_all"] = method.mbit_of_all();
        result["mbit_per_camera"] = method.mbit_per_camera;
        result["sender_ms"] = method.sender_ms;
        result["receiver_ms"] = method.receiver_ms;
        result["sender_of_all_ms"] = method.sender_of_all_ms;
        result["receiver_of_all_ms"] = method.receiver_of_all_ms;
        result["links"] = nlohmann::json::array();
        for (const LinkFigures& f : method.links)
            result["links"].push_back(
                {{"mbit", f.link.mbit},
                 {"latency_ms", f.link.latency_ms},
                 {"pictures_per_s", f.pictures_per_s},
                 {"delay_ms", {{"mean", f.delay_ms}, {"p95", f.delay_p95_ms}}}});
    }
    if (!method.drawn_on.empty()) {
        result["drawing_ms"] = method.drawing_ms;
        result["drawn_on"] = method.drawn_on;
    }
    if (method.wound)
        result["wound"] = wound_json(*method.wound);
    if (method.own_view)
        result["own_view"] = {{"psnr_db", method.own_view->psnr_db},
                              {"ssim", method.own_view->ssim}};
    if (method.expert)
        result["expert"] = likeness_json(*method.expert);
    if (method.close_up && method.close_up->likeness)
        result["close_up"] = close_up_json(*method.close_up);
    return result;
}

}  // namespace

std::string link_text(const CompareLink& link) {
    return figure_text(link.mbit) + " Mbit/s, " + figure_text(link.latency_ms) + " ms";
}

std::vector<std::string> compare_remarks(const Compared& c) {
    std::vector<std::string> remarks;
    remarks.push_back(
        "Input: the generated operating room, " + counted(c.cameras, "camera", "cameras") + ", " +
        counted(c.frames, "picture", "pictures") + " each at 30 a second; depth " +
        size_text(c.depth) + ", colour " + size_text(c.color) + ", with the noise of sensors.");
    remarks.push_back("Machine: " + c.processor + ", " + counted(c.cores, "core", "cores") + "; " +
                      drawn_by(c.gl_renderer));
    if (c.cores_of_others > 0.2)
        remarks.push_back("Other programs used " + formatted("%.1f", c.cores_of_others) +
                          " cores before the first measurement. Processor times are those of the "
                          "work itself, and a little longer for that.");
    return remarks;
}

std::vector<std::string> compare_limits() {
    return {
        "The operation is generated. Its cameras have the noise and the gaps of real ones, but no "
        "blood on a lens, no smoke and no lamp that blinds a sensor.",
        "The lines are simulated, without losses and without other users. The age of a "
        "picture is without the time that camera, drawing and display take; this holds for every "
        "way.",
        "The video calls' cameras hang where Theatron's do, and one of them is zoomed to the "
        "wound. "
        "Somebody in the room could put a camera nearer or turn it when the expert asks.",
        "No figure says whether an expert decides better or sooner. That takes a study with "
        "surgeons."};
}

std::vector<std::string> compare_notes() {
    return {
        "Age is from the moment of the picture until it is decoded. Each camera has a processor "
        "core of its own in this. Drawing is in neither: it has a row of its own.",
        "A pixel counts as the part of the wound that it covers across the line of sight. What the "
        "codec loses of it is not in this figure.",
        "Whether colours are right is not in what is shown rightly, where the surface alone "
        "counts; the likeness says it.",
        "Data is that of the pictures after the first one, which no other precedes and which is "
        "larger.",
        "Each video call is one encoder at one rate. Products for video calls add and leave out "
        "much that is not measured here, sound among it.",
        "The near camera hangs on the side from which the expert looks; other places were not "
        "measured.",
        "The research system is rebuilt from what its authors say (Fischer et al. 2022); their own "
        "program was not run. Its depth loses detail for fewer bytes, the one here does not.",
        "PCL's codec is the one that cwipc's grew out of. cwipc itself was not run."};
}

std::string compare_text(const Compared& c) {
    std::string text;
    for (const std::string& remark : compare_remarks(c))
        text += remark + "\n";
    text += "\n" + pad_right("", 32) + column("cameras", 8) + column("Mbit/s", 9) +
            column("Mbit/s", 9) + column("sender", 9) + column("receiver", 10);
    for (const CompareLink& link : c.links)
        text += column(link_text(link), 23);
    text += column("from the expert's place", 60) + "\n" + pad_right("", 32) + column("", 8) +
            column("in all", 9) + column("a camera", 9) + column("ms", 9) + column("ms", 10);
    for (std::size_t i = 0; i < c.links.size(); ++i)
        text += column("pictures/s   delay ms", 23);
    text += column("PSNR dB", 12) + column("SSIM", 8) + column("holes %", 9) + column("dark %", 8) +
            column("unseen %", 10) + column("through %", 11) + "\n";
    for (const CompareMethod& m : c.methods) {
        text += pad_right(m.name, 32);
        if (!m.is_measured()) {
            text += "not measured: " + m.reason + "\n";
            continue;
        }
        text += column(std::to_string(m.cameras), 8) +
                column(formatted("%.1f", m.mbit_of_all()), 9) +
                column(formatted("%.1f", m.mbit_per_camera), 9) +
                column(formatted("%.1f", m.sender_ms), 9) +
                column(formatted("%.1f", m.receiver_ms), 10);
        for (const LinkFigures& f : m.links)
            text += column(formatted("%.1f", f.pictures_per_s), 12) +
                    column(formatted("%.0f", f.delay_ms), 11);
        if (m.expert)
            text += column(formatted("%.1f", m.expert->psnr_db), 12) +
                    column(formatted("%.3f", m.expert->ssim), 8) +
                    column(formatted("%.1f", m.expert->holes_percent), 9) +
                    column(formatted("%.1f", m.expert->undrawn_percent), 8) +
                    column(formatted("%.1f", m.expert->undrawn_unseen_percent), 10) +
                    column(formatted("%.1f", m.expert->see_through_percent), 11);
        else
            text += "  none";
        text += "\n";
    }
    text += wound_table(c);
    if (const std::vector<std::string> verdict = compare_verdict(c); !verdict.empty()) {
        text += "\nWhat may be judged from it:\n";
        for (const std::string& sentence : verdict)
            text += "  " + sentence + "\n";
    }
    text += "\nWhat ran:\n";
    for (const CompareMethod& m : c.methods) {
        text += "  " + m.name + ": " + m.ran + ".\n";
        if (m.is_measured() && !m.expert_reason.empty())
            text += "    " + m.expert_reason + "\n";
    }
    text += "\nWhat the figures do not say:\n";
    for (const std::vector<std::string>& sentences : {compare_limits(), compare_notes()})
        for (const std::string& sentence : sentences)
            text += "  " + sentence + "\n";
    return text;
}

nlohmann::json compare_json(const Compared& c) {
    nlohmann::json methods = nlohmann::json::array();
    for (const CompareMethod& method : c.methods)
        methods.push_back(method_json(method));
    return {{"here",
             {{"processor", c.processor},
              {"cores", c.cores},
              {"cores_of_others", c.cores_of_others},
              {"gl_renderer", text_or_null(c.gl_renderer)}}},
            {"cameras", c.cameras},
            {"frames", c.frames},
            {"pictures_per_s", compare_pictures_per_s},
            {"depth", size_json(c.depth)},
            {"color", size_json(c.color)},
            {"picture", size_json(c.picture)},
            {"places", c.places},
            {"near_wound_m", c.near_wound_m},
            {"close_up_width_m", c.close_up_width_m},
            {"methods", methods}};
}

}  // namespace theatron::bench
