// SPDX-License-Identifier: Apache-2.0
#include "bench_view_scene.h"

#include <atomic>
#include <cmath>
#include <thread>

#include "base/error.h"
#include "codec/depth_codec.h"
#include "codec/rows.h"
#include "filter/chain.h"
#include "filter/color_registration.h"
#include "geometry/ray_table.h"
#include "synthetic/operating_room.h"
#include "synthetic/sensor_model.h"
#include "video/color_codec.h"

namespace theatron::bench {
namespace {

using synthetic::GroundTruth;
using synthetic::Material;
using synthetic::OperatingRoom;

constexpr Vec3 situs{0, 1.15, 0.05};
constexpr double field_of_view = 70;  // degrees, horizontal

bool is_person(Material material) {
    switch (material) {
        case Material::gown:
        case Material::cap:
        case Material::mask:
        case Material::glove:
        case Material::skin:
        case Material::eye:
        case Material::hair:
        case Material::scrubs:
            return true;
        default:
            return false;
    }
}

bool is_patterned(Material material) {
    return material == Material::paper || material == Material::screen ||
           material == Material::brick;
}

Vec3 on_circle(double degrees, double radius, double height) {
    const double a = radians_of(degrees);
    return {radius * std::cos(a), height, radius * std::sin(a)};
}

// Viewpoints between cameras: the first four cameras are at -42, 46, 137 and -132 degrees.
std::vector<ViewBenchEye> held_places() {
    std::vector<ViewBenchEye> eyes;
    for (const double degrees : {2.0, 91.0, 182.0, -87.0})
        eyes.push_back({on_circle(degrees, 1.8, 1.95), situs, field_of_view});
    for (const double degrees : {-42.0, 46.0, 137.0, -132.0}) {
        eyes.push_back({on_circle(degrees + 14, 1.45, 1.8), situs, field_of_view});
        eyes.push_back({on_circle(degrees - 14, 1.75, 2.3), situs, field_of_view});
    }
    return eyes;
}

// Viewpoints near the papers on the table, so that a pixel of the picture is smaller than one of
// the cameras'.
std::vector<ViewBenchEye> close_places() {
    std::vector<ViewBenchEye> eyes;
    for (const double degrees : {-35.0, -10.0, 15.0, 40.0})
        eyes.push_back({on_circle(degrees, 1.3, 1.9), {0.35, 0.98, 0.0}, 26});
    return eyes;
}

// Calls work(0) to work(count - 1), two at a time: exact pictures are slow, and nothing is timed.
template <class Work>
void for_each_of(std::size_t count, const Work& work) {
    std::atomic<std::size_t> next{0};
    const auto run = [&] {
        for (std::size_t i = next++; i < count; i = next++)
            work(i);
    };
    std::thread other(run);
    run();
    other.join();
}

// Frames that the filters process before the first one that counts, as in a running host.
constexpr unsigned settling_frames = 20, first_settling_frame = 1000;

// Depth and colour of the sensors, passed through the filters and the default codecs.
class SensorAndCodecs {
public:
    SensorAndCodecs(const ViewBenchOptions& options, const Calibration& calibration, unsigned seed)
        : options_(options),
          seed_(seed),
          depth_(synthetic::nfov_unbinned(), calibration.depth.size, seed),
          filters_(options.filter,
                   {.size = calibration.depth.size, .depth_unit_mm = calibration.depth_unit_mm}),
          rays_(make_ray_table(calibration.depth)) {}

    // Frames must come in order.
    DepthImage depth(const GroundTruth& truth, unsigned frame) {
        if (!settled_ && !filters_.off())
            for (unsigned before = 0; before < settling_frames; ++before)
                filtered(measured(truth, first_settling_frame + before));
        settled_ = true;
        return transported(filtered(measured(truth, frame)));
    }

    ColorImage color(const GroundTruth& truth, unsigned frame) const {
        synthetic::ColorSensorParams params;
        params.white_balance *= float(options_.exposure_stops) / params.exposure_stops;
        params.exposure_stops = float(options_.exposure_stops);
        ColorData data;
        data.size = truth.color.size;
        data.pixels.resize(data.size);
        synthetic::apply_color_sensor(params, seed_, frame, truth.color.view(), data.pixels.view());
        const auto encoder =
            video::make_color_encoder(video::parse_color_setting("jpeg:quality=85").setting);
        const auto decoder = video::make_color_decoder(video::ColorCodecId::jpeg);
        const auto encoded = encoder->encode(data, true);
        if (!encoded || decoder->submit(encoded->bytes, FrameNumber{}) != Status::ok)
            throw Error("A picture of the generated room could not be compressed.");
        return std::move(decoder->poll().value().image);
    }

private:
    DepthImage measured(const GroundTruth& truth, unsigned frame) {
        const Size size = truth.depth_m.size;
        Image<float> cosine(size), reflectivity(size), specular(size);
        for (std::size_t i = 0; i < rays_.pixels.size(); ++i) {
            const synthetic::SurfaceSample& s = truth.surface.pixels[i];
            const Ray r = rays_.pixels[i];
            const float along = -(s.nx * r.x + s.ny * r.y + s.nz);
            cosine.pixels[i] = std::max(along / std::sqrt(r.x * r.x + r.y * r.y + 1), 0.0f);
            reflectivity.pixels[i] = s.infrared;
            specular.pixels[i] = s.specular;
        }
        DepthImage depth(size);
        depth_.capture({truth.depth_m.view(), reflectivity.view(), cosine.view(), specular.view()},
                       frame, depth.view());
        return depth;
    }

    DepthImage filtered(const DepthImage& depth) {
        return copy_of(filters_.apply(depth.view(), std::chrono::microseconds(33333)));
    }

    static DepthImage transported(const DepthImage& depth) {
        const auto codec = codec::make_depth_codec(codec::parse_depth_setting("strata").setting);
        Bytes bytes(codec->max_encoded_size(depth.size));
        bytes.resize(codec->encode(depth.view(), nullptr, bytes, nullptr));
        DepthImage arrived(depth.size);
        if (codec->decode(bytes, nullptr, arrived.view(), nullptr) != Status::ok)
            throw Error("Depth of the generated room could not be decoded.");
        return arrived;
    }

    const ViewBenchOptions& options_;
    unsigned seed_;
    synthetic::DepthSensor depth_;
    filter::Chain filters_;
    bool settled_ = false;
    Image<Ray> rays_;
};

ViewBenchCamera make_camera(const OperatingRoom& room, const synthetic::RoomMoment& moment,
                            const ViewBenchOptions& options, int index) {
    ViewBenchCamera camera;
    camera.calibration = synthetic::synthetic_camera(synthetic::Variant::room, index,
                                                     options.cameras, options.color);
    GroundTruth truth = room.look_from(camera.calibration, {true, true, true})->render(moment);
    SensorAndCodecs chain(options, camera.calibration, 1009 + unsigned(index));
    for (unsigned frame = 0; frame < ViewBenchCamera::frames; ++frame) {
        camera.depth[frame] = chain.depth(truth, frame);
        camera.color[frame] = chain.color(truth, frame);
    }
    const Calibration fine = synthetic::synthetic_camera(synthetic::Variant::room, index,
                                                         options.cameras, options.fine_color);
    const GroundTruth fine_truth = room.look_from(fine, {.depth = false})->render(moment);
    camera.fine_color = chain.color(fine_truth, ViewBenchCamera::frames - 1);
    camera.fine_model = fine.color;
    camera.exact_depth_m = std::move(truth.depth_m);
    camera.exact_color = std::move(truth.color);
    return camera;
}

// A surface seen at a smaller angle counts as not seen: 0.17 is the sine of 10 degrees.
constexpr double least_cosine = 0.17;

enum class Sight { none, seen, measured };

// Tells if the depth camera sees this side of a surface, and has measured it there.
Sight sight_of(const ViewBenchCamera& camera, Vec3 point_room, Vec3 normal_room) {
    const Calibration& c = camera.calibration;
    const Vec3 p = inverse(c.room_from_camera) * point_room;
    const Vec3 normal = rotate(conjugate(c.room_from_camera.rotation), normal_room);
    const auto pixel = project(c.depth, p);
    if (!pixel || dot(normal, p) > -least_cosine * length(p))
        return Sight::none;
    const int x0 = int(std::floor(pixel->x)), y0 = int(std::floor(pixel->y));
    const Size size = c.depth.size;
    if (x0 < 0 || y0 < 0 || x0 + 1 >= size.width || y0 + 1 >= size.height ||
        !synthetic::inside_hexagon(size, x0, y0))
        return Sight::none;
    bool seen = false;
    int measured = 0;
    for (int i = 0; i < 4; ++i) {
        const int x = x0 + i % 2, y = y0 + i / 2;
        const double z = camera.exact_depth_m.view().row(y)[x];
        const double z_measured =
            camera.depth[ViewBenchCamera::frames - 1].view().row(y)[x] / 1000.0;
        seen = seen || std::abs(z - p.z) < 0.01 + 0.005 * p.z;
        measured += std::abs(z_measured - p.z) < 0.03 + 0.01 * p.z;
    }
    return !seen ? Sight::none : measured >= 2 ? Sight::measured : Sight::seen;
}

}  // namespace

ViewBenchPlace make_view_bench_place(const OperatingRoom& room, const synthetic::RoomMoment& moment,
                                     const std::vector<ViewBenchCamera>& cameras,
                                     const ViewBenchEye& eye, Size picture) {
    const Calibration exact = synthetic::free_viewpoint(eye.from, eye.to, picture, eye.fov_degrees);
    GroundTruth truth = room.look_from(exact, {true, true, true})->render(moment);
    ViewBenchPlace place;
    place.view = render::view_of_camera(exact.depth, exact.room_from_camera, picture);
    place.exact_color = std::move(truth.color);
    place.exact_mm.resize(picture);
    for (auto* mask :
         {&place.seen, &place.overlap, &place.person, &place.patterned, &place.instrument})
        mask->resize(picture);
    for (int y = 0; y < picture.height; ++y)
        for (int x = 0; x < picture.width; ++x) {
            const double z = truth.depth_m.view().row(y)[x];
            const auto ray = unproject(exact.depth, {double(x), double(y)});
            if (z <= 0 || !ray)
                continue;
            const Vec3 point = exact.room_from_camera * Vec3{ray->x * z, ray->y * z, z};
            const synthetic::SurfaceSample& surface = truth.surface.view().row(y)[x];
            const Vec3 normal =
                rotate(exact.room_from_camera.rotation, {surface.nx, surface.ny, surface.nz});
            int seen_by = 0, measured_by = 0;
            for (const ViewBenchCamera& camera : cameras) {
                const Sight sight = sight_of(camera, point, normal);
                seen_by += sight != Sight::none;
                measured_by += sight == Sight::measured;
            }
            place.exact_mm.view().row(y)[x] = std::uint16_t(std::lround(z * 1000));
            place.seen.view().row(y)[x] = seen_by >= 1;
            place.overlap.view().row(y)[x] = measured_by >= 2;
            place.person.view().row(y)[x] = seen_by >= 1 && is_person(surface.material);
            place.instrument.view().row(y)[x] = surface.material == Material::polished;
            place.patterned.view().row(y)[x] = measured_by >= 1 && is_patterned(surface.material);
        }
    return place;
}

ViewBenchScene make_view_bench_scene(const ViewBenchOptions& options,
                                     const capture::Progress& progress) {
    if (options.cameras < 1 || options.cameras > synthetic::max_viewpoints)
        throw Error("The view benchmark has 1 to 12 cameras.");
    synthetic::SceneOptions scene_options;
    scene_options.detail = options.detail;
    const OperatingRoom room(scene_options);
    const auto moment = room.at(seconds_to_duration(options.seconds));

    const std::vector<ViewBenchEye> held = held_places(), close = close_places();
    ViewBenchScene scene;
    scene.cameras.resize(std::size_t(options.cameras));
    scene.places.resize(held.size());
    scene.close.resize(close.size());
    const double all = double(scene.cameras.size() + held.size() + close.size());
    std::atomic<int> done{0};
    const auto tell = [&] { progress("drawing the exact room", ++done / all); };
    for_each_of(scene.cameras.size(), [&](std::size_t i) {
        scene.cameras[i] = make_camera(room, *moment, options, int(i));
        tell();
    });
    for_each_of(held.size() + close.size(), [&](std::size_t i) {
        const bool is_held = i < held.size();
        ViewBenchPlace& place = is_held ? scene.places[i] : scene.close[i - held.size()];
        const ViewBenchEye& eye = is_held ? held[i] : close[i - held.size()];
        place = make_view_bench_place(room, *moment, scene.cameras, eye, options.picture);
        tell();
    });
    return scene;
}

namespace {

ViewBenchImages without_color(const Calibration& calibration, DepthView depth) {
    ViewBenchImages result{calibration, DepthImage(depth.size), ColorImage(depth.size)};
    result.calibration.color = calibration.depth;
    result.calibration.color_from_depth = {};
    codec::copy_rows(depth, result.depth.view());
    return result;
}

}  // namespace

ViewBenchImages registered_color(const Calibration& calibration, DepthView depth, ColorView color) {
    ViewBenchImages result = without_color(calibration, depth);
    Image<std::uint8_t> seen(depth.size);
    filter::ColorRegistration(calibration).apply(depth, color, result.color.view(), seen.view());
    for (std::size_t i = 0; i < seen.pixels.size(); ++i)
        if (seen.pixels[i] == 0)
            result.depth.pixels[i] = 0;
    return result;
}

ViewBenchImages depth_sized_color(const Calibration& calibration, DepthView depth,
                                  ColorView color) {
    const Size size = depth.size;
    const CameraModel lens = scaled(calibration.color, color.size);
    const Image<Ray> rays = make_ray_table(calibration.depth);
    ViewBenchImages result = without_color(calibration, depth);
    for (int y = 0; y < size.height; ++y) {
        // Renderers may close gaps in depth, so pixels without measurement get the colour of a
        // surface at the last distance.
        double z = 0;
        for (int x = 0; x < size.width; ++x) {
            if (depth.row(y)[x] > 0)
                z = depth.row(y)[x] * calibration.depth_unit_mm / 1000;
            const Ray ray = rays.view().row(y)[x];
            if (z == 0 || ray.x == no_ray)
                continue;
            const auto place =
                project(lens, calibration.color_from_depth * Vec3{ray.x * z, ray.y * z, z});
            if (!place || place->x < 0 || place->y < 0 || place->x > lens.size.width - 2 ||
                place->y > lens.size.height - 2)
                continue;
            const int cx = int(place->x), cy = int(place->y);
            const double u = place->x - cx, v = place->y - cy;
            const Rgb *above = color.row(cy) + cx, *below = color.row(cy + 1) + cx;
            const auto mix = [&](std::uint8_t Rgb::*channel) {
                return std::uint8_t(
                    std::lround((above[0].*channel * (1 - u) + above[1].*channel * u) * (1 - v) +
                                (below[0].*channel * (1 - u) + below[1].*channel * u) * v));
            };
            result.color.view().row(y)[x] = {mix(&Rgb::r), mix(&Rgb::g), mix(&Rgb::b)};
        }
    }
    return result;
}

}  // namespace theatron::bench
