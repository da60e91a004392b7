// SPDX-License-Identifier: Apache-2.0
#include "face/osc_face.h"

#include <cmath>

namespace theatron::face {
namespace {

// The last part of an address, or the text that a message carries as its name.
std::string_view name_in(const OscMessage& message) {
    if (!message.text.empty())
        return message.text;
    return message.address.substr(message.address.rfind('/') + 1);
}

// Trackers stay within -1..1; a little more is rounding.
bool is_plausible(float value) {
    return std::isfinite(value) && std::fabs(value) <= 2;
}

}  // namespace

OscFace::OscFace()
    : unified_(table_of(Source::unified).inputs.size()),
      arkit_(channel_count),
      has_unified_(unified_.size()),
      has_arkit_(channel_count),
      binary_(unified_.size()) {}

bool OscFace::is_flood(TimePoint now) {
    if (now - second_began_ >= 1s || now < second_began_) {
        second_began_ = now;
        messages_of_second_ = 0;
    }
    return ++messages_of_second_ > max_messages_per_second;
}

bool OscFace::use_binary(std::string_view name, bool is_set) {
    constexpr std::string_view negative = "Negative";
    const SourceTable& table = table_of(Source::unified);
    std::optional<std::size_t> input;
    unsigned bit = 0;
    if (name.size() > negative.size() && name.substr(name.size() - negative.size()) == negative) {
        input = table.input_of(name.substr(0, name.size() - negative.size()));
    } else {
        std::size_t end = name.size();
        for (unsigned place = 1; end > 0 && name[end - 1] >= '0' && name[end - 1] <= '9';
             place *= 10)
            if (place > 100)
                return false;
            else
                bit += unsigned(name[--end] - '0') * place;
        if (bit == 0 || bit > 128 || (bit & (bit - 1)) != 0)
            return false;
        input = table.input_of(name.substr(0, end));
    }
    if (!input)
        return false;
    Binary& binary = binary_[*input];
    if (bit == 0)
        binary.is_negative = is_set;
    binary.known |= bit;
    binary.set = is_set ? binary.set | bit : binary.set & ~bit;
    if (binary.known == 0)
        return true;
    const float size = float(binary.set) / float(binary.known);
    unified_[*input] = binary.is_negative ? -size : size;
    has_unified_[*input] = true;
    return true;
}

bool OscFace::use(const OscMessage& message) {
    const std::string_view name = name_in(message);
    const auto input = table_of(Source::unified).input_of(name);
    const auto channel = input ? std::nullopt : channel_of(name);
    if (!input && !channel) {
        const bool is_used = message.is_truth && use_binary(name, message.value != 0);
        ++(is_used ? counts_.used : counts_.unknown);
        return is_used;
    }
    if (!message.has_value || message.is_truth || !is_plausible(message.value)) {
        ++counts_.no_number;
        return false;
    }
    if (input) {
        unified_[*input] = message.value;
        has_unified_[*input] = true;
    } else {
        arkit_[*channel] = message.value;
        has_arkit_[*channel] = true;
    }
    ++counts_.used;
    return true;
}

bool OscFace::take(ByteView packet, TimePoint now) {
    ++counts_.packets;
    bool is_used = false;
    const Status status = read_osc(packet, [&](const OscMessage& message) {
        if (is_flood(now))
            ++counts_.flooded;
        else
            is_used |= use(message);
    });
    if (status != Status::ok)
        ++counts_.refused;
    return is_used;
}

Mapped OscFace::mapped() const {
    Mapped result = map_inputs(Source::unified, unified_, has_unified_);
    const Mapped arkit = map_inputs(Source::arkit, arkit_, has_arkit_);
    for (std::size_t i = 0; i < channel_count; ++i)
        if (arkit.present[i])
            result.values[i] = arkit.values[i];
    result.present |= arkit.present;
    return result;
}

}  // namespace theatron::face
