// SPDX-License-Identifier: Apache-2.0
#include "send/camera_lane.h"

#include <cassert>

#include "base/fault.h"
#include "base/log.h"
#include "base/outside_text.h"
#include "geometry/screen.h"

namespace theatron::send {
namespace {

// If no frame comes in this time, a requested key frame is made of the last one:
// a participant joined a camera that is stale or has ended.
constexpr Duration least_key_patience = 100ms, most_key_patience = 1s;

// As the lines of filters (docs/filters.md), with the region that operators have drawn.
std::string spelling_of(const filter::ChainSettings& filter,
                        const std::optional<capture::Crop>& crop) {
    std::string text = filter.spelling();
    if (crop)
        text += (text.empty() ? "" : "+") + std::string("region:x=") + std::to_string(crop->x) +
                ",y=" + std::to_string(crop->y) + ",width=" + std::to_string(crop->size.width) +
                ",height=" + std::to_string(crop->size.height);
    return text;
}

// `in` without measurements outside of the crop; in `out`, whose memory is reused.
DepthView inside_of(const capture::Crop& crop, DepthView in, DepthImage& out) {
    out.resize(in.size);
    std::fill(out.pixels.begin(), out.pixels.end(), std::uint16_t(0));
    const MutableDepthView target = out.view();
    for (int y = crop.y; y < crop.y + crop.size.height; ++y)
        std::copy_n(in.row(y) + crop.x, crop.size.width, target.row(y) + crop.x);
    return std::as_const(out).view();
}

}  // namespace

CameraLane::CameraLane(CameraId id, std::unique_ptr<capture::Camera> camera, Events events,
                       Workers& workers, Options options)
    : id_(id),
      events_(std::move(events)),
      workers_(workers),
      options_([&] {
          if (!options.moments)
              options.moments = std::make_shared<SharedMoments>(camera->info().frames_per_second);
          return std::move(options);
      }()),
      waits_(options_.every_frame && camera->skip_none()),
      info_([&] {
          // It may be the name of a folder, which can hold any bytes.
          capture::CameraInfo info = camera->info();
          info.name = clean_text(info.name, wire::max_name);
          return info;
      }()),
      newest_(options_.waiting_frames),
      encoders_(id, encoder_events(), encoder_environment()) {
    told_.camera = id_;
    held_ = waits_;
    capture_ = std::make_unique<CaptureThread>(
        std::move(camera), options_.open_again,
        [this](FramePtr frame) { on_frame(std::move(frame)); }, options_.clock, waits_);
    ticket_ = workers_.look_after([this] { look(); });
}

LaneEncoders::Events CameraLane::encoder_events() {
    LaneEncoders::Events events;
    events.publish = [this](EncodedMedia media) {
        meter_.on_bytes(is_depth(media.header.stream), media.message->size());
        events_.media(std::move(media));
    };
    events.key_due = [this](StreamId stream, SettingId setting) { request_key(stream, setting); };
    events.keeps_up = events_.keeps_up;
    return events;
}

LaneEncoders::Environment CameraLane::encoder_environment() const {
    LaneEncoders::Environment environment;
    environment.now = options_.clock.now;
    environment.behind = [this](std::function<void()> work) {
        workers_.enqueue_behind(std::move(work));
    };
    environment.share =
        encoder_share(info_.frames_per_second, workers_.threads(), options_.cameras);
    environment.make_depth = options_.make_depth;
    environment.make_color = options_.make_color;
    return environment;
}

CameraLane::~CameraLane() {
    workers_.forget(ticket_);
    {
        const std::lock_guard lock(mutex_);
        stopping_ = true;
    }
    room_.notify_all();
    capture_.reset();
    wait_idle();
}

void CameraLane::wait_idle() {
    {
        std::unique_lock lock(mutex_);
        idle_.wait(lock, [this] { return !busy_; });
    }
    encoders_.wait_behind();
}

void CameraLane::set_settings(std::vector<LaneSetting> depth, std::vector<LaneSetting> color) {
    {
        const std::lock_guard lock(mutex_);
        orders_.depth_settings = std::move(depth);
        orders_.color_settings = std::move(color);
        orders_.settings_changed = true;
        wanted_ = true;
    }
    begin_work();
}

void CameraLane::set_region(codec::strata::Region region) {
    assert(codec::strata::is_valid(region));
    const std::lock_guard lock(mutex_);
    orders_.region = std::move(region);
    orders_.settings_changed = true;
}

void CameraLane::set_filter(filter::ChainSettings settings,
                            std::shared_ptr<const filter::Background> background) {
    const std::lock_guard lock(mutex_);
    orders_.filter = std::move(settings);
    orders_.background = std::move(background);
    orders_.filter_changed = true;
}

void CameraLane::set_crop(std::optional<capture::Crop> crop) {
    assert(!crop || capture::lies_in(*crop, info_.calibration.depth.size));
    const std::lock_guard lock(mutex_);
    orders_.crop = crop;
    orders_.filter_changed = true;
}

void CameraLane::hold(bool held) {
    {
        const std::lock_guard lock(mutex_);
        held_ = held;
        wanted_ |= newest_.waiting();
    }
    begin_work();
}

void CameraLane::close() {
    const std::lock_guard lock(mutex_);
    closed_ = true;
    room_.notify_all();
}

std::size_t CameraLane::wait_until_encoded(Duration patience) {
    std::unique_lock lock(mutex_);
    idle_.wait_for(lock, patience, [this] { return !busy_ && !newest_.waiting(); });
    return newest_.size() + has_frame_in_work_;
}

void CameraLane::request_key(StreamId stream, SettingId setting) {
    const std::lock_guard lock(mutex_);
    orders_.keys.insert({stream, setting});
}

// On the camera's thread.
void CameraLane::on_frame(FramePtr frame) {
    const FrameTimes& times = frame->times;
    const auto tag = options_.moments->tag(id_, times.captured, !is_screen(info_.calibration));
    const TimePoint came = now();
    meter_.on_frame(came, times.captured, times.delivered, tag.offset);
    events_.frame(frame);
    if (tag.pass_over && options_.one_per_moment)
        return meter_.on_drop(DropReason::moment);
    {
        std::unique_lock lock(mutex_);
        if (waits_)
            room_.wait(lock, [this] {
                return stopping_ || closed_ || newest_.size() < options_.waiting_frames;
            });
        if (closed_)
            return;
        if (newest_.put({std::move(frame), tag.moment}))
            meter_.on_drop(DropReason::newer);
        frame_came_ = came;
        wanted_ = true;
    }
    begin_work();
}

Duration CameraLane::key_patience() const {
    const double fps = info_.frames_per_second;
    return std::clamp(fps > 0 ? seconds_to_duration(2 / fps) : Duration(0), least_key_patience,
                      most_key_patience);
}

// Every 20 ms, on the workers' thread for periodic calls.
void CameraLane::look() {
    const capture::WatchedCamera::Status status = capture_->look();
    {
        const std::lock_guard lock(status_mutex_);
        status_ = status;
    }
    const std::string filter = meter_.filter(), device = meter_.filter_device();
    if (status.condition != told_.condition || status.problem != told_.problem ||
        filter != told_.filter || device != told_.filter_device) {
        told_.filter = filter;
        told_.filter_device = device;
        told_.condition = status.condition;
        told_.problem = status.problem;
        events_.state(told_);
    }
    {
        const std::lock_guard lock(mutex_);
        // Where every frame is wanted once, keys wait for the next one.
        const bool is_wanted = !waits_ && (!orders_.keys.empty() || repeat_waits_);
        if (!is_wanted || now() - frame_came_ < key_patience())
            return;
        wanted_ = true;
    }
    begin_work();
}

void CameraLane::begin_work() {
    {
        const std::lock_guard lock(mutex_);
        if (busy_ || stopping_ || held_ || !wanted_)
            return;
        busy_ = true;
        wanted_ = false;
    }
    workers_.enqueue([this] { work(); });
}

void CameraLane::work() {
    std::optional<Captured> next;
    {
        const std::lock_guard lock(mutex_);
        // Held since it was enqueued.
        if (held_) {
            wanted_ = true;
            busy_ = false;
            idle_.notify_all();
            return;
        }
        next = newest_.take(Duration(0));
        has_frame_in_work_ = next.has_value();
    }
    room_.notify_one();
    bool ready = false;
    if (!contain("encode", [&] { ready = prepare(std::move(next)); }))
        failed_ = true;
    if (ready)
        encode_frame();
    else
        end_work();
}

void CameraLane::end_work() {
    if (failed_.exchange(false)) {
        // The frame is lost. The filters may hold anything; encoders go on with key frames.
        chain_.reset();
        filtered_at_ = {};
    }
    bool more;
    {
        const std::lock_guard lock(mutex_);
        has_frame_in_work_ = false;
        more = (wanted_ || newest_.waiting()) && !stopping_ && !held_;
        wanted_ = wanted_ && !more;
        busy_ = more;
        // Notified under the lock: the lane may be gone as soon as it is free.
        if (!more)
            idle_.notify_all();
    }
    // Behind the other lanes, so that each gets its turn.
    if (more)
        workers_.enqueue([this] { work(); });
}

bool CameraLane::prepare(std::optional<Captured> next) {
    take_orders();
    // Read after the orders, so that a repeat is never older than the order that asked for it.
    const TimePoint begin = now();
    LaneEncoders::For meant = LaneEncoders::For::all;
    if (next) {
        last_ = std::move(next);
        last_has_number_ = false;
        if (encoders_.empty()) {
            filtered_at_ = {};
            return false;
        }
        meter_.on_stage(Stage::queue, begin - last_->frame->times.delivered);
        filter_frame();
    } else {
        const auto again = waits_ ? std::nullopt : repeats(begin);
        if (!again)
            return false;
        meant = *again;
        // The frame came without a receiver, or before the filters changed.
        if (filtered_at_ == TimePoint{})
            filter_frame();
    }
    prepare_frame(begin, meant);
    return true;
}

// The settings for which the last frame is to be encoded again now; none: it is not. Keys that are
// wanted wait for a frame, or for look().
std::optional<LaneEncoders::For> CameraLane::repeats(TimePoint begin) {
    if (!last_ || (keys_.empty() && !encoders_.has_new()))
        return std::nullopt;
    const std::lock_guard lock(mutex_);
    const bool is_early = repeated_ != TimePoint{} && begin - repeated_ < repeat_interval;
    const bool stands = begin - frame_came_ >= key_patience();
    repeat_waits_ = is_early;
    if (!is_early && stands && !keys_.empty()) {
        repeated_ = begin;
        return LaneEncoders::For::all;
    }
    orders_.keys.merge(keys_);
    keys_.clear();
    if (is_early || !encoders_.has_new())
        return std::nullopt;
    repeated_ = begin;
    return LaneEncoders::For::new_ones;
}

void CameraLane::take_orders() {
    const std::lock_guard lock(mutex_);
    if (std::exchange(orders_.settings_changed, false)) {
        encoders_.set_settings(orders_.depth_settings, orders_.color_settings);
        encoders_.set_region(orders_.region);
    }
    if (std::exchange(orders_.filter_changed, false)) {
        // A screen's plane is not measured.
        filter_ = is_screen(info_.calibration) ? filter::ChainSettings{} : orders_.filter;
        background_ = orders_.background;
        crop_ = orders_.crop;
        chain_.reset();
        filtered_at_ = {};
        meter_.on_filter_device({});
        meter_.on_filter(spelling_of(filter_, crop_));
    }
    keys_.merge(orders_.keys);
    orders_.keys.clear();
}

// Filters the frame's depth into filtered_, if there is a filter.
void CameraLane::filter_frame() {
    filtered_at_ = {};
    if (filter_.off() && !crop_)
        return;
    const Frame& frame = *last_->frame;
    if (!filter_.off() && (!chain_ || chain_->size() != frame.depth.size)) {
        filter::ChainCamera camera;
        camera.size = frame.depth.size;
        camera.depth_unit_mm = info_.calibration.depth_unit_mm;
        camera.background = background_.get();
        chain_ = std::make_unique<filter::DeviceChain>(filter_, camera, [this] { return now(); });
        meter_.on_filter_device(chain_->device());
    }
    const TimePoint begin = now();
    const TimePoint captured = frame.times.captured;
    filtered_ = chain_ ? chain_->apply(frame.depth.view(), captured - filtered_captured_)
                       : frame.depth.view();
    if (crop_ && capture::lies_in(*crop_, frame.depth.size))
        filtered_ = inside_of(*crop_, filtered_, cropped_);
    filtered_captured_ = captured;
    filtered_at_ = now();
    meter_.on_stage(Stage::filter, filtered_at_ - begin);
    // Only a chain that has a remark may have changed its device.
    if (const std::string remark = chain_ ? chain_->take_remark() : ""; !remark.empty()) {
        meter_.on_filter_device(chain_->device());
        log::warning("filter", remark, {{"camera", info_.name}});
    }
}

void CameraLane::prepare_frame(TimePoint begin, LaneEncoders::For meant) {
    const Frame& frame = *last_->frame;
    const bool filtered = filtered_at_ != TimePoint{};
    picture_ = {};
    // A new setting has the number that the others had, so that none of them misses one.
    const bool has_number = meant == LaneEncoders::For::new_ones && last_has_number_;
    picture_.header.frame = has_number ? next_number_ - 1 : next_number_++;
    last_has_number_ = true;
    picture_.meant = meant;
    picture_.header.moment = last_->moment;
    picture_.header.captured = frame.times.captured;
    picture_.header.delivered = frame.times.delivered;
    picture_.header.filtered = filtered_at_;
    picture_.depth = filtered ? filtered_ : frame.depth.view();
    picture_.begun = begin;
}

// Neither thread waits for the other: the one that is done last ends the work.
void CameraLane::encode_frame() {
    const bool color = encoders_.has_color() && !last_->frame->color.empty();
    const bool two_threads = color && encoders_.has_depth() && color_took_ > worth_a_thread &&
                             workers_.has_idle_thread();
    color_waits_ = color;
    unfinished_parts_ = two_threads ? 2 : 1;
    if (two_threads)
        workers_.enqueue_first([this] {
            encode_color();
            end_part();
        });
    if (encoders_.has_depth() && !contain("encode", [this] { encode_depth(); }))
        failed_ = true;
    encode_color();
    end_part();
}

void CameraLane::end_part() {
    if (--unfinished_parts_ > 0)
        return;
    keys_.clear();
    meter_.on_stage(Stage::lane, now() - picture_.begun);
    end_work();
}

void CameraLane::encode_depth() {
    const TimePoint start = now();
    encoders_.encode_depth(picture_.depth, picture_.header, keys_, picture_.meant);
    meter_.on_stage(Stage::depth_encode, now() - start);
}

void CameraLane::encode_color() {
    if (!color_waits_.exchange(false))
        return;
    const bool done = contain("encode", [this] {
        const TimePoint start = now();
        if (encoders_.encode_color(last_->frame, picture_.header, keys_, picture_.meant) > 0)
            meter_.on_damaged_color();
        color_took_ = now() - start;
        meter_.on_stage(Stage::color_encode, color_took_);
    });
    if (!done)
        failed_ = true;
}

LaneFigures CameraLane::figures() const {
    LaneFigures figures = meter_.figures(now());
    figures.encoders = encoders_.figures();
    figures.name = info_.name;
    const std::lock_guard lock(status_mutex_);
    figures.camera = status_;
    const auto& faults = status_.figures;
    figures.dropped[std::size_t(DropReason::repeated)] = faults.repeated_frames;
    figures.dropped[std::size_t(DropReason::time_jump)] = faults.jumped_frames;
    return figures;
}

}  // namespace theatron::send
