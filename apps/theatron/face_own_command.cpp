// SPDX-License-Identifier: Apache-2.0
// theatron face model, photos, enrol, landmarks, show and delete: their options
#include <memory>

#include "cli/choice_check.h"
#include "commands.h"
#include "enrol/photo_guide.h"
#include "face/face_fit.h"
#include "face_command.h"
#include "picture_options.h"

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

void add_window_options(CLI::App& command, FaceWindow& window) {
    command.add_flag("--mark", window.mark,
                     "Mark the landmarks in a window, or look over those that were found");
    command
        .add_option("--landmark-model", window.landmark_model,
                    "The model of dlib that finds landmarks (a shape_predictor of 68 points)")
        ->capture_default_str();
    add_language_option(command, window.language);
    command.add_option("--size", window.size, "Size of the window")->capture_default_str();
}

void add_enrol(CLI::App& face) {
    const auto wanted = std::make_shared<FaceEnrol>();
    CLI::App* command =
        face.add_subcommand("enrol", "Make a face of your own from one photo to six");
    command->footer(
        "Take photos from the front, upright, in even light; or let a window take them with "
        "--camera. The 68\nlandmarks of each face (as iBUG, 300-W, marks them) are found where "
        "Debian's package libdlib-data\nis installed, whose model excludes commercial use, or are "
        "marked with --mark, or come in a .pts file.\nAn emotion without a photo gets the neutral "
        "one's skin. The face is sealed with a passphrase and\nstays on this machine. 'theatron "
        "face delete' removes it.\n"
        "\nExamples:\n"
        "  theatron face enrol --camera /dev/video0 --out me.face\n"
        "  theatron face enrol --photo me.jpg --happiness smile.jpg --mark --out me.face\n"
        "  theatron face enrol --photo me.jpg --landmarks me.pts --happiness smile.jpg \\\n"
        "    --happiness-landmarks smile.pts --eye-distance-mm 61.5 --out me.face");
    CLI::Option* neutral = nullptr;
    for (const face::Emotion emotion : enrol::photo_order) {
        const bool is_neutral = emotion == face::Emotion::neutral;
        const std::string name(to_text(emotion));
        const std::string photo = is_neutral ? "--photo" : "--" + name;
        auto& files = wanted->photos[std::size_t(emotion)];
        CLI::Option* picture =
            command->add_option(photo, files.picture,
                                is_neutral ? std::string("Your face at rest, as JPEG or PNG")
                                           : "A photo of your " + name);
        CLI::Option* landmarks =
            command->add_option(is_neutral ? std::string("--landmarks") : photo + "-landmarks",
                                files.landmarks, "Its landmarks, as .pts");
        landmarks->needs(picture);
        if (is_neutral)
            neutral = picture;
        else
            picture->needs(neutral);
    }
    CLI::Option* camera = command->add_option(
        "--camera", wanted->camera,
        "Takes the photos in a window, one emotion after the other: /dev/video0, or a video file");
    camera->excludes(neutral);
    add_window_options(*command, wanted->window);
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
    command->callback([wanted] {
        if (wanted->camera.empty() &&
            wanted->photos[std::size_t(face::Emotion::neutral)].picture.empty())
            throw CLI::RequiredError("--camera or --photo");
        run_face_enrol(*wanted);
    });
}

void add_landmarks(CLI::App& face) {
    const auto wanted = std::make_shared<FaceLandmarks>();
    CLI::App* command =
        face.add_subcommand("landmarks", "Find or mark the 68 landmarks of a face in a photo");
    command->footer(
        "They are written as a .pts file, which only you may read.\n"
        "\nExamples:\n"
        "  theatron face landmarks me.jpg --out me.pts\n"
        "  theatron face landmarks smile.jpg --emotion happiness --mark --out smile.pts");
    command->add_option("photo", wanted->photo, "A photo of one face, as JPEG or PNG")->required();
    command->add_option("--out", wanted->out, "The .pts file to write")->required();
    command
        ->add_option("--emotion", wanted->emotion,
                     "What the face shows: a guess of the landmarks begins with it")
        ->capture_default_str()
        ->check(cli::one_of({face::emotion_names.begin(), face::emotion_names.end()}));
    add_window_options(*command, wanted->window);
    command->add_flag("--overwrite", wanted->overwrite, "Replace a file that is there");
    command->callback([wanted] { run_face_landmarks(*wanted); });
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
    add_landmarks(face);
    add_show(face);
    add_delete(face);
}

}  // namespace theatron::app
