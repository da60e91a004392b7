// SPDX-License-Identifier: Apache-2.0
#include "bench_face.h"

#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/statistics.h"
#include "base/steady_clock.h"
#include "bench_report.h"
#include "cli/progress.h"
#include "face/expression.h"
#include "face/fit_figures.h"
#include "face/sent_face.h"
#include "face/synthetic_faces.h"
#include "face/training.h"
#include "files/file_bytes.h"
#include "render/gl_driver.h"
#include "render/offscreen_context_native.h"
#include "render/room_picture.h"
#include "room/people.h"
#include "this_machine.h"

namespace theatron::bench {
namespace {

constexpr double missing_share = 0.2;
// Those of training have seeds from the seed of its parameters on.
constexpr std::uint64_t held_out_seed = 1'000'001;

struct FaceFlags {
    std::string model, json;
    int persons = 40;
};

face::MorphModel model_of(const std::string& file) {
    if (file.empty())
        return face::generated_head();
    const Result<face::MorphModel> model = face::parse_model(files::read_file(file));
    if (!model)
        throw Error("'" + file + "' is no face model: it is " +
                    std::string(to_text(model.error())) + ".");
    return *model;
}

nlohmann::json fit_json(const face::FitFigures& f) {
    return {{"mean_error_mm", f.mean_error_mm},
            {"mean_face_error_mm", f.mean_face_error_mm},
            {"shape_error_mm", f.shape_error_mm},
            {"eyes_known_error_mm", f.eyes_known_error_mm},
            {"mean_face_shape_error_mm", f.mean_face_shape_error_mm},
            {"pose_deg", f.pose_degrees},
            {"worst_pose_deg", f.worst_pose_degrees},
            {"residual_px", f.residual_px},
            {"refused", f.refused}};
}

// The median time of a call, over calls that take about a second.
double median_ms(const std::function<void()>& call) {
    std::vector<double> times;
    const TimePoint begin = steady_now();
    while (times.size() < 50 || steady_now() - begin < std::chrono::seconds(1)) {
        const TimePoint from = steady_now();
        call();
        times.push_back(to_ms(steady_now() - from));
    }
    return theatron::median(times);
}

nlohmann::json times_json(const face::MorphModel& model, const face::Network& network) {
    // The actor's smile, and the most that a face can move.
    face::Channels all;
    all.fill(0.5F);
    const face::Channels smile = face::actor_channels(1.5);
    const face::Features features{};
    const face::ChannelMask present = network.mask;
    const face::DrawnPerson person = face::drawn_person(model, 1, 0);
    std::vector<float> vertices(model.neutral.size());
    float sum = 0;
    const double infer = median_ms([&] { sum += face::evaluate(network, features, present)[0]; });
    const auto blend = [&](const face::Channels& channels) {
        return median_ms([&] {
            face::blend_shape(model, person.identity, channels, vertices);
            sum += vertices[0];
        });
    };
    const double one = blend(smile), most = blend(all);
    // Keeps the calls from being left out by the compiler.
    if (sum == -1)
        std::puts("");
    return {{"infer", infer}, {"blend", one}, {"blend_all_channels", most}};
}

// A person's own face as a session has it: with six different pictures of the skin.
std::shared_ptr<const room::OwnHead> own_head_of(const face::MorphModel& model) {
    room::OwnHead::Textures textures;
    for (std::size_t i = 0; i < textures.size(); ++i) {
        textures[i] = ColorImage(Size{face::max_sent_texture_side, face::max_sent_texture_side});
        for (std::size_t k = 0; k < textures[i].pixels.size(); ++k)
            textures[i].pixels[k] = {std::uint8_t(120 + 20 * i), std::uint8_t(90 + k % 16),
                                     std::uint8_t(80 + k / 512 % 16)};
    }
    face::EnrolledFace person = face::without_shoulders(face::enrolled_person(model, {}));
    return std::make_shared<const room::OwnHead>(face::thinned(person, 6000), std::move(textures));
}

// A picture of 640x480 pixels in which one head takes the middle third: of a bust whose face shows
// something else each time, of the person's own face, which does so, too, and of the usual bust.
// With the wait for the driver, and reading back.
nlohmann::json draw_json(const face::MorphModel& model) {
    constexpr Size size{640, 480};
    const render::OffscreenContext context;
    render::ScenePasses passes;
    room::People people;
    room::RoomPerson person;
    person.id = ParticipantId{1};
    person.has_headset = true;
    person.head = look_at({0, 1.6, 0}, {0, 1.6, 3}, {0, 1, 0}) * Pose{Quat{0, 1, 0, 0}, {}};
    const auto view = render::view_towards({0, 1.6, 0.9}, {0, 1.58, 0}, 40, size);
    const auto draw = [&] {
        render::SceneFrame frame;
        frame.quality = render::usual_quality();
        people.add_to(frame, {person}, view);
        (void)render::draw_and_read(&frame, {}, {view}, size, &passes);
    };
    const double bust = median_ms(draw);
    float jaw = 0;
    const double with_face = median_ms([&] {
        jaw = jaw < 0.5F ? jaw + 0.01F : 0;
        face::Emotions smile{};
        smile[std::size_t(face::Emotion::happiness)] = 1;
        person.expression = face::blend_expressions(smile, {jaw, 0, 0});
        draw();
    });
    person.own_head = own_head_of(model);
    float smile = 0;
    const auto draw_own = [&](float step) {
        jaw = jaw < 0.5F ? jaw + 0.01F : 0;
        smile = smile < 0.9F ? smile + step : 0;
        person.shown_face = {};
        person.shown_face.direct.jaw_open = jaw;
        person.shown_face.emotions[std::size_t(face::Emotion::happiness)] = smile;
        person.shown_face.emotions[std::size_t(face::Emotion::neutral)] = 1 - smile;
        draw();
    };
    const double with_own = median_ms([&] { draw_own(0); });
    const double with_other_skin = median_ms([&] { draw_own(0.1F); });
    const room::OwnHead& own = *person.own_head;
    const double own_meshes = median_ms([&] { (void)own.meshes(person.shown_face); });
    ColorImage skin;
    face::Emotions half{};
    half[std::size_t(face::Emotion::happiness)] = half[std::size_t(face::Emotion::neutral)] = 0.5F;
    const double own_skin = median_ms([&] { own.blend(own.shares(half), skin); });
    person.own_head = nullptr;
    const room::FaceShape shape;
    const double meshes = median_ms([&] { (void)shape.meshes(*person.expression); });
    return {{"driver", render::driver_name()},
            {"meshes", meshes},
            {"draw", with_face},
            {"own_meshes", own_meshes},
            {"own_skin", own_skin},
            {"draw_own_face", with_own},
            {"draw_own_face_new_skin", with_other_skin},
            {"draw_usual_bust", bust}};
}

nlohmann::json measure_face(const FaceFlags& flags) {
    require_outputs({flags.json});
    const capture::Progress progress = cli::show_progress();
    const face::MorphModel model = model_of(flags.model);
    progress("fitting faces", 0);
    nlohmann::json result = {{"processor", processor_name()},
                             {"persons", flags.persons},
                             {"model", flags.model.empty() ? "generated" : flags.model},
                             {"vertices", model.vertex_count()},
                             {"synthetic", true},
                             {"chance", 1.0 / double(face::emotion_count)},
                             {"fit", fit_json(face::fit_figures(model, flags.persons, 1))}};
    const std::pair<face::Source, const char*> sources[] = {
        {face::Source::xr_fb_face2, "training for XR_FB"},
        {face::Source::xr_htc, "training for HTC"}};
    std::optional<face::Network> network;
    for (const auto& [source, what] : sources) {
        network = face::train_synthetic(
            source, {}, [&progress, what = what](double done) { progress(what, done); });
        const face::Recording others =
            face::synthetic_recording(source, flags.persons, held_out_seed);
        const std::string name(face::source_name(source));
        result["accuracy"][name] = face::confusion_of(*network, others).accuracy();
        const double missing = face::confusion_of(*network, others, missing_share).accuracy();
        if (source == face::Source::xr_fb_face2)
            result["accuracy"]["missing_20"] = missing;
        else
            result["accuracy"][name + "_missing_20"] = missing;
    }
    result["ms"] = times_json(model, *network);
    progress("drawing", 0);
    result["ms"].update(draw_json(model));
    return result;
}

void print_face(const nlohmann::json& r) {
    const auto& fit = r["fit"];
    const auto& accuracy = r["accuracy"];
    const auto number = [](const nlohmann::json& value) { return value.get<double>(); };
    std::printf("%s\n%d synthetic persons, a model of %d vertices: no measure of real faces\n",
                r["processor"].get<std::string>().c_str(), r["persons"].get<int>(),
                r["vertices"].get<int>());
    std::printf(
        "\na face from one frontal photo, landmarks off by 2 px\n"
        "  surface %.2f mm from the person's (the mean face %.2f), at one size %.2f (%.2f),\n"
        "  %.2f where the distance of the eyes is known to 1 mm\n"
        "  pose %.2f degrees off, the worst %.2f; landmarks %.1f px; %d refused\n",
        number(fit["mean_error_mm"]), number(fit["mean_face_error_mm"]),
        number(fit["shape_error_mm"]), number(fit["mean_face_shape_error_mm"]),
        number(fit["eyes_known_error_mm"]), number(fit["pose_deg"]), number(fit["worst_pose_deg"]),
        number(fit["residual_px"]), fit["refused"].get<int>());
    std::printf(
        "\nsix emotions, windows told right (chance %.0f %%)\n"
        "  XR_FB %.1f %%, with a fifth of the channels missing %.1f %%\n"
        "  HTC   %.1f %%, with a fifth of the channels missing %.1f %%\n",
        100 * number(r["chance"]), 100 * number(accuracy["xr_fb"]),
        100 * number(accuracy["missing_20"]), 100 * number(accuracy["xr_htc"]),
        100 * number(accuracy["xr_htc_missing_20"]));
    std::printf(
        "\none core: network %.3f ms, shape of the head %.3f ms (all channels moved: %.3f)\n",
        number(r["ms"]["infer"]), number(r["ms"]["blend"]), number(r["ms"]["blend_all_channels"]));
    std::printf(
        "meshes of the drawn face %.3f ms; a picture with it %.2f ms, with the usual bust %.2f ms\n"
        "a person's own face: meshes %.3f ms, the skin of another emotion %.3f ms; a picture with\n"
        "it %.2f ms, and %.2f ms where the skin changes, too\n"
        "(640x480, %s)\n",
        number(r["ms"]["meshes"]), number(r["ms"]["draw"]), number(r["ms"]["draw_usual_bust"]),
        number(r["ms"]["own_meshes"]), number(r["ms"]["own_skin"]),
        number(r["ms"]["draw_own_face"]), number(r["ms"]["draw_own_face_new_skin"]),
        r["ms"]["driver"].get<std::string>().c_str());
}

}  // namespace

void add_face_bench(CLI::App& bench) {
    const auto flags = std::make_shared<FaceFlags>();
    CLI::App* command =
        bench.add_subcommand("face", "The face under the headset: fit, emotions, times");
    command->footer(
        "The persons are made up, so that the truth is known; no figure is one of real faces.\n"
        "Example: theatron bench face\n"
        "Example: theatron bench face --model head.theatron-face --json face.json");
    command->add_option("--model", flags->model, "A face model; the generated head without it");
    command->add_option("--persons", flags->persons, "Made-up persons")
        ->capture_default_str()
        ->check(CLI::Range(2, 1000));
    add_json_option(*command, flags->json);
    command->callback([flags] {
        const nlohmann::json result = measure_face(*flags);
        report(result, flags->json, [&] { print_face(result); });
    });
}

}  // namespace theatron::bench
