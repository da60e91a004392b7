// SPDX-License-Identifier: Apache-2.0
#include "photon/latency_plot.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "photon/svg_text.h"

namespace theatron::photon {
namespace {

constexpr double width = 760, height = 360, top = 56, bottom = 312;
constexpr double left = 64, middle = 530, bars_left = 550, right = 736;
constexpr int most_bars = 24;

// 1, 2 or 5 times a power of ten, so that `range` has at most eight steps.
double step_of(double range) {
    const double power = std::pow(10, std::floor(std::log10(std::max(range, 1e-6) / 8)));
    for (const double factor : {1.0, 2.0, 5.0})
        if (range / (factor * power) <= 8)
            return factor * power;
    return 10 * power;
}

class Plot {
public:
    explicit Plot(const FilmLatency& latency) : latency_(latency) {
        const Spread& spread = latency.latency_ms;
        step_ = step_of(std::max(spread.most - spread.least, 10.0));
        low_ = std::floor(spread.least / step_) * step_;
        high_ = std::ceil((spread.most + 0.01) / step_) * step_;
        length_ms_ = 1;
        for (const SeenChange& change : latency.changes)
            length_ms_ = std::max(length_ms_, change.at_ms);
    }

    void axes(std::string& svg) const {
        for (double ms = low_; ms <= high_ + step_ / 2; ms += step_)
            svg_add(svg,
                    "<path class='grid' d='M%.1f %.1fH%.1f'/><text x='%.1f' y='%.1f' "
                    "text-anchor='end'>%g</text>\n",
                    left, y_of(ms), right, left - 8, y_of(ms) + 4, ms);
        const double step_s = step_of(length_ms_ / 1000);
        for (double s = 0; s * 1000 <= length_ms_; s += step_s)
            svg_add(svg, "<text x='%.1f' y='%.1f' text-anchor='middle'>%g</text>\n", x_of(s * 1000),
                    bottom + 18, s);
        svg_add(svg, "<text x='%.1f' y='%.1f' text-anchor='middle'>seconds of the film</text>\n",
                (left + middle) / 2, bottom + 36);
        svg_add(svg, "<text x='%.1f' y='%.1f' text-anchor='middle'>share of the changes</text>\n",
                (bars_left + right) / 2, bottom + 36);
    }

    void mean(std::string& svg) const {
        const double upper = y_of(std::min(latency_.to_ms, high_));
        const double lower = y_of(std::max(latency_.from_ms, low_));
        svg_add(svg, "<rect class='interval' x='%.1f' y='%.1f' width='%.1f' height='%.1f'/>\n",
                left, upper, right - left, std::max(lower - upper, 0.0));
        svg_add(svg, "<path class='mean' d='M%.1f %.1fH%.1f'/>\n", left,
                y_of(latency_.latency_ms.mean), right);
    }

    void changes(std::string& svg) const {
        for (const SeenChange& change : latency_.changes)
            svg_add(svg, "<circle cx='%.1f' cy='%.1f' r='2'/>\n", x_of(change.at_ms),
                    y_of(change.latency_ms));
    }

    void bars(std::string& svg) const {
        std::vector<int> counts(most_bars);
        for (const SeenChange& change : latency_.changes)
            ++counts[std::size_t(std::clamp(
                int((change.latency_ms - low_) / (high_ - low_) * most_bars), 0, most_bars - 1))];
        const int most = *std::max_element(counts.begin(), counts.end());
        const double bar = (bottom - top) / most_bars;
        for (int i = 0; i < most_bars; ++i)
            svg_add(svg, "<rect class='bar' x='%.1f' y='%.1f' width='%.1f' height='%.1f'/>\n",
                    bars_left, bottom - (i + 1) * bar + 0.5,
                    (right - bars_left) * counts[std::size_t(i)] / most, bar - 1);
    }

private:
    double x_of(double ms) const { return left + (middle - left) * ms / length_ms_; }
    double y_of(double ms) const { return bottom - (bottom - top) * (ms - low_) / (high_ - low_); }

    const FilmLatency& latency_;
    double low_ = 0, high_ = 1, step_ = 1, length_ms_ = 1;
};

}  // namespace

std::string latency_svg(const FilmLatency& latency, const std::string& title) {
    std::string svg;
    svg_add(svg,
            "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 %g %g' font-family='sans-serif' "
            "font-size='12'>\n",
            width, height);
    svg +=
        "<style>text{fill:#222}.grid{stroke:#ddd}.mean{stroke:#b03020;stroke-width:1.5}"
        ".interval{fill:#b03020;fill-opacity:.15}circle,.bar{fill:#1f6f8b}</style>\n"
        "<rect width='100%' height='100%' fill='#fff'/>\n";
    svg += "<text x='16' y='22' font-size='15'>" + svg_escaped(title) + "</text>\n";
    svg_add(
        svg,
        "<text x='16' y='42'>ms of motion to photon: mean %.1f, between %.1f and %.1f with 95 %%; "
        "%zu changes at %.0f frames a second</text>\n",
        latency.latency_ms.mean, latency.from_ms, latency.to_ms, latency.changes.size(),
        latency.frames_per_second);
    const Plot plot(latency);
    plot.axes(svg);
    plot.mean(svg);
    plot.changes(svg);
    plot.bars(svg);
    return svg + "</svg>\n";
}

}  // namespace theatron::photon
