// SPDX-License-Identifier: Apache-2.0
#include "photon/latency_plot.h"

#include <gtest/gtest.h>

namespace theatron::photon {
namespace {

std::size_t count(const std::string& text, const std::string& part) {
    std::size_t found = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
        ++found;
    return found;
}

FilmLatency measured(std::vector<double> latencies) {
    FilmLatency latency;
    for (std::size_t i = 0; i < latencies.size(); ++i)
        latency.changes.push_back({33.0 * double(i), latencies[i]});
    latency.latency_ms = spread_of(latencies);
    latency.from_ms = latency.latency_ms.mean - 2;
    latency.to_ms = latency.latency_ms.mean + 2;
    latency.frames_per_second = 240;
    return latency;
}

TEST(LatencyPlot, ShowsEveryChangeAndTheMean) {
    const std::string svg = latency_svg(measured({100, 110, 120}), "film.mp4");
    EXPECT_EQ(count(svg, "<circle"), 3u);
    EXPECT_EQ(count(svg, "class='mean'"), 1u);
    EXPECT_NE(svg.find("mean 110.0, between 108.0 and 112.0"), std::string::npos);
    EXPECT_TRUE(svg.ends_with("</svg>\n"));
}

TEST(LatencyPlot, OfEqualLatenciesHasFiniteNumbers) {
    const std::string svg = latency_svg(measured({100, 100}), "same");
    EXPECT_EQ(svg.find("nan"), std::string::npos);
    EXPECT_EQ(svg.find("inf"), std::string::npos);
}

TEST(LatencyPlot, TakesNoMarkupFromTheTitle) {
    EXPECT_NE(latency_svg(measured({1, 2}), "<b>&\n").find("&lt;b&gt;&amp; </text>"),
              std::string::npos);
}

}  // namespace
}  // namespace theatron::photon
