// SPDX-License-Identifier: Apache-2.0
#include "register_result.h"

#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <iostream>
#include <nlohmann/json.hpp>
#include <span>

#include "base/error.h"
#include "base/utc.h"
#include "files/file_bytes.h"
#include "files/json_text.h"
#include "registration/room_alignment.h"
#include "registration/surface_refinement.h"

namespace theatron::app {
namespace {

using registration::BoardSession;
using registration::RegistrationReport;
using registration::RigSolution;
using registration::SurfaceCamera;

// Surfaces further apart are different ones.
constexpr double report_reach_m = 0.05;
// Viewers subtract an offset that is saved, so others are left to their own estimates.
constexpr double well_known_offset_m = 0.00075;
// Heads are lower, and hands reach no further from the board's places.
constexpr double volume_height_m = 2.2, volume_radius_m = 1.5;

// The floor in the reference's frame, measured by the camera that sees most of it.
std::optional<registration::Plane> floor_of(const Cameras& cameras, const BoardSession& session,
                                            const RigSolution& solution) {
    std::optional<registration::Plane> floor;
    double area = 0;
    for (std::size_t c = 0; c < cameras.size(); ++c) {
        const auto found =
            registration::find_floor(session.last_mean(c).view(), session.mean_unit_mm(c),
                                     make_ray_table(cameras[c].calibration.depth));
        if (!found || found->area_m2 < area)
            continue;
        area = found->area_m2;
        const Pose& pose = solution.cameras[c].reference_from_camera;
        const Vec3 normal = rotate(pose.rotation, found->plane.normal());
        const Vec3 point = pose * (found->plane.q * (1 / dot(found->plane.q, found->plane.q)));
        floor = registration::Plane{normal * (1 / dot(normal, point))};
    }
    return floor;
}

// A sentence on the table's top, as the camera sees it that sees most of it; else empty.
std::string table_text(const Cameras& cameras, const BoardSession& session,
                       const RigSolution& solution, const Pose& room) {
    double area = 0;
    char text[160] = "";
    for (std::size_t c = 0; c < cameras.size(); ++c) {
        const Image<Ray> rays = make_ray_table(cameras[c].calibration.depth);
        const DepthView depth = session.last_mean(c).view();
        const auto floor = registration::find_floor(depth, session.mean_unit_mm(c), rays);
        if (!floor)
            continue;
        const auto table =
            registration::find_table(depth, session.mean_unit_mm(c), rays, floor->plane);
        if (!table || table->area_m2 < area)
            continue;
        area = table->area_m2;
        const Vec3 at = room * solution.cameras[c].reference_from_camera * table->middle;
        std::snprintf(
            text, sizeof(text),
            "The table's top is %.2f m high; its seen part (%.1f square metres) is around "
            "x %.2f, z %.2f m.",
            at.y, area, at.x, at.z);
    }
    return text;
}

// Depth images of all cameras of one still scene, to be compared.
struct Scene {
    std::vector<SurfaceCamera> cameras;
    std::vector<DepthImage> images;

    std::vector<registration::SurfaceView> views(const std::vector<Pose>& poses) const {
        std::vector<registration::SurfaceView> views;
        for (std::size_t c = 0; c < cameras.size(); ++c)
            views.push_back({&cameras[c], images[c].view(), poses[c]});
        return views;
    }
};

// Appends the surfaces that both see in the working volume around `middle`.
void compare(const Scene& scene, std::size_t a, std::size_t b, const std::vector<Pose>& room_from,
             Vec3 middle, std::vector<RegistrationReport::Surface>& surfaces) {
    for (const auto& point :
         overlap(surface_grid(scene.cameras[a], scene.images[a].view()), scene.cameras[b],
                 scene.images[b].view(), inverse(room_from[b]) * room_from[a], report_reach_m)) {
        const Vec3 at = room_from[b] * point.at;
        if (at.y < volume_height_m &&
            std::hypot(at.x - middle.x, at.z - middle.z) < volume_radius_m)
            surfaces.push_back({at, std::abs(point.apart_m) * 1000});
    }
}

// Fills report.pairs' surfaces, one for each pair of cameras.
void compare_all(const Scene& before, const std::vector<Pose>& poses_before, const Scene& after,
                 const std::vector<Pose>& poses_after, Vec3 middle, RegistrationReport& report) {
    for (std::size_t a = 0; a < after.cameras.size(); ++a)
        for (std::size_t b = a + 1; b < after.cameras.size(); ++b) {
            RegistrationReport::Pair pair;
            pair.a = a;
            pair.b = b;
            compare(before, a, b, poses_before, middle, pair.before);
            compare(before, b, a, poses_before, middle, pair.before);
            compare(after, a, b, poses_after, middle, pair.after);
            compare(after, b, a, poses_after, middle, pair.after);
            report.pairs.push_back(std::move(pair));
        }
}

std::string refined_text(const registration::SurfaceRefinement& refined) {
    char text[200];
    if (refined.is_kept)
        std::snprintf(
            text, sizeof(text),
            "Improved on the scene's own surfaces: the median distance of those that took "
            "no part fell from %.1f to %.1f mm.",
            refined.before_m * 1000, refined.after_m * 1000);
    else
        std::snprintf(
            text, sizeof(text),
            "The scene's own surfaces gave no better places, so those of the board stand.");
    return text;
}

std::vector<Pose> earlier_places(const Cameras& cameras) {
    std::vector<Pose> poses;
    for (const DepthSource::Camera& camera : cameras)
        if (camera.calibration.registered)
            poses.push_back(camera.calibration.room_from_camera);
    return poses;
}

}  // namespace

RegisteredRig rig_of_board(const Cameras& cameras, const BoardSession& session,
                           const RigSolution& solution, const std::string& method,
                           const std::optional<RoomFrame>& given) {
    RegisteredRig rig;
    RegistrationReport& report = rig.report;
    Vec3 middle{};
    for (const Pose& board : solution.reference_from_board)
        middle = middle + board.translation * (1.0 / double(session.places()));
    // A place of the first camera, by hand or in its own calibration, overrides the found one.
    const Calibration& first = cameras[0].calibration;
    const auto floor = floor_of(cameras, session, solution);
    Pose room;
    if (given) {
        room = given->room_from_reference;
        rig.room = given->source;
    } else if (first.registered) {
        room = first.room_from_camera;
        rig.room = "the first camera's own place";
    } else {
        room = registration::room_from_reference(floor, middle);
        rig.room = floor ? "the floor in depth"
                         : "a guess: no floor was seen, so the first camera is taken to be level, "
                           "1.5 m up";
    }

    Scene measured, corrected;
    std::vector<Pose> of_board;
    double shift_m = 0.0005, turn = 0.0005;  // the board's own accuracy is hardly better
    for (std::size_t c = 0; c < cameras.size(); ++c) {
        const registration::CameraPlace& found = solution.cameras[c];
        measured.cameras.emplace_back(cameras[c].calibration.depth, session.mean_unit_mm(c));
        measured.images.push_back(session.last_mean(c));
        corrected.cameras.push_back(measured.cameras.back());
        corrected.cameras.back().bias = found.bias;
        of_board.push_back(found.reference_from_camera);
        shift_m =
            std::max(shift_m, std::sqrt(found.covariance.bottomRightCorner<3, 3>().trace() / 3));
        turn = std::max(turn, std::sqrt(found.covariance.topLeftCorner<3, 3>().trace() / 3));
    }
    corrected.images = measured.images;
    const auto refined = registration::refine_on_surfaces(corrected.views(of_board),
                                                          {report_reach_m, shift_m, turn});
    report.remarks.push_back("The room's frame comes from " + rig.room + ".");
    report.remarks.push_back(refined_text(refined));
    if (const std::string table = table_text(cameras, session, solution, room); !table.empty())
        report.remarks.push_back(table);

    rig.places.made = utc_text(utc_now());
    rig.places.method = method + ", " + std::to_string(session.places()) + " places" +
                        (refined.is_kept ? ", surfaces" : "") + "; room from " + rig.room;
    std::vector<Pose> places, before = earlier_places(cameras);
    for (std::size_t c = 0; c < cameras.size(); ++c) {
        const registration::CameraPlace& found = solution.cameras[c];
        places.push_back(room * refined.reference_from_camera[c]);
        capture::CameraPlaces::Entry entry{cameras[c].name, places[c], {}, {}, {}};
        if (found.bias_sigma.offset_m < well_known_offset_m)
            entry.depth_offset_mm = found.bias.offset_m * 1000;
        auto& covariance = entry.covariance.emplace();
        for (int i = 0; i < 6; ++i)
            for (int j = 0; j < 6; ++j)
                covariance[std::size_t(6 * i + j)] = found.covariance(i, j);
        rig.places.cameras.push_back(std::move(entry));
        RegistrationReport::Camera& drawn = report.cameras.emplace_back();
        drawn.name = cameras[c].name;
        drawn.room_from_camera = places[c];
        if (before.size() == cameras.size())
            drawn.earlier = before[c];
        drawn.is_reference = c == 0;
        if (c > 0)
            drawn.sigma = {
                std::sqrt(found.covariance.bottomRightCorner<3, 3>().trace()) * 1000,
                std::sqrt(found.covariance.topLeftCorner<3, 3>().trace()) / radians_of(1)};
        drawn.bias = found.bias;
        drawn.bias_sigma = found.bias_sigma;
        drawn.views = session.views(c);
        drawn.ninths = session.coverage(c);
    }
    report.made = rig.places.made;
    report.method = rig.places.method;
    for (const Pose& board : solution.reference_from_board)
        report.places.push_back(room * board.translation);
    report.before = "the cameras' earlier places, depth as measured";
    if (before.size() != cameras.size()) {
        report.before = "the places of the board alone, depth as measured";
        before.clear();
        for (const Pose& pose : of_board)
            before.push_back(room * pose);
    }
    compare_all(measured, before, corrected, places, room * middle, report);
    for (const BoardSession::Pair& pair : session.pairs(solution))
        for (RegistrationReport::Pair& drawn : report.pairs)
            if (drawn.a == pair.a && drawn.b == pair.b) {
                drawn.places = pair.places;
                drawn.board_mm = pair.apart_m * 1000;
            }
    return rig;
}

RegisteredRig rig_of_surfaces(const Cameras& cameras, const capture::CameraPlaces& earlier,
                              const std::vector<registration::FrameMean>& means) {
    // A camera that was moved: more than that is a new registration.
    constexpr double shift_m = 0.05, turn = 0.03, reach_m = 0.1;
    RegisteredRig rig;
    rig.room = "the earlier places";
    Scene scene;
    std::vector<Pose> before;
    for (std::size_t c = 0; c < cameras.size(); ++c) {
        const capture::CameraPlaces::Entry* entry = earlier.find(cameras[c].name);
        if (!entry)
            throw Error("The file of places has no camera '" + cameras[c].name +
                        "'; register it with the board.");
        before.push_back(entry->room_from_camera);
        scene.cameras.emplace_back(
            cameras[c].calibration.depth,
            cameras[c].calibration.depth_unit_mm / registration::FrameMean::finer);
        scene.cameras.back().bias.offset_m = entry->depth_offset_mm.value_or(0) / 1000;
        scene.images.push_back(means[c].mean());
    }
    const auto refined =
        registration::refine_on_surfaces(scene.views(before), {reach_m, shift_m, turn});
    if (!refined.is_kept)
        throw Error(
            "The surfaces that two cameras see gave no better places, so nothing was written. If "
            "the picture is wrong all the same, register with the board.");
    const std::vector<Pose> places =
        registration::with_most_places_kept(before, refined.reference_from_camera);
    rig.places.made = utc_text(utc_now());
    rig.places.method = ("surfaces; before: " + earlier.method).substr(0, 480);
    Vec3 middle{};
    for (std::size_t c = 0; c < cameras.size(); ++c) {
        const capture::CameraPlaces::Entry& entry = *earlier.find(cameras[c].name);
        rig.places.cameras.push_back(
            {cameras[c].name, places[c], {}, entry.depth_offset_mm, entry.color_gain});
        RegistrationReport::Camera& drawn = rig.report.cameras.emplace_back();
        drawn.name = cameras[c].name;
        drawn.room_from_camera = places[c];
        drawn.earlier = before[c];
        drawn.bias.offset_m = entry.depth_offset_mm.value_or(0) / 1000;
        // Around the place that the cameras look at.
        middle = middle + places[c] * Vec3{0, 0, 2} * (1.0 / double(cameras.size()));
    }
    // Cameras that are in no file of these stay in it.
    for (const capture::CameraPlaces::Entry& entry : earlier.cameras)
        if (!rig.places.find(entry.camera))
            rig.places.cameras.push_back(entry);
    rig.report.made = rig.places.made;
    rig.report.method = rig.places.method;
    rig.report.before = "the places of the file";
    rig.report.remarks.push_back(refined_text(refined));
    compare_all(scene, before, scene, places, middle, rig.report);
    return rig;
}

const char* clear_line() {
    return isatty(STDOUT_FILENO) ? "\r\033[K" : "";
}

void save(const RegisteredRig& rig, const RigOutput& output) {
    const auto write = [](const std::string& file, const std::string& text) {
        files::write_file(file, std::as_bytes(std::span(text)));
    };
    // The places last: if the report cannot be written, they stay as they were.
    if (!output.report.empty())
        write(output.report, to_html(rig.report));
    write(output.places, capture::write_places(rig.places));

    nlohmann::json json{
        {"event", "saved"}, {"output", output.places},       {"places", rig.report.places.size()},
        {"room", rig.room}, {"remarks", rig.report.remarks}, {"cameras", nlohmann::json::array()}};
    if (!output.json) {
        std::cout << clear_line() << output.places << ": " << rig.places.method << "\n";
        for (const std::string& remark : rig.report.remarks)
            std::cout << remark << "\n";
    }
    for (const RegistrationReport::Camera& camera : rig.report.cameras) {
        const capture::CameraPlaces::Entry& entry = *rig.places.find(camera.name);
        const double offset_mm = camera.bias.offset_m * 1000,
                     sigma_mm = camera.bias_sigma.offset_m * 1000;
        const double moved_mm =
            camera.earlier
                ? length(camera.room_from_camera.translation - camera.earlier->translation) * 1000
                : 0;
        // Figures that were not estimated are left out.
        nlohmann::json& about = json["cameras"].emplace_back(
            nlohmann::json{{"camera", camera.name}, {"reference", camera.is_reference}});
        if (camera.sigma) {
            about["sigma_mm"] = camera.sigma->mm;
            about["sigma_deg"] = camera.sigma->deg;
        }
        if (entry.depth_offset_mm)
            about["depth_offset_mm"] = *entry.depth_offset_mm;
        if (sigma_mm > 0)
            about["depth_offset_sigma_mm"] = sigma_mm;
        if (camera.earlier)
            about["moved_mm"] = moved_mm;
        if (output.json)
            continue;
        std::printf("  %s:", camera.name.c_str());
        if (camera.is_reference)
            std::printf(" the reference;");
        else if (camera.sigma)
            std::printf(" good to %.1f mm and %.2f degrees;", camera.sigma->mm, camera.sigma->deg);
        if (sigma_mm > 0)
            std::printf(" measures %+.1f mm too far (+- %.1f)%s%s", offset_mm, sigma_mm,
                        entry.depth_offset_mm ? "" : ", which is too uncertain to be saved",
                        camera.earlier ? ";" : "");
        if (camera.earlier)
            std::printf(" %.1f mm from its earlier place", moved_mm);
        std::printf("\n");
    }
    if (output.json)
        std::cout << files::json_text(json) << std::endl;
}

}  // namespace theatron::app
