// SPDX-License-Identifier: Apache-2.0
#include "cases/import_case.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "base/error.h"
#include "base/outside_text.h"
#include "cases/case_folder.h"
#include "cases/import_parts.h"
#include "cases/new_folder.h"
#include "cases/patient_words.h"
#include "cases/quoted_path.h"
#include "files/file_bytes.h"
#include "files/private_file.h"
#include "medical/mesh_measures.h"
#include "medical/picture.h"

namespace theatron::cases {
namespace {

namespace fs = std::filesystem;
using medical::Case;

void write_identifiers(const fs::path& folder, const std::vector<ImportedSeries>& all_series) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    bool any = false;
    for (const ImportedSeries& series : all_series) {
        nlohmann::ordered_json one{{"file", series.series.file}};
        for (const Identifier& identifier : series.identifiers) {
            one.emplace(identifier.name, identifier.value);  // the first one of a name
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

// Throws Error if a label was named that no label map has.
void require_labels(const ImportOptions& options, const std::set<int>& found) {
    for (const LabelChoice& label : options.labels)
        if (!found.contains(label.value))
            throw Error("There is no label " + std::to_string(label.value) +
                        " in the source, though --label names it.");
}

std::string remark_on_label_maps(const std::vector<fs::path>& files) {
    const bool is_one = files.size() == 1;
    return "The source has surfaces, so " +
           (is_one ? quoted_path(files[0]) + " is" : std::to_string(files.size()) + " files are") +
           " not used" + (is_one ? "" : ": " + first_names(files)) +
           "; with --from-labels parts are made of " + (is_one ? "its" : "their") +
           " labels, and not of the surfaces.";
}

std::vector<ImportedPart> parts_of(const SourceFiles& files, const std::optional<Case>& manifest,
                                   const ImportOptions& options, LeftOut& left_out,
                                   std::set<fs::path>& beside, std::vector<std::string>& remarks,
                                   const Progress& progress) {
    const bool from_labels = options.surfaces_from_labels || files.meshes.empty();
    if (options.surfaces_from_labels && files.label_maps.empty())
        throw Error("The source holds no label map (NIfTI, NRRD) to make surfaces of.");
    if (!from_labels) {
        if (!files.label_maps.empty())
            remarks.push_back(remark_on_label_maps(files.label_maps));
        if (!options.labels.empty())
            throw Error(
                "--label names labels of a label map, which is not used here; give "
                "--from-labels, too.");
        return import_meshes(files.meshes, manifest, options, left_out, beside, remarks, progress);
    }
    std::vector<ImportedPart> parts;
    std::set<int> found;
    for (const fs::path& file : files.label_maps) {
        std::vector<ImportedPart> more =
            import_labels(file, options, found, left_out, remarks, progress);
        // A file for each organ, as TotalSegmentator writes them: its name is the organ's.
        if (more.size() == 1 && more[0].part.name.starts_with("label ") && options.labels.empty()) {
            std::string name = file.filename().string();
            name = name.substr(0, name.find('.'));
            more[0].part = usual_part(name);
        }
        std::move(more.begin(), more.end(), std::back_inserter(parts));
    }
    if (parts.size() > max_parts)
        throw Error("The source holds more than " + std::to_string(max_parts) + " labels.");
    require_labels(options, found);
    return parts;
}

// "Segment 4", "gastric impression of liver".
bool is_region(const medical::Part& part) {
    const std::string name = " " + part.name + " ";
    if (part.role != medical::Role::other)
        return false;
    for (const char* region : {"egment", "impression", "surface", " lobe ", " area "})
        if (name.find(region) != std::string::npos)
            return true;
    return false;
}

// Regions of an organ lie on its shell or fill it: opaque ones would hide all that is in it.
void make_regions_translucent(std::vector<ImportedPart>& parts) {
    constexpr double region_opacity = 0.15;
    const bool has_shell = std::any_of(parts.begin(), parts.end(), [](const ImportedPart& one) {
        return one.part.role == medical::Role::shell;
    });
    for (ImportedPart& one : parts)
        if (has_shell && is_region(one.part))
            one.part.opacity = std::min(one.part.opacity, region_opacity);
}

// Surfaces of another program or patient, or with a wrong unit or wrong axes.
void remark_on_places(const std::vector<ImportedPart>& parts,
                      const std::vector<ImportedSeries>& all_series,
                      std::vector<std::string>& remarks) {
    std::vector<fs::path> outside;  // their names
    for (const ImportedPart& one : parts) {
        const medical::Box box = medical::box_of(one.mesh);
        const auto is_there = [&](const ImportedSeries& series) {
            return medical::overlap(medical::box_of(series.volume.grid), box);
        };
        if (!all_series.empty() && std::none_of(all_series.begin(), all_series.end(), is_there))
            outside.emplace_back(one.part.name);
    }
    const std::string advice =
        " outside of all images; check the surfaces' axes (--axes) and unit (--unit)";
    if (outside.size() == 1)
        remarks.push_back("The part " + quoted_path(outside[0]) + " lies" + advice + ".");
    else if (!outside.empty())
        remarks.push_back(std::to_string(outside.size()) + " parts lie" + advice + ": " +
                          first_names(outside) + ".");
}

// `one` and `many`: the verb, as in "is too deep" and "are too deep".
void remark_on_unopened(const std::vector<fs::path>& paths, const char* one, const char* many,
                        std::vector<std::string>& remarks) {
    if (paths.size() == 1)
        remarks.push_back(quoted_path(paths[0]) + " " + one + ", so what it holds is left out.");
    else if (!paths.empty())
        remarks.push_back(std::to_string(paths.size()) + " files and folders " + many +
                          ", so what they hold is left out: " + first_names(paths) + ".");
}

// No file is left out without a word. `read`: those that were read with others.
void remark_on_others(const SourceFiles& files, std::set<fs::path> read,
                      std::vector<std::string>& remarks) {
    for (const fs::path& file : files.label_maps)
        if (const std::optional<fs::path> samples = sample_file_of(file))
            read.insert(*samples);
    std::vector<fs::path> unread;
    LeftOut known;
    for (const fs::path& file : files.others) {
        if (file.filename() == manifest_name || read.contains(file))
            continue;
        if (const char* const reason = reason_of_other_kind(file))
            known.add(file, reason);
        else
            unread.push_back(file);
    }
    known.append_to(remarks);
    remark_on_unopened(files.closed, "may not be opened by this user",
                       "may not be opened by this user", remarks);
    remark_on_unopened(files.too_deep, "lies too many folders deep", "lie too many folders deep",
                       remarks);
    if (files.links > 0)
        remarks.push_back("Links in the source are not followed, so what they lead to (" +
                          std::to_string(files.links) + ") is left out.");
    if (!unread.empty())
        remarks.push_back(
            std::to_string(unread.size()) + (unread.size() == 1 ? " file was" : " files were") +
            " not read, being of no kind that is imported: " + first_names(unread) + ".");
}

// Throws Error if a text that was given for everybody to see has the patient's name in it.
void require_silent(const ImportOptions& options, const PatientWords& words) {
    const auto require = [&](const std::string& text, const char* option) {
        if (words.occur_in(text))
            throw Error(std::string(option) +
                        " has a name or number of the patient in it, and everybody sees it; give "
                        "another text.");
    };
    require(options.name, "--name");
    require(options.license, "--license");
    require(options.credit, "--credit");
    for (const LabelChoice& label : options.labels)
        require(label.name, "--label");
}

}  // namespace

ImportReport import_case(const fs::path& source, const fs::path& folder,
                         const ImportOptions& options, const Progress& progress) {
    SourceFiles files = find_source_files(source);
    if (options.without_pictures)
        files.pictures.clear();
    NewFolder target(folder);
    ImportReport report;
    const std::optional<Case> manifest = manifest_of(files);
    LeftOut left_out;
    std::set<fs::path> beside;
    std::vector<ImportedPart> parts =
        parts_of(files, manifest, options, left_out, beside, report.remarks, progress);
    if (!manifest)
        make_regions_translucent(parts);
    std::set<Identifier> identifiers;
    std::vector<ImportedSeries> all_series =
        import_series(files.images, identifiers, left_out, report.remarks, progress);
    std::vector<ImportedPicture> pictures =
        import_pictures(files.pictures, manifest, left_out, report.remarks, progress);
    left_out.append_to(report.remarks);
    if (parts.empty() && all_series.empty() && pictures.empty())
        throw Error(quoted_path(source) +
                    " holds neither images nor surfaces nor pictures that could be shown." +
                    (report.remarks.empty() ? "" : " " + report.remarks.front()));

    Case& result = report.manifest;
    PatientWords words;
    for (const Identifier& identifier : identifiers)
        words.add(identifier);
    require_silent(options, words);
    fs::path shown = folder;
    if (shown.filename().empty())
        shown = shown.parent_path();
    result.name = clean_text(!options.name.empty() ? options.name
                             : manifest            ? manifest->name
                                                   : shown.filename().string(),
                             max_name_characters);
    result.license = options.license.empty() && manifest ? manifest->license : options.license;
    result.credit = options.credit.empty() && manifest ? manifest->credit : options.credit;
    const auto take_out = [&](std::string& text, const char* what, const char* instead) {
        if (!words.occur_in(text))
            return;
        text = instead;
        report.remarks.push_back(
            std::string("The ") + what + " had the patient's name in it" +
            (text.empty() ? " and is left out." : " and became '" + text + "'."));
    };
    take_out(result.name, "case's name", "case");
    take_out(result.license, "licence", "");
    take_out(result.credit, "credit", "");
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
        if (words.occur_in(part.name)) {
            part.name = std::string(medical::to_text(part.role)) + " " + std::to_string(i + 1);
            report.remarks.push_back("A part's name had the patient's in it and became '" +
                                     part.name + "'.");
        }
        part.file = "part_" + std::to_string(i + 1) + mesh_extension;
        files::write_file(target.path() / part.file, medical::encode_mesh(parts[i].mesh));
        result.parts.push_back(part);
    }
    remark_on_places(parts, all_series, report.remarks);
    for (std::size_t i = 0; i < pictures.size(); ++i) {
        medical::CasePicture& picture = pictures[i].picture;
        if (words.occur_in(picture.name)) {
            picture.name = "picture " + std::to_string(i + 1);
            report.remarks.push_back("A picture's name had the patient's in it and became '" +
                                     picture.name + "'.");
        }
        picture.file = "picture_" + std::to_string(i + 1) + picture_extension;
        files::write_file(target.path() / picture.file,
                          medical::encode_picture(pictures[i].image.view()));
        result.pictures.push_back(picture);
    }
    write_identifiers(target.path(), all_series);
    files::write_file(target.path() / manifest_name, as_bytes(manifest_text(result)));
    progress("Writing", 1);
    remark_on_others(files, std::move(beside), report.remarks);
    target.keep();
    return report;
}

}  // namespace theatron::cases
