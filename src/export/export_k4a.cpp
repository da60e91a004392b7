// SPDX-License-Identifier: Apache-2.0
// Exports the recording of an Azure Kinect, as its own tools write it: depth as
// 16-bit big-endian pictures ("b16g"), colour as MJPEG, the factory calibration
// as an attachment, and tags that name them.
#include "base/error.h"
#include "capture/azure_calibration.h"
#include "export/export_formats.h"
#include "record/matroska_writer.h"
#include "video/jpeg_encoder_native.h"

namespace theatron::exporting {
namespace {

constexpr int color_track = 1, depth_track = 2;
constexpr std::uint64_t calibration_uid = 1;
constexpr int quality_of_raw_color = 95;

std::string to_text(Size size) {
    return std::to_string(size.width) + "x" + std::to_string(size.height);
}

// The BITMAPINFOHEADER that V_MS/VFW/FOURCC tracks begin with.
Bytes bitmap_info(Size size, std::string_view fourcc, int bits, std::size_t image_bytes) {
    constexpr std::uint32_t info_size = 40;
    Bytes bytes;
    bytes.reserve(info_size);
    ByteWriter out(bytes);
    out.put(info_size);
    out.put(std::int32_t(size.width));
    out.put(std::int32_t(size.height));
    out.put(std::uint16_t(1));
    out.put(std::uint16_t(bits));
    out.put_bytes(as_bytes(fourcc));
    out.put(std::uint32_t(image_bytes));
    for (int i = 0; i < 4; ++i)
        out.put(std::uint32_t(0));
    return bytes;
}

record::MatroskaWriter::Layout layout_of(const capture::CameraInfo& info,
                                         const capture::AzureDescription& azure) {
    record::MatroskaWriter::Layout layout;
    const auto add = [&](int number, const char* name, Size size, Bytes head) {
        record::Track track;
        track.number = number;
        track.name = name;
        track.codec_id = "V_MS/VFW/FOURCC";
        track.codec_private = std::move(head);
        track.width = size.width;
        track.height = size.height;
        track.frames_per_second = info.frames_per_second;
        layout.tracks.push_back(std::move(track));
        layout.tags.push_back({.name = std::string("K4A_") + name + "_TRACK",
                               .value = std::to_string(number),
                               .track = number});
    };
    const Size color = info.calibration.color.size, depth = info.calibration.depth.size;
    if (color != Size{}) {
        add(color_track, "COLOR", color, bitmap_info(color, "MJPG", 24, 0));
        layout.tags.push_back(
            {.name = "K4A_COLOR_MODE", .value = azure.color_mode, .track = color_track});
    }
    add(depth_track, "DEPTH", depth,
        bitmap_info(depth, "b16g", 16, depth.area() * sizeof(std::uint16_t)));
    layout.tags.push_back(
        {.name = "K4A_DEPTH_MODE", .value = azure.depth_mode, .track = depth_track});
    layout.tags.push_back({.name = "K4A_DEPTH_DELAY_NS", .value = "0"});
    layout.tags.push_back({.name = "K4A_WIRED_SYNC_MODE", .value = "STANDALONE"});
    layout.tags.push_back({.name = "K4A_CALIBRATION_FILE",
                           .value = "calibration.json",
                           .attachment_uid = calibration_uid});
    layout.tags.push_back({.name = "K4A_START_OFFSET_NS", .value = "0"});
    const ByteView text = as_bytes(azure.calibration);
    layout.attachments.push_back({"calibration.json", "application/octet-stream",
                                  Bytes(text.begin(), text.end()), calibration_uid});
    return layout;
}

void require_azure(const capture::CameraInfo& info, const capture::AzureDescription& azure) {
    const Calibration& calibration = info.calibration;
    if (azure.depth_mode.empty())
        throw Error("An Azure Kinect gives no depth of " + to_text(calibration.depth.size) +
                    ", so this camera cannot be exported as one; use --png.");
    if (azure.color_mode.empty())
        throw Error("An Azure Kinect gives no colour of " + to_text(calibration.color.size) +
                    ", so this camera cannot be exported as one; use --png.");
    if (calibration.depth_unit_mm != 1)
        throw Error(
            "An Azure Kinect's depth counts millimetres, but this camera's does not, so it "
            "cannot be exported as one; use --png.");
}

}  // namespace

std::size_t export_k4a(ExportSource& source, const std::filesystem::path& file) {
    if (source.cameras.size() != 1)
        throw Error("The recording holds " + std::to_string(source.cameras.size()) +
                    " cameras, but an Azure Kinect's file only one; choose it with --camera N.");
    capture::RecordedFrames& camera = *source.cameras[0];
    const capture::AzureDescription azure = capture::describe_as_azure(camera.info().calibration);
    require_azure(camera.info(), azure);
    if (std::filesystem::exists(file))
        throw Error("'" + file.string() + "' exists already; name another file.");

    record::MatroskaWriter writer(file, layout_of(camera.info(), azure));
    video::JpegCompressor compressor(quality_of_raw_color, /*halve_chroma=*/false);
    Frame frame;
    Bytes depth;
    std::size_t frames = 0, seen = 0;
    for (; const auto offset = source.next_selected(0, seen); ++frames) {
        camera.read(frame);
        depth.resize(frame.depth.pixels.size() * sizeof(std::uint16_t));
        for (std::size_t i = 0; i < frame.depth.pixels.size(); ++i) {
            depth[2 * i] = std::byte(frame.depth.pixels[i] >> 8);
            depth[2 * i + 1] = std::byte(frame.depth.pixels[i] & 0xff);
        }
        std::vector<record::Block> blocks;
        if (!frame.color.empty())
            blocks.push_back({.track = color_track,
                              .time_us = offset->count(),
                              .payload = frame.color.is_jpeg()
                                             ? ByteView(frame.color.jpeg)
                                             : compressor.compress(frame.color.pixels.view())});
        blocks.push_back({.track = depth_track, .time_us = offset->count(), .payload = depth});
        if (const std::string problem = writer.write(std::move(blocks)); !problem.empty())
            throw Error(problem);
        if (source.progress)
            source.progress("exporting", double(frames + 1) / double(camera.frames()));
    }
    if (const std::string problem = writer.finish(); !problem.empty())
        throw Error(problem);
    return frames;
}

}  // namespace theatron::exporting
