// SPDX-License-Identifier: Apache-2.0
#include "compare_measure.h"

#include <exception>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <thread>
#include <utility>
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

using CameraCosts = std::vector<std::vector<PictureCost>>;

// Calls work(0) to work(count - 1), each on a thread of its own.
template <class Work>
void at_once(std::size_t count, const Work& work) {
    std::vector<std::exception_ptr> failures(count);
    std::vector<std::jthread> threads;
    for (std::size_t i = 0; i < count; ++i)
        threads.emplace_back([&, i] {
            try {
                work(i);
            } catch (...) {
                failures[i] = std::current_exception();
            }
        });
    threads.clear();
    for (const std::exception_ptr& failure : failures)
        if (failure)
            std::rethrow_exception(failure);
}

// The pictures of all cameras, which work side by side; `alone`: their costs when each way ran by
// itself.
CameraCosts sent_at_once(const CompareWay& way, const CameraCosts& alone,
                         const std::function<void(double)>& progress) {
    const std::size_t cameras = way.cameras.size(), pictures = way.cameras.front()->color.size();
    std::vector<std::unique_ptr<CameraPath>> paths;
    for (const CompareCamera* camera : way.cameras)
        paths.push_back(way.path(*camera));
    std::vector<ArrivedCamera> arrived(cameras);
    CameraCosts costs(cameras, std::vector<PictureCost>(pictures));
    std::vector<PictureCost> moments(pictures);
    for (std::size_t i = 0; i < pictures; ++i) {
        moments[i].sender_ms = processor_ms_of([&] {
            at_once(cameras,
                    [&](std::size_t c) { costs[c][i].bytes = paths[c]->send(*way.cameras[c], i); });
        });
        moments[i].receiver_ms = processor_ms_of(
            [&] { at_once(cameras, [&](std::size_t c) { paths[c]->receive(arrived[c]); }); });
        for (ArrivedCamera& camera : arrived) {
            drop_oldest(camera.depth, way.kept);
            drop_oldest(camera.color, way.kept);
        }
        progress(double(i + 1) / double(pictures));
    }
    share_out(costs, moments, alone);
    return costs;
}

// Measures way after way. The scene, the drawing and the ways live longer than it.
class Measuring {
public:
    Measuring(const CompareScene& scene, const CompareDrawing& drawing,
              const std::vector<CompareLink>& links)
        : scene_(scene), drawing_(drawing), links_(links) {}

    CompareMethod measured(const CompareWay& way, const std::function<void(double)>& progress) {
        CompareMethod method = way.words;
        if (method.is_measured() && way.parts.empty())
            measure_one(method, way, progress);
        else if (method.is_measured())
            measure_pair(method, way, progress);
        measured_[method.id] = method;
        return method;
    }

private:
    void measure_one(CompareMethod& method, const CompareWay& way,
                     const std::function<void(double)>& progress) {
        CameraCosts& costs = costs_[method.id];
        costs.resize(way.cameras.size());
        std::vector<ArrivedCamera> arrived;
        for (std::size_t c = 0; c < way.cameras.size(); ++c)
            arrived.push_back(sent_and_received(way, *way.cameras[c], costs[c], [&](double done) {
                progress(before_drawing * (double(c) + done) / double(way.cameras.size()));
            }));
        if (const std::string& library = arrived.front().library; !library.empty())
            method.ran += " (" + library + ")";
        add_costs(method, costs, links_);
        if (way.arrives_as_taken)
            method.own_view =
                own_view_of(way.cameras.front()->last_exact, arrived.front().color.back());
        show(method, way, arrived,
             [&](double done) { progress(before_drawing + (1 - before_drawing) * done); });
    }

    void show(CompareMethod& method, const CompareWay& way,
              const std::vector<ArrivedCamera>& arrived,
              const std::function<void(double)>& progress) const {
        using Shown = CompareWay::Shown;
        const CompareViews& views = *way.views;
        Image<float> details =
            finest_details({views.close_up.view, views.close_up.exact_mm.view()},
                           sight_cameras(way.cameras, arrived, !way.arrives_as_taken));
        if (way.shown == Shown::clouds) {
            drawing_.show_clouds(method, views, way.cameras, arrived, std::move(details),
                                 way.renderer, progress);
        } else if (way.shown == Shown::points) {
            show_points(method, views, way.cameras, arrived, std::move(details));
        } else {
            show_video(method, way.cameras, arrived, scene_.wound,
                       way.shown == Shown::zoomed_video);
            judge_video(method, views, std::move(details));
            drawing_.time_video(method, arrived, views.close_up.exact_mm.size);
        }
    }

    void measure_pair(CompareMethod& method, const CompareWay& way,
                      const std::function<void(double)>& progress) {
        const CompareMethod &one = measured_.at(way.parts[0]), &other = measured_.at(way.parts[1]);
        CameraCosts alone = costs_.at(one.id);
        const CameraCosts& rest = costs_.at(other.id);
        alone.insert(alone.end(), rest.begin(), rest.end());
        add_costs(method, sent_at_once(way, alone, progress), links_);
        if (one.sights && other.sights)
            judge_pair(method, *way.views, one, other);
        if (one.drawn_on.empty() || other.drawn_on.empty())
            return;
        method.drawing_ms = one.drawing_ms + other.drawing_ms;
        method.drawn_on = one.drawn_on;
    }

    const CompareScene& scene_;
    const CompareDrawing& drawing_;
    const std::vector<CompareLink>& links_;
    std::map<std::string, CompareMethod> measured_;
    std::map<std::string, CameraCosts> costs_;
};

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
    out.near_wound = scene.without_near.near_wound;
    out.near_wound_m = near_wound_m;
    const CompareDrawing drawing;
    out.gl_renderer = drawing.driver();
    Measuring measuring(scene, drawing, options.links);
    for (const CompareWay& way : compare_ways(scene)) {
        const std::string step = "measuring: " + way.words.name;
        const auto tell = [&](double done) { progress(step, done); };
        tell(0);
        out.methods.push_back(measuring.measured(way, tell));
        tell(1);
    }
    drawing.check();
    return out;
}

}  // namespace theatron::bench
