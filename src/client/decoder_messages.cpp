// SPDX-License-Identifier: Apache-2.0
#include "client/decoder_messages.h"

#include <type_traits>
#include <utility>

namespace theatron::client {
namespace {

// Calls `field` for each field, to write or to read it: `m` may be const.
void figure_fields(auto& m, auto&& field) {
    field(m.stream);
    field(m.codec);
    field(m.frames_per_second);
    field(m.mbit_per_second);
    field(m.frames);
    field(m.bytes);
    field(m.dropped);
    field(m.newest);
    field(m.age_ms);
    field(m.age_now_ms);
    field(m.exact);
    field(m.age_p50_ms);
    field(m.age_p95_ms);
    field(m.age_p99_ms);
    field(m.age_max_ms);
    field(m.past);
    field(m.decode_ms);
    field(m.decoder_failures);
    field(m.awaited_ms);
    field(m.has_come);
}

template <class T>
concept Integer = std::is_integral_v<T> && !std::is_same_v<T, bool>;
template <class T>
concept Enumeration = std::is_enum_v<T>;

struct Writer {
    explicit Writer(Bytes& out) : writer(out) {}

    void operator()(bool value) { writer.put(std::uint8_t(value)); }
    void operator()(double value) { writer.put_f64(value); }
    void operator()(Duration value) { writer.put(std::int64_t(value.count())); }
    void operator()(TimePoint value) { (*this)(value.time_since_epoch()); }
    void operator()(Integer auto value) { writer.put(value); }
    void operator()(Enumeration auto value) { writer.put(std::int64_t(value)); }
    void operator()(ByteView bytes) {
        writer.put(std::uint64_t(bytes.size()));
        writer.put_bytes(bytes);
    }
    void operator()(const std::string& text) { (*this)(as_bytes(text)); }
    // As the host sent them.
    void operator()(const std::vector<wire::Camera>& cameras) {
        (*this)(ByteView(wire::encode(wire::ToParticipant(wire::CamerasAdded{cameras}))));
    }
    void operator()(const std::vector<wire::StreamSetting>& settings) {
        (*this)(ByteView(wire::encode(wire::ToParticipant(wire::Settings{settings, {}}))));
    }
    void operator()(const std::vector<receive::StreamFigures>& all) {
        writer.put(std::uint32_t(all.size()));
        for (const receive::StreamFigures& figures : all)
            figure_fields(figures, *this);
    }

    ByteWriter writer;
};

struct Reader {
    explicit Reader(ByteView in) : reader(in) {}

    void operator()(bool& value) { value = reader.get<std::uint8_t>() != 0; }
    void operator()(double& value) { value = reader.get_f64(); }
    void operator()(Duration& value) { value = Duration(reader.get<std::int64_t>()); }
    void operator()(TimePoint& value) { value = TimePoint(Duration(reader.get<std::int64_t>())); }
    template <Integer T>
    void operator()(T& value) {
        value = reader.get<T>();
    }
    template <Enumeration T>
    void operator()(T& value) {
        value = T(reader.get<std::int64_t>());
    }
    void operator()(ByteView& bytes) {
        const auto size = reader.get<std::uint64_t>();
        if (size > reader.rest().size())
            is_damaged = true;
        else
            bytes = reader.get_bytes(std::size_t(size));
    }
    void operator()(std::string& text) {
        ByteView bytes;
        (*this)(bytes);
        text.assign(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    }
    // The `list` of a message of the host.
    template <class Message, class List>
    void part(List Message::*list, List& value) {
        ByteView bytes;
        (*this)(bytes);
        auto message = wire::decode_to_participant(bytes);
        auto* const found = message ? std::get_if<Message>(&*message) : nullptr;
        if (found)
            value = std::move(found->*list);
        else
            is_damaged = true;
    }
    void operator()(std::vector<wire::Camera>& cameras) {
        part(&wire::CamerasAdded::cameras, cameras);
    }
    void operator()(std::vector<wire::StreamSetting>& settings) {
        part(&wire::Settings::settings, settings);
    }
    void operator()(std::vector<receive::StreamFigures>& all) {
        for (auto left = reader.get<std::uint32_t>(); left > 0 && reader.ok(); --left)
            figure_fields(all.emplace_back(), *this);
    }

    ByteReader reader;
    bool is_damaged = false;
};

template <class Variant>
Bytes encode_any(const Variant& message) {
    Bytes bytes{std::byte(message.index())};
    std::visit(
        [&](const auto& m) {
            if constexpr (requires { m.depth; })
                bytes.reserve(m.depth.size() + m.color.size() + 256);
            Writer writer(bytes);
            m.fields(m, writer);
        },
        message);
    return bytes;
}

template <class Variant, std::size_t kind = 0>
Result<Variant> decode_any(ByteView bytes) {
    if constexpr (kind < std::variant_size_v<Variant>) {
        if (bytes.empty() || bytes[0] != std::byte(kind))
            return decode_any<Variant, kind + 1>(bytes);
        std::variant_alternative_t<kind, Variant> m;
        Reader reader(bytes.subspan(1));
        m.fields(m, reader);
        if (!reader.reader.ok() || reader.is_damaged)
            return Status::malformed;
        return Variant(std::move(m));
    } else {
        return Status::malformed;
    }
}

}  // namespace

Bytes encode(const ToWorker& message) {
    return encode_any(message);
}

Bytes encode(const FromWorker& message) {
    return encode_any(message);
}

Result<ToWorker> decode_to_worker(ByteView bytes) {
    return decode_any<ToWorker>(bytes);
}

Result<FromWorker> decode_from_worker(ByteView bytes) {
    return decode_any<FromWorker>(bytes);
}

}  // namespace theatron::client
