// SPDX-License-Identifier: Apache-2.0
#include "compare_measure.h"

#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "compare_shown.h"
#include "compare_ways.h"
#include "this_machine.h"

namespace theatron::bench {
namespace {

// The share of a method's time that passes before anything is drawn.
constexpr double before_drawing = 0.7;

template <class T>
void drop_oldest(std::vector<T>& images, std::size_t kept) {
    if (images.size() > kept)
        images.erase(images.begin());
}

// All pictures of one camera from the room to the expert.
ArrivedCamera sent_and_received(const CompareWay& way, const CompareCamera& camera,
                                std::vector<PictureCost>& costs,
                                const std::function<void(double)>& progress) {
    const std::unique_ptr<CameraPath> path = way.path(camera);
    ArrivedCamera arrived{.calibration = camera.calibration};
    for (std::size_t i = 0; i < camera.color.size(); ++i) {
        PictureCost& cost = costs.emplace_back();
        cost.sender_ms = processor_ms_of([&] { cost.bytes = path->send(camera, i); });
        cost.receiver_ms = processor_ms_of([&] { path->receive(arrived); });
        drop_oldest(arrived.depth, way.kept);
        drop_oldest(arrived.color, way.kept);
        progress(double(i + 1) / double(camera.color.size()));
    }
    path->finish(arrived, costs);
    return arrived;
}

void show(CompareMethod& method, const CompareWay& way, const std::vector<ArrivedCamera>& arrived,
          const CompareDrawing& drawing, Vec3 wound, const std::function<void(double)>& progress) {
    using Shown = CompareWay::Shown;
    if (way.shown == Shown::clouds)
        drawing.show_clouds(method, *way.views, way.cameras, arrived, way.renderer, progress);
    else if (way.shown == Shown::points)
        show_points(method, *way.views, way.cameras, arrived);
    else
        show_video(method, way.cameras, arrived, wound, way.shown == Shown::zoomed_video);
}

CompareMethod measured(const CompareWay& way, const CompareDrawing& drawing, Vec3 wound,
                       const std::vector<CompareLink>& links,
                       const std::function<void(double)>& progress) {
    CompareMethod method = way.words;
    if (!method.is_measured())
        return method;
    std::vector<std::vector<PictureCost>> costs(way.cameras.size());
    std::vector<ArrivedCamera> arrived;
    for (std::size_t c = 0; c < way.cameras.size(); ++c)
        arrived.push_back(sent_and_received(way, *way.cameras[c], costs[c], [&](double done) {
            progress(before_drawing * (double(c) + done) / double(way.cameras.size()));
        }));
    if (const std::string& library = arrived.front().library; !library.empty())
        method.ran += " (" + library + ")";
    add_costs(method, costs, links);
    if (way.arrives_as_taken)
        method.own_view =
            own_view_of(way.cameras.front()->last_exact, arrived.front().color.back());
    show(method, way, arrived, drawing, wound,
         [&](double done) { progress(before_drawing + (1 - before_drawing) * done); });
    return method;
}

}  // namespace

Compared measure_compare(const CompareOptions& options, const capture::Progress& progress) {
    Compared out;
    out.processor = processor_name();
    out.cores = int(std::thread::hardware_concurrency());
    out.cameras = options.scene.cameras;
    out.frames = options.scene.frames;
    out.picture = options.scene.picture;
    out.links = options.links;
    out.cores_of_others = cores_of_others();
    const CompareScene scene = make_compare_scene(options.scene, progress);
    out.depth = scene.cameras.front().calibration.depth.size;
    out.color = scene.cameras.front().color.front().size;
    out.places = scene.place_names;
    for (const ViewBenchPlace& place : scene.without_near.places)
        out.truth.push_back(place.exact_color);
    out.close_up_truth = scene.without_near.close_up.exact_color;
    out.close_up_width_m = close_up_width_m;
    const CompareDrawing drawing;
    out.gl_renderer = drawing.driver();
    for (const CompareWay& way : compare_ways(scene)) {
        const std::string step = "measuring: " + way.words.name;
        const auto tell = [&](double done) { progress(step, done); };
        tell(0);
        out.methods.push_back(measured(way, drawing, scene.wound, options.links, tell));
        tell(1);
    }
    drawing.check();
    return out;
}

}  // namespace theatron::bench
