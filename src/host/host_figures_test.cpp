// SPDX-License-Identifier: Apache-2.0
#include "host/host_figures.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

namespace theatron::host {
namespace {

// One of everything that has fields.
HostFigures full_figures() {
    HostFigures figures;
    HostFigures::Camera camera;
    camera.lane.stages.emplace_back();
    camera.lane.encoders.emplace_back();
    figures.cameras.push_back(camera);
    figures.participants.emplace_back();
    figures.published.emplace_back().sync_offset_seconds = 0.015;
    figures.moments = {.skew_p50_ms = 15, .skew_max_ms = 18, .whole = 90, .unpaired = 12};
    figures.places.cameras.push_back({true, true, false, false, false, 0, 0, {}});
    figures.places.pairs.push_back({0, 0, 0, false});
    figures.visitors.emplace_back();
    figures.certificates.emplace_back();
    return figures;
}

// Names of fields at any depth, without those of `dropped` and `troubles`, which are kinds.
void add_names(const nlohmann::json& json, std::set<std::string>& names) {
    if (json.is_array())
        for (const auto& element : json)
            add_names(element, names);
    if (json.is_object())
        for (const auto& [name, value] : json.items()) {
            names.insert(name);
            if (name != "dropped" && name != "troubles")
                add_names(value, names);
        }
}

std::string metrics_page() {
    std::ifstream in("docs/metrics.md", std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(in), {});
}

TEST(HostFigures, EveryFieldIsOnThePageOfMetrics) {
    const std::string page = metrics_page();
    std::set<std::string> names;
    add_names(to_json(PortFigures{{full_figures(), full_figures()}, {{}}}), names);
    EXPECT_GT(names.size(), 50u);
    for (const std::string& name : names)
        EXPECT_NE(page.find('`' + name + '`'), std::string::npos) << name;
}

TEST(HostFigures, TellWhereThePlacesOfCamerasComeFrom) {
    HostFigures figures = full_figures();
    EXPECT_EQ(to_table(to_json(figures)).find("places of cameras"), std::string::npos);
    figures.registration = {"2026-05-04T10:20:30Z", "board 80x60, 10 places", "They differ."};
    const std::string table = to_table(to_json(figures));
    EXPECT_NE(table.find("places of cameras: 2026-05-04T10:20:30Z, board 80x60, 10 places\n"),
              std::string::npos)
        << table;
    EXPECT_NE(table.find("\nThey differ.\n"), std::string::npos) << table;
}

TEST(HostFigures, TellsWhatTheHostCannotWrite) {
    HostFigures figures = full_figures();
    EXPECT_NE(to_prometheus({{figures}, {}}).find("host_problem{of=\"audit_log\"} 0\n"),
              std::string::npos);
    figures.problems.audit_log = "The audit log cannot be written.";
    const std::string metrics = to_prometheus({{figures}, {}});
    EXPECT_NE(metrics.find("host_problem{of=\"audit_log\"} 1\n"), std::string::npos) << metrics;
    EXPECT_NE(metrics.find("host_problem{of=\"room\"} 0\n"), std::string::npos) << metrics;
    EXPECT_NE(to_table(to_json(figures)).find("\nThe audit log cannot be written.\n"),
              std::string::npos);
}

TEST(HostFigures, TellHowFarApartCamerasAreAndWhatFiltersThePublishedOnes) {
    HostFigures figures = full_figures();
    figures.published.front().name = "face";
    figures.published.front().filter_device = "GPU of a test";
    const nlohmann::json json = to_json(figures);
    EXPECT_EQ(json["skew_ms"]["p50"], 15);
    EXPECT_EQ(json["unpaired"], 12);
    EXPECT_EQ(json["published"][0]["sync_offset_ms"], 15);
    EXPECT_EQ(json["published"][0]["filter_device"], "GPU of a test");
    EXPECT_NE(to_table(json).find("\ncameras 15 ms apart (at most 18), 12 pictures alone\n"),
              std::string::npos);
    const std::string metrics = to_prometheus({{figures}, {}});
    for (const char* line :
         {"theatron_skew_seconds{quantile=\"0.5\"} 0.015\n",
          "theatron_unpaired_pictures_total{} 12\n",
          "theatron_published_sync_offset_seconds{camera=\"0\",name=\"face\"} 0.015\n",
          "theatron_published_filter_on_gpu{camera=\"0\",name=\"face\"} 1\n"})
        EXPECT_NE(metrics.find(line), std::string::npos) << line << metrics;

    figures.moments = {};
    EXPECT_TRUE(to_json(figures)["skew_ms"].is_null());
    EXPECT_EQ(to_table(to_json(figures)).find("ms apart"), std::string::npos);
}

TEST(HostFigures, EveryMetricIsOnThePageOfMetrics) {
    const std::string page = metrics_page();
    std::istringstream lines(to_prometheus({{full_figures()}, {{}}}));
    int families = 0;
    for (std::string line; std::getline(lines, line);)
        if (line.starts_with("# TYPE ")) {
            const std::string name = line.substr(7, line.find(' ', 7) - 7);
            EXPECT_NE(page.find('`' + name + '`'), std::string::npos) << name;
            ++families;
        }
    EXPECT_GT(families, 20);
}

}  // namespace
}  // namespace theatron::host
