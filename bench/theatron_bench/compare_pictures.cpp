// SPDX-License-Identifier: Apache-2.0
#include "compare_page_parts.h"
#include "compare_words.h"
#include "data_url.h"
#include "svg_drawing.h"

namespace theatron::bench {
namespace {

std::string figure(const ColorImage& picture, const std::string& title, const std::string& line,
                   bool is_ours = false) {
    return std::string("<figure") + (is_ours ? " class=\"ours\"" : "") +
           "><button type=\"button\"><img src=\"" + picture_url(picture) + "\" alt=\"" +
           escaped(title) + ". " + escaped(line) + "\"></button><figcaption><b>" + escaped(title) +
           "</b><small>" + escaped(line) + "</small></figcaption></figure>\n";
}

std::string likeness_line(const CompareLikeness& likeness) {
    return "Dark " + tenths_text(likeness.undrawn_percent) + " %, seen through " +
           tenths_text(likeness.see_through_percent) + " %; of what cameras see " +
           tenths_text(likeness.holes_percent) + " % missing. Likeness " +
           tenths_text(likeness.psnr_db) + " dB: " + psnr_words(likeness.psnr_db) + ".";
}

bool is_theatron(const CompareMethod& method) {
    return method.id == theatron_id || method.id == theatron_near_id;
}

// `line` is HTML, and may be empty.
std::string row_of(const std::string& title, const std::string& line, const std::string& figures) {
    return "<h2>" + escaped(title) + "</h2>\n" +
           (line.empty() ? "" : "<p class=\"quiet\">" + line + "</p>\n") +
           "<div class=\"pictures\">\n" + figures + "</div>\n";
}

// The caption of cameras' pictures, which are close-ups by their lens or by a cut.
std::string pixels_line(const CompareMethod& method) {
    const std::string width = std::to_string(method.close_up->picture.size.width) + " pixels wide";
    if (method.id == zoomed_call_id)
        return "The zoomed camera's picture: " + width + ", from the camera's place.";
    if (method.cameras > 1)
        return "Cut out of each camera's picture that shows the wound: together " + width +
               ", from the cameras' places.";
    return "Cut out of the camera's picture: " + width + ", from the camera's place.";
}

// The caption of cameras' whole pictures.
std::string video_line(const CompareMethod& method, bool is_first_place) {
    if (!is_first_place)
        return "The same as before: cameras do not move with the expert.";
    return method.cameras > 1 ? "From the cameras' places, not the expert's, beside each other."
                              : "From the camera's place, not the expert's.";
}

std::string close_up_row(const Compared& c) {
    std::string figures =
        figure(c.close_up_truth, "What is really there", "Drawn from the generated room itself.");
    for (const CompareMethod& method : c.methods) {
        if (!method.is_measured() || !method.close_up)
            continue;
        const CompareCloseUp& close_up = *method.close_up;
        figures +=
            figure(close_up.picture, method.name,
                   close_up.likeness ? likeness_line(*close_up.likeness) : pixels_line(method),
                   is_theatron(method));
    }
    return row_of(
        "Close to the wound",
        "The " + whole_text(c.close_up_width_m * 100) +
            " cm around the operation. Dark: nothing is drawn. Seen through: a surface is "
            "missing, and something behind it shows. <span class=\"screen\">A click, a tap "
            "or the Enter key shows a picture large; arrow keys then change between the "
            "ways.</span>",
        figures);
}

std::string place_row(const Compared& c, std::size_t place) {
    std::string figures =
        figure(c.truth[place], "What is really there", "Drawn from the generated room itself.");
    for (const CompareMethod& method : c.methods) {
        if (!method.is_measured() || method.pictures.empty())
            continue;
        const ColorImage& picture = method.pictures[place < method.pictures.size() ? place : 0];
        std::string line;
        if (method.is_video)
            line = video_line(method, place == 0);
        else if (place < method.from_place.size())
            line = likeness_line(method.from_place[place]);
        figures += figure(picture, method.name, line, is_theatron(method));
    }
    return row_of((place == 0 ? "The expert stands " : "The expert takes ") + c.places[place],
                  place == 0
                      ? "All ways show the same moment; the table says how many cameras each had."
                      : "",
                  figures);
}

}  // namespace

std::string compare_pictures(const Compared& c) {
    std::string text = close_up_row(c);
    for (std::size_t place = 0; place < c.places.size(); ++place)
        text += place_row(c, place);
    return text;
}

}  // namespace theatron::bench
