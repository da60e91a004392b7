// SPDX-License-Identifier: Apache-2.0
#include "face/recording.h"

#include <charconv>
#include <cmath>
#include <cstdio>

namespace theatron::face {
namespace {

constexpr std::string_view first_line = "# theatron face 1";
constexpr std::size_t max_columns = 256;
constexpr float max_seconds = 86400;

std::string_view next_line(std::string_view& text) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    if (!line.empty() && line.back() == '\r')
        line.remove_suffix(1);
    return line;
}

std::vector<std::string_view> fields_of(std::string_view line) {
    std::vector<std::string_view> fields;
    for (std::size_t begin = 0; fields.size() <= max_columns;) {
        const std::size_t end = std::min(line.find(',', begin), line.size());
        fields.push_back(line.substr(begin, end - begin));
        if (end == line.size())
            break;
        begin = end + 1;
    }
    return fields;
}

template <class T>
std::optional<T> number_in(std::string_view field) {
    T value{};
    const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
    if (error != std::errc() || end != field.data() + field.size())
        return std::nullopt;
    return value;
}

class Reading {
public:
    RecordingRead read(std::string_view text) {
        for (; !text.empty() && result_.problem.empty(); ++line_) {
            const std::string_view line = next_line(text);
            if (line_ == 1 && line != first_line)
                return wrong("the first line is not '# theatron face 1'"), result_;
            if (line.empty())
                continue;
            if (line[0] == '#')
                note(line);
            else if (!has_columns_)
                columns(line);
            else
                row(line);
        }
        if (result_.problem.empty() && (!has_columns_ || rows_ == 0))
            result_.problem = "there is no row of values";
        return std::move(result_);
    }

private:
    void wrong(const char* what) {
        result_.problem = "line " + std::to_string(line_) + ": " + what;
    }

    void note(std::string_view line) {
        constexpr std::string_view source = "# source ", synthetic = "# synthetic ";
        if (line.substr(0, source.size()) == source) {
            const auto named = source_of(line.substr(source.size()));
            if (!named)
                return wrong("the source is none of arkit, unified, xr_fb, xr_htc");
            result_.recording.source = *named;
        } else if (line.substr(0, synthetic.size()) == synthetic) {
            result_.recording.is_synthetic = line.substr(synthetic.size()) == "yes";
        }
    }

    void columns(std::string_view line) {
        const auto fields = fields_of(line);
        if (fields.size() > max_columns)
            return wrong("there are more than 256 columns");
        if (fields.size() < 4 || fields[0] != "time_s" || fields[1] != "take" ||
            fields[2] != "label")
            return wrong("the columns do not begin with time_s,take,label");
        const SourceTable& table = table_of(result_.recording.source);
        // One naming for the whole file: the source's, or ARKit's.
        for (const Source naming : {result_.recording.source, Source::arkit}) {
            const SourceTable& names = table_of(naming);
            inputs_.clear();
            for (std::size_t i = 3; i < fields.size(); ++i)
                if (const auto input = names.input_of(fields[i]))
                    inputs_.push_back(*input);
            if (inputs_.size() + 3 != fields.size())
                continue;
            naming_ = naming;
            limit_ = table.mask;
            has_columns_ = true;
            return;
        }
        wrong("a column has a name that the source does not know");
    }

    void row(std::string_view line) {
        if (++rows_ > max_recording_rows)
            return wrong("there are more than 500000 rows");
        const auto fields = fields_of(line);
        if (fields.size() != inputs_.size() + 3)
            return wrong("the row has another number of fields than the columns");
        const auto time = number_in<float>(fields[0]);
        const auto take = number_in<int>(fields[1]);
        if (!time || !std::isfinite(*time) || *time < 0 || *time > max_seconds || !take)
            return wrong("the time or the number of the take is no number in range");
        const auto label = emotion_of(fields[2]);
        if (!label) {
            ++result_.recording.left_out_rows;
            return;
        }
        std::vector<float> inputs(table_of(naming_).inputs.size());
        std::vector<bool> present(inputs.size());
        for (std::size_t i = 0; i < inputs_.size(); ++i) {
            if (fields[i + 3].empty())
                continue;
            const auto value = number_in<float>(fields[i + 3]);
            if (!value || !std::isfinite(*value))
                return wrong("a value is no number");
            inputs[inputs_[i]] = *value;
            present[inputs_[i]] = true;
        }
        add(*take, *label, *time, map_inputs(naming_, inputs, present));
    }

    void add(int number, Emotion label, float time, Mapped mapped) {
        auto& takes = result_.recording.takes;
        mapped.present &= limit_;
        if (takes.empty() || number != take_ || takes.back().label != label) {
            takes.push_back({0, label, mapped.present, {}});
            take_ = number;
        } else if (time < takes.back().samples.back().time_s) {
            return wrong("the time goes back within a take");
        }
        // A value that is missing in one row is missing in the take: half a channel is no channel.
        takes.back().present &= mapped.present;
        takes.back().samples.push_back({time, mapped.values});
    }

    RecordingRead result_;
    std::size_t line_ = 1, rows_ = 0;
    bool has_columns_ = false;
    Source naming_ = Source::arkit;
    ChannelMask limit_;
    std::vector<std::size_t> inputs_;
    int take_ = 0;
};

}  // namespace

RecordingRead parse_recording(std::string_view text) {
    return Reading().read(text);
}

std::string recording_text(const Recording& recording) {
    std::string text = std::string(first_line) + "\n# source " +
                       std::string(source_name(recording.source)) + "\n# synthetic " +
                       (recording.is_synthetic ? "yes" : "no") + "\ntime_s,take,label";
    const ChannelMask mask = table_of(recording.source).mask;
    for (std::size_t i = 0; i < channel_count; ++i)
        if (mask[i])
            text += "," + std::string(channel_names[i]);
    text += "\n";
    int number = 0;
    for (const Take& take : recording.takes) {
        for (const Sample& sample : take.samples) {
            char field[32];
            std::snprintf(field, sizeof(field), "%.3f,%d,", double(sample.time_s), number);
            text += field;
            text += to_text(take.label);
            for (std::size_t i = 0; i < channel_count; ++i) {
                if (!mask[i])
                    continue;
                text += ",";
                if (!take.present[i])
                    continue;
                std::snprintf(field, sizeof(field), "%.4f", double(sample.values[i]));
                text += field;
            }
            text += "\n";
        }
        ++number;
    }
    return text;
}

}  // namespace theatron::face
