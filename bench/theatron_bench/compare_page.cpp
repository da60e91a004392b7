// SPDX-License-Identifier: Apache-2.0
#include "compare_page.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "compare_output.h"
#include "compare_page_parts.h"
#include "compare_verdict.h"
#include "compare_words.h"
#include "render/gl_driver.h"
#include "svg_drawing.h"

namespace theatron::bench {

std::string whole_text(double value) {
    return formatted("%.0f", value);
}

std::string tenths_text(double value) {
    return formatted("%.1f", value);
}

std::string kept_together(const std::string& text) {
    constexpr std::array<std::string_view, 7> units = {"%",  "dB", "ms",      "Mbit/s",
                                                       "mm", "cm", "pictures"};
    std::string kept;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const bool may_break = text[i] == ' ' && i > 0 && text[i - 1] >= '0' && text[i - 1] <= '9';
        const std::string_view rest = std::string_view(text).substr(i + 1);
        kept += may_break && std::any_of(units.begin(), units.end(),
                                         [&](std::string_view u) { return rest.starts_with(u); })
                    ? "\u00a0"
                    : std::string(1, text[i]);
    }
    return kept;
}

std::string line_text(const CompareLink& link) {
    return "a line of " + formatted("%g", link.mbit) + " Mbit/s";
}

std::string near_wound_text(const Compared& c) {
    return whole_text(c.near_wound_m * 100) + " cm";
}

std::string shares_text(const Compared& c, const CompareShares& near) {
    return "Of the " + near_wound_text(c) + " around the wound " +
           tenths_text(near.rightly_percent) + " % are shown rightly, " +
           tenths_text(near.wrongly_percent) + " % wrongly, " + tenths_text(near.hidden_percent) +
           " % not" +
           (near.detail_mm > 0 ? "; a pixel is " + tenths_text(near.detail_mm) + " mm." : ".");
}

namespace {

std::string list_item(const std::string& text) {
    return "<li>" + escaped(text) + "</li>\n";
}

std::string list(const std::vector<std::string>& sentences) {
    std::string text = "<ul>\n";
    for (const std::string& sentence : sentences)
        text += list_item(sentence);
    return text + "</ul>\n";
}

// "19 pictures a second, each 99 ms old on arrival".
std::string arrival_text(const LinkFigures& f) {
    return whole_text(f.pictures_per_s) + " pictures a second, each " + whole_text(f.delay_ms) +
           " ms old on arrival";
}

std::string number_text(std::size_t count) {
    constexpr std::array<const char*, 13> numbers = {"none", "one",    "two",   "three", "four",
                                                     "five", "six",    "seven", "eight", "nine",
                                                     "ten",  "eleven", "twelve"};
    return count < numbers.size() ? numbers[count] : std::to_string(count);
}

std::string capital(std::string text) {
    if (text.front() >= 'a' && text.front() <= 'z')
        text.front() = char(text.front() - 'a' + 'A');
    return text;
}

// How many ways the page lists, and how many of them have figures.
std::string ways_text(const Compared& c) {
    const std::size_t all = c.methods.size();
    const auto measured =
        std::size_t(std::count_if(c.methods.begin(), c.methods.end(),
                                  [](const CompareMethod& m) { return m.is_measured(); }));
    const std::string count = capital(number_text(all)) + (all == 1 ? " way" : " ways") +
                              " to show an operation to an expert elsewhere " +
                              (all == 1 ? "is" : "are") + " listed here";
    return measured == all ? count + " and measured"
                           : count + ", and " + number_text(measured) + " of them " +
                                 (measured == 1 ? "was" : "were") + " measured on this computer";
}

// The comparison, its result and its limit, a sentence each.
std::string lead(const Compared& c) {
    const CompareMethod *call = c.find_measured(video_call_id),
                        *ours = c.find_measured(theatron_id);
    std::string text = ways_text(c) +
                       ", in the same second of the same operation and over the same lines. The "
                       "table says how many cameras each had.";
    if (ours && call) {
        text +=
            " With Theatron the expert can look from any place, which a video call does not "
            "allow; it needs " +
            tenths_text(ours->mbit_of_all()) + " Mbit/s in place of " +
            tenths_text(call->mbit_of_all()) + " (" + std::to_string(ours->cameras) +
            (ours->cameras == 1 ? " camera" : " cameras") + " in place of " +
            std::to_string(call->cameras) + ")";
        if (ours->expert)
            text += ", and " + tenths_text(ours->expert->undrawn_percent) +
                    " % of its picture stays dark";
        text += ".";
    }
    return text +
           " The operation is generated and no surgeon has judged the pictures, so nothing here "
           "shows that an expert helps better.";
}

std::string lower_first(std::string text) {
    if (text.front() >= 'A' && text.front() <= 'Z')
        text.front() = char(text.front() - 'A' + 'a');
    return text;
}

// As it is read in the table, so that differences of figures agree with them.
double in_tenths(double value) {
    return std::round(value * 10) / 10;
}

// The dark, the seen-through and the missing part of Theatron's picture, and how they differ.
std::vector<std::string> gaps(const CompareMethod& ours) {
    const CompareLikeness& all = *ours.expert;
    const double dark = in_tenths(all.undrawn_percent),
                 unseen = in_tenths(all.undrawn_unseen_percent);
    std::vector<std::string> sentences = {
        "On the mean of the expert's standing places " + tenths_text(dark) +
            " % of Theatron's picture stays dark: " + tenths_text(unseen) +
            " % because no camera sees the place, " + tenths_text(dark - unseen) +
            " % although a camera does. In " + tenths_text(all.see_through_percent) +
            " % of the rest a surface is missing, and something behind it shows.",
        "Of the surfaces that a camera sees, " + tenths_text(all.holes_percent) +
            " % are missing. This is what sensors and method lose. The dark part also has what no "
            "camera sees, which depends on how many cameras there are and where they hang."};
    return sentences;
}

std::string in_short(const Compared& c) {
    const CompareMethod *call = c.find_measured(video_call_id),
                        *ours = c.find_measured(theatron_id);
    std::vector<std::string> points;
    if (call)
        points.push_back(
            "A video call needs the least: " + tenths_text(call->mbit_of_all()) +
            " Mbit/s. The expert sees what one camera sees, and cannot step aside or look past a "
            "head or a hand that is in the way.");
    for (const char* id : {full_hd_call_id, two_camera_call_id})
        if (const CompareMethod* other = c.find_measured(id))
            points.push_back(other->name + ": " + tenths_text(other->mbit_of_all()) +
                             " Mbit/s. The expert sees what " +
                             (other->cameras == 1 ? "that camera sees, sharper."
                                                  : "either camera sees, and from nowhere else."));
    if (ours) {
        points.push_back(
            "With Theatron the expert looks from any place. The whole view of " +
            std::to_string(ours->cameras) + (ours->cameras == 1 ? " camera" : " cameras") +
            " needs " + tenths_text(ours->mbit_of_all()) + " Mbit/s" +
            (call ? ", " + whole_text(ours->mbit_of_all() / call->mbit_of_all()) +
                        " times what the video call needs for its one camera; one "
                        "camera's " +
                        tenths_text(ours->mbit_per_camera) + " Mbit/s are " +
                        whole_text(ours->mbit_per_camera / call->mbit_per_camera) + " times as many"
                  : "") +
            ". The expert needs a computer with a graphics card" +
            (render::is_software(ours->drawn_on) && ours->drawing_ms > 0
                 ? "; without one a picture took " + whole_text(ours->drawing_ms) +
                       " ms to draw here."
                 : "."));
        if (ours->expert)
            for (const std::string& sentence : gaps(*ours))
                points.push_back(sentence);
    }
    for (const char* id : {zoomed_call_id, theatron_id, theatron_near_id, theatron_and_call_id})
        if (const CompareMethod* other = c.find_measured(id); other && other->wound)
            points.push_back(other->name + ", " + tenths_text(other->mbit_of_all()) +
                             " Mbit/s: " + lower_first(shares_text(c, other->wound->near)));
    for (const char* id : {paper_id, pcl_id})
        if (const CompareMethod* other = c.find_measured(id))
            points.push_back(
                other->name + ": looks from any place, too; " + tenths_text(other->mbit_of_all()) +
                " Mbit/s for the whole view" +
                (other->id == paper_id ? std::string(" (") + paper_caveat() + ")" : "") +
                (other->expert ? ", " + tenths_text(other->expert->undrawn_percent) + " % dark, " +
                                     tenths_text(other->expert->holes_percent) +
                                     " % of what cameras see missing"
                               : "") +
                ".");
    if (ours && call)
        for (std::size_t i = 0; i < ours->links.size(); ++i)
            points.push_back("On " + line_text(ours->links[i].link) + ": Theatron has " +
                             arrival_text(ours->links[i]) + "; the video call " +
                             arrival_text(call->links[i]) + ".");
    return points.empty() ? "" : "<h2>In short</h2>\n" + list(points);
}

std::string ways(const Compared& c) {
    std::string text = "<h2>The ways that were compared</h2>\n<dl>\n";
    for (const CompareMethod& method : c.methods) {
        text += "<dt>" + escaped(method.name) + "</dt><dd>" + escaped(method.plain + ".");
        if (!method.is_measured())
            text +=
                " <b>Not measured on this computer</b>, so it has no pictures and no figures; "
                "the reason stands at the end of the page.";
        else if (!method.is_pair && !method.close_up && method.pictures.empty())
            text += " <b>It has no pictures here</b>; the reason stands at the end of the page.";
        text += "</dd>\n";
    }
    return text + "</dl>\n";
}

std::string verdict(const Compared& c) {
    const std::vector<std::string> sentences = compare_verdict(c);
    return sentences.empty() ? ""
                             : "<div class=\"verdict\"><h2>What may be judged from it</h2>\n" +
                                   list(sentences) + "</div>\n";
}

// For people who check: input, machine, limits of each method, its settings and its reason.
std::string how_measured(const Compared& c) {
    std::vector<std::string> settings;
    for (const CompareMethod& method : c.methods) {
        std::string sentence = method.name + ": " + method.ran + ".";
        for (const std::string& reason : {method.reason, method.expert_reason})
            if (!reason.empty())
                sentence += " " + reason;
        settings.push_back(sentence);
    }
    return "<h2>How it was measured</h2>\n" + list(compare_remarks(c)) + list(compare_notes()) +
           "<h2>Exact settings, for engineers</h2>\n" + list(settings);
}

}  // namespace

std::string compare_page(const Compared& c) {
    return compare_page_head() +
           kept_together(
               "<h1>An expert looks into the operating room from afar: a video call, and "
               "what Theatron adds</h1>\n<p class=\"lead\">" +
               escaped(lead(c)) + "</p>\n" + verdict(c) +
               "<div class=\"limits\"><h2>What this page does not say</h2>\n" +
               list(compare_limits()) + "</div>\n" + in_short(c) + ways(c) + compare_pictures(c) +
               compare_table(c) + how_measured(c) +
               "<p class=\"quiet\">Made by theatron bench compare.</p>\n") +
           compare_page_end();
}

}  // namespace theatron::bench
