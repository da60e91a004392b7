// SPDX-License-Identifier: Apache-2.0
#include "codec/strata.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstring>

#include "codec/strata_kernel.h"
#include "codec/strata_memory.h"
#include "codec/strata_payload.h"
#include "codec/strata_values.h"
#include "codec/strata_weights.h"

namespace theatron::codec {
namespace {

using namespace strata;

// Bits of these tokens under ideal probability tables; excludes context bits.
double ideal_bits(const Counts& counts) {
    double bits = 0;
    for (unsigned c = 0; c < coded_contexts; ++c) {
        double total = 0;
        for (unsigned t = 0; t < used_tokens; ++t) {
            const double n = counts[std::size_t(c) * token_count + t];
            if (n == 0)
                continue;
            total += n;
            bits += n * (extra_bits(t) - std::log2(n));
        }
        if (total > 0)
            bits += total * std::log2(total);
    }
    return bits;
}

// The age selects frames on which both predictors are tried (blend_pays): intra
// frames, the first frame that refers to one, and then every eighth. Other frames
// use the predictor of their reference.
std::uint8_t next_age(bool delta, const Memory& before) {
    constexpr int period = 8;
    return delta ? std::uint8_t(before.head->age % period + 1) : std::uint8_t(0);
}

// Temporary buffers for one image. They belong to the thread, not to the codec: the
// codecs of many cameras that take turns on a thread would evict each other's buffers
// from the caches. Tokens overwrite the pixels in place.
struct Scratch {
    std::vector<std::uint16_t> pixels, trial_tokens, extras, words, moved;
    std::vector<std::uint8_t> has_extra;
    TokenCounts token_counts;
    Counts counts;
    Frequencies frequencies;

    static Scratch& of_this_thread() {
        thread_local Scratch scratch;
        return scratch;
    }
};

class Codec final : public DepthCodec {
public:
    explicit Codec(const StrataParams& params) {
        tolerance_.constant = std::uint16_t(params.max_error_mm);
        tolerance_.squared = std::uint16_t(params.noise_scaled);
        everywhere_ = params.everywhere;
    }

    bool lossless() const override { return tolerance_.lossless(); }
    bool temporal() const override { return true; }
    std::size_t max_encoded_size(Size size) const override {
        return strata::max_payload_size(size);
    }

    void set_region(Region region) override {
        assert(strata::is_valid(region));
        region_ = std::move(region);
    }

    std::size_t encode(DepthView depth, const Reference* reference, std::span<std::byte> out,
                       Reference* next) override;
    Result<Size> read_size(ByteView encoded) const override {
        const Result<Payload> payload = read_payload(encoded);
        if (!payload)
            return payload.error();
        return payload->size;
    }
    Status decode(ByteView encoded, const Reference* reference, MutableDepthView out,
                  Reference* next) override;

private:
    void prepare(Size size);
    bool blend_pays(Model model, CodedPixels coded);
    void encode_and_count(const Model& model, const std::uint16_t* pixels,
                          const CodedPixels& coded);
    const std::uint8_t* draw(const Region& region);

    Tolerance tolerance_;
    bool everywhere_ = false;
    Region region_;

    Layout layout_;
    std::vector<std::uint8_t> region_rows_, region_steps_;
    Region drawn_;
    RankTables tables_;
    Bytes side_, own_memory_;
    Slots slots_;
};

void Codec::prepare(Size size) {
    if (layout_.size != size) {
        layout_ = layout_of(size);
        region_steps_.clear();
        drawn_.clear();
    }
    Scratch::of_this_thread().pixels.resize(layout_.coded_values());
}

// The region in step order, redrawn when it changes.
const std::uint8_t* Codec::draw(const Region& region) {
    if (!region_steps_.empty() && drawn_ == region)
        return region_steps_.data();
    const auto [width, height] = layout_.size;
    region_rows_.resize(layout_.size.area());
    region_steps_.assign(layout_.coded_values(), 0);
    drawn_ = region;
    const View<std::uint8_t> rows{region_rows_.data(), layout_.size};
    draw_region(region, rows);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const std::size_t at = std::size_t(layout_.step_of(x, y)) * lane_count;
            region_steps_[at + std::size_t(y % lane_count)] = rows.row(y)[x];
        }
    }
    return region_steps_.data();
}

void Codec::encode_and_count(const Model& model, const std::uint16_t* pixels,
                             const CodedPixels& coded) {
    Scratch& scratch = Scratch::of_this_thread();
    for (Counts& table : scratch.token_counts.of)
        table.fill(0);
    encode_model(model, pixels, coded);
    scratch.counts.fill(0);
    for (const Counts& table : scratch.token_counts.of)
        for (std::size_t i = 0; i < table.size(); ++i)
            scratch.counts[i] += table[i];
}

// Tries both predictors on the 32 rows in the middle of the image.
bool Codec::blend_pays(Model model, CodedPixels coded) {
    Scratch& scratch = Scratch::of_this_thread();
    const int group = (layout_.groups - 1) / 2;
    const std::size_t at = std::size_t(group) * std::size_t(layout_.pitch);
    model.layout.size.height = std::min(lane_count, layout_.size.height - group * lane_count);
    model.layout.groups = 1;
    model.layout.steps = layout_.pitch + skew * (lane_count - 1);
    if (model.reference_depth != nullptr) {
        model.reference_depth += at * plane_stride;
        model.reference_valid += at;
    }
    model.tolerance = {};
    scratch.trial_tokens.resize(model.layout.coded_values());
    coded.token = scratch.trial_tokens.data();
    double bits[2];
    for (const bool blend : {false, true}) {
        model.blend = blend;
        encode_and_count(model, scratch.pixels.data() + at * lane_count, coded);
        bits[blend] = ideal_bits(scratch.counts);
    }
    return bits[true] < bits[false];
}

std::size_t Codec::encode(DepthView depth, const Reference* reference, std::span<std::byte> out,
                          Reference* next) {
    assert(strata::is_codable(depth.size) && out.size() >= max_encoded_size(depth.size));
    prepare(depth.size);
    Scratch& scratch = Scratch::of_this_thread();
    const std::size_t plane = layout_.plane_values();
    scratch.extras.resize(layout_.coded_values());
    scratch.has_extra.resize(std::size_t(layout_.steps));
    scratch.words.resize(max_words(layout_) + 2 * word_slack);

    Payload payload;
    payload.size = depth.size;
    if (everywhere_ || !region_.empty())
        payload.tolerance = tolerance_;

    Memory before;
    payload.delta = reference != nullptr && open_memory(layout_, reference->memory, before);
    Values old_values, values;
    if (payload.delta) {
        old_values = values = before.values();
        // More values than a list holds: encode an intra frame instead.
        if (!values.empty() && !tables_.to_ranks(layout_, depth, values, scratch.pixels.data()))
            payload.delta = false;
    }
    if (!payload.delta) {
        old_values.clear();
        values = find_values(depth, payload.tolerance);
        if (!values.empty())
            tables_.to_ranks(layout_, depth, values, scratch.pixels.data());
    }
    payload.ranks = !values.empty();
    // Ranks save more than a tolerance would (find_values).
    if (payload.ranks)
        payload.tolerance = {};
    const bool lossy = !payload.tolerance.lossless();
    if (lossy)
        payload.region = region_;
    if (!payload.ranks)
        rows_to_steps(layout_, depth, scratch.pixels.data());

    Memory after = make_memory(layout_, next != nullptr ? next->memory : own_memory_);
    Model model;
    model.layout = layout_;
    model.depth = after.depth;
    model.valid = after.valid;
    model.tolerance = payload.tolerance;
    if (lossy)
        model.region = draw(payload.region);
    if (payload.delta) {
        model.reference_depth = before.depth;
        model.reference_valid = before.valid;
        if (old_values.size() != values.size()) {
            scratch.moved.resize(plane);
            RankShift(old_values, values).apply(before.depth, plane, scratch.moved.data());
            model.reference_depth = scratch.moved.data();
        }
    }
    const CodedPixels coded{scratch.pixels.data(), scratch.extras.data(), scratch.has_extra.data(),
                            &scratch.token_counts};
    Equations equations;
    sample_equations(model, scratch.pixels.data(), payload.ranks ? 8 : 40, equations);
    model.weights = solve(equations, payload.delta ? tap_count : intra_taps);
    after.head->age = next_age(payload.delta, before);
    model.blend = after.head->age <= 1 ? blend_pays(model, coded) : before.head->blend != 0;
    after.head->blend = model.blend;
    payload.weights = model.weights;
    payload.blend = model.blend;

    encode_and_count(model, scratch.pixels.data(), coded);
    const Levels& old_levels = payload.delta ? before.head->levels : standard_levels();
    choose_levels(scratch.counts, old_levels, after.head->levels);
    make_frequencies(after.head->levels, scratch.frequencies);

    Stream stream;
    stream.words = scratch.words.data() + word_slack;
    encode_tokens(layout_, coded, scratch.frequencies, stream);

    SideWriter side(side_);
    if (payload.ranks)
        put_values(old_values, values, side);
    put_levels(after.head->levels, old_levels, side);
    side.finish();

    if (next != nullptr) {
        after.head->value_count = std::uint16_t(values.size());
        std::copy(values.begin(), values.end(), after.head->values.begin());
        next->depth.pixels.clear();
    }
    return put_payload(payload, side_, stream, out);
}

Status Codec::decode(ByteView encoded, const Reference* reference, MutableDepthView out,
                     Reference* next) {
    const Result<Payload> payload = read_payload(encoded);
    if (!payload)
        return payload.error();
    if (payload->size != out.size)
        return Status::size_mismatch;
    prepare(out.size);
    Scratch& scratch = Scratch::of_this_thread();

    Memory before;
    if (payload->delta &&
        (reference == nullptr || !open_memory(layout_, reference->memory, before)))
        return Status::missing_reference;
    Values old_values, values;
    if (payload->delta)
        old_values = before.values();
    if (payload->delta && payload->ranks == old_values.empty())
        return Status::malformed;

    Memory after = make_memory(layout_, next != nullptr ? next->memory : own_memory_);
    SideReader side(payload->side);
    if (payload->ranks && !get_values(old_values, values, side))
        return Status::malformed;
    if (!get_levels(payload->delta ? before.head->levels : standard_levels(), after.head->levels,
                    side) ||
        !side.ok())
        return Status::malformed;

    Model model;
    model.layout = layout_;
    model.depth = after.depth;
    model.valid = after.valid;
    model.weights = payload->weights;
    model.blend = payload->blend;
    after.head->blend = payload->blend;
    after.head->age = next_age(payload->delta, before);
    model.tolerance = payload->tolerance;
    if (!payload->tolerance.lossless())
        model.region = draw(payload->region);
    if (payload->delta) {
        model.reference_depth = before.depth;
        model.reference_valid = before.valid;
        if (old_values.size() != values.size()) {
            const std::size_t plane = layout_.plane_values();
            scratch.moved.resize(plane);
            RankShift(old_values, values).apply(before.depth, plane, scratch.moved.data());
            model.reference_depth = scratch.moved.data();
        }
    }

    scratch.words.resize(payload->words.size() / 2 + 2 * word_slack);
    Stream stream;
    stream.states = payload->states;
    stream.words = scratch.words.data() + word_slack;
    stream.word_count = payload->words.size() / 2;
    if constexpr (std::endian::native == std::endian::little)
        std::copy(payload->words.begin(), payload->words.end(),
                  std::as_writable_bytes(std::span(stream.words, stream.word_count)).begin());
    else
        for (std::size_t i = 0; i < stream.word_count; ++i)
            stream.words[i] = load_le<std::uint16_t>(payload->words.data() + 2 * i);

    const std::uint16_t* const depths = payload->ranks ? tables_.depths_of(values) : nullptr;
    if (!decode_steps(model, slots_.of(after.head->levels), stream, scratch.pixels.data()))
        return Status::malformed;
    steps_to_rows(layout_, scratch.pixels.data(), depths, out);
    if (next != nullptr) {
        after.head->value_count = std::uint16_t(values.size());
        std::copy(values.begin(), values.end(), after.head->values.begin());
        next->depth.pixels.clear();
    }
    return Status::ok;
}

}  // namespace

std::unique_ptr<DepthCodec> make_strata(const StrataParams& params) {
    return std::make_unique<Codec>(params);
}

Result<StrataExactness> read_strata_exactness(ByteView encoded) {
    Result<Payload> payload = read_payload(encoded);
    if (!payload)
        return payload.error();
    return StrataExactness{payload->tolerance.lossless(), std::move(payload->region)};
}

}  // namespace theatron::codec
