// SPDX-License-Identifier: Apache-2.0
#include "face/network.h"

#include <algorithm>
#include <cmath>

#include "base/float_bytes.h"

namespace theatron::face {
namespace {

constexpr std::string_view magic = "TFNET";
constexpr std::uint8_t version = 1;
constexpr float max_weight = 10000;

// FNV-1a: damage, not forgery, is what it finds.
std::uint32_t checksum(ByteView bytes) {
    std::uint32_t hash = 2166136261U;
    for (const std::byte byte : bytes)
        hash = (hash ^ std::to_integer<std::uint32_t>(byte)) * 16777619U;
    return hash;
}

// All numbers in the order of the file.
template <class Net, class Each>
void each_number(Net& network, Each&& each) {
    const auto all = [&](auto& numbers) {
        for (auto& number : numbers)
            each(number);
    };
    all(network.mean);
    all(network.scale);
    for (auto& row : network.into_hidden)
        all(row);
    all(network.hidden_bias);
    for (auto& row : network.into_output)
        all(row);
    all(network.output_bias);
}

}  // namespace

Emotions evaluate(const Network& network, const Features& features, const ChannelMask& present) {
    const ChannelMask usable = network.mask & present;
    Features scaled{};
    for (std::size_t i = 0; i < feature_count; ++i)
        if (usable[i % channel_count])
            scaled[i] = std::clamp((features[i] - network.mean[i]) * network.scale[i], -6.F, 6.F);
    Emotions out = network.output_bias;
    std::array<float, hidden_count> sums = network.hidden_bias;
    for (std::size_t i = 0; i < feature_count; ++i)
        for (std::size_t h = 0; h < hidden_count; ++h)
            sums[h] += network.into_hidden[i][h] * scaled[i];
    for (std::size_t h = 0; h < hidden_count; ++h) {
        const float active = std::tanh(sums[h]);
        for (std::size_t o = 0; o < emotion_count; ++o)
            out[o] += network.into_output[o][h] * active;
    }
    const float top = *std::max_element(out.begin(), out.end());
    float total = 0;
    for (float& value : out)
        total += value = std::exp(value - top);
    for (float& value : out)
        value /= total;
    return out;
}

Emotion decide(const Emotions& emotions) {
    const auto top =
        std::size_t(std::max_element(emotions.begin(), emotions.end()) - emotions.begin());
    if (Emotion(top) != Emotion::anger)
        return Emotion(top);
    float next = 0;
    for (std::size_t i = 0; i < emotion_count; ++i)
        if (i != top)
            next = std::max(next, emotions[i]);
    return emotions[top] >= 2 * next ? Emotion::anger : Emotion::neutral;
}

Bytes network_bytes(const Network& network) {
    Bytes bytes;
    ByteWriter out(bytes);
    out.put_bytes(as_bytes(magic));
    out.put(version);
    out.put(std::uint8_t(network.source));
    out.put(std::uint8_t(network.is_synthetic_only));
    out.put(network.own_takes);
    out.put(std::uint64_t(network.mask.to_ullong()));
    out.put(std::uint16_t(feature_count));
    out.put(std::uint16_t(hidden_count));
    out.put(std::uint16_t(emotion_count));
    each_number(network, [&](const float number) { put_f32(out, number); });
    out.put(checksum(bytes));
    return bytes;
}

Result<Network> parse_network(ByteView bytes) {
    ByteReader in(bytes);
    const ByteView start = in.get_bytes(magic.size());
    if (!std::equal(start.begin(), start.end(), as_bytes(magic).begin(), as_bytes(magic).end()))
        return Status::malformed;
    const auto made_by = in.get<std::uint8_t>();
    if (made_by > version)
        return Status::unsupported_version;
    Network network;
    const auto source = in.get<std::uint8_t>();
    const auto synthetic = in.get<std::uint8_t>();
    network.own_takes = in.get<std::uint32_t>();
    const auto mask = in.get<std::uint64_t>();
    const auto features = in.get<std::uint16_t>(), hidden = in.get<std::uint16_t>(),
               outputs = in.get<std::uint16_t>();
    if (!in.ok())
        return Status::truncated;
    if (made_by == 0 || source >= std::size(all_sources) || synthetic > 1 ||
        mask >> channel_count != 0 || features != feature_count || hidden != hidden_count ||
        outputs != emotion_count)
        return Status::malformed;
    network.source = Source(source);
    network.is_synthetic_only = synthetic == 1;
    network.mask = ChannelMask(mask);
    bool is_sound = true;
    each_number(network, [&](float& number) {
        number = get_f32(in);
        is_sound = is_sound && std::isfinite(number) && std::fabs(number) <= max_weight;
    });
    const std::size_t summed = bytes.size() - in.rest().size();
    const auto sum = in.get<std::uint32_t>();
    if (!in.ok())
        return Status::truncated;
    if (!is_sound || sum != checksum(bytes.first(summed)))
        return Status::malformed;
    if (!in.rest().empty())
        return Status::trailing_bytes;
    return network;
}

}  // namespace theatron::face
