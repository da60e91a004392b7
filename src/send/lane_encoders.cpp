// SPDX-License-Identifier: Apache-2.0
#include "send/lane_encoders.h"

#include <time.h>

#include <algorithm>
#include <cassert>

#include "video/depth_codecs.h"

namespace theatron::send {
namespace {

// Encoders by their settings: those that stay are taken over, new ones are made.
template <class Encoder, class Make>
std::vector<std::shared_ptr<Encoder>> updated(const std::vector<std::shared_ptr<Encoder>>& old,
                                              const std::vector<LaneSetting>& settings, Make make) {
    std::vector<std::shared_ptr<Encoder>> result;
    for (const LaneSetting& s : settings) {
        const auto same = std::find_if(old.begin(), old.end(),
                                       [&](const auto& e) { return e->setting.id == s.id; });
        if (same != old.end()) {
            result.push_back(*same);
            continue;
        }
        const auto encoder = std::make_shared<Encoder>();
        encoder->setting = s;
        encoder->cost = EncoderCost(expected_cost(s.codec));
        make(*encoder, s.codec);
        result.push_back(encoder);
    }
    return result;
}

template <class E>
void add_figures(const std::vector<std::shared_ptr<E>>& encoders, StreamId stream,
                 std::vector<EncoderFigures>& figures) {
    for (const auto& e : encoders) {
        const std::lock_guard lock(e->mutex);
        figures.push_back({stream, e->setting.id, e->setting.codec, to_ms(e->cost.typical()),
                           e->behind, e->left_out});
    }
}

}  // namespace

Duration thread_cpu_time() {
    timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return Duration(time.tv_sec * 1'000'000 + time.tv_nsec / 1000);
}

LaneEncoders::LaneEncoders(CameraId camera, Events events, Environment environment)
    : camera_(camera), events_(std::move(events)), environment_([&] {
          if (!environment.make_depth)
              environment.make_depth = video::make_depth_encoder;
          if (!environment.make_color)
              environment.make_color = video::make_color_encoder;
          return std::move(environment);
      }()) {}

LaneEncoders::~LaneEncoders() {
    {
        const std::lock_guard lock(behind_mutex_);
        stopping_ = true;
    }
    wait_behind();
}

void LaneEncoders::wait_behind() {
    std::unique_lock lock(behind_mutex_);
    behind_done_.wait(lock, [&] { return behind_ == 0; });
}

void LaneEncoders::set_settings(const std::vector<LaneSetting>& depth,
                                const std::vector<LaneSetting>& color) {
    const std::lock_guard lock(list_mutex_);
    depth_ = updated(depth_, depth, [](Depth& encoder, const std::string& codec) {
        const auto parsed = video::parse_depth_setting(codec);
        assert(parsed.problem.empty());
        encoder.parsed = parsed.setting;
        encoder.codec = std::uint8_t(parsed.setting.id);
    });
    color_ = updated(color_, color, [](Color& encoder, const std::string& codec) {
        if (codec == video::auto_color) {
            // Each picture's header names its codec.
            encoder.parsed.text = codec;
            return;
        }
        const auto parsed = video::parse_color_setting(codec);
        assert(parsed.problem.empty());
        encoder.parsed = parsed.setting;
        encoder.codec = std::uint8_t(parsed.setting.id);
    });
}

void LaneEncoders::set_region(const codec::strata::Region& region) {
    for (const auto& encoder : depth_) {
        const std::lock_guard lock(encoder->mutex);
        encoder->new_region = region;
    }
}

std::vector<EncoderFigures> LaneEncoders::figures() const {
    std::vector<EncoderFigures> figures;
    const std::lock_guard lock(list_mutex_);
    add_figures(depth_, depth_stream(camera_), figures);
    add_figures(color_, color_stream(camera_), figures);
    return figures;
}

void LaneEncoders::publish(wire::MediaHeader& header, ByteView payload) {
    header.payload_size = std::uint32_t(payload.size());
    header.encoded = environment_.now();
    const std::shared_ptr<Bytes> message = messages_.take();
    message->resize(wire::media_header_size);
    wire::write_media_header(header, message->data());
    message->insert(message->end(), payload.begin(), payload.end());
    events_.publish({header, message});
}

template <class E>
void LaneEncoders::choose(const std::vector<std::shared_ptr<E>>& encoders,
                          std::vector<std::size_t>& at_once) {
    if (encoders.size() == 1) {
        at_once.assign(1, 0);
    } else {
        std::vector<EncoderCost> costs;
        std::vector<bool> was_at_once;
        for (const auto& e : encoders) {
            const std::lock_guard lock(e->mutex);
            costs.push_back(e->cost);
            was_at_once.push_back(e->at_once);
        }
        choose_at_once(costs, was_at_once, environment_.share, at_once);
    }
    for (std::size_t i = 0; i < encoders.size(); ++i)
        encoders[i]->at_once = std::find(at_once.begin(), at_once.end(), i) != at_once.end();
}

LaneEncoders::Turn LaneEncoders::begin(Encoder& encoder, bool key) {
    std::unique_lock lock(encoder.mutex);
    encoder.behind = !encoder.at_once;
    // A new one may have waited behind others until it was measured.
    const bool changed =
        encoder.cost.known() && encoder.keeping_up.on_picture(!encoder.busy || encoder.at_once);
    // The encoder cannot keep up: waiting pictures are dropped.
    std::deque<std::function<void()>> given_up;
    const bool may_wait = !encoder.cost.known() || encoder.at_once;
    if (!may_wait)
        given_up.swap(encoder.waiting);
    encoder.left_out += given_up.size();
    encoder.key_asked = encoder.key_asked || !given_up.empty();  // it may have been of one of them
    Turn turn = Turn::now;
    if (!encoder.busy) {
        encoder.busy = true;
    } else if (may_wait && encoder.waiting.size() < max_waiting) {
        turn = Turn::waits;
    } else {
        turn = Turn::left_out;
        encoder.key_asked = encoder.key_asked || key;
        ++encoder.left_out;
    }
    const bool keeps_up = encoder.keeping_up.keeps_up();
    const Duration cpu = encoder.cost.typical();
    lock.unlock();
    if (changed)
        events_.keeps_up(encoder.setting.id, keeps_up, cpu);
    return turn;
}

void LaneEncoders::end(Encoder& encoder, bool done, Duration cpu, StreamId stream) {
    bool asked;
    std::function<void()> next;
    {
        const std::lock_guard lock(encoder.mutex);
        encoder.cost.add(cpu);
        asked = std::exchange(encoder.key_asked, false);
        if (done)
            encoder.key_due = asked;
        encoder.busy = !encoder.waiting.empty();
        if (encoder.busy) {
            next = std::move(encoder.waiting.front());
            encoder.waiting.pop_front();
        }
    }
    if (next)
        go_behind(std::move(next));
    if (asked)
        events_.key_due(stream, encoder.setting.id);
}

bool LaneEncoders::encode(Depth& e, DepthView depth, wire::MediaHeader header, bool key) {
    if (!e.encoder)
        e.encoder = environment_.make_depth(e.parsed);
    std::optional<codec::strata::Region> region;
    {
        const std::lock_guard lock(e.mutex);
        region.swap(e.new_region);
    }
    if (region)
        e.encoder->set_region(std::move(*region));
    e.scratch.resize(std::max(e.scratch.size(), e.encoder->max_encoded_size(depth.size)));
    const auto encoded = e.encoder->encode(depth, header.frame, key, e.scratch);
    header.key = encoded.key;
    header.reference = encoded.reference_frame;
    header.temporal_layer = std::uint8_t(encoded.layer);
    publish(header, ByteView(e.scratch).first(encoded.bytes));
    return true;
}

bool LaneEncoders::encode(Color& e, const ColorData& color, wire::MediaHeader header, bool key) {
    if (!e.encoder)
        e.encoder = environment_.make_color(e.parsed);
    const auto encoded = e.encoder->encode(color, key);
    // A camera's damaged picture is skipped; its depth is not. Later pictures must not refer to
    // data of it that the encoder may have kept.
    if (!encoded)
        return false;
    if (encoded->codec)
        header.codec = std::uint8_t(*encoded->codec);
    header.key = encoded->key;
    header.reference = encoded->key ? header.frame : e.encoded_last;
    e.encoded_last = header.frame;
    publish(header, encoded->bytes);
    return true;
}

template <class E, class Picture>
bool LaneEncoders::encode_and_end(E& encoder, const Picture& picture,
                                  const wire::MediaHeader& header, bool key) {
    // Also where it throws: the next picture is then a key frame.
    struct End {
        LaneEncoders& encoders;
        E& encoder;
        const StreamId stream;
        const Duration began;
        bool done = false;
        ~End() { encoders.end(encoder, done, encoders.environment_.cpu_time() - began, stream); }
    } end{*this, encoder, header.stream, environment_.cpu_time()};
    bool key_due;
    {
        const std::lock_guard lock(encoder.mutex);
        key_due = std::exchange(encoder.key_due, true);  // until it is encoded
    }
    end.done = encode(encoder, picture, header, key || key_due);
    return end.done;
}

template <class E, class Keep, class Picture>
void LaneEncoders::encode_behind(std::shared_ptr<E> encoder, Turn turn, Keep keep, Picture picture,
                                 const wire::MediaHeader& header, bool key) {
    const auto work = [this, encoder, keep = std::move(keep), picture, header, key] {
        bool stopping;
        {
            const std::lock_guard lock(behind_mutex_);
            stopping = stopping_;
        }
        if (stopping) {
            // They own the encoder, and it owns them.
            std::deque<std::function<void()>> given_up;
            const std::lock_guard lock(encoder->mutex);
            given_up.swap(encoder->waiting);
        } else {
            try {
                encode_and_end(*encoder, picture(*keep), header, key);
            } catch (const std::exception&) {
                // Memory is exhausted or a library failed: this picture is missing, the next is a
                // key frame.
            }
        }
        // Notified under the lock: the encoders may be gone as soon as none is behind.
        const std::lock_guard lock(behind_mutex_);
        --behind_;
        behind_done_.notify_all();
    };
    if (turn == Turn::waits) {
        const std::lock_guard lock(encoder->mutex);
        // It may have ended the picture before since begin().
        if (encoder->busy) {
            encoder->waiting.push_back(work);
            return;
        }
        encoder->busy = true;
    }
    go_behind(work);
}

// The work ends with --behind_.
void LaneEncoders::go_behind(std::function<void()> work) {
    {
        const std::lock_guard lock(behind_mutex_);
        ++behind_;
    }
    environment_.behind(std::move(work));
}

bool LaneEncoders::has_new() const {
    const auto is_new = [](const auto& encoder) { return encoder->is_new; };
    return std::any_of(depth_.begin(), depth_.end(), is_new) ||
           std::any_of(color_.begin(), color_.end(), is_new);
}

void LaneEncoders::encode_depth(DepthView depth, wire::MediaHeader header, const WantedKeys& keys,
                                For settings) {
    header.stream = depth_stream(camera_);
    std::shared_ptr<DepthImage> copy;
    const auto encode_with = [&](const std::shared_ptr<Depth>& encoder) {
        if (!is_meant(*encoder, settings))
            return;
        encoder->is_new = false;
        header.setting = encoder->setting.id;
        header.codec = encoder->codec;
        const bool key = keys.contains({header.stream, header.setting});
        const Turn turn = begin(*encoder, key);
        if (turn == Turn::left_out)
            return;
        if (turn == Turn::now && encoder->at_once) {
            encode_and_end(*encoder, depth, header, key);
            return;
        }
        if (!copy) {
            copy = depths_.take();
            copy->resize(depth.size);
            copy_pixels(depth, copy->view());
        }
        encode_behind(
            encoder, turn, std::shared_ptr<const DepthImage>(copy),
            [](const DepthImage& image) { return image.view(); }, header, key);
    };
    choose(depth_, depth_at_once_);
    for (const std::size_t i : depth_at_once_)
        encode_with(depth_[i]);
    for (const auto& encoder : depth_)
        if (!encoder->at_once)
            encode_with(encoder);
}

int LaneEncoders::encode_color(const FramePtr& frame, wire::MediaHeader header,
                               const WantedKeys& keys, For settings) {
    header.stream = color_stream(camera_);
    int damaged = 0;
    const auto encode_with = [&](const std::shared_ptr<Color>& encoder) {
        if (!is_meant(*encoder, settings))
            return;
        encoder->is_new = false;
        header.setting = encoder->setting.id;
        header.codec = encoder->codec;
        const bool key = keys.contains({header.stream, header.setting});
        const Turn turn = begin(*encoder, key);
        if (turn == Turn::now && encoder->at_once)
            damaged += !encode_and_end(*encoder, frame->color, header, key);
        else if (turn != Turn::left_out)
            encode_behind(
                encoder, turn, frame, [](const Frame& f) -> const ColorData& { return f.color; },
                header, key);
    };
    choose(color_, color_at_once_);
    for (const std::size_t i : color_at_once_)
        encode_with(color_[i]);
    for (const auto& encoder : color_)
        if (!encoder->at_once)
            encode_with(encoder);
    return damaged;
}

}  // namespace theatron::send
