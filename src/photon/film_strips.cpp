// SPDX-License-Identifier: Apache-2.0
#include "photon/film_strips.h"

#include <algorithm>

namespace theatron::photon {
namespace {

// A film of anything else has few false finds, so that more than these are no film of strips.
constexpr std::size_t most_tracks = 64;
// A strip is seen in one of ten frames at least.
constexpr int least_share = 10;

}  // namespace

// A strip moves less than half its width from one frame to the next.
FilmStrips::Track* FilmStrips::nearest(const Quad& frame) {
    const double reach = length(frame[1] - frame[0]) / 2;
    Track* best = nullptr;
    double least = reach;
    for (Track& track : tracks_)
        if (const double distance = length(middle_of(track.last) - middle_of(frame));
            distance < least && track.times.size() < frame_ms_.size()) {
            least = distance;
            best = &track;
        }
    return best;
}

void FilmStrips::add(double film_ms, Size size, std::span<const StripReading> strips) {
    frame_ms_.push_back(film_ms);
    for (const StripReading& strip : strips) {
        Track* track = nearest(strip.frame);
        if (!track) {
            if (tracks_.size() == most_tracks)
                continue;
            track = &tracks_.emplace_back();
        }
        track->last = strip.frame;
        ++track->sums.seen;
        track->sums.read += strip.time.has_value();
        track->sums.x_share += middle_of(strip.frame).x / size.width;
        track->sums.y_share += middle_of(strip.frame).y / size.height;
        track->sums.contrast += strip.contrast;
        track->times.resize(frame_ms_.size());
        track->times.back() = strip.time;
    }
}

FilmStrips::Pair FilmStrips::pair() const {
    Pair result;
    std::vector<const Track*> strips;
    for (const Track& track : tracks_)
        if (track.sums.seen * least_share >= frames())
            strips.push_back(&track);
    if (strips.size() < 2) {
        result.problem =
            strips.empty()
                ? "no strip is seen in it: film both screens sharply, each strip with its white "
                  "border and at least a tenth of the picture wide"
                : "only one strip is seen in it; a film needs the strip on the scene's screen and "
                  "the one on the display, each with its white border";
        return result;
    }
    if (strips.size() > 2) {
        result.problem = std::to_string(strips.size()) +
                         " strips are seen in it, and which two are meant cannot be known; cover "
                         "the others";
        return result;
    }
    for (std::size_t i = 0; i < 2; ++i) {
        Place place = strips[i]->sums;
        place.x_share /= place.seen;
        place.y_share /= place.seen;
        place.contrast /= place.seen;
        result.places[i] = place;
    }
    for (std::size_t n = 0; n < frame_ms_.size(); ++n) {
        FilmFrame frame{frame_ms_[n], {}};
        for (std::size_t i = 0; i < 2; ++i)
            if (n < strips[i]->times.size())
                frame.times[i] = strips[i]->times[n];
        result.frames.push_back(frame);
    }
    return result;
}

}  // namespace theatron::photon
