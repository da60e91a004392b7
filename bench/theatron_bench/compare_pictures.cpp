// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "compare_page_parts.h"
#include "compare_sights.h"
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
std::string row_of(const std::string& title, const std::string& line, const std::string& figures,
                   bool is_pairs = false) {
    return "<h2>" + escaped(title) + "</h2>\n" +
           (line.empty() ? "" : "<p class=\"quiet\">" + line + "</p>\n") +
           (is_pairs ? "<div class=\"pictures pairs\">\n" : "<div class=\"pictures\">\n") +
           figures + "</div>\n";
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

// The caption of a camera's whole picture.
std::string video_line(const CompareMethod& method) {
    return method.cameras > 1
               ? "The second camera's picture, from its place; the first one's is the video call's."
               : "From the camera's place, not the expert's.";
}

CompareSights nothing_in(Size size) {
    return {Image<Seen>(size), Image<float>(size)};
}

// The close-up with marks of what is false or missing: over the drawn picture, or over the exact
// picture if the method shows a camera's.
std::string marked_figure(const Compared& c, const CompareMethod& method) {
    const View<const std::uint8_t> region = c.near_wound.view();
    if (method.is_video)
        return figure(marked(c.close_up_truth, *method.sights, region), method.name + ", marked",
                      "What is really there. Cyan: hidden from the camera. A camera shows nothing "
                      "falsely.");
    const CompareShares& whole = method.wound->whole;
    return figure(marked(method.close_up->picture, *method.sights, region),
                  method.name + ", marked",
                  "Magenta: something else is shown in place of what is there, " +
                      tenths_text(whole.wrongly_percent) +
                      " % of the whole picture. Cyan: nothing "
                      "is shown, " +
                      tenths_text(whole.hidden_percent) + " %.",
                  is_theatron(method));
}

std::string close_up_line(const Compared& c, const CompareMethod& method) {
    const std::string shares = method.wound ? shares_text(c, method.wound->near) + " " : "";
    const CompareCloseUp& close_up = *method.close_up;
    return shares + (close_up.likeness ? "Likeness " + tenths_text(close_up.likeness->psnr_db) +
                                             " dB: " + psnr_words(close_up.likeness->psnr_db) + "."
                                       : pixels_line(method));
}

std::string close_up_row(const Compared& c) {
    std::string figures =
        figure(c.close_up_truth, "What is really there", "Drawn from the generated room itself.") +
        figure(marked(c.close_up_truth, nothing_in(c.close_up_truth.size), c.near_wound.view()),
               "What is really there, marked",
               "White line: the " + near_wound_text(c) + " around the wound.");
    for (const CompareMethod& method : c.methods) {
        if (!method.is_measured() || !method.close_up || !method.sights || !method.wound)
            continue;
        figures += figure(method.close_up->picture, method.name, close_up_line(c, method),
                          is_theatron(method)) +
                   marked_figure(c, method);
    }
    return row_of(
        "Close to the wound",
        "The " + whole_text(c.close_up_width_m * 100) +
            " cm around the wound as an expert at the foot of the table would see them; a video "
            "call shows them from its camera's place. On the right the same with marks; of a video "
            "call what is really there, with marks. Rightly: "
            "the surface that is there is shown, at most 2 cm off. Wrongly: something else is "
            "shown in its place. <span class=\"screen\">A click, a tap or the Enter key shows a "
            "picture large; arrow keys then go to the next one.</span>",
        figures, true);
}

// The ways with a picture of their own from this place of the expert.
bool has_picture(const CompareMethod& method, std::size_t place) {
    if (!method.is_measured() || method.pictures.empty())
        return false;
    // A camera does not move with the expert, and more pixels show the same from the same place.
    return method.is_video ? place == 0 && method.id != full_hd_call_id
                           : place < method.pictures.size();
}

std::string place_line(const Compared& c, std::size_t place) {
    const auto is_video = [](const CompareMethod& m) { return m.is_video && m.is_measured(); };
    const bool has_video = std::any_of(c.methods.begin(), c.methods.end(), is_video);
    if (place > 0)
        return has_video ? "Video calls show the same as before, because cameras do not move with "
                           "the expert; their pictures are not repeated."
                         : "";
    return std::string("All ways show the same moment; the table says how many cameras each had.") +
           (c.find_measured(full_hd_call_id)
                ? " The call in full HD shows the same as the video call, sharper."
                : "");
}

std::string place_row(const Compared& c, std::size_t place) {
    std::string figures =
        figure(c.truth[place], "What is really there", "Drawn from the generated room itself.");
    for (const CompareMethod& method : c.methods) {
        if (!has_picture(method, place))
            continue;
        std::string line;
        if (method.is_video)
            line = video_line(method);
        else if (place < method.from_place.size())
            line = likeness_line(method.from_place[place]);
        figures += figure(method.pictures[place], method.name, line, is_theatron(method));
    }
    return row_of((place == 0 ? "The expert stands " : "The expert takes ") + c.places[place],
                  place_line(c, place), figures);
}

}  // namespace

std::string compare_pictures(const Compared& c) {
    std::string text = close_up_row(c);
    for (std::size_t place = 0; place < c.places.size(); ++place)
        text += place_row(c, place);
    return text;
}

}  // namespace theatron::bench
