// SPDX-License-Identifier: Apache-2.0
#include "filter/chain_settings.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>

#include "base/options.h"
#include "filter/step_fields.h"

namespace theatron::filter {
namespace {

using nlohmann::json;

// The chains `default` and `stereo` follow from the measurements in docs/filters.md.
std::vector<Step> preset(std::string_view name) {
    if (name == "paper")
        return {RangeParams{}, HoleParams{}, KalmanParams{}};
    if (name == "default") {
        // Holes before flying pixels: a removed flying pixel is at an edge and must stay empty.
        return {HoleParams{}, FlyingPixelParams{}, KalmanParams{}};
    }
    if (name == "stereo")
        return {HoleParams{}, FlyingPixelParams{}, SteadyParams{}};
    return {};
}

bool is_preset(std::string_view name) {
    return name == "off" || name == "paper" || name == "default" || name == "stereo";
}

constexpr const char* known =
    "there are range, background, flying_pixels, speckles, holes, kalman and steady, and the "
    "presets "
    "off, paper, default and stereo";

// Calls `use` with the default parameters of the filter of this name.
template <std::size_t index = 0, class Use>
bool with_step(std::string_view name, Use use) {
    if constexpr (index < std::variant_size_v<Step>) {
        using Params = std::variant_alternative_t<index, Step>;
        if (name == StepFields<Params>::name) {
            use(Params{});
            return true;
        }
        return with_step<index + 1>(name, use);
    }
    return false;
}

bool removes_far(const Step& step) {
    return std::holds_alternative<RangeParams>(step) ||
           std::holds_alternative<BackgroundParams>(step);
}

// A filter added to a preset replaces the preset's filter of the same kind. A new filter
// that removes distant pixels goes first, because the others then have less to do.
void add_to_preset(std::vector<Step>& steps, const Step& step) {
    const auto same = std::find_if(steps.begin(), steps.end(),
                                   [&](const Step& s) { return s.index() == step.index(); });
    if (same != steps.end())
        *same = step;
    else
        steps.insert(removes_far(step) ? steps.begin() : steps.end(), step);
}

std::optional<Device> device_of(std::string_view name) {
    if (name == "cpu")
        return Device::processor;
    if (name == "cuda")
        return Device::cuda;
    if (name == "auto")
        return Device::quickest;
    return std::nullopt;
}

// Shortens text from outside for a message.
std::string shown(const std::string& text) {
    return text.size() <= 40 ? text : text.substr(0, 40) + "...";
}

class Reader {
public:
    void set_device(std::string_view name) {
        if (const auto device = device_of(name))
            parsed_.settings.device = *device;
        else
            note("There is no device '" + std::string(name.substr(0, 40)) +
                 "' for filters; there are cpu, cuda and auto.");
    }

    void take_preset(std::string_view name) {
        parsed_.settings.steps = preset(name);
        behind_preset_ = true;
    }

    void add(const Step& step) {
        auto& steps = parsed_.settings.steps;
        if (behind_preset_)
            add_to_preset(steps, step);
        else
            steps.push_back(step);
        if (steps.size() > max_steps)
            note("A chain has at most " + std::to_string(max_steps) + " filters.");
    }

    void set_background_file(std::string file) { parsed_.settings.background_file = file; }

    // Records a problem. Only the first one is reported.
    void note(std::string problem) {
        if (parsed_.problem.empty())
            parsed_.problem = std::move(problem);
    }

    ParsedChain finish() {
        if (parsed_.settings.device != Device::processor && parsed_.settings.off())
            note("There are no filters to run on a GPU: leave the device out.");
        for (const Step& step : parsed_.settings.steps)
            if (const auto* range = std::get_if<RangeParams>(&step))
                if (range->min_mm >= range->max_mm)
                    note("The filter range keeps nothing: min_mm must be less than max_mm.");
        if (!parsed_.problem.empty())
            parsed_.settings = {};
        return std::move(parsed_);
    }

private:
    ParsedChain parsed_;
    bool behind_preset_ = false;
};

void read_step(const std::string& text, Reader& reader) {
    Options options = Options::parse(text);
    const bool there = with_step(options.kind(), [&](auto params) {
        using Params = decltype(params);
        for (const auto& field : StepFields<Params>::fields)
            params.*field.value =
                options.take_int(field.name, params.*field.value, field.min, field.max);
        if constexpr (std::is_same_v<Params, BackgroundParams>)
            if (const std::string file = options.take("file"); !file.empty())
                reader.set_background_file(file);
        if (!options.value().empty())
            reader.note("In the filter '" + text + "', '" + options.value() +
                        "' is not a key=value pair.");
        reader.add(params);
    });
    if (!there)
        reader.note("There is no filter '" + options.kind() + "'; " + known + ".");
    else if (!options.problem().empty())
        reader.note(options.problem());
}

void read_step(const json& object, Reader& reader) {
    const auto name = object.is_object() ? object.find("filter") : object.end();
    if (!object.is_object() || name == object.end() || !name->is_string())
        return reader.note("Each filter is an object that names it, as {\"filter\": \"holes\"}.");
    const std::string& kind = name->get_ref<const std::string&>();
    const bool there = with_step(kind, [&](auto params) {
        using Params = decltype(params);
        for (auto item = object.begin(); item != object.end(); ++item) {
            const std::string& key = item.key();
            const json& value = item.value();
            if (key == "filter")
                continue;
            if (std::is_same_v<Params, BackgroundParams> && key == "file" && value.is_string()) {
                reader.set_background_file(value.get<std::string>());
                continue;
            }
            const auto& fields = StepFields<Params>::fields;
            const auto field = std::find_if(std::begin(fields), std::end(fields),
                                            [&](const auto& f) { return f.name == key; });
            if (field == std::end(fields))
                return reader.note("The filter " + kind + " has no parameter '" + shown(key) +
                                   "'.");
            const bool fits =
                value.is_number_integer() && value >= field->min && value <= field->max;
            if (!fits)
                return reader.note("The filter " + kind + " takes " + field->name +
                                   " as a whole number from " + std::to_string(field->min) +
                                   " to " + std::to_string(field->max) + ".");
            params.*field->value = value.get<int>();
        }
        reader.add(params);
    });
    if (!there)
        reader.note("There is no filter '" + shown(kind) + "'; " + known + ".");
}

}  // namespace

bool ChainSettings::needs_background() const {
    return std::any_of(steps.begin(), steps.end(), [](const Step& step) {
        return std::holds_alternative<BackgroundParams>(step);
    });
}

std::string ChainSettings::spelling() const {
    std::string text;
    for (const Step& step : steps) {
        if (!text.empty())
            text += '+';
        std::visit(
            [&](const auto& params) {
                using Params = std::decay_t<decltype(params)>;
                text += StepFields<Params>::name;
                char separator = ':';
                for (const auto& field : StepFields<Params>::fields) {
                    if (params.*field.value == Params{}.*field.value)
                        continue;
                    text += separator;
                    text += field.name;
                    text += '=' + std::to_string(params.*field.value);
                    separator = ',';
                }
            },
            step);
    }
    return text;
}

ParsedChain parse_chain(std::string_view text) {
    Reader reader;
    if (text.empty())
        return reader.finish();
    // A name of a background's file may have the character, too.
    const auto at = text.rfind('@');
    if (at != std::string_view::npos &&
        (device_of(text.substr(at + 1)) || text.find("file=") == std::string_view::npos)) {
        const std::string_view device = text.substr(at + 1),
                               name = device.substr(0, device.find('+'));
        if (name != device && device_of(name))
            reader.note("The device stands at the end of the line: '" +
                        shown(std::string(text.substr(0, at)) +
                              std::string(device.substr(name.size())) + "@" + std::string(name)) +
                        "'.");
        reader.set_device(device);
        text = text.substr(0, at);
    }
    bool first = true;
    while (true) {
        const auto plus = text.find('+');
        const std::string part(text.substr(0, plus));
        if (first && is_preset(part))
            reader.take_preset(part);
        else
            read_step(part, reader);
        first = false;
        if (plus == std::string_view::npos)
            return reader.finish();
        text.remove_prefix(plus + 1);
    }
}

ParsedChain parse_chain_json(std::string_view text) {
    Reader reader;
    const json root = json::parse(text, nullptr, /*allow_exceptions=*/false,
                                  /*ignore_comments=*/true);
    if (!root.is_object()) {
        reader.note("The file is not a JSON object, as {\"preset\": \"default\"}.");
        return reader.finish();
    }
    for (const auto& [key, value] : root.items()) {
        if (key == "preset" && value.is_string() && is_preset(value.get_ref<const std::string&>()))
            reader.take_preset(value.get_ref<const std::string&>());
        else if (key == "preset")
            reader.note("The preset is one of off, paper, default and stereo.");
        else if (key == "device" && value.is_string())
            reader.set_device(value.get_ref<const std::string&>());
        else if (key == "device")
            reader.note("The device is one of cpu, cuda and auto.");
        else if (key != "filters")
            reader.note("The file has no use for '" + shown(key) +
                        "'; there are preset, filters and device.");
        else if (!value.is_array())
            reader.note("The filters are a list, as [{\"filter\": \"holes\"}].");
    }
    const auto filters = root.find("filters");
    if (filters != root.end() && filters->is_array())
        for (const json& filter : *filters)
            read_step(filter, reader);
    return reader.finish();
}

}  // namespace theatron::filter
