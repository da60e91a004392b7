// SPDX-License-Identifier: Apache-2.0
// theatron face model, photos, enrol, show and delete: their options
#include <memory>

#include "commands.h"
#include "face/face_fit.h"
#include "face_command.h"

namespace theatron::app {
namespace {

constexpr const char* passphrase_file_help =
    "A file with the passphrase in its first line, which only you may read (default: asked for)";

void add_model_commands(CLI::App& face) {
    CLI::App* model = face.add_subcommand("model", "Morphable heads, to which photos are fitted");
    model->require_subcommand(1);
    const auto imported = std::make_shared<FaceModelImport>();
    CLI::App* command = model->add_subcommand("import", "Convert the files of ICT-FaceKit Light");
    command->footer(
        "ICT-FaceKit Light is a model of faces by the University of Southern California, under the "
        "MIT licence.\nTheatron does not contain it; docs/face.md says what the folder has to "
        "hold.\n"
        "\nExample:\n"
        "  theatron face model import ict-facekit-light --out ict.head");
    command->add_option("folder", imported->folder, "The folder of its files")->required();
    command->add_option("--out", imported->out, "The model's file, some 50 MB")->required();
    command->add_flag("--overwrite", imported->overwrite, "Replace a file that is there");
    command->callback([imported] { run_face_model_import(*imported); });

    const auto shown = std::make_shared<FaceModelShow>();
    command = model->add_subcommand("show", "Draw a model's mean person with the six emotions");
    command->footer(
        "Example:\n"
        "  theatron face model show ict.head --out heads.png");
    command->add_option("model", shown->model, "The model (default: the generated head)");
    command->add_option("--out", shown->out, "The picture to write, as PNG")->required();
    command->callback([shown] { run_face_model_show(*shown); });
}

void add_photos(CLI::App& face) {
    const auto wanted = std::make_shared<FacePhotos>();
    CLI::App* command = face.add_subcommand(
        "photos", "Draw six photos of a person who does not exist, to try 'face enrol'");
    command->footer(
        "Each photo has its landmarks beside it, as EMOTION.pts.\n"
        "\nExample:\n"
        "  theatron face photos nobody");
    command->add_option("folder", wanted->folder, "The folder to write into; it is made")
        ->required();
    command->add_option("--seed", wanted->seed, "Which person")->capture_default_str();
    command->add_option("--model", wanted->model,
                        "Of 'theatron face model import' (default: the generated head)");
    command
        ->add_option("--noise-px", wanted->noise_px,
                     "Deviation of the landmarks each way, in pixels")
        ->capture_default_str()
        ->check(CLI::Range(0.0, 20.0));
    command->callback([wanted] { run_face_photos(*wanted); });
}

void add_enrol(CLI::App& face) {
    const auto wanted = std::make_shared<FaceEnrol>();
    CLI::App* command =
        face.add_subcommand("enrol", "Make a face of your own from one photo to six");
    command->footer(
        "Each photo needs the 68 landmarks of its face in a .pts file, as iBUG (300-W) marks them. "
        "Take photos\nfrom the front, upright, in even light. An emotion without a photo gets the "
        "neutral one's skin.\nThe face is sealed with a passphrase and stays on this machine. "
        "'theatron face delete' removes it.\n"
        "\nExamples:\n"
        "  theatron face enrol --photo me.jpg --landmarks me.pts --out me.face\n"
        "  theatron face enrol --photo me.jpg --landmarks me.pts --happiness smile.jpg \\\n"
        "    --happiness-landmarks smile.pts --eye-distance-mm 61.5 --out me.face");
    for (std::size_t i = 0; i < face::emotion_count; ++i) {
        const bool is_neutral = face::Emotion(i) == face::Emotion::neutral;
        const std::string name(face::emotion_names[i]);
        const std::string photo = is_neutral ? "--photo" : "--" + name;
        auto& files = wanted->photos[i];
        CLI::Option* picture =
            command->add_option(photo, files.picture,
                                is_neutral ? std::string("Your face at rest, as JPEG or PNG")
                                           : "A photo of your " + name);
        CLI::Option* landmarks =
            command->add_option(is_neutral ? std::string("--landmarks") : photo + "-landmarks",
                                files.landmarks, "Its landmarks, as .pts");
        picture->needs(landmarks);
        landmarks->needs(picture);
        if (is_neutral)
            picture->required();
    }
    command->add_option("--model", wanted->model,
                        "Of 'theatron face model import' (default: the generated head)");
    command
        ->add_option("--eye-distance-mm", wanted->eyes_apart_mm,
                     "How far apart your pupils are, as your headset or optician says: photos "
                     "alone do not tell how large your head is")
        ->check(CLI::Range(face::least_eye_distance_mm, face::most_eye_distance_mm));
    command
        ->add_option("--view-degrees", wanted->view_degrees,
                     "The angle that the camera saw along the longer side of the photo")
        ->capture_default_str()
        ->check(CLI::Range(5.0, 120.0));
    command->add_option("--out", wanted->out, "Your face's file, which only you may read")
        ->required();
    command->add_option("--passphrase-file", wanted->passphrase_file, passphrase_file_help);
    command->add_flag("--overwrite", wanted->overwrite, "Replace a file that is there");
    command->add_flag("--json", wanted->json, "Print the figures as one JSON line");
    command->callback([wanted] { run_face_enrol(*wanted); });
}

void add_show(CLI::App& face) {
    const auto wanted = std::make_shared<FaceShow>();
    CLI::App* command = face.add_subcommand("show", "Draw your own face with the six emotions");
    command->footer(
        "Example:\n"
        "  theatron face show me.face --out faces.png");
    command->add_option("face", wanted->face, "Your face, of 'theatron face enrol'")->required();
    command->add_option("--out", wanted->out, "The picture to write, as PNG")->required();
    command->add_option("--passphrase-file", wanted->passphrase_file, passphrase_file_help);
    command->callback([wanted] { run_face_show(*wanted); });
}

void add_delete(CLI::App& face) {
    const auto file = std::make_shared<std::string>();
    CLI::App* command = face.add_subcommand("delete", "Delete your own face");
    command->footer(
        "Example:\n"
        "  theatron face delete me.face");
    command->add_option("face", *file, "Your face, of 'theatron face enrol'")->required();
    command->callback([file] { run_face_delete(*file); });
}

}  // namespace

void add_own_face_commands(CLI::App& face) {
    add_model_commands(face);
    add_photos(face);
    add_enrol(face);
    add_show(face);
    add_delete(face);
}

}  // namespace theatron::app
