// SPDX-License-Identifier: Apache-2.0
// Any bytes, and bytes with the right checksum: what is taken for a network gives probabilities,
// and the same bytes again.
#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "face/network.h"

namespace {

void check(theatron::ByteView bytes) {
    using namespace theatron::face;
    const auto network = parse_network(bytes);
    if (!network)
        return;
    Features features{};
    features.fill(0.5F);
    for (const float value : evaluate(*network, features, ChannelMask().set()))
        if (!std::isfinite(value))
            std::abort();
    const theatron::Bytes again = network_bytes(*network);
    if (!std::equal(again.begin(), again.end(), bytes.begin(), bytes.end()))
        std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const auto input = std::as_bytes(std::span(data, size));
    check(input);
    // Input becomes the weights of a sound file, so that they are reached.
    static const theatron::Bytes sound = theatron::face::network_bytes({});
    theatron::Bytes bytes = sound;
    for (std::size_t i = 0; i < size && 26 + i + 4 < bytes.size(); ++i)
        bytes[26 + i] = input[i];
    std::uint32_t hash = 2166136261U;
    for (std::size_t i = 0; i + 4 < bytes.size(); ++i)
        hash = (hash ^ std::to_integer<std::uint32_t>(bytes[i])) * 16777619U;
    theatron::store_le(bytes.data() + bytes.size() - 4, hash);
    check(bytes);
    return 0;
}
