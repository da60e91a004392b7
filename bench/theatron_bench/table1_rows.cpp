// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "base/statistics.h"
#include "render/gl_driver.h"
#include "table1.h"
#include "table1_inputs.h"

namespace theatron::bench {
namespace {

// The reason with the longest key that begins `key`.
std::string reason_for(const Table1Measured& measured, const std::string& key) {
    std::string best = "It was not measured.";
    std::size_t longest = 0;
    for (const auto& [begin, reason] : measured.reasons)
        if (key.starts_with(begin) && begin.size() >= longest) {
            longest = begin.size();
            best = reason;
        }
    return best;
}

Table1Cell cell(const Table1Measured& measured, const Table1Line::Way& way) {
    Table1Cell result{way.ran, {}, {}};
    if (way.key.empty())
        return result;
    const auto found = measured.samples.find(way.key);
    if (found == measured.samples.end() || found->second.empty()) {
        result.reason = reason_for(measured, way.key);
        return result;
    }
    const std::vector<double>& values = found->second;
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    result.spread = Table1Spread{median(values), *low, *high, int(values.size())};
    return result;
}

std::string device_text(const Table1Measured& measured, Table1Device device) {
    const std::string cores = measured.processor + ", " + std::to_string(measured.cores) + " cores";
    switch (device) {
        case Table1Device::none:
            return "any";
        case Table1Device::thread:
            return measured.processor + ", one thread";
        case Table1Device::gpu:
            return measured.gpu.empty() ? "no GL" : measured.gpu;
        case Table1Device::machine:
            return cores;
    }
    return cores;
}

bool is_cropped(Table1Input input) {
    return input == Table1Input::depth_cropped || input == Table1Input::color_cropped ||
           input == Table1Input::both_cropped;
}

std::vector<std::string> differences(const Table1Measured& measured, const Table1Line& line) {
    std::vector<std::string> result;
    if (line.input != Table1Input::none)
        result.push_back("Another scene: sizes and times depend on what the camera sees.");
    const auto size = measured.sizes.find(line.input);
    const Size papers = is_cropped(line.input) ? paper_cropped : paper_full;
    if (size != measured.sizes.end() && size->second != papers)
        result.push_back("Other pictures: " + size_text(size->second) + " here, " +
                         size_text(papers) + " in the paper.");
    if (line.device == Table1Device::thread || line.device == Table1Device::machine)
        result.push_back("Another processor: the paper's is an Intel i7-7800X.");
    if (line.device == Table1Device::gpu) {
        result.push_back("Another GPU: the paper's is a GeForce RTX 2070.");
        if (render::is_software(measured.gpu))
            result.push_back(measured.gpu +
                             " draws with the processor: the time says nothing about a headset, "
                             "only how the ways of drawing compare with each other.");
    }
    result.insert(result.end(), line.differences.begin(), line.differences.end());
    return result;
}

}  // namespace

std::vector<Table1Row> table1_rows(const Table1Measured& measured) {
    std::vector<Table1Row> rows;
    for (const Table1Line& line : table1_lines()) {
        Table1Row row{line.id,
                      line.group,
                      line.name,
                      line.unit,
                      {},
                      {},
                      cell(measured, line.same),
                      cell(measured, line.best),
                      {},
                      device_text(measured, line.device),
                      differences(measured, line)};
        if (line.paper_low > 0) {
            row.paper_low = line.paper_low;
            row.paper_high = line.paper_high;
        }
        if (const auto input = measured.inputs.find(line.input); input != measured.inputs.end())
            row.input = input->second;
        rows.push_back(std::move(row));
    }
    return rows;
}

}  // namespace theatron::bench
