// SPDX-License-Identifier: Apache-2.0
#include "compare_ways.h"

#include <utility>

#include "compare_pcl.h"
#include "svg_drawing.h"
#include "video/color_codec.h"

namespace theatron::bench {
namespace {

std::string missing_encoder(const std::string& codec) {
    return video::missing_color_encoder(video::parse_color_setting(codec).setting);
}

// A video call at a usual rate for the pictures of its cameras.
CompareWay video_call(CompareMethod words, std::vector<const CompareCamera*> cameras, double mbit,
                      const std::string& cameras_in_words, const CompareScene& scene) {
    words.is_video = true;
    words.rate_setting_mbit = mbit;
    const std::string rate = "h264:bitrate_mbit=" + formatted("%g", mbit);
    const std::string x264 = rate + ",preset=veryfast,encoder=x264";
    const bool has_x264 = missing_encoder(x264).empty();
    const std::string codec = has_x264 ? x264 : rate;
    if (words.reason.empty())
        words.reason = missing_encoder(codec);
    words.expert_reason =
        "A video call shows what its cameras see; it has no picture from another place.";
    if (!cameras.empty()) {
        const Size size = cameras.front()->last_exact.size;
        words.ran = cameras_in_words + ", " + std::to_string(size.width) + "x" +
                    std::to_string(size.height) + ", H.264 set to " + formatted("%g", mbit) +
                    " Mbit/s a camera by " +
                    (has_x264 ? "FFmpeg's libx264 (veryfast)" : "OpenH264");
    }
    return {.words = std::move(words),
            .cameras = std::move(cameras),
            .path = [codec](const CompareCamera&) { return make_video_path(codec); },
            .arrives_as_taken = true,
            .shown = CompareWay::Shown::video,
            .views = &scene.without_near};
}

CompareWay usual_call(const CompareScene& scene) {
    return video_call({.id = video_call_id,
                       .name = "Video call",
                       .plain = "The picture of one camera, as in any video call. The expert sees "
                                "what that camera sees"},
                      {&scene.cameras.front()}, 2.5, "one camera", scene);
}

CompareWay full_hd_call(const CompareScene& scene) {
    return video_call({.id = full_hd_call_id,
                       .name = "Video call, full HD",
                       .plain = "The same with a camera of more pixels, and a higher rate"},
                      {&scene.full_hd}, 4, "one camera", scene);
}

CompareWay zoomed_call(const CompareScene& scene) {
    CompareWay way =
        video_call({.id = zoomed_call_id,
                    .name = "Video call, zoomed",
                    .plain = "A video call whose camera hangs at the same place and is zoomed to "
                             "the wound. It shows nothing else"},
                   {&scene.zoomed}, 2.5, "one camera zoomed to the wound", scene);
    way.shown = CompareWay::Shown::zoomed_video;
    return way;
}

CompareWay two_camera_call(const CompareScene& scene) {
    CompareMethod words{.id = two_camera_call_id,
                        .name = "Video call, two cameras",
                        .plain = "The pictures of two cameras beside each other"};
    const std::vector<const CompareCamera*> usual = scene.usual_cameras();
    std::vector<const CompareCamera*> cameras;
    if (usual.size() < 2)
        words.reason = "This room has one camera alone.";
    else
        cameras = {usual[0], usual[1]};
    return video_call(std::move(words), std::move(cameras), 2.5, "two cameras", scene);
}

CompareWay paper(const CompareScene& scene) {
    return {
        .words = {.id = paper_id,
                  .name = "Research system, 2022",
                  .plain = "The method of a published study, built again from its text. Cameras "
                           "that also measure distance; the expert's computer draws surfaces "
                           "from them",
                  .ran = "Fischer et al. 2022: filters of the study (\"paper\"), colour "
                         "registered to depth as JPEG of quality 85 (libjpeg-turbo), depth as "
                         "temporal RVL without loss, drawn as mesh"},
        .cameras = scene.usual_cameras(),
        .path = make_paper_path,
        .views = &scene.without_near,
        .renderer = "mesh"};
}

CompareWay pcl(const CompareScene& scene) {
    return {
        .words = {.id = pcl_id,
                  .name = "General 3D method",
                  .plain = "Cameras that also measure distance. Their coloured points are "
                           "compressed by a library for any purpose, and drawn as squares",
                  .ran = "PCL's octree codec at medium resolution with colour (points of 5 mm), "
                         "the family that cwipc's codec comes from; usual filters "
                         "(\"default\"); drawn as squares",
                  .reason = missing_pcl()},
        .cameras = scene.usual_cameras(),
        .path = make_pcl_path,
        .shown = CompareWay::Shown::points,
        .views = &scene.without_near};
}

CompareWay theatron(const CompareScene& scene, bool near) {
    // A host sends this to `auto`, where it has an encoder and time.
    std::string codec = "h264:crf=20";
    if (!missing_encoder(codec).empty())
        codec = "jpeg:quality=85";
    CompareWay way{
        .words = {.id = theatron_id,
                  .name = "Theatron",
                  .plain = "The cameras of the research system. Theatron removes noise, sends "
                           "distances in a form of its own and colours as video, and draws "
                           "surfaces from both",
                  .ran = "usual filters (\"default\"), distances without loss by Theatron's codec "
                         "strata, colour as " +
                         codec + ", drawn by the renderer blend"},
        .cameras = scene.usual_cameras(),
        .path = [codec](const CompareCamera& camera) { return make_theatron_path(camera, codec); },
        .arrives_as_taken = true,
        .views = &scene.without_near,
        .renderer = "blend",
        .kept = 5};
    if (!near)
        return way;
    way.words.id = theatron_near_id;
    way.words.name = "Theatron, near camera";
    way.words.plain =
        "Theatron with one camera more, on an arm over the foot of the table, about a "
        "metre from the wound, on the expert's side";
    way.cameras.push_back(&scene.near_camera());
    way.views = &scene.with_near;
    return way;
}

// Both ways at once.
CompareWay pair(const CompareWay& one, const CompareWay& video, CompareMethod words) {
    words.is_pair = true;
    for (const CompareWay* part : {&one, &video})
        if (words.reason.empty())
            words.reason = part->words.reason;
    words.ran = "both at once: " + one.words.ran + "; and " + video.words.ran;
    words.expert_reason =
        "Its pictures are those of \"" + one.words.name + "\" and \"" + video.words.name + "\".";
    CompareWay both{.words = std::move(words),
                    .cameras = one.cameras,
                    .path =
                        [clouds = one.path, picture = video.path](const CompareCamera& camera) {
                            return camera.depth.empty() ? picture(camera) : clouds(camera);
                        },
                    .shown = CompareWay::Shown::pair,
                    .views = one.views,
                    .parts = {one.words.id, video.words.id}};
    both.cameras.insert(both.cameras.end(), video.cameras.begin(), video.cameras.end());
    return both;
}

}  // namespace

std::vector<CompareWay> compare_ways(const CompareScene& scene) {
    std::vector<CompareWay> ways = {
        usual_call(scene), full_hd_call(scene), zoomed_call(scene),     two_camera_call(scene),
        paper(scene),      pcl(scene),          theatron(scene, false), theatron(scene, true)};
    ways.push_back(pair(theatron(scene, false), zoomed_call(scene),
                        {.id = theatron_and_call_id,
                         .name = "Theatron beside a zoomed call",
                         .plain = "Theatron and the zoomed video call at once, from the same "
                                  "room. The expert has both pictures beside each other"}));
    return ways;
}

}  // namespace theatron::bench
