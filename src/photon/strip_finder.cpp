// SPDX-License-Identifier: Apache-2.0
#include "photon/strip_finder.h"

#include <algorithm>

#include "photon/dark_regions.h"

namespace theatron::photon {
namespace {

constexpr std::size_t most_regions = 200;
// Blur rounds the corners, which costs a small strip most.
constexpr double least_hull_share = 0.85;

bool are_same_place(const Quad& a, const Quad& b) {
    const double height = std::min(length(a[3] - a[0]), length(b[3] - b[0]));
    return length(middle_of(a) - middle_of(b)) < height / 2;
}

// In any of the four directions.
std::optional<StripReading> read_turned(GreyView grey, Quad frame) {
    for (int turn = 0; turn < 4; ++turn) {
        if (auto reading = read_strip(grey, frame))
            return reading;
        std::rotate(frame.begin(), frame.begin() + 1, frame.end());
    }
    return std::nullopt;
}

void add_new(const StripReading& reading, std::vector<StripReading>& found) {
    for (StripReading& other : found)
        if (are_same_place(other.frame, reading.frame)) {
            if (!other.time)
                other = reading;
            return;
        }
    found.push_back(reading);
}

void sort_by_left(std::vector<StripReading>& strips) {
    std::sort(strips.begin(), strips.end(), [](const auto& a, const auto& b) {
        return middle_of(a.frame).x < middle_of(b.frame).x;
    });
}

// Regions are looked for in a picture that is `scale` times smaller, strips are read in the whole.
void search(GreyView whole, GreyView small, double scale, std::vector<StripReading>& found) {
    for (std::vector<Point>& hull : dark_regions(small, most_regions)) {
        auto quad = quad_around(std::move(hull), least_hull_share);
        if (!quad)
            continue;
        for (Point& corner : *quad)
            corner = corner * scale;
        if (const auto frame = refined(whole, *quad))
            if (const auto reading = read_turned(whole, *frame))
                add_new(*reading, found);
    }
}

}  // namespace

std::vector<StripReading> find_strips(GreyView grey) {
    std::vector<StripReading> found;
    GreyImage halves[2];
    GreyView view = grey;
    for (int level = 0; level < 3; ++level) {
        if (view.size.width < 2 * least_region_height || view.size.height < 2 * least_region_height)
            break;
        search(grey, view, 1 << level, found);
        if (level == 2)
            break;
        halve(view, halves[level]);
        view = halves[level].view();
    }
    sort_by_left(found);
    return found;
}

std::vector<StripReading> StripFinder::find(GreyView grey) {
    constexpr int search_interval = 60;  // a strip may come into the picture later
    constexpr int longest_missed = 30;
    std::vector<StripReading> found;
    for (const Known& known : known_)
        if (const auto frame = refined(grey, known.frame))
            if (const auto reading = read_strip(grey, *frame))
                add_new(*reading, found);
    if (found.size() < std::max(known_.size(), expected_) || ++since_search_ >= search_interval) {
        since_search_ = 0;
        for (const StripReading& reading : find_strips(grey))
            add_new(reading, found);
    }
    // A strip that this picture hides is looked for in the next one where it was.
    std::vector<Known> known;
    for (const StripReading& reading : found)
        known.push_back({reading.frame});
    for (const Known& before : known_) {
        const bool is_seen = std::any_of(found.begin(), found.end(), [&](const auto& reading) {
            return are_same_place(reading.frame, before.frame);
        });
        if (!is_seen && before.missed < longest_missed)
            known.push_back({before.frame, before.missed + 1});
    }
    known_ = std::move(known);
    sort_by_left(found);
    return found;
}

}  // namespace theatron::photon
