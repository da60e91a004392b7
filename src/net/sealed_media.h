// SPDX-License-Identifier: Apache-2.0
// Media messages whose payload only the people of the session can read: a relay sees their headers
// alone (docs/formats/connection.md). AES-256-GCM seals the payload with the session's key; the
// header is not hidden, but nobody without the key can change it, except `sent`.
#pragma once

#include <map>
#include <optional>
#include <utility>

#include "base/bytes.h"
#include "base/ids.h"
#include "net/cipher.h"
#include "wire/media_header.h"

namespace theatron::net {

inline constexpr std::size_t media_seal_key_size = 32;
// Bytes that a seal adds behind the payload: the number of the key, a count, and a tag.
inline constexpr std::size_t media_seal_size = 4 + 8 + 16;

// Not thread safe.
class MediaSealer {
public:
    // A key never has two sealers: each counts the messages of its key. `key`: media_seal_key_size
    // bytes. Throws Error if OpenSSL cannot do it here.
    MediaSealer(std::uint32_t key_number, ByteView key);

    std::uint32_t key_number() const { return number_; }
    // The message with this header, whose payload_size grows by media_seal_size, and this payload.
    // Throws Error.
    Bytes seal(wire::MediaHeader header, ByteView payload);

private:
    const std::uint32_t number_;
    std::uint64_t count_ = 0;
    Cipher cipher_;
};

// Not thread safe. Safe on any bytes.
class MediaOpener {
public:
    enum class Failure {
        unknown_key,  // one that this receiver does not know, or does not know any more
        repeated,     // a message that came before, or is older than one that came
        forged,       // it is not what the session has sealed
    };
    // One more key; of earlier ones the newest stays. `key`: media_seal_key_size bytes.
    void add_key(std::uint32_t number, ByteView key);
    // The message as it was before it was sealed, or why it is to be left out.
    std::optional<Bytes> open(ByteView message, Failure& failure);

private:
    std::map<std::uint32_t, Bytes> keys_;  // at most two
    // The key and the count of the newest message.
    std::map<StreamId, std::pair<std::uint32_t, std::uint64_t>> newest_;
    Cipher cipher_;
    std::uint32_t cipher_key_ = 0;  // of which cipher_ is
};

}  // namespace theatron::net
