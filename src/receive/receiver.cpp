// SPDX-License-Identifier: Apache-2.0
#include "receive/receiver.h"

#include <algorithm>

#include "base/error.h"
#include "base/frame_order.h"
#include "codec/strata.h"
#include "geometry/calibration.h"
#include "phrases/phrase.h"
#include "video/depth_codecs.h"
#include "video/reduced_size.h"
#include "wire/no_codec.h"

namespace theatron::receive {
namespace {

// A request for a key frame is repeated after this time without one.
constexpr Duration key_patience = std::chrono::milliseconds(700);

// The place of a camera does not concern its decoders.
bool has_equal_pictures(const Bytes& a, const Bytes& b) {
    if (a == b)
        return true;
    const auto one = decode_calibration(a), other = decode_calibration(b);
    return one && other && one->depth == other->depth && one->color == other->color;
}

}  // namespace

std::size_t max_media_size(const wire::Camera& camera, StreamId stream) {
    const auto calibration = decode_calibration(camera.calibration);
    if (!calibration)
        return 0;
    if (stream == camera.depth_stream)
        return max_media_size(calibration->depth.size.area());
    return stream == camera.color_stream ? max_media_size(calibration->color.size.area()) : 0;
}

void Receiver::set_cameras(const std::vector<wire::Camera>& cameras) {
    const auto stays = [&](CameraId id) {
        return std::any_of(cameras.begin(), cameras.end(), [&](const wire::Camera& camera) {
            return camera.id == id && camera.has_color == cameras_.at(id).has_color &&
                   has_equal_pictures(camera.calibration, cameras_.at(id).calibration);
        });
    };
    std::erase_if(streams_, [&](const auto& entry) { return !stays(entry.second.camera); });
    std::erase_if(cameras_, [&](const auto& entry) { return !stays(entry.first); });
    for (const wire::Camera& camera : cameras) {
        const auto calibration = decode_calibration(camera.calibration);
        if (!calibration || cameras_.contains(camera.id))
            continue;
        cameras_[camera.id].calibration = camera.calibration;
        cameras_[camera.id].has_color = camera.has_color;
        Stream& depth = streams_[camera.depth_stream];
        depth.camera = camera.id;
        depth.is_depth = true;
        depth.size = calibration->depth.size;
        depth.max_message = max_media_size(depth.size.area());
        if (!camera.has_color)
            continue;
        Stream& color = streams_[camera.color_stream];
        color.camera = camera.id;
        color.size = calibration->color.size;
        color.max_message = max_media_size(color.size.area());
    }
}

void Receiver::set_settings(const std::vector<wire::StreamSetting>& settings) {
    std::string problem;
    for (const wire::StreamSetting& s : settings) {
        const auto found = streams_.find(s.stream);
        if (found == streams_.end() || found->second.setting == s.setting)
            continue;
        Stream& stream = found->second;
        const bool changes_time = s.past || stream.past;
        if (changes_time)
            set_past(stream, s.past);
        if (s.codec == wire::no_codec) {
            stop(stream);
            continue;
        }
        const std::string unknown = set_codec(stream, s);
        if (unknown.empty()) {
            if (stream.is_depth)
                cameras_[stream.camera].has_depth = true;
            stream.setting = s.setting;
            stream.codec = s.codec;
            stream.asked_for_key = false;
            continue;
        }
        problem = problem.empty() ? unknown : problem;
        // Pictures that are still on their way would be taken for those of the other time.
        if (changes_time)
            stream.setting.reset();
    }
    if (!problem.empty())
        throw Error(say(Phrase::unknown_sending, problem));
}

std::string Receiver::set_codec(Stream& stream, const wire::StreamSetting& setting) const {
    if (stream.is_depth) {
        const auto parsed = video::parse_depth_setting(setting.codec);
        if (!parsed.problem.empty())
            return parsed.problem;
        stream.depth =
            std::make_unique<codec::DepthStreamDecoder>(video::make_depth_decoder(parsed.setting));
        stream.depth_setting = parsed.setting;
        stream.depth_is_lossless = video::make_depth_codec(parsed.setting)->lossless();
        return "";
    }
    stream.color_is_automatic = setting.codec == video::auto_color;
    const auto parsed =
        video::parse_color_setting(stream.color_is_automatic ? std::string("jpeg") : setting.codec);
    if (parsed.problem.empty())
        set_color_codec(stream, parsed.setting.id);
    return parsed.problem;
}

void Receiver::stop(Stream& stream) {
    stream.setting.reset();
    stream.codec = wire::no_codec;
    stream.depth.reset();
    stream.color.reset();
    stream.submitted.clear();
    stream.color_reference.reset();
    stream.counting = false;
    CameraImages& camera = cameras_[stream.camera];
    camera.depth.reset();
    if (stream.is_depth)
        camera.has_depth = false;
    else
        camera.color.reset();
}

// Between the past and the present frame numbers jump, and an image that waits has no partner.
void Receiver::set_past(Stream& stream, bool past) {
    stream.past = past;
    stream.counting = false;
    CameraImages& camera = cameras_[stream.camera];
    camera.depth.reset();
    camera.color.reset();
}

void Receiver::add_age(Stream& stream, double ms) {
    if (stream.past)
        return;
    stream.age_ms = ms;
    stream.ages.add(ms);
}

void Receiver::add_decode_time(Stream& stream, Duration time) {
    constexpr double newest_share = 0.1;
    const double ms = to_ms(time);
    stream.decode_ms += (stream.decode_ms > 0 ? newest_share : 1) * (ms - stream.decode_ms);
}

Status Receiver::on_media(ByteView message, TimePoint now) {
    const auto header = wire::parse_media_header(message);
    if (!header) {
        ++refused_;
        return header.error();
    }
    const auto found = streams_.find(header->stream);
    // Frames of the setting before the last change may still be on their way.
    if (found == streams_.end() || found->second.setting != header->setting)
        return Status::ok;

    Stream& stream = found->second;
    if (message.size() > stream.max_message) {
        ++refused_;
        return Status::too_large;
    }
    count(stream, *header, message.size(), now);
    const ByteView payload = wire::media_payload(message);
    const Status status = stream.is_depth ? decode_depth(stream, *header, payload, now)
                                          : decode_color(stream, *header, payload, now);
    if (status == Status::ok)
        return status;
    ++stream.dropped;
    if (status != Status::missing_reference)
        ++refused_;
    // A frame of an upper layer is only skipped: the next of layer 0 does not need it.
    if (header->temporal_layer == 0)
        ask_for_key(header->stream, stream, now);
    return status;
}

void Receiver::count(Stream& stream, const wire::MediaHeader& header, std::size_t size,
                     TimePoint now) {
    const std::int32_t step = frames_after(header.frame, stream.newest);
    if (stream.counting && step > 1)
        stream.dropped += std::uint64_t(step - 1);
    if (!stream.counting || step > 0)
        stream.newest = header.frame;
    stream.counting = true;
    stream.bytes += size;
    stream.bit_rate.add(now, double(size) * 8e-6);
}

Status Receiver::decode_depth(Stream& stream, const wire::MediaHeader& header, ByteView payload,
                              TimePoint now) {
    const auto size = stream.depth->read_size(payload);
    if (!size)
        return size.error();
    if (*size != stream.size)
        return Status::size_mismatch;
    const std::shared_ptr<CameraFrame> frame = frames_.take();
    frame->depth.resize(*size);
    const codec::FrameLink link{header.frame, header.reference, header.temporal_layer, header.key};
    if (const Status s = stream.depth->decode(link, payload, frame->depth.view()); s != Status::ok)
        return s;

    const TimePoint decoded = events_.now ? events_.now() : now;
    if (header.key)
        stream.asked_for_key = false;
    frame->camera = stream.camera;
    frame->number = header.frame;
    frame->moment = header.moment;
    frame->past = stream.past;
    frame->times = {};
    frame->times.captured = header.captured;
    frame->times.delivered = header.delivered;
    frame->times.filtered = header.filtered;
    frame->times.encoded = header.encoded;
    frame->times.sent = header.sent;
    frame->times.received = now;
    frame->times.decoded = decoded;
    ++stream.frames;
    stream.frame_rate.add(decoded);
    add_age(stream, to_ms(decoded - header.captured));
    add_decode_time(stream, decoded - now);

    stream.newest_captured = header.captured;
    stream.exact = exactness(stream, payload);

    CameraImages& camera = cameras_[stream.camera];
    // Its colour never came: the depth image is shown with an older one.
    if (camera.depth)
        hand_on(camera);
    camera.depth = frame;
    if (!camera.has_color ||
        (camera.color && frames_after(camera.color_number, frame->number) >= 0))
        hand_on(camera);
    return Status::ok;
}

// `payload` has been decoded.
Exactness Receiver::exactness(const Stream& stream, ByteView payload) {
    if (stream.depth_is_lossless)
        return Exactness::everywhere;
    if (stream.depth_setting.id != codec::DepthCodecId::strata)
        return Exactness::nowhere;
    const auto exact = codec::read_strata_exactness(payload);
    if (exact && exact->whole_image)
        return Exactness::everywhere;
    return exact && !exact->region.empty() ? Exactness::region : Exactness::nowhere;
}

void Receiver::set_color_codec(Stream& stream, video::ColorCodecId codec) const {
    stream.color =
        events_.make_color ? events_.make_color(codec) : video::make_color_decoder(codec);
    stream.submitted.clear();
    stream.color_codec = codec;
    stream.color_reference.reset();
}

// Automatic colour may change its codec with a key frame.
Status Receiver::follow_color_codec(Stream& stream, const wire::MediaHeader& header) const {
    const auto codec = video::ColorCodecId(header.codec);
    const bool is_another = codec != stream.color_codec;
    if (is_another) {
        if (!stream.color_is_automatic ||
            (codec != video::ColorCodecId::jpeg && codec != video::ColorCodecId::h264))
            return Status::malformed;
        if (!header.key)
            return Status::missing_reference;
        if (!video::missing_color_decoder({codec, ""}).empty())
            return Status::unsupported;
        set_color_codec(stream, codec);
    }
    // The codec of the first picture is known with that picture.
    if (stream.color_is_automatic && (is_another || stream.codec == video::auto_color))
        stream.codec = std::string(video::auto_color) +
                       (codec == video::ColorCodecId::h264 ? ": h264" : ": jpeg");
    return Status::ok;
}

Status Receiver::decode_color(Stream& stream, const wire::MediaHeader& header, ByteView payload,
                              TimePoint now) {
    if (const Status s = follow_color_codec(stream, header); s != Status::ok)
        return s;
    // Checked before any memory is allocated for the picture.
    const auto size = video::read_color_size(stream.color_codec, payload);
    if (!size)
        return size.error();
    const bool may_be_reduced =
        stream.color_is_automatic && stream.color_codec == video::ColorCodecId::jpeg;
    if (may_be_reduced ? !video::is_reduced(*size, stream.size) : *size != stream.size)
        return Status::size_mismatch;
    const auto reference = std::exchange(stream.color_reference, std::nullopt);
    if (!header.key && reference != header.reference)
        return Status::missing_reference;
    if (const Status s = stream.color->submit(payload, header.frame); s != Status::ok) {
        take_pictures(header.stream, stream, now);
        return s;
    }
    stream.color_reference = header.frame;
    if (header.key)
        stream.asked_for_key = false;
    stream.submitted.push_back({header.frame, header.captured, now});
    take_pictures(header.stream, stream, now);
    return Status::ok;
}

void Receiver::take_pictures(StreamId id, Stream& stream, TimePoint now) {
    while (auto decoded = stream.color->poll()) {
        // A decoder leaves pictures out where nobody polls.
        while (!stream.submitted.empty() && stream.submitted.front().frame != decoded->frame)
            stream.submitted.pop_front();
        if (stream.submitted.empty())
            continue;
        const Stream::Submitted submitted = stream.submitted.front();
        stream.submitted.pop_front();
        const TimePoint done = events_.now ? events_.now() : now;
        ++stream.frames;
        stream.newest_captured = submitted.captured;
        stream.frame_rate.add(done);
        add_age(stream, to_ms(done - submitted.captured));
        add_decode_time(stream, done - submitted.arrived);

        CameraImages& camera = cameras_[stream.camera];
        const std::shared_ptr<ColorImage> image = colors_.take();
        std::swap(*image, decoded->image);
        stream.color->recycle(std::move(decoded->image));
        camera.color = image;
        camera.color_number = decoded->frame;
        if (camera.depth && frames_after(camera.color_number, camera.depth->number) >= 0)
            hand_on(camera);
        else if (!camera.has_depth)
            hand_on_color(stream, submitted, done);
    }
    const std::size_t failures = stream.color->take_failures();
    if (failures == 0)
        return;
    stream.decoder_failures += failures;
    stream.dropped += failures;
    stream.color_reference.reset();
    stream.submitted.clear();
    ask_for_key(id, stream, now);
}

void Receiver::poll(TimePoint now) {
    for (auto& [id, stream] : streams_)
        if (stream.color && stream.setting)
            take_pictures(id, stream, now);
}

std::size_t Receiver::pending() const {
    std::size_t sum = 0;
    for (const auto& [id, stream] : streams_)
        if (stream.color)
            sum += stream.color->pending();
    return sum;
}

void Receiver::hand_on(CameraImages& camera) {
    camera.depth->color = camera.color;
    events_.frame(std::exchange(camera.depth, nullptr));
}

void Receiver::hand_on_color(const Stream& stream, const Stream::Submitted& submitted,
                             TimePoint done) {
    const std::shared_ptr<CameraFrame> frame = frames_.take();
    frame->camera = stream.camera;
    frame->number = submitted.frame;
    frame->moment = submitted.captured;
    frame->past = stream.past;
    frame->times = {};
    frame->times.captured = submitted.captured;
    frame->times.received = submitted.arrived;
    frame->times.decoded = done;
    frame->depth.resize({});
    frame->color = cameras_[stream.camera].color;
    events_.frame(frame);
}

void Receiver::ask_for_key(StreamId id, Stream& stream, TimePoint now) {
    if (stream.asked_for_key && now - stream.asked_at < key_patience)
        return;
    stream.asked_for_key = true;
    stream.asked_at = now;
    events_.needs_key(id, *stream.setting);
}

std::vector<StreamFigures> Receiver::figures(TimePoint now) {
    std::vector<StreamFigures> result;
    for (auto& [id, s] : streams_) {
        const double age_now = s.newest_captured ? to_ms(now - *s.newest_captured) : 0;
        if (!s.setting || s.newest_captured)
            s.awaited_since.reset();
        else if (!s.awaited_since)
            s.awaited_since = now;
        const double awaited = s.awaited_since ? to_ms(now - *s.awaited_since) : 0;
        sort_ages(s);
        result.push_back({id,
                          s.codec,
                          s.frame_rate.per_second(now),
                          s.bit_rate.per_second(now),
                          s.frames,
                          s.bytes,
                          s.dropped,
                          s.newest,
                          s.age_ms,
                          age_now,
                          s.exact,
                          s.age_p50_ms,
                          s.age_p95_ms,
                          s.age_p99_ms,
                          s.age_max_ms,
                          s.past,
                          s.decode_ms,
                          s.decoder_failures,
                          awaited,
                          s.newest_captured.has_value()});
    }
    return result;
}

void Receiver::sort_ages(Stream& stream) {
    constexpr std::uint64_t many = 15;
    const bool few_known = stream.frames < 4 * many;
    if (stream.frames == stream.sorted_at ||
        (!few_known && stream.frames - stream.sorted_at < many))
        return;
    stream.sorted_at = stream.frames;
    stream.age_p50_ms = stream.ages.percentile(0.5);
    stream.age_p95_ms = stream.ages.percentile(0.95);
    stream.age_p99_ms = stream.ages.percentile(0.99);
    stream.age_max_ms = stream.ages.max();
}

void Receiver::forget_ages() {
    for (auto& [id, s] : streams_) {
        s.sorted_at = 0;
        s.age_ms = s.age_p50_ms = s.age_p95_ms = s.age_p99_ms = s.age_max_ms = 0;
        s.ages.clear();
        s.awaited_since.reset();
    }
}

void Receiver::reset_figures() {
    for (auto& [id, s] : streams_) {
        s.frames = s.bytes = s.dropped = s.sorted_at = s.decoder_failures = 0;
        s.decode_ms = s.age_p50_ms = s.age_p95_ms = s.age_p99_ms = s.age_max_ms = 0;
        s.ages.clear();
        s.counting = false;
    }
}

}  // namespace theatron::receive
