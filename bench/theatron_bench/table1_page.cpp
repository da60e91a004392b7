// SPDX-License-Identifier: Apache-2.0
#include "table1_page.h"

#include <algorithm>

#include "render/gl_driver.h"
#include "svg_drawing.h"
#include "table1_output.h"

namespace theatron::bench {
namespace {

constexpr const char* head = R"(<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>Theatron beside Table 1 of Fischer et al. 2022</title>
<style>
body { font: 16px/1.5 sans-serif; color: #1c1c1c; background: #fff; margin: 0 auto; padding: 1.5rem; max-width: 62rem; }
h1 { font-size: 1.6rem; line-height: 1.25; }
h2 { font-size: 1.2rem; margin-top: 2rem; }
.sub, .how, td small { color: #555; }
svg { max-width: 100%; height: auto; }
.scroll { overflow-x: auto; }
table { border-collapse: collapse; font-size: .86rem; width: 100%; }
th, td { text-align: left; vertical-align: top; padding: .35rem .5rem; border-bottom: 1px solid #ddd; }
th { border-bottom: 2px solid #888; }
tr.group td { font-weight: bold; background: #f3f5f8; }
td.number { white-space: nowrap; }
td small { display: block; }
.paper { color: #b35900; } .here { color: #1f5fa8; }
</style>
</head>
<body>
)";

std::string item(const std::string& text) {
    return "<li>" + escaped(text) + "</li>\n";
}

const Table1Row* row_of(const std::vector<Table1Row>& rows, const std::string& id) {
    const auto found =
        std::find_if(rows.begin(), rows.end(), [&](const Table1Row& row) { return row.id == id; });
    return found == rows.end() ? nullptr : &*found;
}

// The figures of a row with a spread on both sides and the paper's, for a sentence.
struct Three {
    std::string paper, same, best;
    double best_value = 0;
};
std::optional<Three> three(const std::vector<Table1Row>& rows, const std::string& id) {
    const Table1Row* row = row_of(rows, id);
    if (row == nullptr || !row->same.spread || !row->best.spread)
        return std::nullopt;
    return Three{paper_text(*row), figure_text(row->same.spread->median),
                 figure_text(row->best.spread->median), row->best.spread->median};
}

std::string in_short(const Table1Measured& measured, const std::vector<Table1Row>& rows) {
    std::string text = "<h2>In short</h2>\n<ul>\n";
    if (const auto depth = three(rows, "depth.trvl.full.size"))
        text += item("A depth picture takes " + depth->best +
                     " kB with Theatron's own codec, and "
                     "every value comes back. The paper reports " +
                     depth->paper +
                     " kB for a method that loses detail; without that loss the method takes " +
                     depth->same + " kB here.");
    if (const auto rate = three(rows, "rate.full"))
        text += item("A camera with 30 pictures a second needs " +
                     formatted("%.1f", rate->best_value * bytes_per_kb * 8e-6) + " Mbit/s here (" +
                     rate->best + " kB/s), without loss of depth; the paper reports " +
                     rate->paper + " kB/s, with loss.");
    if (const auto filter = three(rows, "filter.chain"))
        text += item("Filtering a picture takes " + filter->best +
                     " ms on one thread of this processor; the paper reports " + filter->paper +
                     " ms on a GPU.");
    if (const auto picture = three(rows, "vr.2.mesh.low")) {
        if (render::is_software(measured.gpu))
            text += item("There was no GPU: " + measured.gpu +
                         " drew the pictures for a headset with the processor. Their times compare "
                         "ways of drawing, and say nothing about a headset.");
        else
            text += item("A picture for both eyes with two cameras takes " + picture->same +
                         " ms as a mesh and " + picture->best + " ms blended on " + measured.gpu +
                         "; the paper reports " + picture->paper +
                         " ms. A headset with 90 pictures a second leaves 11.1 ms.");
    }
    if (const auto action = three(rows, "delay.interaction"))
        text += item(
            "An action reaches the other participant after " + action->best +
            " ms here, on one machine, without a network, input device and drawing; the paper's " +
            action->paper + " ms are between two PCs in a LAN.");
    if (const Table1Row* inside = row_of(rows, "delay.inside");
        inside != nullptr && inside->best.spread)
        text += item("The whole system with a synthetic camera, without display: a picture is " +
                     figure_text(inside->best.spread->median) +
                     " ms old when it is drawn. The paper filmed 120 to 150 ms; less the 75 ms of "
                     "its camera these are 45 to 75 ms, with a display in them." +
                     (render::is_software(measured.gpu)
                          ? std::string(" Here the processor draws in place of a GPU: see the "
                                        "stages below.")
                          : std::string()));
    text += item(
        "The paper's machine, camera and scene were other ones. A figure here beside a "
        "figure there is no proof that one program is faster; the notes say, row by row, "
        "what differs.");
    return text + "</ul>\n";
}

std::string plots(const std::vector<Table1Row>& rows) {
    std::string text =
        "<h2>Plots</h2>\n<p class=\"how\"><span class=\"paper\">&#9670; paper</span> &nbsp; "
        "<span class=\"here\">&#9675; here, the paper's method</span> &nbsp; "
        "<span class=\"here\">&#9679; here, Theatron's own choice</span> &nbsp; lines: from the "
        "lowest to the highest run.</p>\n";
    std::vector<std::pair<std::string, std::vector<const Table1Row*>>> panels;
    for (const Table1Row& row : rows) {
        const std::string title = row.group + ", " + row.unit;
        auto panel = std::find_if(panels.begin(), panels.end(),
                                  [&](const auto& one) { return one.first == title; });
        if (panel == panels.end())
            panel = panels.insert(panels.end(), {title, {}});
        panel->second.push_back(&row);
    }
    for (const auto& [title, of_panel] : panels) {
        // One error in millimetres, of which a codec without loss has none, is no plot.
        if (of_panel.front()->unit == "mm")
            continue;
        if (const std::string svg = table1_plot(of_panel); !svg.empty())
            text += "<figure><figcaption><b>" + escaped(title) + "</b></figcaption>\n" + svg +
                    "</figure>\n";
    }
    return text;
}

std::string stages(const Table1Measured& measured) {
    if (measured.stages.empty())
        return "";
    return "<h2>Where the time goes</h2>\n<p class=\"how\">A picture of a synthetic camera "
           "without delay, from its moment until it is drawn, on this machine alone. A real "
           "camera and a display come on top.</p>\n" +
           photon::stages_svg(measured.stages, "Mean age of a drawn picture, stage by stage");
}

std::string cell_html(const Table1Cell& cell) {
    std::string text =
        "<td>" + escaped(cell.spread || cell.reason.empty() ? spread_text(cell) : cell.reason);
    if (cell.spread)
        text += "<small>" + escaped(cell.ran) + "</small>";
    return text + "</td>";
}

std::string table(const std::vector<Table1Row>& rows, const std::vector<std::string>& notes) {
    std::string text =
        "<h2>All rows</h2>\n<div class=\"scroll\"><table>\n<tr><th>row</th><th>unit</th>"
        "<th class=\"paper\">paper</th><th class=\"here\">here, paper's method</th>"
        "<th class=\"here\">here, Theatron's choice</th><th>on</th><th>not comparable: notes</th>"
        "</tr>\n";
    std::string group;
    for (const Table1Row& row : rows) {
        if (row.group != group) {
            group = row.group;
            text += "<tr class=\"group\"><td colspan=\"7\">" + escaped(group) + "</td></tr>\n";
        }
        std::string numbers;
        for (const int note : note_numbers(row, notes))
            numbers += (numbers.empty() ? "" : ", ") + ("<a href=\"#note" + std::to_string(note)) +
                       "\">" + std::to_string(note) + "</a>";
        text += "<tr><td>" + escaped(row.name) + "</td><td>" + escaped(row.unit) +
                "</td><td class=\"number\">" +
                escaped(row.paper_low ? paper_text(row) : "not given") + "</td>" +
                cell_html(row.same) + cell_html(row.best) + "<td><small>" + escaped(row.device) +
                (row.input.empty() ? "" : "; " + escaped(row.input)) + "</small></td><td>" +
                numbers + "</td></tr>\n";
    }
    return text + "</table></div>\n";
}

}  // namespace

std::string table1_page(const Table1Measured& measured, const std::vector<Table1Row>& rows) {
    const std::vector<std::string> notes = notes_of(rows);
    std::string page = head;
    page += "<h1>Theatron beside Table 1 of Fischer et al. 2022</h1>\n<p class=\"sub\">" +
            escaped(paper_title) + ". Its machine: " + escaped(paper_machine) + ".</p>\n<ul>\n";
    for (const std::string& remark : table1_remarks(measured))
        page += item(remark);
    page += "</ul>\n" + in_short(measured, rows) + plots(rows) + stages(measured) +
            table(rows, notes) +
            "<h2>Why a figure here cannot be compared with the paper's</h2>\n<ol>\n";
    for (std::size_t i = 0; i < notes.size(); ++i)
        page += "<li id=\"note" + std::to_string(i + 1) + "\">" + escaped(notes[i]) + "</li>\n";
    return page + "</ol>\n<p class=\"sub\">Made by theatron bench table1.</p>\n</body>\n</html>\n";
}

}  // namespace theatron::bench
