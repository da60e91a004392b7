// SPDX-License-Identifier: Apache-2.0
#include "cases/import_case.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/outside_text.h"
#include "cases/case_folder.h"
#include "cases/import_parts.h"
#include "cases/new_folder.h"
#include "files/file_bytes.h"
#include "files/private_file.h"

namespace theatron::cases {
namespace {

namespace fs = std::filesystem;
using medical::Case;

std::string lower(std::string_view text) {
    std::string result(text);
    for (char& c : result)
        c = c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c;
    return result;
}

// The words of the patient's names and numbers. Parts are named after files, and files are often
// named after patients.
std::vector<std::string> telling_words(const std::vector<ImportedSeries>& all_series) {
    std::vector<std::string> words;
    for (const ImportedSeries& series : all_series)
        for (const Identifier& identifier : series.identifiers) {
            if (identifier.name != "PatientName" && identifier.name != "PatientID" &&
                identifier.name != "OtherPatientNames" && identifier.name != "OtherPatientIDs" &&
                identifier.name != "AccessionNumber")
                continue;
            std::string word;
            for (const char c : lower(identifier.value) + "^") {
                const bool parts_words = c == '^' || c == ' ' || c == ',' || c == '=' || c == '\\';
                if (!parts_words) {
                    word += c;
                    continue;
                }
                if (word.size() >= 3)
                    words.push_back(word);
                word.clear();
            }
        }
    return words;
}

bool tells(const std::string& name, const std::vector<std::string>& words) {
    const std::string lowered = lower(name);
    return std::any_of(words.begin(), words.end(), [&](const std::string& word) {
        return lowered.find(word) != std::string::npos;
    });
}

void write_identifiers(const fs::path& folder, const std::vector<ImportedSeries>& all_series) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    bool any = false;
    for (const ImportedSeries& series : all_series) {
        nlohmann::ordered_json one{{"file", series.series.file}};
        for (const Identifier& identifier : series.identifiers) {
            one[identifier.name] = identifier.value;
            any = true;
        }
        list.push_back(std::move(one));
    }
    if (any)
        files::write_private_file(
            folder / identifiers_name,
            nlohmann::ordered_json{{"series", list}}.dump(
                2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) +
                "\n");
}

std::optional<Case> manifest_of(const SourceFiles& files) {
    for (const fs::path& file : files.others)
        if (file.filename() == manifest_name)
            return read_manifest(file.parent_path());
    return std::nullopt;
}

std::vector<ImportedPart> parts_of(const SourceFiles& files, const std::optional<Case>& manifest,
                                   const ImportOptions& options, std::vector<std::string>& remarks,
                                   const Progress& progress) {
    const bool from_labels = options.surfaces_from_labels || files.meshes.empty();
    if (options.surfaces_from_labels && files.label_maps.empty())
        throw Error("The source holds no label map (NIfTI, NRRD) to make surfaces of.");
    if (!from_labels) {
        if (!files.label_maps.empty())
            remarks.push_back(
                "The source has surfaces, so its label map is not used; use it with "
                "--from-labels.");
        return import_meshes(files.meshes, manifest, options, remarks, progress);
    }
    std::vector<ImportedPart> parts;
    for (const fs::path& file : files.label_maps) {
        std::vector<ImportedPart> more = import_labels(file, options, remarks, progress);
        // A file for each organ, as TotalSegmentator writes them: its name is the organ's.
        if (more.size() == 1 && more[0].part.name == "label 1" && options.labels.empty()) {
            std::string name = file.filename().string();
            name = name.substr(0, name.find('.'));
            std::replace(name.begin(), name.end(), '_', ' ');
            medical::Part& part = more[0].part;
            part.name = clean_text(name, max_name_characters);
            part.role = medical::role_of_name(part.name);
            part.color = medical::usual_color(part.role);
            part.opacity = medical::usual_opacity(part.role);
        }
        std::move(more.begin(), more.end(), std::back_inserter(parts));
    }
    if (parts.size() > max_parts)
        throw Error("The source holds more than " + std::to_string(max_parts) + " labels.");
    return parts;
}

}  // namespace

ImportReport import_case(const fs::path& source, const fs::path& folder,
                         const ImportOptions& options, const Progress& progress) {
    const SourceFiles files = find_source_files(source);
    NewFolder target(folder);
    ImportReport report;
    const std::optional<Case> manifest = manifest_of(files);
    std::vector<ImportedPart> parts = parts_of(files, manifest, options, report.remarks, progress);
    std::vector<ImportedSeries> all_series = import_series(files.images, report.remarks, progress);
    if (parts.empty() && all_series.empty())
        throw Error("'" + clean_text(source.string(), 300) +
                    "' holds neither images nor surfaces that could be shown.");

    Case& result = report.manifest;
    const std::vector<std::string> words = telling_words(all_series);
    fs::path shown = folder;
    if (shown.filename().empty())
        shown = shown.parent_path();
    result.name = clean_text(!options.name.empty()                     ? options.name
                             : manifest                                ? manifest->name
                             : tells(shown.filename().string(), words) ? "case"
                                                                       : shown.filename().string(),
                             max_name_characters);
    result.license = options.license.empty() && manifest ? manifest->license : options.license;
    result.credit = options.credit.empty() && manifest ? manifest->credit : options.credit;
    const bool said = std::all_of(all_series.begin(), all_series.end(),
                                  [](const ImportedSeries& s) { return s.deidentified; });
    result.deidentified = options.deidentified.value_or(
        all_series.empty() ? manifest && manifest->deidentified : said);

    for (std::size_t i = 0; i < all_series.size(); ++i) {
        progress("Writing", double(i) / double(all_series.size() + parts.size()));
        ImportedSeries& one = all_series[i];
        one.series.file = "series_" + std::to_string(i + 1) + volume_extension;
        files::write_file(target.path() / one.series.file, medical::encode_volume(one.volume));
        result.series.push_back(one.series);
        one.volume.samples = {};
    }
    for (std::size_t i = 0; i < parts.size(); ++i) {
        medical::Part& part = parts[i].part;
        if (tells(part.name, words)) {
            part.name = std::string(medical::to_text(part.role)) + " " + std::to_string(i + 1);
            report.remarks.push_back("A part's name had the patient's in it and became '" +
                                     part.name + "'.");
        }
        part.file = "part_" + std::to_string(i + 1) + mesh_extension;
        files::write_file(target.path() / part.file, medical::encode_mesh(parts[i].mesh));
        result.parts.push_back(part);
    }
    write_identifiers(target.path(), all_series);
    files::write_file(target.path() / manifest_name, as_bytes(manifest_text(result)));
    progress("Writing", 1);
    target.keep();
    return report;
}

}  // namespace theatron::cases
