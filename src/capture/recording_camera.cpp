// SPDX-License-Identifier: Apache-2.0
#include "capture/recording_camera.h"

#include <algorithm>
#include <limits>
#include <set>
#include <tuple>

#include "base/error.h"
#include "base/lasting_error.h"
#include "base/log.h"
#include "record/remarks.h"
#include "video/depth_codecs.h"
#include "video/jpeg_header.h"

namespace theatron::capture {
namespace {

constexpr std::uint32_t no_color = std::numeric_limits<std::uint32_t>::max();

// Gains only concern how cameras are drawn together.
bool differ_in_gains_only(const Bytes& one, const Bytes& other) {
    if (one == other)
        return true;
    auto a = decode_calibration(one), b = decode_calibration(other);
    if (!a || !b)
        return false;
    a->color_gain = b->color_gain;
    return *a == *b;
}

// The parts of the camera that have its calibration number `wanted`, in order.
std::vector<record::CameraPart> parts_of(const record::CameraContent& camera, std::size_t wanted) {
    std::vector<record::CameraPart> parts;
    if (wanted == RecordedFrames::any_place) {
        for (const record::CameraPart& part : camera.parts) {
            if (!parts.empty() && !differ_in_place_only(parts[0].calibration, part.calibration))
                break;
            parts.push_back(part);
        }
        return parts;
    }
    std::size_t number = 0;
    for (std::size_t i = 0; i < camera.parts.size(); ++i) {
        number += i > 0 && !differ_in_gains_only(camera.parts[i].calibration,
                                                 camera.parts[i - 1].calibration);
        if (number == wanted)
            parts.push_back(camera.parts[i]);
    }
    return parts;
}

// Throws Error if there is no such camera.
const record::CameraContent& require_camera(const record::RecordingFile& recording,
                                            std::size_t camera, const std::string& file) {
    const std::size_t count = recording.cameras().size();
    if (camera < count)
        return recording.cameras()[camera];
    if (count == 0)
        throw Error("'" + file + "' holds no camera, only the room and its voices.");
    throw Error("'" + file + "' holds " + std::to_string(count) +
                (count == 1 ? " camera" : " cameras") +
                ", numbered from 0, so camera=" + std::to_string(camera) + " is none of them.");
}

// The end of `part`'s frames: the first frame of the next segment.
std::size_t end_of(const record::CameraContent& camera, const record::CameraPart& part) {
    for (const record::CameraPart& other : camera.parts)
        if (other.segment > part.segment)
            return other.first_depth;
    return camera.depth.frames.size();
}

bool is_jpeg(const record::CameraPart& part) {
    return part.color.codec.starts_with("jpeg");
}

// False for codecs of a later version, in another calibration's part.
bool can_decode_color(const record::CameraPart& part) {
    return is_jpeg(part) || video::parse_color_setting(part.color.codec).problem.empty();
}

}  // namespace

std::size_t calibrations_of(const record::CameraContent& camera) {
    std::size_t count = 1;
    for (std::size_t i = 1; i < camera.parts.size(); ++i)
        count +=
            !differ_in_gains_only(camera.parts[i].calibration, camera.parts[i - 1].calibration);
    return count;
}

bool differ_in_place_only(const Bytes& one, const Bytes& other) {
    if (one == other)
        return true;
    const auto a = decode_calibration(one), b = decode_calibration(other);
    return a && b && a->depth == b->depth && a->color == b->color &&
           a->color_from_depth == b->color_from_depth && a->depth_unit_mm == b->depth_unit_mm &&
           a->person == b->person;
}

const Bytes& calibration_at(const record::CameraContent& camera, Duration position) {
    const record::CameraPart* at = &camera.parts.front();
    for (const record::CameraPart& part : camera.parts)
        if (part.first_depth < camera.depth.frames.size() &&
            camera.depth.frames[part.first_depth].time() <= position)
            at = &part;
    return at->calibration;
}

RecordedFrames::RecordedFrames(std::shared_ptr<const record::RecordingFile> recording,
                               std::size_t camera, std::string file, std::size_t part)
    : recording_(std::move(recording)),
      content_(require_camera(*recording_, camera, file)),
      file_(std::move(file)),
      parts_(parts_of(content_, part)) {
    const std::string name = "'" + file_ + "'";
    if (parts_.empty())
        throw Error("Camera " + std::to_string(camera) + " in " + name + " has no calibration " +
                    std::to_string(part) + ".");
    const auto calibration = decode_calibration(parts_[0].calibration);
    if (!calibration)
        throw Error("The calibration in " + name + " is " +
                    std::string(theatron::to_text(calibration.error())) + ".");
    if (calibration->depth.size == Size{})
        throw Error("The camera in " + name + " has no depth, which this version cannot play.");
    info_ = {parts_[0].name, *calibration, parts_[0].frames_per_second};
    for (const record::CameraPart& one : parts_) {
        const auto depth = video::parse_depth_setting(one.depth.codec);
        if (!depth.problem.empty())
            throw Error("The depth in " + name +
                        " is encoded in a way that this Theatron does not know: " + depth.problem);
        if (!one.color.present || is_jpeg(one))
            continue;
        const auto color = video::parse_color_setting(one.color.codec);
        if (!color.problem.empty())
            throw Error("The colour in " + name +
                        " is encoded in a way that this Theatron does not know: " + color.problem);
    }
    begin_ = parts_.front().first_depth;
    end_ = end_of(content_, parts_.back());
    match_colors();
    rewind();
}

// Depth and colour of a frame have the same number. The numbers restart with the host. In
// version 1 that does not start a segment, so there the time identifies a frame as well.
void RecordedFrames::match_colors() {
    const auto name_of = [&](const record::RecordedFrame& frame) {
        const bool has_info = recording_->segments()[frame.segment].has_info;
        return std::tuple(std::uint32_t(frame.segment), has_info ? Duration(0) : frame.time(),
                          frame.number);
    };
    using Name = decltype(name_of(content_.color.frames[0]));
    std::set<std::size_t> color_segments;
    for (const record::CameraPart& part : content_.parts)
        if (part.color.present && can_decode_color(part))
            color_segments.insert(part.segment);
    const auto& frames = content_.color.frames;
    std::vector<std::pair<Name, std::uint32_t>> names;
    names.reserve(frames.size());
    for (std::size_t i = 0; i < frames.size(); ++i)
        names.emplace_back(name_of(frames[i]), std::uint32_t(i));
    std::sort(names.begin(), names.end());
    colors_.assign(end_ - begin_, no_color);
    for (std::size_t i = begin_; i < end_; ++i) {
        const record::RecordedFrame& depth = content_.depth.frames[i];
        const auto find = [&](const Name& name) {
            const auto found =
                std::lower_bound(names.begin(), names.end(), std::pair(name, std::uint32_t(0)));
            return found != names.end() && found->first == name ? found->second : no_color;
        };
        std::uint32_t& color = colors_[i - begin_];
        color = find(name_of(depth));
        // Where a segment changes, the two may be on either side.
        if (color != no_color || !color_segments.contains(depth.segment))
            continue;
        for (const std::size_t beside :
             {depth.segment - std::size_t(1), depth.segment + std::size_t(1)}) {
            if (!color_segments.contains(beside))
                continue;
            const std::uint32_t other = find({std::uint32_t(beside), Duration(0), depth.number});
            constexpr Duration same_moment = std::chrono::milliseconds(500);
            if (other != no_color &&
                std::chrono::abs(frames[other].time() - depth.time()) < same_moment)
                color = other;
        }
    }
}

void RecordedFrames::rewind() {
    next_ = begin_;
    is_decoded_ = false;
    color_.clear();
    last_offset_ = {};
    lost_before_ = std::max(lost_before_, losses_.depth() + losses_.color());
    losses_ = {};
    begin_part(0);
}

void RecordedFrames::go_to(Duration position) {
    const auto& frames = content_.depth.frames;
    std::size_t wanted = begin_;
    for (std::size_t low = begin_, high = end_; low < high;) {
        const std::size_t middle = (low + high) / 2;
        if (frames[middle].time() <= position) {
            wanted = middle;
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    std::size_t part = 0;
    while (part + 1 < parts_.size() && wanted >= parts_[part + 1].first_depth)
        ++part;
    color_.clear();
    begin_part(part);
    // From the key frame on that it refers to.
    next_ = wanted;
    while (next_ > std::max(begin_, parts_[part].first_depth) && !frames[next_].key)
        --next_;
    is_decoded_ = false;
    last_offset_ = {};
    while (next_ < wanted)
        skip();
}

void RecordedFrames::begin_part(std::size_t part) {
    part_ = part;
    const record::CameraPart& one = parts_[part];
    depth_ = std::make_unique<codec::DepthStreamDecoder>(
        video::make_depth_decoder(video::parse_depth_setting(one.depth.codec).setting));
    std::erase_if(color_, [&](const auto& entry) { return entry.first + 1 < one.segment; });
}

// Precondition: the camera has colour in this segment.
RecordedFrames::ColorOfSegment& RecordedFrames::colors_of(std::size_t segment) {
    const auto [at, is_new] = color_.try_emplace(segment);
    ColorOfSegment& colors = at->second;
    if (!is_new)
        return colors;
    const auto part = std::find_if(content_.parts.begin(), content_.parts.end(),
                                   [&](const auto& p) { return p.segment == segment; });
    if (!is_jpeg(*part))
        colors.decoder =
            video::make_color_decoder(video::parse_color_setting(part->color.codec).setting.id);
    colors.next = part->first_color;
    return colors;
}

std::optional<Duration> RecordedFrames::offset() {
    for (; next_ < end_; ++next_) {
        if (!is_decoded_ && !decode())
            continue;
        // Relative to the start of the whole recording, so that its cameras stay in step.
        last_offset_ = std::max(last_offset_, content_.depth.frames[next_].time());
        return last_offset_;
    }
    return std::nullopt;
}

std::optional<Duration> RecordedFrames::round() const {
    return recording_->duration() + seconds_to_duration(1 / info_.frames_per_second);
}

std::uint64_t RecordedFrames::lost_pictures() const {
    return content_.depth.damaged + content_.color.damaged +
           std::max(lost_before_, losses_.depth() + losses_.color());
}

std::string RecordedFrames::problem_at_end() const {
    const record::Segment& last = recording_->segments().back();
    // A camera that left earlier has nothing to do with the recording's end.
    if (parts_.back().segment + 1 != recording_->segments().size())
        return "";
    if (last.next != 0)
        return "The recording '" + file_ + "' goes on in a segment that is missing.";
    const std::string remark = last.lacks_end() ? record::end_of(last) : record::early_end_of(last);
    constexpr std::string_view subject = "it ";
    return remark.empty() ? ""
                          : "The recording '" + file_ + "' " + remark.substr(subject.size()) + ".";
}

wire::MediaHeader RecordedFrames::upcoming() const {
    const auto header = recording_->read_header(content_.depth.frames[next_]);
    return header ? *header : wire::MediaHeader{};
}

UtcTime RecordedFrames::upcoming_utc() const {
    const record::Segment& segment = recording_->segments()[parts_[part_].segment];
    return segment.has_info
               ? segment.info.clock.utc + (upcoming().captured - segment.info.clock.session)
               : UtcTime{};
}

bool RecordedFrames::decode() {
    const record::RecordedFrame& frame = content_.depth.frames[next_];
    while (part_ + 1 < parts_.size() && next_ >= parts_[part_ + 1].first_depth)
        begin_part(part_ + 1);
    const auto header = recording_->read_header(frame);
    Status status = header ? recording_->read_payload(frame, payload_) : header.error();
    if (status == Status::ok) {
        const auto size = depth_->read_size(payload_);
        if (!size)
            status = size.error();
        else if (*size != info_.calibration.depth.size)
            status = Status::size_mismatch;
        else
            decoded_.resize(*size);
    }
    if (status == Status::ok)
        status =
            depth_->decode({header->frame, header->reference, header->temporal_layer, header->key},
                           payload_, decoded_.view());
    is_decoded_ = status == Status::ok;
    if (status == Status::missing_reference)
        ++losses_.undecodable_depth;
    else if (status != Status::ok)
        ++losses_.damaged_depth;
    return is_decoded_;
}

void RecordedFrames::skip() {
    // A skipped frame is decoded, because it may be the reference of the next one.
    if (!is_decoded_)
        decode();
    is_decoded_ = false;
    ++next_;
}

bool RecordedFrames::read(Frame& out) {
    if (!is_decoded_ && !decode())
        return false;
    is_decoded_ = false;
    std::swap(out.depth, decoded_);

    out.color.jpeg.clear();
    out.color.pixels.pixels.clear();
    out.color.size = {};
    const std::uint32_t color = colors_[next_++ - begin_];
    if (color != no_color && !read_color(color, out.color)) {
        out.color.jpeg.clear();
        out.color.pixels.pixels.clear();
        out.color.size = {};
    }
    return true;
}

bool RecordedFrames::read_color(std::size_t index, ColorData& out) {
    ColorOfSegment& colors = colors_of(content_.color.frames[index].segment);
    if (colors.decoder)
        return decode_color(colors, index, out);
    Status status = recording_->read_payload(content_.color.frames[index], payload_);
    const auto size = status == Status::ok ? video::read_jpeg_size(payload_) : Result<Size>(status);
    if (!size || *size != info_.calibration.color.size) {
        ++losses_.damaged_color;
        return false;
    }
    out.size = *size;
    out.jpeg.assign(payload_.begin(), payload_.end());
    return true;
}

// Decodes the picture, and before it the skipped pictures that it refers to. False if it
// cannot be decoded.
bool RecordedFrames::decode_color(ColorOfSegment& colors, std::size_t index, ColorData& out) {
    const auto& frames = content_.color.frames;
    std::size_t first = index;
    while (!frames[first].key && first > colors.next)
        --first;
    colors.next = index + 1;
    bool is_wanted = false;
    for (std::size_t i = first; i <= index; ++i) {
        const auto header = recording_->read_header(frames[i]);
        is_wanted = false;
        // A delta picture refers to the one before it, back to a key frame.
        if (header && !header->key && colors.last != header->reference) {
            losses_.undecodable_color += i == index;
            continue;
        }
        Status status = header ? recording_->read_payload(frames[i], payload_) : header.error();
        if (status == Status::ok)
            status = colors.decoder->submit(payload_, frames[i].number);
        colors.last.reset();
        if (status != Status::ok) {
            ++losses_.damaged_color;
            continue;
        }
        colors.last = frames[i].number;
        while (auto decoded = colors.decoder->poll()) {
            std::swap(out.pixels, decoded->image);
            out.size = out.pixels.size;
            colors.decoder->recycle(std::move(decoded->image));
            is_wanted = out.size == info_.calibration.color.size;
        }
    }
    return is_wanted;
}

std::unique_ptr<Camera> open_recording_camera(Options& options, const Progress& progress) {
    const int camera = options.take_int("camera", 0, 0, 1000);
    const PlaybackOptions playback = take_playback_options(options);
    options.require_no_problem();
    if (options.value().empty())
        throw LastingError("The camera 'recording' needs a file, as in recording:FILE.mkv.");
    const std::string& file = options.value();
    const std::shared_ptr<const record::RecordingFile> opened = record::RecordingFile::open(file);
    for (const std::string& remark : record::remarks_on_files(*opened))
        log::warning("capture", remark, {{"file", file}});
    for (const record::Segment& segment : opened->segments())
        for (const std::string& remark : record::remarks_on(segment))
            log::warning("capture", remark, {{"file", segment.file.empty() ? file : segment.file}});
    auto frames = std::make_unique<RecordedFrames>(opened, std::size_t(camera), file,
                                                   RecordedFrames::any_place);
    if (frames->frames() == 0)
        throw Error("'" + file + "' holds no frame of camera " + std::to_string(camera) + ".");
    if (std::size_t(playback.start) >= frames->frames())
        throw Error("'" + file + "' has " + std::to_string(frames->frames()) +
                    " frames, so start=" + std::to_string(playback.start) + " is too far.");
    if (!frames->offset())
        throw Error("None of the pictures of camera " + std::to_string(camera) + " in '" + file +
                    "' can be decoded.");
    CameraInfo info = frames->info();
    std::unique_ptr<Recording> recording = std::move(frames);
    // Preloads only on request: decoding is cheap.
    if (playback.preload.value_or(false)) {
        auto& source = static_cast<RecordedFrames&>(*recording);
        recording = std::make_unique<MemoryRecording>(source, source.frames(), progress);
    }
    return make_recorded_camera(std::move(info), std::move(recording), playback);
}

}  // namespace theatron::capture
