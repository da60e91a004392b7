// SPDX-License-Identifier: Apache-2.0
#include "compare_page.h"

#include <functional>

#include "compare_output.h"
#include "data_url.h"
#include "svg_drawing.h"

namespace theatron::bench {
namespace {

constexpr const char* compare_head = R"(<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>Theatron beside a video call</title>
<style>
body { font: 16px/1.5 sans-serif; color: #1c1c1c; background: #fff; margin: 0 auto; padding: 1.5rem; max-width: 72rem; }
h1 { font-size: 1.7rem; line-height: 1.25; }
h2 { font-size: 1.25rem; margin-top: 2.2rem; }
.sub, small { color: #555; }
.pictures { display: grid; grid-template-columns: repeat(6, 1fr); gap: 1.2rem; }
.pictures figure { grid-column: span 2; }
.pictures figure.wide { grid-column: span 3; }
@media (max-width: 50rem) { .pictures figure, .pictures figure.wide { grid-column: span 6; } }
figure { margin: 0; }
figure img, .none { width: 100%; aspect-ratio: 16 / 9; display: block; background: #111; }
.none { background: #eef0f3; color: #555; display: flex; align-items: center; justify-content: center; text-align: center; padding: 1rem; box-sizing: border-box; font-size: .9rem; }
figcaption { margin-top: .35rem; line-height: 1.4; }
figcaption small { display: block; }
.best { outline: 3px solid #1f5fa8; }
.truth { outline: 3px solid #2e7d32; }
.other { outline: 3px dashed #b35900; }
.warn { color: #8a4500; }
.scroll { overflow-x: auto; }
table { border-collapse: collapse; width: 100%; font-size: .95rem; }
th, td { text-align: left; vertical-align: top; padding: .45rem .6rem; border-bottom: 1px solid #ddd; }
thead th { border-bottom: 2px solid #888; }
tbody th { font-weight: normal; width: 34%; }
tbody th small { display: block; }
td { white-space: nowrap; }
td.word { white-space: normal; color: #555; }
tr.part th { font-weight: bold; background: #f3f5f8; }
</style>
</head>
<body>
)";

std::string whole(double value) {
    return formatted("%.0f", value);
}
std::string tenths_of(double value) {
    return formatted("%.1f", value);
}

std::string list_item(const std::string& text) {
    return "<li>" + escaped(text) + "</li>\n";
}

std::string line_text(const CompareLink& link) {
    return "a line of " + whole(link.mbit) + " Mbit/s";
}

// "10 pictures a second, 140 ms old".
std::string arrival_text(const LinkFigures& f) {
    return whole(f.pictures_per_s) + " pictures a second, each " + whole(f.delay_ms) +
           " ms old on arrival";
}

std::string in_words(const Compared& c) {
    const CompareMethod *call = c.find(video_call_id), *ours = c.find(theatron_id),
                        *paper = c.find(paper_id), *pcl = c.find(pcl_id);
    std::string text = "<h2>In short</h2>\n<ul>\n";
    if (call && call->reason.empty())
        text += list_item("A video call needs the least: " + tenths_of(call->mbit_per_camera) +
                          " Mbit/s. The expert sees what one camera sees, and cannot step aside or "
                          "look past a head or a hand that is in the way.");
    if (ours && ours->reason.empty() && ours->expert) {
        text += list_item(
            "With Theatron the expert looks from any place, as if standing in the room. From "
            "beside the table " +
            tenths_of(ours->expert->holes_percent) +
            " % of the surfaces that the cameras see are missing from the picture. Places that no "
            "camera sees stay empty; more cameras fill them.");
        std::string cost = "That costs " + tenths_of(ours->mbit_per_camera) +
                           " Mbit/s for each of " + std::to_string(ours->cameras) + " cameras";
        if (call && call->reason.empty())
            cost += ", " + whole(ours->mbit_per_camera * ours->cameras / call->mbit_per_camera) +
                    " times the video call in all";
        cost += ", and a computer with a graphics card for the expert.";
        text += list_item(cost);
        std::string others;
        const auto add = [&](const CompareMethod* other, const std::string& name) {
            if (other && other->reason.empty())
                others += (others.empty() ? "" : ", ") + name + " " +
                          tenths_of(other->mbit_per_camera) + " Mbit/s a camera" +
                          (other->expert
                               ? " with " + tenths_of(other->expert->holes_percent) + " % missing"
                               : "");
        };
        add(paper, "the published pipeline takes");
        add(pcl, "a general point cloud codec");
        if (!others.empty())
            text += list_item("For the same freedom, " + others + ".");
    }
    if (ours && call && ours->reason.empty() && call->reason.empty())
        for (std::size_t i = 0; i < ours->links.size(); ++i)
            text += list_item("On " + line_text(ours->links[i].link) + ": Theatron has " +
                              arrival_text(ours->links[i]) + "; the video call " +
                              arrival_text(call->links[i]) + ".");
    return text + "</ul>\n";
}

std::string image(const ColorImage& picture, const char* kind, const std::string& alt) {
    return "<img class=\"" + std::string(kind) + "\" src=\"" + picture_url(picture) + "\" alt=\"" +
           escaped(alt) + "\">";
}

enum class FigureKind { ordinary, wide, wide_with_warning };

std::string figure(const std::string& picture, const std::string& title, const std::string& line,
                   FigureKind kind = FigureKind::ordinary) {
    const bool warns = kind == FigureKind::wide_with_warning;
    return (kind == FigureKind::ordinary ? "<figure>" : "<figure class=\"wide\">") + picture +
           "<figcaption><b>" + escaped(title) + "</b><small" + (warns ? " class=\"warn\"" : "") +
           ">" + escaped(line) + "</small></figcaption></figure>\n";
}

// The picture that a method shows at one place of the expert.
std::string figure_of(const CompareMethod& method, std::size_t place) {
    const bool is_call = method.id == video_call_id;
    const FigureKind kind = is_call ? FigureKind::wide : FigureKind::ordinary;
    if (!method.reason.empty())
        return figure("<div class=\"none\">not measured here</div>", method.name, method.reason,
                      kind);
    if (method.pictures.empty())
        return figure("<div class=\"none\">no picture</div>", method.name, method.expert_reason,
                      kind);
    const ColorImage& picture = method.pictures[place < method.pictures.size() ? place : 0];
    if (is_call)
        return figure(image(picture, "other", "what the camera of the video call sees"),
                      method.name,
                      place == 0 ? "This is the camera's place, not the expert's. A video call can "
                                   "show no other one."
                                 : "The same picture as before: the camera does not move with the "
                                   "expert.",
                      FigureKind::wide_with_warning);
    std::string line;
    if (place < method.from_place.size())
        line = tenths_of(method.from_place[place].holes_percent) +
               " % of what the cameras see is missing; likeness " +
               tenths_of(method.from_place[place].psnr_db) + " dB (higher is better).";
    return figure(image(picture, method.id == theatron_id ? "best" : "",
                        method.name + ", from the expert's place"),
                  method.name, line);
}

std::string pictures(const Compared& c) {
    std::string text;
    for (std::size_t place = 0; place < c.places.size(); ++place) {
        text += place == 0
                    ? "<h2>The same moment, for an expert " + escaped(c.places[place]) + "</h2>\n"
                    : "<h2>The expert takes " + escaped(c.places[place]) + "</h2>\n";
        if (place == 0)
            text +=
                "<p class=\"sub\">Each method had the same cameras and the same second of the "
                "operation. Dark parts are seen by no camera, or are missing.</p>\n";
        text += "<div class=\"pictures\">\n" +
                figure(image(c.truth[place], "truth", "what is there"), "What is really there",
                       "Drawn from the generated room itself.", FigureKind::wide);
        for (const CompareMethod& method : c.methods)
            text += figure_of(method, place);
        text += "</div>\n";
    }
    return text;
}

std::string table(const Compared& c) {
    std::string text =
        "<h2>What it costs and what it gives</h2>\n<div "
        "class=\"scroll\"><table>\n<thead><tr><th></th>";
    for (const CompareMethod& method : c.methods)
        text += "<th>" + escaped(method.name) + "</th>";
    text += "</tr></thead>\n<tbody>\n";
    const std::string columns = std::to_string(c.methods.size() + 1);
    using Cell = std::function<std::string(const CompareMethod&)>;
    const auto part = [&](const std::string& title) {
        text +=
            "<tr class=\"part\"><th colspan=\"" + columns + "\">" + escaped(title) + "</th></tr>\n";
    };
    const auto row = [&](const std::string& title, const std::string& meaning, const Cell& cell) {
        text += "<tr><th>" + escaped(title) + "<small>" + escaped(meaning) + "</small></th>";
        for (const CompareMethod& method : c.methods)
            text += !method.reason.empty() ? std::string("<td class=\"word\">not measured</td>")
                                           : "<td>" + escaped(cell(method)) + "</td>";
        text += "</tr>\n";
    };
    const auto expert = [](double CompareLikeness::*figure, const char* format) {
        return [=](const CompareMethod& m) {
            return m.expert ? formatted(format, (*m.expert).*figure)
                            : std::string("no such picture");
        };
    };
    part("What the expert gets");
    row("Looks from any place", "or only from where a camera hangs",
        [](const CompareMethod& m) { return std::string(m.id == video_call_id ? "no" : "yes"); });
    row("Missing surfaces, %", "of those that a camera sees; lower is better",
        expert(&CompareLikeness::holes_percent, "%.1f"));
    row("Empty picture, %", "seen by no camera, or missing; lower is better",
        expert(&CompareLikeness::undrawn_percent, "%.1f"));
    row("Likeness from the expert's place, dB",
        "PSNR against the exact picture, where a camera sees the surface; higher is better",
        expert(&CompareLikeness::psnr_db, "%.1f"));
    row("Likeness of structure", "SSIM, 1 is equal; higher is better",
        expert(&CompareLikeness::ssim, "%.3f"));
    row("Likeness of the camera's own picture, dB", "what a video call is good at",
        [](const CompareMethod& m) {
            return m.own_view ? tenths_of(m.own_view->psnr_db) : std::string("sends none");
        });
    part("What it costs");
    row("Cameras", "", [](const CompareMethod& m) { return std::to_string(m.cameras); });
    row("Data, Mbit/s for each camera", "at 30 pictures a second",
        [](const CompareMethod& m) { return tenths_of(m.mbit_per_camera); });
    row("Work in the operating room, ms",
        "of one processor core, for a picture of a camera; 33 ms are all of a core",
        [](const CompareMethod& m) { return tenths_of(m.sender_ms); });
    row("Work at the expert's, ms", "the same, without drawing",
        [](const CompareMethod& m) { return tenths_of(m.receiver_ms); });
    for (std::size_t i = 0; i < c.links.size(); ++i) {
        part("Over " + line_text(c.links[i]) + " with " + whole(c.links[i].latency_ms) +
             " ms of delay each way");
        row("Pictures a second", "of all cameras, at most 30",
            [i](const CompareMethod& m) { return tenths_of(m.links[i].pictures_per_s); });
        row("Age on arrival, ms", "mean; 95 of 100 are younger than the number in brackets",
            [i](const CompareMethod& m) {
                return whole(m.links[i].delay_ms) + " (" + whole(m.links[i].delay_p95_ms) + ")";
            });
    }
    text += "</tbody></table></div>\n";
    return text;
}

}  // namespace

std::string compare_page(const Compared& c) {
    std::string page = compare_head;
    page +=
        "<h1>An expert looks into the operating room from afar: a video call, and what Theatron "
        "adds</h1>\n"
        "<p class=\"sub\">";
    for (const std::string& remark : compare_remarks(c))
        page += escaped(remark) + " ";
    page += "</p>\n" + in_words(c) + pictures(c) + table(c) + "<h2>What ran</h2>\n<ul>\n";
    for (const CompareMethod& method : c.methods)
        page += list_item(method.name + ": " + method.ran + ".");
    page += "</ul>\n<h2>What this page does not say</h2>\n<ul>\n";
    for (const std::string& sentence : compare_limits())
        page += list_item(sentence);
    return page + "</ul>\n<p class=\"sub\">Made by theatron bench compare.</p>\n</body>\n</html>\n";
}

}  // namespace theatron::bench
