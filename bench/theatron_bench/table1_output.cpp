// SPDX-License-Identifier: Apache-2.0
#include "table1_output.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/statistics.h"
#include "svg_drawing.h"

namespace theatron::bench {
namespace {

constexpr const char* yardstick = "depth/full/zstd1_raw/";

std::optional<double> median_of(const Table1Measured& measured, const std::string& key) {
    const auto found = measured.samples.find(key);
    if (found == measured.samples.end() || found->second.empty())
        return std::nullopt;
    return median(found->second);
}

nlohmann::json json_of(const Table1Cell& cell) {
    if (cell.spread)
        return {{"ran", cell.ran},
                {"median", cell.spread->median},
                {"low", cell.spread->low},
                {"high", cell.spread->high},
                {"runs", cell.spread->runs}};
    if (cell.reason.empty())
        return nullptr;
    return {{"ran", cell.ran}, {"reason", cell.reason}};
}

std::string csv_field(const std::string& text) {
    if (text.find_first_of(",\"\r\n") == std::string::npos)
        return text;
    std::string quoted = "\"";
    for (const char c : text)
        quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
    return quoted + "\"";
}

std::string number(double value) {
    return formatted("%.6g", value);
}

std::vector<std::string> csv_fields(const Table1Cell& cell) {
    if (!cell.spread)
        return {cell.ran, "", "", "", "", cell.reason};
    return {cell.ran,
            number(cell.spread->median),
            number(cell.spread->low),
            number(cell.spread->high),
            std::to_string(cell.spread->runs),
            ""};
}

std::string csv_line(const std::vector<std::string>& fields) {
    std::string line;
    for (const std::string& field : fields)
        line += (line.empty() ? "" : ",") + csv_field(field);
    return line + "\n";
}

std::string padded(const std::string& text, std::size_t width) {
    return text + std::string(text.size() < width ? width - text.size() : 1, ' ');
}

}  // namespace

std::string figure_text(double value) {
    if (value == 0)
        return "0";
    const double size = std::abs(value);
    return formatted(size >= 99.95 ? "%.0f" : size >= 9.995 ? "%.1f" : "%.2f", value);
}

std::string paper_text(const Table1Row& row) {
    if (!row.paper_low)
        return "";
    // As it is printed there.
    const auto printed = [](double value) { return formatted("%g", value); };
    return *row.paper_low == *row.paper_high
               ? printed(*row.paper_low)
               : printed(*row.paper_low) + " to " + printed(*row.paper_high);
}

std::string spread_text(const Table1Cell& cell) {
    if (!cell.spread)
        return "-";
    const Table1Spread& s = *cell.spread;
    const std::string low = figure_text(s.low), high = figure_text(s.high);
    return figure_text(s.median) + (low == high ? "" : " (" + low + " to " + high + ")");
}

std::vector<std::string> notes_of(const std::vector<Table1Row>& rows) {
    std::vector<std::string> notes;
    for (const Table1Row& row : rows)
        for (const std::string& sentence : row.not_comparable)
            if (std::find(notes.begin(), notes.end(), sentence) == notes.end())
                notes.push_back(sentence);
    return notes;
}

std::vector<int> note_numbers(const Table1Row& row, const std::vector<std::string>& notes) {
    std::vector<int> numbers;
    for (const std::string& sentence : row.not_comparable)
        numbers.push_back(int(std::find(notes.begin(), notes.end(), sentence) - notes.begin()) + 1);
    std::sort(numbers.begin(), numbers.end());
    return numbers;
}

std::vector<std::string> table1_remarks(const Table1Measured& measured) {
    std::vector<std::string> remarks = {
        "Here: " + measured.processor + ", " + std::to_string(measured.cores) + " cores; " +
            (measured.gpu.empty() ? "no GL." : "GL: " + measured.gpu + "."),
        (measured.runs == 1 ? "One run"
                            : "Medians of " + std::to_string(measured.runs) +
                                  " runs, with the lowest and the highest") +
            "; codecs and filters have " + std::to_string(measured.frames) +
            " pictures of each kind. 1 kB is 1024 bytes, as in the paper."};
    const auto encode = median_of(measured, std::string(yardstick) + "encode_ms");
    const auto decode = median_of(measured, std::string(yardstick) + "decode_ms");
    if (encode && decode)
        remarks.push_back("Yardstick for other machines: zstd level 1 on the depth's pixels, " +
                          figure_text(*encode) + " ms to compress, " + figure_text(*decode) +
                          " ms to decompress.");
    double all_seconds = 0;
    std::string parts;
    for (const auto& [part, seconds] : measured.part_seconds) {
        all_seconds += seconds;
        parts += (parts.empty() ? ": " : ", ") + part + " " + formatted("%.0f", seconds);
    }
    if (!parts.empty())
        remarks.push_back("It took " + formatted("%.0f", all_seconds) + " s" + parts + ".");
    if (measured.cores_of_others > 0.2)
        remarks.push_back("Other programs used " + formatted("%.1f", measured.cores_of_others) +
                          " cores before the first run: times are longer than on an idle machine.");
    return remarks;
}

std::string table1_text(const Table1Measured& measured, const std::vector<Table1Row>& rows) {
    std::string text = std::string(paper_title) + "\nPaper: " + paper_machine + ".\n";
    for (const std::string& remark : table1_remarks(measured))
        text += remark + "\n";
    const std::vector<std::string> notes = notes_of(rows);
    constexpr std::size_t name = 46, unit = 6, paper = 12, cell = 26;
    std::string group;
    for (const Table1Row& row : rows) {
        if (row.group != group) {
            group = row.group;
            text += "\n" + padded(group, name) + padded("unit", unit) + padded("paper", paper) +
                    padded("here, paper's method", cell) + padded("here, Theatron's choice", cell) +
                    "notes\n";
        }
        std::string line = padded("  " + row.name, name) + padded(row.unit, unit) +
                           padded(paper_text(row).empty() ? "-" : paper_text(row), paper) +
                           padded(spread_text(row.same), cell) +
                           padded(spread_text(row.best), cell);
        for (const int note : note_numbers(row, notes))
            line += (line.back() == ' ' ? "" : ",") + std::to_string(note);
        text += line + "\n";
        const std::string reason = !row.same.reason.empty() ? row.same.reason : row.best.reason;
        if (!reason.empty())
            text += "    no figure: " + reason + "\n";
    }
    if (!measured.stages.empty())
        text += "\nMean age of a drawn picture of a synthetic camera, without display:\n";
    for (const photon::Stage& stage : measured.stages)
        text += "  " + padded(formatted("%.1f ms", stage.mean_ms), 12) + stage.name + "\n";
    text += "\nWhy a figure here cannot be compared with the paper's:\n";
    for (std::size_t i = 0; i < notes.size(); ++i)
        text += "  " + std::to_string(i + 1) + " " + notes[i] + "\n";
    return text;
}

nlohmann::json table1_json(const Table1Measured& measured, const std::vector<Table1Row>& rows) {
    nlohmann::json here = {{"processor", measured.processor},
                           {"cores", measured.cores},
                           {"gl_renderer", nullptr},
                           {"cores_of_others", measured.cores_of_others},
                           {"runs", measured.runs},
                           {"frames", measured.frames},
                           {"part_seconds", nlohmann::json::object()},
                           {"yardstick", nullptr}};
    for (const auto& [part, seconds] : measured.part_seconds)
        here["part_seconds"][part] = seconds;
    if (!measured.gpu.empty())
        here["gl_renderer"] = measured.gpu;
    const std::string key = yardstick;
    if (const auto encode = median_of(measured, key + "encode_ms"))
        here["yardstick"] = {{"name", "zstd1_raw"},
                             {"encode_ms", *encode},
                             {"decode_ms", median_of(measured, key + "decode_ms").value_or(0)},
                             {"kb", median_of(measured, key + "kb").value_or(0)}};
    nlohmann::json list = nlohmann::json::array();
    for (const Table1Row& row : rows) {
        nlohmann::json paper;
        if (row.paper_low)
            paper = {{"low", *row.paper_low}, {"high", *row.paper_high}};
        list.push_back({{"id", row.id},
                        {"group", row.group},
                        {"name", row.name},
                        {"unit", row.unit},
                        {"paper", paper},
                        {"same", json_of(row.same)},
                        {"best", json_of(row.best)},
                        {"input", row.input},
                        {"device", row.device},
                        {"not_comparable", row.not_comparable}});
    }
    nlohmann::json stages = nlohmann::json::array();
    for (const photon::Stage& stage : measured.stages)
        stages.push_back({{"until", stage.id}, {"what", stage.name}, {"mean_ms", stage.mean_ms}});
    return {{"paper", {{"title", paper_title}, {"machine", paper_machine}}},
            {"here", here},
            {"stages", stages},
            {"bytes_per_kb", bytes_per_kb},
            {"rows", list}};
}

std::string table1_csv(const std::vector<Table1Row>& rows) {
    std::vector<std::string> names = {"id", "group", "row", "unit", "paper_low", "paper_high"};
    for (const std::string way : {"same", "best"})
        for (const char* what : {"ran", "median", "low", "high", "runs", "reason"})
            names.push_back(way + "_" + what);
    for (const char* name : {"input", "device", "not_comparable"})
        names.emplace_back(name);
    std::string text = csv_line(names);
    for (const Table1Row& row : rows) {
        std::vector<std::string> fields = {row.id,
                                           row.group,
                                           row.name,
                                           row.unit,
                                           row.paper_low ? formatted("%g", *row.paper_low) : "",
                                           row.paper_high ? formatted("%g", *row.paper_high) : ""};
        for (const Table1Cell* cell : {&row.same, &row.best})
            for (std::string& field : csv_fields(*cell))
                fields.push_back(std::move(field));
        std::string sentences;
        for (const std::string& sentence : row.not_comparable)
            sentences += (sentences.empty() ? "" : " ") + sentence;
        fields.insert(fields.end(), {row.input, row.device, sentences});
        text += csv_line(fields);
    }
    return text;
}

}  // namespace theatron::bench
