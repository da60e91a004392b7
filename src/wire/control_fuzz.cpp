// SPDX-License-Identifier: Apache-2.0
// Any bytes: decoding stays inside them. An accepted message encodes again to bytes that decode to
// the same, within the stated memory, however often the input's tables share their parts.
#include <cstdlib>

#include "base/outside_text.h"
#include "wire/control.h"

namespace {

using namespace theatron;

// Bytes that a message holds beside its own struct. Every text in it must be clean.
struct Measure {
    std::size_t& bytes;
    template <class T>
    void operator()(const T& value) {
        if constexpr (requires { T::fields(value, *this); })
            T::fields(value, *this);
    }
    void operator()(const std::string& text, std::size_t limit) {
        if (clean_text(text, limit) != text)
            std::abort();
        bytes += text.size();
    }
    template <class T>
    void operator()(const std::vector<T>& list, std::size_t limit) {
        if (list.size() > limit)
            std::abort();
        bytes += list.size() * sizeof(T);
        if constexpr (requires(const T& element) { T::fields(element, *this); })
            for (const T& element : list)
                T::fields(element, *this);
        if constexpr (std::is_same_v<T, std::string>)
            for (const std::string& text : list)
                (*this)(text, wire::max_sentence);
    }
};

template <class Union>
void check(const Result<Union>& message, Result<Union> (*decode)(ByteView)) {
    if (!message)
        return;
    std::size_t bytes = 0;
    std::visit([&](const auto& m) { m.fields(m, Measure{bytes}); }, *message);
    if (bytes > wire::max_decoded_size)
        std::abort();
    const Bytes encoded = wire::encode(*message);
    const auto again = decode(encoded);
    if (!again || again->index() != message->index() || wire::encode(*again) != encoded)
        std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const ByteView bytes = std::as_bytes(std::span(data, size));
    check(wire::decode_to_host(bytes), wire::decode_to_host);
    check(wire::decode_to_participant(bytes), wire::decode_to_participant);
    return 0;
}
