// SPDX-License-Identifier: Apache-2.0
// theatron face train and theatron face test
#include <filesystem>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/output.h"
#include "cli/progress.h"
#include "face/synthetic_faces.h"
#include "face/training.h"
#include "face_command.h"
#include "files/file_bytes.h"
#include "files/json_text.h"
#include "files/private_file.h"

namespace theatron::app {
namespace {

constexpr int held_out_persons = 40;
constexpr double missing_share = 0.2;

nlohmann::json confusion_json(const face::Confusion& confusion) {
    return {{"accuracy", confusion.accuracy()},
            {"windows", confusion.total()},
            {"confusion", confusion.counts}};
}

std::string percent(double share) {
    return std::to_string(int(share * 100 + 0.5)) + " %";
}

// Takes of several files as those of one user.
face::Recording own_takes(const std::vector<std::string>& files, face::Source source) {
    face::Recording own;
    own.source = source;
    for (const std::string& file : files) {
        const face::Recording one = visit::read_face_recording(file);
        if (one.source != source)
            throw Error("'" + file + "' is of the tracker " +
                        std::string(face::source_name(one.source)) + ", and the network is for " +
                        std::string(face::source_name(source)) + "; give --source " +
                        std::string(face::source_name(one.source)) + ".");
        own.takes.insert(own.takes.end(), one.takes.begin(), one.takes.end());
    }
    if (const auto problem = face::problem_of_own(own); !problem.empty())
        throw Error("The takes are of no use: " + problem + ".");
    return own;
}

face::Progress progress_of(const char* what) {
    return
        [show = cli::show_progress(), what = std::string(what)](double done) { show(what, done); };
}

void require_absent(const std::string& file, bool overwrite) {
    if (std::error_code ignored; !overwrite && std::filesystem::exists(file, ignored))
        throw Error("'" + file + "' exists already; name another file, or give --overwrite.");
}

}  // namespace

void run_face_train(const FaceTrain& wanted) {
    const face::Source source = visit::face_source(wanted.source);
    require_absent(wanted.out, wanted.overwrite);
    files::require_writable(wanted.out);
    face::Recording own;
    if (!wanted.own.empty())
        own = own_takes(wanted.own, source);

    face::TrainingParams params;
    params.seed = wanted.seed;
    face::Network network = face::train_synthetic(source, params, progress_of("training"));
    nlohmann::json figures = {{"source", face::source_name(source)},
                              {"synthetic_only", wanted.own.empty()},
                              {"chance", 1.0 / double(face::emotion_count)},
                              {"emotions", face::emotion_names}};
    std::string text;
    if (!wanted.own.empty()) {
        const face::Confusion left_out =
            face::leave_one_take_out(network, own, params, progress_of("leaving out each take"));
        network = face::train_own(network, own, params);
        figures["own"] = confusion_json(left_out);
        figures["own"]["takes"] = own.takes.size();
        text += "Your " + std::to_string(own.takes.size()) +
                " takes, each told by a network that learned from the others: " +
                percent(left_out.accuracy()) + " right\n" + face::to_text(left_out) + "\n";
    }
    // Persons whose seeds no training uses.
    const face::Recording others =
        face::synthetic_recording(source, held_out_persons, wanted.seed + 1'000'000);
    const face::Confusion held_out = face::confusion_of(network, others);
    const face::Confusion missing = face::confusion_of(network, others, missing_share);
    figures["synthetic"] = confusion_json(held_out);
    figures["synthetic_missing_20"] = confusion_json(missing);
    const Bytes bytes = face::network_bytes(network);
    files::write_private_file(
        wanted.out, std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
    if (wanted.json)
        return output::result(files::json_text(figures) + "\n");
    text += std::to_string(held_out_persons) +
            " synthetic persons that it has not seen (synthetic: no measure of real faces): " +
            percent(held_out.accuracy()) + " right, " + percent(missing.accuracy()) +
            " with a fifth of the channels missing; chance is 17 %\n" + face::to_text(held_out);
    output::result(text + "\n" + wanted.out + ": written\n");
}

void run_face_test(const FaceTest& wanted) {
    const face::Network network = visit::read_face_network(wanted.model);
    face::Confusion all;
    std::size_t left_out_rows = 0;
    bool is_synthetic = false;
    for (const std::string& file : wanted.recordings) {
        const face::Recording recording = visit::read_face_recording(file);
        const face::Confusion one = face::confusion_of(network, recording);
        for (std::size_t i = 0; i < face::emotion_count; ++i)
            for (std::size_t k = 0; k < face::emotion_count; ++k)
                all.counts[i][k] += one.counts[i][k];
        left_out_rows += recording.left_out_rows;
        is_synthetic = is_synthetic || recording.is_synthetic;
    }
    if (all.total() == 0)
        throw Error("The recordings have no take of 0.8 s or more; nothing could be told.");
    if (wanted.json) {
        nlohmann::json figures = confusion_json(all);
        figures["source"] = face::source_name(network.source);
        figures["synthetic_only"] = network.is_synthetic_only;
        figures["synthetic_recording"] = is_synthetic;
        figures["left_out_rows"] = left_out_rows;
        figures["chance"] = 1.0 / double(face::emotion_count);
        return output::result(files::json_text(figures) + "\n");
    }
    std::string text = percent(all.accuracy()) + " of " + std::to_string(all.total()) +
                       " windows right; chance is 17 %" +
                       (is_synthetic ? " (synthetic: no measure of real faces)\n" : "\n") +
                       face::to_text(all);
    if (left_out_rows > 0)
        text += std::to_string(left_out_rows) + " rows of other emotions were left out\n";
    output::result(text);
}

}  // namespace theatron::app
