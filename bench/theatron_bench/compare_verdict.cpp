// SPDX-License-Identifier: Apache-2.0
#include "compare_verdict.h"

#include <algorithm>
#include <array>

#include "compare_page_parts.h"
#include "compare_words.h"

namespace theatron::bench {
namespace {

// A measured method with shares of the wound, or null.
const CompareMethod* with_wound(const Compared& c, const char* id) {
    const CompareMethod* method = c.find_measured(id);
    return method && method->wound ? method : nullptr;
}

std::string percent_text(double percent) {
    return tenths_text(percent) + " %";
}

std::string mbit_text(const CompareMethod& method) {
    return tenths_text(method.mbit_of_all()) + " Mbit/s";
}

std::string of_the_wound(const Compared& c, const CompareShares& ours) {
    const std::string found =
        "Of what an expert at the foot of the table should see in a circle at the wound, " +
        near_wound_text(c) + " wide, Theatron's picture shows " +
        percent_text(ours.rightly_percent) +
        " rightly, which is at most 2 cm off, something else in place of " +
        percent_text(ours.wrongly_percent) + ", without a warning, and nothing in place of " +
        percent_text(ours.hidden_percent);
    if (ours.wrongly_percent >= many_percent)
        return found + ": do not judge the wound from it.";
    if (ours.wrongly_percent >= few_percent || ours.hidden_percent >= many_percent)
        return found + ": look at the video, too, before you judge the wound.";
    return found + ".";
}

// "a zoomed one", after "a video call".
std::string of_calls(const CompareMethod* usual, const CompareMethod* zoomed,
                     const CompareMethod* two) {
    const CompareMethod& first = usual ? *usual : *zoomed;
    std::string text = std::string(usual ? "A" : "A zoomed") + " video call shows " +
                       percent_text(first.wound->near.rightly_percent) + " of it";
    if (usual && zoomed)
        text += ", a zoomed one " + percent_text(zoomed->wound->near.rightly_percent);
    if (two)
        text += ", one with two cameras " + percent_text(two->wound->near.rightly_percent) +
                " at " + tenths_text(two->wound->near.detail_mm) + " mm a pixel";
    return text +
           ", and nothing falsely: what no camera of it sees from its fixed place is hidden.";
}

// Says which of the two shows more of the wound, and whether that can be trusted.
std::string against_call(const CompareShares& ours, const CompareShares& call,
                         const std::string& name) {
    const bool is_false = ours.wrongly_percent >= few_percent;
    const double more = ours.rightly_percent - call.rightly_percent;
    if (more >= few_percent)
        return is_false ? "At the wound Theatron shows more than " + name +
                              ", and also what is not there: it does not replace the video."
                        : "At the wound Theatron is better than " + name +
                              ": it shows more, and next to nothing falsely.";
    if (is_false || more <= -few_percent)
        return "At the wound " + name + " is better than Theatron alone: it shows " +
               (more <= -few_percent ? "more" : "as much") +
               (is_false ? ", and nothing falsely." : ".");
    return "At the wound Theatron and " + name + " show as much.";
}

std::string of_detail(const CompareShares& ours, const CompareShares& call,
                      const std::string& name) {
    return "Detail: a pixel of the best camera is " + tenths_text(ours.detail_mm) +
           " mm of the wound with Theatron, and " + tenths_text(call.detail_mm) + " mm with " +
           name + ".";
}

std::string of_instruments(const CompareCauses& missing) {
    const std::string found = percent_text(missing.sum()) +
                              " of the surface of instruments is missing in Theatron's picture";
    return missing.sum() >= many_percent ? found + ": do not guide an instrument by it."
                                         : found + ".";
}

// The step that loses most, and its share.
std::string of_causes(const CompareCauses& causes) {
    const double other = causes.sum() - causes.no_camera;
    const std::array<std::pair<double, const char*>, 4> steps{
        {{causes.no_camera, "no camera sees the place"},
         {causes.sensor, "a camera sees the place and its sensor measures nothing there"},
         {causes.filters, "filters drop what was measured"},
         {causes.drawing, "drawing loses or moves what arrived"}}};
    const auto most = std::max_element(steps.begin(), steps.end());
    return "The largest cause of what Theatron does not show rightly: " +
           std::string(most->second) + ", " + tenths_text(most->first) + " of " +
           percent_text(causes.sum()) +
           (most == steps.begin() && other > 0
                ? "; its sensors, filters and drawing lose the other " + tenths_text(other) + "."
                : ".");
}

std::string of_near_camera(const CompareMethod& without, const CompareMethod& with) {
    const CompareShares &before = without.wound->near, &after = with.wound->near;
    return "With one camera more, about a metre from the wound, Theatron shows " +
           percent_text(after.rightly_percent) + " rightly in place of " +
           percent_text(before.rightly_percent) + ", and " + percent_text(after.wrongly_percent) +
           " wrongly in place of " + percent_text(before.wrongly_percent) + "; it needs " +
           mbit_text(with) + " in place of " + mbit_text(without) +
           (after.wrongly_percent >= many_percent
                ? ". " + percent_text(after.wrongly_percent) +
                      " shown wrongly are still too much to judge the wound."
            : after.rightly_percent > before.rightly_percent ? "."
                                                             : ". This camera does not help.");
}

// The zoomed call and Theatron beside it: what Theatron adds where the video shows nothing.
std::string of_both(const CompareMethod& pair, const CompareMethod* zoomed) {
    const CompareShares& both = pair.wound->near;
    std::string text = ": together they need " + mbit_text(pair) +
                       ", and at least one of the two pictures shows " +
                       percent_text(both.rightly_percent) + " rightly";
    if (zoomed)
        text += ". Where the video shows nothing, Theatron shows " +
                percent_text(
                    std::max(0.0, both.rightly_percent - zoomed->wound->near.rightly_percent)) +
                " rightly and " + percent_text(both.wrongly_percent) +
                " wrongly: do not judge what only Theatron shows";
    return text;
}

// Two ordinary cameras where they show as much of the wound as Theatron beside a call.
std::string of_two_cameras(const CompareMethod& two) {
    return "For the wound alone, a video call with two cameras shows as much for " +
           mbit_text(two) + ", and nothing falsely.";
}

std::string advice(const CompareShares& ours, const CompareMethod* pair,
                   const CompareMethod* zoomed) {
    if (ours.wrongly_percent < many_percent)
        return "Whether that is enough for a decision, no figure here says.";
    return "Use Theatron beside a video picture of the wound, not in its place" +
           (pair ? of_both(*pair, zoomed) : "") + ". Where they differ, believe the video.";
}

}  // namespace

std::vector<std::string> compare_verdict(const Compared& c) {
    const CompareMethod *ours = with_wound(c, theatron_id), *near = with_wound(c, theatron_near_id),
                        *usual = with_wound(c, video_call_id),
                        *zoomed = with_wound(c, zoomed_call_id),
                        *two = with_wound(c, two_camera_call_id),
                        *pair = with_wound(c, theatron_and_call_id);
    if (!ours)
        return {};
    const CompareShares& shares = ours->wound->near;
    std::vector<std::string> sentences = {of_the_wound(c, shares)};
    if (const CompareMethod* call = zoomed ? zoomed : usual) {
        const std::string name = zoomed ? "the zoomed video call" : "the video call";
        sentences.push_back(of_calls(usual, zoomed, two));
        sentences.push_back(against_call(shares, call->wound->near, name));
        sentences.push_back(of_detail(shares, call->wound->near, name));
    }
    sentences.push_back(advice(shares, pair, zoomed));
    if (two && two->wound->near.rightly_percent >=
                   (pair ? pair->wound->near : shares).rightly_percent - few_percent)
        sentences.push_back(of_two_cameras(*two));
    if (near)
        sentences.push_back(of_near_camera(*ours, *near));
    if (ours->wound->lost && ours->wound->lost->sum() > 0)
        sentences.push_back(of_causes(*ours->wound->lost));
    if (ours->close_up && ours->close_up->instruments)
        sentences.push_back(of_instruments(*ours->close_up->instruments));
    return sentences;
}

}  // namespace theatron::bench
