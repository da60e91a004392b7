// SPDX-License-Identifier: Apache-2.0
// theatron case
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <utility>

#include "base/error.h"
#include "base/outside_text.h"
#include "cases/case_folder.h"
#include "cases/case_pictures.h"
#include "cases/import_case.h"
#include "cases/new_folder.h"
#include "cases/synth_case.h"
#include "cli/choice_check.h"
#include "cli/progress.h"
#include "cli/stop_signal.h"
#include "commands.h"
#include "files/png_file.h"
#include "medical/mesh_measures.h"

namespace theatron::app {
namespace {

// From Ctrl-C until nothing of a patient is left in a half-made folder.
constexpr Duration folder_patience = std::chrono::seconds(30);

void check(const std::string& folder) {
    const cases::CheckReport report = cases::check_case(folder);
    for (const std::string& problem : report.problems)
        std::printf("problem: %s\n", problem.c_str());
    for (const std::string& remark : report.remarks)
        std::printf("remark: %s\n", remark.c_str());
    if (!report.problems.empty())
        throw CLI::RuntimeError(1);
    std::printf("The case can be shown.\n");
}

void add_check(CLI::App& group) {
    const auto folder = std::make_shared<std::string>();
    CLI::App* command = group.add_subcommand("check", "Says what is wrong with a case.");
    command->add_option("FOLDER", *folder, "The case's folder")->required();
    command->callback([folder] { check(*folder); });
}

// As in "1=liver" or "2=portal vein:portal_vein".
cases::LabelChoice label_choice(const std::string& text) {
    const std::size_t equals = text.find('='), colon = text.rfind(':');
    cases::LabelChoice choice;
    choice.value = std::atoi(text.c_str());
    if (equals == std::string::npos || choice.value < 1 || choice.value > 65535)
        throw Error("'" + text +
                    "' names no label; write --label 1=liver or --label 1=liver:shell.");
    const bool has_role = colon != std::string::npos && colon > equals;
    choice.name = text.substr(equals + 1, has_role ? colon - equals - 1 : std::string::npos);
    if (choice.name.find_first_not_of(' ') == std::string::npos)
        throw Error("'" + text + "' gives the label no name; write --label 1=liver.");
    choice.role = medical::role_of_name(choice.name);
    if (has_role) {
        const std::optional<medical::Role> role = medical::role_from_text(text.substr(colon + 1));
        if (!role)
            throw Error("'" + text.substr(colon + 1) +
                        "' is no role; there are shell, artery, portal_vein, hepatic_vein, tumour "
                        "and other.");
        choice.role = *role;
    }
    return choice;
}

struct ImportArguments {
    std::string source, folder;
    cases::ImportOptions options;
    std::string unit, axes;
    std::vector<std::string> labels;
    bool deidentified = false;
};

cases::ImportReport import_until_stopped(const ImportArguments& arguments) {
    try {
        return cases::import_case(arguments.source, arguments.folder, arguments.options,
                                  cli::show_progress());
    } catch (const Error&) {
        // Ctrl-C in a terminal also ends the process that reads a file, which is not the file's
        // fault.
        if (cli::stop_requested())
            throw Error("Stopped before the case was complete; nothing of it was kept.");
        throw;
    }
}

void import(ImportArguments& arguments) {
    cases::ImportOptions& options = arguments.options;
    if (!arguments.unit.empty())
        options.unit = arguments.unit == "mm"   ? medical::Unit::mm
                       : arguments.unit == "cm" ? medical::Unit::cm
                                                : medical::Unit::m;
    if (!arguments.axes.empty())
        options.axes = arguments.axes == "lps"   ? medical::Axes::lps
                       : arguments.axes == "ras" ? medical::Axes::ras
                                                 : medical::Axes::y_up;
    for (const std::string& label : arguments.labels)
        options.labels.push_back(label_choice(label));
    if (arguments.deidentified)
        options.deidentified = true;
    // A signal that ended the program at once would leave a part of the patient's data behind.
    cli::catch_stop_signals();
    const cli::Saving saving(folder_patience);
    const cases::ImportReport report = import_until_stopped(arguments);
    for (const std::string& remark : report.remarks)
        std::printf("remark: %s\n", remark.c_str());
    std::printf("name: %s\n", report.manifest.name.c_str());
    for (const medical::Series& series : report.manifest.series)
        std::printf("series: %s\n", series.name.c_str());
    for (const medical::Part& part : report.manifest.parts)
        std::printf("part: %s (%s)\n", part.name.c_str(),
                    std::string(medical::to_text(part.role)).c_str());
    for (const medical::CasePicture& picture : report.manifest.pictures)
        std::printf("picture: %s\n", picture.name.c_str());
    std::printf(
        "The case lies in '%s'. Everybody in a session sees the names above: none may be "
        "the patient's.\n",
        clean_text(arguments.folder, 300).c_str());
}

void add_import(CLI::App& group) {
    const auto arguments = std::make_shared<ImportArguments>();
    cases::ImportOptions& options = arguments->options;
    CLI::App* command = group.add_subcommand(
        "import",
        "Makes a case of DICOM images, surfaces (STL, OBJ, PLY, glTF), label maps "
        "(NIfTI, NRRD) and pictures (PNG, JPEG).");
    command->footer("Example: theatron case import patient-17 cases/patient-17 --name \"Case 17\"");
    command->add_option("SOURCE", arguments->source, "The folder, or one file")->required();
    command->add_option("CASE", arguments->folder, "The case's folder, which is made")->required();
    command->add_option("--name", options.name, "The case's name; usually that of its folder");
    command->add_option("--license", options.license, "The licence of the data");
    command->add_option("--credit", options.credit, "Whom the data is by");
    command->add_flag("--deidentified", arguments->deidentified,
                      "What names the patient was taken out before");
    command->add_flag("--without-pictures", options.without_pictures,
                      "Leave out PNG and JPEG pictures");
    command
        ->add_option("--unit", arguments->unit,
                     "Unit of surfaces: mm, cm or m; usually m in glTF, else mm")
        ->check(cli::one_of({"mm", "cm", "m"}));
    command
        ->add_option("--axes", arguments->axes,
                     "Axes of surfaces: lps, ras or y_up; usually y_up in glTF, else lps or what "
                     "the file says")
        ->check(cli::one_of({"lps", "ras", "y_up"}));
    command
        ->add_option("--max-triangles", options.max_triangles,
                     "Surfaces with more triangles are simplified")
        ->check(CLI::Range(100, 5'000'000))
        ->capture_default_str();
    command->add_flag("--from-labels", options.surfaces_from_labels,
                      "Surfaces out of the label map, also where the source has surfaces");
    command->add_option("--label", arguments->labels,
                        "Name and role of a label, as in 2=portal vein:portal_vein");
    command->callback([arguments] { import(*arguments); });
}

constexpr std::pair<const char*, cases::PartsView> views[] = {
    {"corner", cases::PartsView::corner}, {"front", cases::PartsView::front},
    {"back", cases::PartsView::back},     {"left", cases::PartsView::left},
    {"right", cases::PartsView::right},   {"above", cases::PartsView::above},
    {"below", cases::PartsView::below}};

struct ShowArguments {
    std::string folder, png, plane = "parts", window;
    cases::PartsView from = cases::PartsView::corner;
    double at_mm = std::nan("");
    int series = 1, picture = 0;
};

// A preset's name, or centre and width as in 40,400.
medical::Window window_of(const std::string& text) {
    std::string names;
    for (const medical::WindowPreset& preset : medical::window_presets()) {
        if (text == preset.name)
            return preset.window;
        names += std::string(preset.name) + ", ";
    }
    medical::Window window;
    int end = 0;
    if (std::sscanf(text.c_str(), "%lf,%lf%n", &window.center, &window.width, &end) != 2 ||
        end != int(text.size()) || !(window.width > 0 && window.width <= 1e9) ||
        !(std::abs(window.center) <= 1e9))
        throw Error("'" + text + "' is no window; there are " + names +
                    "or centre and width as in 40,400.");
    return window;
}

void show(const ShowArguments& arguments) {
    const cases::LoadedCase loaded = cases::read_case(arguments.folder);
    if (arguments.picture != 0) {
        if (std::size_t(arguments.picture) > loaded.pictures.size())
            throw Error("The case has " + std::to_string(loaded.pictures.size()) +
                        " pictures, so there is no picture " + std::to_string(arguments.picture) +
                        ".");
        files::write_png(arguments.png, loaded.pictures[std::size_t(arguments.picture - 1)].view());
        return;
    }
    if (arguments.plane == "parts") {
        files::write_png(arguments.png,
                         cases::picture_of_parts(loaded, {1000, 800}, arguments.from).view());
        return;
    }
    const auto series = std::size_t(arguments.series - 1);
    if (series >= loaded.volumes.size())
        throw Error("The case has " + std::to_string(loaded.volumes.size()) +
                    " series of images, so there is no series " + std::to_string(arguments.series) +
                    ".");
    const medical::Volume& volume = loaded.volumes[series];
    const medical::Orientation orientation =
        arguments.plane == "axial"     ? medical::Orientation::axial
        : arguments.plane == "coronal" ? medical::Orientation::coronal
                                       : medical::Orientation::sagittal;
    const medical::SliceRange range = medical::slice_range(volume.grid, orientation);
    const double middle = range.first_mm + range.step_mm * std::floor((range.count - 1) / 2.0);
    const medical::SlicePlane plane = medical::slice_plane(
        volume.grid, orientation, std::isnan(arguments.at_mm) ? middle : arguments.at_mm);
    const medical::Window window =
        arguments.window.empty() ? volume.window : window_of(arguments.window);
    files::write_png(arguments.png, cases::picture_of_slice(loaded, series, plane, window).view());
    std::printf("%s slices from %.1f to %.1f mm, %.2f mm apart; %.3f mm a pixel\n",
                arguments.plane.c_str(), range.first_mm, range.last_mm, range.step_mm,
                plane.mm_per_pixel);
}

void add_show(CLI::App& group) {
    const auto arguments = std::make_shared<ShowArguments>();
    CLI::App* command = group.add_subcommand("show", "Writes a picture of a case.");
    command->add_option("CASE", arguments->folder, "The case's folder")->required();
    command->add_option("--png", arguments->png, "The picture's file")->required();
    command
        ->add_option("--plane", arguments->plane, "The parts, or a slice: axial, coronal, sagittal")
        ->check(cli::one_of({"parts", "axial", "coronal", "sagittal"}))
        ->capture_default_str();
    command
        ->add_option_function<std::string>(
            "--from",
            [arguments](const std::string& text) {
                for (const auto& [name, view] : views)
                    if (text == name)
                        arguments->from = view;
            },
            "The side from which the parts are seen: corner, front, back, left, right, above, "
            "below")
        ->check(cli::one_of({"corner", "front", "back", "left", "right", "above", "below"}))
        ->default_str("corner");
    command->add_option("--at", arguments->at_mm,
                        "Place of the slice: z, y or x in millimetres; usually the middle");
    command->add_option("--window", arguments->window,
                        "abdomen, liver, vessels, lung, bone, brain, or centre and width as in "
                        "40,400; usually that of the images");
    command->add_option("--series", arguments->series, "Number of the series, from 1")
        ->capture_default_str();
    command->add_option("--picture", arguments->picture, "Number of a picture instead, from 1")
        ->check(CLI::Range(1, 64));
    command->callback([arguments] { show(*arguments); });
}

struct SynthArguments {
    std::string folder, dicom;
    cases::SynthOptions options;
};

void synth(const SynthArguments& arguments) {
    cases::require_new_folder(arguments.folder);
    if (!arguments.dicom.empty()) {
        cases::require_new_folder(arguments.dicom);
        const auto in_case =
            std::filesystem::weakly_canonical(arguments.dicom)
                .lexically_relative(std::filesystem::weakly_canonical(arguments.folder));
        if (!in_case.empty() && *in_case.begin() != "..")
            throw Error("--dicom names a folder in the case; name one beside it.");
    }
    cli::catch_stop_signals();
    const cli::Saving saving(folder_patience);
    const cases::Progress progress = cli::show_progress();
    const cases::SynthCase made = cases::make_synth_case(arguments.options, progress);
    cases::write_synth_case(made, arguments.folder, arguments.dicom, progress);
    for (std::size_t i = 0; i < made.meshes.size(); ++i)
        std::printf("part: %s, %.1f ml\n", made.manifest.parts[i].name.c_str(),
                    medical::shape_of(made.meshes[i]).volume_mm3 * 1e-3);
    std::printf("The generated case lies in '%s'%s%s%s.\n",
                clean_text(arguments.folder, 300).c_str(),
                arguments.dicom.empty() ? "" : ", its CT as DICOM files in '",
                clean_text(arguments.dicom, 300).c_str(), arguments.dicom.empty() ? "" : "'");
}

void add_synth(CLI::App& group) {
    const auto arguments = std::make_shared<SynthArguments>();
    CLI::App* command = group.add_subcommand(
        "synth", "Generates a case: a liver with segments, vessels and tumours, and its CT.");
    command->add_option("CASE", arguments->folder, "The case's folder, which is made")->required();
    command->add_option("--seed", arguments->options.seed, "Equal seeds give equal cases")
        ->capture_default_str();
    command->add_option("--dicom", arguments->dicom,
                        "A further folder, which is made, for the CT as DICOM files");
    command->callback([arguments] { synth(*arguments); });
}

}  // namespace

void add_case_command(CLI::App& app) {
    CLI::App* group = app.add_subcommand(
        "case", "The patient's organs and images that a session shows, as folders.");
    group->require_subcommand(1);
    add_check(*group);
    add_import(*group);
    add_show(*group);
    add_synth(*group);
}

}  // namespace theatron::app
