// SPDX-License-Identifier: Apache-2.0
#include "cases/series_parts.h"

#include <algorithm>
#include <map>
#include <set>

#include "cases/series_builder.h"

namespace theatron::cases {
namespace {

using Slices = std::vector<DicomSlice>;
// Numbers of slices at one place, which are not copies of one another, by their instance.
using Places = std::vector<std::vector<std::size_t>>;

Places places_of(const Slices& slices) {
    const Vec3 normal = cross(slices[0].right, slices[0].down);
    const auto along = [&](std::size_t i) { return dot(slices[i].position_mm, normal); };
    std::vector<std::size_t> order(slices.size());
    for (std::size_t i = 0; i < order.size(); ++i)
        order[i] = i;
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return along(a) < along(b); });
    Places places;
    double last = 0;
    for (const std::size_t i : order) {
        if (places.empty() || along(i) - last >= same_place_mm) {
            places.push_back({i});
            last = along(i);
            continue;
        }
        const auto is_copy = [&](std::size_t other) {
            return slices[other].samples == slices[i].samples;
        };
        if (std::none_of(places.back().begin(), places.back().end(), is_copy))
            places.back().push_back(i);
    }
    for (std::vector<std::size_t>& place : places)
        std::stable_sort(place.begin(), place.end(), [&](std::size_t a, std::size_t b) {
            return slices[a].instance < slices[b].instance;
        });
    return places;
}

using Numbers = std::vector<std::vector<std::size_t>>;

// The phases by one key: as many values as there are images at a place, and never two images of
// one value there.
Numbers by_key(const Slices& slices, const Places& places, std::size_t key, std::size_t phases) {
    for (const std::vector<std::size_t>& place : places)
        for (std::size_t a = 0; a < place.size(); ++a)
            for (std::size_t b = 0; b < a; ++b)
                if (slices[place[a]].keys[key] == slices[place[b]].keys[key])
                    return {};
    std::map<std::string, std::vector<std::size_t>> parts;
    for (std::size_t i = 0; i < slices.size(); ++i)
        parts[slices[i].keys[key]].push_back(i);
    if (parts.size() != phases)
        return {};
    Numbers found;
    for (auto& [value, part] : parts)
        found.push_back(std::move(part));
    return found;
}

// The phases by their numbers in the series: one phase after another, or all phases of one place
// after another.
Numbers by_instance(const Slices& slices, const Places& places, std::size_t phases) {
    std::vector<int> first(phases, 2'000'000'000), last(phases, -1);
    bool are_consecutive = true;
    for (const std::vector<std::size_t>& place : places) {
        if (place.size() != phases)
            return {};
        for (std::size_t k = 0; k < phases; ++k) {
            const int number = slices[place[k]].instance;
            first[k] = std::min(first[k], number);
            last[k] = std::max(last[k], number);
            are_consecutive = are_consecutive && number == slices[place[0]].instance + int(k);
        }
    }
    bool are_apart = true;
    for (std::size_t k = 1; k < phases; ++k)
        are_apart = are_apart && first[k] > last[k - 1];
    if (!are_apart && !are_consecutive)
        return {};
    Numbers parts(phases);
    for (const std::vector<std::size_t>& place : places)
        for (std::size_t k = 0; k < phases; ++k)
            parts[k].push_back(place[k]);
    return parts;
}

void add_phases(Slices slices, SeriesParts& out) {
    const Places places = slices[0].has_place ? places_of(slices) : Places();
    std::size_t phases = 0;
    for (const std::vector<std::size_t>& place : places)
        phases = std::max(phases, place.size());
    Numbers parts;
    for (std::size_t key = 0; phases > 1 && parts.empty() && key < slice_keys; ++key)
        parts = by_key(slices, places, key, phases);
    if (phases > 1 && parts.empty())
        parts = by_instance(slices, places, phases);
    if (parts.empty()) {
        out.parts.push_back(std::move(slices));
        return;
    }
    out.remarks.push_back("The series has " + std::to_string(phases) +
                          " images at each place (phases or reconstructions), so it becomes " +
                          std::to_string(phases) + " series.");
    for (const std::vector<std::size_t>& part : parts) {
        out.parts.emplace_back();
        for (const std::size_t i : part)
            out.parts.back().push_back(std::move(slices[i]));
    }
}

// True where each image had a frame of reference of its own, so that none says anything.
bool take_one_frame_for_all(Slices& slices) {
    std::set<std::string> frames;
    for (const DicomSlice& slice : slices)
        frames.insert(slice.frame_uid);
    if (slices.size() < 3 || frames.size() < slices.size() || frames.contains(""))
        return false;
    for (DicomSlice& slice : slices)
        slice.frame_uid.clear();
    return true;
}

// Scouts that say so, beside at least three images that do not. Returns their number.
std::size_t take_out_scouts(Slices& slices) {
    const auto is_scout = [](const DicomSlice& slice) {
        return slice.keys[image_kind_key].find("LOCALIZER") != std::string::npos;
    };
    const auto count = std::size_t(std::count_if(slices.begin(), slices.end(), is_scout));
    if (slices.size() - count < 3)
        return 0;
    return std::erase_if(slices, is_scout);
}

}  // namespace

SeriesParts split_series(std::vector<DicomSlice> slices) {
    SeriesParts split;
    if (take_one_frame_for_all(slices))
        split.remarks.push_back(
            "Each image of the series names a frame of reference of its own, as programs write "
            "that "
            "take the patient's name out; they are taken for one.");
    std::vector<Slices> groups;
    std::size_t scouts = take_out_scouts(slices);
    for (DicomSlice& slice : slices) {
        auto group = std::find_if(groups.begin(), groups.end(), [&](const Slices& one) {
            return one[0].has_place == slice.has_place && place_difference(one[0], slice).empty();
        });
        if (group == groups.end())
            group = groups.insert(groups.end(), Slices());
        if (!group->empty() && group->front().frame_uid.empty())
            group->front().frame_uid = slice.frame_uid;
        group->push_back(std::move(slice));
    }
    std::stable_sort(groups.begin(), groups.end(),
                     [](const Slices& a, const Slices& b) { return a.size() > b.size(); });
    if (groups.size() >= 3 && groups[0].size() == 1 && groups[0][0].has_place) {
        split.problem = "Each of the " + std::to_string(groups.size()) +
                        " images of the series lies in another plane, as scouts and views from all "
                        "around do, so they make no volume; save those that matter as PNG.";
        return split;
    }
    const bool is_series = !groups.empty() && groups[0].size() >= 3;
    for (std::size_t i = 0; i < groups.size(); ++i)
        if (is_series && i > 0 && (groups[i].size() == 1 || !groups[i][0].has_place))
            scouts += groups[i].size();
        else
            add_phases(std::move(groups[i]), split);
    if (scouts > 0)
        split.remarks.push_back(
            std::to_string(scouts) + (scouts == 1 ? " image" : " images") +
            " of the series with another orientation, size or place than the others (a scout?) " +
            (scouts == 1 ? "is" : "are") + " left out.");
    return split;
}

}  // namespace theatron::cases
