// SPDX-License-Identifier: Apache-2.0
#include "cases/manifest.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <initializer_list>
#include <nlohmann/json.hpp>

#include "base/outside_text.h"

namespace theatron::cases {
namespace {

using Json = nlohmann::ordered_json;
using medical::Axes;
using medical::Case;
using medical::Part;
using medical::Series;
using medical::Unit;

constexpr std::array<std::string_view, 3> unit_names{"mm", "cm", "m"};
constexpr std::array<std::string_view, 3> axes_names{"LPS", "RAS", "Y_UP"};
constexpr std::array<std::string_view, 5> modalities{"CT", "MR", "PT", "US", "OT"};
constexpr int deepest = 4;  // object, list, object, list
constexpr int most_slices = 4096;

std::string in_quotes(std::string_view text) {
    return "'" + clean_text(text, 40) + "'";
}

template <class List>
std::string listed(const List& names) {
    std::string text;
    for (const std::string_view name : names)
        text += (text.empty() ? "" : ", ") + std::string(name);
    return text;
}

// Reads members of objects; the first thing that is wrong is kept.
class Fields {
public:
    void note(std::string problem) {
        if (problem_.empty())
            problem_ = std::move(problem);
    }
    const std::string& problem() const { return problem_; }
    bool good() const { return problem_.empty(); }

    // The object that is read next, and what it is called in problems ("part 3").
    void enter(const Json& object, std::string what,
               std::initializer_list<std::string_view> known) {
        static const Json none = Json::object();
        what_ = std::move(what);
        object_ = object.is_object() ? &object : &none;
        if (!object.is_object())
            return note("holds no object as " + what_);
        for (const auto& [key, value] : object.items())
            if (std::find(known.begin(), known.end(), key) == known.end())
                return note("has the unknown key " + in_quotes(key) + where());
    }

    const Json* member(const char* key) {
        const auto found = object_->find(key);
        if (found != object_->end())
            return &*found;
        note("lacks '" + std::string(key) + "'" + where());
        return nullptr;
    }
    bool has(const char* key) const { return object_->contains(key); }

    std::string text(const char* key, std::size_t max_characters) {
        const Json* value = member(key);
        if (!value)
            return "";
        if (!value->is_string()) {
            note("holds no text as '" + std::string(key) + "'" + where());
            return "";
        }
        const auto& given = value->get_ref<const std::string&>();
        const std::string cleaned = clean_text(given, max_characters);
        if (cleaned != given)
            note("holds a text as '" + std::string(key) + "'" + where() + " that is longer than " +
                 std::to_string(max_characters) + " characters or has control characters");
        return cleaned;
    }

    double number(const char* key, double low, double high) {
        const Json* value = member(key);
        if (!value)
            return low;
        if (value->is_number()) {
            const double number = value->get<double>();
            if (number >= low && number <= high)
                return number;
        }
        char range[64];
        std::snprintf(range, sizeof(range), "from %g to %g", low, high);
        note("holds no number " + std::string(range) + " as '" + key + "'" + where());
        return low;
    }

    bool flag(const char* key) {
        const Json* value = member(key);
        if (value && !value->is_boolean())
            note("holds neither true nor false as '" + std::string(key) + "'" + where());
        return value && value->is_boolean() && value->get<bool>();
    }

    // The place of a text among `names`.
    template <class List>
    std::size_t choice(const char* key, const List& names) {
        const std::string given = text(key, 40);
        const auto found = std::find(names.begin(), names.end(), given);
        if (found != names.end())
            return std::size_t(found - names.begin());
        note("has " + in_quotes(given) + " as '" + key + "'" + where() + "; it is one of " +
             listed(names));
        return 0;
    }

    std::string file() {
        const std::string name = text("file", 100);
        if (good() && !is_plain_file_name(name))
            note("names the file " + in_quotes(name) + where() +
                 "; a file lies in the case's folder and has a name of letters, digits, blanks and "
                 "'._-'");
        return name;
    }

    Rgb color() {
        const std::string given = text("color", 40);
        unsigned r = 0, g = 0, b = 0;
        int end = 0;
        const bool hexadecimal =
            given.size() == 7 && given[0] == '#' &&
            given.find_first_not_of("0123456789abcdefABCDEF", 1) == std::string::npos;
        if (!hexadecimal || std::sscanf(given.c_str(), "#%2x%2x%2x%n", &r, &g, &b, &end) != 3)
            note("has " + in_quotes(given) + " as 'color'" + where() +
                 "; a colour is written as #rrggbb");
        return {std::uint8_t(r), std::uint8_t(g), std::uint8_t(b)};
    }

    // A list of at most `most` members, or nothing and a problem.
    std::vector<const Json*> list(const char* key, std::size_t most) {
        std::vector<const Json*> items;
        const Json* value = member(key);
        if (!value)
            return items;
        if (!value->is_array() || value->size() > most) {
            note("holds no list of at most " + std::to_string(most) + " as '" + key + "'" +
                 where());
            return items;
        }
        for (const Json& item : *value)
            items.push_back(&item);
        return items;
    }

    std::string where() const { return what_.empty() ? "" : " in " + what_; }

private:
    std::string problem_;
    std::string what_;
    const Json* object_ = nullptr;
};

Part read_part(Fields& fields, const Json& json, std::size_t number) {
    fields.enter(json, "part " + std::to_string(number),
                 {"name", "role", "file", "color", "opacity"});
    Part part;
    part.name = fields.text("name", max_name_characters);
    part.role = medical::Role(fields.choice("role", medical::role_names));
    part.file = fields.file();
    part.color = fields.color();
    part.opacity = fields.number("opacity", 0, 1);
    return part;
}

Series read_series(Fields& fields, const Json& json, std::size_t number) {
    fields.enter(json, "series " + std::to_string(number),
                 {"name", "modality", "file", "missing_slices"});
    Series series;
    series.name = fields.text("name", max_name_characters);
    series.modality = std::string(modalities[fields.choice("modality", modalities)]);
    series.file = fields.file();
    if (!fields.has("missing_slices"))
        return series;
    for (const Json* slice : fields.list("missing_slices", most_slices)) {
        const double number_of_slice = slice->is_number_integer() ? slice->get<double>() : -1;
        if (number_of_slice >= 0 && number_of_slice < most_slices)
            series.missing_slices.push_back(int(number_of_slice));
        else
            fields.note("has something else than numbers of slices as 'missing_slices'" +
                        fields.where());
    }
    return series;
}

bool is_too_deep(std::string_view text) {
    int depth = 0, most = 0;
    bool in_text = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (in_text && text[i] == '\\') {
            ++i;
        } else if (text[i] == '"') {
            in_text = !in_text;
        } else if (!in_text) {
            depth += (text[i] == '{' || text[i] == '[') - (text[i] == '}' || text[i] == ']');
            most = std::max(most, depth);
        }
    }
    return most > deepest;
}

medical::CasePicture read_picture(Fields& fields, const Json& json, std::size_t number) {
    fields.enter(json, "picture " + std::to_string(number), {"name", "file"});
    medical::CasePicture picture;
    picture.name = fields.text("name", max_name_characters);
    picture.file = fields.file();
    return picture;
}

std::string problem_of_version(const Json& json) {
    const auto version = json.find("theatron_case");
    if (version == json.end())
        return "is not the manifest of a case: it lacks 'theatron_case'";
    if (!version->is_number_integer() || version->get<double>() < 1)
        return "holds no version as 'theatron_case'";
    if (version->get<double>() > manifest_version)
        return "is of version " + version->dump().substr(0, 12) +
               ", which a newer version of Theatron wrote; this one reads version " +
               std::to_string(manifest_version);
    return "";
}

}  // namespace

bool is_plain_file_name(std::string_view name) {
    const auto is_fit = [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
               c == '.' || c == '_' || c == '-' || c == ' ';
    };
    return !name.empty() && name.size() <= 100 && name[0] != '.' &&
           std::all_of(name.begin(), name.end(), is_fit);
}

ParsedManifest parse_manifest(std::string_view text) {
    if (text.size() > max_manifest_bytes)
        return {{}, "is larger than " + std::to_string(max_manifest_bytes >> 10) + " KiB"};
    if (is_too_deep(text))
        return {{}, "is not the manifest of a case: it is nested too deeply"};
    const Json json = Json::parse(text, nullptr, /*allow_exceptions=*/false);
    if (!json.is_object())
        return {{}, json.is_discarded() ? "is not JSON" : "is not a JSON object"};
    if (std::string problem = problem_of_version(json); !problem.empty())
        return {{}, std::move(problem)};

    Fields fields;
    Case value;
    const bool has_pictures = json["theatron_case"] != manifest_version_without_pictures;
    if (has_pictures)
        fields.enter(json, "",
                     {"theatron_case", "name", "units", "space", "deidentified", "license",
                      "credit", "parts", "series", "pictures"});
    else
        fields.enter(json, "",
                     {"theatron_case", "name", "units", "space", "deidentified", "license",
                      "credit", "parts", "series"});
    value.name = fields.text("name", max_name_characters);
    value.unit = Unit(fields.choice("units", unit_names));
    value.axes = Axes(fields.choice("space", axes_names));
    value.deidentified = fields.flag("deidentified");
    value.license = fields.text("license", max_credit_characters);
    value.credit = fields.text("credit", max_credit_characters);
    const auto parts = fields.list("parts", max_parts);
    const auto series = fields.list("series", max_series);
    const auto pictures =
        has_pictures ? fields.list("pictures", max_pictures) : std::vector<const Json*>();
    for (const Json* part : parts)
        value.parts.push_back(read_part(fields, *part, value.parts.size() + 1));
    for (const Json* one : series)
        value.series.push_back(read_series(fields, *one, value.series.size() + 1));
    for (const Json* one : pictures)
        value.pictures.push_back(read_picture(fields, *one, value.pictures.size() + 1));
    return {std::move(value), fields.problem()};
}

std::string manifest_text(const Case& value) {
    Json parts = Json::array();
    for (const Part& part : value.parts) {
        char color[8];
        std::snprintf(color, sizeof(color), "#%02x%02x%02x", part.color.r, part.color.g,
                      part.color.b);
        parts.push_back({{"name", part.name},
                         {"role", medical::to_text(part.role)},
                         {"file", part.file},
                         {"color", color},
                         {"opacity", part.opacity}});
    }
    Json all_series = Json::array();
    for (const Series& one : value.series) {
        Json series{{"name", one.name}, {"modality", one.modality}, {"file", one.file}};
        if (!one.missing_slices.empty())
            series["missing_slices"] = one.missing_slices;
        all_series.push_back(std::move(series));
    }
    Json json{{"theatron_case",
               value.pictures.empty() ? manifest_version_without_pictures : manifest_version},
              {"name", value.name},
              {"units", unit_names[std::size_t(value.unit)]},
              {"space", axes_names[std::size_t(value.axes)]},
              {"deidentified", value.deidentified},
              {"license", value.license},
              {"credit", value.credit},
              {"parts", parts},
              {"series", all_series}};
    for (const medical::CasePicture& one : value.pictures)
        json["pictures"].push_back({{"name", one.name}, {"file", one.file}});
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace theatron::cases
