// SPDX-License-Identifier: Apache-2.0
#include "face/osc.h"

#include <string>

#include "base/float_bytes.h"

namespace theatron::face {
namespace {

template <class T>
T load_be(ByteView in) {
    using U = std::make_unsigned_t<T>;
    U bits = 0;
    for (std::size_t i = 0; i < sizeof(T); ++i)
        bits = U(U(bits << 8) | std::to_integer<U>(in[i]));
    return T(bits);
}

// Fields in OSC's order: big-endian, each filled up to four bytes.
class OscReader {
public:
    explicit OscReader(ByteView in) : in_(in) {}

    template <class T>
    T number() {
        const ByteView bytes = take(sizeof(T));
        return bytes.empty() ? T{} : load_be<T>(bytes);
    }
    // Ends with a zero, which is not part of the result.
    std::string_view text() {
        const auto* begin = reinterpret_cast<const char*>(in_.data());
        const std::string_view all(begin, in_.size());
        const std::size_t end = all.find('\0');
        if (end == std::string_view::npos) {
            fail();
            return {};
        }
        take(end / 4 * 4 + 4);
        return ok_ ? all.substr(0, end) : std::string_view();
    }
    ByteView take(std::size_t count) {
        if (in_.size() < count) {
            fail();
            return {};
        }
        const ByteView bytes = in_.first(count);
        in_ = in_.subspan(count);
        return bytes;
    }
    void skip_blob() {
        const auto size = number<std::uint32_t>();
        if (size > in_.size())
            return fail();
        take((std::size_t(size) + 3) / 4 * 4);
    }
    bool ok() const { return ok_; }
    bool at_end() const { return in_.empty(); }

private:
    void fail() {
        ok_ = false;
        in_ = {};
    }

    ByteView in_;
    bool ok_ = true;
};

void put_be(Bytes& out, std::uint32_t value) {
    for (int shift = 24; shift >= 0; shift -= 8)
        out.push_back(std::byte(value >> shift));
}

// With one zero or more, to four bytes.
void put_text(Bytes& out, std::string_view text) {
    out.insert(out.end(), as_bytes(text).begin(), as_bytes(text).end());
    out.resize((out.size() / 4 + 1) * 4);
}

float float_of(std::uint32_t bits) {
    std::byte bytes[4];
    store_le(bytes, bits);
    return load_f32(bytes);
}

float double_of(std::uint64_t bits) {
    double value;
    std::memcpy(&value, &bits, sizeof(value));
    return float(value);
}

void set_number(OscMessage& message, float value, bool is_truth = false) {
    if (message.has_value)
        return;
    message.value = value;
    message.has_value = true;
    message.is_truth = is_truth;
}

Status read_message(ByteView packet, const std::function<void(const OscMessage&)>& take) {
    OscReader in(packet);
    OscMessage message;
    message.address = in.text();
    if (!in.ok())
        return Status::truncated;
    if (message.address.empty() || message.address[0] != '/')
        return Status::malformed;
    // Old senders leave the types out; their values cannot be told.
    const std::string_view types = in.at_end() ? std::string_view(",") : in.text();
    if (!in.ok())
        return Status::truncated;
    if (types.empty() || types[0] != ',')
        return Status::malformed;
    for (std::size_t i = 1; i < types.size() && in.ok(); ++i) {
        switch (types[i]) {
            case 'f':
                set_number(message, float_of(in.number<std::uint32_t>()));
                break;
            case 'd':
                set_number(message, double_of(in.number<std::uint64_t>()));
                break;
            case 'i':
                set_number(message, float(in.number<std::int32_t>()));
                break;
            case 'h':
                set_number(message, float(in.number<std::int64_t>()));
                break;
            case 'T':
            case 'F':
                set_number(message, types[i] == 'T' ? 1.F : 0.F, true);
                break;
            case 's':
            case 'S': {
                const std::string_view text = in.text();
                if (i == 1)
                    message.text = text;
                break;
            }
            case 'b':
                in.skip_blob();
                break;
            case 't':
                in.take(8);
                break;
            case 'c':
            case 'r':
            case 'm':
                in.take(4);
                break;
            case 'N':
            case 'I':
            case '[':
            case ']':
                break;
            default:
                return Status::unsupported;
        }
    }
    if (!in.ok())
        return Status::truncated;
    take(message);
    return Status::ok;
}

Status read_element(ByteView packet, int depth, int& left,
                    const std::function<void(const OscMessage&)>& take) {
    constexpr std::string_view bundle("#bundle\0", 8);
    const std::string_view start(reinterpret_cast<const char*>(packet.data()),
                                 std::min(packet.size(), bundle.size()));
    if (start != bundle) {
        if (left-- <= 0)
            return Status::too_large;
        return read_message(packet, take);
    }
    if (depth == 0)
        return Status::too_large;
    OscReader in(packet.subspan(bundle.size()));
    in.take(8);  // when it is meant for: everything is meant for now
    while (in.ok() && !in.at_end()) {
        const auto size = in.number<std::uint32_t>();
        const ByteView element = in.take(size);
        if (!in.ok())
            break;
        if (size % 4 != 0 || size == 0)
            return Status::malformed;
        if (const Status status = read_element(element, depth - 1, left, take);
            status != Status::ok)
            return status;
    }
    return in.ok() ? Status::ok : Status::truncated;
}

}  // namespace

Status read_osc(ByteView packet, const std::function<void(const OscMessage&)>& take) {
    if (packet.empty())
        return Status::truncated;
    if (packet.size() > max_osc_packet)
        return Status::too_large;
    int left = max_osc_messages;
    return read_element(packet, max_osc_depth, left, take);
}

Bytes osc_packet(const Channels& values, const ChannelMask& mask) {
    Bytes out;
    put_text(out, "#bundle");
    put_be(out, 0);
    put_be(out, 1);  // at once
    for (std::size_t i = 0; i < channel_count; ++i) {
        if (!mask[i])
            continue;
        Bytes message;
        put_text(message, "/theatron/face/" + std::string(channel_names[i]));
        put_text(message, ",f");
        std::byte bytes[4];
        store_f32(bytes, values[i]);
        put_be(message, load_le<std::uint32_t>(bytes));
        put_be(out, std::uint32_t(message.size()));
        out.insert(out.end(), message.begin(), message.end());
    }
    return out;
}

}  // namespace theatron::face
