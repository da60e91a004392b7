// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include "base/error.h"
#include "cases/foreign_files.h"
#include "cases/import_parts.h"
#include "cases/left_out.h"
#include "cases/manifest.h"
#include "cases/quoted_path.h"
#include "cases/same_patient.h"
#include "cases/series_builder.h"
#include "cases/series_parts.h"

namespace theatron::cases {
namespace {

namespace fs = std::filesystem;

std::string modality_of(const DicomSlice& slice) {
    for (const char* known : {"CT", "MR", "PT", "US"})
        if (slice.modality == known)
            return known;
    return "OT";
}

struct Slices {
    fs::path first;       // file
    std::string problem;  // a sentence on the first image that cannot be shown as its file means it
    std::vector<DicomSlice> slices;
};
using SlicesOfSeries = std::map<std::string, Slices>;

// A folder of one patient has fewer.
constexpr std::size_t max_texts_of_patients = 100'000;

void add_identifiers(const fs::path& file, const std::vector<Identifier>& of_file,
                     std::set<Identifier>& identifiers) {
    identifiers.insert(of_file.begin(), of_file.end());
    if (identifiers.size() > max_texts_of_patients)
        throw Error("The DICOM files hold more than " + std::to_string(max_texts_of_patients) +
                    " texts about patients, from " + quoted_path(file) +
                    " on; import the images of one patient.");
}

// `first` and `first_file`: the first image of all, to which the others are compared.
void require_one_patient(const fs::path& file, const DicomSlice& slice,
                         std::optional<DicomSlice>& first, fs::path& first_file) {
    if (first && !may_be_one_patient(first->identifiers, slice.identifiers))
        throw Error("The images are of more than one patient: " + quoted_path(first_file) +
                    " is of another one than " + quoted_path(file) +
                    "; import those of each patient by themselves.");
    if (first)
        return;
    first = slice;
    first->samples.clear();
    first_file = file;
}

SlicesOfSeries read_slices(const std::vector<fs::path>& files, std::set<Identifier>& identifiers,
                           LeftOut& left_out, const Progress& progress) {
    SlicesOfSeries series;
    std::optional<DicomSlice> first;  // without its samples
    fs::path first_file;
    DicomFiles reader;
    std::size_t samples = 0;
    for (std::size_t i = 0; i < files.size(); ++i) {
        progress("Reading images", double(i) / double(files.size()));
        std::vector<DicomSlice> slices;
        try {
            slices = reader.read(files[i]);
        } catch (const NotForUs& error) {
            add_identifiers(files[i], reader.identifiers(), identifiers);
            left_out.add(files[i], error.reason());
            continue;
        }
        add_identifiers(files[i], reader.identifiers(), identifiers);
        require_one_patient(files[i], slices.front(), first, first_file);
        Slices& same = series[slices.front().series_uid];
        if (same.slices.empty() && same.problem.empty())
            same.first = files[i];
        for (DicomSlice& slice : slices) {
            samples += slice.samples.size();
            if (samples > medical::max_volume_samples)
                throw Error("The source holds more images than are read at once, from " +
                            quoted_path(files[i]) + " on; import one series.");
            if (!slice.problem.empty() && same.problem.empty())
                same.problem = quoted_path(files[i]) + " " + slice.problem + ".";
            else if (slice.problem.empty())
                same.slices.push_back(std::move(slice));
        }
    }
    progress("Reading images", 1);
    return series;
}

// Programs that take the patient's name out may give each image a series of its own. At least three
// such images of one kind that lie in one row, evenly, are a series.
void join_single_images(SlicesOfSeries& all, std::vector<std::string>& remarks) {
    std::vector<std::vector<Slices*>> groups;
    for (auto& [uid, read] : all) {
        if (read.slices.size() != 1 || !read.problem.empty() || !read.slices[0].has_place)
            continue;
        const DicomSlice& slice = read.slices[0];
        auto group = std::find_if(groups.begin(), groups.end(), [&](const auto& one) {
            const DicomSlice& first = one[0]->slices[0];
            return first.modality == slice.modality && place_difference(first, slice).empty();
        });
        if (group == groups.end())
            group = groups.insert(groups.end(), std::vector<Slices*>());
        group->push_back(&read);
    }
    for (const std::vector<Slices*>& group : groups) {
        if (group.size() < 3)
            continue;
        std::vector<DicomSlice> slices;
        for (const Slices* one : group)
            slices.push_back(one->slices[0]);
        std::vector<DicomSlice> tried = slices;
        const BuiltSeries built = build_series(tried);
        if (!built.problem.empty() || built.repeated > 0 || !built.missing_slices.empty())
            continue;
        for (Slices* one : group)
            one->slices.clear();
        group[0]->slices = std::move(slices);
        remarks.push_back(std::to_string(group.size()) +
                          " images that name a series of their own each lie in one row, and are "
                          "taken for one series. The first is " +
                          quoted_path(group[0]->first) + ".");
    }
    std::erase_if(all, [](const auto& one) {
        return one.second.slices.empty() && one.second.problem.empty();
    });
}

// Adds the volume of one part of a series to `imported`, or a sentence to `problems`.
void add_volume(std::vector<DicomSlice> slices, const std::string& begins,
                std::map<std::string, int>& count, std::vector<ImportedSeries>& imported,
                std::vector<std::string>& problems, std::vector<std::string>& remarks) {
    ImportedSeries one;
    one.series.modality = modality_of(slices.front());
    one.identifiers = slices.front().identifiers;
    one.frame_uid = slices.front().frame_uid;
    one.deidentified = std::all_of(slices.begin(), slices.end(),
                                   [](const DicomSlice& slice) { return slice.deidentified; });
    BuiltSeries built = build_series(slices);
    if (!built.problem.empty()) {
        problems.push_back(built.problem + begins);
        return;
    }
    if (!built.missing_slices.empty())
        remarks.push_back("The series lacks " + std::to_string(built.missing_slices.size()) +
                          " of " + std::to_string(built.volume.grid.slices) +
                          " slices, which stay empty." + begins);
    if (built.repeated > 0)
        remarks.push_back(std::to_string(built.repeated) +
                          (built.repeated == 1 ? " image is" : " images are") +
                          " in the series twice and taken once." + begins);
    const bool has_window = std::any_of(slices.begin(), slices.end(),
                                        [](const DicomSlice& slice) { return slice.has_window; });
    if (!has_window && std::any_of(slices.begin(), slices.end(),
                                   [](const DicomSlice& slice) { return slice.has_wrong_window; }))
        remarks.push_back(
            "The window of its images cannot be used, and is made of their values instead." +
            begins);
    const int number = ++count[one.series.modality];
    one.series.name = one.series.modality + (number > 1 ? " " + std::to_string(number) : "");
    one.series.missing_slices = std::move(built.missing_slices);
    one.volume = std::move(built.volume);
    imported.push_back(std::move(one));
}

}  // namespace

std::vector<ImportedSeries> import_series(const std::vector<fs::path>& files,
                                          std::set<Identifier>& identifiers, LeftOut& left_out,
                                          std::vector<std::string>& remarks,
                                          const Progress& progress) {
    std::vector<ImportedSeries> imported;
    std::vector<std::string> problems;
    std::map<std::string, int> count;
    SlicesOfSeries all = read_slices(files, identifiers, left_out, progress);
    join_single_images(all, remarks);
    for (auto& [uid, read] : all) {
        const std::string begins = " The series begins with " + quoted_path(read.first) + ".";
        if (!read.problem.empty()) {
            problems.push_back(read.problem);
            continue;
        }
        SeriesParts split = split_series(std::move(read.slices));
        if (!split.problem.empty())
            problems.push_back(split.problem + begins);
        for (const std::string& remark : split.remarks)
            remarks.push_back(remark + begins);
        for (std::vector<DicomSlice>& part : split.parts)
            add_volume(std::move(part), begins, count, imported, problems, remarks);
    }
    if (imported.empty() && !problems.empty())
        throw Error(problems.front());
    for (const std::string& problem : problems)
        remarks.push_back("A series is left out: " + problem);
    // The one with the most slices is shown first.
    std::stable_sort(imported.begin(), imported.end(),
                     [](const ImportedSeries& a, const ImportedSeries& b) {
                         return a.volume.grid.slices > b.volume.grid.slices;
                     });
    for (const ImportedSeries& one : imported)
        if (one.frame_uid != imported.front().frame_uid)
            remarks.push_back(
                "The series " + one.series.name + " has another frame of reference than " +
                imported.front().series.name + ": their places in the patient may not agree.");
    if (imported.size() > max_series) {
        remarks.push_back("Only the " + std::to_string(max_series) + " longest of " +
                          std::to_string(imported.size()) + " series are taken.");
        imported.resize(max_series);
    }
    return imported;
}

}  // namespace theatron::cases
