// SPDX-License-Identifier: Apache-2.0
// The figures of the paper, its Table 1 and text, as data.
#include "table1.h"

namespace theatron::bench {
namespace {

using In = Table1Input;
using On = Table1Device;
using Way = Table1Line::Way;
using Sentences = std::vector<std::string>;

constexpr const char* headset = "Picture in the headset";
constexpr const char* delay = "Delay";

const Sentences other_filter = {
    "The paper filters on a GPU; here one thread of the processor does.",
    "Theatron's own choice, the chain default, also removes flying pixels."};
const Sentences other_jpeg = {
    "The paper does not give its JPEG quality; here it is 85.",
    "Colour here is black where there is no depth, as it is registered to the depth image."};
const Sentences other_video = {
    "Theatron's own choice is OpenH264; the paper's settings are those of x264, which is measured "
    "as the paper's method. Sizes are of pictures that refer to the one before."};
const Sentences lossy_trvl = {
    "The paper's tRVL drops small changes before coding (a dead band), so it loses detail and its "
    "size depends on the motion; trvl and strata here give back every value."};
const Sentences lossless_rvl = {"RVL is the same codec in both; only the scene differs."};
const Sentences depth_video = {
    "How the paper puts depth into H.264 is not published; here it is ten bits in levels of equal "
    "ratio, with an exact mask of valid pixels. Strata beside it loses nothing."};
const Sentences headset_picture = {
    "The size of the paper's pictures is not published; here it is stated, with new images of "
    "every camera in each picture, offscreen, without waiting for a display.",
    "Theatron's virtual room is not the paper's; its qualities low and high stand for the "
    "presets."};
const Sentences one_machine = {
    "All programs ran on one machine over its loopback; the paper used two PCs in a LAN.",
    "Here from a call of one participant's client to the changed room of the other one, without "
    "input device and drawing; how much of the paper's figure is its engine's picture rate is not "
    "known."};

// A codec's times and size in the paper; 0: not given.
struct PaperCodec {
    const char *id, *part;
    double encode_ms, decode_ms, kb;
};
constexpr PaperCodec paper_codecs[] = {
    {"color.jpeg", "full", 1.5, 1.5, 21.9},    {"color.jpeg", "cropped", 1.08, 1.22, 18},
    {"color.h264", "full", 7.72, 4.84, 15.85}, {"color.h264", "cropped", 0, 0, 0},
    {"depth.trvl", "full", 1.76, 1.19, 96.6},  {"depth.trvl", "cropped", 1.31, 0.987, 81.78},
    {"depth.rvl", "full", 0, 0, 208},          {"depth.h264", "full", 11.04, 9.4, 59.69},
    {"depth.h264", "cropped", 0, 0, 0},
};

// The measurements beside it. Keys are the codecs' rows in the benchmarks of depth and colour.
struct Method {
    const char *id, *name;
    Way same, best;
    const Sentences& differences;
};
const Way strata = {"strata", "strata, lossless"};
const Method methods[] = {
    {"color.jpeg",
     "JPEG",
     {"libjpeg_turbo:quality=85", "libjpeg-turbo, quality 85"},
     {"jpeg:quality=85", "jpeg:quality=85, Theatron's own"},
     other_jpeg},
    {"color.h264",
     "H.264, CRF 20",
     {"h264:crf=20,encoder=x264", "h264:crf=20,encoder=x264 (ultrafast)"},
     {"h264:crf=20", "h264:crf=20 (OpenH264)"},
     other_video},
    {"depth.trvl", "tRVL", {"trvl", "trvl, lossless"}, strata, lossy_trvl},
    {"depth.rvl", "RVL", {"rvl", "rvl, lossless"}, strata, lossless_rvl},
    {"depth.h264", "H.264, CRF 10", {"h264:crf=10", "h264:crf=10 (x264)"}, strata, depth_video},
};

Way measured(const Way& codec, const std::string& place, const char* what) {
    return {place + codec.key + "/" + what, codec.ran};
}

// Encoding, decoding and size.
void add_codec(std::vector<Table1Line>& lines, const PaperCodec& paper, const Method& method) {
    const std::string id = paper.id, part = paper.part;
    const bool full = part == "full", is_color = id.starts_with("color");
    const std::string place = id.substr(0, id.find('.')) + "/" + part + "/";
    const In input = is_color ? (full ? In::color_full : In::color_cropped)
                              : (full ? In::depth_full : In::depth_cropped);
    const auto add = [&](const char* end, const char* name, const char* unit, double figure,
                         const char* what, On device) {
        lines.push_back({id + "." + part + "." + end, is_color ? "Colour" : "Depth",
                         std::string(method.name) + ", " + part + ", " + name, unit, figure, figure,
                         measured(method.same, place, what), measured(method.best, place, what),
                         input, device, method.differences});
    };
    add("encode", "encode", "ms", paper.encode_ms, "encode_ms", On::thread);
    add("decode", "decode", "ms", paper.decode_ms, "decode_ms", On::thread);
    add("size", "a picture", "kB", paper.kb, "kb", On::none);
}

void add_picture(std::vector<Table1Line>& lines, int cameras, const std::string& renderer,
                 const std::string& preset, double paper_ms) {
    const std::string number = std::to_string(cameras);
    const auto way = [&](const std::string& drawn_with) {
        return Way{"vr/" + number + "/" + drawn_with + "/" + preset,
                   drawn_with + ", room " + preset};
    };
    lines.push_back({"vr." + number + "." + renderer + "." + preset, headset,
                     number + (cameras == 1 ? " camera, " : " cameras, ") +
                         (renderer == "splat" ? "splats" : renderer) + ", preset " + preset,
                     "ms", paper_ms, paper_ms, way(renderer), way("blend"),
                     cameras == 1 ? In::one_camera : In::two_cameras, On::gpu, headset_picture});
}

}  // namespace

std::vector<Table1Line> table1_lines() {
    std::vector<Table1Line> lines;
    lines.push_back({"filter.chain",
                     "Filters",
                     "All filters, one picture",
                     "ms",
                     1.34,
                     1.34,
                     {"filter/paper", "chain paper: range, holes, kalman"},
                     {"filter/default", "chain default"},
                     In::depth_full,
                     On::thread,
                     other_filter});
    lines.push_back({"filter.holes",
                     "Filters",
                     "Hole filling alone",
                     "ms",
                     0.59,
                     0.59,
                     {"filter/paper/holes", "holes of the chain paper"},
                     {"filter/default/holes", "holes of the chain default"},
                     In::depth_full,
                     On::thread,
                     other_filter});
    for (const PaperCodec& paper : paper_codecs)
        for (const Method& method : methods)
            if (std::string(paper.id) == method.id)
                add_codec(lines, paper, method);
    lines.push_back({"depth.h264.full.error",
                     "Depth",
                     "H.264, full, error (RMSE)",
                     "mm",
                     0,
                     0,
                     {"depth/full/h264:crf=10/rmse_mm", "h264:crf=10 (x264)"},
                     {"depth/full/strata/rmse_mm", "strata, lossless"},
                     In::depth_full,
                     On::none,
                     {"The paper gives no figure; it speaks of visible artefacts."}});
    const Sentences one_rate = {
        "Colour as JPEG and depth, 30 pictures a second; other colour codecs are rows above.",
        lossy_trvl.front()};
    lines.push_back({"rate.full",
                     "Data rate",
                     "One camera at 30 Hz, full",
                     "kB/s",
                     3555,
                     3555,
                     {"rate/full/same", "libjpeg-turbo, quality 85, and trvl"},
                     {"rate/full/best", "jpeg:quality=85 and strata"},
                     In::both_full,
                     On::none,
                     one_rate});
    lines.push_back({"rate.cropped",
                     "Data rate",
                     "One camera at 30 Hz, cropped",
                     "kB/s",
                     2993,
                     2993,
                     {"rate/cropped/same", "libjpeg-turbo, quality 85, and trvl"},
                     {"rate/cropped/best", "jpeg:quality=85 and strata"},
                     In::both_cropped,
                     On::none,
                     one_rate});
    add_picture(lines, 1, "splat", "low", 10.9);
    add_picture(lines, 1, "mesh", "low", 8.5);
    add_picture(lines, 2, "splat", "low", 15);
    add_picture(lines, 2, "mesh", "low", 13);
    add_picture(lines, 1, "mesh", "high", 12.5);
    add_picture(lines, 2, "mesh", "high", 15.5);
    Sentences interval = {one_machine.front()};
    interval.push_back(
        "Here: the measured time over the number of pictures of the slowest camera at a receiver "
        "that decodes them.");
    lines.push_back({"delay.interval",
                     delay,
                     "Time between two pictures of a cloud",
                     "ms",
                     33,
                     33,
                     {"session/same/interval_ms", "host and receivers, trvl and JPEG"},
                     {"session/best/interval_ms", "host and receivers, strata and JPEG"},
                     In::session,
                     On::machine,
                     interval});
    lines.push_back({"delay.interaction",
                     delay,
                     "Interaction, client to server to client",
                     "ms",
                     22,
                     29,
                     {"session/same/move_ms", "an object moved, at the other participant"},
                     {"session/best/move_ms", "the same, with strata"},
                     In::session,
                     On::machine,
                     one_machine});
    Sentences answered = one_machine;
    answered.push_back("The paper has no such row: it is the way of the row above, twice.");
    lines.push_back({"delay.answer",
                     delay,
                     "Interaction, there and back with an answer",
                     "ms",
                     0,
                     0,
                     {"session/same/answer_ms", "an object moved, and the other's answer"},
                     {"session/best/answer_ms", "the same, with strata"},
                     In::session,
                     On::machine,
                     answered});
    lines.push_back({"delay.photon",
                     delay,
                     "Motion to photon",
                     "ms",
                     120,
                     150,
                     {"photon/filmed", "from a movement to light on a screen"},
                     {},
                     In::none,
                     On::machine,
                     {"The paper filmed it at 30 Hz; about 75 ms of it are those of the camera."}});
    lines.push_back(
        {"delay.inside",
         delay,
         "Whole system with a synthetic camera, without display",
         "ms",
         0,
         0,
         {},
         {"photon/inside", "theatron photon read, host with --camera strip:delay=0"},
         In::strip,
         On::machine,
         {"The paper has no such figure. Its 120 to 150 ms less the 75 ms of its camera "
          "are 45 to 75 ms, with a display in them, which this figure does not have."}});
    return lines;
}

}  // namespace theatron::bench
