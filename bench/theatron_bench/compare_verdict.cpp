// SPDX-License-Identifier: Apache-2.0
#include "compare_verdict.h"

#include <algorithm>
#include <array>

#include "compare_page_parts.h"
#include "compare_words.h"

namespace theatron::bench {
namespace {

// A measured close-up with its likeness, or null.
const CompareCloseUp* close_up_of(const Compared& c, const char* id) {
    const CompareMethod* method = c.find_measured(id);
    return method && method->close_up && method->close_up->likeness ? &*method->close_up : nullptr;
}

std::string of_the_wound(const CompareCloseUp& close_up) {
    const double through = close_up.likeness->see_through_percent;
    const std::string found =
        "At the wound Theatron's picture shows something behind a missing surface on " +
        tenths_text(through) + " % of its area";
    if (through >= many_missing_percent)
        return found + ": do not judge the wound from it.";
    if (through >= few_missing_percent)
        return found + ": look at the video, too, before you judge the wound.";
    return found + ".";
}

std::string of_instruments(const CompareCauses& missing) {
    const std::string found = tenths_text(missing.sum()) +
                              " % of the surface of instruments is missing in Theatron's picture";
    return missing.sum() >= many_missing_percent ? found + ": do not guide an instrument by it."
                                                 : found + ".";
}

// The step that loses most, and its share.
std::string of_causes(const CompareCauses& causes) {
    const std::array<std::pair<double, const char*>, 4> steps{
        {{causes.no_camera, "no camera sees the place"},
         {causes.sensor, "a camera sees the place and its sensor measures nothing there"},
         {causes.filters, "filters drop what was measured"},
         {causes.drawing, "drawing loses what arrived"}}};
    const auto most = std::max_element(steps.begin(), steps.end());
    return "The largest cause: " + std::string(most->second) + ", " + tenths_text(most->first) +
           " of " + tenths_text(causes.sum()) + " %.";
}

std::string of_near_camera(const CompareCloseUp& without, const CompareCloseUp& with) {
    const double before = without.likeness->see_through_percent,
                 after = with.likeness->see_through_percent;
    return "With one camera more, about a metre from the wound, the share is " +
           tenths_text(after) + " % in place of " + tenths_text(before) + " %" +
           (after >= many_missing_percent ? ": still too much to judge the wound."
            : after < before              ? "."
                                          : ": this camera does not help.");
}

}  // namespace

std::vector<std::string> compare_verdict(const Compared& c) {
    const CompareCloseUp *ours = close_up_of(c, theatron_id),
                         *near = close_up_of(c, theatron_near_id);
    if (!ours)
        return {};
    std::vector<std::string> sentences = {of_the_wound(*ours)};
    if (ours->see_through && ours->see_through->sum() > 0)
        sentences.push_back(of_causes(*ours->see_through));
    if (near)
        sentences.push_back(of_near_camera(*ours, *near));
    if (ours->instruments)
        sentences.push_back(of_instruments(*ours->instruments));
    if (const CompareMethod* zoomed = c.find_measured(zoomed_call_id); zoomed && zoomed->own_view)
        sentences.push_back(
            "A video camera that is zoomed to the wound shows all that it sees, with " +
            psnr_words(zoomed->own_view->psnr_db) +
            " from it, but from its own place only, and nothing else.");
    const bool is_bad = ours->likeness->see_through_percent >= many_missing_percent;
    sentences.push_back(is_bad
                            ? "Use Theatron beside a video picture of the wound, not in its place."
                            : "Whether that is enough for a decision, no figure here says.");
    return sentences;
}

}  // namespace theatron::bench
